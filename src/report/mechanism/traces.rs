//! Paths of markers.

use super::motion::DrawnMotion;
use super::snapshot::markers;
use super::view::View;
use crate::body::{MarkerId, MarkerTable, Probe, Quantity};
use crate::error::Result;
use crate::plot::{Series, Style};
use crate::prepared::{AnyMechanism, in_either};
use crate::scene::Measure;

/// A marker whose path is drawn.
#[derive(Clone, Debug, PartialEq)]
pub struct Trace {
    /// Name, such as `crank.tip`.
    pub name: String,
    pub marker: MarkerId,
    /// The body that carries it; `None` is the ground.
    pub body: Option<usize>,
}

impl Trace {
    fn new(table: &MarkerTable, marker: MarkerId) -> Self {
        Trace { name: table.names[marker].clone(), marker, body: table.bodies[marker] }
    }
}

/// Returns the marker of a name.
///
/// # Errors
/// There is none; the error names the most similar ones.
pub fn find_trace(mechanism: &AnyMechanism, name: &str) -> Result<Trace> {
    let table = mechanism.markers();
    Ok(Trace::new(table, table.find(name)?))
}

/// Returns the markers whose positions relative to the ground are outputs of the scene.
pub fn output_traces(mechanism: &AnyMechanism) -> Vec<Trace> {
    let table = mechanism.markers();
    let mut traces = Vec::<Trace>::new();
    for output in in_either!(mechanism, mechanism => &mechanism.model().outputs) {
        if let Measure::Probe(Probe { of, to, quantity: Quantity::Position(_), order: 0 }) = output.measure
            && to.is_none_or(|to| table.bodies[to].is_none())
            && table.bodies[of].is_some()
            && traces.iter().all(|known| known.marker != of)
        {
            traces.push(Trace::new(table, of));
        }
    }
    traces
}

/// Draws the paths in the colours of their bodies.
pub fn curves(motion: &DrawnMotion, view: &View, traces: &[Trace]) -> Vec<Series> {
    let path = |trace: &Trace| Series {
        color: trace.body,
        ..Series::line(format!("path of {}", trace.name), Vec::new()).style(Style::Thin)
    };
    let mut curves: Vec<Series> = traces.iter().map(path).collect();
    if traces.is_empty() {
        return curves;
    }
    for t in motion.times(4000) {
        let poses = markers(&motion.prepared.mechanism, &motion.state(t));
        for (curve, trace) in curves.iter_mut().zip(traces) {
            curve.points.push(view.flat(poses[trace.marker].r));
        }
    }
    curves
}
