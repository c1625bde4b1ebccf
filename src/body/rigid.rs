//! Rigid body: its keys in a scene, and the choice of its coordinates.

use super::guided::Guided;
use super::inertia::{self, Inertia};
use super::orientation::{Orientation, quaternion};
use super::rigid_planar::RigidPlanar;
use super::rigid_spatial::RigidSpatial;
use super::shapes::{MassProperties, Shape};
use super::{BodySpec, Build, BuiltBody, Marker, cross};
use crate::error::{Error, Result};
use crate::math::array::{Each, from_fn};
use crate::math::expression::Number;
use crate::math::rotation::{Matrix3, matrix_from_quaternion, quaternion_from_axes};
use crate::tolerances;
use schemars::JsonSchema;
use serde::{Deserialize, Deserializer};
use std::collections::BTreeMap;

/// A rigid body: x, y and angle in the plane; position and unit quaternion in space. Its coordinates are those of its
/// centre of mass. It has `mass` and `inertia`, or `shapes` from which they and its centre of mass follow.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(extend("anyOf" = [{ "required": ["mass"] }, { "required": ["shapes"] }]))]
pub struct Rigid {
    /// kg; zero for a massless link whose motion the joints determine.
    #[serde(default, deserialize_with = "present")]
    #[schemars(with = "Number")]
    pub mass: Option<Number>,
    /// About the centre of mass, kg m^2: one number in the plane; in space 3 numbers (Ixx, Iyy, Izz) or 6 (Ixx, Iyy,
    /// Izz, Ixy, Ixz, Iyz), which are the entries of the inertia tensor in the body's axes, or, for a body that turns
    /// about one axis alone, the moment about that. A body that does not turn needs none.
    #[serde(default, deserialize_with = "present")]
    #[schemars(with = "Inertia")]
    #[doc(hidden)]
    pub inertia: Option<Inertia>,
    /// In the place of `mass`, `inertia` and `origin`: parts, given in the body's axes from its origin, wherever that is;
    /// mass, centre of mass and inertia are those of their sum.
    pub shapes: Option<Vec<Shape>>,
    /// Only these coordinates of the centre of mass move: of x, y, angle in the plane; in space of x, y, z and one of
    /// rx, ry, rz (rotation about that world axis through the centre of mass: `["rz"]` is a flywheel). For a body that
    /// turns about another point take a revolute joint. Default: all.
    pub free: Option<Vec<String>>,
}

/// A value that is there, which `null` is not.
fn present<'de, D: Deserializer<'de>, T: Deserialize<'de>>(deserializer: D) -> Result<Option<T>, D::Error> {
    T::deserialize(deserializer).map(Some)
}

/// Where a body starts: a guess, which assembly makes consistent with the joints.
#[derive(Deserialize, JsonSchema, Default)]
#[serde(deny_unknown_fields)]
pub struct Initial {
    /// Of the body's origin in the world, m. Default: zero.
    pub position: Option<Vec<Number>>,
    /// In the plane, rad.
    pub angle: Option<Number>,
    /// In space: a unit quaternion [w, x, y, z] or a rotation vector of 3 numbers, rad.
    pub rotation: Option<Vec<Number>>,
    /// In space, instead of a rotation: direction of the body's z axis in the world.
    pub z_axis: Option<Vec<Number>>,
    /// In space, with or without `z_axis`: direction of its x axis, made square to z.
    pub x_axis: Option<Vec<Number>>,
    /// Of the body's origin in the world, m/s.
    pub velocity: Option<Vec<Number>>,
    /// rad/s: one number in the plane; 3 numbers in the body's axes in space, or one about the only axis that is `free`.
    #[doc(hidden)]
    pub angular_velocity: Option<Inertia>,
    /// Of a flexible body in a floating frame: elastic coordinates by name, as `check` lists them. Default: zero.
    pub elastic: Option<BTreeMap<String, Number>>,
    /// Their rates. Default: zero.
    pub elastic_velocity: Option<BTreeMap<String, Number>>,
    /// Position of the body's origin from its centre of mass, which the body itself states; empty if it does not.
    #[serde(skip)]
    pub origin: Vec<f64>,
}

