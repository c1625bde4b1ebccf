//! Forces: wrenches at markers as functions of their motion and of time.
//!
//! A force is one kernel over moving frames; bodies pull its wrenches back to generalized forces. It also states its
//! potential: what its wrenches do beyond that is the work that the energy ledger counts.
//!
//! To add one: a file with a [`ForceSpec`] and a [`ForceKernel`], and a line in [`registry`].

mod applied;
mod beam;
mod bushing;
mod spring_damper;
mod torsion_spring;
mod tyre;

pub use beam::{Beam, Half, Load, Station};

use crate::body::{Build, Frame, MarkerId, Slope, Wrench, parse_among};
use crate::error::Result;
use crate::math::{Rate, Scalar, Taylor, Time};
use schemars::{JsonSchema, Schema, SchemaGenerator};
use serde::de::DeserializeOwned;

/// The moving frames of a force's markers.
pub type Motion<S, const D: usize> = [Frame<Taylor<S>, D>];
/// The time of an evaluation, as it goes on.
pub type Instant<'a, S> = Time<'a, Taylor<S>>;

/// What a force says beside its wrenches.
#[derive(Clone, Copy, Debug)]
pub struct Action<S> {
    /// Energy it stores, J, with its rate.
    pub potential: Taylor<S>,
    /// The scalar a user watches: tension of a spring (positive when it pulls), torque, tyre load; N or N m.
    pub magnitude: S,
}

impl<S: Scalar> Action<S> {
    /// A force that stores nothing.
    pub fn without_potential(magnitude: S) -> Self {
        Action { potential: Taylor::fixed(S::zero()), magnitude }
    }
}

/// A wheel as a drawing shows it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wheel {
    /// m
    pub radius: f64,
    /// Height of the road under it, m.
    pub road: f64,
}

/// A force's equations, written once over any scalar.
pub trait ForceKernel<const D: usize>: Send + Sync + 'static {
    /// One wrench a marker; `out` holds zeros on entry.
    fn act<S: Scalar>(&self, frames: &Motion<S, D>, time: Instant<S>, out: &mut [Wrench<S, D>]) -> Action<S>;
    /// The same where inputs drive it: `input` adds to its components, N or N m, in its own axes. Default: none can.
    fn driven<S: Scalar>(
        &self,
        _input: &[S; 3],
        frames: &Motion<S, D>,
        time: Instant<S>,
        out: &mut [Wrench<S, D>],
    ) -> Action<S> {
        ForceKernel::act(self, frames, time, out)
    }
    /// Writes the arguments of its switching functions at their numbers. Default: none.
    fn switching(&self, _frames: &Motion<Rate, D>, _time: Instant<Rate>, _out: &mut [Rate]) {}
    /// Whether its law takes the rotation between its markers to be small. Default: no.
    fn takes_small_rotations(&self) -> bool {
        false
    }
    /// The wheel that a drawing shows, if it is one.
    fn wheel(&self, _t: f64) -> Option<Wheel> {
        None
    }
    /// The element whose sections an output may watch, if it is one.
    fn beam(&self) -> Option<&Beam> {
        None
    }
}

/// A force over one scalar: what the model calls.
pub trait ForceOver<S: Scalar, const D: usize> {
    /// All inputs zero; `out` holds zeros on entry.
    fn act(&self, frames: &Motion<S, D>, time: Instant<S>, out: &mut [Wrench<S, D>]) -> Action<S>;
    /// With inputs that add to its components.
    fn driven(&self, input: &[S; 3], frames: &Motion<S, D>, time: Instant<S>, out: &mut [Wrench<S, D>]) -> Action<S>;
}

impl<K: ForceKernel<D>, S: Scalar, const D: usize> ForceOver<S, D> for K {
    fn act(&self, frames: &Motion<S, D>, time: Instant<S>, out: &mut [Wrench<S, D>]) -> Action<S> {
        ForceKernel::act(self, frames, time, out)
    }

    fn driven(&self, input: &[S; 3], frames: &Motion<S, D>, time: Instant<S>, out: &mut [Wrench<S, D>]) -> Action<S> {
        ForceKernel::driven(self, input, frames, time, out)
    }
}

/// The object-safe form of a force; implemented for every [`ForceKernel`].
pub trait Force<const D: usize>: ForceOver<f64, D> + ForceOver<Slope, D> + Send + Sync {
    fn wheel(&self, t: f64) -> Option<Wheel>;
    fn beam(&self) -> Option<&Beam>;
    fn takes_small_rotations(&self) -> bool;
    fn switching(&self, frames: &Motion<Rate, D>, time: Instant<Rate>, out: &mut [Rate]);
}

impl<K: ForceKernel<D>, const D: usize> Force<D> for K {
    fn wheel(&self, t: f64) -> Option<Wheel> {
        ForceKernel::wheel(self, t)
    }
    fn beam(&self) -> Option<&Beam> {
        ForceKernel::beam(self)
    }
    fn takes_small_rotations(&self) -> bool {
        ForceKernel::takes_small_rotations(self)
    }
    fn switching(&self, frames: &Motion<Rate, D>, time: Instant<Rate>, out: &mut [Rate]) {
        ForceKernel::switching(self, frames, time, out);
    }
}

/// A force ready for the model, with the markers it sees.
pub struct Built<const D: usize> {
    pub force: Box<dyn Force<D>>,
    pub markers: Vec<MarkerId>,
}

/// What a scene says of a kind of force.
pub trait ForceSpec: DeserializeOwned + JsonSchema {
    const TYPE: &'static str;
    /// Whether an input of the scene can drive it.
    const DRIVEN: bool = false;
    /// Whether what a user watches of it is a torque, N m, and no force.
    const TORQUE: bool = false;
    fn build<const D: usize>(&self, build: &Build<D>) -> Result<Built<D>>;
}

/// One kind of force as the scene format, its schema and its errors know it.
pub struct Entry<const D: usize> {
    pub name: &'static str,
    pub driven: bool,
    pub torque: bool,
    pub schema: fn(&mut SchemaGenerator) -> Schema,
    pub build: fn(serde_json::Value, &Build<D>) -> Result<Built<D>>,
}

fn entry<T: ForceSpec, const D: usize>() -> Entry<D> {
    Entry {
        name: T::TYPE,
        driven: T::DRIVEN,
        torque: T::TORQUE,
        schema: |generator| generator.subschema_for::<T>(),
        build: |json, build| parse_among::<T>(json, &["name", "type"])?.build(build),
    }
}

/// Every kind of force, in the order of the documentation. Gravity belongs to the scene.
pub fn registry<const D: usize>() -> Vec<Entry<D>> {
    vec![
        entry::<spring_damper::SpringDamper, D>(),
        entry::<torsion_spring::TorsionSpring, D>(),
        entry::<bushing::Bushing, D>(),
        entry::<beam::BeamForce, D>(),
        entry::<applied::AppliedForce, D>(),
        entry::<applied::AppliedTorque, D>(),
        entry::<tyre::Tyre, D>(),
    ]
}

/// Whether what a user watches of a kind of force is a torque.
pub fn is_torque<const D: usize>(kind: &str) -> bool {
    registry::<D>().iter().any(|entry| entry.name == kind && entry.torque)
}
