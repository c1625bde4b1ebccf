//! The state nearest to the guess among those with phi = 0.

use super::Metric;
use crate::error::Result;
use crate::math::largest;
use crate::tolerances;

/// Moves a closed q along the constraints until |q - q_0|_W is least, by steps [W G^T; G 0] [d; .] = [-W (q - q_0);
/// -phi]. A step is halved until the joints close after it by Newton's method with the matrix before it, and the
/// distance falls. Where no step does so, the last closed state is kept. `moved` is the way from the guess.
///
/// # Errors
/// None from a closed state where the constraints are smooth.
pub fn approach(metric: &mut Metric, t: f64, q: &mut [f64], moved: &mut [f64]) -> Result<()> {
    let mut d = vec![0.0; moved.len()];
    let mut smallest = f64::INFINITY;
    let mut stalled = 0;
    for _ in 0..tolerances::APPROACH_STEPS {
        metric.at_rest(t, q)?;
        metric.step(Some(moved), &mut d)?;
        let size = largest(&d);
        let travel = 1.0 + largest(moved);
        // Near the nearest state the distance changes by the square of the step: by its round-off.
        // There the distance falls by the square of the step, which the corrections of the joints hide.
        let is_close = size <= tolerances::UNSEEN * travel;
        stalled = if size > tolerances::STAGNANT * smallest { stalled + 1 } else { 0 };
        if size <= tolerances::ROUND_OFF_OF_SOLUTIONS * travel || (is_close && stalled > 8) {
            break;
        }
        smallest = smallest.min(size);
        let before = metric.distance(moved);
        let factor = (tolerances::LARGEST_TURN / metric.largest_turn(q, &d)).min(1.0);
        let step = DampedStep { d: &d, factor, most: tolerances::STEP_HALVINGS };
        let next = halved(metric, t, q, moved, step, |metric, way| is_close || metric.distance(way) < before);
        let Some(next) = next else { break };
        q.copy_from_slice(&next.0);
        moved.copy_from_slice(&next.1);
    }
    Ok(())
}

/// A step along d that is halved where it is too long.
pub(super) struct DampedStep<'a> {
    pub d: &'a [f64],
    /// The part of d that is tried first.
    pub factor: f64,
    /// The largest number of trials.
    pub most: usize,
}

/// The closed state after `factor` of a step from a closed q, to which `moved` leads, with the way to it, if it
/// `is_better` with that way; else after half, and so on.
pub(super) fn halved(
    metric: &mut Metric,
    t: f64,
    q: &[f64],
    moved: &[f64],
    step: DampedStep,
    is_better: impl Fn(&Metric, &[f64]) -> bool,
) -> Option<(Vec<f64>, Vec<f64>)> {
    let DampedStep { d, mut factor, most } = step;
    for _ in 0..most {
        let mut ahead = q.to_vec();
        let mut way = moved.to_vec();
        metric.go(q, d, factor, &mut ahead);
        way.iter_mut().zip(d).for_each(|(way, d)| *way += factor * d);
        if corrected(metric, t, &mut ahead, &mut way) && is_better(metric, &way) {
            return Some((ahead, way));
        }
        factor *= 0.5;
    }
    None
}

/// Newton's method with the matrix at hand; true if it closes the joints.
fn corrected(metric: &mut Metric, t: f64, q: &mut [f64], moved: &mut [f64]) -> bool {
    let mut d = vec![0.0; moved.len()];
    let mut last = f64::INFINITY;
    for _ in 0..tolerances::CLOSING_ITERATIONS {
        let residual = metric.residual(t, q);
        let is_slow = residual.is_nan() || residual > tolerances::NEWTON_HALVES * last;
        if metric.is_closed(q) || is_slow {
            return metric.is_closed(q);
        }
        last = residual;
        if metric.step(None, &mut d).is_err() {
            return false;
        }
        let start = q.to_vec();
        metric.go(&start, &d, 1.0, q);
        moved.iter_mut().zip(&d).for_each(|(moved, d)| *moved += d);
    }
    false
}
