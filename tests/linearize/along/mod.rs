//! Linear time-varying models along motions: against closed forms, and against the transition matrices of one span.

mod charts;
mod closed_forms;
mod lqr;
mod shipped;
mod switches;

use holonom::linearize::{Along, Changes, Chart, Matrix, State, along, transition};
use holonom::system::MechanicalSystem;

/// Times from that of the start to `end`.
pub fn times(start: &State, end: f64, count: usize) -> Vec<f64> {
    let part = |i: usize| i as f64 / (count - 1) as f64;
    (0..count).map(|i| start.t * (1.0 - part(i)) + end * part(i)).collect()
}

pub fn models(system: &dyn MechanicalSystem, start: &State, chart: &str, (end, count): (f64, usize)) -> Along {
    along(system, start, Some(&Chart::parse(chart)), &times(start, end, count), |_| {}).unwrap()
}

/// The changes (dq, dv) at the end of unit states at the start, by the products of the transition matrices.
pub fn carried(found: &Along) -> Changes {
    let frame = found.models.last().unwrap().frame.as_ref().unwrap();
    frame.coordinates.changes_of(&found.whole().unwrap())
}

/// The largest difference of the products from the transition over the whole span, over its largest entry.
pub fn off_whole(system: &dyn MechanicalSystem, start: &State, chart: &str, found: &Along) -> f64 {
    let end = found.models.last().unwrap().point.t;
    let whole = transition(system, start, &Chart::parse(chart), &[end]).unwrap().remove(0).changes;
    let product = carried(found);
    let off = |a: &Matrix, b: &Matrix| (a - b).amax() / b.amax();
    off(&product.q, &whole.q).max(off(&product.v, &whole.v))
}
