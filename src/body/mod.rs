//! Bodies: coordinates, inertia, and the frames of their markers.
//!
//! A body owns coordinates q (with q' = N(q) v) and markers. It gives the frames of its markers as functions of q,
//! and pulls a wrench at a marker back to its generalized forces, J^T w. Joints and forces see nothing else.
//!
//! To add one: a file with a [`BodySpec`] and a [`BodyKernel`], and a line in [`registry`]; from outside the crate, the
//! same two and [`Elements::with_body`](crate::scene::Elements::with_body), as in `tests/examples/own_body.rs`.

mod build;
mod facts;
#[doc(hidden)]
pub mod flexible;
#[doc(hidden)]
pub mod floating;
mod formula;
mod frame;
mod guided;
mod inertia;
mod kernel;
mod kind;
mod marker_table;
mod orientation;
mod parse;
mod point_mass;
mod pose;
mod probe;
mod read_formula;
mod rigid;
mod rigid_planar;
mod rigid_spatial;
mod shapes;
mod state;
mod turning;

pub use build::{Build, NamedOutput, NamedOutputs, Switches};
pub use facts::BodyFacts;
pub use formula::Formula;
pub(crate) use frame::turned;
pub use frame::{Frame, Marker, Wrench, cross, dot, norm, scale, sub};
#[doc(hidden)]
pub use frame::{in_space, twist_len, unit, unit_axes};
#[doc(hidden)]
pub use kernel::MOST_COORDINATES;
pub use kind::ElementKind;
#[doc(hidden)]
pub use kind::Repeat;
pub(crate) use kind::mistaken;
pub use marker_table::{MarkerId, MarkerTable};
#[doc(hidden)]
pub use orientation::{Orientation, aim};
#[doc(hidden)]
pub use parse::{parse, parse_among, show};
#[doc(hidden)]
pub use pose::{Carried, Freedom, Pose};
pub use probe::{Probe, Quantity};
#[doc(hidden)]
pub use probe::{small_rotation, small_rotation_torque};
pub use rigid::Initial;
pub(crate) use rigid_planar::RigidPlanar;
pub(crate) use rigid_spatial::RigidSpatial;
#[doc(hidden)]
pub use shapes::{Form, MassProperties, Solid, solids};
pub(crate) use state::StateBody;
#[doc(hidden)]
pub use turning::{TurnAxes, Turned, Turning};

use crate::error::Result;
use crate::math::{Dual, Scalar, Taylor};
use schemars::JsonSchema;
use serde::de::DeserializeOwned;

/// Values with their derivatives along six directions: the second scalar that every element is evaluated over.
pub type Dual6 = Dual<f64, 6>;

/// The largest number of markers of a joint or force: their frames are kept on the stack.
#[doc(hidden)]
pub const MOST_MARKERS: usize = 8;

/// Energy of a body or of a whole mechanism, J.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Energy<S = f64> {
    /// Kinetic energy, J.
    pub kinetic: S,
    /// Potential energy, J.
    pub potential: S,
}

/// The equations of a rigid body of a few coordinates, at most `MOST_COORDINATES`, with a constant M, written once
/// over any scalar. Bodies beyond that implement `Body` and `BodyOver` themselves.
pub trait BodyKernel<const D: usize>: Send + Sync + 'static {
    /// What never changes, by [`BodyFacts::new`]; what follows from the kernel itself may be left out.
    fn facts(&self) -> BodyFacts;
    /// The markers given to [`BodySpec::build`], in their order.
    fn markers(&self) -> &[Marker<D>];

    /// q' = N(q) v, with N affine in q: constant for positions, linear for quaternions. Default: N = I.
    fn rate<S: Scalar>(&self, _q: &[S], v: &[S], qdot: &mut [S]) {
        qdot.copy_from_slice(v);
    }

    /// The frame in which its markers are fixed; in the plane `turn` is the angle of the axes.
    fn frame<S: Scalar>(&self, q: &[S]) -> Frame<S, D>;

    /// [`frame`](Self::frame) along the motion with the accelerations `vdot`, zero if not given.
    #[doc(hidden)]
    #[inline]
    fn motion<S: Scalar>(&self, q: &[S], v: &[S], vdot: Option<&[S]>) -> Frame<Taylor<S>, D>
    where
        Self: Sized,
    {
        kernel::motion(self, q, v, vdot)
    }

    /// f += J^T w for a wrench at the frame of one of the markers. Default: J is the derivative of
    /// [`frame`](Self::frame), one coordinate at a time.
    fn pull_back<S: Scalar>(&self, q: &[S], frame: &Frame<S, D>, wrench: &Wrench<S, D>, f: &mut [S])
    where
        Self: Sized,
    {
        kernel::pull_back(self, q, frame, wrench, f);
    }

    /// Mass matrix M, constant for such a body: `values` at the places of [`BodyFacts::mass_pattern`].
    fn mass(&self, values: &mut [f64]);

    /// See `Body::pose`.
    #[doc(hidden)]
    fn pose(&self, q: &[f64], v: &[f64]) -> Pose<D>
    where
        Self: Sized,
    {
        kernel::pose(self, q, v)
    }

    /// f += weight and velocity-dependent inertia forces; `gravity` in m/s^2.
    fn own_forces<S: Scalar>(&self, q: &[S], v: &[S], gravity: &[f64; D], f: &mut [S]);

    /// See `Body::tangent`; not called where the own forces are constant. Default: own forces over dual numbers, for
    /// the default places.
    #[doc(hidden)]
    fn tangent(&self, at: BodyState<D>, k: &mut [f64], c: &mut [f64])
    where
        Self: Sized,
    {
        kernel::tangent(self, at, k, c);
    }

    /// The kinetic energy v^T M v / 2, and the potential of the weight.
    fn energy<S: Scalar>(&self, q: &[S], v: &[S], gravity: &[f64; D]) -> Energy<S>;

    /// Brings redundant coordinates (a quaternion) back to their normal form.
    fn normalize(&self, _q: &mut [f64]) {}
}

