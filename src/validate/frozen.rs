//! The frozen model exp(A t) against the variational equations.

use super::deviation::{Comparison, Deviation, MatrixLimits};
use super::limit::limit;
use super::subject::Subject;
use super::{Decay, decay};
use crate::error::Result;
use crate::linearize::flow::Bundle;
use crate::linearize::{Coordinates, Matrix};
use crate::math::eigen::expm;
use crate::tolerances;
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
    /// A against the limit of (X(h) - I)/h, entry by entry; none if the time was over before.
    pub limit: Option<Deviation>,
}

/// Compares exp(A h) with the state-transition matrix X(h) over halved steps from `longest`. The error is -A' h^2/2 and
/// falls as h^2, or faster where A does not change; a term missing in A shows as order 1. Returns the chart at each step,
/// too.
///
/// # Errors
/// A motion that cannot go on.
pub fn frozen(subject: &Subject, longest: f64) -> Result<(Frozen, Vec<Coordinates>)> {
    let Subject { start, model, carried, speed, .. } = subject;
    let a = &model.built.a;
    let rate = speed.usual;
    let steps: Vec<f64> = (0..14).rev().map(|i| longest / f64::from(1 << i)).collect();
    let times: Vec<f64> = steps.iter().map(|h| start.t + h).collect();
    let mut errors = Vec::new();
    let bundle = Bundle { columns: carried.start.changes(), ..Bundle::of(start) };
    let snapshots = carried.flow(&bundle, &times)?;
    let charts = carried.charts(&snapshots)?;
    let mut transitions = Vec::new();
    let mut predicted = expm(&(a * steps[0]))?;
    for (snapshot, chart) in snapshots.iter().zip(&charts) {
        let transition = chart.states_of(&snapshot.columns);
        let exact = alike(transition.clone(), chart.freedom(), rate);
        errors.push((&exact - alike(predicted.clone(), chart.freedom(), rate)).norm() / exact.norm());
        transitions.push(transition);
        // The next step is twice as long.
        predicted = &predicted * &predicted;
    }
    // Fast modes are accurate relative to the fastest rate, not the slow one; and the error of the shortest step counts
    // as rounding.
    let floor =
        (3.0 * tolerances::TIGHTEST * (speed.fastest / rate).max(1.0)).max(errors.first().copied().unwrap_or(0.0));
    let steps = steps[..errors.len()].to_vec();
    // Up to here the lowest power of h rules.
    let decay = decay(&steps, &errors, |_| 3e-3, floor);
    let limit = transition_limit(&carried.start, &steps, &transitions).and_then(|measured| {
        let names = &carried.start.states;
        let n = names.len();
        let comparison = Comparison::new(a.clone(), measured, carried.start.freedom(), n, rate);
        comparison.worst(0..n, 0..n, [names, names])
    });
    Ok((Frozen { steps, errors, decay, limit }, charts))
}

/// Returns the limit of (X(h) - I)/h from X at increasing steps.
fn transition_limit(start: &Coordinates, steps: &[f64], transitions: &[Matrix]) -> Option<MatrixLimits> {
    let sizes: Vec<f64> = steps.iter().rev().copied().collect();
    let first = start.states_of(&start.changes());
    let n = first.nrows();
    let mut limits = MatrixLimits::new(n, n);
    for (i, j) in (0..n).flat_map(|i| (0..n).map(move |j| (i, j))) {
        let slopes = transitions.iter().rev().zip(&sizes).map(|(x, h)| (x[(i, j)] - first[(i, j)]) / h);
        let rounding = tolerances::TIGHTEST * first[(j, j)].abs().max(1.0);
        limits.set((i, j), limit(&sizes, &slopes.collect::<Vec<f64>>(), 1, rounding));
    }
    (transitions.len() >= tolerances::FEWEST_CHARTS).then_some(limits)
}

/// Scales the blocks of a state-transition matrix to one unit.
fn alike(mut x: Matrix, k: usize, rate: f64) -> Matrix {
    let rest = x.nrows() - k;
    x.rows_mut(k, rest).unscale_mut(rate);
    x.columns_mut(k, rest).scale_mut(rate);
    x
}
