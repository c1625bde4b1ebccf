//! Places of the entries of K and C: a block for each body, and one for each pair of bodies that an element joins.

use super::evaluate::RigidParts;
use super::support::Support;
use crate::joint::Joint;
use crate::math::kkt::Pattern;
use crate::scene::{Connection, Model};
use std::ops::Range;

/// Places of the blocks of all bodies, joints and forces.
pub(super) struct Couplings {
    pub bodies: Vec<Range<usize>>,
    pub joints: Vec<Coupling>,
    pub forces: Vec<Coupling>,
}

/// Blocks of one joint or force: the bodies that carry its markers, and the blocks of their pairs, column by column.
pub(super) struct Coupling {
    pub carriers: Vec<Carrier>,
    blocks: Vec<Block>,
}

/// A body that carries markers of an element.
pub(super) struct Carrier {
    pub body: usize,
    /// The velocities of the system that move any of the element's markers on this body.
    pub velocities: Vec<usize>,
    pub markers: Vec<Held>,
}

/// One marker of an element on its carrier.
pub(super) struct Held {
    /// Index of the marker in the element.
    pub slot: usize,
    /// Places of the marker's velocities among those of the carrier.
    pub places: Vec<usize>,
}

/// d(forces on the velocities of a row's carrier)/d(velocity directions of a column's carrier), row by row.
pub(super) struct Block {
    pub first_entry: usize,
    pub width: usize,
}

impl Couplings {
    pub fn new<const D: usize>(
        model: &Model<D>,
        supports: &[Support],
        rigid: &RigidParts<D>,
        pattern: &mut Pattern,
    ) -> Self {
        let own = |part: &crate::scene::Part<D>| {
            let first = pattern.entries.len();
            let places = part.body.tangent_pattern().into_iter();
            pattern.entries.extend(places.map(|(i, j)| (part.first_v + i, part.first_v + j)));
            first..pattern.entries.len()
        };
        let bodies = model.bodies.iter().map(own).collect();
        let mut coupling = |carriers: Vec<Carrier>, is_joined: bool| Coupling::new(carriers, is_joined, pattern);
        let joint = |(i, joint): (usize, &Connection<Box<dyn Joint<D>>>)| {
            let mut carriers = Carrier::all(&joint.markers, supports);
            let Some(lock) = rigid.lock(model, i) else { return coupling(carriers, true) };
            if lock.changes_with_rotations() {
                carriers.iter_mut().for_each(|carrier| carrier.keep_rotations(rigid));
            }
            coupling(carriers, lock.couples_bodies())
        };
        let joints = model.joints.iter().enumerate().map(joint).collect();
        let forces = model.forces.iter().map(|force| coupling(Carrier::all(&force.markers, supports), true)).collect();
        Couplings { bodies, joints, forces }
    }
}

impl Coupling {
    /// The blocks of these bodies; of each with itself alone unless they are joined.
    fn new(carriers: Vec<Carrier>, is_joined: bool, pattern: &mut Pattern) -> Self {
        let mut blocks = Vec::new();
        for column in &carriers {
            for row in &carriers {
                blocks.push(Block { first_entry: pattern.entries.len(), width: column.velocities.len() });
                let rows = if is_joined || row.body == column.body { &row.velocities[..] } else { &[] };
                let places = rows.iter().flat_map(|&i| column.velocities.iter().map(move |&j| (i, j)));
                pattern.entries.extend(places);
            }
        }
        Coupling { carriers, blocks }
    }

    /// The blocks of one column, one for each row.
    pub fn column(&self, column: usize) -> &[Block] {
        let n = self.carriers.len();
        &self.blocks[column * n..(column + 1) * n]
    }
}

impl Carrier {
    /// The bodies that carry these markers, in the order of the model.
    pub fn all(markers: &[usize], supports: &[Support]) -> Vec<Carrier> {
        let mut bodies: Vec<usize> = markers.iter().filter_map(|&marker| supports[marker].body).collect();
        bodies.sort_unstable();
        bodies.dedup();
        bodies.into_iter().map(|body| Carrier::new(body, markers, supports)).collect()
    }

    /// Leaves the translations of a rigid body out, which come first.
    fn keep_rotations<const D: usize>(&mut self, rigid: &RigidParts<D>) {
        let translations = rigid.freedoms[self.body].as_ref().map_or(0, |freedom| freedom.translations.len());
        self.velocities.drain(..translations);
    }

    fn new(body: usize, markers: &[usize], supports: &[Support]) -> Self {
        let own = || markers.iter().enumerate().filter(|(_, marker)| supports[**marker].body == Some(body));
        let mut velocities: Vec<usize> = own().flat_map(|(_, &marker)| supports[marker].velocities.clone()).collect();
        velocities.sort_unstable();
        velocities.dedup();
        let held = |(slot, &marker): (usize, &usize)| {
            let places = supports[marker].velocities.iter();
            Held { slot, places: places.filter_map(|velocity| velocities.binary_search(velocity).ok()).collect() }
        };
        let markers = own().map(held).collect();
        Carrier { body, velocities, markers }
    }
}
