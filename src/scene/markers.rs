//! Markers of bodies and of the ground.

use super::format::OrientedMarker;
use crate::body::{Build, Marker, Orientation, parse, show};
use crate::error::{Error, Result};
use crate::math::array::from_fn;
use crate::math::expression::{Number, Parameters};
use serde_json::{Map, Value};

/// The markers of one body, in the order of the scene. `origin` is added to their positions.
pub fn markers<const D: usize>(
    given: &Map<String, Value>,
    origin: &[f64; D],
    build: &Build<D>,
) -> Result<Vec<(String, Marker<D>)>> {
    let one = |(name, value): (&String, &Value)| {
        super::names::check_name(name).map_err(|error| error.under("markers"))?;
        let mut marker = marker(value, build).map_err(|error| error.under(name).under("markers"))?;
        marker.offset = from_fn(|i| marker.offset[i] + origin[i]);
        Ok((name.clone(), marker))
    };
    given.iter().map(one).collect()
}

fn marker<const D: usize>(value: &Value, build: &Build<D>) -> Result<Marker<D>> {
    if value.is_array() {
        let position: Vec<Number> = parse(value)?;
        return Ok(Marker::point(build.vector("", &position)?));
    }
    if !value.is_object() {
        return Err(Error::input(format!("expected a position, found {}", show(value)))
            .hint("write [x, y], [x, y, z] or {\"position\": [...], ...}"));
    }
    let given: OrientedMarker = parse(value)?;
    let mut marker = Marker::point(build.vector("position", &given.position)?);
    let OrientedMarker { rotation, z_axis, x_axis, .. } = &given;
    let orientation = Orientation { rotation, z_axis, x_axis };
    if D == 2 && orientation.given().is_some() {
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
    if orientation.given().is_some() {
        let axes = orientation.axes(build)?;
        marker.axes = from_fn(|i| from_fn(|j| axes[i][j]));
    }
    Ok(marker)
}

fn turn<const D: usize>(marker: &mut Marker<D>, angle: f64) {
    let (s, c) = angle.sin_cos();
    marker.turn = angle;
    (marker.axes[0][0], marker.axes[0][1]) = (c, s);
    (marker.axes[1][0], marker.axes[1][1]) = (-s, c);
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
