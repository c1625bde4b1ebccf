//! Parts whose theory is valid up to some deformation only.

use std::f64::consts::PI;

/// Part of the energy of bending that elements miss, of order 2 in their length, that a finer mesh aims at. Unit:
/// `[1]`.
const MESH_AIM: f64 = 0.02;

/// Assumption of a part about its deformation.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Theory {
    /// Displacements in a floating frame are small against the length: they enter the elastic forces linearly.
    SmallDisplacements,
    /// Bending moments in a floating frame in space are small against those at which the beam buckles sideways: the
    /// softening of lateral bending and twist together is neglected.
    SmallMoments,
    /// Axial forces in a floating frame are small against the Euler load, where their stiffening of bending is
    /// neglected.
    SmallAxialForces,
    /// The rotation of a bushing in space is small against a radian.
    SmallRotations,
    /// The ends of an element rotate relative to each other by less than pi in space, 2 pi in the plane.
    Helix {
        /// 2 or 3.
        dimension: usize,
        /// Number of elements of the beam.
        elements: usize,
    },
    /// The curvature of a beam changes little between neighbouring elements, each of which has a constant one.
    Mesh {
        /// Number of elements of the beam.
        elements: usize,
    },
}

/// A part whose theory has a limit.
#[derive(Clone, Debug, PartialEq)]
pub struct Limited {
    /// Name in the scene, such as `rod`.
    pub part: String,
    /// The assumption that limits it.
    pub theory: Theory,
}

impl Theory {
    /// The deformation up to which the theory is valid: displacement over length, load over critical load, or rad. A
    /// cantilever that bends by a tenth of its length under a load at its tip is off by 1 % of that.
    pub fn most(self) -> f64 {
        match self {
            Theory::SmallDisplacements => 0.1,
            // Part of the critical loads. Lateral stiffness falls with the square of the moment, bending stiffness with
            // the force itself: the crank of the IVP test set reaches 0.22 and is simulated without the effect.
            Theory::SmallMoments | Theory::SmallAxialForces => 0.3,
            // The sine is 4 % less than the angle.
            Theory::SmallRotations => 0.5,
            // Below the limits of 2 pi and pi, with a margin since the observed states may be some way apart.
            Theory::Helix { dimension: 2, .. } => 1.5 * PI,
            Theory::Helix { .. } => 0.75 * PI,
            // A rubber pendulum of 12 elements, off by 6 % in places, reaches 18 %.
            Theory::Mesh { .. } => 0.1,
        }
    }

    /// Number of elements needed. Helix: none rotates by more than pi/2 where one of the present elements rotates by
    /// `turn`, rad. Mesh: the error falls to the aim where it is `turn` now. Otherwise 0.
    pub fn elements_for(self, turn: f64) -> usize {
        match self {
            // A quarter turn may be passed by so much of it.
            Theory::Helix { elements, .. } => (elements as f64 * turn / (0.5 * PI) - 0.01).ceil() as usize,
            Theory::Mesh { elements } => (elements as f64 * (turn / MESH_AIM).sqrt()).ceil() as usize,
            _ => 0,
        }
    }
}
