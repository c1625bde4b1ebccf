//! Outputs of a symmetric mechanism from one half of it.

use super::mirror::Mirror;
use super::planar_output::made_of;
use crate::simplify::edit::{carrier, mentions, text};
use serde_json::{Value, json};

/// What became of the joints and forces.
#[derive(Default)]
pub struct Elements {
    /// Names of those that go, with those of their images.
    pub gone: Vec<(String, String)>,
    /// Names of those on the plane, which have half their strength and reaction.
    pub halved: Vec<String>,
}

/// The output of the half, after others that it is made of: that of what goes by the image of that, totals doubled.
/// `None` for what has no counterpart.
pub fn half_output(mirror: &Mirror, elements: &Elements, output: &Value) -> Option<Vec<Value>> {
    let (measure, of) = (text(output, "measure"), text(output, "of"));
    let mut own = output.clone();
    if measure == "expression" {
        mirror.translate(&mut own["value"])?;
        return Some(vec![own]);
    }
    let is_of = |name: &str| of == name && ["force", "power", "work", "reaction"].contains(&measure);
    if measure == "energy" || elements.halved.iter().any(|name| is_of(name)) {
        return made_of(&own, &[(2.0, None)], 0.0);
    }
    let is_gone = |name: &str| elements.gone.iter().any(|(gone, _)| gone == name);
    if !is_gone(of) && !mirror.pairs.iter().any(|[_, goes]| mentions(output, goes)) {
        return Some(vec![own]);
    }
    let component = text(output, "component");
    let (mut sign, mut offset) = (1.0, 0.0);
    let base = output["relative_to"].as_str().unwrap_or("ground");
    let there = if base == "ground" { base.to_string() } else { mirror.marker_mate(base)? };
    if let Some(axis) = ["x", "y", "z"].iter().position(|axis| component.ends_with(axis)) {
        let is_turning = component.starts_with('m') || measure.starts_with("angular");
        let image = axis_sign(mirror, [base, &there], axis)?;
        sign = if is_turning { 0.0 - image } else { image };
        if measure == "position" && base == "ground" && axis == mirror.axis {
            offset = 2.0 * mirror.offset;
        }
    } else if measure.starts_with("ang") {
        sign = 0.0 - axis_sign(mirror, [base, &there], 2)?;
    } else if !["", "axial"].contains(&component) {
        return None;
    }
    match elements.gone.iter().find(|(gone, _)| gone == of) {
        Some(_) if !["force", "power", "work", "reaction", "distance", "distance_rate"].contains(&measure) => {
            return None;
        }
        Some((_, image)) => own["of"] = json!(image),
        None if of.is_empty() => {
            for end in own["between"].as_array_mut()? {
                *end = json!(mirror.marker_mate(end.as_str()?)?);
            }
        }
        None => {
            let image = mirror.marker_mate(of)?;
            if measure == "angle" {
                let turn = |name: &str| Some(mirror.place(name)?.turn);
                offset = turn(of)? - turn(base)? - sign * (turn(&image)? - turn(&there)?);
            }
            own["of"] = json!(image);
        }
    }
    if own.get("relative_to").is_some() {
        own["relative_to"] = json!(there);
    }
    let is_left = |key: &str| own[key].as_str().is_some_and(|name| mirror.goes(carrier(name)));
    let is_whole =
        !["of", "relative_to"].iter().any(|key| is_left(key)) && (mirror.facts.dimension() == 2 || measure != "angle");
    is_whole.then(|| made_of(&own, &[(sign, None)], offset)).flatten()
}

/// Sign of the image of an axis of `base` in those of its own image; the ground is seen in its own axes.
fn axis_sign(mirror: &Mirror, [base, there]: [&str; 2], axis: usize) -> Option<f64> {
    match base {
        "ground" => Some(if axis == mirror.axis { -1.0 } else { 1.0 }),
        _ => mirror.signs([base, there])?[axis],
    }
}
