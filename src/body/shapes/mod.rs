//! Mass, centre of mass and inertia of a rigid body from the shapes that it is made of.

mod crossing;
mod solid;
mod uniform;

pub use solid::{Form, Solid, solids};

use super::{Build, Orientation, Repeat, in_space};
use crate::error::{Error, Result, short};
use crate::math::expression::Number;
use crate::math::rotation::Matrix3;
use schemars::JsonSchema;
use serde::Deserialize;
use uniform::Uniform;

/// A part of uniform density: exactly one of `box`, `cylinder`, `tube`, `sphere`, `rod`, `plate`, `disc` and `polygon`,
/// with a `density` or a `mass`. In the plane z is normal to it.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Shape {
    /// Edges along x, y and z, m.
    pub r#box: Option<Vec<Number>>,
    /// About the z axis.
    pub cylinder: Option<Cylinder>,
    /// Hollow cylinder about the z axis.
    pub tube: Option<Tube>,
    pub sphere: Option<Round>,
    /// Straight, between two points.
    pub rod: Option<Rod>,
    /// Edges along x and y, m.
    pub plate: Option<Vec<Number>>,
    /// In the x-y plane.
    pub disc: Option<Round>,
    /// Corners [x, y] in the x-y plane, in order, m.
    pub polygon: Option<Vec<Vec<Number>>>,
    /// Of a plate, disc or polygon, half to each side along z, m. Default: none, as for a thin sheet.
    pub thickness: Option<Number>,
    /// kg/m^3
    pub density: Option<Number>,
    /// kg
    pub mass: Option<Number>,
    /// True for a hole, whose mass and inertia are taken away. Default: false.
    #[serde(default)]
    pub hole: bool,
    /// Of the shape's centre (of the origin that the points of a rod or polygon are given from), from the body's origin
    /// in its axes, m. Default: zero.
    pub at: Option<Vec<Number>>,
    /// In the plane: angle of the shape's x axis, rad.
    pub angle: Option<Number>,
    /// In space: unit quaternion [w, x, y, z] or rotation vector.
    pub rotation: Option<Vec<Number>>,
    /// In space, instead of a rotation: direction of the shape's z axis.
    pub z_axis: Option<Vec<Number>>,
    /// In space, with or without `z_axis`: direction of the x axis, made square to z.
    pub x_axis: Option<Vec<Number>>,
    #[serde(rename = "repeat")]
    pub _repeat: Option<Repeat>,
}

#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Cylinder {
    /// m
    pub radius: Number,
    /// m
    pub length: Number,
}

#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Tube {
    /// Outer radius, m.
    pub outer: Number,
    /// Inner radius, m.
    pub inner: Number,
    /// m
    pub length: Number,
}

#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Round {
    /// m
    pub radius: Number,
}

#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Rod {
    /// m
    pub from: Vec<Number>,
    /// m
    pub to: Vec<Number>,
    /// m. Default: slender.
    pub radius: Option<Number>,
}

/// Mass, centre of mass and inertia of a body.
#[derive(Clone)]
pub struct MassProperties {
    /// kg
    pub mass: f64,
    /// Centre of mass from the body's origin, in its axes, m.
    pub centre: [f64; 3],
    /// Tensor of inertia about the centre, in the body's axes, kg m^2.
    pub inertia: Matrix3,
}

impl MassProperties {
    /// Sum over parts; those of inertia alone, such as rotors, add that wherever they are.
    pub fn sum(parts: Vec<MassProperties>) -> Self {
        let (masses, rotors): (Vec<_>, Vec<_>) = parts.into_iter().partition(|part| part.mass > 0.0);
        let mut sum = Self::of_masses(masses);
        rotors.iter().for_each(|rotor| uniform::add(&mut sum.inertia, 1.0, &rotor.inertia));
        sum
    }

    fn of_masses(mut parts: Vec<MassProperties>) -> Self {
        if parts.len() < 2 {
            let none = MassProperties { mass: 0.0, centre: [0.0; 3], inertia: [[0.0; 3]; 3] };
            return parts.pop().unwrap_or(none);
        }
        let parts: Vec<(f64, Uniform)> =
            parts.iter().map(|part| (part.mass, Uniform::of_tensor(part.mass, part.centre, &part.inertia))).collect();
        let (mass, centre, inertia) = uniform::sum(&parts);
        MassProperties { mass, centre, inertia }
    }

