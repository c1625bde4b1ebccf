//! The equations of motion as solvers see them, from a scene or from a user.
//!
//! [`MechanicalSystem`] is what solvers see: M, f, phi, phi', gamma and G at a state. A scene becomes one through
//! [`Mechanism`]; a researcher implements it directly, or writes M, f and phi once over any scalar as [`Equations`]
//! and gets the derivatives.

mod coupling;
mod critical;
mod equations;
mod evaluate;
mod gaps;
mod input;
mod levi_civita;
mod limits;
mod locked;
mod mechanism;
mod output;
mod output_tangent;
mod portions;
mod rigid_joint;
mod road;
mod rotating;
mod rows;
mod scale;
mod section;
mod solid;
mod spin;
mod spinning;
mod support;
mod switching;
mod tangent;
mod terms;
mod turnings;
mod variation;
mod view;
mod workspace;

pub use equations::Equations;
pub use input::Excitation;
#[doc(hidden)]
pub use levi_civita::LeviCivita;
#[doc(hidden)]
pub use limits::{Limited, Theory};
pub use mechanism::Mechanism;
pub use output_tangent::OutputTangent;
#[doc(hidden)]
pub use road::Road;
#[doc(hidden)]
pub use rotating::Rotating;
#[doc(hidden)]
pub use spin::{Placement, Rotation, Spin};
pub use tangent::{OperatingPoint, Tangent};
pub use terms::{Need, Scratch, Structure, Terms};

#[doc(hidden)]
pub use crate::body::Energy;
use crate::math::Rate;
use crate::math::expression::{Switch, TimeFunction};
use crate::math::kkt::Pattern;
use nalgebra::DMatrix;

/// Numbers of coordinates, velocities and constraints.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
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

/// What a force does at a state.
#[derive(Clone, Debug, PartialEq)]
#[doc(hidden)]
pub struct Feed {
    /// Name of the force in the scene.
    pub name: String,
    /// Power that it delivers to the bodies, W.
    pub power: f64,
    /// Sum of the sizes of its forces and torques, N and N m.
    pub size: f64,
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

/// A row of phi that depends on t explicitly.
#[derive(Clone, Copy, Debug, PartialEq)]
#[doc(hidden)]
pub struct Prescribed {
    /// Its index in phi.
    pub row: usize,
    /// The value that it prescribes, m or rad, if the row is a coordinate minus a value.
    pub value: Option<f64>,
}

/// Name and unit of an output or input.
#[derive(Clone, Debug, PartialEq)]
pub struct Column {
    /// Name in the scene and in the header of files.
    pub name: String,
    /// Unit, such as `rad`; empty where it is not known.
    pub unit: String,
}

/// M(q) v' + G(q,t)^T lambda = f(t,q,v), phi(q,t) = 0, q' = N(q) v.
///
/// The last velocities may be states xi, see [`Dimensions::states`]: f, K and C then contain r and its derivatives, so
/// that formulations and integrators need not tell them apart.
///
/// Immutable while it is solved, so that threads can share it; scratch memory comes from the caller.
pub trait MechanicalSystem: Send + Sync {
    /// n_q, n_v and n_c, and how many of the last ones are states or nonholonomic.
    fn dimensions(&self) -> Dimensions;

    /// Fills the terms named by `need` at (t, q, v); filling more is allowed. The places of the values of M and G are
    /// those of [`structure`](Self::structure). All values may be stale on entry.
    fn evaluate(&self, t: f64, q: &[f64], v: &[f64], need: Need, terms: &mut Terms, scratch: &mut Scratch);

    /// Places of the values of M (lower triangle) and G. Default: dense, row by row.
    fn structure(&self) -> Structure {
        let n = self.dimensions();
        Structure::new(Pattern::lower(n.v), Pattern::dense(n.lambda, n.v), Pattern::dense(n.v, n.v))
    }

    /// K and C of r = M v' + G^T lambda - f at a state with its v' and lambda, for implicit methods and linear models.
    /// Returns false where they are not provided, which is the default.
    fn tangent(&self, _at: OperatingPoint, _tangent: &mut Tangent, _scratch: &mut Scratch) -> bool {
        false
    }

    /// d(phi'')/dq along the directions of v at fixed v and v', values at the places of G, for linear models. Returns
    /// false where it is not provided, which is the default.
    fn acceleration_gradient(&self, _at: OperatingPoint, _values: &mut [f64], _scratch: &mut Scratch) -> bool {
        false
    }

