//! For how long a frozen model can be trusted.

use super::subject::Subject;
use crate::error::Result;
use crate::linearize::Matrix;
use crate::linearize::flow::Bundle;
use crate::math::array::Each;
use crate::math::eigen::expm;
use crate::tolerances;

/// The errors at which a horizon ends.
pub const SHARES: [f64; 2] = [0.01, 0.1];

/// Returns the first times at which the relative error of exp(A t) x0 exceeds each share, none where it stays below up
/// to `end`; nothing if the time was over before. The perturbation is carried along the motion, with states as near as
/// the fastest mode needs and, after the start, as the first passage needs.
///
/// # Errors
/// A motion that cannot go on.
pub fn horizons(subject: &Subject, x0: &Matrix, end: f64) -> Result<Option<[Option<f64>; 2]>> {
    let Subject { start, model, carried, norm, speed, .. } = subject;
    let times = times(end, speed.fastest);
    let bundle = Bundle { columns: model.coordinates.changes_of(x0), ..Bundle::of(start) };
    let absolute: Vec<f64> = times.iter().map(|t| start.t + t).collect();
    let snapshots = carried.flow(&bundle, &absolute)?;
    if snapshots.len() < times.len() {
        return Ok(None);
    }
    let freedom = carried.start.freedom();
    let mut errors = Vec::new();
    let mut x = x0.clone();
    let mut step = 0.0;
    let mut factor = Matrix::zeros(0, 0);
    let mut last = 0.0;
    for (exact, t) in carried.states(&snapshots)?.iter().zip(&times) {
        let length = t - last;
        let is_near = |other: f64| (length - other).abs() <= tolerances::SAME * t;
        if step > 0.0 && is_near(2.0 * step) {
            factor = &factor * &factor;
        } else if !is_near(step) {
            factor = expm(&(&model.built.a * length))?;
        }
        step = length;
        x = &factor * x;
        last = *t;
        errors.push(norm.states(freedom, &(exact - &x)) / norm.states(freedom, exact));
    }
    Ok(Some(SHARES.each(|share| horizon(&times, &errors, share))))
}

/// Even times up to `end`, a part of the period of the fastest mode apart, and halvings of the first.
fn times(end: f64, fastest: f64) -> Vec<f64> {
    let period = std::f64::consts::TAU / fastest;
    // An error that oscillates is right to a percent then; each state costs a step of the motion.
    let count = (end / period * 24.0).ceil().clamp(60.0, 600.0);
    let first = end / count;
    // A passage at a thousandth of the first state is still found.
    let halved = (1..=12).rev().map(|i| first * 0.5f64.powi(i));
    halved.chain((1..=count as usize).map(|i| end * i as f64 / count)).collect()
}

/// Returns the first time at which an error exceeds `share`, between times by a power of the time; none where it stays
/// below.
pub fn horizon(times: &[f64], errors: &[f64], share: f64) -> Option<f64> {
    let first = errors.iter().position(|error| *error > share)?;
    let Some(before) = first.checked_sub(1) else { return Some(times[0]) };
    let low = errors[before];
    let high = errors[first];
    let length = times[first] - times[before];
    if low <= 0.0 {
        return Some(times[before] + length * (share - low) / (high - low));
    }
    let fraction = (share / low).ln() / (high / low).ln();
    Some(times[before] * (times[first] / times[before]).powf(fraction))
}
