//! The equations that everything above solves, whoever wrote them.
//!
//! [`MechanicalSystem`] is what solvers see: M, f, phi, phi', gamma and G at a state. A scene becomes one through
//! [`Mechanism`]; a researcher implements it directly, or writes M, f and phi once over any scalar as [`Equations`]
//! and gets the derivatives.

mod coupling;
mod critical;
mod equations;
mod input;
mod levi_civita;
mod limits;
mod mechanism;
mod output;
mod output_tangent;
mod rotating;
mod rows;
mod scale;
mod section;
mod spin;
mod spinning;
mod states;
mod support;
mod tangent;
mod terms;
mod turnings;
mod variation;
mod view;

pub use equations::Equations;
#[doc(hidden)]
pub use levi_civita::LeviCivita;
#[doc(hidden)]
pub use limits::{Limited, Theory};
pub use mechanism::Mechanism;
pub use output_tangent::OutputTangent;
#[doc(hidden)]
pub use rotating::Rotating;
#[doc(hidden)]
pub use spin::{Placement, Spin};
#[doc(hidden)]
pub use states::refuse_states;
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
    /// How many constraints, the last ones, are nonholonomic: A v + a = 0, with A in the rows of G and A v + a in those of
    /// phi'. They have no position, so phi is zero there.
    pub nonholonomic: usize,
    /// How many velocities, the last ones, are states xi of controllers, filters and actuators: xi' = r(t, q, v, xi), with r
    /// in their rows of f and ones on those of M. They have no position and no constraint: N and G are zero there. Their
    /// errors are tested as those of velocities.
    pub states: usize,
}

impl Dimensions {
    /// Constraints that have a position, which come first.
    pub fn holonomic(self) -> usize {
        self.lambda - self.nonholonomic
    }

    /// Velocities that move q, which come first.
    pub fn moving(self) -> usize {
        self.v - self.states
    }
}

/// Names of the columns that a user reads.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Names {
    pub q: Vec<String>,
    /// Of states xi, too, which come last.
    pub v: Vec<String>,
    pub lambda: Vec<String>,
}

/// JointRows of phi that belong together: a joint.
#[derive(Clone, Debug, PartialEq, Eq)]
#[doc(hidden)]
pub struct Group {
    pub name: String,
    /// Such as `revolute`.
    pub kind: String,
    pub rows: std::ops::Range<usize>,
}

/// The name of an output or input and how to show it.
#[derive(Clone, Debug, PartialEq)]
pub struct Column {
    pub name: String,
    /// Such as `rad`; empty where it is not known.
    pub unit: String,
}

/// M(q) v' + G(q,t)^T lambda = f(t,q,v), phi(q,t) = 0, q' = N(q) v.
///
/// The last velocities may be states xi, see [`Dimensions::states`]: f, K and C then hold r and how it changes, so that every
/// formulation and integrator has them without knowing.
///
/// Immutable while it is solved, so threads share it; scratch memory comes from the caller.
pub trait MechanicalSystem: Send + Sync {
    fn dimensions(&self) -> Dimensions;

    /// Fills what `need` names of `terms` at (t, q, v); filling more is allowed. Where the entries of M and G stand is
    /// said by [`structure`](Self::structure). All values there may be stale on entry.
    fn evaluate(&self, t: f64, q: &[f64], v: &[f64], need: Need, terms: &mut Terms, scratch: &mut Scratch);

    /// Places of the values of M (lower triangle) and G. Default: dense, row by row.
    fn structure(&self) -> Structure {
        let n = self.dimensions();
        Structure { mass: Pattern::lower(n.v), g: Pattern::dense(n.lambda, n.v), tangent: Pattern::dense(n.v, n.v) }
    }

    /// K and C of r = M v' + G^T lambda - f at a state with its v' and lambda, for implicit methods and linear models.
    /// Returns false where the author of the equations gave none, which is the default.
    fn tangent(&self, _at: OperatingPoint, _tangent: &mut Tangent, _scratch: &mut Scratch) -> bool {
        false
    }

    /// d(phi'')/dq along the directions of v at fixed v and v', values at the places of G, for linear models. Returns
    /// false where the author of the equations gave none, which is the default.
    fn acceleration_gradient(&self, _at: OperatingPoint, _values: &mut [f64], _scratch: &mut Scratch) -> bool {
        false
    }

    /// out = \[v, x\], by which a change of q along the directions x, at a change dv of v, moves: x' = dv - \[v, x\]. For
    /// angular velocities in the body's axes w x (dtheta). Default: zero, for N = I.
    fn bracket(&self, _v: &[f64], _x: &[f64], out: &mut [f64]) {
        out.fill(0.0);
    }

    /// How the mass metric carries directions along the motion. Returns false where the equations do not say, which is
    /// the default.
    fn levi_civita(&self, _at: OperatingPoint, _connection: &mut LeviCivita, _scratch: &mut Scratch) -> bool {
        false
    }