    /// Sum over the shapes.
    pub fn of<const D: usize>(shapes: &[Shape], build: &Build<D>) -> Result<Self> {
        if shapes.is_empty() {
            return Err(Error::input("the list of shapes is empty").under("shapes").hint("give at least one shape"));
        }
        let part = |(i, shape): (usize, &Shape)| shape.part(build).map_err(|error| error.under(format!("shapes[{i}]")));
        let parts = shapes.iter().enumerate().map(part).collect::<Result<Vec<_>>>()?;
        let (mass, centre, inertia) = uniform::sum(&parts);
        if mass > 0.0 && mass.is_finite() {
            return Ok(MassProperties { mass, centre, inertia });
        }
        Err(Error::input(format!("the shapes have a mass of {} kg together", short(mass)))
            .under("shapes")
            .hint("make holes smaller than what they are cut from"))
    }
}

impl Shape {
    /// Mass, negative for a hole, and its distribution in the body's axes.
    fn part<const D: usize>(&self, build: &Build<D>) -> Result<(f64, Uniform)> {
        let own = self.uniform(build)?;
        let mass = match (&self.mass, &self.density) {
            (Some(mass), None) => build.positive("mass", mass)?,
            (None, Some(density)) if own.volume > 0.0 => own.volume * build.positive("density", density)?,
            (None, Some(_)) => {
                return Err(Error::input("the shape has a density, but no volume")
                    .under("density")
                    .hint("give a \"thickness\", a rod its \"radius\", or \"mass\" in the place of \"density\""));
            }
            _ => {
                return Err(Error::input("a shape has either a density or a mass")
                    .hint("give one of \"density\" (kg/m^3) and \"mass\" (kg)"));
            }
        };
        let at = self.at.as_ref().map_or(Ok([0.0; D]), |at| build.vector("at", at))?;
        let part = own.placed(in_space(&at), &self.axes(build)?);
        Ok((if self.hole { -mass } else { mass }, part))
    }

    fn axes<const D: usize>(&self, build: &Build<D>) -> Result<Matrix3> {
        let Shape { rotation, z_axis, x_axis, .. } = self;
        let orientation = Orientation { rotation, z_axis, x_axis };
        match (&self.angle, orientation.given()) {
            (Some(_), _) if D == 3 => Err(Error::input("a spatial shape needs more than one angle")
                .under("angle")
                .hint("give \"rotation\", or \"z_axis\" and \"x_axis\"")),
            (_, Some(key)) if D == 2 => {
                Err(Error::input("a planar shape is turned by an angle").under(key).hint("give \"angle\" in radians"))
            }
            (Some(angle), _) => {
                let (s, c) = build.angle("angle", angle)?.sin_cos();
                Ok([[c, s, 0.0], [-s, c, 0.0], [0.0, 0.0, 1.0]])
            }
            _ => orientation.axes(build),
        }
    }

    /// Names of the kinds of shapes that are given.
    fn kinds(&self) -> Vec<&'static str> {
        let all = [
            ("box", self.r#box.is_some()),
            ("cylinder", self.cylinder.is_some()),
            ("tube", self.tube.is_some()),
            ("sphere", self.sphere.is_some()),
            ("rod", self.rod.is_some()),
            ("plate", self.plate.is_some()),
            ("disc", self.disc.is_some()),
            ("polygon", self.polygon.is_some()),
        ];
        all.iter().filter(|(_, given)| *given).map(|(name, _)| *name).collect()
    }

    fn uniform<const D: usize>(&self, build: &Build<D>) -> Result<Uniform> {
        let kinds = self.kinds();
        let [kind] = kinds[..] else {
            let found = if kinds.is_empty() { "none".to_string() } else { kinds.join(" and ") };
            return Err(Error::input(format!("expected one kind of shape, found {found}"))
                .hint("give one of box, cylinder, tube, sphere, rod, plate, disc, polygon"));
        };
        let is_flat = ["plate", "disc", "polygon"].contains(&kind);
        if let (Some(_), false) = (&self.thickness, is_flat) {
            return Err(Error::input(format!("a {kind} has no thickness"))
                .under("thickness")
                .hint("remove it: plates, discs and polygons have one"));
        }
        let thickness = self.thickness.as_ref().map_or(Ok(0.0), |thickness| build.positive("thickness", thickness))?;
        self.of_kind(thickness, build).map_err(|error| error.under(kind))
    }

