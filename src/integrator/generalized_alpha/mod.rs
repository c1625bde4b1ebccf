//! Generalized-alpha on the index 3 equations, and on stabilized index 2.

mod motion;
mod newton;
mod prediction;

use super::memory::{read, written};
use super::newton_matrix;
use super::sums::trapezoid;
use super::{
    Accepted, Control, Integrator, IntegratorEntry, Problem, Setup, StepStart, Steps, Tightening, no_memory, refuses,
    takes,
};
use crate::error::{Error, Result};
use crate::formulation::StepError;
use crate::method_spec::OptionDoc;
use motion::{Scheme, StepMotion};
use newton::Newton;
use serde::{Deserialize, Serialize};
use serde_json::Value;

/// The largest rotation of a body in a controlled step of generalized_alpha. Unit: `[rad]`. Why: Newton's method
/// converges, and no half revolution is missed. Test: `steady_motions_are_as_accurate_as_asked`.
const GENERALIZED_ALPHA_TURN: f64 = 1.0;

/// ```text
/// q_1 = q + h v + h^2 ((1/2 - beta) a + beta a_1) + u,   v_1 = v + h ((1 - gamma) a + gamma a_1) + w
/// (1 - alpha_m) a_1 + alpha_m a = (1 - alpha_f) v'_1 + alpha_f v',   M v'_1 + G^T lambda_1 = f
/// alpha_m = (2 r - 1)/(r + 1),  alpha_f = r/(r + 1),  gamma = 1/2 + alpha_f - alpha_m,  beta = (gamma + 1/2)^2/4
/// ```
///
/// with the rows and the shifts u and w of the formulation's `Dae`, r = rho_inf, the damping at infinite frequency.
/// Source: Chung, Hulbert, J. Appl. Mech. 60 (1993) 371-375; Arnold, Bruels, Multibody Syst. Dyn. 18 (2007) 185-202;
/// stabilized index 2: Arnold, Bruels, Cardona, Numer. Math. 129 (2015) 149-179. Rotations advance along the group, q
/// exp(Dq), which is exact about a fixed axis; with ggl in two factors, one for the change that was predicted and one
/// for the rest, so that Newton's method sees small rotations only and steps of a radian converge. (That moves q by
/// O(h^4), which the phi of index3 would amplify by h^-2.) Order 2 in q, v and lambda; implicit, for stiff motions.
///
/// With rho_inf = 1 nothing is damped, which ggl allows. With index3 the multipliers have the eigenvalue -rho_inf
/// three times, which a rotating G separates, the more the larger the step: with too little damping errors grow
/// (Cardona, Geradin, Comput. Struct. 33 (1989) 801-820), so rho_inf above 0.9 is refused there. phi vanishes to
/// round-off. With index3 G v + phi_t vanishes to order 2 (project it where that matters: `velocity`, `manifold`,
/// `exact`; `full` would distribute that error between v and q at every step, which costs q an order, so it is
/// refused); with ggl to round-off too.
///
/// Error of a step: (1/6 - beta - (alpha_m - alpha_f)/2) h^2 (a_1 - a) + h^3/12 [v, v'] in q, the leading terms, and
/// that of h^3 xi''' in states; v and lambda, index 2 and 3, are not tested. Source: Geradin, Cardona, Flexible
/// Multibody Dynamics (2001), chapter 7. A step turns no body in space by more than a radian, since at a steady
/// rotation these errors are zero, however large the rotation. When the step changes, a = v'(t + (alpha_m - alpha_f) h) is moved with it: Jay, Negrut, ECCOMAS Multibody
/// Dynamics (2009) 143-158. One matrix, from exact K and C, is kept while Newton's method converges with it; an
/// evaluation and a back-substitution (with ggl two) per iteration. The work is integrated by the trapezoidal rule.
/// Cubic Hermite interpolation.
pub const ENTRY: IntegratorEntry = IntegratorEntry {
    steps: Steps::Either,
    // Errors over a motion were 10 rtol^(2/3), 70 for lasting oscillations, whose v is not in the estimate.
    tightening: Tightening::new(0.01, 1.5),
    solves: takes::positions,
    refuses: refuses::shared_error,
    options: &[OptionDoc {
        name: "rho_inf",
        about: "what is left of infinitely fast oscillations a step, 0 to 1 (default 0.8)",
    }],
    ..IntegratorEntry::new(
        "generalized_alpha",
        "implicit, damped at high frequencies by rho_inf, for stiff motions; holds phi, with ggl phi' too",
        2,
        make,
    )
};