/// A body over one scalar: the kinematics that joints and forces need, and its energy.
pub trait BodyOver<S: Scalar, const D: usize> {
    /// `qdot` = N(q) v.
    fn rate(&self, q: &[S], v: &[S], qdot: &mut [S]);
    /// Frames of the markers from number `first` on with their velocities, and their accelerations at v' = `vdot` (zero
    /// if not given).
    fn motion(&self, q: &[S], v: &[S], vdot: Option<&[S]>, first: usize, out: &mut [Frame<Taylor<S>, D>]);
    /// f += J^T w for a wrench at the frame of marker `marker`; f is indexed as its [support](BodyFacts::support).
    fn pull_back(&self, marker: usize, q: &[S], frame: &Frame<S, D>, wrench: &Wrench<S, D>, f: &mut [S]);
    /// Kinetic energy, and potential energy of weight and of the body's own deformation, J.
    fn energy(&self, q: &[S], v: &[S], gravity: &[f64; D]) -> Energy<S>;
}

/// A body's state with its accelerations, and the scene's gravity.
#[derive(Clone, Copy, Debug)]
pub struct BodyState<'a, const D: usize> {
    /// Coordinates of the body.
    pub q: &'a [f64],
    /// Velocities of the body.
    pub v: &'a [f64],
    /// Accelerations v' of the body.
    pub vdot: &'a [f64],
    /// Acceleration of gravity in world axes, m/s^2.
    pub gravity: &'a [f64; D],
}

/// Centre line of a beam in a floating frame, which deforms with the elastic coordinates of its body.
#[derive(Clone, Copy)]
#[doc(hidden)]
pub struct Bent<'a, const D: usize> {
    /// Undeformed line with the displacement functions of its points.
    pub line: &'a dyn flexible::Line<D>,
    /// Parts of the line with geometric stiffening; empty without it.
    pub stretches: &'a [flexible::Stretch],
    /// Index of the first elastic coordinate among those of the body.
    pub first: usize,
}

/// The object-safe form of a body; implemented for every [`BodyKernel`].
#[diagnostic::on_unimplemented(
    message = "`{Self}` has no equations of a body",
    note = "implement `holonom::parts::BodyKernel<D>`: its frame over any scalar and its mass, for D = 2, 3 or both"
)]
pub trait Body<const D: usize>: BodyOver<f64, D> + BodyOver<Dual6, D> + Send + Sync {
    /// What never changes. Evaluations do not ask for it: a model keeps it.
    fn facts(&self) -> BodyFacts;
    /// Its markers, its own frame first.
    fn markers(&self) -> &[Marker<D>];
    /// Mass matrix M(q): `values` at the places of [`BodyFacts::mass_pattern`].
    fn mass(&self, q: &[f64], values: &mut [f64]);
    /// f += weight, velocity-dependent inertia forces, and the body's own elastic and damping forces.
    fn own_forces(&self, q: &[f64], v: &[f64], gravity: &[f64; D], f: &mut [f64]);
    /// k += d(M v' - f)/dq along the directions of v, c += d(M v' - f)/dv, with f the own forces, at the places of
    /// [`BodyFacts::tangent_pattern`].
    fn tangent(&self, at: BodyState<D>, k: &mut [f64], c: &mut [f64]);
    /// Power dissipated by its damping, W.
    fn dissipation(&self, v: &[f64]) -> f64;
    /// Brings redundant coordinates (a quaternion) back to their normal form.
    fn normalize(&self, q: &mut [f64]);
    /// Position, orientation and twist of the frame in which its markers are fixed when it is not deformed.
    fn pose(&self, q: &[f64], v: &[f64]) -> Pose<D>;
    /// Displacement functions of its markers; empty for a rigid body.
    fn shapes(&self) -> &[flexible::PointShape<D>];
    /// Centre line, if it is a beam in a floating frame.
    fn bent(&self) -> Option<Bent<'_, D>>;
}

