//! Places of the values of M, K and C of a flexible body: the pattern is fixed when the body is made.

use crate::body::flexible::{Elastic, MassIntegrals};
use std::collections::BTreeMap;

/// Patterns of M, K and C, and the entry of each contribution.
pub(super) struct FloatingLayout {
    /// Lower triangle of M: the frame's block row by row, the rows coupling elastic coordinates to the frame, then the
    /// others.
    pub mass: Vec<(usize, usize)>,
    /// Places of K and C: the frame's block row by row, for each elastic coordinate its row and its column coupling it
    /// to the frame, then the others.
    pub tangent: Vec<(usize, usize)>,
    nv: usize,
    pub pieces: Vec<PieceLayout>,
    pub discs: Vec<PieceLayout>,
    /// Entries of K, in both triangles, for each entry of the stiffness matrix; `damping` likewise for C.
    pub stiffness: Vec<[usize; 2]>,
    pub damping: Vec<[usize; 2]>,
    /// Entry of M at the place of each entry of the stiffness matrix, if M has one there.
    pub sparing: Vec<Option<usize>>,
    /// Entries of K for the coordinates of each stretch, row by row.
    pub stretches: Vec<Vec<usize>>,
}

/// Places of the entries of one piece or disc.
pub(super) struct PieceLayout {
    /// M: entries of (i, j <= i), row by row.
    pub mass: Vec<usize>,
    /// K and C: entries of (i, j), row by row.
    pub tangent: Vec<usize>,
}

impl FloatingLayout {
    pub fn new<const D: usize>(elastic: &Elastic<D>, nv: usize) -> FloatingLayout {
        let n = elastic.names.len();
        let mut mass = IndexedPlaces::default();
        let mut tangent = IndexedPlaces::default();
        for i in 0..nv + n {
            (0..nv.min(i + 1)).for_each(|j| mass.add(i, j));
            (0..nv).for_each(|j| tangent.add(i, j));
            (0..nv).filter(|_| i >= nv).for_each(|j| tangent.add(j, i));
        }
        let MassIntegrals { pieces, discs } = &elastic.inertia;
        for dofs in pieces.iter().map(|piece| &piece.dofs).chain(discs.iter().map(|disc| &disc.dofs)) {
            each_pair(dofs, |i, j| {
                tangent.add(nv + i, nv + j);
                if j <= i {
                    mass.add(nv + i, nv + j);
                }
            });
        }
        for &(i, j, _) in elastic.stiffness.iter().chain(&elastic.damping) {
            tangent.add(nv + i, nv + j);
            tangent.add(nv + j, nv + i);
        }
        for stretch in &elastic.stretches {
            each_pair(&stretch.dofs, |i, j| tangent.add(nv + i, nv + j));
        }
        let piece = |dofs: &[usize]| {
            let lower = |a: usize, b: usize| if a >= b { (nv + a, nv + b) } else { (nv + b, nv + a) };
            let pairs = (0..dofs.len()).flat_map(|a| (0..=a).map(move |b| (a, b)));
            PieceLayout {
                mass: pairs.map(|(a, b)| lower(dofs[a], dofs[b])).map(|(i, j)| mass.find(i, j)).collect(),
                tangent: block(dofs, nv, &tangent),
            }
        };
        let both = |&(i, j, _): &(usize, usize, f64)| [tangent.find(nv + i, nv + j), tangent.find(nv + j, nv + i)];
        FloatingLayout {
            pieces: pieces.iter().map(|p| piece(&p.dofs)).collect(),
            discs: discs.iter().map(|disc| piece(&disc.dofs)).collect(),
            stiffness: elastic.stiffness.iter().map(both).collect(),
            sparing: elastic.stiffness.iter().map(|&(i, j, _)| mass.get(nv + i, nv + j)).collect(),
            damping: elastic.damping.iter().map(both).collect(),
            stretches: elastic.stretches.iter().map(|stretch| block(&stretch.dofs, nv, &tangent)).collect(),
            mass: mass.list,
            tangent: tangent.list,
            nv,
        }
    }

    /// Entry of M in the frame's block, i >= j.
    pub fn frame_mass(&self, i: usize, j: usize) -> usize {
        i * (i + 1) / 2 + j
    }
    /// Entry of M in the row of elastic coordinate `dof` and the frame's first column.
    pub fn coupling_mass(&self, dof: usize) -> usize {
        self.nv * (self.nv + 1) / 2 + dof * self.nv
    }
    /// Entry of K in the frame's block.
    pub fn frame(&self, i: usize, j: usize) -> usize {
        i * self.nv + j
    }
    /// Entry of K in the row of elastic coordinate `dof`, column `j` of the frame.
    pub fn row(&self, dof: usize, j: usize) -> usize {
        self.nv * self.nv + dof * 2 * self.nv + j
    }
    /// Entry of K in row `i` of the frame, column of elastic coordinate `dof`.
    pub fn column(&self, i: usize, dof: usize) -> usize {
        self.row(dof, self.nv) + i
    }
}

fn each_pair(dofs: &[usize], mut see: impl FnMut(usize, usize)) {
    dofs.iter().for_each(|&i| dofs.iter().for_each(|&j| see(i, j)));
}

fn block(dofs: &[usize], nv: usize, places: &IndexedPlaces) -> Vec<usize> {
    let mut entries = Vec::new();
    each_pair(dofs, |i, j| entries.push(places.find(nv + i, nv + j)));
    entries
}

/// A list of places with an index into it.
#[derive(Default)]
struct IndexedPlaces {
    list: Vec<(usize, usize)>,
    index: BTreeMap<(usize, usize), usize>,
}

impl IndexedPlaces {
    fn add(&mut self, i: usize, j: usize) {
        if let std::collections::btree_map::Entry::Vacant(place) = self.index.entry((i, j)) {
            place.insert(self.list.len());
            self.list.push((i, j));
        }
    }

    fn get(&self, i: usize, j: usize) -> Option<usize> {
        self.index.get(&(i, j)).copied()
    }

    fn find(&self, i: usize, j: usize) -> usize {
        self.index[&(i, j)]
    }
}
