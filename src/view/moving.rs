//! A mechanism of a page with its motion, within a budget of numbers.

use super::ShownMotion;
use super::clip::Clip;
use super::parts::{BodyPart, LinkPart, PageParts, TracePart};
use crate::linearize::State;
use crate::report::mechanism::{Snapshot, output_traces, reactions, snapshot, solids};
use serde::Serialize;

/// Rows that a motion has at least; where more bodies do not fit then, the last ones are not shown.
const LEAST_ROWS: usize = 120;

/// A mechanism in motion.
#[derive(Serialize)]
pub struct MovingMechanism {
    pub label: String,
    pub bodies: Vec<BodyPart>,
    pub joints: Vec<LinkPart>,
    pub forces: Vec<LinkPart>,
    pub traces: Vec<TracePart>,
    pub clip: Clip,
}

impl MovingMechanism {
    /// The motion of a run at these rows.
    pub fn new(run: &ShownMotion, parts: PageParts, rows: &[usize]) -> Self {
        let mut clip = Clip::default();
        rows.iter().for_each(|row| add(&mut clip, run, &parts, *row));
        let PageParts { bodies, joints, forces, traces, .. } = parts;
        MovingMechanism { label: run.label.clone(), bodies, joints, forces, traces, clip }
    }
}

/// Returns the parts of a run that fit into a page with this many numbers.
pub fn fitting_parts(run: &ShownMotion, numbers: usize) -> PageParts {
    let mechanism = &run.prepared.mechanism;
    // A pose, and about one joint a body.
    let of_body = if mechanism.dimension() == 2 { 4 } else { 8 };
    let most = numbers / LEAST_ROWS / of_body;
    PageParts::new(&scene_at(run, 0), &solids(mechanism), &output_traces(mechanism), most)
}

/// Returns how many numbers a row has.
pub fn numbers_of_row(run: &ShownMotion, parts: &PageParts) -> usize {
    let mut clip = Clip::default();
    add(&mut clip, run, parts, 0);
    clip.len()
}

fn state(run: &ShownMotion, row: usize) -> State {
    let row = &run.trajectory.rows[row];
    let (q, v, _) = run.trajectory.row_state(row);
    State { t: row[0], q: q.to_vec(), v: v.to_vec() }
}

/// Returns the mechanism at a row.
pub fn scene_at(run: &ShownMotion, row: usize) -> Snapshot {
    snapshot(&run.prepared.mechanism, &state(run, row))
}

fn add(clip: &mut Clip, run: &ShownMotion, parts: &PageParts, row: usize) {
    let state = state(run, row);
    let (_, _, lambda) = run.trajectory.row_state(&run.trajectory.rows[row]);
    let mechanism = &run.prepared.mechanism;
    clip.add(parts, state.t, &snapshot(mechanism, &state), &reactions(mechanism, &state, lambda));
}
