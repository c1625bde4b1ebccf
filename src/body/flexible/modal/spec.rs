//! Keys of a body in modal coordinates, in a scene or in a file of its own.

use super::array::Table;
use schemars::{JsonSchema, Schema, SchemaGenerator};
use serde::de::{Deserializer, MapAccess, Visitor};
use serde::{Deserialize, Serialize, Serializer};
use std::borrow::Cow;
use std::collections::BTreeMap;
use std::fmt;
use std::marker::PhantomData;

/// A flexible body by its modes, such as another program computes them: rigid coordinates of a frame that is fixed in the
/// data's axes, and one elastic coordinate a mode. Its markers are at the data's nodes. Points move in proportion to the
/// modes: what sections that turn and lines that shorten do to the inertia at second order is not in such data.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ModalBody {
    /// A file beside the scene with the keys of `data`: JSON, or `.npz` with one array a key. In `.npz` files `nodes` are
    /// `node_names` (optional; else node1, node2 ...), `node_positions` (m x dimension), `node_translations` (m x
    /// dimension x n) and `node_rotations` (m x 3 x n, m x n in the plane; optional); `lumped` are `lumped_masses` (m),
    /// `lumped_positions` and `lumped_translations`.
    pub file: Option<String>,
    /// Instead of `file`.
    pub data: Option<ModalData<Table>>,
}

/// Rigid inertia, modes and where they move things. n is the number of modes; positions are from the body's origin.
#[derive(Serialize, Deserialize, JsonSchema, Clone, Debug, Default, PartialEq)]
#[serde(deny_unknown_fields)]
pub struct ModalData<T> {
    /// kg. Left out with `lumped`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub mass: Option<T>,
    /// Centre of mass, m. Left out with `lumped`. Default: the origin.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub center: Option<T>,
    /// About the centre of mass, kg m^2: one number in the plane; in space 3 (Ixx, Iyy, Izz) or 6 (with Ixy, Ixz, Iyz).
    /// Left out with `lumped`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub inertia: Option<T>,
    /// n x n, or n on the diagonal. Left out with `lumped`. Default: one each (modes normalised to mass).
    #[serde(skip_serializing_if = "Option::is_none")]
    pub modal_mass: Option<T>,
    /// n x n, or n on the diagonal: squares of the angular frequencies where modes are normalised to mass.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub modal_stiffness: Option<T>,
    /// n x n, or n on the diagonal. Default: none.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub modal_damping: Option<T>,
    /// Momentum of the modes, int rho psi_i dV: n x dimension, kg. Default: zero, that of free-free modes.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub linear_coupling: Option<T>,
    /// Moment of momentum of the modes about the origin, int rho x cross psi_i dV: n x 3, or n in the plane, kg m.
    /// Default: zero.
    ///
    /// Momenta alone do not say how modes change the inertia: centrifugal forces within the modes are then those of
    /// motions that go in all directions alike, and `lumped` has them exactly.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub angular_coupling: Option<T>,
    /// Masses whose motion in the modes is known, such as those of a finite-element mesh. All inertia follows from them.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub lumped: Option<Vec<Lumped<T>>>,
    /// Places for markers, by name.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub nodes: Option<Nodes<T>>,
}

/// A place for a marker.
#[derive(Serialize, Deserialize, JsonSchema, Clone, Debug, PartialEq)]
#[serde(deny_unknown_fields)]
pub struct Node<T> {
    /// m
    pub position: T,
    /// Displacement a mode: dimension x n.
    pub translation: T,
    /// Rotation a mode: 3 x n, or n in the plane. Default: the modes do not turn it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub rotation: Option<T>,
}

/// A point mass.
#[derive(Serialize, Deserialize, JsonSchema, Clone, Debug, PartialEq)]
#[serde(deny_unknown_fields)]
pub struct Lumped<T> {
    /// kg
    pub mass: T,
    /// m
    pub position: T,
    /// Displacement a mode: dimension x n.
    pub translation: T,
}

/// Nodes by their names, in the order of the file.
#[derive(Clone, Debug, PartialEq)]
pub struct Nodes<T>(pub Vec<(String, Node<T>)>);

impl<'de, T: Deserialize<'de>> Deserialize<'de> for Nodes<T> {
    fn deserialize<De: Deserializer<'de>>(json: De) -> Result<Self, De::Error> {
        json.deserialize_map(Entries(PhantomData)).map(Nodes)
    }
}

struct Entries<T>(PhantomData<T>);

impl<'de, T: Deserialize<'de>> Visitor<'de> for Entries<T> {
    type Value = Vec<(String, Node<T>)>;
    fn expecting(&self, out: &mut fmt::Formatter) -> fmt::Result {
        write!(out, "nodes by their names")
    }
    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<Self::Value, A::Error> {
        std::iter::from_fn(|| map.next_entry().transpose()).collect()
    }
}

impl<T: Serialize> Serialize for Nodes<T> {
    fn serialize<S: Serializer>(&self, out: S) -> Result<S::Ok, S::Error> {
        out.collect_map(self.0.iter().map(|(name, node)| (name, node)))
    }
}

impl<T: JsonSchema> JsonSchema for Nodes<T> {
    fn schema_name() -> Cow<'static, str> {
        BTreeMap::<String, Node<T>>::schema_name()
    }
    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        BTreeMap::<String, Node<T>>::json_schema(generator)
    }
}
