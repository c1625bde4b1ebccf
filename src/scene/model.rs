//! The checked, named model that a scene describes.

use super::absolute_beam::BeamLine;
use super::place::{Cut, Place};
use super::units::Unit;
use crate::body::{
    Body, BodyFacts, Energy, Formula, Frame, Marker, MarkerId, MarkerTable, Probe, Solid, Switches, Turning,
};
use crate::force::Force;
use crate::joint::Joint;
use crate::math::Scalar;
use std::ops::Range;

/// Bodies, joints and forces with all names and expressions resolved and checked.
pub struct Model<const D: usize> {
    /// Acceleration of gravity in world axes, m/s^2.
    pub gravity: [f64; D],
    /// All markers: the ground's first, then each body's.
    pub markers: MarkerTable,
    /// Markers of the ground; the first is the world frame.
    pub ground: Vec<Marker<D>>,
    /// Bodies in the order of the scene; each node of an absolute beam is one, and, after them, each state.
    pub bodies: Vec<Part<D>>,
    /// Joints in the order of the scene.
    pub joints: Vec<ModelJoint<D>>,
    /// Forces of the scene, then the elements of absolute beams, then the rates of states.
    pub forces: Vec<ModelForce<D>>,
    /// Flexible beams in absolute coordinates.
    pub beams: Vec<BeamLine>,
    /// Outputs in the order of the scene.
    pub outputs: Vec<ModelOutput>,
    /// Powers whose integrals over a run are watched, with the names and units of these works.
    pub works: Vec<ModelOutput>,
    /// Sections of beams in floating frames that outputs watch.
    pub cuts: Vec<Cut<D>>,
    /// Inputs u in the order of the scene.
    pub inputs: Vec<ModelInput>,
    /// Number of the states xi: the last bodies, and their rates the last forces.
    pub states: usize,
    /// Events at which elements change their form.
    pub switches: Switches,
    /// Angles in space counted through full turns, which stand in q after the coordinates of the bodies.
    pub turnings: Vec<Turning>,
    /// The largest coordinate of position at the start, m.
    pub extent: f64,
}

/// A body with the places of its coordinates, velocities and markers in the model.
pub struct Part<const D: usize> {
    /// Name in the scene, or `beam.n3` for a node of an absolute beam.
    pub name: String,
    /// Kinematics, inertia and energy of the body.
    pub body: Box<dyn Body<D>>,
    /// What the body says of itself; boxed, since evaluations read all else of a part.
    pub facts: Box<BodyFacts>,
    /// Index of its first marker in the table.
    pub first_marker: MarkerId,
    /// Index of its first coordinate in q.
    pub first_q: usize,
    /// Index of its first velocity in v.
    pub first_v: usize,
    /// Number of its coordinates.
    pub nq: usize,
    /// Number of its velocities.
    pub nv: usize,
    /// Shapes that it is made of, where the scene gives them.
    pub solids: Vec<Solid>,
}

impl<const D: usize> Part<D> {
    /// Its coordinates among all.
    #[inline]
    pub fn coordinates<'q>(&self, q: &'q [f64]) -> &'q [f64] {
        &q[self.first_q..self.first_q + self.nq]
    }

    /// Its velocities among all, or what else has a value for each velocity.
    #[inline]
    pub fn velocities<'v>(&self, v: &'v [f64]) -> &'v [f64] {
        &v[self.first_v..self.first_v + self.nv]
    }

    /// The range of its markers.
    #[inline]
    pub fn markers(&self) -> Range<MarkerId> {
        self.first_marker..self.first_marker + self.body.markers().len()
    }

    /// Name of a coordinate or velocity of the body; a state has its own.
    pub fn full_name(&self, name: &str) -> String {
        if name.is_empty() { self.name.clone() } else { format!("{}.{name}", self.name) }
    }
}

/// A joint or force with its name, its kind in the scene and the markers it sees.
pub struct Connection<E> {
    /// Name in the scene, or `beam.e3` for an element of an absolute beam.
    pub name: String,
    /// Name of its type in the scene, such as `revolute`.
    pub kind: &'static str,
    /// Equations of the joint or force.
    pub element: E,
    /// Indices of its markers, in the order in which the element takes their frames.
    pub markers: Vec<MarkerId>,
}

/// A joint of a model.
pub type ModelJoint<const D: usize> = Connection<Box<dyn Joint<D>>>;
/// A force of a model.
pub type ModelForce<const D: usize> = Connection<Box<dyn Force<D>>>;

/// A named output.
pub struct ModelOutput {
    /// Name of the output: a column of the trajectory and a row of C.
    pub name: String,
    /// The unit that its values are in.
    pub unit: Unit,
    /// Quantity that the output reads.
    pub measure: Measure,
}

