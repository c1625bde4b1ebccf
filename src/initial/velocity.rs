//! Velocities: min |v - v_0|_W subject to G v + phi_t = 0 and the held rates.

use super::Metric;
use crate::error::{Error, Result};

/// What may remain of G v + phi_t against the size of its terms.
const FITTED: f64 = 1e-9;
/// A start that keeps less than this part of the given velocities contradicts the joints.
const KEPT: f64 = 1e-6;

pub fn fit(metric: &mut Metric, t: f64, q: &[f64], v: &mut [f64]) -> Result<()> {
    let given = v.to_vec();
    // Twice: the second time takes off the round-off of the first.
    for _ in 0..2 {
        metric.at(t, q, v)?;
        let bottom: Vec<f64> = metric.terms.phi_dot.iter().map(|rate| -rate).collect();
        let mut change = vec![0.0; v.len()];
        metric.solve(&mut change, &bottom)?;
        v.iter_mut().zip(&change).for_each(|(v, change)| *v += change);
    }
    metric.at(t, q, v)?;
    let largest = v.iter().chain(&given).chain(&metric.terms.phi_t).fold(0.0f64, |largest, x| largest.max(x.abs()));
    if metric.worst(&metric.terms.phi_dot) > FITTED * largest.max(f64::MIN_POSITIVE) {
        let culprits = metric.culprits(&metric.terms.phi_dot);
        let error = Error::input(format!("the initial velocities contradict the joints: {culprits} (m/s or rad/s)"));
        return Err(error.under("bodies").hint(match metric.held.is_empty() {
            true => "two joints ask for different velocities: check drivers, and joints that hold the same motion",
            false => "rates of coordinates in assembly.hold are kept as given: mend them or hold fewer coordinates",
        }));
    }
    let size = |metric: &Metric, v: &[f64]| v.iter().zip(metric.weigh(v)).map(|(a, b)| a * b).sum::<f64>();
    let (before, after) = (size(metric, &given), size(metric, v));
    let driven = metric.terms.phi_t.iter().any(|rate| *rate != 0.0);
    if before > 0.0 && !driven && after < KEPT * KEPT * before {
        return Err(Error::input("the initial velocities contradict the joints: none of them is possible")
            .under("bodies")
            .hint("the joints allow no motion in the given directions: mend \"velocity\" and \"angular_velocity\""));
    }
    Ok(())
}
