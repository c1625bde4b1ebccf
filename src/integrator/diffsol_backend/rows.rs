//! A formulation with its multipliers for implicit integrators.

use super::super::{From, Setup};
use super::kinematics::{Dense, Kinematics};
use crate::formulation::{Dae, Dynamics, NO_TANGENT, Residual, Row, Statistics, StepError, Unknowns};
use crate::system::{Dimensions, Need, OperatingPoint, Tangent};
use std::ops::Range;

/// ```text
/// q' = N (v + u),   v' = a + w,   w' = powers
/// 0 = M a + G^T lambda - f,   0 = M w + G^T eta,   0 = M u + G^T mu,   and the rows of lambda, eta and mu
/// ```
///
/// in q, v, the work, a and lambda, then w and eta, u and mu where the [`Dae`] has them: with rates as unknowns no M
/// multiplies a derivative, where diffsol requires a constant. The Jacobian is exact but for the derivative of phi''
/// with respect to q, which contains no stiffness, and for terms that vanish with mu = eta = 0, as in the exact motion.
/// Multipliers of dropped rows are zero.
pub struct FirstOrderRows<'s> {
    dae: Dae,
    dynamics: Dynamics<'s>,
    residual: Residual,
    tangent: Tangent,
    kinematics: Kinematics,
    /// v + u
    velocity: Vec<f64>,
    places: Places,
}

/// Ranges of the unknowns; the equations of motion are in the rows of a, those of the shifts in the rows of the shifts.
struct Places {
    v: Range<usize>,
    work: Range<usize>,
    a: Range<usize>,
    lambda: Range<usize>,
    /// Shift of v with its multipliers, then shift of q with its multipliers.
    w: Option<[Range<usize>; 2]>,
    u: Option<[Range<usize>; 2]>,
    end: usize,
}

impl Places {
    fn new(dae: &Dae, n: Dimensions, rates: usize) -> Self {
        let mut end = rates;
        let mut next = |size: usize| {
            end += size;
            end - size..end
        };
        let (a, lambda) = (next(n.v), next(n.lambda));
        let w = dae.eta.map(|_| [next(n.v), next(n.lambda)]);
        let u = dae.mu.map(|_| [next(n.v), next(n.lambda)]);
        let work = n.q + n.v..rates;
        Places { v: n.q..work.start, work, a, lambda, w, u, end }
    }
}

/// Number of unknowns for a system of these dimensions, `rates` of which have a rate.
pub fn unknowns(dae: &Dae, n: Dimensions, rates: usize) -> usize {
    Places::new(dae, n, rates).end
}

impl<'s> FirstOrderRows<'s> {
    pub fn new(dae: Dae, setup: &Setup<'s>) -> Self {
        let n = setup.system.dimensions();
        FirstOrderRows {
            dae,
            dynamics: Dynamics::new(setup.system),
            residual: Residual::new(n),
            tangent: Tangent::new(&setup.system.structure().tangent),
            kinematics: Kinematics::new(setup.system),
            velocity: vec![0.0; n.v],
            places: Places::new(&dae, n, setup.len()),
        }
    }

    /// Sets `velocity` to v + u.
    fn moves(&mut self, x: &[f64]) {
        self.velocity.copy_from_slice(&x[self.places.v.clone()]);
        if let Some([u, _]) = &self.places.u {
            self.velocity.iter_mut().zip(&x[u.clone()]).for_each(|(velocity, u)| *velocity += u);
        }
    }

    /// Writes the rows of q' and v' of the Jacobian.
    fn rates(&mut self, x: &[f64], out: &mut Dense) {
        self.moves(x);
        let Places { v, a, w, u, .. } = &self.places;
        let (system, q) = (self.dynamics.system, &x[..v.start]);
        self.kinematics.update(system, q);
        self.kinematics.by_q(system, q, &self.velocity, out);
        self.kinematics.by_v((0, v.start), out);
        u.iter().for_each(|[u, _]| self.kinematics.by_v((0, u.start), out));
        let rates = [Some(a), w.as_ref().map(|[w, _]| w)];
        for rate in rates.into_iter().flatten() {
            rate.clone().zip(v.clone()).for_each(|(rate, v)| out.add(v, rate, 1.0));
        }
    }