impl Initial {
    fn orientation(&self) -> Orientation<'_> {
        Orientation { rotation: &self.rotation, z_axis: &self.z_axis, x_axis: &self.x_axis }
    }

    /// Refuses initial elastic coordinates, for bodies that have none.
    pub fn refuse_elastic(&self) -> Result<()> {
        let given = [("elastic", &self.elastic), ("elastic_velocity", &self.elastic_velocity)];
        match given.iter().find(|(_, given)| given.is_some()) {
            None => Ok(()),
            Some((key, _)) => Err(Error::input("this body has no elastic coordinates")
                .under(format!("initial.{key}"))
                .hint("remove it, or use a flexible_beam with \"frame\": \"floating\"")),
        }
    }

    /// Angle and its rate in the plane, rad and rad/s.
    pub fn planar<const D: usize>(&self, build: &Build<D>) -> Result<(f64, f64)> {
        if let Some(key) = self.orientation().given() {
            return Err(Error::input("a planar body turns by an angle")
                .under(format!("initial.{key}"))
                .hint("give \"angle\" in radians"));
        }
        let angle = self.angle.as_ref().map_or(Ok(0.0), |angle| build.angle("initial.angle", angle))?;
        let spin = match &self.angular_velocity {
            None => 0.0,
            Some(Inertia::Moment(number)) => build.number("initial.angular_velocity", number)?,
            Some(Inertia::Tensor(numbers)) => build.vector::<1>("initial.angular_velocity", numbers)?[0],
        };
        Ok((angle, spin))
    }

    /// Unit quaternion and angular velocity in the body's axes, rad/s.
    pub fn spatial<const D: usize>(&self, build: &Build<D>) -> Result<([f64; 4], [f64; 3])> {
        self.spatial_about(None, build)
    }

    /// The same; `axis` is the only one of the world about which the body turns, if there is one only.
    fn spatial_about<const D: usize>(&self, axis: Option<usize>, build: &Build<D>) -> Result<([f64; 4], [f64; 3])> {
        if self.angle.is_some() {
            return Err(Error::input("a spatial body needs more than one angle").under("initial.angle").hint(
                "give \"rotation\" as a quaternion [w, x, y, z] or a rotation vector, or \"z_axis\" and \"x_axis\"",
            ));
        }
        let aimed = self.orientation().aimed(build).map_err(|error| error.under("initial"))?;
        let quaternion = match aimed {
            Some(axes) => quaternion_from_axes(&axes),
            None => quaternion("initial.rotation", self.rotation.as_deref(), build)?,
        };
        let spin = match &self.angular_velocity {
            None => [0.0; 3],
            Some(Inertia::Moment(rate)) if let Some(axis) = axis => {
                let rate = build.number("initial.angular_velocity", rate)?;
                matrix_from_quaternion(&quaternion)[axis].each(|part| rate * part)
            }
            Some(Inertia::Moment(_)) => {
                return Err(Error::input("expected 3 numbers, found one")
                    .under("initial.angular_velocity")
                    .hint("give [wx, wy, wz] in the body's axes, rad/s"));
            }
            Some(Inertia::Tensor(numbers)) => build.vector("initial.angular_velocity", numbers)?,
        };
        Ok((quaternion, spin))
    }

    /// Position, m, and velocity, m/s, of the body's origin in the world.
    pub fn translation<const D: usize>(&self, build: &Build<D>) -> Result<([f64; D], [f64; D])> {
        let position = start_vector::<D>("initial.position", &self.position, build)?;
        Ok((position, start_vector::<D>("initial.velocity", &self.velocity, build)?))
    }

    /// Coordinates and velocities of a frame that moves freely: position with angle or quaternion, velocity with spin.
    pub fn motion<const D: usize>(&self, build: &Build<D>) -> Result<(Vec<f64>, Vec<f64>)> {
        let (position, velocity) = self.translation::<D>(build)?;
        if D == 2 {
            let (angle, spin) = self.planar(build)?;
            return Ok(([&position[..], &[angle]].concat(), [&velocity[..], &[spin]].concat()));
        }
        let (quaternion, spin) = self.spatial(build)?;
        Ok(([&position[..], &quaternion].concat(), [&velocity[..], &spin].concat()))
    }

    /// Refuses an initial rotation, for point masses.
    pub fn refuse_rotation(&self) -> Result<()> {
        let is_turned = self.angle.is_some() || self.orientation().given().is_some();
        if is_turned || self.angular_velocity.is_some() {
            Err(Error::input("a point mass has no rotation")
                .under("initial")
                .hint("remove angle, rotation and angular_velocity, or use a body of type \"rigid\""))
        } else {
            Ok(())
        }
    }
}

