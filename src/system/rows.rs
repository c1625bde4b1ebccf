//! The rows of phi and G that belong to one joint.

use super::Prescribed;
use super::facts::Group;
use super::support::Support;
use crate::joint::Joint;
use crate::math::kkt::Pattern;
use crate::scene::{Connection, Model};
use std::ops::Range;

/// Rows of a joint in phi, and the places of its entries in G.
pub(super) struct JointRows {
    /// Range of its rows in phi.
    pub rows: Range<usize>,
    /// True if phi depends explicitly on t.
    pub rheonomic: bool,
    pub blocks: Vec<JointBlock>,
}

/// Entries of G for one joint and one of its markers: rows x the velocities that move the marker, row by row.
pub(super) struct JointBlock {
    /// Index of the marker in the joint.
    pub slot: usize,
    pub body: usize,
    pub first_entry: usize,
}

impl JointRows {
    /// Adds the joint's entries to the pattern of G, and its rows.
    pub fn new<const D: usize>(supports: &[Support], joint: &Connection<Box<dyn Joint<D>>>, g: &mut Pattern) -> Self {
        let count = joint.element.row_names().len();
        let mut blocks: Vec<JointBlock> = Vec::with_capacity(joint.markers.len());
        for (slot, &marker) in joint.markers.iter().enumerate() {
            let Support { body: Some(body), velocities, .. } = &supports[marker] else { continue };
            if !velocities.is_empty() {
                blocks.push(JointBlock { slot, body: *body, first_entry: g.entries.len() });
                let places = (0..count).flat_map(|i| velocities.iter().map(move |&j| (i, j)));
                g.entries.extend(places.map(|(i, j)| (g.rows + i, j)));
            }
        }
        let first = g.rows;
        g.rows += count;
        JointRows { rows: first..g.rows, rheonomic: joint.element.depends_on_time(), blocks }
    }

    /// Place of its entries in G: the blocks of its markers one after the other.
    pub fn first_entry(&self) -> usize {
        self.blocks.first().map_or(0, |block| block.first_entry)
    }
}

/// The rows of phi by joint.
pub(super) fn groups<const D: usize>(model: &Model<D>, joints: &[JointRows]) -> Vec<Group> {
    let joints = model.joints.iter().zip(joints);
    let group = |(joint, rows): (&Connection<_>, &JointRows)| Group {
        name: joint.name.clone(),
        kind: joint.kind.to_string(),
        rows: rows.rows.clone(),
    };
    joints.map(group).collect()
}

/// The rows that depend on t, with what they prescribe.
pub(super) fn prescribed<const D: usize>(model: &Model<D>, joints: &[JointRows], t: f64) -> Vec<Prescribed> {
    let driven = model.joints.iter().zip(joints).filter(|(joint, _)| joint.element.depends_on_time());
    let rows = driven.flat_map(|(joint, rows)| rows.rows.clone().map(|row| (row, joint.element.prescribed(t))));
    rows.map(|(row, value)| Prescribed { row, value }).collect()
}
