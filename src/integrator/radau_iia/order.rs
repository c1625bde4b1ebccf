//! Choice of the number of stages during the integration.

use super::collocation::Collocation;
use crate::error::{Error, Result};
use crate::integrator::explicit::widest_gap;
use crate::integrator::{Control, Tolerance};
use crate::math::newton::Monitor;
use crate::method_spec::MethodSpec;
use crate::tolerances;
use serde::{Deserialize, Serialize};

/// Contraction of Newton's method that a larger step may come to. Unit: `[1]`. Test: `no_more_work_than_other_codes`.
const RADAU_SLOW: f64 = 0.4;

/// The methods with 3, 5 and 7 stages, and the one in use.
///
/// The error of s - 2 stages is estimated from the stages of a step, that of s + 2 by the same ratio again; from it
/// follows the step size of each method, and the method with the least work per second is chosen.
pub struct Order {
    pub methods: Vec<Collocation>,
    pub choice: Choice,
}

/// What the choice passes on from step to step.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Choice {
    /// Index of the method in use.
    current: usize,
    pub control: Control,
    /// Accepted steps since the last change.
    steady: usize,
    last_fall: Option<f64>,
}

/// Measures of an accepted step.
pub struct StepMeasures {
    /// Error in units of the internal tolerance.
    pub error: f64,
    /// What the error of two stages less would be with the same real eigenvalue; 0 where the number is fixed.
    pub lower: f64,
    /// Contraction of the Newton iteration.
    pub theta: f64,
}

const STAGES: [usize; 3] = [3, 5, 7];

impl Order {
    pub fn new(spec: &MethodSpec, is_fixed: bool) -> Result<Self> {
        let stages = match spec.text("order") {
            None if is_fixed => vec![3],
            None => STAGES.to_vec(),
            Some(text) => {
                let found = STAGES.into_iter().find(|s| text.parse() == Ok(2 * s - 1));
                vec![found.ok_or_else(|| {
                    Error::input(format!("radau_iia: order is `{text}`")).hint("give order=5, order=9 or order=13")
                })?]
            }
        };
        let methods = stages.into_iter().map(Collocation::new).collect();
        let control = Control::predictive(4.0, 0.125, tolerances::RADAU_GROWTH);
        let mut order = Order { methods, choice: Choice { current: 0, control, steady: 0, last_fall: None } };
        order.set(0);
        Ok(order)
    }

    /// Restores a [`choice`](Self::choice).
    pub fn recall(&mut self, choice: Choice) {
        let current = choice.current.min(self.methods.len() - 1);
        self.choice = Choice { current, ..choice };
    }

    pub fn method(&self) -> &Collocation {
        &self.methods[self.choice.current]
    }

    /// Index of the method in use.
    pub fn current(&self) -> usize {
        self.choice.current
    }

    fn set(&mut self, index: usize) {
        let method = &self.methods[index];
        let control = &mut self.choice.control;
        control.order = method.stages();
        control.exponent = 1.0 / (method.stages() as f64 + 1.0);
        control.spacing = widest_gap(&method.nodes).0;
        self.choice = Choice { current: index, control: *control, steady: 0, last_fall: None };
    }

    /// Chooses the method of the next step, for the user's tolerance.
    pub fn accepted(&mut self, tolerance: &Tolerance, seen: &StepMeasures) {
        self.choice.steady += 1;
        let own = if seen.lower > 0.0 { seen.error / seen.lower } else { 0.0 };
        let fall = (own * self.choice.last_fall.unwrap_or(own)).sqrt();
        self.choice.last_fall = Some(own);
        // Steps at one order come first, and a change must be worth the new matrices.
        if self.choice.steady < 4 {
            return;
        }
        let (best, gain) = self.neighbours().fold((self.current(), 1.0), |best, index| {
            let gain = self.gain(index, tolerance, seen, fall);
            if gain > best.1 { (index, gain) } else { best }
        });
        if best != self.current() && gain > 1.2 {
            self.set(best);
        }
    }

    fn neighbours(&self) -> impl Iterator<Item = usize> + use<> {
        let current = self.current();
        let count = self.methods.len();
        [current.checked_sub(1), Some(current + 1)].into_iter().flatten().filter(move |index| *index < count)
    }

    /// Time stepped over per unit of work, relative to the method in use, where two stages more make the error `fall`
    /// times as large.
    fn gain(&self, index: usize, tolerance: &Tolerance, seen: &StepMeasures, fall: f64) -> f64 {
        let [before, after] = [self.method(), &self.methods[index]];
        let old = before.stages();
        let new = after.stages();
        let scale =
            internal(tolerance, old).rtol / internal(tolerance, new).rtol * after.real.value / before.real.value;
        let fall = if new > old { fall } else { 1.0 / fall.max(f64::MIN_POSITIVE) };
        let error = (seen.error * scale * fall).max(1e-16);
        let step = |error: f64, s: usize| error.powf(-1.0 / (s as f64 + 1.0));
        let ratio = step(error, new) / step(seen.error.max(1e-16), old);
        // A larger step contracts less.
        let ratio = if new > old { ratio.min(RADAU_SLOW / seen.theta) } else { ratio };
        ratio * old as f64 / new as f64
    }

    /// Limits the next step: shorter where Newton's method took many of its `most` corrections, and no longer than
    /// where it would contract too slowly, as theta grows like h, or turn too far after one with rotation vectors up to
    /// `turned`.
    pub fn limit(&mut self, newton: &Monitor, most: usize, turned: f64) {
        let most = most as f64;
        let iterations = newton.iterations as f64;
        self.choice.control.safety = 0.9 * (2.0 * most + 1.0) / (2.0 * most + iterations);
        self.choice.control.grow = farthest(newton.rate, turned).clamp(1.0, tolerances::RADAU_GROWTH);
    }

    /// Sets how much shorter a step is tried again that Newton's method did not solve: so that it would contract well
    /// enough and not turn too far; as short as it may be where the residual has no value, or nothing is known.
    pub fn retry(&mut self, newton: &Monitor, has_value: bool, turned: f64) {
        // Contraction tells the length within, but its first rates are rough.
        let [shortest, longest] = [0.25, 0.8];
        let is_known = has_value && newton.iterations > 1 && !newton.rate.is_nan();
        let shorter = if is_known { farthest(newton.rate, turned) } else { shortest };
        self.choice.control.retry = shorter.clamp(shortest, longest);
    }
}

/// The longest next step over the present one, which contracts with `rate` and has rotation vectors up to `turned`.
fn farthest(rate: f64, turned: f64) -> f64 {
    (RADAU_SLOW / rate).min(0.9 * tolerances::RADAU_TURN / turned)
}

/// Tolerance for the error estimate of order s + 1 at which the solution, of order 2 s, meets the given one.
/// Source: the code RADAU5 of Hairer and Wanner.
pub fn internal(tolerance: &Tolerance, s: usize) -> Tolerance {
    let s = s as f64;
    let rtol = 0.1 * tolerance.rtol.powf((s + 1.0) / (2.0 * s));
    tolerance.with(rtol, rtol * tolerance.atol / tolerance.rtol)
}
