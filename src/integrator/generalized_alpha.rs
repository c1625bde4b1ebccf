//! Generalized-alpha on the index 3 equations.

use super::hermite::Hermite;
use super::{Control, Entry, From, Integrator, Problem, Setup, Steps, Tolerance};
use crate::choice::OptionDoc;
use crate::error::{Error, Result};
use crate::formulation::Halt;
use crate::math::kkt::Unsymmetric;
use crate::system::{Loaded, Need, Tangent};

/// ```text
/// q_1 = q + h v + h^2 ((1/2 - beta) a + beta a_1),   v_1 = v + h ((1 - gamma) a + gamma a_1)
/// (1 - alpha_m) a_1 + alpha_m a = (1 - alpha_f) v'_1 + alpha_f v'
/// M v'_1 + G^T lambda_1 = f,   phi(q_1, t_1) = 0
/// alpha_m = (2 r - 1)/(r + 1),  alpha_f = r/(r + 1),  gamma = 1/2 + alpha_f - alpha_m,  beta = (gamma + 1/2)^2/4
/// ```
///
/// with r = rho_inf, the damping at infinite frequency. Source: Chung, Hulbert, J. Appl. Mech. 60 (1993) 371-375; Arnold,
/// Bruels, Multibody Syst. Dyn. 18 (2007) 185-202. Rotations advance along the group: q_1 = q exp(h Dq), by four
/// Runge-Kutta stages of q' = N(q) Dq. Order 2 in q, v and lambda; implicit, for stiff motions. phi holds to round-off,
/// G v + phi_t to order 2: project it (`velocity`, `manifold`, `exact`) where that matters. `full` would share that
/// error out between v and q at every step, which costs q an order, so it is refused. One matrix a step, from exact K and C; an
/// evaluation and a back-substitution an iteration. The work is the trapezoidal rule. Fixed steps; cubic Hermite interpolation.
pub const ENTRY: Entry = Entry {
    name: "generalized_alpha",
    about: "implicit, damped at high frequencies by rho_inf, for stiff motions; holds phi, fixed steps",
    order: 2,
    orders: &[],
    steps: Steps::Fixed,
    accepts: &["index3"],
    refuses: &["full"],
    options: &[OptionDoc {
        name: "rho_inf",
        about: "what is left of infinitely fast oscillations a step, 0 to 1 (default 0.8)",
    }],
    make,
};

fn make(setup: &Setup) -> Result<Box<dyn Integrator>> {
    let (n, r) = (setup.system.dimensions(), setup.integrator.not_negative("rho_inf", 0.8)?);
    if r > 1.0 {
        return Err(Error::input(format!("generalized_alpha: rho_inf is {r}")).hint("give a number from 0 to 1"));
    }
    let structure = setup.system.structure();
    let matrix = Unsymmetric::new(&structure.mass, &structure.tangent, &structure.g)
        .ok_or_else(|| Error::input("there is not enough memory for a matrix of this size"))?;
    let (alpha_m, alpha_f) = ((2.0 * r - 1.0) / (r + 1.0), r / (r + 1.0));
    let gamma = 0.5 + alpha_f - alpha_m;
    let zeros = |n: usize| vec![0.0; n];
    Ok(Box::new(GeneralizedAlpha {
        coefficients: Coefficients { alpha_m, alpha_f, gamma, beta: 0.25 * (gamma + 0.5) * (gamma + 0.5) },
        tangent: Tangent::new(&structure.tangent),
        matrix,
        reached: None,
        a: zeros(n.v),
        vdot: zeros(n.v),
        a_new: zeros(n.v),
        vdot_new: zeros(n.v),
        lambda: zeros(n.lambda),
        top: zeros(n.v),
        bottom: zeros(n.lambda),
        stages: [zeros(n.q), zeros(n.q), zeros(n.q)],
        control: Control::new(2.0, 0.0, 0.2, 5.0),
        polynomial: Hermite::new(setup.len(), 0),
    }))
}

struct Coefficients {
    alpha_m: f64,
    alpha_f: f64,
    gamma: f64,
    beta: f64,
}

struct GeneralizedAlpha {
    coefficients: Coefficients,
    tangent: Tangent,
    matrix: Unsymmetric<f64>,
    /// Time at which `a_new` and `vdot_new` were reached.
    reached: Option<f64>,
    /// a and v' at the start of the step.
    a: Vec<f64>,
    vdot: Vec<f64>,
    a_new: Vec<f64>,
    vdot_new: Vec<f64>,
    lambda: Vec<f64>,
    top: Vec<f64>,
    bottom: Vec<f64>,
    stages: [Vec<f64>; 3],
    control: Control,
    polynomial: Hermite,
}

