//! The line of a relaxed beam.

use super::spec::OneOrMany;
use crate::body::{Build, Frame};
use crate::error::{Error, Result};
use crate::math::array::from_fn;
use crate::math::screw::exponential;

/// A line of constant curvature, straight, an arc or a helix, with the axes of its sections: r0' = R0 e_x and
/// R0' = R0 kappa~ from the left end on, in the axes there.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ReferenceLine {
    /// Length, m.
    pub length: f64,
    /// Curvature kappa: twist, about y and about z, 1/m.
    pub curvature: [f64; 3],
}

impl ReferenceLine {
    /// A straight line of the given length, m.
    pub fn straight(length: f64) -> Self {
        ReferenceLine { length, curvature: [0.0; 3] }
    }

    /// True if twist and curvatures are zero.
    pub fn is_straight(&self) -> bool {
        self.curvature == [0.0; 3]
    }

    /// Axes of the section at `s`, and its position, m, both in the axes of the left end.
    pub fn at(&self, s: f64) -> ([[f64; 3]; 3], [f64; 3]) {
        exponential(&[1.0, 0.0, 0.0], &self.curvature, s)
    }

    /// The section at `s` as a frame.
    pub fn section<const D: usize>(&self, s: f64) -> Frame<f64, D> {
        let (axes, r) = self.at(s);
        let turn = if D == 2 { self.curvature[2] * s } else { 0.0 };
        Frame { r: from_fn(|k| r[k]), axes: from_fn(|i| from_fn(|k| axes[i][k])), turn }
    }
}

/// Curvature of a relaxed beam, 1/m: twist, about y and about z.
///
/// # Errors
/// Bad input: not one number in the plane, three in space.
pub fn curvature<const D: usize>(given: Option<&OneOrMany>, build: &Build<D>) -> Result<[f64; 3]> {
    match given {
        None => Ok([0.0; 3]),
        Some(OneOrMany::One(number)) if D == 2 => Ok([0.0, 0.0, build.number("curvature", number)?]),
        Some(OneOrMany::Many(numbers)) if D == 3 => build.vector("curvature", numbers),
        Some(_) => {
            let expected = if D == 2 { "one number" } else { "three numbers: twist, about y and about z" };
            Err(Error::input(format!("expected {expected}")).under("curvature").hint("1/m, of the relaxed beam"))
        }
    }
}
