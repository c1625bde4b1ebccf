//! The checked, named model that a scene describes.

use super::place::{Cut, Place};
use super::units::Unit;
use crate::body::flexible::{Profile, Section};
use crate::body::{Body, Energy, Frame, Marker, MarkerId, MarkerTable, Quantity, Signal, Switches, Turning};
use crate::force::{Beam, Force, Half, Station};
use crate::joint::Joint;
use crate::math::{Scalar, Taylor};
use std::ops::Range;

/// Bodies, joints and forces with everything resolved; nothing in it can be wrong any more but the start.
pub struct Model<const D: usize> {
    pub gravity: [f64; D],
    /// All markers: the ground's first, then each body's.
    pub markers: MarkerTable,
    pub ground: Vec<Marker<D>>,
    pub bodies: Vec<Part<D>>,
    pub joints: Vec<Connection<Box<dyn Joint<D>>>>,
    /// Those of the scene, then the elements of absolute beams.
    pub forces: Vec<Connection<Box<dyn Force<D>>>>,
    pub beams: Vec<BeamLine>,
    pub outputs: Vec<Watched>,
    /// Sections of beams in floating frames that outputs watch.
    pub cuts: Vec<Cut<D>>,
    pub inputs: Vec<ForceInput>,
    pub switches: Switches,
    /// Angles in space that q carries after the coordinates of the bodies.
    pub turnings: Vec<Turning>,
    /// The largest coordinate of position at the start, m.
    pub extent: f64,
}

/// A body in its place.
pub struct Part<const D: usize> {
    pub name: String,
    pub body: Box<dyn Body<D>>,
    /// Index of its first marker in the table.
    pub first_marker: MarkerId,
    /// Places of its first coordinate and velocity.
    pub first_q: usize,
    pub first_v: usize,
    pub nq: usize,
    pub nv: usize,
}

/// A flexible beam in absolute coordinates: bodies as nodes, and elements as forces between them.
pub struct BeamLine {
    pub name: String,
    /// Index of its first node among the bodies; the others follow.
    pub first_body: usize,
    /// Index of its first element among the forces.
    pub first_force: usize,
    /// Abscissae of the nodes from the left end, m; one more than there are elements.
    pub abscissae: Vec<f64>,
    pub elements: Vec<Beam>,
    pub profile: Profile,
    /// Of each element the halves that its nodes carry.
    pub halves: Vec<[Half; 2]>,
}

impl BeamLine {
    /// Indices of its nodes among the bodies.
    pub fn bodies(&self) -> Range<usize> {
        self.first_body..self.first_body + self.abscissae.len()
    }

    /// Indices of its elements among the forces.
    pub fn forces(&self) -> Range<usize> {
        self.first_force..self.first_force + self.elements.len()
    }

    /// m, relaxed.
    pub fn length(&self) -> f64 {
        self.abscissae.last().copied().unwrap_or(0.0)
    }

    /// Where the relaxed beam is at `s`, in the axes of its left end, m.
    pub fn relaxed(&self, s: f64) -> [f64; 3] {
        self.elements.first().map_or([0.0; 3], |element| element.relaxed(s))
    }

    /// The section at `s`; at a node that to the left of it.
    pub fn section(&self, s: f64) -> Section {
        let element = self.element_at(s);
        self.profile.within([self.abscissae[element], self.abscissae[element + 1]], s)
    }

    /// What the section at `s` from the left end, 0 <= s <= length, carries of the beam without mass; `node` gives the frame of a body of
    /// the model. At a node it is that of the element to the left of it.
    pub fn station<S: Scalar, const D: usize>(
        &self,
        s: f64,
        node: impl Fn(usize) -> Frame<Taylor<S>, D>,
    ) -> Station<S, D> {
        let element = self.element_at(s);
        let first = self.first_body + element;
        self.elements[element].station([&node(first), &node(first + 1)], s - self.abscissae[element])
    }

    /// The element at `s`; its nodes are bodies `first_body` + this and the next.
    pub fn element_at(&self, s: f64) -> usize {
        self.abscissae.partition_point(|&abscissa| abscissa < s).clamp(1, self.elements.len()) - 1
    }
}

/// A joint or force with its name, its kind in the scene and the markers it sees.
pub struct Connection<E> {
    pub name: String,
    pub kind: &'static str,
    pub element: E,
    pub markers: Vec<MarkerId>,
}

/// A named output.
pub struct Watched {
    pub name: String,
    /// The unit that its values are in.
    pub unit: Unit,
    pub measure: Measure,
}