    /// Writes the rows of the equations of motion and of the shifts.
    fn balances(&self, out: &mut Dense) {
        let Places { v, a, lambda, w, u, .. } = &self.places;
        let (terms, structure) = (&self.dynamics.terms, &self.dynamics.structure);
        let (mass, g, tangent) = (&structure.mass, &structure.g, &structure.tangent);
        self.kinematics.along(a.start, tangent, &self.tangent.k, out);
        out.block((a.start, v.start), tangent, &self.tangent.c);
        let pairs = [Some([a, lambda]), w.as_ref().map(|[w, eta]| [w, eta]), u.as_ref().map(|[u, mu]| [u, mu])];
        for [moved, multipliers] in pairs.into_iter().flatten() {
            out.symmetric((moved.start, moved.start), mass, &terms.mass, 1.0);
            out.transposed((moved.start, multipliers.start), g, &terms.g);
        }
    }

    /// Writes the rows of one kind of multipliers, which begin at `at`.
    fn constraints(&self, dae: impl Fn(&Dae) -> Option<Row>, at: usize, out: &mut Dense) {
        let Places { v, a, .. } = &self.places;
        let (terms, g) = (&self.dynamics.terms, &self.dynamics.structure.g);
        let kinds = [dae(&self.dae), dae(&self.dae.nonholonomic())];
        let holonomic = self.dynamics.system.dimensions().holonomic();
        let dropped = &self.dynamics.dropped;
        dropped.iter().for_each(|row| out.add(at + row, at + row, 1.0));
        // Multipliers without a row are zero.
        let without = |row: &usize| kinds[usize::from(*row >= holonomic)].is_none() && !dropped.contains(row);
        (0..g.rows).filter(without).for_each(|row| out.add(at + row, at + row, 1.0));
        for (&(i, j), (g, l)) in g.entries.iter().zip(terms.g.iter().zip(&terms.l)) {
            if dropped.contains(&i) {
                continue;
            }
            let Some(row) = kinds[usize::from(i >= holonomic)] else { continue };
            self.kinematics.add_along(at + i, j, row.position * g + row.velocity * l, out);
            out.add(at + i, v.start + j, row.velocity * g + 2.0 * row.acceleration * l);
            out.add(at + i, a.start + j, row.acceleration * g);
        }
    }
}

