//! RATTLE.

use super::memory::{read, written};
use super::sums::{add, trapezoid};
use super::{Accepted, Control, Integrator, IntegratorEntry, Problem, Setup, Stability, StepStart, takes};
use crate::error::{Error, Result};
use crate::formulation::StepError;
use crate::math::kkt::Singular;
use crate::math::largest;
use crate::math::newton::{Limits, Monitor, relative};
use crate::system::{MechanicalSystem, Need};
use crate::tolerances;
use serde::{Deserialize, Serialize};
use serde_json::Value;

/// ```text
/// v_h = v + h/2 M^-1 (f(t, q, v_h) - G(q)^T lambda),   q_1 = q + h v_h,   phi(q_1) = 0
/// v_1 = v_h + h/2 M^-1 (f(t_1, q_1, v_h) - G(q_1)^T mu),   G(q_1) v_1 + phi_t = 0
/// ```
///
/// Source: Andersen, J. Comput. Phys. 52 (1983) 24-34; Jay, SIAM J. Numer. Anal. 33 (1996) 368-387, for forces that
/// depend on v, which are implicit in the first half and explicit in the second, so that the step stays symmetric.
/// Order 2 in q, v and lambda; symmetric, and symplectic without such forces. For constant M and q' = v. One
/// factorization a step; the first half is iterated to round-off, one evaluation of f and one of phi an iteration. The
/// work is integrated by the trapezoidal rule. Fixed steps; cubic Hermite interpolation.
pub const ENTRY: IntegratorEntry = IntegratorEntry {
    solves: takes::position_rows,
    stability: Some(|| Stability::Leapfrog),
    ..IntegratorEntry::new("rattle", "symmetric, symplectic, for constant M; holds phi and phi', fixed steps", 2, make)
};

fn make(setup: &Setup) -> Result<Box<dyn Integrator>> {
    let n = setup.system.dimensions();
    let zeros = |n: usize| vec![0.0; n];
    if n.q_without_turns() != n.moving() {
        return Err(Error::input(
            "rattle cannot integrate coordinates whose rates are not the velocities, q' = N(q) v",
        )
        .hint("this mechanism turns in space; use phem56 with index2, or dop853"));
    }
    Ok(Box::new(Rattle {
        mass: None,
        is_ahead: false,
        is_ready: false,
        half: zeros(n.v),
        q: zeros(n.q),
        f: zeros(n.v),
        dv: zeros(n.v),
        rows: zeros(n.lambda),
        slope: zeros(setup.len()),
        control: Control::new(2.0, 0.2, 5.0),
    }))
}

/// What steps pass on, as it is saved: the problem is evaluated at the state from which a run continues, as at the end
/// of a step.
#[derive(Serialize, Deserialize)]
struct RattleMemory {
    is_ready: bool,
    mass: Option<Vec<f64>>,
}

struct Rattle {
    /// M at the first state, to which all others are compared.
    mass: Option<Vec<f64>>,
    /// True if the terms and factors of the state at the end of the last attempt are in the problem, and true if that
    /// is the state from which the next step starts.
    is_ahead: bool,
    is_ready: bool,
    /// v_h
    half: Vec<f64>,
    q: Vec<f64>,
    /// The forces of the last iteration.
    f: Vec<f64>,
    dv: Vec<f64>,
    rows: Vec<f64>,
    /// y' at the new state.
    slope: Vec<f64>,
    control: Control,
}

/// Limits on changes over their stagnation tolerance.
const LIMITS: Limits = Limits {
    // The matrix has no K: the contraction is h^2 K/M.
    most: 100,
    tolerance: tolerances::ROUND_OFF_OF_STAGNATION,
    round_off: tolerances::ROUND_OFF_OF_STAGNATION,
    stagnation: 1.0,
    ..Limits::NONE
};

impl Rattle {
    /// Evaluates and factors M, G and f at the start, unless that was done at the end of the step before.
    fn start(&mut self, problem: &mut Problem, from: StepStart) -> Result<(), StepError> {
        let (q, v) = problem.split(from.y);
        let dynamics = &mut problem.dynamics;
        self.is_ahead = false;
        if !std::mem::take(&mut self.is_ready) {
            dynamics.evaluate(from.t, q, v, Need::DYNAMICS);
            dynamics.factor()?;
        }
        self.compare(&dynamics.terms.mass)?;
        self.f.copy_from_slice(&dynamics.terms.f);
        Ok(())
    }

    /// Refuses a mass matrix that changed by more than round-off.
    fn compare(&mut self, mass: &[f64]) -> Result<(), StepError> {
        let known = self.mass.get_or_insert_with(|| mass.to_vec());
        let largest = largest(known);
        let same = known.iter().zip(mass).all(|(known, m)| (known - m).abs() <= 1e-12 * largest);
        let reason = "rattle needs a constant mass matrix, and it changed";
        let hint = "use generalized_alpha, or phem56 with index2: they take any mass matrix";
        if same { Ok(()) } else { Err(StepError::Unsuitable { reason, hint }) }
    }

