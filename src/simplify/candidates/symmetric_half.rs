//! A mechanism whose two halves move as the mirror images of each other.

use super::half_output::{Elements, half_output};
use super::half_spring::HalfSpring;
use super::mirror::Mirror;
use crate::error::percent;
use crate::simplify::edit::{carrier, drop_references, elements, elements_mut, pair, text};
use crate::simplify::{Candidate, Facts, Proposal};
use crate::tolerances::SAME;
use serde_json::{Value, json};

/// Of a scene that is symmetric at the start about a plane across x, y or z, in bodies, joints, forces and gravity, one
/// half stays. Bodies on the plane stay in it, with half their mass and inertia; forces there have half their strength, and
/// springs from a point to its image act towards the plane. Outputs of the other half become those of the images, totals
/// are doubled. By how far bodies leave the images of each
/// other along the motion, where loads and drives make them. Not for scenes with beams, gears, equations, inputs, or
/// another element that connects the halves.
pub struct SymmetricHalf;

impl Candidate for SymmetricHalf {
    fn name(&self) -> &'static str {
        "symmetric_half"
    }

    fn propose(&self, facts: &Facts) -> Vec<Proposal> {
        (0..facts.dimension()).filter_map(|axis| proposal(facts, Mirror::new(facts, axis)?)).collect()
    }
}

fn proposal(facts: &Facts, mirror: Mirror) -> Option<Proposal> {
    let effect = mirror.asymmetry()?.part(&facts.travel());
    let name = ["x", "y", "z"][mirror.axis];
    // Of the other side where that keeps more of the watched outputs.
    let (lower, upper) = (half(&mirror)?, half(&mirror.turned())?);
    let kept = |scene: &Value| {
        let is_there = |name: &&String| elements(scene, "outputs").iter().any(|output| text(output, "name") == **name);
        facts.watched.iter().filter(is_there).count()
    };
    let (scene, before) = (if kept(&upper) > kept(&lower) { upper } else { lower }, facts.scene().clone());
    Some(Proposal {
        subject: "the scene".to_string(),
        what: format!("of the two halves across {name} one is left"),
        why: format!("bodies leave the mirror images of each other by {} of their motion", percent(effect)),
        effect,
        edit: Box::new(move |richest| {
            if *richest != before {
                return Err("the scene is no longer what it was".to_string());
            }
            *richest = scene.clone();
            Ok(())
        }),
    })
}

/// The half as a scene; `None` where an element has no image, or connects the halves.
fn half(mirror: &Mirror) -> Option<Value> {
    let mut scene = mirror.facts.scene().clone();
    if !elements(&scene, "inputs").is_empty() {
        return None;
    }
    let mut found = Elements::default();
    let held = held(mirror);
    for list in ["joints", "forces"] {
        let kept = kept(mirror, list, &held, &mut found)?;
        scene[list] = json!(kept);
    }
    if mirror.pairs.is_empty() && found.gone.is_empty() {
        return None;
    }
    let bodies = elements(mirror.facts.scene(), "bodies").iter();
    let stays = bodies.filter(|body| !mirror.goes(text(body, "name")));
    for (name, place) in &found.markers {
        scene["ground"]["markers"][name] = place.clone();
    }
    scene["bodies"] = stays.map(|body| own_half(mirror, &held, body)).collect::<Option<_>>()?;
    let outputs = elements(mirror.facts.scene(), "outputs").iter();
    let outputs = outputs.flat_map(|output| half_output(mirror, &found, output).unwrap_or_default());
    let outputs: Vec<Value> = outputs.collect();
    let gone = mirror.pairs.iter().map(|[_, goes]| *goes).chain(found.gone.iter().map(|(gone, _)| gone.as_str()));
    scene["outputs"] = json!([]);
    gone.for_each(|name| drop_references(&mut scene, name));
    scene["outputs"] = json!(outputs);
    for state in elements_mut(&mut scene, "states") {
        mirror.translate(state)?;
    }
    Some(scene)
}

/// Joints, or forces, of the half that stays; those on the plane halved.
fn kept(mirror: &Mirror, list: &str, held: &[&str], found: &mut Elements) -> Option<Vec<Value>> {
    let all = elements(mirror.facts.scene(), list);
    let mut kept = Vec::new();
    for element in all {
        let (name, markers) = (text(element, "name").to_string(), markers(element)?);
        let goes = |marker: &&str| mirror.goes(marker);
        let is_paired = |marker: &&str| !mirror.middle.contains(&carrier(marker));
        if markers.iter().any(goes) && markers.iter().any(|marker| is_paired(marker) && !goes(marker)) {
            let spring = HalfSpring::new(mirror, element)?;
            let (bushing, marker) = spring.bushing(mirror, element)?;
            kept.push(bushing);
            found.markers.push(marker);
            found.across.push(spring);
            continue;
        }
        let mut own = element.clone();
        if is_image(mirror, element, element) {
            own = if list == "forces" { weaker(element)? } else { flatter(mirror, held, element) };
            found.halved.push(name);
        } else {
            let images = |of: &Value| all.iter().filter(|other| is_image(mirror, of, other)).count();
            let other = all.iter().find(|other| is_image(mirror, element, other))?;
            if images(element) != images(other) {
                return None;
            }
            let is_gone = match markers.iter().any(is_paired) {
                true => markers.iter().any(goes),
                false => is_beyond(mirror, &markers)?,
            };
            if is_gone {
                found.gone.push((name, text(other, "name").to_string()));
                continue;
            }
        }
        mirror.translate(&mut own)?;
        kept.push(own);
    }
    Some(kept)
}