const NO_TANGENT: Halt = Halt::Unsuitable {
    reason: "generalized_alpha needs K and C, which these equations do not give",
    hint: "implement MechanicalSystem::tangent, or use a method that needs none, such as phem56 with index2",
};

/// Newton iterations, and the relative change below which it may stop falling.
const MOST: usize = 25;
const SMALL: f64 = 1e-8;

impl GeneralizedAlpha {
    /// a = v'(t + (alpha_m - alpha_f) h) + O(h^2) at the first step, against transients of first order in lambda; later
    /// a and v' of the step before.
    fn begin(&mut self, problem: &mut Problem, from: From, h: f64, ahead: &mut [f64]) -> Result<(), Halt> {
        if self.reached.is_some_and(|t| (t - from.t).abs() < 1e-6 * h) {
            self.a.copy_from_slice(&self.a_new);
            self.vdot.copy_from_slice(&self.vdot_new);
            return Ok(());
        }
        let (_, vdot) = problem.split(from.slope);
        self.vdot.copy_from_slice(vdot);
        for (i, ahead) in ahead.iter_mut().enumerate() {
            *ahead = from.y[i] + h * from.slope[i];
        }
        let (q, v) = problem.split_mut(ahead);
        problem.dynamics.system.normalize(q);
        problem.dynamics.solve(from.t + h, q, v, |_, _| 0.0)?;
        let Coefficients { alpha_m, alpha_f, .. } = self.coefficients;
        for (i, a) in self.a.iter_mut().enumerate() {
            *a = self.vdot[i] + (alpha_m - alpha_f) * (problem.dynamics.vdot[i] - self.vdot[i]);
        }
        Ok(())
    }

    /// a_1, v_1 and q_1 that go with v'_1.
    fn advance(&mut self, problem: &mut Problem, from: From, h: f64, to: &mut [f64]) {
        let Coefficients { alpha_m, alpha_f, gamma, beta } = self.coefficients;
        let (q0, v0) = problem.split(from.y);
        let (q, v) = problem.split_mut(to);
        for i in 0..v.len() {
            let mean = (1.0 - alpha_f) * self.vdot_new[i] + alpha_f * self.vdot[i];
            self.a_new[i] = (mean - alpha_m * self.a[i]) / (1.0 - alpha_m);
            v[i] = v0[i] + h * ((1.0 - gamma) * self.a[i] + gamma * self.a_new[i]);
            self.top[i] = h * v0[i] + h * h * ((0.5 - beta) * self.a[i] + beta * self.a_new[i]);
        }
        let system = problem.dynamics.system;
        if q.len() == v.len() {
            q.iter_mut().zip(q0.iter().zip(&self.top)).for_each(|(q, (q0, dq))| *q = q0 + dq);
            return;
        }
        // The exponential of a constant rate by the classical Runge-Kutta method: its error is O(|dq|^5).
        let [rate, stage, sum] = &mut self.stages;
        stage.copy_from_slice(q0);
        sum.fill(0.0);
        for (ahead, weight) in [(0.5, 1.0 / 6.0), (0.5, 1.0 / 3.0), (1.0, 1.0 / 3.0), (0.0, 1.0 / 6.0)] {
            system.rate(stage, &self.top, rate);
            for i in 0..rate.len() {
                sum[i] += weight * rate[i];
                stage[i] = q0[i] + ahead * rate[i];
            }
        }
        q.iter_mut().zip(q0.iter().zip(sum.iter())).for_each(|(q, (q0, dq))| *q = q0 + dq);
        system.normalize(q);
    }

    /// J = [M + gamma' h C + beta' h^2 K, G^T; G, 0] at the predicted state.
    fn factor(&mut self, problem: &mut Problem, t: f64, h: f64, to: &[f64]) -> Result<(), Halt> {
        let (q, v) = problem.split(to);
        let dynamics = &mut problem.dynamics;
        dynamics.evaluate(t, q, v, Need::DYNAMICS);
        let at = Loaded { t, q, v, vdot: &self.vdot_new, lambda: &self.lambda };
        if !dynamics.system.tangent(at, &mut self.tangent, &mut dynamics.scratch) {
            return Err(NO_TANGENT);
        }
        dynamics.statistics.jacobian_evaluations += 1;
        dynamics.statistics.factorizations += 1;
        let slope = self.slope();
        let Coefficients { gamma, beta, .. } = self.coefficients;
        let structure = &dynamics.structure;
        self.matrix.clear();
        self.matrix.add(&structure.mass, &dynamics.terms.mass, 1.0, true);
        self.matrix.add(&structure.tangent, &self.tangent.c, h * gamma * slope, false);
        self.matrix.add(&structure.tangent, &self.tangent.k, h * h * beta * slope, false);
        self.matrix.factor(&structure.g, &dynamics.terms.g).map_err(Halt::from)
    }

