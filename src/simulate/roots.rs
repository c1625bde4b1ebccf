//! Roots: a run pauses where a function of its sink changes sign.
//!
//! The function is read at parts of each step. A change of sign between two of them is located on the dense output, and
//! the step is taken again so that it ends there.

use super::{Sink, TimeLoop};
use crate::formulation::StepError;
use crate::integrator::{Step, StepStart};
use crate::tolerances;

/// Parts of a step between which the sign is compared: in a third of an oscillation a function may dip below zero and
/// return.
const PARTS: [f64; 4] = [0.25, 0.5, 0.75, 1.0];

/// The place at which the sign is read first. Unit: `[steps]`. Why: a run that goes on from a root is on neither side.
/// Test: `a_run_goes_on_from_root_to_root`.
const FIRST_LOOK: f64 = 1e-6;

/// The root that a run looks for.
#[derive(Clone, Copy, Debug, Default)]
pub struct Roots {
    /// Value at the start of the next step, where it is known.
    start: Option<f64>,
    /// Value at the end of the step just tried.
    end: f64,
    /// True if the step just tried ends at a root.
    is_at_end: bool,
    /// Time of the root at which the run pauses, s.
    pub passed: Option<f64>,
}

/// The first root in a step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Root {
    /// At the start of the step.
    AtStart,
    /// At this fraction of the step.
    Within(f64),
}

/// A fraction of a step, and the value there.
type RootSample = (f64, f64);

impl Roots {
    /// The step just tried is accepted and ends at `t`.
    pub fn accept(&mut self, t: f64) {
        self.start = Some(self.end);
        if std::mem::take(&mut self.is_at_end) {
            self.passed = Some(t);
        }
    }
}

impl TimeLoop<'_> {
    /// The first root in the step of size `h` to `end`; none where that is its end.
    pub fn root_within(&mut self, h: f64, end: f64, sink: &mut dyn Sink) -> Result<Option<Root>, StepError> {
        self.roots.is_at_end = false;
        if !sink.watches_root() {
            return Ok(None);
        }
        self.rows.problem.begin_step(self.t, &self.y)?;
        let step = Step {
            from: StepStart { t: self.t, y: &self.y, slope: &self.slope, h, end, tolerance: &self.tolerance },
            to: &self.next,
            slope: &self.next_slope,
        };
        self.integrator.prepare(&mut self.rows.problem, step)?;
        let rows = &mut self.rows;
        let integrator = &mut self.integrator;
        let mut look = |theta: f64| {
            if theta < 1.0 {
                integrator.interpolate(&mut rows.problem, step, theta, &mut rows.y)?;
            } else {
                rows.y.copy_from_slice(step.to);
            }
            rows.root(if theta < 1.0 { step.from.t + theta * h } else { end }, sink)
        };
        let start = match self.roots.start {
            Some(start) => start,
            None => look(FIRST_LOOK)?,
        };
        self.roots.start = Some(start);
        let Some(bracket) = first_change((0.0, start), &mut self.roots.end, &mut look)? else { return Ok(None) };
        let theta = located(bracket, &mut look)?;
        let no_time =
            (tolerances::ROUND_OFF_OF_FACTORS * (self.span.end - self.span.start)).max(f64::EPSILON * end.abs());
        let is_at_start = theta * h <= no_time;
        self.roots.is_at_end = (1.0 - theta) * h <= no_time.max(tolerances::ROUND_OFF_OF_SOLUTIONS * h) && !is_at_start;
        Ok(match theta {
            _ if is_at_start => Some(Root::AtStart),
            _ if self.roots.is_at_end => None,
            theta => Some(Root::Within(theta)),
        })
    }
}

/// The two looks between which the sign changes first, and the value at the end of the step where it never does.
fn first_change(
    mut low: RootSample,
    at_end: &mut f64,
    look: &mut impl FnMut(f64) -> Result<f64, StepError>,
) -> Result<Option<[RootSample; 2]>, StepError> {
    for theta in PARTS {
        let value = look(theta)?;
        if low.1 * value <= 0.0 && low.1 != 0.0 {
            *at_end = value;
            return Ok(Some([low, (theta, value)]));
        }
        low = (theta, value);
    }
    *at_end = low.1;
    Ok(None)
}

/// The place of the change of sign, by the regula falsi with halved weights (Illinois).
fn located(bracket: [RootSample; 2], look: &mut impl FnMut(f64) -> Result<f64, StepError>) -> Result<f64, StepError> {
    let [mut low, mut high] = bracket;
    let sign = low.1.signum();
    // The Illinois rule takes about ten.
    for _ in 0..100 {
        if high.1 == 0.0 || high.0 - low.0 <= tolerances::ROUND_OFF_OF_FACTORS {
            break;
        }
        let theta = low.0 + (high.0 - low.0) * low.1 / (low.1 - high.1);
        let value = look(theta)?;
        if value * sign > 0.0 {
            low = (theta, value);
            high.1 *= 0.5;
        } else {
            high = (theta, value);
            low.1 *= 0.5;
        }
    }
    Ok(high.0)
}
