//! Points along a motion, as close as interpolation needs them.

use super::{Along, along_by};
use crate::error::{Error, Result, percent, short};
use crate::linearize::{Chart, State};
use crate::system::MechanicalSystem;

/// Points at most where interpolation needs them close: files of more are hard to use.
const WITHIN_MOST: usize = 20_000;

/// Returns models at times so close that linear interpolation between them is within the part `error` of the largest
/// entry of each kind of matrix, measured half-way. Intervals are halved, beginning with those of `times`.
///
/// # Errors
/// Those of [`along`](super::along); too many points.
pub fn within(
    system: &dyn MechanicalSystem,
    start: &State,
    chart: Option<&Chart>,
    times: &[f64],
    error: f64,
    mut progress: impl FnMut(f64),
) -> Result<Along> {
    let mut times = times.to_vec();
    loop {
        let along = along_by(system, start, chart, &times, 1, &mut progress)?;
        let before = times.len();
        times = finer(&times, &along.intervals, error);
        if times.len() == before {
            return Ok(along);
        }
        if times.len() > WITHIN_MOST {
            let at = along.intervals.iter().enumerate().max_by(|a, b| a.1.total_cmp(b.1)).map_or(0, |(i, _)| i);
            let text = format!(
                "interpolation within {} needs more than {} points; it is worst near t = {} s",
                percent(error),
                WITHIN_MOST,
                short(along.models[at].point.t)
            );
            return Err(Error::input(text).under("--within").hint("give more percent, or a shorter time"));
        }
    }
}

/// Returns the times with one more half-way where the deviation is too large.
fn finer(times: &[f64], deviations: &[f64], error: f64) -> Vec<f64> {
    let mut finer = vec![times[0]];
    for (pair, deviation) in times.windows(2).zip(deviations) {
        finer.extend((*deviation > error).then_some(0.5 * (pair[0] + pair[1])));
        finer.push(pair[1]);
    }
    finer
}
