//! Gear-Gupta-Leimkuhler's equations for implicit integrators.

use super::super::{From, Setup};
use super::form::{Dense, Form};
use super::kinematics::Kinematics;
use crate::formulation::{Dynamics, Halt, Statistics};
use crate::system::{Dimensions, Loaded, Need, Tangent};
use std::ops::Range;

/// ```text
/// q' = N u,   v' = a,   w' = power
/// 0 = M a + G^T lambda - f,   0 = M (u - v) + G^T mu,   0 = phi,   0 = G v + phi_t
/// ```
///
/// in q, v, w, a, u, lambda, mu: with rates as unknowns no M stands before a derivative, where diffsol wants a constant.
/// The Jacobian is exact at mu = 0, which holds for the exact motion.
pub struct Ggl<'s> {
    dynamics: Dynamics<'s>,
    tangent: Tangent,
    kinematics: Kinematics,
    places: Places,
}

/// Where the unknowns stand; rows of the equations of a, u, phi and phi' are those of a, u, lambda and mu.
struct Places {
    v: Range<usize>,
    work: usize,
    a: Range<usize>,
    u: Range<usize>,
    lambda: Range<usize>,
    mu: Range<usize>,
}

impl Places {
    fn new(n: Dimensions) -> Self {
        let work = n.q + n.v;
        let (a, u) = (work + 1, work + 1 + n.v);
        let (lambda, mu) = (u + n.v, u + n.v + n.lambda);
        Places { v: n.q..work, work, a: a..u, u: u..lambda, lambda: lambda..mu, mu: mu..mu + n.lambda }
    }
}

impl<'s> Ggl<'s> {
    pub fn new(setup: &Setup<'_, 's>) -> Self {
        Ggl {
            dynamics: Dynamics::new(setup.system),
            tangent: Tangent::new(&setup.system.structure().tangent),
            kinematics: Kinematics::new(setup.system),
            places: Places::new(setup.system.dimensions()),
        }
    }
}

impl Form for Ggl<'_> {
    fn len(&self) -> usize {
        self.places.mu.end
    }

    fn start(&mut self, from: From, x: &mut [f64], rate: &mut [f64]) -> Result<(), Halt> {
        let Places { v, work, a, u, lambda, .. } = &self.places;
        let (q, speed) = (&from.y[..v.start], &from.y[v.clone()]);
        self.dynamics.solve(from.t, q, speed, |_, _| 0.0)?;
        if self.dynamics.is_rank_deficient {
            return Err(Halt::Unsuitable("ggl cannot solve redundant constraints: `holonom check` names them"));
        }
        x.fill(0.0);
        rate.fill(0.0);
        x[..=*work].copy_from_slice(from.y);
        rate[..=*work].copy_from_slice(from.slope);
        x[a.clone()].copy_from_slice(&self.dynamics.vdot);
        x[u.clone()].copy_from_slice(speed);
        x[lambda.clone()].copy_from_slice(&self.dynamics.lambda);
        Ok(())
    }

    fn evaluate(&mut self, t: f64, x: &[f64], out: &mut [f64]) -> Result<(), Halt> {
        if x.iter().any(|x| !x.is_finite()) {
            return Err(Halt::NotFinite);
        }
        let Places { v, work, a, u, lambda, mu } = &self.places;
        let (dynamics, q) = (&mut self.dynamics, &x[..v.start]);
        dynamics.statistics.rhs_evaluations += 1;
        dynamics.evaluate(t, q, &x[v.clone()], Need::DYNAMICS);
        let (terms, structure) = (&dynamics.terms, &dynamics.structure);
        out.fill(0.0);
        dynamics.system.rate(q, &x[u.clone()], &mut out[..v.start]);
        out[v.clone()].copy_from_slice(&x[a.clone()]);
        out[*work] = terms.power + x[lambda.clone()].iter().zip(&terms.phi_t).map(|(l, p)| l * p).sum::<f64>();
        out[a.clone()].iter_mut().zip(&terms.f).for_each(|(out, f)| *out = -f);
        structure.mass.multiply_symmetric(&terms.mass, &x[a.clone()], &mut out[a.clone()]);
        structure.g.multiply_transposed(&terms.g, &x[lambda.clone()], &mut out[a.clone()]);
        let slip: Vec<f64> = x[u.clone()].iter().zip(&x[v.clone()]).map(|(u, v)| u - v).collect();
        structure.mass.multiply_symmetric(&terms.mass, &slip, &mut out[u.clone()]);
        structure.g.multiply_transposed(&terms.g, &x[mu.clone()], &mut out[u.clone()]);
        out[lambda.clone()].copy_from_slice(&terms.phi);
        out[mu.clone()].copy_from_slice(&terms.phi_dot);
        Ok(())
    }

    fn jacobian(&mut self, t: f64, x: &[f64], out: &mut Dense) -> Result<(), Halt> {
        let Places { v, a, u, lambda, mu, .. } = &self.places;
        let (dynamics, kinematics) = (&mut self.dynamics, &mut self.kinematics);
        let q = &x[..v.start];
        dynamics.statistics.jacobian_evaluations += 1;
        dynamics.evaluate(t, q, &x[v.clone()], Need::DYNAMICS | Need::L);
        let at = Loaded { t, q, v: &x[v.clone()], vdot: &x[a.clone()], lambda: &x[lambda.clone()] };
        if !dynamics.system.tangent(at, &mut self.tangent, &mut dynamics.scratch) {
            return Err(Halt::Unsuitable("implicit integrators need K and C, which these equations do not give"));
        }
        let (terms, structure) = (&dynamics.terms, &dynamics.structure);
        let (mass, g, tangent) = (&structure.mass, &structure.g, &structure.tangent);
        kinematics.update(dynamics.system, q);
        kinematics.by_q(dynamics.system, q, &x[u.clone()], out);
        kinematics.by_v((0, u.start), out);
        a.clone().zip(v.clone()).for_each(|(a, v)| out.add(v, a, 1.0));
        kinematics.along(a.start, tangent, &self.tangent.k, 1.0, out);
        out.block((a.start, v.start), tangent, &self.tangent.c, 1.0);
        out.symmetric((a.start, a.start), mass, &terms.mass, 1.0);
        out.transposed((a.start, lambda.start), g, &terms.g, 1.0);
        out.symmetric((u.start, u.start), mass, &terms.mass, 1.0);
        out.symmetric((u.start, v.start), mass, &terms.mass, -1.0);
        out.transposed((u.start, mu.start), g, &terms.g, 1.0);
        kinematics.along(lambda.start, g, &terms.g, 1.0, out);
        kinematics.along(mu.start, g, &terms.l, 1.0, out);
        out.block((mu.start, v.start), g, &terms.g, 1.0);
        Ok(())
    }

    fn statistics(&mut self) -> &mut Statistics {
        &mut self.dynamics.statistics
    }
}
