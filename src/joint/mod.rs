//! Joints: holonomic constraints phi(markers, t) = 0.
//!
//! A joint is one kernel over frames. Evaluated along the motion (Taylor numbers) it gives phi, phi' and -gamma;
//! evaluated with seeded frames (dual numbers) it gives its gradient with respect to the twists of its markers, which
//! the bodies pull back to rows of G. Where closed formulas between rigid bodies are known, [`ClosedForm`], they are
//! used in their place and must agree to round-off.
//!
//! To add one: a file with a [`JointSpec`] and a [`JointKernel`], and a line in [`registry`]; from outside the crate,
//! the same two and [`Elements::with_joint`](crate::scene::Elements::with_joint), as in `tests/examples/own_joint.rs`.

mod added;
mod coordinates;
mod cylindrical;
mod distance;
mod driver;
mod equation;
mod gear;
mod lock;
mod planar;
mod point_on_line;
mod prismatic;
mod revolute;
mod spherical;
mod universal;
mod weld;

use crate::body::{Build, Dual6, ElementKind, Frame, MOST_MARKERS, MarkerId, mistaken, parse_among, twist_len};
use crate::error::Result;
use crate::forward::forward;
use crate::math::array::from_fn;
use crate::math::{Dual, Rate, Scalar, Taylor, Time};
use schemars::JsonSchema;
use serde::de::DeserializeOwned;

#[doc(hidden)]
pub use added::Added;
pub use coordinates::{JointCoordinate, given};
#[doc(hidden)]
pub use lock::{Lock, within_half_turn};

/// The largest number of rows of a joint.
pub const MOST_ROWS: usize = 6;

/// The axis of a joint, a direction in the world.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Axis {
    /// The second marker translates along it through the first, or rotates freely about it.
    Along([f64; 3]),
    /// The joint prescribes the rotation of the second marker about it.
    Turn([f64; 3]),
}

/// The joints for which closed formulas between rigid bodies are known.
#[derive(Clone)]
#[doc(hidden)]
pub enum ClosedForm<const D: usize> {
    /// Locked translations and rotations.
    Lock(Lock<D>),
    /// A distance of this length, m.
    Rod(f64),
}

/// A joint's equations, written once over any scalar.
pub trait JointKernel<const D: usize>: Send + Sync + 'static {
    /// A name for each row, 1 to 6: the direction it constrains. Rows named `x`, `y`, `z` and `length` are
    /// in metres, all others in radians: drift is measured in these units. A single row `length` is that of a rod,
    /// whose tension outputs can read; that of a single row `angle` is a torque.
    fn row_names(&self) -> Vec<&'static str>;
    /// True if phi depends on t explicitly; phi_t is taken as zero if not.
    fn depends_on_time(&self) -> bool;
    /// Its axis with the first marker at `first`, if it has one.
    #[doc(hidden)]
    fn joint_axis(&self, _first: &Frame<f64, D>) -> Option<Axis> {
        None
    }
    /// Writes phi, one value a row, at the frames of the joint's markers, in the order of [`BuiltJoint::markers`]; zero
    /// where the joint is closed. Derivatives follow from the scalars that are put in.
    fn phi<S: Scalar>(&self, frames: &[Frame<S, D>], time: Time<S>, out: &mut [S]);
    /// True if its row, the only one, is a coordinate minus a value that it prescribes, m or rad: an input of a scene
    /// may then add to the value, by [`driven`](Self::driven). Default: false.
    fn prescribes(&self) -> bool {
        false
    }
    /// The value that its row prescribes at `t`, if that is a function of t alone. Default: none.
    #[doc(hidden)]
    fn prescribed(&self, _t: f64) -> Option<f64> {
        None
    }
    /// [`phi`](Self::phi) with an input that adds to the value that is prescribed: phi - input.
    fn driven<S: Scalar>(&self, _input: S, frames: &[Frame<S, D>], time: Time<S>, out: &mut [S]) {
        self.phi(frames, time, out);
    }
    /// Its form if closed formulas between rigid bodies are known, which must give what [`phi`](Self::phi) gives.
    /// Default: none.
    #[doc(hidden)]
    fn closed_form(&self) -> Option<ClosedForm<D>> {
        None
    }
    /// Writes the arguments of its switching functions at the numbers that [`Build::switch`] gave; those of an
    /// expression by
    /// [`Expression::arguments`](crate::math::expression::Expression::arguments). Default: it has none.
    #[doc(hidden)]
    fn switching(&self, _frames: &[Frame<Rate, D>], _time: Time<Rate>, _out: &mut [Rate]) {}
}

