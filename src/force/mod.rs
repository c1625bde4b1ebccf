//! Forces: wrenches at markers as functions of their motion and of time.
//!
//! A force is one kernel over moving frames; bodies pull its wrenches back to generalized forces. It also returns its
//! potential: the power of its wrenches beyond minus the potential's rate is the work in the energy balance.
//!
//! To add one: a file with a [`ForceSpec`] and a [`ForceKernel`], and a line in [`registry`]; from outside the crate,
//! the same two and [`Elements::with_force`](crate::scene::Elements::with_force), as in `tests/examples/own_force.rs`.

mod added;
mod applied;
mod beam;
mod bushing;
mod central_gravity;
mod law;
mod spring_damper;
mod state_rate;
mod torsion_spring;
mod tyre;

#[doc(hidden)]
pub use added::Added;
#[doc(hidden)]
pub use beam::{Beam, Half, Load, Station};
pub(crate) use central_gravity::CentralGravity;
pub(crate) use state_rate::StateRate;

use crate::body::{Build, Dual6, ElementKind, Frame, MOST_MARKERS, MarkerId, Wrench, mistaken, parse_among};
use crate::error::Result;
use crate::forward::forward;
use crate::math::{Rate, Scalar, Taylor, Time};
use schemars::JsonSchema;
use serde::de::DeserializeOwned;

/// The moving frames of a force's markers: each number has its value in `x` and its rate in `d`.
pub type Motion<S, const D: usize> = [Frame<Taylor<S>, D>];
/// The time of an evaluation, with its rate t' = 1.
pub type Instant<'a, S> = Time<'a, Taylor<S>>;

/// Potential and magnitude of a force; [`Action::without_potential`] if it stores no energy.
#[derive(Clone, Copy, Debug)]
pub struct Action<S> {
    /// Stored energy, J, with its rate: computed from the frames with their `x` and `d`.
    pub potential: Taylor<S>,
    /// Scalar for outputs: tension of a spring (positive when it pulls), torque, tyre load; N or N m.
    pub magnitude: S,
}

impl<S: Scalar> Action<S> {
    /// A force that stores nothing.
    pub fn without_potential(magnitude: S) -> Self {
        Action { potential: Taylor::fixed(S::zero()), magnitude }
    }
}

/// What an input of a scene adds to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum InputKind {
    /// The force takes none.
    None,
    /// A component of the force, N, or of the torque, N m.
    Component,
    /// A displacement such as the height of a road, m: the first of the three components of
    /// [`driven`](ForceKernel::driven).
    Displacement {
        /// True if the force depends on its rate.
        rate: bool,
    },
}

/// A wheel for drawings, and for warnings about its load.
#[derive(Clone, Copy, Debug, PartialEq)]
#[doc(hidden)]
pub struct Wheel {
    /// Radius, m.
    pub radius: f64,
    /// Height of the road under it, m.
    pub road: f64,
    /// True if it may leave the road, so that it never pulls.
    pub lifts: bool,
}