pub(super) fn start_vector<const D: usize>(
    field: &str,
    numbers: &Option<Vec<Number>>,
    build: &Build<D>,
) -> Result<[f64; D]> {
    numbers.as_ref().map_or(Ok([0.0; D]), |numbers| build.vector(field, numbers))
}

impl BodySpec for Rigid {
    const TYPE: &'static str = "rigid";

    fn build<const D: usize>(
        &self,
        mut markers: Vec<Marker<D>>,
        initial: &Initial,
        build: &Build<D>,
    ) -> Result<BuiltBody<D>> {
        initial.refuse_elastic()?;
        let (mass, made_of) = self.mass_properties(initial, build)?;
        let (position, velocity) = initial.translation(build)?;
        // From the centre of mass to the origin that markers and `initial` refer to.
        let mut origin: [f64; 3] = from_fn(|i| initial.origin.get(i).copied().unwrap_or(0.0));
        if let Some(made_of) = &made_of {
            origin = made_of.centre.each(|x| -x);
            markers.iter_mut().for_each(|marker| marker.offset = from_fn(|i| marker.offset[i] + origin[i]));
        }
        let tensor = made_of.map(|made_of| made_of.inertia);
        let data = RigidData { mass, tensor, origin, position, velocity, markers };
        match D {
            2 => self.planar(data, initial, build),
            _ => self.spatial(data, initial, build),
        }
    }
}

/// What a body is built from in the plane and in space.
struct RigidData<const D: usize> {
    mass: f64,
    /// Tensor of inertia about the centre of mass, if the body is made of shapes.
    tensor: Option<Matrix3>,
    /// The body's origin from its centre of mass, in the body's axes, m.
    origin: [f64; 3],
    /// Position of the origin in the world, m.
    position: [f64; D],
    /// Velocity of the origin in the world, m/s.
    velocity: [f64; D],
    /// Markers from the centre of mass.
    markers: Vec<Marker<D>>,
}

impl Rigid {
    /// Mass, and what follows from shapes.
    fn mass_properties<const D: usize>(
        &self,
        initial: &Initial,
        build: &Build<D>,
    ) -> Result<(f64, Option<MassProperties>)> {
        let missing = |key: &str| {
            Error::input(format!("the key `{key}` is missing"))
                .hint(format!("add \"{key}\": ...; `holonom schema` says what it means"))
        };
        let Some(shapes) = &self.shapes else {
            let mass = build.not_negative("mass", self.mass.as_ref().ok_or_else(|| missing("mass"))?)?;
            return Ok((mass, None));
        };
        let given = [
            ("mass", self.mass.is_some()),
            ("inertia", self.inertia.is_some()),
            ("origin", !initial.origin.is_empty()),
        ];
        if let Some((key, _)) = given.iter().find(|(_, given)| *given) {
            return Err(Error::input(format!("`{key}` is given, and `shapes` from which it follows"))
                .under(key)
                .hint("keep one of them"));
        }
        let made_of = MassProperties::of(shapes, build)?;
        let hint = || Some("put holes within what they are cut from".to_string());
        inertia::physical(&made_of.inertia).map_err(|error| error.at("shapes").changed(|input| input.hint = hint()))?;
        Ok((made_of.mass, Some(made_of)))
    }

    fn planar<const D: usize>(&self, data: RigidData<D>, initial: &Initial, build: &Build<D>) -> Result<BuiltBody<D>> {
        let RigidData { mass, tensor, origin, position, velocity, markers } = data;
        let [x, y, _] = origin;
        let (angle, spin) = initial.planar(build)?;
        // From the centre of mass to the body's origin, in the world.
        let (s, c) = angle.sin_cos();
        let arm = [c * x - s * y, s * x + c * y];
        let start = [position[0] - arm[0], position[1] - arm[1], angle];
        let rates = [velocity[0] + spin * arm[1], velocity[1] - spin * arm[0], spin];
        let free = self.free_slots(&["x", "y", "angle"])?;
        let turns = free.contains(&2) || self.inertia.is_some();
        let inertia = match tensor {
            Some(tensor) => tensor[2][2],
            None if turns => inertia::planar(&self.inertia, build)?,
            None => 0.0,
        };
        let kept = |i: usize| if free.contains(&i) { rates[i] } else { 0.0 };
        let moves = [kept(0) - kept(2) * arm[1], kept(1) + kept(2) * arm[0]];
        refuse_locked("velocity", &velocity, &moves)?;
        refuse_locked("angular_velocity", &[spin], &[kept(2)])?;
        let body = RigidPlanar::new(mass, inertia, start, &free, markers);
        let pick = |all: [f64; 3]| free.iter().map(|&i| all[i]).collect();
        Ok(BuiltBody { body: Box::new(body), q: pick(start), v: pick(rates) })
    }

