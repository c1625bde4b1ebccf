//! phi = 0 from a guess, by damped Newton's method in the mass metric.

use super::Metric;
use crate::error::Result;
use crate::tolerances;

/// Closes the joints: d = -W^-1 G^T (G W^-1 G^T)^-1 phi, damped until |phi| falls. Where that ends at an open state, G
/// has lost rank there, such as with all bars of a loop on one line. Then it begins again from states beside the guess.
/// Returns true if the joints are closed; else q is the open state with the smallest |phi|. Adds the way to `moved`.
///
/// # Errors
/// Constraints that are infinite at the guess.
pub fn close(metric: &mut Metric, t: f64, q: &mut [f64], moved: &mut [f64]) -> Result<bool> {
    let guess = (q.to_vec(), moved.to_vec());
    if attempt(metric, t, q, moved)? {
        return Ok(true);
    }
    let mut least = metric.residual(t, q);
    let is_large = moved.len() > tolerances::DENSE_EIGENVALUES;
    // Each takes seconds where there are many velocities; of 199 loops with random angles one needs four.
    let restarts = if is_large { 3 } else { 12 };
    for number in 1..=restarts {
        let (mut from, mut way) = guess.clone();
        beside(metric, number, &mut from, &mut way);
        // A state beside the guess may be where an expression has no value.
        let is_closed = attempt(metric, t, &mut from, &mut way).unwrap_or(false);
        let residual = metric.residual(t, &from);
        if is_closed || residual < least {
            q.copy_from_slice(&from);
            moved.copy_from_slice(&way);
            least = residual;
        }
        if is_closed {
            metric.is_beside = true;
            return Ok(true);
        }
    }
    metric.residual(t, q);
    Ok(false)
}

/// Damped Newton's method from one guess; true if it ends closed, as far as round-off lets the residual fall.
pub(super) fn attempt(metric: &mut Metric, t: f64, q: &mut [f64], moved: &mut [f64]) -> Result<bool> {
    let (mut d, mut start) = std::mem::take(&mut metric.newton);
    d.resize(moved.len(), 0.0);
    let is_closed = iterate(metric, t, q, moved, &mut d, &mut start);
    metric.newton = (d, start);
    is_closed
}

fn iterate(
    metric: &mut Metric,
    t: f64,
    q: &mut [f64],
    moved: &mut [f64],
    d: &mut [f64],
    start: &mut Vec<f64>,
) -> Result<bool> {
    let mut last = f64::INFINITY;
    // Loops of random angles take 56 at most.
    for _ in 0..80 {
        metric.at_rest(t, q)?;
        let residual = metric.size_of_phi();
        let is_closed = metric.is_closed(q);
        if metric.is_rounding(q) || is_closed && residual >= tolerances::NEWTON_HALVES * last {
            return Ok(true);
        }
        last = residual;
        metric.step(None, d)?;
        let factor = (tolerances::LARGEST_TURN / metric.largest_turn(q, d)).min(1.0);
        start.clear();
        start.extend_from_slice(q);
        let Some(taken) = advance(metric, t, start, q, d, factor, residual) else { return Ok(is_closed) };
        moved.iter_mut().zip(&*d).for_each(|(moved, d)| *moved += taken * d);
    }
    metric.residual(t, q);
    Ok(metric.is_closed(q))
}

/// Moves q from `start` along a step, halved until the residual falls; returns the part that is taken. `None` where it does not fall,
/// with q unchanged.
fn advance(
    metric: &mut Metric,
    t: f64,
    start: &[f64],
    q: &mut [f64],
    d: &[f64],
    full: f64,
    residual: f64,
) -> Option<f64> {
    let mut factor = full;
    for _ in 0..tolerances::STEP_HALVINGS {
        metric.go(start, d, factor, q);
        if metric.residual(t, q) < residual * (1.0 - tolerances::SUFFICIENT_STEP * factor) {
            return Some(factor);
        }
        factor *= 0.5;
    }
    q.copy_from_slice(start);
    None
}

/// The numbers of a Weyl sequence between -1 and 1: fractional parts of multiples of the golden ratio.
pub fn weyl(number: usize) -> f64 {
    2.0 * (0.5 * (5f64.sqrt() - 1.0) * (number + 1) as f64).fract() - 1.0
}

/// Moves q away from the guess, farther with each number, along none of the held directions.
fn beside(metric: &mut Metric, number: usize, q: &mut [f64], moved: &mut [f64]) {
    let amplitude = (tolerances::BESIDE * number as f64).min(1.0);
    let length = metric.system.facts().length;
    let mut away = vec![0.0; moved.len()];
    for (i, away) in away.iter_mut().enumerate() {
        let place = weyl(number * moved.len() + i);
        *away = amplitude * place * (length / metric.inertia(i).sqrt()).min(1.0);
    }
    metric.held.iter().for_each(|held| away[*held] = 0.0);
    let start = q.to_vec();
    metric.go(&start, &away, 1.0, q);
    moved.iter_mut().zip(&away).for_each(|(moved, away)| *moved += away);
}
