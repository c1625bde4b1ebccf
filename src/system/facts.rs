//! What is known of a system before it moves: counts, names, units, and what its state is monitored for.

use super::spin::{Placement, Rotation, Spin};
use super::theory::Limited;
use crate::math::expression::{Switch, TimeFunction};

/// Numbers of coordinates, velocities and constraints.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Dimensions {
    /// n_q
    pub q: usize,
    /// n_v
    pub v: usize,
    /// n_c
    pub lambda: usize,
    /// Number of nonholonomic constraints, the last ones: A v + a = 0, with A in the rows of G and A v + a in those of
    /// phi'. They have no position, so phi is zero there.
    pub nonholonomic: usize,
    /// Number of velocities, the last ones, that are states xi of controllers, filters and actuators: xi' = r(t, q, v,
    /// xi), with r in their rows of f and the identity in those of M. They have no position and no constraint: N and G
    /// are zero there. Their errors are tested as those of velocities.
    pub states: usize,
    /// Number of coordinates, the last ones, that count full turns of angles which the others give modulo 2 pi.
    pub turning_angles: usize,
}

impl Dimensions {
    /// Number of constraints that have a position, which come first.
    pub fn holonomic(self) -> usize {
        self.lambda - self.nonholonomic
    }

    /// Number of velocities that move q, which come first.
    pub fn moving(self) -> usize {
        self.v - self.states
    }

    /// Number of coordinates without the turning angles.
    pub fn q_without_turns(self) -> usize {
        self.q - self.turning_angles
    }

    /// The coordinates without the turning angles.
    pub fn without_turns(self, q: &[f64]) -> &[f64] {
        &q[..q.len() - self.turning_angles]
    }
}

/// Names of the columns of a trajectory.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Names {
    /// Coordinates, n_q.
    pub q: Vec<String>,
    /// Velocities, n_v; the states xi come last.
    pub v: Vec<String>,
    /// Multipliers, n_c.
    pub lambda: Vec<String>,
}

/// Name and unit of an output or input.
#[derive(Clone, Debug, PartialEq)]
pub struct Column {
    /// Name in the scene and in the header of files.
    pub name: String,
    /// Unit, such as `rad`; empty where it is not known.
    pub unit: String,
}

/// The equation that an input u is part of; it decides which derivatives of u are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Excitation {
    /// f(u).
    Force,
    /// f(u, u'): a displacement under a damped element.
    Displacement,
    /// phi - u in this row: a prescribed coordinate. u' is part of phi', u'' of phi''.
    Constraint(usize),
}

impl Excitation {
    /// Order of the highest derivative of u in the equations of index 1.
    pub fn order(self) -> usize {
        match self {
            Excitation::Force => 0,
            Excitation::Displacement => 1,
            Excitation::Constraint(_) => 2,
        }
    }
}

/// The rows of phi that belong to one joint.
#[derive(Clone, Debug, PartialEq, Eq)]
#[doc(hidden)]
pub struct Group {
    /// Name of the joint in the scene.
    pub name: String,
    /// Type of the joint, such as `revolute`.
    pub kind: String,
    /// Range of the rows in phi.
    pub rows: std::ops::Range<usize>,
}

/// Functions at whose thresholds the equations change, and functions of time.
#[derive(Clone, Copy, Debug, Default)]
pub struct SwitchFacts<'a> {
    /// Switching functions: see [`Regime`](crate::math::Regime).
    #[doc(hidden)]
    pub all: &'a [Switch],
    /// Owners of the switching functions, such as "the force `push`".
    pub owners: &'a [String],
    /// Functions of t alone: the time loop limits its steps so as to miss none.
    #[doc(hidden)]
    pub time_functions: &'a [TimeFunction],
}

impl<'a> SwitchFacts<'a> {
    /// Owner of a switching function.
    pub fn owner(self, switch: usize) -> &'a str {
        self.owners.get(switch).map_or("the equations", String::as_str)
    }
}

/// Facts of a system that never change. Own equations fill what they have, over those of [`SystemFacts::new`].
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SystemFacts {
    /// Names of q, v and lambda.
    pub names: Names,
    /// Names and units of the outputs.
    pub outputs: Vec<Column>,
    /// Names and units of the works of single forces since the start of a run, which are no functions of the state:
    /// the integrals of [`Terms::powers`](super::Terms::powers).
    pub works: Vec<Column>,
    /// The inputs u: changes of what the equations contain. In a run that drives them their values are
    /// [`Scratch::inputs`](super::Scratch::inputs), which an evaluation adds; else they are zero.
    pub inputs: Vec<Column>,
    /// The equation that each input is part of: f(u) for inputs beyond the end of this list.
    pub excitations: Vec<Excitation>,
    /// Numbers of the switching functions that hold a line: of forces along the gap between two markers that jump where
    /// it closes.
    pub gaps: Vec<usize>,
    /// Parts whose theory is valid up to some deformation only.
    #[doc(hidden)]
    pub limited: Vec<Limited>,
    /// Names of the bodies that have an orientation.
    pub turning_bodies: Vec<String>,
    /// The unit quaternions among the coordinates.
    #[doc(hidden)]
    pub rotations: Vec<Rotation>,
    /// Rotation of the axes in which q and v are measured; `None` for the axes of the world.
    #[doc(hidden)]
    pub axes: Option<Spin>,
    /// The coordinates that change when the world is rotated; all others are invariant. `None` where bodies have
    /// coordinates along fixed directions of the world.
    #[doc(hidden)]
    pub placements: Option<Vec<Placement>>,
    /// Typical length of the mechanism, m.
    pub length: f64,
    /// Lengths by name, m, for messages: of bodies, from the origin to the farthest marker, and of rods.
    pub lengths: Vec<(String, f64)>,
    /// Reference values of the rows of phi for drift: a length for rows in metres, 1 rad for angles.
    pub scales: Vec<f64>,
    /// Stiffness of bodies against their own deformation times the square of a length, at places of the values of M:
    /// with it as a mass, assembly closes loops by moving bodies rather than by bending them.
    pub stiffness: Vec<(usize, f64)>,
    /// The rows of phi by joint; where it is empty, each row is a group of its own.
    #[doc(hidden)]
    pub groups: Vec<Group>,
}

impl SystemFacts {
    /// Names `q1, q2 ...`, `v1 ...` and `xi1 ...`, `lambda1 ...`, lengths of 1, and nothing else.
    pub fn new(n: Dimensions) -> Self {
        let numbered = |prefix: &str, n: usize| (1..=n).map(|i| format!("{prefix}{i}")).collect::<Vec<String>>();
        let v = [numbered("v", n.moving()), numbered("xi", n.states)].concat();
        SystemFacts {
            names: Names { q: numbered("q", n.q), v, lambda: numbered("lambda", n.lambda) },
            length: 1.0,
            scales: vec![1.0; n.lambda],
            ..SystemFacts::default()
        }
    }

    /// The equation that each input is part of.
    pub fn excitations(&self) -> Vec<Excitation> {
        let all = 0..self.inputs.len();
        all.map(|input| self.excitations.get(input).copied().unwrap_or(Excitation::Force)).collect()
    }

    /// The rows of phi by joint, or row by row.
    #[doc(hidden)]
    pub fn groups(&self) -> Vec<Group> {
        if !self.groups.is_empty() {
            return self.groups.clone();
        }
        let names = self.names.lambda.iter().enumerate();
        names.map(|(i, name)| Group { name: name.clone(), kind: "constraint".to_string(), rows: i..i + 1 }).collect()
    }
}
