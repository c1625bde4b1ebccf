//! The integrals over a beam that the equations of motion need, from its shapes at points of integration.

use super::line::Cross;
use super::profile::Profile;
use super::section::Section;
use super::shape::{Piece, Second, Stretch, Symmetric};
use crate::body::cross;
use std::array::from_fn;
use std::collections::BTreeMap;

/// A point of integration on the line.
pub struct Sample {
    pub s: f64,
    /// m
    pub weight: f64,
    pub section: Section,
    pub inertia: Inertia,
    /// What the coordinates do here, in the order of the piece's.
    pub shapes: Vec<Cross>,
}

impl Sample {
    pub fn new(profile: &Profile, (s, weight): (f64, f64), shapes: Vec<Cross>) -> Self {
        let section = profile.at(s);
        let inertia = Inertia { rho_a: section.rho_a, rho_i: section.rho_i, rotary: profile.rotary };
        Sample { s, weight, section, inertia, shapes }
    }
}

/// How the mass of a section counts.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Inertia {
    pub rho_a: f64,
    /// About y and z.
    pub rho_i: [f64; 2],
    /// Whether sections that bending turns have inertia (Rayleigh); those that twist always have.
    pub rotary: bool,
}

impl Inertia {
    /// The turn that moves the mass of a section.
    fn turn(&self, shape: &Cross) -> [f64; 3] {
        let [rx, ry, rz] = shape.rotation;
        if self.rotary { [rx, ry, rz] } else { [rx, 0.0, 0.0] }
    }

    /// psi at the point (y, z) of a section is [0] + y [1] + z [2], as the rotation r moves it by r x (0, y, z) ...
    fn shape<const D: usize>(&self, shape: &Cross) -> [[f64; D]; 3] {
        let [rx, ry, rz] = self.turn(shape);
        [shape.displacement, [-rz, 0.0, rx], [ry, -rx, 0.0]].map(|v| from_fn(|k| v[k]))
    }

    /// ... and to second order by r x (r x (0, y, z))/2.
    fn second<const D: usize>(&self, left: &Cross, right: &Cross) -> [[f64; D]; 3] {
        let [left, right] = [left, right].map(|shape| self.turn(shape));
        let turned = |unit: [f64; 3]| {
            let [once, twice] = [cross(&left, &cross(&right, &unit)), cross(&right, &cross(&left, &unit))];
            from_fn(|k| (once[k] + twice[k]) / 2.0)
        };
        [[0.0; D], turned([0.0, 1.0, 0.0]), turned([0.0, 0.0, 1.0])]
    }

    /// psi_0 = (s, y, z)
    fn rest<const D: usize>(s: f64) -> [[f64; D]; 3] {
        [[s, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]].map(|v| from_fn(|k| v[k]))
    }

    /// int rho, int rho y^2 and int rho z^2 a length.
    fn densities(&self) -> [f64; 3] {
        [self.rho_a, self.rho_i[1], self.rho_i[0]]
    }

    fn add<const D: usize>(&self, piece: &mut Piece<D>, psi: &[[[f64; D]; 3]], weight: f64) {
        let densities = self.densities().map(|density| density * weight);
        piece.mass += densities[0];
        for (a, left) in psi.iter().enumerate() {
            (0..D).for_each(|k| piece.moments[a][k] += densities[0] * left[0][k]);
            for (b, right) in psi.iter().enumerate() {
                let product = &mut piece.products[a * psi.len() + b];
                for ((density, l), r) in densities.iter().zip(left).zip(right) {
                    (0..D).for_each(|k| (0..D).for_each(|m| product[k][m] += density * l[k] * r[m]));
                }
            }
        }
    }
}

/// The mass integrals over all samples. Axes of the section are principal ones, so that int rho y = int rho z =
/// int rho y z = 0, int rho y^2 is the moment of inertia about z and int rho z^2 that about y.
pub fn piece<const D: usize>(dofs: Vec<usize>, samples: &[Sample]) -> Piece<D> {
    let n = 1 + dofs.len();
    let mut piece =
        Piece { dofs, mass: 0.0, moments: vec![[0.0; D]; n], products: vec![[[0.0; D]; D]; n * n], second: Vec::new() };
    for Sample { s, weight, inertia, shapes, .. } in samples {
        let shapes = shapes.iter().map(|shape| inertia.shape::<D>(shape));
        let psi: Vec<_> = std::iter::once(Inertia::rest(*s)).chain(shapes).collect();
        inertia.add(&mut piece, &psi, *weight);
    }
    piece.second = (1..n).map(|i| second_of(i - 1, samples)).collect();
    piece
}

/// The integrals of psi_ij for all j.
fn second_of<const D: usize>(i: usize, samples: &[Sample]) -> Vec<Second<D>> {
    let count = samples.first().map_or(0, |sample| sample.shapes.len());
    let integral = |other: usize| {
        let mut second = Second { other, moment: [0.0; D], product: [[0.0; D]; D] };
        for Sample { s, weight, inertia, shapes, .. } in samples {
            let [rest, psi] = [Inertia::rest::<D>(*s), inertia.second(&shapes[i], &shapes[other])];
            for ((density, r), p) in inertia.densities().iter().zip(&rest).zip(&psi) {
                (0..D).for_each(|k| (0..D).for_each(|m| second.product[k][m] += density * weight * r[k] * p[m]));
            }
        }
        second
    };
    (0..count).map(integral).filter(Second::counts).collect()
}

/// Entries of a symmetric matrix, added up in their places; in the order of the places.
#[derive(Default)]
pub struct Sum(BTreeMap<(usize, usize), f64>);

impl Sum {
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
pub fn add_stiffness(sum: &mut Sum, dofs: &[usize], samples: &[Sample]) {
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

/// Geometric stiffening from the abscissa `start` on, by the means over samples; only the coordinates that stretch or turn the line there.
pub fn stretch(quartic: f64, start: f64, dofs: &[usize], samples: &[Sample]) -> Stretch {
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

/// The elastic mass matrix, M_ij = tr P_ij.
pub fn mass_matrix<const D: usize>(pieces: &[Piece<D>]) -> Symmetric {
    let mut sum = Sum::default();
    for piece in pieces {
        let n = 1 + piece.dofs.len();
        for (a, &i) in piece.dofs.iter().enumerate() {
            for (b, &j) in piece.dofs.iter().enumerate().take(a + 1) {
                let product = &piece.products[(a + 1) * n + b + 1];
                let trace: f64 = (0..D).map(|k| product[k][k]).sum();
                if trace != 0.0 {
                    sum.add(i, j, trace);
                }
            }
        }
    }
    sum.finish()
}
