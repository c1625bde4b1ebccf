//! Gear-Gupta-Leimkuhler's equations for implicit integrators.

use super::super::{From, Setup};
use super::form::{Dense, Form};
use super::kinematics::Kinematics;
use crate::formulation::{Dynamics, Halt, Statistics};
use crate::integrator::NO_TANGENT;
use crate::system::{Dimensions, Loaded, Need, Tangent};
use std::ops::Range;

/// ```text
/// q' = N u,   v' = a,   w' = power
/// 0 = M a + G^T lambda - f,   0 = M (u - v) + G^T mu,   0 = phi,   0 = G v + phi_t
/// ```
///
/// in q, v, w, a, u, lambda, mu: with rates as unknowns no M stands before a derivative, where diffsol wants a constant.
/// The Jacobian is exact at mu = 0, which holds for the exact motion. diffsol solves with its matrix before it takes the norm
/// of an error, which leaves what is along the constraints: no driver, however fast, makes steps shorter.
pub struct Ggl<'s> {
    dynamics: Dynamics<'s>,
    tangent: Tangent,
    kinematics: Kinematics,
    /// u - v
    slip: Vec<f64>,
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
            slip: vec![0.0; setup.system.dimensions().v],
            places: Places::new(setup.system.dimensions()),
        }
    }
}

impl Ggl<'_> {
    /// The rows of q' and v' of the Jacobian.
    fn rates(&mut self, x: &[f64], out: &mut Dense) {
        let Places { v, a, u, .. } = &self.places;
        let (system, q) = (self.dynamics.system, &x[..v.start]);
        self.kinematics.update(system, q);
        self.kinematics.by_q(system, q, &x[u.clone()], out);
        self.kinematics.by_v((0, u.start), out);
        a.clone().zip(v.clone()).for_each(|(a, v)| out.add(v, a, 1.0));
    }

    /// The rows without a derivative.
    fn balances(&self, out: &mut Dense) {
        let Places { v, a, u, lambda, mu, .. } = &self.places;
        let (terms, structure) = (&self.dynamics.terms, &self.dynamics.structure);
        let (mass, g, tangent) = (&structure.mass, &structure.g, &structure.tangent);
        self.kinematics.along(a.start, tangent, &self.tangent.k, out);
        out.block((a.start, v.start), tangent, &self.tangent.c);
        out.symmetric((a.start, a.start), mass, &terms.mass, 1.0);
        out.transposed((a.start, lambda.start), g, &terms.g);
        out.symmetric((u.start, u.start), mass, &terms.mass, 1.0);
        out.symmetric((u.start, v.start), mass, &terms.mass, -1.0);
        out.transposed((u.start, mu.start), g, &terms.g);
        self.kinematics.along(lambda.start, g, &terms.g, out);
        self.kinematics.along(mu.start, g, &terms.l, out);
        out.block((mu.start, v.start), g, &terms.g);
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
            return Err(Halt::Unsuitable {
                reason: "ggl cannot solve redundant constraints with this integrator",
                hint: "`holonom check` names them; radau_iia and generalized_alpha solve them with ggl",
            });
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
        for (i, slip) in self.slip.iter_mut().enumerate() {
            *slip = x[u.start + i] - x[v.start + i];
            out[a.start + i] = -terms.f[i];
        }
        structure.mass.multiply_symmetric(&terms.mass, &x[a.clone()], &mut out[a.clone()]);
        structure.g.multiply_transposed(&terms.g, &x[lambda.clone()], &mut out[a.clone()]);
        structure.mass.multiply_symmetric(&terms.mass, &self.slip, &mut out[u.clone()]);
        structure.g.multiply_transposed(&terms.g, &x[mu.clone()], &mut out[u.clone()]);
        out[lambda.clone()].copy_from_slice(&terms.phi);
        out[mu.clone()].copy_from_slice(&terms.phi_dot);
        Ok(())
    }

    fn jacobian(&mut self, t: f64, x: &[f64], out: &mut Dense) -> Result<(), Halt> {
        let Places { v, a, lambda, .. } = &self.places;
        let (dynamics, q, v) = (&mut self.dynamics, &x[..v.start], &x[v.clone()]);
        dynamics.statistics.jacobian_evaluations += 1;
        dynamics.evaluate(t, q, v, Need::DYNAMICS | Need::L);
        let at = Loaded { t, q, v, vdot: &x[a.clone()], lambda: &x[lambda.clone()] };
        if !dynamics.system.tangent(at, &mut self.tangent, &mut dynamics.scratch) {
            return Err(NO_TANGENT);
        }
        self.rates(x, out);
        self.balances(out);
        Ok(())
    }

    fn follow(&mut self, run: &Dynamics) {
        self.dynamics.follow(run);
    }

    fn statistics(&mut self) -> &mut Statistics {
        &mut self.dynamics.statistics
    }
}