    /// out = \[v, x\], in the rate of a variation of q along the directions x with dv that of v: x' = dv - \[v, x\].
    /// For angular velocities in the body's axes w x (dtheta). Default: zero, for N = I.
    fn bracket(&self, _v: &[f64], _x: &[f64], out: &mut [f64]) {
        out.fill(0.0);
    }

    /// Levi-Civita connection of the mass metric along the motion. Returns false where it is not provided, which is the
    /// default.
    fn levi_civita(&self, _at: OperatingPoint, _connection: &mut LeviCivita, _scratch: &mut Scratch) -> bool {
        false
    }

    /// Names of q, v and lambda. Default: `q1, q2 ...`, `v1 ...` and `xi1 ...`, `lambda1 ...`.
    fn names(&self) -> Names {
        let n = self.dimensions();
        let numbered = |prefix: &str, n: usize| (1..=n).map(|i| format!("{prefix}{i}")).collect::<Vec<String>>();
        let v = [numbered("v", n.moving()), numbered("xi", n.states)].concat();
        Names { q: numbered("q", n.q), v, lambda: numbered("lambda", n.lambda) }
    }

    /// Number of coordinates, the last ones, that count full turns of angles which the others give modulo 2 pi.
    /// Default: 0.
    fn turning_angles(&self) -> usize {
        0
    }

