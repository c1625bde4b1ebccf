//! Step sizes: the norm of the error and the controller.

use super::{Accepted, Problem};
use crate::formulation::StepError;
use crate::math::largest;
use crate::system::MechanicalSystem;
use crate::tolerances;
use serde::{Deserialize, Serialize};
use std::ops::Range;

/// Steps are not controlled more tightly than this unless that is asked for. Unit: `[1]`. Why: Newton's methods, which
/// go two digits further, and projections near singular states come near round-off. Test:
/// `steps_are_never_looser_than_asked_nor_tighter_than_round_off`.
const CONTROLLED_RTOL: f64 = 1e-11;

/// Divisions by ten of a guess of the first step at most, where y' has no value ahead.
const FIRST_STEP_SHORTER: usize = 20;

/// Tolerated local error of component y: atol + rtol |y|, with one atol for metres, radians and their rates, and y
/// measured from the origin: a mechanism of micrometres needs a smaller atol in proportion, one far from the origin
/// should be moved nearer. Angles that count full turns are not tested: they are reset to the angles of the other
/// coordinates, and a mere observation must not change the steps.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tolerance {
    /// Relative tolerance.
    pub rtol: f64,
    /// Absolute tolerance.
    pub atol: f64,
    /// First place in y of the angles that count full turns, and the one after the last.
    turning: [usize; 2],
    /// Number of components of y before the work, which is not tested.
    motion: usize,
}

impl Tolerance {
    /// Tolerances for the states of a system.
    pub fn new(rtol: f64, atol: f64, system: &dyn MechanicalSystem) -> Self {
        let n = system.dimensions();
        Tolerance { rtol, atol, turning: [n.q_without_turns(), n.q], motion: n.q + n.v }
    }

    /// Tolerated error between two states.
    #[inline]
    pub fn weight(&self, from: f64, to: f64) -> f64 {
        self.atol + self.rtol * from.abs().max(to.abs())
    }

    /// Root mean square of `change` over the tolerated errors at `y`. The last components, of the work, are not tested.
    pub fn norm(&self, y: &[f64], change: &[f64]) -> f64 {
        self.norm_between(y, y, change)
    }

    /// Root mean square of `change` over the tolerated errors of a step.
    pub fn norm_between(&self, from: &[f64], to: &[f64], change: &[f64]) -> f64 {
        let n = self.motion;
        (self.squares(n, from, to, change) / self.tested(n) as f64).sqrt()
    }

    /// Other tolerances for the same components.
    pub fn with(&self, rtol: f64, atol: f64) -> Self {
        Tolerance { rtol, atol, ..*self }
    }

    /// Round-off of sums, for the iterations of fixed steps at coordinates `q`.
    pub(super) fn exact(q: &[f64], system: &dyn MechanicalSystem) -> Self {
        let size = Some(largest(system.dimensions().without_turns(q)))
            .filter(|size| *size > 0.0)
            .map_or(1.0, |size| size.clamp(tolerances::ATOM, 1.0));
        Tolerance::new(tolerances::ROUND_OFF_OF_SUMS, tolerances::ROUND_OFF_OF_SUMS * size, system)
    }

    /// Number of components of y before the work.
    pub fn motion(&self) -> usize {
        self.motion
    }

    /// Range in y of the angles that count full turns.
    pub fn untested(&self) -> Range<usize> {
        self.turning[0]..self.turning[1]
    }

    /// Number of tested components among the first n.
    pub fn tested(&self, n: usize) -> usize {
        n - self.untested().len()
    }

    /// Sum of the squares of `error` over the tolerated errors of a step, for the tested ones among the first n
    /// components; in four sums so that it vectorizes.
    pub fn squares(&self, n: usize, from: &[f64], to: &[f64], error: &[f64]) -> f64 {
        let Range { start, end } = self.untested();
        let mut sums = [0.0; 4];
        for tested in [0..start, end..n] {
            let from = from[tested.clone()].as_chunks::<4>();
            let to = to[tested.clone()].as_chunks::<4>();
            let error = error[tested.clone()].as_chunks::<4>();
            for ((from, to), error) in from.0.iter().zip(to.0).zip(error.0) {
                (0..4).for_each(|i| sums[i] += (error[i] / self.weight(from[i], to[i])).powi(2));
            }
            for (i, error) in error.1.iter().enumerate() {
                sums[i] += (error / self.weight(from.1[i], to.1[i])).powi(2);
            }
        }
        sums.iter().sum()
    }
}