/// Quantity that an output reads.
pub enum Measure {
    /// An expression over t and marker quantities.
    Formula(Formula),
    /// A scalar of markers, or its rate.
    Probe(Probe),
    /// Force (components 0 to 2), torque (3 to 5), [`FORCE_SIZE`] or [`TORQUE_SIZE`] of a joint on the body of one of
    /// its markers, in the axes of a marker.
    Reaction {
        /// Index of the joint in the model.
        joint: usize,
        /// Place, among the joint's markers, of that on whose body it acts, and about which the torque is.
        slot: usize,
        /// 0 to 5, [`FORCE_SIZE`] or [`TORQUE_SIZE`].
        component: usize,
        /// Marker in whose axes the components are.
        axes: MarkerId,
    },
    /// Force or torque of a driver on the second body along its coordinate.
    Push {
        /// Index of the driver among the joints.
        joint: usize,
    },
    /// Multiplier of a joint with one row: of a length the force in it, N, tension positive; of an equation in the unit
    /// of energy over that of its expression.
    Multiplier {
        /// Index of the joint in the model.
        joint: usize,
    },
    /// Deflection or strain of a beam in a floating frame.
    Elastic(Combination),
    /// Deflection, strain or internal force at a place of an absolute or massless beam.
    Station(Box<Place>),
    /// A component of force or moment at a [`Cut`].
    Section {
        /// Index in [`Model::cuts`].
        cut: usize,
        /// Component in the order of [`Station`](crate::force::Station): axial force, shear y, z, torque, bending y, z.
        component: usize,
    },
    /// Magnitude of the force, or of the torque, with this index.
    Force(usize),
    /// Force (components 0 to 2) or torque (3 to 5) that a force exerts on the body of one of its markers, in the axes
    /// of a marker.
    Load {
        /// Index of the force in the model.
        force: usize,
        /// Place, among the force's markers, of that on whose body it acts, and about which the torque is.
        slot: usize,
        /// 0 to 5.
        component: usize,
        /// Marker in whose axes the components are.
        axes: MarkerId,
    },
    /// Power of a force on all its bodies, W.
    Power {
        /// Index of the force in the model.
        force: usize,
    },
    /// Power of a joint that depends on t, -lambda . G v, W.
    DrivePower {
        /// Index of the joint in the model.
        joint: usize,
    },
    /// Energy of the whole mechanism, J.
    Energy(EnergyPart),
}

impl Measure {
    /// True if the value may depend on velocities.
    pub fn feels_velocity(&self) -> bool {
        match self {
            Measure::Formula(formula) => formula.probes.iter().any(|probe| probe.feels(1)),
            Measure::Probe(probe) => probe.feels(1),
            Measure::Elastic(_) => false,
            Measure::Reaction { .. } | Measure::Push { .. } | Measure::Multiplier { .. } => false,
            _ => true,
        }
    }

    /// True if the value depends on accelerations.
    pub fn feels_acceleration(&self) -> bool {
        match self {
            Measure::Formula(formula) => formula.probes.iter().any(|probe| probe.feels(2)),
            Measure::Probe(probe) => probe.feels(2),
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

/// A quadratic function of the coordinates: sum a_i q_i + sum b_ij q_i q_j.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Combination {
    /// Pairs (i, a): terms a q_i.
    pub linear: Vec<(usize, f64)>,
    /// Pairs ([i, j], a): terms a q_i q_j.
    pub squares: Vec<([usize; 2], f64)>,
}

impl Combination {
    /// Value of the function; `q(i)` is coordinate i of the system.
    pub fn at<S: Scalar>(&self, q: impl Fn(usize) -> S) -> S {
        let linear = self.linear.iter().fold(S::zero(), |sum, &(i, factor)| sum + q(i) * factor);
        self.squares.iter().fold(linear, |sum, &([i, j], factor)| sum + q(i) * q(j) * factor)
    }

    /// Indices of the coordinates that the function depends on, in increasing order.
    pub fn coordinates(&self) -> Vec<usize> {
        let linear = self.linear.iter().map(|&(i, _)| i);
        let mut all: Vec<usize> = linear.chain(self.squares.iter().flat_map(|&(pair, _)| pair)).collect();
        all.sort_unstable();
        all.dedup();
        all
    }
}

/// Part of the mechanical energy that an output reads.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum EnergyPart {
    /// Kinetic energy, v.M v/2 where N = I.
    Kinetic,
    /// Potential energy of weight, springs and elastic deformation.
    Potential,
    /// Sum of kinetic and potential energy.
    Total,
}

impl EnergyPart {
    /// Returns this part of `energy`, J.
    pub fn of<S: Scalar>(self, energy: Energy<S>) -> S {
        match self {
            EnergyPart::Kinetic => energy.kinetic,
            EnergyPart::Potential => energy.potential,
            EnergyPart::Total => energy.kinetic + energy.potential,
        }
    }
}

/// A named input.
pub struct ModelInput {
    /// Name of the input in the scene.
    pub name: String,
    /// What it adds to.
    pub target: Target,
    /// `N`, `N m`, `m` or `rad`.
    pub unit: &'static str,
    /// Its value in simulations, which the element contains; none: zero.
    pub value: Option<Formula>,
}

/// What an input adds to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Target {
    /// A component of an applied force or torque.
    Component {
        /// Index of the force.
        force: usize,
        /// 0 to 2 for x to z, in its axes.
        component: usize,
    },
    /// The height of a road.
    Road {
        /// Index of the tyre.
        force: usize,
        /// True if its force depends on the rate of the height.
        rate: bool,
    },
    /// What a driver prescribes.
    Driver {
        /// Index of the joint.
        joint: usize,
    },
}

impl Target {
    /// The force that it drives, with the component.
    pub fn force(self) -> Option<(usize, usize)> {
        match self {
            Target::Component { force, component } => Some((force, component)),
            Target::Road { force, .. } => Some((force, 0)),
            Target::Driver { .. } => None,
        }
    }
}

impl<const D: usize> Model<D> {
    /// Number of all markers, those of the ground among them.
    pub fn marker_count(&self) -> usize {
        self.markers.names.len()
    }

    /// The forces of the scene, without the elements of absolute beams and the rates of states.
    pub fn given_forces(&self) -> &[ModelForce<D>] {
        let count = self.beams.first().map_or(self.forces.len() - self.states, |beam| beam.first_force);
        &self.forces[..count]
    }

    /// The rates of the states.
    pub fn rates(&self) -> &[ModelForce<D>] {
        &self.forces[self.forces.len() - self.states..]
    }

    /// The bodies without the states.
    pub fn given_bodies(&self) -> &[Part<D>] {
        &self.bodies[..self.bodies.len() - self.states]
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
