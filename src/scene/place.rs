//! Places on beams that outputs watch.

use super::model::Reading;
use crate::body::flexible::{Inertia, PointShape};
use crate::body::{Frame, Marker, MarkerId, dot, sub};
use crate::force::{Beam, Half, Load, Station};
use crate::math::{Scalar, Taylor};

/// A place on an element of an absolute beam, or on a massless one.
pub struct Place {
    pub element: Beam,
    pub ends: [MarkerId; 2],
    /// The mass beside the ends.
    pub halves: [Half; 2],
    /// Deflections are in the axes of this frame and from its origin.
    pub own: MarkerId,
    /// From the first end, m.
    pub x: f64,
    pub reading: Reading,
}

impl Place {
    /// Whether inertia is in what is read.
    pub fn feels_acceleration(&self) -> bool {
        !matches!(self.reading, Reading::Deflection { .. }) && self.halves.iter().any(|half| half.mass > 0.0)
    }

    /// The markers that are read.
    pub fn markers(&self) -> [MarkerId; 3] {
        [self.ends[0], self.ends[1], self.own]
    }

    pub fn read<S: Scalar, const D: usize>(
        &self,
        gravity: &[f64; D],
        frame: impl Fn(MarkerId) -> Frame<Taylor<S>, D>,
    ) -> S {
        let ends = self.ends.map(&frame);
        if let Reading::Deflection { axis, rest } = self.reading {
            let own = frame(self.own).map(|x| x.x);
            let Station { r, .. } = self.element.station(ends.each_ref(), self.x);
            return dot(&own.axes[axis], &sub(&r, &own.r)) - rest;
        }
        let loads: [Load<S>; 2] = std::array::from_fn(|i| self.halves[i].load(&ends[i], gravity));
        let Station { elastic, force, .. } = self.element.loaded_station(ends.each_ref(), &loads, self.x);
        match self.reading {
            Reading::Strain(factors) => elastic.iter().zip(factors).fold(S::zero(), |sum, (&x, f)| sum + x * f),
            Reading::Force(component) => force[component],
            Reading::Deflection { .. } => S::zero(),
        }
    }
}

/// A section of a beam in a floating frame, with all that acts on the body from there on to larger abscissae.
pub struct Cut<const D: usize> {
    /// Index among the bodies of the model.
    pub body: usize,
    /// Abscissa, m.
    pub at: f64,
    /// How the section moves with the elastic coordinates, and its axes at rest.
    pub section: PointShape<D>,
    pub axes: Marker<D>,
    /// The mass beyond.
    pub beyond: Inertia<D>,
    /// Joints and forces with the slot of each of their markers beyond.
    pub joints: Vec<(usize, usize)>,
    pub forces: Vec<(usize, usize)>,
}
