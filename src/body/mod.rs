//! Bodies: what moves, and what it answers at its markers.
//!
//! A body owns coordinates q (with q' = N(q) v) and markers. It answers the frames of its markers as functions of q,
//! and pulls a wrench at a marker back to its generalized forces, J^T w. Joints and forces see nothing else.
//!
//! To add one: a file with a [`BodySpec`] and a [`BodyKernel`], and a line in [`registry`].

mod build;
pub mod flexible;
mod frame;
mod guided;
mod parse;
mod point_mass;
mod probe;
mod rigid;
mod rigid_planar;
mod rigid_spatial;

pub use build::{Build, MarkerId, MarkerTable};
pub use frame::{Frame, Marker, Wrench, cross, dot, in_space, scale, sub, twist_len, unit_axes};
pub use parse::{parse, parse_among, show};
pub use probe::{Probe, Quantity, Signal, small_rotation, small_rotation_torque};
pub use rigid::Initial;
pub(crate) use rigid::quaternion;
pub(crate) use rigid_planar::RigidPlanar;
pub(crate) use rigid_spatial::RigidSpatial;

use crate::error::Result;
use crate::math::{Dual, Scalar, Taylor};
use schemars::{JsonSchema, Schema, SchemaGenerator};
use serde::de::DeserializeOwned;

/// Values with their derivatives along six coordinates: the second number every element is evaluated over.
pub type Slope = Dual<f64, 6>;

/// So many markers a joint or force may have: their frames are kept on the stack.
pub const MOST_MARKERS: usize = 8;

/// Energy of a body or force, J.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Energy {
    pub kinetic: f64,
    pub potential: f64,
}

/// A body's equations, written once over any scalar.
pub trait BodyKernel<const D: usize>: Send + Sync + 'static {
    /// Coordinate names without the body's, such as `x` or `qw`.
    fn coordinate_names(&self) -> Vec<&'static str>;
    /// Velocity names without the body's, such as `x'` or `wx`.
    fn velocity_names(&self) -> Vec<&'static str>;
    fn markers(&self) -> &[Marker<D>];

    /// q' = N(q) v, with N affine in q: constant for positions, linear for quaternions. Default: N = I.
    fn rate<S: Scalar>(&self, _q: &[S], v: &[S], qdot: &mut [S]) {
        qdot.copy_from_slice(v);
    }

    /// The frames of all markers, in their order.
    fn frames<S: Scalar>(&self, q: &[S], out: &mut [Frame<S, D>]);

    /// f += J^T w for a wrench at the frame of one of the markers.
    fn pull_back<S: Scalar>(&self, q: &[S], frame: &Frame<S, D>, wrench: &Wrench<S, D>, f: &mut [S]);

    /// Places of the mass matrix's lower triangle, in the order of the values of [`mass`](Self::mass).
    fn mass_pattern(&self) -> Vec<(usize, usize)>;
    fn mass<S: Scalar>(&self, q: &[S], values: &mut [S]);

    /// Whether its markers have an orientation.
    fn oriented(&self) -> bool {
        true
    }

    /// f += weight and velocity-dependent inertia forces.
    fn own_forces<S: Scalar>(&self, q: &[S], v: &[S], gravity: &[f64; D], f: &mut [S]);

    fn energy(&self, q: &[f64], v: &[f64], gravity: &[f64; D]) -> Energy;

    /// Brings redundant coordinates (a quaternion) back to their normal form.
    fn normalize(&self, _q: &mut [f64]) {}
}

/// A body over one scalar: what the model calls.
pub trait BodyOver<S: Scalar, const D: usize> {
    fn rate(&self, q: &[S], v: &[S], qdot: &mut [S]);
    /// Frames with their velocities, and their accelerations at v' = `vdot` (zero where it is not given).
    fn motion(&self, q: &[S], v: &[S], vdot: Option<&[S]>, out: &mut [Frame<Taylor<S>, D>]);
    fn pull_back(&self, q: &[S], frame: &Frame<S, D>, wrench: &Wrench<S, D>, f: &mut [S]);
    fn mass(&self, q: &[S], values: &mut [S]);
    fn own_forces(&self, q: &[S], v: &[S], gravity: &[f64; D], f: &mut [S]);
}

/// The object-safe form of a body; implemented for every [`BodyKernel`].
pub trait Body<const D: usize>: BodyOver<f64, D> + BodyOver<Slope, D> + Send + Sync {
    fn coordinate_names(&self) -> Vec<&'static str>;
    fn velocity_names(&self) -> Vec<&'static str>;
    fn marker_count(&self) -> usize;
    /// Where a marker is on the body.
    fn marker(&self, index: usize) -> &Marker<D>;
    fn mass_pattern(&self) -> Vec<(usize, usize)>;
    fn energy(&self, q: &[f64], v: &[f64], gravity: &[f64; D]) -> Energy;
    fn normalize(&self, q: &mut [f64]);
    /// Whether its markers have an orientation.
    fn oriented(&self) -> bool;
    /// Largest distance of a marker from the origin of the coordinates, m.
    fn reach(&self) -> f64;
}

/// More coordinates than this a rigid body never has; the motion of a longer one is computed on the heap.
const ON_STACK: usize = 8;

