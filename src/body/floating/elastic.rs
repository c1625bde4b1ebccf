//! Elastic forces: K q + D q', and geometric stiffening.

use super::{Floating, frame_coordinates, frame_velocities};
use crate::body::flexible::{Stretch, Symmetric};
use crate::math::Scalar;

/// The mean extension a.q and mean squared slope q.S q of a stretch.
struct Means<S> {
    axial: S,
    squared: S,
}

impl<S: Scalar> Means<S> {
    fn at(stretch: &Stretch, q: &[S]) -> Self {
        let axial = stretch.dofs.iter().zip(&stretch.axial);
        let axial = axial.fold(S::zero(), |sum, (&dof, a)| sum + q[dof] * *a);
        let squared = stretch.dofs.iter().enumerate();
        let squared = squared.fold(S::zero(), |sum, (i, &dof)| sum + q[dof] * steepness(stretch, i, q));
        Means { axial, squared }
    }
}

/// Component i of S q.
fn steepness<S: Scalar>(stretch: &Stretch, i: usize, q: &[S]) -> S {
    let n = stretch.dofs.len();
    let row = stretch.slopes[i * n..(i + 1) * n].iter().zip(&stretch.dofs);
    row.fold(S::zero(), |sum, (s, &dof)| sum + q[dof] * *s)
}

impl<const D: usize> Floating<D> {
    /// f -= K q + D q' + dV/dq, with V = sum weight (a.q q.S q + quartic (q.S q)^2/4)/2 of geometric stiffening.
    pub(super) fn add_elastic_forces(&self, q: &[f64], v: &[f64], f: &mut [f64]) {
        let q = &q[frame_coordinates(D)..];
        let v = &v[frame_velocities(D)..];
        let f = &mut f[frame_velocities(D)..];
        for (matrix, x) in [(&self.elastic.stiffness, q), (&self.elastic.damping, v)] {
            for &(i, j, value) in matrix {
                f[i] -= value * x[j];
                if i != j {
                    f[j] -= value * x[i];
                }
            }
        }
        for stretch in &self.elastic.stretches {
            let Means { axial, squared } = Means::at(stretch, q);
            for (i, (&dof, a)) in stretch.dofs.iter().zip(&stretch.axial).enumerate() {
                let bending = (axial + 0.5 * stretch.quartic * squared) * steepness(stretch, i, q);
                f[dof] -= stretch.weight * (0.5 * a * squared + bending);
            }
        }
    }

    pub(super) fn elastic_energy<S: Scalar>(&self, q: &[S]) -> S {
        let q = &q[frame_coordinates(D)..];
        let stretch = |stretch: &Stretch| {
            let Means { axial, squared } = Means::at(stretch, q);
            (axial + squared * (0.25 * stretch.quartic)) * squared * (0.5 * stretch.weight)
        };
        self.elastic.stretches.iter().fold(half_square(&self.elastic.stiffness, q), |sum, s| sum + stretch(s))
    }

    pub(super) fn add_elastic_tangent(&self, q: &[f64], k: &mut [f64], c: &mut [f64]) {
        let q = &q[frame_coordinates(D)..];
        let stiffness = self.elastic.stiffness.iter().zip(&self.layout.stiffness);
        let damping = self.elastic.damping.iter().zip(&self.layout.damping);
        stiffness.for_each(|(entry, places)| add(entry, places, k));
        damping.for_each(|(entry, places)| add(entry, places, c));
        for (stretch, places) in self.elastic.stretches.iter().zip(&self.layout.stretches) {
            let Means { axial, squared } = Means::at(stretch, q);
            let n = stretch.dofs.len();
            for i in 0..n {
                let a = stretch.axial[i];
                let steep = steepness(stretch, i, q);
                for j in 0..n {
                    let other = steepness(stretch, j, q);
                    let mixed = a * other + stretch.axial[j] * steep + stretch.quartic * steep * other;
                    let force = (axial + 0.5 * stretch.quartic * squared) * stretch.slopes[i * n + j];
                    k[places[i * n + j]] += stretch.weight * (mixed + force);
                }
            }
        }
    }
}

/// Quadratic form x.A x/2.
pub(super) fn half_square<S: Scalar>(matrix: &Symmetric, x: &[S]) -> S {
    let factor = |i: usize, j: usize| if i == j { 0.5 } else { 1.0 };
    matrix.iter().fold(S::zero(), |sum, &(i, j, value)| sum + x[i] * x[j] * (factor(i, j) * value))
}

/// Adds an entry to both triangles of a symmetric matrix.
fn add(entry: &(usize, usize, f64), places: &[usize; 2], matrix: &mut [f64]) {
    let (i, j, value) = *entry;
    let [lower, upper] = *places;
    matrix[lower] += value;
    if i != j {
        matrix[upper] += value;
    }
}