    /// v_h and q_1, starting with v + h/2 v' of the equations of motion: v_h differs from it by reactions, and by the
    /// dependence of f on v.
    fn first_half(&mut self, problem: &mut Problem, from: StepStart) -> Result<(), StepError> {
        let h = from.h;
        let (_, v) = problem.split(from.y);
        let (_, vdot) = problem.split(from.slope);
        for i in 0..v.len() {
            self.half[i] = v[i] + 0.5 * h * vdot[i];
        }
        let mut newton = Monitor::default();
        let converged = newton.solve(LIMITS, |_| {
            problem.dynamics.statistics.newton_iterations += 1;
            let change = self.iterate(problem, from)?;
            Ok::<_, StepError>(change / self.still(h))
        })?;
        problem.dynamics.statistics.stagnated += u64::from(converged && newton.has_stagnated);
        if converged { Ok(()) } else { Err(StepError::Singular(Singular::Apart)) }
    }

    /// Stagnation tolerance of the relative change of v_h: in tiny steps the round-off of phi over h dominates.
    fn still(&self, h: f64) -> f64 {
        let of_phi = 16.0 * f64::EPSILON * largest(&self.q) / h;
        // With ROUND_OFF_OF_STAGNATION this is 1e-16 of v.
        f64::max(1e-9, of_phi / largest(&self.half))
    }

    /// One correction of v_h for the forces and for phi(q_1). Returns its size relative to v_h.
    fn iterate(&mut self, problem: &mut Problem, from: StepStart) -> Result<f64, StepError> {
        let (q, _) = problem.split(from.y);
        let h = from.h;
        let dynamics = &mut problem.dynamics;
        dynamics.evaluate(from.t, q, &self.half, Need::FORCE);
        for (i, f) in dynamics.terms.f.iter().enumerate() {
            self.dv[i] = 0.5 * h * (f - self.f[i]);
        }
        self.f.copy_from_slice(&dynamics.terms.f);
        self.advance(dynamics.system, q, h);
        dynamics.evaluate(from.end, &self.q, &self.half, Need::CONSTRAINTS);
        self.rows.iter_mut().zip(&dynamics.terms.phi).for_each(|(row, phi)| *row = -phi / h);
        dynamics.kkt.solve(&mut self.dv, &mut self.rows)?;
        add(&mut self.half, &self.dv);
        self.advance(dynamics.system, q, h);
        Ok(relative(&self.dv, &self.half))
    }

    /// q_1 = q + h v_h; angles in space at the rate that follows from v_h.
    fn advance(&mut self, system: &dyn MechanicalSystem, q: &[f64], h: f64) {
        let rate = &mut self.slope[..q.len()];
        system.rate(q, &self.half, rate);
        for (next, (q, rate)) in self.q.iter_mut().zip(q.iter().zip(rate)) {
            *next = q + h * *rate;
        }
    }

    /// v_1, and y' there, with the factors at q_1.
    fn second_half(&mut self, problem: &mut Problem, from: StepStart, to: &mut [f64]) -> Result<(), StepError> {
        let StepStart { h, end: t, .. } = from;
        let (q, v) = problem.split_mut(to);
        q.copy_from_slice(&self.q);
        let dynamics = &mut problem.dynamics;
        dynamics.evaluate(t, q, &self.half, Need::DYNAMICS);
        dynamics.factor()?;
        self.compare(&dynamics.terms.mass)?;
        for (dv, f) in self.dv.iter_mut().zip(&dynamics.terms.f) {
            *dv = 0.5 * h * f;
        }
        self.rows.iter_mut().zip(&dynamics.terms.phi_dot).for_each(|(row, phi_dot)| *row = -phi_dot);
        dynamics.kkt.solve(&mut self.dv, &mut self.rows)?;
        for (v, (half, dv)) in v.iter_mut().zip(self.half.iter().zip(&self.dv)) {
            *v = half + dv;
        }
        // Near a singular state y' is truncated, and these factors are not.
        self.is_ahead = dynamics.kkt.is_regular(dynamics.rank_tolerance);
        if self.is_ahead {
            problem.derivative_at_velocity(t, to, &mut self.slope)
        } else {
            problem.derivative(t, to, &mut self.slope)
        }
    }
}

impl Integrator for Rattle {
    fn control(&mut self) -> &mut Control {
        &mut self.control
    }

    fn attempt(&mut self, problem: &mut Problem, from: StepStart, to: &mut [f64]) -> Result<Option<f64>, StepError> {
        self.start(problem, from)?;
        self.first_half(problem, from)?;
        self.second_half(problem, from, to)?;
        let n = problem.dynamics.system.dimensions();
        trapezoid(from, &self.slope[n.q + n.v..], to);
        Ok(None)
    }

    fn last_slope(&self) -> Option<&[f64]> {
        Some(&self.slope)
    }

    fn restart(&mut self) {
        (self.is_ahead, self.is_ready) = (false, false);
    }

    fn accepted(&mut self, step: &Accepted) -> f64 {
        self.is_ready = self.is_ahead && !step.is_moved;
        step.h
    }

    fn memory(&self) -> Option<Value> {
        written(RattleMemory { is_ready: self.is_ready, mass: self.mass.clone() })
    }

    fn recall(&mut self, memory: &Value) {
        if let Some(RattleMemory { is_ready, mass }) = read(memory) {
            self.is_ready = is_ready;
            self.mass = mass;
        }
    }
}