/// What an output reads.
pub enum Measure {
    /// An expression over t and marker quantities.
    Signal(Signal),
    /// A component of a marker's position or velocity against another marker, in that one's axes.
    Relative {
        of: MarkerId,
        to: MarkerId,
        quantity: Quantity,
    },
    /// Angle about the third axis of `to`, counted through full turns; in space as the one next to a turning angle.
    Turn {
        of: MarkerId,
        to: MarkerId,
        turning: usize,
    },
    /// Distance between two markers and its rate.
    Distance {
        from: MarkerId,
        to: MarkerId,
        rate: bool,
    },
    /// Force (components 0 to 2), torque (3 to 5), [`FORCE_SIZE`] or [`TORQUE_SIZE`] on the second body of a joint, in the
    /// axes of a marker.
    Reaction {
        joint: usize,
        component: usize,
        axes: MarkerId,
    },
    /// Force or torque of a driver on the second body along its coordinate.
    Push {
        joint: usize,
    },
    /// Force in a joint that holds a length, tension positive.
    Tension {
        joint: usize,
    },
    /// Deflection or strain of a beam in a floating frame.
    Elastic(Combination),
    /// Of an absolute beam, or of a massless one.
    Station(Box<Place>),
    /// A component of force or moment at a [`Cut`].
    Section {
        cut: usize,
        component: usize,
    },
    /// The magnitude of a force.
    Force(usize),
    Energy(EnergyPart),
}

impl Measure {
    /// Whether inertia is in what it reads.
    pub fn feels_acceleration(&self) -> bool {
        match self {
            Measure::Station(place) => place.feels_acceleration(),
            Measure::Section { .. } => true,
            _ => false,
        }
    }
}

/// Component of a reaction: the size of its force.
pub const FORCE_SIZE: usize = 6;
/// Component of a reaction: the size of its torque.
pub const TORQUE_SIZE: usize = 7;

/// What is read of a section of an absolute or massless beam.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Reading {
    /// Along an axis of the beam's left end, from the relaxed beam there.
    Deflection { axis: usize, rest: f64 },
    /// Elastic forces of the section times these: strains with factors.
    Strain([f64; 6]),
    /// A component of force or moment.
    Force(usize),
}

/// Coordinates, and products of two of them, with factors.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Combination {
    pub linear: Vec<(usize, f64)>,
    pub squares: Vec<([usize; 2], f64)>,
}

impl Combination {
    /// Its value; `q` gives a coordinate of the system.
    pub fn at<S: Scalar>(&self, q: impl Fn(usize) -> S) -> S {
        let linear = self.linear.iter().fold(S::zero(), |sum, &(i, factor)| sum + q(i) * factor);
        self.squares.iter().fold(linear, |sum, &([i, j], factor)| sum + q(i) * q(j) * factor)
    }

    /// The coordinates that it reads, in increasing order.
    pub fn coordinates(&self) -> Vec<usize> {
        let linear = self.linear.iter().map(|&(i, _)| i);
        let mut all: Vec<usize> = linear.chain(self.squares.iter().flat_map(|&(pair, _)| pair)).collect();
        all.sort_unstable();
        all.dedup();
        all
    }
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum EnergyPart {
    Kinetic,
    Potential,
    Total,
}

impl EnergyPart {
    pub fn of<S: Scalar>(self, energy: Energy<S>) -> S {
        match self {
            EnergyPart::Kinetic => energy.kinetic,
            EnergyPart::Potential => energy.potential,
            EnergyPart::Total => energy.kinetic + energy.potential,
        }
    }
}

/// A named input: it adds to a component of an applied force or torque.
pub struct ForceInput {
    pub name: String,
    pub force: usize,
    /// In the axes of the force.
    pub component: usize,
    /// `N` or `N m`.
    pub unit: &'static str,
}

impl<const D: usize> Model<D> {
    pub fn marker_count(&self) -> usize {
        self.markers.names.len()
    }

    /// The forces of the scene, without the elements of absolute beams.
    pub fn given_forces(&self) -> &[Connection<Box<dyn Force<D>>>] {
        let count = self.beams.first().map_or(self.forces.len(), |beam| beam.first_force);
        &self.forces[..count]
    }

    /// Frames of the ground's markers.
    pub fn ground_frames(&self) -> impl Iterator<Item = Frame<f64, D>> + '_ {
        self.ground.iter().map(|marker| Frame::world().at(marker))
    }

    /// The body that carries a marker, unless it is the ground.
    pub fn carrier(&self, marker: MarkerId) -> Option<&Part<D>> {
        self.markers.bodies[marker].map(|body| &self.bodies[body])
    }
}