    fn spatial<const D: usize>(&self, data: RigidData<D>, initial: &Initial, build: &Build<D>) -> Result<BuiltBody<D>> {
        let RigidData { mass, tensor, origin, position, velocity, markers } = data;
        let free = self.free_slots(&["x", "y", "z", "rx", "ry", "rz"])?;
        let axes: Vec<usize> = free.iter().filter_map(|i| i.checked_sub(3)).collect();
        let (quaternion, spin) = initial.spatial_about(axes.first().copied().filter(|_| axes.len() == 1), build)?;
        // From the centre of mass to the body's origin, in the world.
        let rotation = matrix_from_quaternion(&quaternion);
        let turned = |v: [f64; 3]| -> [f64; 3] { from_fn(|i| (0..3).map(|j| rotation[i][j] * v[j]).sum()) };
        let arm = turned(origin);
        let world_spin = turned(spin);
        let lever = cross(&world_spin, &arm);
        let start: [f64; 3] = from_fn(|i| position[i] - arm[i]);
        let given = velocity;
        let velocity: [f64; 3] = from_fn(|i| velocity[i] - lever[i]);
        if free.len() == 6 {
            let inertia = tensor.map_or_else(|| inertia::tensor(&self.inertia, build), Ok)?;
            let q = [&start[..], &quaternion].concat();
            let v = [&velocity[..], &spin].concat();
            return Ok(BuiltBody { body: Box::new(RigidSpatial { mass, inertia, markers }), q, v });
        }
        let turns: [f64; 3] = from_fn(|i| if free.contains(&(i + 3)) { world_spin[i] } else { 0.0 });
        let swept = cross(&turns, &arm);
        let moves: [f64; 3] = from_fn(|i| swept[i] + if free.contains(&i) { velocity[i] } else { 0.0 });
        let axis = axes.first().copied().or(self.inertia.as_ref().map(|_| 2));
        let moment = axis.map_or(Ok(0.0), |axis| match &tensor {
            Some(tensor) => Ok(inertia::moment(tensor, &rotation[axis])),
            None => inertia::about(&self.inertia, &rotation[axis], build),
        })?;
        let body = Guided::new(mass, moment, start, rotation, &free, markers)?;
        refuse_locked("velocity", &given, &moves)?;
        refuse_locked("angular_velocity", &world_spin, &turns)?;
        let q = free.iter().map(|&i| if i < 3 { start[i] } else { 0.0 }).collect();
        let v = free.iter().map(|&i| if i < 3 { velocity[i] } else { world_spin[i - 3] }).collect();
        Ok(BuiltBody { body: Box::new(body), q, v })
    }

    /// Indices of the free coordinates among `names`, in their order.
    fn free_slots(&self, names: &[&str]) -> Result<Vec<usize>> {
        let Some(free) = &self.free else { return Ok((0..names.len()).collect()) };
        for (i, name) in free.iter().enumerate() {
            if !names.contains(&name.as_str()) {
                return Err(Error::unknown("coordinate", name, names.iter().copied()).under(format!("free[{i}]")));
            }
        }
        if free.is_empty() {
            return Err(Error::input("no coordinate is free")
                .under("free")
                .hint(format!("name some of {}, or put the markers on the ground", names.join(", "))));
        }
        Ok((0..names.len()).filter(|&i| free.iter().any(|name| name == names[i])).collect())
    }
}

/// Refuses an initial velocity that is given along what is not free: components that are not zero, and not those with
/// which the free coordinates move the body's origin.
fn refuse_locked(field: &str, given: &[f64], moves: &[f64]) -> Result<()> {
    let scale = crate::math::largest(given);
    let differs = |(x, own): (&f64, &f64)| *x != 0.0 && (x - own).abs() > tolerances::SAME * scale;
    if given.iter().zip(moves).any(differs) {
        Err(Error::input("the body cannot move like that: only the coordinates in `free` move")
            .under(format!("initial.{field}"))
            .hint("remove what is along other directions, or add them to \"free\""))
    } else {
        Ok(())
    }
}
