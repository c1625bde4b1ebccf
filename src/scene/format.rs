//! The scene file as it is typed: what a user may write, before anything is resolved.

use super::measures::OutputSpec;
use crate::body::Repeat;
use crate::math::expression::Number;
use crate::math::signal::{Beyond, Interpolation};
use crate::method_spec::MethodSpec;
use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::{Deserialize, Deserializer};
use serde_json::{Map, Value};
use std::borrow::Cow;
use std::collections::BTreeMap;

/// A scene: a mechanism with its start, what to watch and how to simulate it. Every number may be an expression over
/// `parameters`, as a string. SI units; angles in radians.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(title = "holonom scene")]
pub struct SceneFile {
    /// Where the JSON Schema of this format is, for editors.
    #[serde(rename = "$schema")]
    pub _schema: Option<String>,
    pub name: String,
    /// What the mechanism is and what to expect of it.
    pub about: Option<String>,
    /// Where its data and known results come from.
    #[serde(default)]
    pub references: Vec<String>,
    /// Words by which `holonom models TAG` lists it, such as linkage, vehicle or robot.
    #[serde(rename = "tags", default)]
    pub _tags: Vec<String>,
    pub dimension: Dimension,
    /// Named numbers and expressions over other parameters, in any order.
    #[serde(default)]
    #[schemars(with = "std::collections::BTreeMap<String, Number>")]
    pub parameters: Map<String, Value>,
    /// Measured data as functions of one argument.
    #[serde(default)]
    pub signals: Vec<SignalSpec>,
    /// Uniform: a vector, m/s^2; or towards a point of the ground. Default: none.
    #[schemars(with = "Option<Gravity>")]
    pub gravity: Option<Value>,
    /// Other scenes, whose elements are added under names of their own.
    #[serde(rename = "include", default)]
    pub _include: Vec<Include>,
    #[serde(default)]
    pub ground: Ground,
    /// See the types of bodies.
    #[schemars(with = "Vec<BodyPlace>")]
    pub bodies: Vec<Value>,
    #[serde(default)]
    #[schemars(with = "Vec<JointPlace>")]
    pub joints: Vec<Value>,
    #[serde(default)]
    #[schemars(with = "Vec<ForcePlace>")]
    pub forces: Vec<Value>,
    #[serde(default)]
    pub states: Vec<StateSpec>,
    #[serde(default)]
    pub inputs: Vec<InputSpec>,
    #[serde(default)]
    pub outputs: Vec<OutputSpec>,
    /// Coordinates of joints at the start, as JOINT.COORDINATE, and with ' their rates: `angle` (rad) of hinges,
    /// `position` (m) of sliders, both of cylindrical joints and of points on a line in the plane, `x`, `y` and `angle` of
    /// planar joints, `angle1` and `angle2` of universal ones. Assembly reaches them exactly.
    #[serde(default)]
    pub initial: BTreeMap<String, Number>,
    #[serde(default)]
    pub assembly: Assembly,
    #[serde(default)]
    pub simulation: Simulation,
}

/// Gravity, uniform or towards a point.
#[derive(JsonSchema)]
#[serde(untagged)]
#[allow(dead_code)]
pub enum Gravity {
    Uniform(Vec<Number>),
    Central(CentralGravity),
}

/// Gravity towards a point of the ground: acceleration -mu r/|r|^3 of each body's centre of mass, r from that point. It
/// has no gravity-gradient torque, and acts on rigid bodies and point masses.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct CentralGravity {
    /// Marker of the ground, such as `ground.Sun`.
    pub towards: String,
    /// Gravitational constant times attracting mass, m^3/s^2.
    pub mu: Number,
}

/// Another scene: its bodies, joints, forces, states, signals, inputs, outputs, markers of the ground, parameters and
/// start are added, with names that begin with `as` and an underscore, as in `left_crank.tip`, `ground.left_A` and
/// `left_l`. Its gravity and simulation do not count.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Include {
    /// File, from the folder of this one.
    pub file: String,
    /// Beginning of its names.
    #[serde(rename = "as")]
    pub prefix: String,
    /// Values of its parameters, in terms of those of this scene.
    #[serde(default)]
    #[schemars(with = "BTreeMap<String, Number>")]
    pub parameters: Map<String, Value>,
}

/// In how many dimensions the scene moves.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Dimension {
    Two,
    Three,
}

impl<'de> Deserialize<'de> for Dimension {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        match Value::deserialize(deserializer)?.as_u64() {
            Some(2) => Ok(Dimension::Two),
            Some(3) => Ok(Dimension::Three),
            _ => Err(serde::de::Error::custom("expected 2 for a planar scene or 3 for a spatial one")),
        }
    }
}

impl JsonSchema for Dimension {
    fn schema_name() -> Cow<'static, str> {
        "Dimension".into()
    }
    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        json_schema!({ "description": "2 for a planar scene, 3 for a spatial one.", "enum": [2, 3] })
    }
}

/// The body that does not move.
#[derive(Deserialize, JsonSchema, Default)]
#[serde(deny_unknown_fields)]
pub struct Ground {
    /// Points by name, as those of bodies.
    #[serde(default)]
    #[schemars(with = "std::collections::BTreeMap<String, MarkerSpec>")]
    pub markers: Map<String, Value>,
}

/// A marker: its position, or an object with an orientation.
#[derive(JsonSchema)]
#[serde(untagged)]
#[allow(dead_code)]
pub enum MarkerSpec {
    Point(Vec<Number>),
    Oriented(OrientedMarker),
}

