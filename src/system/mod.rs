//! The equations of motion as solvers see them, from a scene or from a user.
//!
//! [`MechanicalSystem`] is what solvers see: M, f, phi, phi', gamma and G at a state. A scene becomes one through
//! [`Mechanism`]; a researcher implements it directly, or writes M, f and phi once over any scalar as [`Equations`]
//! and gets the derivatives.
//!
//! [`Mechanism`] has a layout of its model, which three parts read: `evaluate` writes the terms, `tangent` K and C, and
//! `output` with `output_tangent` the outputs.

mod actions;
mod coupling;
mod critical;
mod dependence;
mod equations;
mod evaluate;
mod facts;
mod frames;
mod gather;
mod input;
mod layout;
mod levi_civita;
mod limits;
mod locked;
mod mechanism;
mod model_facts;
mod output;
mod output_tangent;
mod placed_joint;
mod portions;
mod rigid_joint;
mod rotating;
mod rows;
mod section;
mod seed;
mod solid;
mod spin;
mod spinning;
mod start;
mod support;
mod switching;
mod tangent;
mod terms;
mod theory;
mod turnings;
mod variation;
mod view;

pub use equations::{Equations, Lagrangian};
#[doc(hidden)]
pub use facts::Group;
#[doc(hidden)]
pub use facts::{Column, Dimensions, Excitation, Names, SwitchFacts, SystemFacts};
#[doc(hidden)]
pub use levi_civita::LeviCivita;
#[doc(hidden)]
pub use mechanism::Mechanism;
#[doc(hidden)]
pub use output_tangent::OutputTangent;
#[doc(hidden)]
pub use rotating::Rotating;
#[doc(hidden)]
pub use spin::{Placement, Rotation, Spin};
pub(crate) use start::check_start;
#[doc(hidden)]
pub use switching::Road;
#[doc(hidden)]
pub use terms::{Need, OperatingPoint, Scratch, Structure, Tangent, Terms};
#[doc(hidden)]
pub use theory::{Limited, Theory};

pub use crate::body::Energy;
use crate::error::Result;
use crate::math::Rate;
pub use crate::math::Scalar;
use crate::math::kkt::Pattern;
use nalgebra::DMatrix;
use std::borrow::Cow;

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
    /// False if a component of them is infinite or not a number.
    pub is_finite: bool,
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

/// M(q) v' + G(q,t)^T lambda = f(t,q,v), phi(q,t) = 0, q' = N(q) v.
///
/// The last velocities may be states xi, see [`Dimensions::states`]: f, K and C then contain r and its derivatives, so
/// that formulations and integrators need not tell them apart.
///
/// Immutable while it is solved, so that threads can share it; scratch memory comes from the caller.
#[diagnostic::on_unimplemented(
    message = "`{Self}` has no equations of motion",
    label = "no equations of motion",
    note = "implement `holonom::system::Equations` (M, f and phi), `holonom::system::Lagrangian` (T, V and phi) or \
            `holonom::research::systems::MechanicalSystem` (all terms)"
)]
#[doc(hidden)]
pub trait MechanicalSystem: Send + Sync {
    /// n_q, n_v and n_c, and how many of the last ones are states or nonholonomic.
    fn dimensions(&self) -> Dimensions;

    /// What never changes: names, units, lengths. Evaluations do not ask for it. Default: numbered
    /// names, and none of what is optional.
    fn facts(&self) -> Cow<'_, SystemFacts> {
        Cow::Owned(SystemFacts::new(self.dimensions()))
    }

    /// Switching functions and functions of time. Default: none.
    fn switches(&self) -> SwitchFacts<'_> {
        SwitchFacts::default()
    }

    /// Refuses a start, with q and v of the right lengths, that cannot be computed with: asked once before a run, an
    /// assembly or a linear model. Default: nothing is refused.
    ///
    /// # Errors
    /// Such a start.
    fn check(&self, _t: f64, _q: &[f64], _v: &[f64]) -> Result<()> {
        Ok(())
    }

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
    #[doc(hidden)]
    fn levi_civita(&self, _at: OperatingPoint, _connection: &mut LeviCivita, _scratch: &mut Scratch) -> bool {
        false
    }

    /// q' = N(q) v; without the rates of turning angles, where `qdot` has no place for them. Default: N = I.
    fn rate(&self, _q: &[f64], v: &[f64], qdot: &mut [f64]) {
        qdot.copy_from_slice(&v[..qdot.len()]);
    }

    /// The constant rotation about a fixed axis that drives prescribe at `t`; `None`, the default, where nothing is
    /// driven or the drives prescribe anything else.
    #[doc(hidden)]
    fn prescribed_spin(&self, _t: f64) -> Option<Spin> {
        None
    }

    /// Brings redundant coordinates (quaternions) back to their normal form.
    fn normalize(&self, _q: &mut [f64]) {}

    /// Kinetic and potential energy, J; `None` where the equations come without a potential.
    fn energy(&self, _t: f64, _q: &[f64], _v: &[f64], _scratch: &mut Scratch) -> Option<Energy> {
        None
    }

    /// Writes the outputs at a state with its v' and lambda.
    fn outputs(&self, _at: OperatingPoint, _out: &mut [f64], _scratch: &mut Scratch) {}

    /// Derivatives of all outputs at a state with its v' and lambda. Returns false where there are outputs without
    /// derivatives.
    fn output_tangent(&self, _at: OperatingPoint, _tangent: &mut OutputTangent, _scratch: &mut Scratch) -> bool {
        self.facts().outputs.is_empty()
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

    /// Writes the arguments of all switching functions with their rates along the motion, at a state with its v'.
    #[doc(hidden)]
    fn switching(&self, _at: OperatingPoint, _out: &mut [Rate], _scratch: &mut Scratch) {}

    /// What each force does at a state. Default: nothing is known.
    #[doc(hidden)]
    fn feeds(&self, _t: f64, _q: &[f64], _v: &[f64], _scratch: &mut Scratch) -> Vec<Feed> {
        Vec::new()
    }

    /// The roads under the wheels at a state. Default: none.
    #[doc(hidden)]
    fn roads(&self, _t: f64, _q: &[f64], _v: &[f64], _scratch: &mut Scratch) -> Vec<Road> {
        Vec::new()
    }

    /// Writes the gaps, m, along the axes of the world.
    fn write_gaps(&self, _q: &[f64], _out: &mut [[f64; 3]]) {}

    /// Writes the deformation of each part of [`SystemFacts::limited`], in the unit of its limit.
    fn deformations(&self, _q: &[f64], _out: &mut [f64]) {}

    /// Writes the magnitude of the angular velocity of each of [`SystemFacts::turning_bodies`], rad/s.
    fn spins(&self, _q: &[f64], _v: &[f64], _out: &mut [f64]) {}

    /// The rows of phi that depend on t explicitly, with the values that they prescribe at `t`. Default: none.
    #[doc(hidden)]
    fn prescribed(&self, _t: f64) -> Vec<Prescribed> {
        Vec::new()
    }
}
