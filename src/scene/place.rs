//! Places on beams that outputs watch.

use crate::body::flexible::{MassIntegrals, PointShape};
use crate::body::{Frame, Marker, MarkerId, dot, sub};
use crate::force::{Beam, Half, Load, Station};
use crate::math::array::from_fn;
use crate::math::{Scalar, Taylor};

/// Quantity of a section of an absolute or massless beam.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Reading {
    /// Displacement from the relaxed beam along an axis of the beam's left end, m.
    Deflection {
        /// Axis of the left end.
        axis: usize,
        /// Position of the relaxed beam along it, m.
        rest: f64,
    },
    /// Sum of the elastic forces of the section times these: compliances times weights of the strains.
    Strain([f64; 6]),
    /// A component of force or moment.
    Force(usize),
}

/// A place on an element of an absolute beam, or on a massless one.
pub struct Place {
    /// Beam element that the place is on.
    pub element: Beam,
    /// Markers at the element's ends.
    pub ends: [MarkerId; 2],
    /// Mass of the element, lumped at its ends; zero for a massless beam.
    pub halves: [Half; 2],
    /// Deflections are in the axes of this frame and from its origin.
    pub own: MarkerId,
    /// Abscissa from the element's first end, m.
    pub x: f64,
    /// Quantity that is read.
    pub reading: Reading,
}

impl Place {
    /// True if the value depends on accelerations.
    pub fn feels_acceleration(&self) -> bool {
        !matches!(self.reading, Reading::Deflection { .. }) && self.halves.iter().any(|half| half.mass > 0.0)
    }

    /// Markers whose frames the value depends on.
    pub fn markers(&self) -> [MarkerId; 3] {
        [self.ends[0], self.ends[1], self.own]
    }

    /// Value of the reading; `frame` gives the position, velocity and acceleration of a marker.
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
        let loads: [Load<S>; 2] = from_fn(|i| self.halves[i].load(&ends[i], gravity));
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
    /// Displacement and rotation of the section under the elastic coordinates.
    pub section: PointShape<D>,
    /// Axes of the undeformed section in the body's frame.
    pub axes: Marker<D>,
    /// The body's mass beyond the section.
    pub beyond: MassIntegrals<D>,
    /// Pairs (joint, slot): `slot` is the place, among the joint's markers, of one that is beyond the section.
    pub joints: Vec<(usize, usize)>,
    /// Pairs (force, slot) of the markers beyond, likewise.
    pub forces: Vec<(usize, usize)>,
}