    /// The coordinates without the turning angles.
    fn own<'q>(&self, q: &'q [f64]) -> &'q [f64] {
        &q[..q.len() - self.turning_angles()]
    }

    /// q' = N(q) v. Default: N = I.
    fn rate(&self, _q: &[f64], v: &[f64], qdot: &mut [f64]) {
        qdot.copy_from_slice(&v[..qdot.len()]);
    }

    /// q' = N(q) v without the rates of turning angles, whose entries are not written.
    fn own_rate(&self, q: &[f64], v: &[f64], qdot: &mut [f64]) {
        self.rate(q, v, qdot);
    }

    /// The unit quaternions among the coordinates. Default: none.
    fn rotations(&self) -> Vec<Rotation> {
        Vec::new()
    }

    /// The constant rotation about a fixed axis that drives prescribe at `t`; `None`, the default, where nothing is
    /// driven or the drives prescribe anything else.
    fn prescribed_spin(&self, _t: f64) -> Option<Spin> {
        None
    }

    /// Rotation of the axes in which q and v are measured. Default: none, the axes of the world.
    fn axes(&self) -> Option<Spin> {
        None
    }

    /// The coordinates that change when the world is rotated; all others are invariant. `None`, the default, where
    /// bodies have coordinates along fixed directions of the world.
    fn placements(&self) -> Option<Vec<Placement>> {
        None
    }

    /// mass += s^2 times the stiffness of bodies against their own deformation, at the places of M: assembly then
    /// closes loops by moving bodies rather than by bending them. Default: nothing.
    fn add_stiffness(&self, _mass: &mut [f64]) {}

    /// Brings redundant coordinates (quaternions) back to their normal form.
    fn normalize(&self, _q: &mut [f64]) {}

    /// Kinetic and potential energy, J; `None` where the equations come without a potential.
    fn energy(&self, _t: f64, _q: &[f64], _v: &[f64], _scratch: &mut Scratch) -> Option<Energy> {
        None
    }

    /// Names and units of the outputs. Default: none.
    fn columns(&self) -> Vec<Column> {
        Vec::new()
    }

    /// Names and units of the works of single forces since the start of a run, which are no functions of the state:
    /// the integrals of [`Terms::powers`]. Default: none.
    fn works(&self) -> Vec<Column> {
        Vec::new()
    }

    /// Writes the outputs at a state with its v' and lambda.
    fn outputs(&self, _at: OperatingPoint, _out: &mut [f64], _scratch: &mut Scratch) {}

    /// Derivatives of all outputs at a state with its v' and lambda. Returns false where there are outputs without
    /// derivatives.
    fn output_tangent(&self, _at: OperatingPoint, _tangent: &mut OutputTangent, _scratch: &mut Scratch) -> bool {
        self.columns().is_empty()
    }

    /// The inputs u: changes of what the equations contain. In a run that drives them their values are
    /// [`Scratch::inputs`], which [`evaluate`](Self::evaluate) adds; else they are zero. Default: none.
    fn inputs(&self) -> Vec<Column> {
        Vec::new()
    }

    /// The equation that each input is part of. Default: f(u).
    fn excitations(&self) -> Vec<Excitation> {
        vec![Excitation::Force; self.inputs().len()]
    }

    /// df/du, n_v x n_u: the generalized forces per unit of each input.
    fn input_forces(&self, _t: f64, _q: &[f64], _v: &[f64], _f: &mut DMatrix<f64>, _scratch: &mut Scratch) {}

    /// df/du', n_v x n_u. Default: zero.
    fn input_rate_forces(&self, _t: f64, _q: &[f64], _v: &[f64], f: &mut DMatrix<f64>, _scratch: &mut Scratch) {
        f.fill(0.0);
    }

    /// Writes the values that inputs have in a simulation as part of the equations. Default: zero.
    fn input_values(&self, _at: OperatingPoint, out: &mut [f64], _scratch: &mut Scratch) {
        out.fill(0.0);
    }

    /// Switching functions, at whose thresholds the equations change: see [`Regime`](crate::math::Regime). Default:
    /// none.
    fn switches(&self) -> &[Switch] {
        &[]
    }

    /// Owner of a switching function, such as "the force `push`".
    fn owner_of_switch(&self, _switch: usize) -> &str {
        "the equations"
    }

    /// Writes the arguments of all switching functions with their rates along the motion, at a state with its v'.
    fn switching(&self, _at: OperatingPoint, _out: &mut [Rate], _scratch: &mut Scratch) {}

    /// Name of the first force that is infinite or not a number at a state, if the forces have names.
    fn infinite_force(&self, _t: f64, _q: &[f64], _v: &[f64], _scratch: &mut Scratch) -> Option<String> {
        None
    }

    /// What each force does at a state. Default: nothing is known.
    fn feeds(&self, _t: f64, _q: &[f64], _v: &[f64], _scratch: &mut Scratch) -> Vec<Feed> {
        Vec::new()
    }

    /// The roads under the wheels at a state. Default: none.
    fn roads(&self, _t: f64, _q: &[f64], _v: &[f64], _scratch: &mut Scratch) -> Vec<Road> {
        Vec::new()
    }

    /// Numbers of the switching functions that hold a line: of forces along the gap between two markers that jump where
    /// it closes. Default: none.
    fn gaps(&self) -> Vec<usize> {
        Vec::new()
    }

    /// Writes the gaps, m, along the axes of the world.
    fn write_gaps(&self, _q: &[f64], _out: &mut [[f64; 3]]) {}

    /// Functions of t alone in the equations: the time loop limits its steps so as to miss none. Default: none.
    fn time_functions(&self) -> &[TimeFunction] {
        &[]
    }

    /// Parts whose theory is valid up to some deformation only. Default: none.
    fn limited(&self) -> &[Limited] {
        &[]
    }

    /// Writes the deformation of each part of [`limited`](Self::limited), in the unit of its limit.
    fn deformations(&self, _q: &[f64], _out: &mut [f64]) {}

    /// Names of the bodies that have an orientation. Default: none.
    fn turning_bodies(&self) -> Vec<String> {
        Vec::new()
    }

    /// Writes the magnitude of the angular velocity of each of [`turning_bodies`](Self::turning_bodies), rad/s.
    fn spins(&self, _q: &[f64], _v: &[f64], _out: &mut [f64]) {}

    /// Typical length of the mechanism, m. Default: 1.
    fn length(&self) -> f64 {
        1.0
    }

    /// Reference values of the rows of phi for drift: a length for rows in metres, 1 rad for angles. Default: 1.
    fn scales(&self) -> Vec<f64> {
        vec![1.0; self.dimensions().lambda]
    }

    /// Lengths by name, m, for messages: of bodies, from the origin to the farthest marker, and of rods. Default: none.
    #[doc(hidden)]
    fn lengths(&self) -> Vec<(String, f64)> {
        Vec::new()
    }

    /// The rows of phi that depend on t explicitly, with the values that they prescribe at `t`. Default: none.
    #[doc(hidden)]
    fn prescribed(&self, _t: f64) -> Vec<Prescribed> {
        Vec::new()
    }

    /// The rows of phi by joint. Default: each row is a group of its own.
    fn groups(&self) -> Vec<Group> {
        let names = self.names().lambda.into_iter().enumerate();
        names.map(|(i, name)| Group { name, kind: "constraint".to_string(), rows: i..i + 1 }).collect()
    }
}