    fn of_kind<const D: usize>(&self, thickness: f64, build: &Build<D>) -> Result<Uniform> {
        if let Some(edges) = &self.r#box {
            return Ok(Uniform::cuboid(edges_of::<3, D>(edges, build)?));
        }
        if let Some(Cylinder { radius, length }) = &self.cylinder {
            return Ok(Uniform::tube(build.positive("radius", radius)?, 0.0, build.positive("length", length)?));
        }
        if let Some(tube) = &self.tube {
            return tube.uniform(build);
        }
        if let Some(Round { radius }) = &self.sphere {
            return Ok(Uniform::sphere(build.positive("radius", radius)?));
        }
        if let Some(rod) = &self.rod {
            return rod.uniform(build);
        }
        if let Some(edges) = &self.plate {
            let [a, b] = edges_of::<2, D>(edges, build)?;
            return Ok(Uniform::cuboid([a, b, thickness]));
        }
        if let Some(Round { radius }) = &self.disc {
            return Ok(Uniform::tube(build.positive("radius", radius)?, 0.0, thickness));
        }
        prism(self.polygon.as_deref().unwrap_or_default(), thickness, build)
    }
}

impl Tube {
    fn uniform<const D: usize>(&self, build: &Build<D>) -> Result<Uniform> {
        let [outer, inner] = [build.positive("outer", &self.outer)?, build.not_negative("inner", &self.inner)?];
        if inner < outer {
            Ok(Uniform::tube(outer, inner, build.positive("length", &self.length)?))
        } else {
            Err(Error::input(format!("the inner radius {} is not below the outer one {}", short(inner), short(outer)))
                .under("inner")
                .hint("\"outer\" and \"inner\" are radii"))
        }
    }
}

impl Rod {
    fn uniform<const D: usize>(&self, build: &Build<D>) -> Result<Uniform> {
        let [from, to] = [build.vector::<D>("from", &self.from)?, build.vector::<D>("to", &self.to)?];
        let radius = self.radius.as_ref().map_or(Ok(0.0), |radius| build.positive("radius", radius))?;
        if from == to {
            Err(Error::input("the rod has no length").under("to").hint("give two different points"))
        } else {
            Ok(Uniform::rod(in_space(&from), in_space(&to), radius))
        }
    }
}

/// N lengths above zero.
fn edges_of<const N: usize, const D: usize>(edges: &[Number], build: &Build<D>) -> Result<[f64; N]> {
    if edges.len() != N {
        return Err(Error::input(format!("expected {N} edges, found {}", edges.len()))
            .hint("a box has [a, b, c] along x, y and z, a plate [a, b]"));
    }
    let mut values = [0.0; N];
    for (i, (value, edge)) in values.iter_mut().zip(edges).enumerate() {
        *value = build.positive(&format!("[{i}]"), edge)?;
    }
    Ok(values)
}

fn prism<const D: usize>(corners: &[Vec<Number>], thickness: f64, build: &Build<D>) -> Result<Uniform> {
    let corner = |(i, corner): (usize, &Vec<Number>)| match corner.len() {
        2 => build.vector::<2>(&format!("[{i}]"), corner),
        n => Err(Error::input(format!("expected a corner [x, y], found {n} numbers")).under(format!("[{i}]"))),
    };
    let corners = corners.iter().enumerate().map(corner).collect::<Result<Vec<_>>>()?;
    let uniform = Uniform::prism(&corners, thickness);
    let is_flat = uniform.spread.iter().flatten().any(|x| !x.is_finite());
    if is_flat || crossing::crosses_itself(&corners) {
        Err(Error::input("the polygon encloses no area, or crosses itself")
            .hint("give three corners or more, in the order in which they follow each other"))
    } else {
        Ok(uniform)
    }
}
