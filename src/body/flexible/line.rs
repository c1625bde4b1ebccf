//! The line of a beam: what descriptions of its displacements by elements, functions and modes share.
//!
//! Displacements (u, w_y, w_z) of the line and rotations (r_x, r_y, r_z) of its sections are small. With ' = d/ds:
//!
//! ```text
//! extension u',  shear w_y' - r_z and w_z' + r_y,  twist r_x',  curvatures r_y' and r_z'
//! strain of the fibre at (y, z):  u' - y r_z' + z r_y'
//! ```
//!
//! so that where sections stay square to the line r_z = w_y' and r_y = -w_z'. On a line that is curved at rest strains
//! and slopes are in the axes of its elements, displacements and rotations in those of the floating frame.

use super::profile::Profile;
use super::reference::ReferenceLine;
use super::shape::MassIntegrals;

/// Displacement, rotation and strain of one section per unit of one coordinate.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Cross {
    /// Displacement of the line: u, w_y, w_z if it is straight.
    pub displacement: [f64; 3],
    /// Small rotation r_x, r_y, r_z.
    pub rotation: [f64; 3],
    /// Strains in the order of [`SectionShape::strains`](super::SectionShape::strains).
    pub strain: [f64; 6],
    /// Slopes w_y', w_z'.
    pub slope: [f64; 2],
}

impl Cross {
    /// Axial displacement u with slope u'.
    pub fn axial(u: f64, slope: f64) -> Self {
        Cross { displacement: [u, 0.0, 0.0], strain: [slope, 0.0, 0.0, 0.0, 0.0, 0.0], ..Self::default() }
    }

    /// Rotation about the line by an angle with slope r_x'.
    pub fn torsion(angle: f64, slope: f64) -> Self {
        Cross { rotation: [angle, 0.0, 0.0], strain: [0.0, 0.0, 0.0, slope, 0.0, 0.0], ..Self::default() }
    }

    /// Bending along y: r_z is the section's rotation.
    pub fn bending_y(Bending { w, slope, turn, turn_rate }: Bending) -> Self {
        Cross {
            displacement: [0.0, w, 0.0],
            rotation: [0.0, 0.0, turn],
            strain: [0.0, slope - turn, 0.0, 0.0, 0.0, turn_rate],
            slope: [slope, 0.0],
        }
    }

    /// Bending along z: r_y is minus the section's rotation.
    pub fn bending_z(Bending { w, slope, turn, turn_rate }: Bending) -> Self {
        Cross {
            displacement: [0.0, 0.0, w],
            rotation: [0.0, -turn, 0.0],
            strain: [0.0, 0.0, slope - turn, 0.0, -turn_rate, 0.0],
            slope: [0.0, slope],
        }
    }

    /// self += factor other
    pub fn add(&mut self, factor: f64, other: &Cross) {
        let into = |a: &mut [f64], b: &[f64]| a.iter_mut().zip(b).for_each(|(a, b)| *a += factor * b);
        into(&mut self.displacement, &other.displacement);
        into(&mut self.rotation, &other.rotation);
        into(&mut self.strain, &other.strain);
        into(&mut self.slope, &other.slope);
    }

    pub fn scaled(&self, factor: f64) -> Self {
        let mut scaled = Cross::default();
        scaled.add(factor, self);
        scaled
    }
}

/// Bending in one plane: deflection w, its slope w', rotation of the section (the slope if there is no shear) and its
/// derivative.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Bending {
    pub w: f64,
    pub slope: f64,
    pub turn: f64,
    pub turn_rate: f64,
}

/// Displacement functions at a section, with the coordinates that they belong to.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Station {
    pub dofs: Vec<usize>,
    pub shapes: Vec<Cross>,
}

/// Displacement functions of the line of a beam.
pub trait Shapes: Send + Sync {
    fn reference(&self) -> &ReferenceLine;
    /// Displacement functions at 0 <= s <= length.
    fn at(&self, s: f64) -> Station;
    /// Abscissae between which the functions are smooth, both ends included.
    fn breaks(&self) -> Vec<f64>;
    fn profile(&self) -> &Profile;
    /// True if the line keeps its length as it bends. Default: false.
    fn shortens(&self) -> bool {
        false
    }
    /// The mass from `s` on, without second-order terms of shortening; one piece of all coordinates if the line
    /// shortens.
    fn inertia<const D: usize>(&self, s: f64) -> MassIntegrals<D>;
}
