//! A flexible beam in a floating frame, from what a scene says of it.

use super::Floating;
use crate::body::flexible::{FlexibleBeam, PointShape, elastic_beam};
use crate::body::{BodySpec, Build, Built, Initial, Marker};
use crate::error::{Error, Result, suggest};
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
    let (position, velocity) = initial.translation::<D>(build)?;
    let (mut q, mut v) = (position.to_vec(), velocity.to_vec());
    if D == 2 {
        let (angle, spin) = initial.planar(build)?;
        q.push(angle);
        v.push(spin);
    } else {
        let (quaternion, spin) = initial.spatial(build)?;
        q.extend(quaternion);
        v.extend(spin);
    }
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
