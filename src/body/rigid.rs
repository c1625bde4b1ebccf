//! Rigid body: its keys in a scene, and the choice of its coordinates.

use super::guided::Guided;
use super::rigid_planar::RigidPlanar;
use super::rigid_spatial::RigidSpatial;
use super::{BodySpec, Build, Built, Marker, cross, norm};
use crate::error::{Error, Result, short, suggest};
use crate::math::expression::Number;
use crate::math::rotation::{Matrix3, matrix_from_quaternion, quaternion_from_vector};
use nalgebra::{Matrix3 as Tensor, SymmetricEigen};
use schemars::JsonSchema;
use serde::Deserialize;
use std::array::from_fn;
use std::collections::BTreeMap;

/// A rigid body: x, y and angle in the plane; position and unit quaternion in space. Its coordinates are those of its
/// centre of mass.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Rigid {
    /// kg; zero for a massless link whose motion the joints determine.
    pub mass: Number,
    /// About the centre of mass, kg m^2: one number in the plane; in space 3 numbers (Ixx, Iyy, Izz) or 6 (Ixx, Iyy,
    /// Izz, Ixy, Ixz, Iyz), which are the entries of the inertia tensor in the body's axes.
    pub inertia: Inertia,
    /// Only these coordinates move: of x, y, angle in the plane; in space of x, y, z and one of rx, ry, rz (rotation
    /// about that world axis). Default: all.
    pub free: Option<Vec<String>>,
}

#[derive(Deserialize, JsonSchema)]
#[serde(untagged, expecting = "expected a number, an expression such as \"m*l^2/12\", or a list of these")]
pub enum Inertia {
    Moment(Number),
    Tensor(Vec<Number>),
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
    /// Of the body's origin in the world, m/s.
    pub velocity: Option<Vec<Number>>,
    /// rad/s: one number in the plane, 3 numbers in the body's axes in space.
    pub angular_velocity: Option<Inertia>,
    /// Of a flexible body in a floating frame: elastic coordinates by name, as `check` lists them. Default: zero.
    pub elastic: Option<BTreeMap<String, Number>>,
    /// Their rates. Default: zero.
    pub elastic_velocity: Option<BTreeMap<String, Number>>,
    /// Position of the body's origin from its centre of mass, which the body itself states.
    #[serde(skip)]
    pub origin: Vec<f64>,
}