    /// da_1/dv'_1
    fn slope(&self) -> f64 {
        (1.0 - self.coefficients.alpha_f) / (1.0 - self.coefficients.alpha_m)
    }

    /// One Newton iteration at q_1, v_1; its size relative to v'_1.
    fn iterate(&mut self, problem: &mut Problem, t: f64, h: f64, to: &[f64]) -> Result<f64, Halt> {
        let (q, v) = problem.split(to);
        let factor = -1.0 / (h * h * self.coefficients.beta * self.slope());
        let dynamics = &mut problem.dynamics;
        dynamics.statistics.newton_iterations += 1;
        dynamics.evaluate(t, q, v, Need::DYNAMICS);
        let (terms, structure) = (&dynamics.terms, &dynamics.structure);
        // top = f - M v' - G^T lambda
        self.top.fill(0.0);
        structure.mass.multiply_symmetric(&terms.mass, &self.vdot_new, &mut self.top);
        structure.g.multiply_transposed(&terms.g, &self.lambda, &mut self.top);
        self.top.iter_mut().zip(&terms.f).for_each(|(top, f)| *top = f - *top);
        self.bottom.iter_mut().zip(&terms.phi).for_each(|(row, phi)| *row = factor * phi);
        self.matrix.solve(&mut self.top, &mut self.bottom)?;
        self.vdot_new.iter_mut().zip(&self.top).for_each(|(vdot, change)| *vdot += change);
        self.lambda.iter_mut().zip(&self.bottom).for_each(|(lambda, change)| *lambda += change);
        let largest = |x: &[f64]| x.iter().fold(0.0, |largest: f64, x| largest.max(x.abs()));
        let size = largest(&self.vdot_new).max(largest(v) / h);
        Ok(if size == 0.0 { 0.0 } else { largest(&self.top) / size })
    }

    fn converge(&mut self, problem: &mut Problem, from: From, h: f64, to: &mut [f64]) -> Result<(), Halt> {
        let t = from.t + h;
        let mut last = f64::INFINITY;
        for iteration in 0..MOST {
            self.advance(problem, from, h, to);
            // A far prediction wants its matrix renewed once.
            if iteration == 0 || iteration == 8 {
                self.factor(problem, t, h, to)?;
            }
            let change = self.iterate(problem, t, h, to)?;
            if !change.is_finite() {
                return Err(Halt::NotFinite);
            }
            if change <= f64::EPSILON || change < SMALL && change > 0.5 * last {
                self.advance(problem, from, h, to);
                return Ok(());
            }
            last = change;
        }
        Err(Halt::NotConverged)
    }
}

impl Integrator for GeneralizedAlpha {
    fn order(&self) -> usize {
        ENTRY.order
    }

    fn control(&mut self) -> &mut Control {
        &mut self.control
    }

    fn attempt(
        &mut self,
        problem: &mut Problem,
        _: &Tolerance,
        from: From,
        h: f64,
        to: &mut [f64],
    ) -> Result<Option<f64>, Halt> {
        self.begin(problem, from, h, to)?;
        self.vdot_new.copy_from_slice(&self.vdot);
        self.converge(problem, from, h, to)?;
        self.reached = Some(from.t + h);
        let work = to.len() - 1;
        // Power at the new state by its own v' and lambda, of which the work needs order 2 only.
        let dynamics = &problem.dynamics;
        let reaction: f64 = self.lambda.iter().zip(&dynamics.terms.phi_t).map(|(lambda, rate)| lambda * rate).sum();
        to[work] = from.y[work] + 0.5 * h * (from.slope[work] + dynamics.terms.power + reaction);
        Ok(None)
    }

    fn prepare(&mut self, _: &mut Problem, from: From, h: f64, to: &[f64], slope: &[f64]) -> Result<(), Halt> {
        self.polynomial.prepare(from, h, to, slope);
        Ok(())
    }

    fn interpolate(&self, theta: f64, from: &[f64], out: &mut [f64]) {
        self.polynomial.interpolate(theta, from, out);
    }
}