/// In the form of diffsol: x' = F(t, x) in the first unknowns, which are q, v and the work; 0 = F(t, x) in the others.
impl FirstOrderRows<'_> {
    /// Number of unknowns.
    pub fn len(&self) -> usize {
        self.places.end
    }

    /// x and x' at the start of a run, from q, v and the work with their rates.
    pub fn start(&mut self, from: From, x: &mut [f64], rate: &mut [f64]) -> Result<(), StepError> {
        let Places { v, work, a, lambda, .. } = &self.places;
        let (q, speed) = (&from.y[..v.start], &from.y[v.clone()]);
        self.dynamics.solve(from.t, q, speed, |_, _| 0.0)?;
        let is_dropped = |row: &usize| self.dynamics.dropped.contains(row);
        if !self.dynamics.kkt.left_out().iter().all(is_dropped) {
            return Err(StepError::Unsuitable {
                reason: "redundant constraints cannot be solved by this integrator",
                hint: "`holonom check` names them; radau_iia and generalized_alpha solve them",
            });
        }
        x.fill(0.0);
        rate.fill(0.0);
        x[..work.end].copy_from_slice(from.y);
        rate[..work.end].copy_from_slice(from.slope);
        x[a.clone()].copy_from_slice(&self.dynamics.vdot);
        x[lambda.clone()].copy_from_slice(&self.dynamics.lambda);
        Ok(())
    }

    pub fn evaluate(&mut self, t: f64, x: &[f64], out: &mut [f64]) -> Result<(), StepError> {
        self.moves(x);
        let Places { v, work, a, lambda, w, u, .. } = &self.places;
        let (dynamics, q) = (&mut self.dynamics, &x[..v.start]);
        let state = (t, q, &x[v.clone()]);
        let pair = |places: &Option<[Range<usize>; 2]>| {
            places.as_ref().map_or([&[][..]; 2], |[moved, multipliers]| [&x[moved.clone()], &x[multipliers.clone()]])
        };
        let ([of_w, of_eta], [of_u, of_mu]) = (pair(w), pair(u));
        let (a_1, lambda_1) = (&x[a.clone()], &x[lambda.clone()]);
        let unknowns = Unknowns { a: a_1, lambda: lambda_1, w: of_w, eta: of_eta, u: of_u, mu: of_mu, stiffness: &[] };
        self.residual.evaluate(&self.dae, state, unknowns, dynamics)?;
        let Residual { motion, lambda: rows, w: left_w, eta: left_eta, u: left_u, mu: left_mu, powers, .. } =
            &self.residual;
        dynamics.system.rate(q, &self.velocity, &mut out[..v.start]);
        out[v.clone()].copy_from_slice(a_1);
        out[v.clone()].iter_mut().zip(of_w).for_each(|(rate, w)| *rate += w);
        out[work.clone()].copy_from_slice(powers);
        let mut set = |place: &Range<usize>, left: &[f64]| {
            out[place.clone()].iter_mut().zip(left).for_each(|(out, left)| *out = -left);
        };
        set(a, motion);
        set(lambda, rows);
        w.iter()
            .for_each(|[w, eta]| [(w, left_w), (eta, left_eta)].into_iter().for_each(|(place, left)| set(place, left)));
        u.iter()
            .for_each(|[u, mu]| [(u, left_u), (mu, left_mu)].into_iter().for_each(|(place, left)| set(place, left)));
        let multipliers = [Some(lambda), w.as_ref().map(|[_, eta]| eta), u.as_ref().map(|[_, mu]| mu)];
        for place in multipliers.into_iter().flatten() {
            dynamics.dropped.iter().for_each(|row| out[place.start + row] = x[place.start + row]);
        }
        let n = dynamics.system.dimensions();
        if let Some([_, place]) = u {
            (place.start + n.holonomic()..place.end).for_each(|row| out[row] += x[row]);
        }
        Ok(())
    }

    /// Adds dF/dx, or a sufficient approximation for Newton's method, to a matrix of zeros.
    pub fn jacobian(&mut self, t: f64, x: &[f64], out: &mut Dense) -> Result<(), StepError> {
        let Places { v, a, lambda, w, u, .. } = &self.places;
        let (dynamics, q, v) = (&mut self.dynamics, &x[..v.start], &x[v.clone()]);
        dynamics.statistics.jacobian_evaluations += 1;
        dynamics.evaluate(t, q, v, Need::DYNAMICS | Need::L);
        let at = OperatingPoint { t, q, v, vdot: &x[a.clone()], lambda: &x[lambda.clone()] };
        if !dynamics.system.tangent(at, &mut self.tangent, &mut dynamics.scratch) {
            return Err(NO_TANGENT);
        }
        let places = [Some(lambda), w.as_ref().map(|[_, eta]| eta), u.as_ref().map(|[_, mu]| mu)];
        let [of_lambda, of_eta, of_mu] = places.map(|place| place.map(|place| place.start));
        self.rates(x, out);
        self.balances(out);
        of_lambda.into_iter().for_each(|at| self.constraints(|dae| Some(dae.lambda), at, out));
        of_eta.into_iter().for_each(|at| self.constraints(|dae| dae.eta, at, out));
        of_mu.into_iter().for_each(|at| self.constraints(|dae| dae.mu, at, out));
        Ok(())
    }

    /// Takes over the dropped rows and the pieces of functions of the run.
    pub fn follow(&mut self, run: &Dynamics) {
        self.dynamics.follow(run);
    }

    /// The counters of the work done here.
    pub fn statistics(&mut self) -> &mut Statistics {
        &mut self.dynamics.statistics
    }
}