/// A joint over one scalar, as the model calls it.
pub trait JointOver<S: Scalar, const D: usize> {
    /// phi, phi' and phi'' along the motion of the frames.
    fn levels(&self, frames: &[Frame<Taylor<S>, D>], time: Time<Taylor<S>>, out: &mut [Taylor<S>]);
    /// The same with an input and its rates, as [`JointKernel::driven`] takes it.
    fn driven(&self, input: Taylor<S>, frames: &[Frame<Taylor<S>, D>], time: Time<Taylor<S>>, out: &mut [Taylor<S>]);
    /// d(phi)/d(twist) for the markers of pass `pass`: markers 2 pass and 2 pass + 1 in the plane (three components
    /// each), marker `pass` in space (six components). `out` has one array for each row of phi.
    fn gradient(&self, frames: &[Frame<Taylor<S>, D>], time: Time<S>, pass: usize, out: &mut [[S; 6]]);
}

/// The object-safe form of a joint; implemented for every [`JointKernel`].
#[diagnostic::on_unimplemented(
    message = "`{Self}` has no equations of a joint",
    note = "implement `holonom::parts::JointKernel<D>`: phi over any scalar, for D = 2, 3 or both"
)]
pub trait Joint<const D: usize>: JointOver<f64, D> + JointOver<Dual6, D> + Send + Sync {
    /// Names of the rows of phi.
    fn row_names(&self) -> Vec<&'static str>;
    /// True if phi depends on t explicitly.
    fn depends_on_time(&self) -> bool;
    /// True if an input may add to the value that its only row prescribes.
    fn prescribes(&self) -> bool;
    /// The value that its row prescribes at `t`, if that is a function of t alone.
    #[doc(hidden)]
    fn prescribed(&self, t: f64) -> Option<f64>;
    /// Axis of the joint with its first marker at `first`, if it has one.
    fn joint_axis(&self, first: &Frame<f64, D>) -> Option<Axis>;
    /// Its form, if closed formulas between rigid bodies are known.
    #[doc(hidden)]
    fn closed_form(&self) -> Option<ClosedForm<D>>;
    /// Writes the arguments of its switching functions, with their rates, at their numbers.
    fn switching(&self, frames: &[Frame<Rate, D>], time: Time<Rate>, out: &mut [Rate]);
}

/// Markers that one pass of [`JointOver::gradient`] covers.
#[doc(hidden)]
pub const fn markers_per_pass(dimension: usize) -> usize {
    6 / twist_len(dimension)
}

impl<K: JointKernel<D>, S: Scalar, const D: usize> JointOver<S, D> for K {
    fn levels(&self, frames: &[Frame<Taylor<S>, D>], time: Time<Taylor<S>>, out: &mut [Taylor<S>]) {
        self.phi(frames, time, out);
    }

    fn driven(&self, input: Taylor<S>, frames: &[Frame<Taylor<S>, D>], time: Time<Taylor<S>>, out: &mut [Taylor<S>]) {
        JointKernel::driven(self, input, frames, time, out);
    }

    fn gradient(&self, frames: &[Frame<Taylor<S>, D>], time: Time<S>, pass: usize, out: &mut [[S; 6]]) {
        let seeded = |i: usize| -> Frame<Dual<S, 6>, D> {
            let frame = frames[i].map(|x| x.x);
            if i / markers_per_pass(D) == pass {
                frame.seeded(i % markers_per_pass(D) * twist_len(D))
            } else {
                frame.map(Dual::fixed)
            }
        };
        let mut rows = [Dual::fixed(S::zero()); MOST_ROWS];
        let rows = &mut rows[..out.len()];
        match frames.len() {
            1 => self.phi(&[seeded(0)], time.map(Dual::fixed), rows),
            2 => self.phi(&[seeded(0), seeded(1)], time.map(Dual::fixed), rows),
            n => {
                let all: [_; MOST_MARKERS] = from_fn(|i| seeded(i.min(n - 1)));
                self.phi(&all[..n], time.map(Dual::fixed), rows);
            }
        }
        out.iter_mut().zip(rows).for_each(|(out, row)| *out = row.eps);
    }
}