fn make(setup: &Setup) -> Result<Box<dyn Integrator>> {
    let r = setup.integrator.not_negative("rho_inf", 0.8)?;
    if r > 1.0 {
        return Err(Error::input(format!("generalized_alpha: rho_inf is {r}")).hint("give a number from 0 to 1"));
    }
    let dae = setup.dae()?;
    // With 0.98 the energy of a pendulum grows a million times in steps of a hundredth of its period.
    if r > 0.9 && dae.velocity_index() == 2 {
        let name = &setup.formulation.name;
        let what = format!("generalized_alpha: with rho_inf = {r} the multipliers of {name} swing up without bound");
        return Err(Error::input(what).hint("give 0.9 or less, or use the formulation ggl"));
    }
    let scheme = Scheme::new(r);
    let newton = Newton::new(dae, scheme, setup.is_fixed, setup.system).ok_or_else(no_memory)?;
    let n = setup.system.dimensions();
    let mut control = Control::proportional(3.0, 0.13, 0.2, 2.0);
    control.order = 2;
    Ok(Box::new(GeneralizedAlpha {
        motion: StepMotion::new(scheme, setup.system, &dae),
        newton,
        error: vec![0.0; n.q],
        control,
    }))
}

/// What steps pass on, as it is saved.
#[derive(Serialize, Deserialize)]
struct GeneralizedAlphaMemory {
    control: Control,
    motion: motion::MotionMemory,
    newton: newton_matrix::Memory,
}

struct GeneralizedAlpha {
    motion: StepMotion,
    newton: Newton,
    /// n_q
    error: Vec<f64>,
    control: Control,
}

impl GeneralizedAlpha {
    /// Root mean square of the errors of q and xi in units of the tolerance; above one where a rotation is too large.
    fn error(&mut self, problem: &Problem, from: StepStart, to: &[f64]) -> f64 {
        let StepStart { h, tolerance, .. } = from;
        let (q, v) = problem.split(to);
        let n = problem.dynamics.system.dimensions();
        problem.dynamics.system.rate(q, self.motion.local_error(problem, from), &mut self.error);
        let sum = tolerance.squares(q.len(), from.y, q, &self.error);
        let of_state = |i: usize| self.motion.state_error(i, h) / tolerance.weight(from.y[q.len() + i], v[i]);
        let of_states: f64 = (n.moving()..n.v).map(|i| of_state(i).powi(2)).sum();
        let error = ((sum + of_states) / (tolerance.tested(q.len()) + n.states) as f64).sqrt();
        error.max((self.motion.turned() / GENERALIZED_ALPHA_TURN).powi(3))
    }
}

impl Integrator for GeneralizedAlpha {
    fn control(&mut self) -> &mut Control {
        &mut self.control
    }

    fn attempt(&mut self, problem: &mut Problem, from: StepStart, to: &mut [f64]) -> Result<Option<f64>, StepError> {
        self.motion.begin(problem, from, to)?;
        let mut found = self.newton.converge(problem, &mut self.motion, from, to);
        let is_first_guess = self.newton.is_stale || self.motion.is_extrapolated();
        if is_first_guess && found.as_ref().is_err_and(|halt| !halt.is_fatal()) {
            self.newton.matrix.forget();
            self.motion.forget_past();
            self.motion.begin(problem, from, to)?;
            found = self.newton.converge(problem, &mut self.motion, from, to);
        }
        found?;
        // Uses the powers at the new state as computed, since the work needs order 2 only.
        trapezoid(from, self.newton.powers(), to);
        Ok(Some(self.error(problem, from, to)))
    }

    fn accepted(&mut self, step: &Accepted) -> f64 {
        self.motion.accepted();
        self.newton.accepted();
        self.control.after(step)
    }

    fn memory(&self) -> Option<Value> {
        let GeneralizedAlpha { control, motion, newton, .. } = self;
        written(GeneralizedAlphaMemory { control: *control, motion: motion.memory(), newton: newton.matrix.memory() })
    }

    fn recall(&mut self, memory: &Value) {
        if let Some(GeneralizedAlphaMemory { control, motion, newton }) = read(memory) {
            self.control = control;
            self.motion.recall(&motion);
            self.newton.matrix.recall(newton);
        }
    }

    fn restart(&mut self) {
        self.motion.restart();
        self.newton.matrix.forget();
    }
}
