//! Mass properties of geoms.

use super::place::from_z_to;
use super::settings::MjcfSettings;
use crate::body::{MassProperties, norm, sub};
use crate::error::{Result, excerpt};
use crate::import::transform::Transform;
use crate::import::xml::{Element, faulty};
use crate::math::array::{Each, from_fn};
use std::f64::consts::PI;

/// kg/m^3, where a geom has neither mass nor density.
const WATER: f64 = 1000.0;

/// A volume with the integrals of x^2, y^2 and z^2 over it, divided by it.
struct GeomVolume {
    volume: f64,
    spread: [f64; 3],
}

/// Mass properties of a geom in the frame of its body; `None` if they follow from a file.
pub fn mass(element: &Element, settings: &MjcfSettings) -> Result<Option<MassProperties>> {
    let kind = element.text("type").unwrap_or("sphere");
    let given = element.number("mass")?;
    let density = element.number_or("density", WATER)?;
    let has_none = given.map_or(density == 0.0, |mass| mass == 0.0) || ["plane", "hfield"].contains(&kind);
    if !has_none && (["mesh", "sdf"].contains(&kind) || element.text("mesh").is_some()) {
        return Ok(None);
    }
    if has_none {
        return Ok(Some(MassProperties { mass: 0.0, centre: [0.0; 3], inertia: [[0.0; 3]; 3] }));
    }
    let (frame, size) = frame_and_size(element, settings, kind)?;
    let GeomVolume { volume, spread } = solid(element, kind, &size)?;
    let mass = given.unwrap_or(density * volume);
    let sum: f64 = spread.iter().sum();
    let inertia = from_fn(|i| from_fn(|j| if i == j { mass * (sum - spread[i]) } else { 0.0 }));
    Ok(Some(frame.mass(&MassProperties { mass, centre: [0.0; 3], inertia })))
}

/// The frame of a geom in its body and its sizes; `fromto` gives both ends of its z axis.
fn frame_and_size(element: &Element, settings: &MjcfSettings, kind: &str) -> Result<(Transform, Vec<f64>)> {
    let mut size = element.list("size")?;
    let Some([a, b, c, d, e, f]) = element.numbers("fromto")? else { return Ok((settings.place(element)?, size)) };
    let from = [a, b, c];
    let to = [d, e, f];
    let along = sub(&from, &to);
    let length = norm(&along);
    if length == 0.0 {
        return Err(faulty(element.node, "the ends in `fromto` are one point"));
    }
    let radius = size.first().copied().unwrap_or(0.0);
    size = if kind == "capsule" || kind == "cylinder" { vec![radius] } else { vec![radius, radius] };
    size.push(0.5 * length);
    let turn = from_z_to(along.each(|x| x / length));
    Ok((Transform { r: from_fn(|i| 0.5 * (from[i] + to[i])), turn }, size))
}

/// A solid of half sizes or radius and half length.
fn solid(element: &Element, kind: &str, size: &[f64]) -> Result<GeomVolume> {
    let known = [("sphere", 1), ("capsule", 2), ("cylinder", 2), ("box", 3), ("ellipsoid", 3)];
    let Some((_, count)) = known.iter().find(|(known, _)| *known == kind) else {
        return Err(faulty(element.node, format!("there is no geom of type `{}`", excerpt(kind))));
    };
    if size.len() < *count || size[..*count].iter().any(|size| *size <= 0.0) {
        let found = size.len();
        return Err(faulty(element.node, format!("a {kind} has {count} sizes above zero in `size`, found {found}")));
    }
    let [r, h] = [size[0], size.get(1).copied().unwrap_or(0.0)];
    Ok(match kind {
        "sphere" => ellipsoid([r; 3]),
        "capsule" => capsule(r, h),
        "cylinder" => GeomVolume { volume: 2.0 * PI * r * r * h, spread: [0.25 * r * r, 0.25 * r * r, h * h / 3.0] },
        "box" => {
            GeomVolume { volume: 8.0 * size[..3].iter().product::<f64>(), spread: from_fn(|i| size[i] * size[i] / 3.0) }
        }
        _ => ellipsoid(from_fn(|i| size[i])),
    })
}

fn ellipsoid(axes: [f64; 3]) -> GeomVolume {
    GeomVolume { volume: 4.0 / 3.0 * PI * axes.iter().product::<f64>(), spread: axes.each(|a| 0.2 * a * a) }
}

/// A cylinder of half length h between two half spheres; the mean of (h + z)^2 over one of these is
/// h^2 + 2 h (3/8) r + r^2/5.
fn capsule(r: f64, h: f64) -> GeomVolume {
    let rod = 2.0 * PI * r * r * h;
    let ball = 4.0 / 3.0 * PI * r * r * r;
    let volume = rod + ball;
    let across = (rod * 0.25 + ball * 0.2) * r * r / volume;
    let along = (rod * h * h / 3.0 + ball * (h * h + 0.75 * h * r + 0.2 * r * r)) / volume;
    GeomVolume { volume, spread: [across, across, along] }
}