impl<K: JointKernel<D>, const D: usize> Joint<D> for K {
    forward! { JointKernel =>
        fn row_names(&self) -> Vec<&'static str>;
        fn depends_on_time(&self) -> bool;
        fn prescribes(&self) -> bool;
        fn prescribed(&self, t: f64) -> Option<f64>;
        fn joint_axis(&self, first: &Frame<f64, D>) -> Option<Axis>;
        fn closed_form(&self) -> Option<ClosedForm<D>>;
        fn switching(&self, frames: &[Frame<Rate, D>], time: Time<Rate>, out: &mut [Rate]);
    }
}

/// A joint ready for the model, with its markers.
pub struct BuiltJoint<const D: usize> {
    /// The kernel, boxed.
    #[doc(hidden)]
    pub joint: Box<dyn Joint<D>>,
    /// 1 to 8, as [`Build::between`] or [`Build::marker`] find them.
    pub markers: Vec<MarkerId>,
}

impl<const D: usize> BuiltJoint<D> {
    /// The joint of a kernel at its markers.
    pub fn new(kernel: impl JointKernel<D>, markers: Vec<MarkerId>) -> Self {
        BuiltJoint { joint: Box::new(kernel), markers }
    }

    /// Refuses too few or too many rows or markers: a mistake in the code of the type, not in a scene.
    fn checked(self) -> Result<Self> {
        let rows = self.joint.row_names().len();
        let markers = self.markers.len();
        match ((1..=MOST_ROWS).contains(&rows), (1..=MOST_MARKERS).contains(&markers)) {
            (false, _) => Err(mistaken(format!("{rows} rows; 1 to {MOST_ROWS} are possible"))),
            (_, false) => Err(mistaken(format!("{markers} markers; 1 to {MOST_MARKERS} are possible"))),
            _ => Ok(self),
        }
    }
}

/// The keys of a kind of joint in a scene, without name and type. Derive `serde::Deserialize`, with
/// `deny_unknown_fields`, and `schemars::JsonSchema`; doc comments become those of the schema. A field of type
/// [`Number`](crate::math::expression::Number) may be an expression.
#[diagnostic::on_unimplemented(
    message = "`{Self}` is no joint of a scene",
    note = "implement `holonom::parts::JointSpec`: its `TYPE` and `build`; derive `serde::Deserialize` and `schemars::JsonSchema`"
)]
pub trait JointSpec: DeserializeOwned + JsonSchema {
    /// Its `type` in scenes.
    const TYPE: &'static str;
    /// Makes the joint in the plane (D = 2) or in space (D = 3).
    ///
    /// # Errors
    /// Keys with values that are not valid; [`Build`] has the checks.
    fn build<const D: usize>(&self, build: &Build<D>) -> Result<BuiltJoint<D>>;
}

/// A kind of joint.
pub type JointKind<const D: usize> = ElementKind<fn(serde_json::Value, &Build<D>) -> Result<BuiltJoint<D>>>;

/// The kind of joint that `T` describes.
#[doc(hidden)]
pub fn kind<T: JointSpec, const D: usize>() -> JointKind<D> {
    ElementKind::of::<T>(T::TYPE, |json, build| {
        parse_among::<T>(json, &["name", "type", "repeat"])?.build(build)?.checked()
    })
}

/// Every built-in kind of joint, in the order of the documentation.
pub fn registry<const D: usize>() -> Vec<JointKind<D>> {
    vec![
        kind::<revolute::Revolute, D>(),
        kind::<prismatic::Prismatic, D>(),
        kind::<cylindrical::Cylindrical, D>(),
        kind::<universal::Universal, D>(),
        kind::<spherical::Spherical, D>(),
        kind::<planar::Planar, D>(),
        kind::<weld::Weld, D>(),
        kind::<distance::Distance, D>(),
        kind::<point_on_line::PointOnLine, D>(),
        kind::<gear::Gear, D>(),
        kind::<driver::Driver, D>(),
        kind::<equation::Equation, D>(),
    ]
}
