//! Derivatives of eigenvalues with respect to a parameter.

use super::found::Found;
use super::{Complex, Kind, Mode};
use crate::error::Result;
use crate::tolerances::DEFECTIVE_MODE;

/// Step of the differences that give the sensitivity of eigenvalues. Unit: `[1]` of the parameter. Why: its fourth
/// power and rounding over it are both about 1e-12. Test: `eigenvalues_have_their_sensitivity`.
const SENSITIVITY_STEP: f64 = 1e-3;

/// The derivatives of the eigenvalues at a value of a parameter.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Sensitivity {
    /// The value of the parameter.
    pub at: f64,
    /// Each physical eigenvalue with im >= 0 and its derivative; none for a defective one, which moves with the root of the
    /// change.
    pub slopes: Vec<(Complex<f64>, Option<Complex<f64>>)>,
}

/// Returns the derivative of each eigenvalue by central differences of fourth order, the state following the parameter:
///
/// ```text
/// lambda' = (8 (lambda(p + h) - lambda(p - h)) - (lambda(p + 2 h) - lambda(p - 2 h))) / 12 h + O(h^4)
/// ```
///
/// # Errors
/// A value without a model.
pub(super) fn sensitivity(here: &Found, h: f64, model: impl Fn(&Found, f64) -> Result<Found>) -> Result<Sensitivity> {
    let at = here.sample.at;
    let beside = [-2.0, -1.0, 1.0, 2.0].map(|k| model(here, at + k * h));
    let [far_below, below, above, far_above] = beside;
    let [far_below, below, above, far_above] = [far_below?, below?, above?, far_above?];
    let upper = here.sample.modes.iter().filter(|mode| mode.kind == Kind::Physical && mode.value.im >= 0.0);
    let slope = |mode: &Mode| {
        let near = [&below, &above].map(|found| nearest(found, mode.value));
        let [minus, plus] = [near[0]?, near[1]?];
        let step = (plus - minus) * 0.5;
        let [far_minus, far_plus] =
            [nearest(&far_below, mode.value - step * 2.0)?, nearest(&far_above, mode.value + step * 2.0)?];
        let is_simple = mode.condition < DEFECTIVE_MODE && !mode.is_zero();
        is_simple.then(|| ((plus - minus) * 8.0 - (far_plus - far_minus)) / (12.0 * h))
    };
    Ok(Sensitivity { at, slopes: upper.map(|mode| (mode.value, slope(mode))).collect() })
}

/// Step of the differences: their error is its fourth power, and rounding over it.
pub(super) fn step(at: f64, range: f64) -> f64 {
    SENSITIVITY_STEP * if at == 0.0 { range.abs() } else { at.abs() }
}

fn nearest(found: &Found, value: Complex<f64>) -> Option<Complex<f64>> {
    let physical = found.sample.modes.iter().filter(|mode| mode.kind == Kind::Physical).map(|mode| mode.value);
    physical.min_by(|a, b| (a - value).norm().total_cmp(&(b - value).norm()))
}
