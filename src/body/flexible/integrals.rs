//! Integrals over a beam from its displacement functions at points of integration.

use super::line::Cross;
use super::profile::Profile;
use super::reference::ReferenceLine;
use super::section::Section;
use super::shape::{Disc, MassIntegrals, Piece, Stretch, Symmetric};
use crate::body::{dot, scale};
use crate::math::array::{Each, from_fn};
use std::collections::BTreeMap;
use std::iter::{once, zip};

/// A point of integration on the line.
pub struct IntegrationPoint {
    /// Axes of the undeformed section, and its position, m.
    rest: ([[f64; 3]; 3], [f64; 3]),
    /// Weight of integration, m.
    pub weight: f64,
    pub section: Section,
    /// True for rotary inertia of sections in bending (Rayleigh); that in torsion is always included.
    rotary: bool,
    /// Displacement functions here, in the order of the piece's coordinates.
    pub shapes: Vec<Cross>,
}

impl IntegrationPoint {
    pub fn new(profile: &Profile, line: &ReferenceLine, s: f64, weight: f64, shapes: Vec<Cross>) -> Self {
        IntegrationPoint { rest: line.at(s), weight, section: profile.at(s), rotary: profile.rotary, shapes }
    }

    /// The rotation that the rotary inertia of a section takes part in.
    fn turn(&self, shape: &Cross) -> [f64; 3] {
        let ([x, ..], _) = &self.rest;
        if self.rotary { shape.rotation } else { scale(x, dot(x, &shape.rotation)) }
    }

    fn disc<const D: usize>(&self, dofs: &[usize]) -> Disc {
        let turns = |turn: &[f64; 3]| if D == 2 { turn[2] != 0.0 } else { *turn != [0.0; 3] };
        let turning = dofs.iter().zip(self.shapes.iter().map(|shape| self.turn(shape))).filter(|(_, turn)| turns(turn));
        let (dofs, rotation) = turning.unzip();
        // int rho z^2 is the moment about y, int rho y^2 that about z.
        let [y, z] = self.section.rho_i.each(|density| density * self.weight);
        let (axes, _) = &self.rest;
        let about =
            |i: usize, j: usize| zip(axes, [y + z, y, z]).map(|(axis, moment)| axis[i] * moment * axis[j]).sum();
        Disc { dofs, rotation, inertia: from_fn(|i| from_fn(|j| about(i, j))) }
    }
}

/// The mass integrals of the line over all samples.
pub fn piece<const D: usize>(dofs: Vec<usize>, samples: &[IntegrationPoint]) -> Piece<D> {
    let mut piece = Piece::massless(dofs);
    for sample in samples {
        let displacements = sample.shapes.iter().map(|shape| shape.displacement);
        let psi: Vec<_> = once(sample.rest.1).chain(displacements).collect();
        piece.add_point(&psi, sample.weight * sample.section.rho_a);
    }
    piece
}

/// Discs of the sections at all samples; those that do not rotate are summed to one.
pub fn discs<const D: usize>(dofs: &[usize], samples: &[IntegrationPoint]) -> Vec<Disc> {
    let discs = samples.iter().map(|sample| sample.disc::<D>(dofs));
    let (fixed, mut turning): (Vec<_>, Vec<_>) = discs.partition(|disc| disc.dofs.is_empty());
    let whole = fixed
        .into_iter()
        .reduce(|sum, disc| Disc { inertia: from_fn(|i| from_fn(|j| sum.inertia[i][j] + disc.inertia[i][j])), ..sum });
    turning.extend(whole);
    turning.retain(|disc| disc.inertia != [[0.0; 3]; 3]);
    turning
}

/// A symmetric sparse matrix under assembly, ordered by place.
#[derive(Default)]
pub struct EntrySum(BTreeMap<(usize, usize), f64>);

