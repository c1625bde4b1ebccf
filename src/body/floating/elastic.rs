//! Elastic forces: K q + D q', and geometric stiffening.

use super::{Floating, frame_coordinates, frame_velocities};
use crate::body::flexible::Stretch;

/// u', w_y' and w_z' at a point of stretch.
struct Slopes {
    axial: f64,
    bending: [f64; 2],
}

impl Slopes {
    fn at(stretch: &Stretch, q: &[f64]) -> Slopes {
        let mut slopes = Slopes { axial: 0.0, bending: [0.0; 2] };
        for (&dof, (axial, bending)) in stretch.dofs.iter().zip(stretch.axial.iter().zip(&stretch.slopes)) {
            slopes.axial += axial * q[dof];
            slopes.bending.iter_mut().zip(bending).for_each(|(sum, slope)| *sum += slope * q[dof]);
        }
        slopes
    }
}

impl<const D: usize> Floating<D> {
    /// f -= K q + D q' + dV/dq with V = sum weight u' (w_y'^2 + w_z'^2)/2 of stiffening.
    pub(super) fn add_elastic_forces(&self, q: &[f64], v: &[f64], f: &mut [f64]) {
        let (q, v) = (&q[frame_coordinates(D)..], &v[frame_velocities(D)..]);
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
            let Slopes { axial, bending: [y, z] } = Slopes::at(stretch, q);
            for (&dof, (a, [by, bz])) in stretch.dofs.iter().zip(stretch.axial.iter().zip(&stretch.slopes)) {
                f[dof] -= stretch.weight * (0.5 * a * (y * y + z * z) + axial * (by * y + bz * z));
            }
        }
    }

    pub(super) fn elastic_energy(&self, q: &[f64]) -> f64 {
        let q = &q[frame_coordinates(D)..];
        let term =
            |&(i, j, value): &(usize, usize, f64)| if i == j { 0.5 * value * q[i] * q[i] } else { value * q[i] * q[j] };
        let stretch = |stretch: &Stretch| {
            let Slopes { axial, bending: [y, z] } = Slopes::at(stretch, q);
            0.5 * stretch.weight * axial * (y * y + z * z)
        };
        self.elastic.stiffness.iter().map(term).sum::<f64>() + self.elastic.stretches.iter().map(stretch).sum::<f64>()
    }

    pub(super) fn add_elastic_tangent(&self, q: &[f64], k: &mut [f64], c: &mut [f64]) {
        let q = &q[frame_coordinates(D)..];
        let stiffness = self.elastic.stiffness.iter().zip(&self.layout.stiffness);
        let damping = self.elastic.damping.iter().zip(&self.layout.damping);
        stiffness.for_each(|(entry, places)| add(entry, places, k));
        damping.for_each(|(entry, places)| add(entry, places, c));
        for (stretch, places) in self.elastic.stretches.iter().zip(&self.layout.stretches) {
            let Slopes { axial, bending: [y, z] } = Slopes::at(stretch, q);
            let n = stretch.dofs.len();
            for i in 0..n {
                let (a, [by, bz]) = (stretch.axial[i], stretch.slopes[i]);
                for j in 0..n {
                    let (a_j, [by_j, bz_j]) = (stretch.axial[j], stretch.slopes[j]);
                    let mixed = a * (by_j * y + bz_j * z) + a_j * (by * y + bz * z);
                    k[places[i * n + j]] += stretch.weight * (mixed + axial * (by * by_j + bz * bz_j));
                }
            }
        }
    }
}

/// Both triangles of a symmetric matrix.
fn add(&(i, j, value): &(usize, usize, f64), &[lower, upper]: &[usize; 2], matrix: &mut [f64]) {
    matrix[lower] += value;
    if i != j {
        matrix[upper] += value;
    }
}