impl Initial {
    fn origin_component(&self, i: usize) -> f64 {
        self.origin.get(i).copied().unwrap_or(0.0)
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
        if self.rotation.is_some() {
            return Err(Error::input("a planar body turns by an angle")
                .under("initial.rotation")
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
        if self.angle.is_some() {
            return Err(Error::input("a spatial body needs more than one angle")
                .under("initial.angle")
                .hint("give \"rotation\" as a quaternion [w, x, y, z] or a rotation vector"));
        }
        let quaternion = quaternion("initial.rotation", self.rotation.as_deref(), build)?;
        let spin = match &self.angular_velocity {
            None => [0.0; 3],
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

    /// Refuses an initial rotation, for point masses.
    pub fn refuse_rotation(&self) -> Result<()> {
        match self.angle.is_some() || self.rotation.is_some() || self.angular_velocity.is_some() {
            true => Err(Error::input("a point mass has no rotation")
                .under("initial")
                .hint("remove angle, rotation and angular_velocity, or use a body of type \"rigid\"")),
            false => Ok(()),
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

    fn build<const D: usize>(&self, markers: Vec<Marker<D>>, initial: &Initial, build: &Build<D>) -> Result<Built<D>> {
        initial.refuse_elastic()?;
        let mass = build.not_negative("mass", &self.mass)?;
        let (position, velocity) = initial.translation(build)?;
        match D {
            2 => self.planar(mass, position, velocity, markers, initial, build),
            _ => self.spatial(mass, position, velocity, markers, initial, build),
        }
    }
}

impl Rigid {
    fn planar<const D: usize>(
        &self,
        mass: f64,
        position: [f64; D],
        velocity: [f64; D],
        markers: Vec<Marker<D>>,
        initial: &Initial,
        build: &Build<D>,
    ) -> Result<Built<D>> {
        let inertia = match &self.inertia {
            Inertia::Moment(moment) => build.not_negative("inertia", moment)?,
            Inertia::Tensor(numbers) => {
                return Err(Error::input(format!("expected one number, found {}", numbers.len()))
                    .under("inertia")
                    .hint("a planar body has one moment of inertia, about its centre of mass"));
            }
        };
        let (angle, spin) = initial.planar(build)?;
        // From the body's origin to its centre of mass.
        let (s, c) = angle.sin_cos();
        let [x, y] = [initial.origin_component(0), initial.origin_component(1)];
        let arm = [c * x - s * y, s * x + c * y];
        let start = [position[0] - arm[0], position[1] - arm[1], angle];
        let rates = [velocity[0] + spin * arm[1], velocity[1] - spin * arm[0], spin];
        let free = self.free_slots(&["x", "y", "angle"])?;
        let body = RigidPlanar::new(mass, inertia, start, &free, markers);
        let pick = |all: [f64; 3]| free.iter().map(|&i| all[i]).collect();
        Ok(Built { body: Box::new(body), q: pick(start), v: pick(rates) })
    }

    fn spatial<const D: usize>(
        &self,
        mass: f64,
        position: [f64; D],
        velocity: [f64; D],
        markers: Vec<Marker<D>>,
        initial: &Initial,
        build: &Build<D>,
    ) -> Result<Built<D>> {
        let inertia = self.tensor(build)?;
        let (quaternion, spin) = initial.spatial(build)?;
        let free = self.free_slots(&["x", "y", "z", "rx", "ry", "rz"])?;
        // From the body's origin to its centre of mass.
        let rotation = matrix_from_quaternion(&quaternion);
        let turned = |v: [f64; 3]| -> [f64; 3] { from_fn(|i| (0..3).map(|j| rotation[i][j] * v[j]).sum()) };
        let arm = turned(from_fn(|i| initial.origin_component(i)));
        let world_spin = turned(spin);
        let lever = cross(&world_spin, &arm);
        let start: [f64; 3] = from_fn(|i| position[i] - arm[i]);
        let velocity: [f64; 3] = from_fn(|i| velocity[i] - lever[i]);
        if free.len() == 6 {
            let q = [&start[..], &quaternion].concat();
            let v = [&velocity[..], &spin].concat();
            return Ok(Built { body: Box::new(RigidSpatial { mass, inertia, markers }), q, v });
        }
        let body = Guided::new(mass, &inertia, start, rotation, &free, markers)?;
        let q = free.iter().map(|&i| if i < 3 { start[i] } else { 0.0 }).collect();
        let v = free.iter().map(|&i| if i < 3 { velocity[i] } else { world_spin[i - 3] }).collect();
        Ok(Built { body: Box::new(body), q, v })
    }

    /// Indices of the free coordinates among `names`, in their order.
    fn free_slots(&self, names: &[&str]) -> Result<Vec<usize>> {
        let Some(free) = &self.free else { return Ok((0..names.len()).collect()) };
        for (i, name) in free.iter().enumerate() {
            if !names.contains(&name.as_str()) {
                return Err(Error::input(format!("there is no coordinate `{name}`"))
                    .under(format!("free[{i}]"))
                    .hint(suggest(name, names.iter().copied())));
            }
        }
        if free.is_empty() {
            return Err(Error::input("no coordinate is free")
                .under("free")
                .hint(format!("name some of {}, or put the markers on the ground", names.join(", "))));
        }
        Ok((0..names.len()).filter(|&i| free.iter().any(|name| name == names[i])).collect())
    }

    fn tensor<const D: usize>(&self, build: &Build<D>) -> Result<Matrix3> {
        let numbers = match &self.inertia {
            Inertia::Tensor(numbers) if numbers.len() == 3 => {
                let [x, y, z] = build.vector::<3>("inertia", numbers)?;
                [x, y, z, 0.0, 0.0, 0.0]
            }
            Inertia::Tensor(numbers) if numbers.len() == 6 => build.vector::<6>("inertia", numbers)?,
            _ => {
                let found = if let Inertia::Tensor(numbers) = &self.inertia { numbers.len() } else { 1 };
                return Err(Error::input(format!("expected 3 or 6 numbers, found {found}"))
                    .under("inertia")
                    .hint("a spatial body has [Ixx, Iyy, Izz] or [Ixx, Iyy, Izz, Ixy, Ixz, Iyz]"));
            }
        };
        let [xx, yy, zz, xy, xz, yz] = numbers;
        let tensor = [[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]];
        physical(&tensor)?;
        Ok(tensor)
    }
}

/// Refuses an inertia tensor that no mass distribution has: principal moments must be >= 0 and each at most the sum of
/// the other two.
fn physical(tensor: &Matrix3) -> Result<()> {
    let mut moments: Vec<f64> =
        SymmetricEigen::new(Tensor::from_fn(|i, j| tensor[i][j])).eigenvalues.iter().copied().collect();
    moments.sort_by(f64::total_cmp);
    // Data are rounded to a few digits, so a thin rod may miss the bound by rounding.
    let slack = 1e-6 * moments[2].abs();
    if moments[0] < -slack {
        return Err(Error::input(format!(
            "a principal moment of inertia is {}, but cannot be negative",
            short(moments[0])
        ))
        .under("inertia")
        .hint("check the signs, and the order Ixx, Iyy, Izz, Ixy, Ixz, Iyz"));
    }
    if moments[2] > moments[0] + moments[1] + slack {
        let [a, b, c] = [moments[0], moments[1], moments[2]].map(short);
        return Err(Error::input(format!("principal moments {a}, {b}, {c} violate the triangle inequality"))
            .under("inertia")
            .hint("no body has one principal moment above the sum of the other two: check units and signs"));
    }
    Ok(())
}

/// Unit quaternion [w, x, y, z] from 4 numbers, or from a rotation vector of 3.
pub(crate) fn quaternion<const D: usize>(
    field: &str,
    numbers: Option<&[Number]>,
    build: &Build<D>,
) -> Result<[f64; 4]> {
    match numbers {
        None => Ok([1.0, 0.0, 0.0, 0.0]),
        Some(numbers) if numbers.len() == 3 => {
            let turn = build.vector::<3>(field, numbers)?;
            build.doubt_turns(field, norm(&turn));
            Ok(quaternion_from_vector(&turn))
        }
        Some(numbers) if numbers.len() == 4 => {
            let q = build.vector::<4>(field, numbers)?;
            let norm = q.iter().map(|x| x * x).sum::<f64>().sqrt();
            if norm < 1e-9 {
                return Err(Error::input("the quaternion is zero").under(field).hint("[1, 0, 0, 0] is no rotation"));
            }
            Ok(q.map(|x| x / norm))
        }
        Some(numbers) => Err(Error::input(format!("expected 4 or 3 numbers, found {}", numbers.len()))
            .under(field)
            .hint("give a quaternion [w, x, y, z] or a rotation vector [x, y, z] in radians")),
    }
}