impl EntrySum {
    /// Adds to (i, j) and (j, i), which are one place.
    pub fn add(&mut self, i: usize, j: usize, value: f64) {
        *self.0.entry((i.max(j), i.min(j))).or_insert(0.0) += value;
    }

    pub fn add_all(&mut self, factor: f64, matrix: &Symmetric) {
        matrix.iter().for_each(|&(i, j, value)| self.add(i, j, factor * value));
    }

    pub fn finish(self) -> Symmetric {
        self.0.into_iter().filter(|(_, value)| *value != 0.0).map(|((i, j), value)| (i, j, value)).collect()
    }
}

/// int strains^T stiffness strains over the samples, added to `sum`.
pub fn add_stiffness(sum: &mut EntrySum, dofs: &[usize], samples: &[IntegrationPoint]) {
    for sample in samples {
        let stiffness = sample.section.stiffness();
        for (a, left) in sample.shapes.iter().enumerate() {
            for (b, right) in sample.shapes.iter().enumerate().take(a + 1) {
                let energy: f64 = (0..6).map(|k| stiffness[k] * left.strain[k] * right.strain[k]).sum();
                if energy != 0.0 {
                    sum.add(dofs[a], dofs[b], sample.weight * energy);
                }
            }
        }
    }
}

/// Geometric stiffening of the part of the line from the abscissa `start` on, by means over samples; it has only the
/// coordinates that stretch or rotate the line there.
pub fn stretch(quartic: f64, start: f64, dofs: &[usize], samples: &[IntegrationPoint]) -> Stretch {
    let counts = |i: &usize| {
        samples.iter().map(|sample| &sample.shapes[*i]).any(|shape| shape.strain[0] != 0.0 || shape.slope != [0.0; 2])
    };
    let used: Vec<usize> = (0..dofs.len()).filter(counts).collect();
    let length: f64 = samples.iter().map(|sample| sample.weight).sum();
    let mean = |of: &dyn Fn(&[Cross]) -> f64| {
        samples.iter().map(|sample| sample.weight * of(&sample.shapes)).sum::<f64>() / length
    };
    let product = |i: usize, j: usize| mean(&|shapes| (0..2).map(|k| shapes[i].slope[k] * shapes[j].slope[k]).sum());
    Stretch {
        ends: [start, start + length],
        dofs: used.iter().map(|&i| dofs[i]).collect(),
        weight: samples.iter().map(|sample| sample.section.ea * sample.weight).sum(),
        quartic,
        axial: used.iter().map(|&i| mean(&|shapes| shapes[i].strain[0])).collect(),
        slopes: used.iter().flat_map(|&i| used.iter().map(move |&j| (i, j))).map(|(i, j)| product(i, j)).collect(),
    }
}

/// The elastic mass matrix of the undeformed body: M_ij = tr P_ij + sum r_i.J r_j of the discs.
pub fn mass_matrix<const D: usize>(inertia: &MassIntegrals<D>) -> Symmetric {
    let mut sum = EntrySum::default();
    for piece in &inertia.pieces {
        let n = 1 + piece.dofs.len();
        add_pairs(&mut sum, &piece.dofs, |a, b| {
            let product = &piece.products[(a + 1) * n + b + 1];
            (0..D).map(|k| product[k][k]).sum()
        });
    }
    for disc in &inertia.discs {
        add_pairs(&mut sum, &disc.dofs, |a, b| {
            let [left, right] = [disc.rotation[a], disc.rotation[b]];
            (0..3).map(|i| left[i] * dot(&disc.inertia[i], &right)).sum()
        });
    }
    sum.finish()
}

fn add_pairs(sum: &mut EntrySum, dofs: &[usize], value: impl Fn(usize, usize) -> f64) {
    for (a, &i) in dofs.iter().enumerate() {
        for (b, &j) in dofs.iter().enumerate().take(a + 1) {
            let value = value(a, b);
            if value != 0.0 {
                sum.add(i, j, value);
            }
        }
    }
}
