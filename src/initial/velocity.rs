//! Velocities: min |v - v_0|_W subject to G v + phi_t = 0 and the held rates.

use super::Metric;
use crate::error::{Error, Result, short};
use crate::math::largest;
use crate::tolerances;

pub fn fit(metric: &mut Metric, t: f64, q: &[f64], v: &mut [f64]) -> Result<()> {
    let given = v.to_vec();
    // The second iteration removes the round-off of the first.
    for _ in 0..2 {
        metric.at(t, q, v)?;
        let bottom: Vec<f64> = metric.terms.phi_dot.iter().map(|rate| -rate).collect();
        let mut change = vec![0.0; v.len()];
        metric.solve(&mut change, &bottom)?;
        v.iter_mut().zip(&change).for_each(|(v, change)| *v += change);
    }
    metric.at(t, q, v)?;
    let asked = largest(&given).max(largest(&metric.terms.phi_t));
    let largest = largest(v).max(asked);
    let is_met = metric.worst(&metric.terms.phi_dot) <= tolerances::SAME * largest.max(f64::MIN_POSITIVE);
    // Beside a dead centre a rate is met by velocities beyond all bounds.
    if is_met && metric.has_initial() && asked < tolerances::HALF_OF_THE_DIGITS * largest {
        let message =
            format!("the rates in `initial` take velocities of {largest:.1e}: the joints are at a dead centre");
        return Err(Error::input(message)
            .under("initial")
            .hint("give a position beside the dead centre, or the rate of another joint"));
    }
    if !is_met {
        let culprits = metric.culprits(&metric.terms.phi_dot);
        let (problem, place, hint) = contradiction(metric);
        let message = format!("{problem}; rates that remain (m/s, rad/s): {culprits}");
        return Err(Error::input(message).under(place).hint(hint));
    }
    let before = metric.distance(&given);
    let after = metric.distance(v);
    let driven = metric.terms.phi_t.iter().any(|rate| *rate != 0.0);
    // Below, a second moves nothing by more than rounding: a run at rest leaves such velocities.
    let moves = asked > f64::EPSILON * metric.system.facts().length;
    if moves && !driven && after < tolerances::SIX_DIGITS * tolerances::SIX_DIGITS * before {
        let names = metric.system.facts().names.v.clone();
        let fastest = (0..given.len()).max_by(|&i, &j| given[i].abs().total_cmp(&given[j].abs())).unwrap_or(0);
        return Err(Error::input(format!(
            "the joints allow none of the initial velocities, such as `{}` = {}",
            names[fastest],
            short(given[fastest])
        ))
        .under("bodies")
        .hint("mend \"velocity\" and \"angular_velocity\" in \"initial\", or leave them out"));
    }
    Ok(())
}

/// The problem of velocities that do not fit together, its place in the scene and the remedy.
fn contradiction(metric: &Metric) -> (&'static str, &'static str, &'static str) {
    if metric.has_initial() {
        let hint = "give rates that the joints allow together, or fewer of them";
        ("the rates in `initial` contradict the joints or each other", "initial", hint)
    } else if metric.held.is_empty() {
        let hint = "check drivers, and joints that hold the same motion";
        ("the joints ask for different velocities", "joints", hint)
    } else {
        let hint = "what is held keeps its initial velocity: mend that, or hold fewer coordinates";
        ("the held rates contradict the joints", "assembly.hold", hint)
    }
}
