//! What a place between the ends of a beam element is like.

use super::strain::Strains;
use super::{Beam, Moving};
use crate::body::Frame;
use crate::math::screw::{cross3, exponential};
use crate::math::{Scalar, Taylor};
use std::array::from_fn;

/// A section of a beam: where it is, how it is strained, and what it carries.
///
/// Strains and forces are in the order extension, shear along y and z, twist, curvature about y and z; or axial force,
/// shear forces, torque and bending moments, in the section's axes. They act on the section from the side of larger
/// abscissae; strains are against the relaxed beam.
#[derive(Clone, Debug, PartialEq)]
pub struct Station<S, const D: usize> {
    /// m
    pub r: [S; D],
    /// Strains, without and 1/m.
    pub strain: [S; 6],
    /// N and N m.
    pub force: [S; 6],
}

impl Beam {
    /// The section at `x` from the first end, 0 <= x <= length, with the ends' frames as given.
    ///
    /// A helix has one moment, right in the middle of the element; from there it changes with the shear force, by
    /// M' = -e_x x N. The line follows the helix with the cubic of that change upon it. For small displacements of a beam
    /// that is loaded at its nodes both are exact.
    pub fn station<S: Scalar, const D: usize>(&self, ends: [&Frame<Taylor<S>, D>; 2], x: f64) -> Station<S, D> {
        let [a, b] = ends.map(|frame| frame.map(|x| Moving { re: x.x, eps: [x.d] }));
        let strains = Strains::between(&a, &b);
        let middle = self.strain(&strains);
        let mut strain: [S; 6] = from_fn(|i| middle[i].re - self.rest[i]);
        let mut force: [S; 6] = from_fn(|i| (strain[i] + middle[i].eps[0] * self.damping) * self.stiffness[i]);
        let growth = cross3(&[force[0], force[1], force[2]], &[S::one(), S::zero(), S::zero()]);
        let bent = [strain[1] * self.bent[0], strain[2] * self.bent[1]];
        (strain[1], strain[2]) = (strain[1] - bent[0], strain[2] - bent[1]);
        for i in 4..6 {
            let change = growth[i - 3] * (x - 0.5 * self.length);
            force[i] += change;
            strain[i] += if self.stiffness[i] > 0.0 { change / self.stiffness[i] } else { S::zero() };
        }
        let part = x / self.length;
        // The cubic that is level at both ends, against the line: 3 x^2 - 2 x^3 - x.
        let bulge = part * (part * (3.0 - 2.0 * part) - 1.0) * self.length;
        let (axes, mut r) = exponential(&strains.shift.map(|u| u.re), &strains.turn.map(|a| a.re), part);
        (0..3).for_each(|i| r[i] += (axes[1][i] * bent[0] + axes[2][i] * bent[1]) * bulge);
        let first = ends[0];
        let r = from_fn(|i| (0..D).fold(first.r[i].x, |sum, j| sum + first.axes[j][i].x * r[j]));
        Station { r, strain, force }
    }
}
