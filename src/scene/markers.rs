//! Markers of bodies and of the ground.

use super::format::OrientedMarker;
use crate::body::{Build, Marker, cross, parse, show};
use crate::error::{Error, Result};
use crate::math::expression::{Number, Parameters};
use crate::math::rotation::axes_from_quaternion;
use serde_json::{Map, Value};
use std::array::from_fn;

/// The markers of one body, in the order of the scene. `origin` is added to their positions.
pub fn markers<const D: usize>(
    given: &Map<String, Value>,
    origin: &[f64; D],
    build: &Build<D>,
) -> Result<Vec<(String, Marker<D>)>> {
    let one = |(name, value): (&String, &Value)| {
        super::resolve::check_name(name).map_err(|error| error.under("markers"))?;
        let mut marker = marker(value, build).map_err(|error| error.under(name).under("markers"))?;
        marker.offset = from_fn(|i| marker.offset[i] + origin[i]);
        Ok((name.clone(), marker))
    };
    given.iter().map(one).collect()
}

fn marker<const D: usize>(value: &Value, build: &Build<D>) -> Result<Marker<D>> {
    if value.is_array() {
        let position: Vec<Number> = parse(value)?;
        return Ok(Marker::point(vector(&position, build)?));
    }
    if !value.is_object() {
        return Err(Error::input(format!("expected a position, found {}", show(value)))
            .hint("write [x, y], [x, y, z] or {\"position\": [...], ...}"));
    }
    let given: OrientedMarker = parse(value)?;
    let mut marker = Marker::point(vector(&given.position, build).map_err(|error| error.under("position"))?);
    let spatial = given.rotation.is_some() || given.z_axis.is_some() || given.x_axis.is_some();
    if D == 2 && spatial {
        return Err(Error::input("a planar marker is turned by an angle").hint("give \"angle\" in radians"));
    }
    if D == 3 && given.angle.is_some() {
        return Err(Error::input("a spatial marker needs more than one angle")
            .under("angle")
            .hint("give \"rotation\", or \"z_axis\" and \"x_axis\""));
    }
    if let Some(angle) = &given.angle {
        turn(&mut marker, build.angle("angle", angle)?);
    }
    if let Some(rotation) = &given.rotation {
        let axes = axes_from_quaternion(&crate::body::quaternion("rotation", Some(rotation), build)?);
        marker.axes = from_fn(|i| from_fn(|j| axes[i][j]));
    }
    if given.z_axis.is_some() || given.x_axis.is_some() {
        if given.rotation.is_some() {
            return Err(Error::input("both a rotation and axes are given").hint("keep one of them"));
        }
        let axis = |field: &str, numbers: &Option<Vec<Number>>| {
            numbers.as_ref().map(|numbers| build.vector::<3>(field, numbers)).transpose()
        };
        let axes = triad(axis("z_axis", &given.z_axis)?, axis("x_axis", &given.x_axis)?)?;
        marker.axes = from_fn(|i| from_fn(|j| axes[i][j]));
    }
    Ok(marker)
}

fn vector<const D: usize>(numbers: &[Number], build: &Build<D>) -> Result<[f64; D]> {
    build.vector::<D>("", numbers).map_err(|error| match error {
        Error::Input(mut input) => {
            input.path = input.path.trim_start_matches('.').to_string();
            Error::Input(input)
        }
        other => other,
    })
}

fn turn<const D: usize>(marker: &mut Marker<D>, angle: f64) {
    let (s, c) = angle.sin_cos();
    marker.turn = angle;
    (marker.axes[0][0], marker.axes[0][1]) = (c, s);
    (marker.axes[1][0], marker.axes[1][1]) = (-s, c);
}

/// Right-handed unit axes [x, y, z] with the given z, and x the given one made orthogonal to z.
fn triad(z: Option<[f64; 3]>, x: Option<[f64; 3]>) -> Result<[[f64; 3]; 3]> {
    let unit = |v: [f64; 3], name: &str| -> Result<[f64; 3]> {
        let length = (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]).sqrt();
        match length > 1e-12 {
            true => Ok(v.map(|c| c / length)),
            false => Err(Error::input("the axis has no direction of its own")
                .under(name)
                .hint("give vectors that are not zero and not parallel")),
        }
    };
    let z = match (z, x) {
        (Some(z), _) => unit(z, "z_axis")?,
        // Only x given: z is the world axis least along it, made square to it.
        (None, x) => {
            let x = unit(x.unwrap_or([1.0, 0.0, 0.0]), "x_axis")?;
            let helper = if x[2].abs() < 0.9 { [0.0, 0.0, 1.0] } else { [0.0, 1.0, 0.0] };
            unit(without(helper, x), "x_axis")?
        }
    };
    let helper = x.unwrap_or(if z[0].abs() < 0.9 { [1.0, 0.0, 0.0] } else { [0.0, 1.0, 0.0] });
    let x = unit(without(helper, z), "x_axis")?;
    Ok([x, cross(&z, &x), z])
}

/// The part of `v` orthogonal to the unit vector `along`.
fn without(v: [f64; 3], along: [f64; 3]) -> [f64; 3] {
    let part = v[0] * along[0] + v[1] * along[1] + v[2] * along[2];
    from_fn(|i| v[i] - part * along[i])
}

/// Names and values of the parameters, in the order of the scene.
pub fn parameters(given: &Map<String, Value>) -> Result<Vec<(String, Number)>> {
    let one = |(name, value): (&String, &Value)| {
        let number = parse::<Number>(value).map_err(|error| error.under(name).under("parameters"))?;
        Ok((name.clone(), number))
    };
    given.iter().map(one).collect()
}

/// Values of the parameters, with overrides in place of those of the scene.
pub fn resolve(given: &Map<String, Value>, overrides: &[(String, Number)]) -> Result<Parameters> {
    Ok(Parameters::resolve(&parameters(given)?, overrides)?)
}
