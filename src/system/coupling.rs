//! Places of the entries of K and C: a block for each body, and one for each pair of bodies that an element joins.

use super::layout::Layout;
use super::support::Support;
use crate::joint::Lock;
use crate::math::array::from_fn;
use crate::math::kkt::Pattern;
use crate::scene::Connection;
use std::ops::Range;

/// Places of the blocks of all bodies, joints and forces.
pub(super) struct Couplings {
    pub bodies: Vec<Range<usize>>,
    /// Those of joints in closed form.
    pub locked: Vec<LockedBlocks>,
    /// Those of all other joints, with their indices.
    pub joints: Vec<(usize, ElementCoupling)>,
    pub forces: Vec<ElementCoupling>,
}

/// Places of the blocks of K of a joint that locks motions of two rigid bodies, row by row: of their rotations alone
/// where others do not change its forces.
pub(super) struct LockedBlocks {
    pub joint: usize,
    /// The first entry of each block, by the slots of the markers: `first[row][column]`.
    pub first: [[Option<usize>; 2]; 2],
}

/// Blocks of one joint or force: the bodies that carry its markers, and the blocks of their pairs, column by column.
pub(super) struct ElementCoupling {
    pub carriers: Vec<Carrier>,
    blocks: Vec<CouplingBlock>,
}

/// A body that carries markers of an element.
pub(super) struct Carrier {
    pub body: usize,
    /// The velocities of the system that move any of the element's markers on this body.
    pub velocities: Vec<usize>,
    pub markers: Vec<CarriedMarker>,
}

/// One marker of an element on its carrier.
pub(super) struct CarriedMarker {
    /// Index of the marker in the element.
    pub slot: usize,
    /// Places of the marker's velocities among those of the carrier.
    pub places: Vec<usize>,
}

/// d(forces on the velocities of a row's carrier)/d(velocity directions of a column's carrier), row by row.
pub(super) struct CouplingBlock {
    pub first_entry: usize,
    pub width: usize,
}

impl Couplings {
    pub fn new<const D: usize>(layout: &Layout<D>, pattern: &mut Pattern) -> Self {
        let Layout { model, supports, .. } = layout;
        let own = |part: &crate::scene::Part<D>| {
            let first = pattern.entries.len();
            let places = part.facts.tangent_pattern.iter();
            pattern.entries.extend(places.map(|&(i, j)| (part.first_v + i, part.first_v + j)));
            first..pattern.entries.len()
        };
        let bodies = model.bodies.iter().map(own).collect();
        let mut locked = Vec::new();
        let mut joints = Vec::new();
        for (joint, Connection { markers, .. }) in model.joints.iter().enumerate() {
            match layout.lock(joint) {
                Some(lock) => locked.push(LockedBlocks::new(layout, joint, lock, pattern)),
                None => joints.push((joint, ElementCoupling::new(markers, supports, pattern))),
            }
        }
        let forces = model.forces.iter().map(|force| ElementCoupling::new(&force.markers, supports, pattern)).collect();
        Couplings { bodies, locked, joints, forces }
    }
}

impl LockedBlocks {
    fn new<const D: usize>(layout: &Layout<D>, joint: usize, lock: &Lock<D>, pattern: &mut Pattern) -> Self {
        let model = &layout.model;
        let velocities = |slot: usize| {
            let body = model.markers.bodies[model.joints[joint].markers[slot]]?;
            let first = model.bodies[body].first_v;
            let freedom = layout.freedoms[body].as_ref()?;
            let skipped = if lock.changes_with_rotations() { freedom.translations.len() } else { 0 };
            Some(first + skipped..first + freedom.count())
        };
        let sides = [velocities(0), velocities(1)];
        let mut block = |row: usize, column: usize| {
            let is_there = row == column || lock.couples_bodies();
            let rows = sides[row].clone().filter(|_| is_there)?;
            let columns = sides[column].clone()?;
            let first = pattern.entries.len();
            pattern.entries.extend(rows.flat_map(|i| columns.clone().map(move |j| (i, j))));
            Some(first)
        };
        LockedBlocks { joint, first: from_fn(|row| from_fn(|column| block(row, column))) }
    }
}

impl ElementCoupling {
    fn new(markers: &[usize], supports: &[Support], pattern: &mut Pattern) -> Self {
        let carriers = Carrier::all(markers, supports);
        let mut blocks = Vec::new();
        for column in &carriers {
            for row in &carriers {
                blocks.push(CouplingBlock { first_entry: pattern.entries.len(), width: column.velocities.len() });
                let places = row.velocities.iter().flat_map(|&i| column.velocities.iter().map(move |&j| (i, j)));
                pattern.entries.extend(places);
            }
        }
        ElementCoupling { carriers, blocks }
    }

    /// The blocks of one column, one for each row.
    pub fn column(&self, column: usize) -> &[CouplingBlock] {
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

    fn new(body: usize, markers: &[usize], supports: &[Support]) -> Self {
        let own = || markers.iter().enumerate().filter(|(_, marker)| supports[**marker].body == Some(body));
        let mut velocities: Vec<usize> = own().flat_map(|(_, &marker)| supports[marker].velocities.clone()).collect();
        velocities.sort_unstable();
        velocities.dedup();
        let held = |(slot, &marker): (usize, &usize)| {
            let places = supports[marker].velocities.iter();
            CarriedMarker {
                slot,
                places: places.filter_map(|velocity| velocities.binary_search(velocity).ok()).collect(),
            }
        };
        let markers = own().map(held).collect();
        Carrier { body, velocities, markers }
    }
}
