//! Gravity of a scene: uniform, or towards a point of the ground.

use super::format::CentralGravity as Spec;
use super::model::{Connection, ModelForce, Part};
use super::parts::SceneParts;
use crate::body::{Build, parse};
use crate::error::{Error, Result};
use crate::force::CentralGravity;
use crate::math::expression::Number;
use serde_json::Value;

/// Acceleration of uniform gravity, m/s^2; zero where it is towards a point, or not given.
pub fn uniform<const D: usize>(given: &Option<Value>, build: &Build<D>) -> Result<[f64; D]> {
    match given {
        None | Some(Value::Object(_)) => Ok([0.0; D]),
        Some(list) => {
            let numbers: Vec<Number> = parse(list).map_err(|error| error.under("gravity"))?;
            build.vector("gravity", &numbers)
        }
    }
}

/// The forces of gravity towards a point, one on each body that has a mass and may move along an axis.
pub fn central<const D: usize>(
    given: &Option<Value>,
    SceneParts { bodies, beams, ground, .. }: &SceneParts<D>,
    build: &Build<D>,
) -> Result<Vec<ModelForce<D>>> {
    let Some(given @ Value::Object(_)) = given else { return Ok(Vec::new()) };
    let in_gravity = |error: Error| error.under("gravity");
    let spec: Spec = parse(given).map_err(in_gravity)?;
    let centre = build.marker("towards", &spec.towards).map_err(in_gravity)?;
    let Some(centre) = ground.get(centre).map(|marker| marker.offset) else {
        return Err(Error::input(format!("`{}` is on a body that moves", spec.towards))
            .under("gravity.towards")
            .hint("name a marker of the ground; bodies attract each other by a spring_damper with a `law`"));
    };
    if let Some(beam) = beams.first() {
        return Err(in_gravity(flexible(&beam.name)));
    }
    let mu = build.not_negative("mu", &spec.mu).map_err(in_gravity)?;
    let mut all: Vec<ModelForce<D>> = Vec::new();
    // States are the last bodies.
    for part in &bodies[..bodies.len() - build.markers.states.len()] {
        let mass = mass(part).map_err(in_gravity)?;
        if mass > 0.0 {
            let element = Box::new(CentralGravity::new(mu, mass, centre, &part.body.markers()[0].offset));
            let name = format!("gravity.{}", part.name);
            all.push(Connection { name, kind: "gravity", element, markers: vec![part.first_marker] });
        }
    }
    Ok(all)
}

/// Mass of a rigid body; zero if its centre of mass does not move.
fn mass<const D: usize>(part: &Part<D>) -> Result<f64> {
    let Some(freedom) = &part.facts.freedom else {
        return Err(flexible(&part.name));
    };
    let mut values = vec![0.0; part.facts.mass_pattern.len()];
    part.body.mass(&vec![0.0; part.nq], &mut values);
    let first = part.facts.mass_pattern.iter().position(|place| *place == (0, 0));
    Ok(first.filter(|_| !freedom.translations.is_empty()).map_or(0.0, |first| values[first]))
}

fn flexible(name: &str) -> Error {
    Error::input(format!("gravity towards a point acts on rigid bodies, but `{name}` is none"))
        .hint("give uniform gravity, or make it of rigid bodies")
}