/// A force's equations, written once over any scalar.
pub trait ForceKernel<const D: usize>: Send + Sync + 'static {
    /// Writes the wrench on each marker's body, in world axes; `out` is zero on entry. The energy balance counts its
    /// power plus the rate of the returned potential as work, so a force that stores energy must return it.
    fn act<S: Scalar>(&self, frames: &Motion<S, D>, time: Instant<S>, out: &mut [Wrench<S, D>]) -> Action<S>;
    /// What inputs of a scene can add to, by [`Self::driven`]. Default: nothing.
    fn input(&self) -> InputKind {
        InputKind::None
    }
    /// True if its magnitude, and an input to a component, is a torque, N m, and not a force. Default: false.
    fn is_torque(&self) -> bool {
        false
    }
    /// Number of its first markers on whose bodies it acts, of `markers` in all; others it reads alone. Default: all.
    fn acted(&self, markers: usize) -> usize {
        markers
    }
    /// False if its wrenches are the same at all velocities, so that they add nothing to C. Default: true.
    fn depends_on_velocities(&self) -> bool {
        true
    }
    /// [`Self::act`] with inputs, each with its rate: `input` adds to its components, N or N m, in its own axes, or its
    /// first entry to a displacement, m.
    fn driven<S: Scalar>(
        &self,
        _input: &[Taylor<S>; 3],
        frames: &Motion<S, D>,
        time: Instant<S>,
        out: &mut [Wrench<S, D>],
    ) -> Action<S> {
        ForceKernel::act(self, frames, time, out)
    }
    /// Writes the arguments of its switching functions with these inputs at the numbers that [`Build::switch`] gave;
    /// those of an expression by [`Expression::arguments`](crate::math::expression::Expression::arguments). Default: it
    /// has none.
    #[doc(hidden)]
    fn switching(
        &self,
        _input: &[Taylor<Rate>; 3],
        _frames: &Motion<Rate, D>,
        _time: Instant<Rate>,
        _out: &mut [Rate],
    ) {
    }
    /// True if its law assumes a small rotation between its markers. Default: false.
    fn takes_small_rotations(&self) -> bool {
        false
    }
    /// Number of the piece that holds the line between its first two markers, if its force jumps where they meet: the
    /// piece is zero for its law, else the `Side` that the gap counts as positive. Default: none.
    fn gap(&self) -> Option<usize> {
        None
    }
    /// The wheel to be drawn, if it is one.
    #[doc(hidden)]
    fn wheel(&self, _frames: &Motion<f64, D>, _time: Instant<f64>) -> Option<Wheel> {
        None
    }
    /// The beam element whose sections outputs may read, if it is one.
    #[doc(hidden)]
    fn beam(&self) -> Option<&Beam> {
        None
    }
}

/// A force over one scalar, as the model calls it.
pub trait ForceOver<S: Scalar, const D: usize> {
    /// Wrenches with all inputs zero; `out` is zero on entry.
    fn act(&self, frames: &Motion<S, D>, time: Instant<S>, out: &mut [Wrench<S, D>]) -> Action<S> {
        self.driven(&[Taylor::fixed(S::zero()); 3], frames, time, out)
    }
    /// Wrenches with inputs, as [`ForceKernel::driven`] takes them.
    fn driven(
        &self,
        input: &[Taylor<S>; 3],
        frames: &Motion<S, D>,
        time: Instant<S>,
        out: &mut [Wrench<S, D>],
    ) -> Action<S>;
}

impl<K: ForceKernel<D>, S: Scalar, const D: usize> ForceOver<S, D> for K {
    fn driven(
        &self,
        input: &[Taylor<S>; 3],
        frames: &Motion<S, D>,
        time: Instant<S>,
        out: &mut [Wrench<S, D>],
    ) -> Action<S> {
        ForceKernel::driven(self, input, frames, time, out)
    }
}

/// The object-safe form of a force; implemented for every [`ForceKernel`].
#[diagnostic::on_unimplemented(
    message = "`{Self}` has no equations of a force",
    note = "implement `holonom::parts::ForceKernel<D>`: `act` over any scalar, for D = 2, 3 or both"
)]
pub trait Force<const D: usize>: ForceOver<f64, D> + ForceOver<Dual6, D> + Send + Sync {
    /// The wheel to be drawn, if it is one.
    fn wheel(&self, frames: &Motion<f64, D>, time: Instant<f64>) -> Option<Wheel>;
    /// The beam element, if the force is one.
    fn beam(&self) -> Option<&Beam>;
    /// True if the force is valid for small relative rotations alone.
    fn takes_small_rotations(&self) -> bool;
    /// Number of the piece that holds the line between its first two markers.
    fn gap(&self) -> Option<usize>;
    /// Number of its first markers on whose bodies it acts, of `markers` in all.
    fn acted(&self, markers: usize) -> usize;
    /// False if its wrenches are the same at all velocities.
    fn depends_on_velocities(&self) -> bool;
    /// What inputs of a scene can add to.
    fn input(&self) -> InputKind;
    /// True if its magnitude is a torque, N m, in place of a force, N.
    fn is_torque(&self) -> bool;
    /// Writes the arguments of its switching functions, with their rates, at their numbers.
    fn switching(&self, input: &[Taylor<Rate>; 3], frames: &Motion<Rate, D>, time: Instant<Rate>, out: &mut [Rate]);
}