impl<K: BodyKernel<D>, S: Scalar, const D: usize> BodyOver<S, D> for K {
    fn rate(&self, q: &[S], v: &[S], qdot: &mut [S]) {
        BodyKernel::rate(self, q, v, qdot);
    }

    fn motion(&self, q: &[S], v: &[S], vdot: Option<&[S]>, out: &mut [Frame<Taylor<S>, D>]) {
        let mut stack = [Taylor::fixed(S::zero()); ON_STACK];
        let mut heap = Vec::new();
        let path = if q.len() <= ON_STACK {
            &mut stack[..q.len()]
        } else {
            heap.resize(q.len(), Taylor::fixed(S::zero()));
            &mut heap[..]
        };
        coordinate_path(self, q, v, vdot, path);
        self.frames(path, out);
    }

    fn pull_back(&self, q: &[S], frame: &Frame<S, D>, wrench: &Wrench<S, D>, f: &mut [S]) {
        BodyKernel::pull_back(self, q, frame, wrench, f);
    }
    fn mass(&self, q: &[S], values: &mut [S]) {
        BodyKernel::mass(self, q, values);
    }
    fn own_forces(&self, q: &[S], v: &[S], gravity: &[f64; D], f: &mut [S]) {
        BodyKernel::own_forces(self, q, v, gravity, f);
    }
}

/// q with q' = N(q) v and q'' = (N(q') - N(0)) v + N(q) v', from N's being affine in q.
fn coordinate_path<K: BodyKernel<D>, S: Scalar, const D: usize>(
    body: &K,
    q: &[S],
    v: &[S],
    vdot: Option<&[S]>,
    path: &mut [Taylor<S>],
) {
    if q.len() == v.len() {
        for (i, place) in path.iter_mut().enumerate() {
            *place = Taylor::new(q[i], v[i], vdot.map_or(S::zero(), |a| a[i]));
        }
        return;
    }
    let mut rates = [[S::zero(); ON_STACK]; 4];
    let [first, second, constant, applied] = &mut rates;
    let n = q.len();
    BodyKernel::rate(body, q, v, &mut first[..n]);
    BodyKernel::rate(body, &first[..n], v, &mut second[..n]);
    BodyKernel::rate(body, &[S::zero(); ON_STACK][..n], v, &mut constant[..n]);
    if let Some(vdot) = vdot {
        BodyKernel::rate(body, q, vdot, &mut applied[..n]);
    }
    for (i, place) in path.iter_mut().enumerate() {
        *place = Taylor::new(q[i], first[i], second[i] - constant[i] + applied[i]);
    }
}

impl<K: BodyKernel<D>, const D: usize> Body<D> for K {
    fn coordinate_names(&self) -> Vec<&'static str> {
        BodyKernel::coordinate_names(self)
    }
    fn velocity_names(&self) -> Vec<&'static str> {
        BodyKernel::velocity_names(self)
    }
    fn marker_count(&self) -> usize {
        self.markers().len()
    }
    fn marker(&self, index: usize) -> &Marker<D> {
        &self.markers()[index]
    }
    fn mass_pattern(&self) -> Vec<(usize, usize)> {
        BodyKernel::mass_pattern(self)
    }
    fn energy(&self, q: &[f64], v: &[f64], gravity: &[f64; D]) -> Energy {
        BodyKernel::energy(self, q, v, gravity)
    }
    fn normalize(&self, q: &mut [f64]) {
        BodyKernel::normalize(self, q);
    }
    fn oriented(&self) -> bool {
        BodyKernel::oriented(self)
    }
    fn reach(&self) -> f64 {
        self.markers().iter().map(|marker| dot(&marker.offset, &marker.offset).sqrt()).fold(0.0, f64::max)
    }
}

/// A body ready for the model, with the start its scene gives.
pub struct Built<const D: usize> {
    pub body: Box<dyn Body<D>>,
    pub q: Vec<f64>,
    pub v: Vec<f64>,
}

/// What a scene says of a kind of body.
pub trait BodySpec: DeserializeOwned + JsonSchema {
    const TYPE: &'static str;
    fn build<const D: usize>(&self, markers: Vec<Marker<D>>, initial: &Initial, build: &Build<D>) -> Result<Built<D>>;
}

/// One kind of body as the scene format, its schema and its errors know it.
pub struct Entry<const D: usize> {
    pub name: &'static str,
    pub schema: fn(&mut SchemaGenerator) -> Schema,
    pub build: BuildFromJson<D>,
}

type BuildFromJson<const D: usize> = fn(serde_json::Value, Vec<Marker<D>>, &Initial, &Build<D>) -> Result<Built<D>>;

fn entry<T: BodySpec, const D: usize>() -> Entry<D> {
    Entry {
        name: T::TYPE,
        schema: |generator| generator.subschema_for::<T>(),
        build: |json, markers, initial, build| parse_among::<T>(json, &SHARED_KEYS)?.build(markers, initial, build),
    }
}

/// The keys that all bodies have beside those of their kind.
pub const SHARED_KEYS: [&str; 5] = ["name", "type", "markers", "initial", "origin"];

/// Every kind of body, in the order of the documentation.
pub fn registry<const D: usize>() -> Vec<Entry<D>> {
    vec![entry::<rigid::Rigid, D>(), entry::<point_mass::PointMass, D>(), entry::<flexible::FlexibleBeam, D>()]
}