/// Tolerance of the steps as a function of that asked of the motion: factor asked^power. Where the error of a step is
/// that of the solution, O(h^(p+1)), the error of the motion has its power p/(p+1), which the power (p + 1)/p
/// compensates; with local extrapolation it is a multiple of it. Source: Shampine, SIAM J. Numer. Anal. 12 (1975) on
/// error per step and per unit step. The factors are measured: medians over the shipped scenes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tightening {
    /// Factor c in c rtol^power.
    pub factor: f64,
    /// Exponent of the tolerance.
    pub power: f64,
    /// The least rtol of steps, unless a smaller one is asked.
    pub least: f64,
}

impl Tightening {
    /// The tolerance as it is: steps are fixed, or the error of the motion is no more than that of one step.
    pub const NONE: Self = Tightening::new(1.0, 1.0);

    /// The tolerance factor asked^power, not below the accuracy of Newton's method.
    pub const fn new(factor: f64, power: f64) -> Self {
        Tightening { factor, power, least: CONTROLLED_RTOL }
    }

    /// The tolerance of steps: at most `asked`, and not below `least`.
    pub fn of_steps(self, asked: &Tolerance) -> Tolerance {
        let rtol = (self.factor * asked.rtol.powf(self.power)).max(self.least).min(asked.rtol);
        asked.with(rtol, asked.atol * rtol / asked.rtol)
    }

    /// The rtol of the motion that the tolerance of the steps achieves: above `asked` where that of the steps is at its
    /// lower bound.
    pub fn reached(self, asked: &Tolerance) -> f64 {
        (self.of_steps(asked).rtol / self.factor).powf(1.0 / self.power)
    }
}

/// h_new = h safety err^-expo within [shrink, grow] h, which aims at an error below the tolerated one at once. Where the
/// error is near that, h_new = h safety err^(-expo/2): with half the gain errors that rise and fall with an oscillation
/// do not swing the steps, of which many would be refused. Source: on the gain, Soederlind, ACM TOMS 29 (2003) 1-26.
/// Predictive, for implicit methods: the whole gain, but not more than h_new = h safety (h/h_old)
/// (err_old/err^2)^expo. Source: Hairer, Wanner II, IV.8 (8.25), after Gustafsson.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Control {
    /// Order of the solution at a start, by which a first step is chosen.
    pub order: usize,
    /// expo, on the error of the step.
    pub exponent: f64,
    /// Least h_new/h.
    pub shrink: f64,
    /// Greatest h_new/h.
    pub grow: f64,
    /// Safety factor on the optimal step.
    pub safety: f64,
    /// h_new/h after a step that failed without an error.
    pub retry: f64,
    /// The longest part of a step between two evaluations of the equations.
    pub spacing: f64,
    /// Fraction of a step at the middle of the widest gap between the points at which the equations are evaluated off
    /// the constraints; `None` for a method without such points, or one that needs steps of equal size.
    pub gap: Option<f64>,
    gain: Gain,
    /// Size and error of the last accepted step, for the controls that know it.
    before: Option<(f64, f64)>,
}

/// How the next step follows from the error of one.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
enum Gain {
    /// By half the gain near the tolerated error.
    Half,
    /// By the whole gain and, to this power, the error of the step before: h_new = h safety err^-expo err_old^beta.
    Proportional(f64),
    /// By the whole gain, but not beyond what the trend of the errors predicts.
    Predictive,
}

impl Control {
    /// The exponent is 1/order, of the solution where the estimate is of one less.
    pub fn new(order: f64, shrink: f64, grow: f64) -> Self {
        Control {
            order: order as usize,
            exponent: 1.0 / order,
            shrink,
            grow,
            safety: 0.9,
            retry: 0.25,
            spacing: 1.0,
            gap: None,
            gain: Gain::Half,
            before: None,
        }
    }

    /// Predictive control for an error estimate of this order.
    pub fn predictive(order: f64, shrink: f64, grow: f64) -> Self {
        Control { gain: Gain::Predictive, ..Control::new(order, shrink, grow) }
    }

    /// Control by the last two errors: exponent 1/order - 0.75 beta, after the codes DOPRI5 and DOP853.
    pub fn proportional(order: f64, beta: f64, shrink: f64, grow: f64) -> Self {
        let control = Control::new(order, shrink, grow);
        Control { exponent: control.exponent - 0.75 * beta, gain: Gain::Proportional(beta), ..control }
    }

    /// The step after an accepted one, as large where that has no error estimate.
    pub fn after(&mut self, step: &Accepted) -> f64 {
        step.error.map_or(step.h, |error| self.accept(step.h, error, step.growing))
    }

