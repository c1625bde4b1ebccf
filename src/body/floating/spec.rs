//! A flexible beam in a floating frame, from what a scene says of it.

use super::Floating;
use crate::body::flexible::{FlexibleBeam, PointShape, elastic_beam};
use crate::body::rigid::{Inertia as Spin, start_vector};
use crate::body::{BodySpec, Build, Built, Initial, Marker, quaternion};
use crate::error::{Error, Result, short, suggest};
use crate::math::expression::Number;
use std::collections::BTreeMap;

impl BodySpec for FlexibleBeam {
    const TYPE: &'static str = "flexible_beam";

    fn build<const D: usize>(&self, markers: Vec<Marker<D>>, initial: &Initial, build: &Build<D>) -> Result<Built<D>> {
        refuse_origin(&markers)?;
        // The first marker is the frame itself.
        let places: Vec<f64> = markers.iter().skip(1).map(|marker| marker.offset[0]).collect();
        let (elastic, length) = elastic_beam::<D>(self, &places, build)?;
        let shapes = markers.iter().enumerate().map(|(i, marker)| match (&elastic.line, i) {
            (Some(line), 1..) => {
                let mut rest = marker.offset;
                rest[0] = rest[0].clamp(0.0, length);
                line.point(rest)
            }
            _ => frame_itself(),
        });
        let shapes = shapes.collect();
        let (q, v) = start(initial, &elastic.names, build)?;
        Ok(Built { body: Box::new(Floating::new(elastic, markers, shapes)), q, v })
    }
}

fn refuse_origin<const D: usize>(markers: &[Marker<D>]) -> Result<()> {
    match markers.first().is_some_and(|own| own.offset.iter().any(|x| *x != 0.0)) {
        false => Ok(()),
        true => Err(Error::input("the origin of a beam is its left end")
            .under("origin")
            .hint("remove it: markers lie at [s, y] or [s, y, z] from the left end")),
    }
}

/// The shape of a marker that is the floating frame.
pub(super) fn frame_itself<const D: usize>() -> PointShape<D> {
    PointShape { rest: [0.0; D], dofs: Vec::new(), translation: Vec::new(), rotation: Vec::new() }
}

/// Coordinates and velocities at the start, the elastic ones by their names.
pub(super) fn start<const D: usize>(
    initial: &Initial,
    names: &[String],
    build: &Build<D>,
) -> Result<(Vec<f64>, Vec<f64>)> {
    let mut q = start_vector::<D>("initial.position", &initial.position, build)?.to_vec();
    let mut v = start_vector::<D>("initial.velocity", &initial.velocity, build)?.to_vec();
    match D {
        2 if initial.rotation.is_some() => {
            return Err(Error::input("a planar body turns by an angle")
                .under("initial.rotation")
                .hint("give \"angle\" in radians"));
        }
        2 => q.push(build.number_or("initial.angle", &initial.angle, 0.0)?),
        _ if initial.angle.is_some() => {
            return Err(Error::input("a spatial body needs more than one angle")
                .under("initial.angle")
                .hint("give \"rotation\" as a quaternion [w, x, y, z] or a rotation vector"));
        }
        _ => q.extend(quaternion("initial.rotation", initial.rotation.as_deref(), build)?),
    }
    v.extend(spin(initial, build)?);
    q.extend(elastic("initial.elastic", &initial.elastic, names, build)?);
    v.extend(elastic("initial.elastic_velocity", &initial.elastic_velocity, names, build)?);
    Ok((q, v))
}

/// Values of the elastic coordinates, or of their rates; those not named are zero.
fn elastic<const D: usize>(
    field: &str,
    given: &Option<BTreeMap<String, Number>>,
    names: &[String],
    build: &Build<D>,
) -> Result<Vec<f64>> {
    let mut values = vec![0.0; names.len()];
    for (name, number) in given.iter().flatten() {
        let Some(place) = names.iter().position(|known| known == name) else {
            return Err(Error::input(format!("there is no elastic coordinate `{name}`"))
                .under(format!("{field}.{name}"))
                .hint(suggest(name, names.iter().map(String::as_str))));
        };
        values[place] = build.number(&format!("{field}.{name}"), number)?;
    }
    Ok(values)
}

/// Angular velocity at the start: a number in the plane, three in the body's axes in space.
fn spin<const D: usize>(initial: &Initial, build: &Build<D>) -> Result<Vec<f64>> {
    const FIELD: &str = "initial.angular_velocity";
    match (&initial.angular_velocity, D) {
        (None, 2) => Ok(vec![0.0]),
        (None, _) => Ok(vec![0.0; 3]),
        (Some(Spin::Moment(number)), 2) => Ok(vec![build.number(FIELD, number)?]),
        (Some(Spin::Tensor(numbers)), 2) => Ok(build.vector::<1>(FIELD, numbers)?.to_vec()),
        (Some(Spin::Tensor(numbers)), _) => Ok(build.vector::<3>(FIELD, numbers)?.to_vec()),
        (Some(Spin::Moment(number)), _) => Err(Error::input(format!(
            "expected 3 numbers, found {}",
            build.number(FIELD, number).map_or("one".to_string(), short)
        ))
        .under(FIELD)
        .hint("give [wx, wy, wz] in the body's axes, rad/s")),
    }
}