/// A marker with an orientation.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct OrientedMarker {
    /// From the body's origin, in its axes, m.
    pub position: Vec<Number>,
    /// In the plane: angle of the marker's x axis, rad.
    pub angle: Option<Number>,
    /// In space: unit quaternion [w, x, y, z] or rotation vector.
    pub rotation: Option<Vec<Number>>,
    /// In space, instead of a rotation: direction of the marker's z axis.
    pub z_axis: Option<Vec<Number>>,
    /// In space, with or without `z_axis`: direction of the x axis, made square to z.
    pub x_axis: Option<Vec<Number>>,
    #[serde(rename = "repeat")]
    pub _repeat: Option<Repeat>,
}

/// A state xi of a controller, filter or actuator, xi' = rate: a number that applied forces and torques, other rates
/// and outputs use by its name.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct StateSpec {
    pub name: String,
    /// Value at the start. Default: zero.
    pub initial: Option<Number>,
    /// Its rate per second: an expression of t, marker quantities (`arm.angle`, `arm.tip.x'`), named outputs and states.
    pub rate: Number,
    #[serde(rename = "repeat")]
    pub _repeat: Option<Repeat>,
}

/// Measured data, which expressions use as a function of one argument: `road(t)`, `road(car.x)`. In `parameters` it is
/// not known.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SignalSpec {
    /// None of a function, a parameter, a state or an output.
    pub name: String,
    /// A table beside the scene: a line of names, if need be one of units, then lines of numbers in units of the SI,
    /// separated by commas, semicolons, tabs or blanks. Lines that begin with # are comments.
    pub file: Option<String>,
    /// Names of the columns with the argument, which increases, and the value. Default: the first two.
    pub columns: Option<[String; 2]>,
    /// In the place of a file: [x, y] in order of x.
    pub points: Option<Vec<[Number; 2]>>,
    /// Between points. Default: cubic.
    #[serde(default)]
    pub interpolation: Interpolation,
    /// Before the first and after the last point. Default: hold.
    #[serde(default)]
    pub beyond: Beyond,
}

/// A quantity u that adds to a component of an applied force or torque, to what a driver prescribes, or to the height of
/// a road: a column of B. Exactly one of `force`, `driver` and `tyre` is given.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct InputSpec {
    pub name: String,
    /// Name of an applied force or torque.
    pub force: Option<String>,
    /// Name of a joint of type `driver`: u adds to its value, m or rad.
    pub driver: Option<String>,
    /// Name of a force of type `tyre`: u adds to the height of its road, m.
    pub tyre: Option<String>,
    /// Of a force: x, y or z. Default: the only one, in the plane, of a torque.
    pub component: Option<String>,
    /// u in simulations, in N, N m, m or rad: an expression of t, for a force also of marker quantities and named
    /// outputs; linear models are taken about it. Default: zero.
    pub value: Option<Number>,
    #[serde(rename = "repeat")]
    pub _repeat: Option<Repeat>,
}

/// How the start is made consistent with the joints.
#[derive(Deserialize, JsonSchema, Default)]
#[serde(deny_unknown_fields)]
pub struct Assembly {
    /// Coordinates that keep their values and rates: `crank.angle`, or `crank` for all of a body's.
    #[serde(default)]
    pub hold: Vec<String>,
}

/// How to simulate; the command line overrides.
#[derive(Deserialize, JsonSchema, Default, Clone)]
#[serde(deny_unknown_fields)]
pub struct Simulation {
    /// s. Default: zero.
    pub t_start: Option<Number>,
    /// s
    pub t_end: Option<Number>,
    /// Distance of the rows of the trajectory, s. Default: a five-hundredth of the time.
    pub output_step: Option<Number>,
    /// Formulation, integrator and projection by trials along the motion, in the place of the three.
    pub method: Option<Automatic>,
    /// Form of the equations that is integrated. Default: `index1`.
    pub formulation: Option<MethodSpec>,
    /// Time integration method. Default: `dop853`.
    pub integrator: Option<MethodSpec>,
    /// Correction of q and v after a step. Default: `manifold`.
    pub projection: Option<MethodSpec>,
    /// Relative tolerance of the local error.
    pub rtol: Option<Number>,
    /// Absolute tolerance of the local error.
    pub atol: Option<Number>,
    /// Fixed step, s. Default: chosen by the integrator.
    pub step: Option<Number>,
    /// A table (CSV) beside the scene that accuracy is measured against: `t` and outputs by name.
    pub reference: Option<String>,
}

/// Lets the program choose.
#[derive(Deserialize, JsonSchema, Clone, Copy, Debug, PartialEq, Eq)]
#[serde(rename_all = "snake_case")]
pub enum Automatic {
    /// Choose by trials along the motion.
    Auto,
}

/// The keys that all bodies share.
#[derive(JsonSchema)]
#[allow(dead_code)]
pub struct BodyPlace {
    pub name: String,
    /// The kind of body.
    pub r#type: String,
    /// Points of the body by name, for joints and forces: [x, y], in space [x, y, z], in its own axes, or an object with
    /// `position` and an orientation: `angle`, in space `rotation`, `z_axis`, `x_axis`.
    pub markers: Option<std::collections::BTreeMap<String, MarkerSpec>>,
    /// Position of the body's origin, which its markers and `initial` refer to, from its centre of mass, m.
    pub origin: Option<Vec<Number>>,
    pub initial: Option<crate::body::Initial>,
    pub repeat: Option<Repeat>,
}

/// The keys that all joints share.
#[derive(JsonSchema)]
#[allow(dead_code)]
pub struct JointPlace {
    pub name: String,
    /// The kind of joint.
    pub r#type: String,
    pub repeat: Option<Repeat>,
}

/// The keys that all forces share.
#[derive(JsonSchema)]
#[allow(dead_code)]
pub struct ForcePlace {
    pub name: String,
    /// The kind of force.
    pub r#type: String,
    pub repeat: Option<Repeat>,
}