    /// The next step after one of size `h` with error `error`; `growing` is false right after a rejection.
    pub fn accept(&mut self, h: f64, error: f64, growing: bool) -> f64 {
        let whole = error.max(1e-16).powf(-self.exponent);
        let aim = match self.gain {
            Gain::Half => damped(whole, self.exponent),
            Gain::Proportional(beta) => whole * self.last(h, error).powf(beta),
            Gain::Predictive => whole.min(self.predicted(h, error)),
        };
        h * (self.safety * aim).clamp(self.shrink, if growing { self.grow } else { 1.0 })
    }

    /// Error of the step before.
    fn last(&mut self, h: f64, error: f64) -> f64 {
        self.before.replace((h, error.max(1e-4))).map_or(1e-4, |(_, old)| old)
    }

    /// (h/h_old) (err_old/err^2)^expo.
    fn predicted(&mut self, h: f64, error: f64) -> f64 {
        // An error below 1e-2 is a poor measure of its trend.
        let error = error.max(1e-2);
        let before = self.before.replace((h, error));
        before.map_or(f64::INFINITY, |(size, old)| h / size * (old / (error * error)).powf(self.exponent))
    }

    /// The step to try again after the error was too large.
    pub fn reject(&self, h: f64, error: f64) -> f64 {
        h * (self.safety * error.powf(-self.exponent)).clamp(self.shrink, 1.0)
    }
}

/// Growth by half the gain where that of the whole one, err^-expo, is near 1, and by all of it beyond.
fn damped(whole: f64, exponent: f64) -> f64 {
    // StepStart there steps double and more, as at a start. With 1e-3 evaluations are as many, with 0.1 a tenth more.
    whole.sqrt().max(whole * 0.01f64.powf(0.5 * exponent))
}

/// Round-off of changes of y, over the tolerated errors; with `divisor`, s, where v is found from q by a division by
/// it: from phi = 0, or from forces so stiff that q follows them within the step. Other v are rounded by their own
/// size. `change` is scratch.
pub(super) fn round_off(
    problem: &Problem,
    tolerance: &Tolerance,
    y: &[f64],
    divisor: Option<f64>,
    change: &mut [f64],
) -> f64 {
    let (q, v) = problem.split(y);
    // Angles that count full turns grow, and only they are rounded to that size.
    let system = problem.dynamics.system;
    let (moving, states) = v.split_at(system.dimensions().moving());
    let of_q = tolerances::ROUND_OFF * largest(system.dimensions().without_turns(q));
    let of_v = tolerances::ROUND_OFF * largest(moving);
    let of_states = tolerances::ROUND_OFF * largest(states);
    change[..q.len()].fill(of_q);
    change[q.len()..].fill(divisor.map_or(of_v, |h| of_v.max(of_q / h)));
    change[q.len() + moving.len()..].fill(of_states);
    tolerance.norm(y, change)
}

/// A first step from the sizes of y, y' and y''. Source: Hairer, Norsett, Wanner, II.4, with one extra evaluation.
pub fn first_step(
    problem: &mut Problem,
    tolerance: &Tolerance,
    t: f64,
    span: f64,
    y: &[f64],
    slope: &[f64],
    order: usize,
) -> Result<f64, StepError> {
    let d0 = tolerance.norm(y, y);
    let d1 = tolerance.norm(y, slope);
    let guess = if d0 < 1e-10 || d1 < 1e-10 { 1e-6 } else { 0.01 * d0 / d1 };
    // As in IDA: at rest y' sets no time of its own, and a load that rises there is seen early, if at all.
    let mut guess = guess.min(tolerances::UNSEEN * span);
    let mut next = vec![0.0; y.len()];
    for shorter in 0..=FIRST_STEP_SHORTER {
        let ahead: Vec<f64> = y.iter().zip(slope).map(|(y, slope)| y + guess * slope).collect();
        match problem.derivative(t + guess, &ahead, &mut next) {
            Ok(()) => break,
            Err(halt) if halt.is_fatal() || shorter == FIRST_STEP_SHORTER => return Err(halt),
            Err(_) => guess *= 0.1,
        }
    }
    let change: Vec<f64> = next.iter().zip(slope).map(|(next, slope)| next - slope).collect();
    let d2 = tolerance.norm(y, &change) / guess;
    let largest = d1.max(d2);
    let step = if largest <= 1e-15 { (guess * 1e-3).max(1e-6) } else { (0.01 / largest).powf(1.0 / order as f64) };
    Ok(step.min(100.0 * guess).min(span))
}
