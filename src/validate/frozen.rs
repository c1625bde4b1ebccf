//! The frozen model exp(A t) against the variational equations.

use super::perturb::Speed;
use super::{Decay, decay};
use crate::error::Result;
use crate::linearize::flow::Bundle;
use crate::linearize::{Carried, Matrix, State};
use crate::math::eigen::expm;
use crate::tolerances::linearize as tolerances;
use serde::Serialize;

/// Deviation of the frozen model from the variational equations.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Frozen {
    /// Steps h, s.
    pub steps: Vec<f64>,
    /// |X(h) - exp(A h)| / |X(h)|, velocities divided by a rate of the model.
    pub errors: Vec<f64>,
    /// Order of the errors in h.
    pub decay: Decay,
}

/// Compares exp(A h) with the state-transition matrix X(h) over halved steps from `longest`. The error is -A' h^2/2 and
/// falls as h^2, or faster where A does not change; a term missing in A shows as order 1.
///
/// # Errors
/// A motion that cannot go on.
pub fn frozen(start: &State, carried: &Carried, (a, speed): (&Matrix, &Speed), longest: f64) -> Result<Frozen> {
    let rate = speed.usual;
    let steps: Vec<f64> = (0..14).rev().map(|i| longest / f64::from(1 << i)).collect();
    let times: Vec<f64> = steps.iter().map(|h| start.t + h).collect();
    let mut errors = Vec::new();
    let bundle = Bundle { columns: carried.start.changes(), ..Bundle::of(start) };
    let (snapshots, charts) = carried.flow(&bundle, &times)?;
    for ((snapshot, chart), h) in snapshots.iter().zip(charts).zip(&steps) {
        let exact = alike(chart.states_of(&snapshot.columns), chart.freedom(), rate);
        let predicted = alike(expm(&(a * *h))?, chart.freedom(), rate);
        errors.push((&exact - predicted).norm() / exact.norm());
    }
    // Fast modes are accurate relative to the fastest rate, not the slow one; and the error of the shortest step counts
    // as rounding.
    let floor =
        (3.0 * tolerances::FLOW_ATOL * (speed.fastest / rate).max(1.0)).max(errors.first().copied().unwrap_or(0.0));
    let steps = steps[..errors.len()].to_vec();
    let decay = decay(&steps, &errors, |_| tolerances::LOWEST_POWER, floor);
    Ok(Frozen { steps, errors, decay })
}

/// Scales the blocks of a state-transition matrix to one unit.
fn alike(mut x: Matrix, k: usize, rate: f64) -> Matrix {
    let rest = x.nrows() - k;
    x.rows_mut(k, rest).unscale_mut(rate);
    x.columns_mut(k, rest).scale_mut(rate);
    x
}

/// Returns the first time at which an error exceeds `share`; none where it stays below.
pub fn horizon(times: &[f64], errors: &[f64], share: f64) -> Option<f64> {
    let first = errors.iter().position(|error| *error > share)?;
    if first == 0 {
        return Some(times[0]);
    }
    let low = errors[first - 1];
    let high = errors[first];
    Some(times[first - 1] + (times[first] - times[first - 1]) * (share - low) / (high - low))
}