impl<K: ForceKernel<D>, const D: usize> Force<D> for K {
    forward! { ForceKernel =>
        fn wheel(&self, frames: &Motion<f64, D>, time: Instant<f64>) -> Option<Wheel>;
        fn beam(&self) -> Option<&Beam>;
        fn takes_small_rotations(&self) -> bool;
        fn gap(&self) -> Option<usize>;
        fn depends_on_velocities(&self) -> bool;
        fn input(&self) -> InputKind;
        fn acted(&self, markers: usize) -> usize;
        fn is_torque(&self) -> bool;
        fn switching(&self, input: &[Taylor<Rate>; 3], frames: &Motion<Rate, D>, time: Instant<Rate>, out: &mut [Rate]);
    }
}

/// A force ready for the model, with its markers.
pub struct BuiltForce<const D: usize> {
    /// The kernel, boxed.
    #[doc(hidden)]
    pub force: Box<dyn Force<D>>,
    /// 1 to 8, as [`Build::between`] or [`Build::marker`] find them.
    pub markers: Vec<MarkerId>,
}

impl<const D: usize> BuiltForce<D> {
    /// The force of a kernel at its markers.
    pub fn new(kernel: impl ForceKernel<D>, markers: Vec<MarkerId>) -> Self {
        BuiltForce { force: Box::new(kernel), markers }
    }

    /// Refuses too few or too many markers: a mistake in the code of the type, not in a scene.
    fn checked(self) -> Result<Self> {
        let markers = self.markers.len();
        if (1..=MOST_MARKERS).contains(&markers) {
            Ok(self)
        } else {
            Err(mistaken(format!("{markers} markers; 1 to {MOST_MARKERS} are possible")))
        }
    }
}

/// The keys of a kind of force in a scene, without name and type: see [`JointSpec`](crate::joint::JointSpec).
#[diagnostic::on_unimplemented(
    message = "`{Self}` is no force of a scene",
    note = "implement `holonom::parts::ForceSpec`: its `TYPE` and `build`; derive `serde::Deserialize` and `schemars::JsonSchema`"
)]
pub trait ForceSpec: DeserializeOwned + JsonSchema {
    /// Its `type` in scenes.
    const TYPE: &'static str;
    /// Makes the force in the plane (D = 2) or in space (D = 3).
    ///
    /// # Errors
    /// Keys with values that are not valid; [`Build`] has the checks.
    fn build<const D: usize>(&self, build: &Build<D>) -> Result<BuiltForce<D>>;
}

/// A kind of force.
pub type ForceKind<const D: usize> = ElementKind<fn(serde_json::Value, &Build<D>) -> Result<BuiltForce<D>>>;

/// The kind of force that `T` describes.
#[doc(hidden)]
pub fn kind<T: ForceSpec, const D: usize>() -> ForceKind<D> {
    ElementKind::of::<T>(T::TYPE, |json, build| {
        parse_among::<T>(json, &["name", "type", "repeat"])?.build(build)?.checked()
    })
}

/// Every built-in kind of force, in the order of the documentation. Gravity belongs to the scene.
pub fn registry<const D: usize>() -> Vec<ForceKind<D>> {
    vec![
        kind::<spring_damper::SpringDamper, D>(),
        kind::<torsion_spring::TorsionSpring, D>(),
        kind::<bushing::Bushing, D>(),
        kind::<beam::BeamForce, D>(),
        kind::<applied::AppliedForce, D>(),
        kind::<applied::AppliedTorque, D>(),
        kind::<tyre::Tyre, D>(),
    ]
}