    /// Default: `q1, q2 ...`, `v1 ...` and `xi1 ...`, `lambda1 ...`.
    fn names(&self) -> Names {
        let n = self.dimensions();
        let numbered = |prefix: &str, n: usize| (1..=n).map(|i| format!("{prefix}{i}")).collect::<Vec<String>>();
        let v = [numbered("v", n.moving()), numbered("xi", n.states)].concat();
        Names { q: numbered("q", n.q), v, lambda: numbered("lambda", n.lambda) }
    }

    /// So many of the last coordinates count the full turns of angles that the others give up to those. Default: none.
    fn turning_angles(&self) -> usize {
        0
    }

    /// The coordinates but for those.
    fn own<'q>(&self, q: &'q [f64]) -> &'q [f64] {
        &q[..q.len() - self.turning_angles()]
    }

    /// q' = N(q) v. Default: N = I.
    fn rate(&self, _q: &[f64], v: &[f64], qdot: &mut [f64]) {
        qdot.copy_from_slice(&v[..qdot.len()]);
    }

    /// The same without the rates of turning angles, which are left as they are.
    fn own_rate(&self, q: &[f64], v: &[f64], qdot: &mut [f64]) {
        self.rate(q, v, qdot);
    }

    /// The constant turn about a fixed axis that drives prescribe at `t`; none where nothing is driven, or more than that,
    /// which is the default.
    fn prescribed_spin(&self, _t: f64) -> Option<Spin> {
        None
    }

    /// The turn of the axes that q and v are counted in. Default: none, the world's.
    fn axes(&self) -> Option<Spin> {
        None
    }

    /// The coordinates that turn with the world; all others are the same from all sides. None, which is the default, where
    /// bodies are held to directions of the world.
    fn placements(&self) -> Option<Vec<Placement>> {
        None
    }

    /// mass += s^2 times the stiffness of bodies against their own deformation, at the places of M: assembly then closes
    /// loops by moving bodies before it bends them. Default: nothing.
    fn add_stiffness(&self, _mass: &mut [f64]) {}

    /// Brings redundant coordinates (quaternions) back to their normal form.
    fn normalize(&self, _q: &mut [f64]) {}

    /// Kinetic and potential energy; `None` where the author of the equations gave no potential.
    fn energy(&self, _t: f64, _q: &[f64], _v: &[f64], _scratch: &mut Scratch) -> Option<Energy> {
        None
    }

    /// The outputs. Default: none.
    fn columns(&self) -> Vec<Column> {
        Vec::new()
    }

    /// The outputs at a state with its v' and lambda.
    fn outputs(&self, _at: OperatingPoint, _out: &mut [f64], _scratch: &mut Scratch) {}

    /// Derivatives of all outputs at a state with its v' and lambda. Returns false where there are outputs and the author of
    /// the equations gave no derivatives.
    fn output_tangent(&self, _at: OperatingPoint, _tangent: &mut OutputTangent, _scratch: &mut Scratch) -> bool {
        self.columns().is_empty()
    }

    /// The inputs u, which the motion of the system itself leaves at zero. Default: none.
    fn inputs(&self) -> Vec<Column> {
        Vec::new()
    }

    /// df/du, n_v x n_u: the generalized forces of a unit of each input.
    fn input_forces(&self, _t: f64, _q: &[f64], _v: &[f64], _f: &mut DMatrix<f64>, _scratch: &mut Scratch) {}

    /// Where the equations change their form: see [`Regime`](crate::math::Regime). Default: nowhere.
    fn switches(&self) -> &[Switch] {
        &[]
    }

    /// Whose a switching function is, such as "the force `push`".
    fn owner_of_switch(&self, _switch: usize) -> &str {
        "the equations"
    }

    /// Writes the arguments of all switching functions with their rates along the motion, at a state with its v'.
    fn switching(&self, _at: OperatingPoint, _out: &mut [Rate], _scratch: &mut Scratch) {}

    /// What in the equations depends on t alone: the time loop looks that no step misses any of it. Default: nothing.
    fn time_functions(&self) -> &[TimeFunction] {
        &[]
    }

    /// Parts that hold up to some deformation only. Default: none.
    fn limited(&self) -> &[Limited] {
        &[]
    }

    /// Writes how far each of them is deformed, in the unit of its limit.
    fn deformations(&self, _q: &[f64], _out: &mut [f64]) {}

    /// Names of the bodies that turn. Default: none.
    fn turning_bodies(&self) -> Vec<String> {
        Vec::new()
    }

    /// Writes the size of the angular velocity of each of them, rad/s.
    fn spins(&self, _q: &[f64], _v: &[f64], _out: &mut [f64]) {}

    /// A length typical of the mechanism, m. Default: 1.
    fn length(&self) -> f64 {
        1.0
    }

    /// Units of phi by row that drift is measured against: a length for rows in metres, 1 rad for angles. Default: 1.
    fn scales(&self) -> Vec<f64> {
        vec![1.0; self.dimensions().lambda]
    }

    /// The rows of phi by joint. Default: each row for itself.
    fn groups(&self) -> Vec<Group> {
        let names = self.names().lambda.into_iter().enumerate();
        names.map(|(i, name)| Group { name, kind: "constraint".to_string(), rows: i..i + 1 }).collect()
    }
}
