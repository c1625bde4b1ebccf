//! Outputs of a symmetric mechanism from one half of it.

use super::half_spring::{HalfSpring, gap, stays};
use super::mirror::Mirror;
use super::planar_output::made_of;
use crate::simplify::edit::{mentions, pair, text};
use serde_json::{Value, json};

/// What became of the joints and forces.
#[derive(Default)]
pub struct Elements {
    /// Names of those that go, with those of their images.
    pub gone: Vec<(String, String)>,
    /// Names of those on the plane, which have half their strength and reaction.
    pub halved: Vec<String>,
    /// Springs between the halves.
    pub across: Vec<HalfSpring>,
    /// Markers of the ground from which these act, with their places.
    pub markers: Vec<(String, Value)>,
}

/// The output of the half, after others that it is made of: that of what goes by the image of that, totals doubled.
/// `None` for what has no counterpart.
pub fn half_output(mirror: &Mirror, elements: &Elements, output: &Value) -> Option<Vec<Value>> {
    let (measure, of) = (text(output, "measure"), text(output, "of"));
    if measure == "expression" {
        let mut own = output.clone();
        mirror.translate(&mut own["value"])?;
        return Some(vec![own]);
    }
    if let Some(spring) = elements.across.iter().find(|spring| spring.name == of) {
        return spring.output(mirror, output);
    }
    if let Some(marker) = pair(output).and_then(|pair| stays(mirror, pair)) {
        return gap(mirror, output, &marker);
    }
    let is_of = |name: &str| of == name && ["force", "power", "work", "reaction"].contains(&measure);
    let is_gone = elements.gone.iter().any(|(gone, _)| gone == of);
    let is_about = mirror.pairs.iter().any(|[_, goes]| mentions(output, goes));
    match measure == "energy" || elements.halved.iter().any(|name| is_of(name)) {
        true => made_of(output, &[(2.0, None)], 0.0).filter(|_| !is_about),
        false if is_gone || is_about => image_output(mirror, elements, output),
        false => Some(vec![output.clone()]),
    }
}

/// An output of what goes, or against it, by the images.
fn image_output(mirror: &Mirror, elements: &Elements, output: &Value) -> Option<Vec<Value>> {
    let (measure, of, component) = (text(output, "measure"), text(output, "of"), text(output, "component"));
    let base = output["relative_to"].as_str().unwrap_or("ground");
    let there = if base == "ground" { base.to_string() } else { mirror.marker_mate(base)? };
    let axis = ["x", "y", "z"].iter().position(|axis| component.ends_with(axis));
    let is_turning = component.starts_with('m') || measure.starts_with("ang");
    let sign = match axis.or(is_turning.then_some(2)) {
        Some(axis) if is_turning => 0.0 - axis_sign(mirror, [base, &there], axis)?,
        Some(axis) => axis_sign(mirror, [base, &there], axis)?,
        None if ["", "axial"].contains(&component) => 1.0,
        None => return None,
    };
    let own = renamed(mirror, elements, output)?;
    // Of a joint whose image names the bodies the other way the angle is minus that, and so is what acts on the second.
    let is_signed = is_turning || axis.is_some() && ["reaction", "force"].contains(&measure);
    let sign = if is_signed && is_reversed(mirror, [of, text(&own, "of")]) { 0.0 - sign } else { sign };
    let offset = match (measure, axis) {
        ("angle", _) if mirror.facts.dimension() == 3 => return None,
        ("angle", _) => {
            let turn = |name: &str| Some(mirror.place(name)?.turn);
            let of_hinge = |name: &str| match element(mirror, name).and_then(pair) {
                Some([first, second]) => Some(turn(second)? - turn(first)?),
                None => turn(name),
            };
            of_hinge(of)? - turn(base)? - sign * (of_hinge(text(&own, "of"))? - turn(&there)?)
        }
        ("position", Some(axis)) if base == "ground" && axis == mirror.axis => 2.0 * mirror.offset,
        _ => 0.0,
    };
    made_of(&own, &[(sign, None)], offset)
}

/// The output of the images of the joint, force, body or markers that it is about; `None` where these go.
fn renamed(mirror: &Mirror, elements: &Elements, output: &Value) -> Option<Value> {
    let (mut own, of) = (output.clone(), text(output, "of"));
    if let Some((_, image)) = elements.gone.iter().find(|(gone, _)| gone == of) {
        own["of"] = has_image(mirror, [of, image], output).then(|| json!(image))?;
    } else if of.is_empty() {
        for end in own["between"].as_array_mut()? {
            *end = json!(mirror.marker_mate(end.as_str()?)?);
        }
    } else {
        own["of"] = json!(mirror.marker_mate(of)?);
    }
    if let Some(base) = output["relative_to"].as_str().filter(|base| *base != "ground") {
        own["relative_to"] = json!(mirror.marker_mate(base)?);
    }
    let goes = |value: &Value| value.as_str().is_some_and(|name| mirror.goes(name));
    let is_left = own["between"].as_array().into_iter().flatten().chain([&own["of"], &own["relative_to"]]).any(goes);
    (!is_left).then_some(own)
}

/// True if what is measured at an element is measured at its image, but for the signs of axes: of a tension or a power,
/// of what acts on the second body, and of a hinge in the plane; not of the torque of a drive or a torsion spring.
fn has_image(mirror: &Mirror, names: [&str; 2], output: &Value) -> bool {
    let Some(own) = element(mirror, names[0]) else { return false };
    let is_signed = || match text(own, "type") {
        "driver" => text(own, "coordinate") != "distance",
        kind => kind == "torsion_spring",
    };
    match text(output, "measure") {
        "power" | "work" | "distance" | "distance_rate" => true,
        "force" | "reaction" if ["", "axial"].contains(&text(output, "component")) => !is_signed(),
        // Moments are about the marker of the body that they act on.
        "force" | "reaction" => !is_reversed(mirror, names) || !text(output, "component").starts_with('m'),
        "angle" | "angular_velocity" | "angular_acceleration" => {
            mirror.facts.dimension() == 2 && text(own, "type") == "revolute"
        }
        _ => false,
    }
}

fn element<'a>(mirror: &Mirror<'a>, name: &str) -> Option<&'a Value> {
    ["joints", "forces"].iter().find_map(|list| mirror.facts.element(list, name))
}

/// True if these are joints or forces of which the first marker of one is not at the image of that of the other.
fn is_reversed(mirror: &Mirror, names: [&str; 2]) -> bool {
    let [own, image] = names.map(|name| element(mirror, name).and_then(pair));
    own.zip(image).is_some_and(|(own, image)| !mirror.are_images(own[0], image[0]))
}

/// Sign of the image of an axis of `base` in those of its own image; the ground is seen in its own axes.
fn axis_sign(mirror: &Mirror, [base, there]: [&str; 2], axis: usize) -> Option<f64> {
    match base {
        "ground" => Some(if axis == mirror.axis { -1.0 } else { 1.0 }),
        _ => mirror.signs([base, there])?[axis],
    }
}
