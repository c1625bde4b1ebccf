//! Condition of the reduction to the directions that the constraints allow, and the error of a model that follows.

use super::changes::beside;
use super::minimal::{Minimal, minimal};
use super::{Changes, Linear, LinearizationPoint, Matrix, Reduction, Variation};
use crate::error::{Error, Result, clock, two_digits};
use crate::tolerances;

/// Condition of the reduction from which on the error of a model by rounding of its state is measured. Unit: `[1]`.
/// Why: below, the fourth power of it times rounding is less than SIX_DIGITS. Test:
/// `a_model_near_a_fold_has_an_error`.
const REDUCTION_MEASURED: f64 = 300.0;

/// Returns the condition of the reduction at a state and the error that follows: an estimate far from singular states,
/// near them the change of the model in minimal coordinates where the state moves as far as rounding of phi lets it. That
/// bounds the error: a start that is closed to rounding has not moved, and may be right to the last digit of its numbers.
///
/// # Errors
/// A model of which rounding leaves no digits: the state is as good as singular.
pub(super) fn measure(variation: &mut Variation, request: &Linear) -> Result<Reduction> {
    let condition = variation.dynamics.kkt.kept_indicator().recip();
    if condition < REDUCTION_MEASURED {
        // Beside folds of two cranks it is 0.05.
        let error = f64::EPSILON * (0.1 * condition.powi(4)).max(1.0);
        return Ok(Reduction { condition, error });
    }
    let chart = request.chart(variation);
    let point = variation.point.clone();
    let here = minimal(variation, &chart)?;
    if here.built.a.is_empty() {
        let error = if condition > 1.0 / tolerances::HALF_OF_THE_DIGITS { f64::INFINITY } else { 0.0 };
        return judged(Reduction { condition, error }, point.t);
    }
    let mut error: f64 = 0.0;
    for sign in [1.0, -1.0] {
        let there = move_off(variation, &point, sign).and_then(|()| minimal(variation, &chart));
        error = error.max(there.map_or(f64::INFINITY, |there| difference(&here, &there)));
    }
    variation.operate_at(point.t, &point.q, &point.v)?;
    judged(Reduction { condition, error }, point.t)
}

/// Refuses a model of which rounding leaves no digits.
fn judged(reduction: Reduction, t: f64) -> Result<Reduction> {
    let Reduction { condition, error } = reduction;
    if error <= tolerances::TOLD {
        return Ok(reduction);
    }
    let result = if error.is_finite() {
        format!("rounding changes the linear model by {} of its size", two_digits(error))
    } else {
        "rounding decides which of them are independent".to_string()
    };
    Err(Error::input(format!(
        "singular state: at t = {} s constraints are nearly dependent (condition {condition:.1e}), and {result}",
        clock(t)
    ))
    .hint("choose another time, a little before or after, or change the state"))
}

/// Operates at a state that is no nearer to the constraints or farther than rounding of phi: each row is off by up to an
/// ulp of its scale, which moves q by the condition times that, and v with it.
fn move_off(variation: &mut Variation, point: &LinearizationPoint, sign: f64) -> Result<()> {
    let system = variation.system();
    // Multiples of the golden ratio are evenly spread (Weyl).
    let part = |i: usize| 2.0 * ((i + 1) as f64 * 0.618_033_988_75).fract() - 1.0;
    let scales = system.facts().scales.clone();
    let rows = Matrix::from_fn(scales.len(), 1, |i, _| sign * f64::EPSILON * scales[i] * part(i));
    let change = variation.correct(&rows)?;
    let mut rate = vec![0.0; point.q.len()];
    system.rate(&point.q, change.as_slice(), &mut rate);
    let mut q: Vec<f64> = point.q.iter().zip(&rate).map(|(q, change)| q + change).collect();
    system.normalize(&mut q);
    variation.operate_at(point.t, &q, &point.v)?;
    let residual = Matrix::from_column_slice(scales.len(), 1, &variation.dynamics.terms.phi_dot);
    let correction = variation.correct(&residual)?;
    let v: Vec<f64> = point.v.iter().zip(correction.iter()).map(|(v, change)| v - change).collect();
    variation.operate_at(point.t, &q, &v)
}

/// Returns the difference of two models over their size, in the states of the first with rates over the size of the
/// frequencies, so that all entries have one unit. Infinite where they have different numbers of states.
fn difference(here: &Minimal, there: &Minimal) -> f64 {
    let n = here.built.a.nrows();
    if there.built.a.nrows() != n {
        return f64::INFINITY;
    }
    let stacked = |changes: &Changes| beside(&changes.q.transpose(), &changes.v.transpose()).transpose();
    let changes_here = stacked(&here.built.changes);
    let changes_there = stacked(&there.built.changes);
    let Some(inverse) = changes_there.tr_mul(&changes_there).try_inverse() else { return f64::INFINITY };
    let to = inverse * changes_there.tr_mul(&changes_here);
    let Some(from) = to.clone().try_inverse() else { return f64::INFINITY };
    let k = here.coordinates.freedom();
    let rate = here.built.a.view((k, 0), (n - k, k)).amax().sqrt();
    let unit = |i: usize| if i < k || rate == 0.0 { 1.0 } else { rate };
    let scaled = |a: &Matrix| Matrix::from_fn(n, n, |i, j| a[(i, j)] * unit(j) / unit(i));
    let size = scaled(&here.built.a).norm();
    let change = scaled(&(from * &there.built.a * to - &here.built.a)).norm();
    if size > 0.0 { change / size } else { 0.0 }
}