/// A body ready for the model, with the initial q and v that its scene gives.
pub struct BuiltBody<const D: usize> {
    /// The body with its markers.
    #[doc(hidden)]
    pub body: Box<dyn Body<D>>,
    /// Coordinates at the start.
    pub q: Vec<f64>,
    /// Velocities at the start.
    pub v: Vec<f64>,
}

impl<const D: usize> BuiltBody<D> {
    /// The body of a kernel, with its coordinates and velocities at the start.
    pub fn new(kernel: impl BodyKernel<D>, q: Vec<f64>, v: Vec<f64>) -> Self {
        BuiltBody { body: Box::new(kernel), q, v }
    }

    /// Refuses a body of inconsistent sizes: a mistake in the code of its type, not in a scene.
    fn checked(self, markers: usize) -> Result<Self> {
        let BuiltBody { body, q, v } = &self;
        let facts = body.facts();
        let sizes = [
            ("coordinates", q.len(), facts.coordinate_names.len()),
            ("velocities", v.len(), facts.velocity_names.len()),
            ("markers", body.markers().len(), markers),
        ];
        if let Some((what, found, expected)) = sizes.into_iter().find(|(_, found, expected)| found != expected) {
            return Err(mistaken(format!("{found} {what} where there should be {expected}")));
        }
        if q.len() > facts.most_coordinates {
            return Err(mistaken(format!("{} coordinates; at most {MOST_COORDINATES} are possible", q.len())));
        }
        let is_outside = |&(row, column): &(usize, usize)| column > row || row >= v.len();
        match facts.mass_pattern.iter().find(|place| is_outside(place)) {
            Some((i, j)) => Err(mistaken(format!("the place ({i}, {j}) outside of the lower triangle of its M"))),
            None => Ok(self),
        }
    }
}

/// The keys of a kind of body in a scene, without `name`, `type`, `markers`, `initial`, `origin` and `repeat`, and the body they make.
#[diagnostic::on_unimplemented(
    message = "`{Self}` is no body of a scene",
    note = "implement `holonom::parts::BodySpec`: its `TYPE` and `build`; derive `serde::Deserialize` and `schemars::JsonSchema`"
)]
pub trait BodySpec: DeserializeOwned + JsonSchema {
    /// Its `type` in scenes.
    const TYPE: &'static str;
    /// Makes the body with these markers, of which the first is its own frame, and its initial q and v from `initial`.
    ///
    /// # Errors
    /// Keys with values that are not valid; [`Build`] has the checks.
    fn build<const D: usize>(
        &self,
        markers: Vec<Marker<D>>,
        initial: &Initial,
        build: &Build<D>,
    ) -> Result<BuiltBody<D>>;
}

/// A kind of body.
pub type BodyKind<const D: usize> =
    ElementKind<fn(serde_json::Value, Vec<Marker<D>>, &Initial, &Build<D>) -> Result<BuiltBody<D>>>;

/// The kind of body that `T` describes.
#[doc(hidden)]
pub fn kind<T: BodySpec, const D: usize>() -> BodyKind<D> {
    ElementKind::of::<T>(T::TYPE, |json, markers, initial, build| {
        let count = markers.len();
        parse_among::<T>(json, &SHARED_KEYS)?.build(markers, initial, build)?.checked(count)
    })
}

/// The keys that all kinds of bodies share.
#[doc(hidden)]
pub const SHARED_KEYS: [&str; 6] = ["name", "type", "markers", "initial", "origin", "repeat"];

/// Every built-in kind of body, in the order of the documentation.
pub fn registry<const D: usize>() -> Vec<BodyKind<D>> {
    vec![
        kind::<rigid::Rigid, D>(),
        kind::<point_mass::PointMass, D>(),
        kind::<flexible::FlexibleBeam, D>(),
        kind::<flexible::modal::ModalBody, D>(),
    ]
}