/// True if the first marker off the plane is on the side that goes.
fn is_beyond(mirror: &Mirror, markers: &[&str]) -> Option<bool> {
    let height = |marker: &&str| Some(mirror.place(marker)?.r[mirror.axis] - mirror.offset);
    let heights: Vec<f64> = markers.iter().map(height).collect::<Option<_>>()?;
    let least = SAME * mirror.facts.prepared.system().length();
    heights.into_iter().find(|height| height.abs() > least).map(|height| (height > 0.0) == mirror.upper_goes)
}

/// Markers of a joint or force, by which it acts.
fn markers(element: &Value) -> Option<Vec<&str>> {
    let at = || Some(["at", "reaction_on"].iter().filter_map(|key| element[*key].as_str()).collect());
    pair(element).map(|pair| pair.to_vec()).or_else(at).filter(|markers: &Vec<&str>| !markers.is_empty())
}

/// Keys whose values may depend on time and motion: what these do is seen in the motion.
const LOADS: [&str; 5] = ["road", "force", "torque", "law", "value"];

/// True if `other` does to the images of the bodies what `element` does to them, but for loads.
fn is_image(mirror: &Mirror, element: &Value, other: &Value) -> bool {
    if text(element, "type") != text(other, "type") {
        return false;
    }
    let (Some(own), Some(mut there)) = (markers(element), markers(other)) else { return false };
    let is_numbered = |key: &str| {
        !["name", "type", "between", "at", "reaction_on", "free_angle"].contains(&key) && !LOADS.contains(&key)
    };
    let keys = [element, other].map(|of| of.as_object().into_iter().flat_map(|keys| keys.keys()));
    let is_equal = |key: &String| !is_numbered(key) || alike(mirror.facts, &element[key], &other[key]);
    let axes: &[usize] = match (text(element, "type"), mirror.facts.dimension()) {
        ("distance" | "spherical" | "weld" | "spring_damper" | "tyre" | "applied_force" | "applied_torque", _) => &[],
        ("revolute", 2) => &[],
        ("prismatic" | "point_on_line", 2) => &[0],
        ("revolute" | "cylindrical" | "prismatic" | "planar" | "point_on_line", _) => &[2],
        ("driver", _) if text(element, "coordinate") == "distance" => &[],
        ("driver" | "universal" | "bushing" | "torsion_spring", _) => &[0, 1, 2],
        _ => return false,
    };
    let is_turned = |markers: (&&str, &&str)| {
        let signs = mirror.signs([markers.0, markers.1]);
        signs.is_none_or(|signs| axes.iter().any(|axis| signs[*axis].is_none()))
    };
    // What names its bodies the other way is the same; a torque or an angle of it has another sign.
    let symmetric = ["distance", "spring_damper", "revolute", "spherical", "weld"];
    if symmetric.contains(&text(element, "type")) && !mirror.are_images(own[0], there[0]) {
        there.reverse();
    }
    own.len() == there.len()
        && own.iter().zip(&there).all(|(own, there)| mirror.are_images(own, there))
        && (axes.is_empty() || !own.iter().zip(&there).any(is_turned))
        && keys.into_iter().flatten().all(is_equal)
        && (text(element, "type") != "torsion_spring" || is_wound(mirror, element, other).unwrap_or(false))
}

/// True if the angles of two torsion springs are those of mirror images: an angle about z is minus that about the image
/// of z, against x axes that both are images, or both minus that.
fn is_wound(mirror: &Mirror, element: &Value, other: &Value) -> Option<bool> {
    let (own, there) = (pair(element)?, pair(other)?);
    let [first, second] = [mirror.signs([own[0], there[0]])?, mirror.signs([own[1], there[1]])?];
    let angle = |spring: &Value| {
        if spring.get("free_angle").is_some() { mirror.facts.number(&spring["free_angle"]) } else { Some(0.0) }
    };
    Some(
        first[0] == second[0]
            && (angle(other)? + first[2]? * angle(element)?).abs() <= SAME
            && element.get("law").is_none(),
    )
}

/// True if two values of a scene are the same, or numbers that are.
fn alike(facts: &Facts, one: &Value, other: &Value) -> bool {
    match (one, other) {
        (Value::Array(one), Value::Array(other)) => {
            one.len() == other.len() && one.iter().zip(other).all(|(one, other)| alike(facts, one, other))
        }
        _ if one == other => true,
        _ => match (facts.number(one), facts.number(other)) {
            (Some(one), Some(other)) => (one - other).abs() <= SAME * one.abs(),
            _ => false,
        },
    }
}

/// Half of a number, or of each of a list.
fn halved(value: &Value) -> Value {
    match value {
        Value::Array(all) => all.iter().map(halved).collect(),
        Value::String(text) => json!(format!("0.5*({text})")),
        Value::Number(number) => json!(0.5 * number.as_f64().unwrap_or(f64::NAN)),
        other => other.clone(),
    }
}

/// A force on the plane with half its strength.
fn weaker(force: &Value) -> Option<Value> {
    let keys: &[&str] = match text(force, "type") {
        "spring_damper" => &["stiffness", "damping", "preload", "law"],
        "tyre" | "bushing" | "torsion_spring" => &["stiffness", "damping"],
        "applied_force" => &["force"],
        "applied_torque" => &["torque"],
        _ => return None,
    };
    let mut own = force.clone();
    for key in keys {
        if let Some(value) = own.get_mut(*key) {
            *value = halved(value);
        }
    }
    Some(own)
}

/// A joint on the plane; a hinge across it as a point on the axis, where a body stays in the plane by itself.
fn flatter(mirror: &Mirror, held: &[&str], joint: &Value) -> Value {
    let mut own = joint.clone();
    let is_free = |marker: &&str| !held.contains(&carrier(marker));
    let is_across = pair(joint).is_some_and(|[first, _]| is_along(mirror, first, 2));
    if mirror.facts.dimension() == 3
        && text(joint, "type") == "revolute"
        && is_across
        && pair(joint).is_some_and(|pair| pair.iter().any(is_free))
    {
        own["type"] = json!("point_on_line");
    }
    own
}

/// True if an axis of a marker is along the normal of the plane.
fn is_along(mirror: &Mirror, marker: &str, axis: usize) -> bool {
    mirror.place(marker).is_some_and(|place| (place.axes[axis][mirror.axis].abs() - 1.0).abs() < SAME)
}

/// True if an axis of a marker lies in the plane.
fn is_within(mirror: &Mirror, marker: &str, axis: usize) -> bool {
    mirror.place(marker).is_some_and(|place| place.axes[axis][mirror.axis].abs() < SAME)
}

/// The ground and the bodies on the plane that joints to those already hold there.
fn held<'a>(mirror: &Mirror<'a>) -> Vec<&'a str> {
    let mut held = vec!["ground"];
    let joints = elements(mirror.facts.scene(), "joints");
    let holds = |joint: &Value, first: &str| {
        let own = joint.get("axis").is_none();
        match (text(joint, "type"), mirror.facts.dimension()) {
            ("weld", _) => true,
            ("prismatic", 2) => own && is_within(mirror, first, 0),
            ("prismatic", _) => own && is_within(mirror, first, 2),
            ("revolute" | "planar", 3) => own && is_along(mirror, first, 2),
            _ => false,
        }
    };
    loop {
        let before = held.len();
        for joint in joints {
            let Some([first, second]) = pair(joint) else { continue };
            let ends = [carrier(first), carrier(second)];
            let open = ends.iter().find(|end| !held.contains(end));
            let next = open.filter(|_| ends.iter().any(|end| held.contains(end)) && holds(joint, first));
            held.extend(next.and_then(|next| mirror.middle.iter().find(|own| *own == next).copied()));
        }
        if held.len() == before {
            return held;
        }
    }
}

/// The body of the half: one on the plane with half its mass and inertia, in the plane by the joints that hold it, or
/// by its freedoms.
fn own_half(mirror: &Mirror, held: &[&str], body: &Value) -> Option<Value> {
    let (mut own, name) = (body.clone(), text(body, "name"));
    if !mirror.middle.contains(&name) {
        return Some(own);
    }
    for key in ["mass", "inertia"] {
        if let Some(value) = own.get_mut(key) {
            *value = halved(value);
        }
    }
    if held.contains(&name) {
        return Some(own);
    }
    let along = ["x", "y", "z"].into_iter().take(mirror.facts.dimension());
    let mut free: Vec<&str> = along.enumerate().filter(|(i, _)| *i != mirror.axis).map(|(_, name)| name).collect();
    if mirror.facts.dimension() == 3 && text(body, "type") == "rigid" {
        free.push(["rx", "ry", "rz"][mirror.axis]);
    }
    if let Some(own) = body["free"].as_array() {
        free.retain(|name| own.iter().any(|own| own == name));
    }
    own["type"] = json!("rigid");
    own["free"] = json!(free);
    (!free.is_empty()).then_some(own)
}
