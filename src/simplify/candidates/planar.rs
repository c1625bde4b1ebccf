//! A mechanism in space whose motion stays in a plane.

use super::planar_output::flat_output;
use super::plane::{Plane, combined, flat, world};
use crate::body::dot;
use crate::error::percent;
use crate::math::array::Each;
use crate::scene::document::{elements, elements_mut, is_rigid, text};
use crate::simplify::{Candidate, Edit, Facts, Proposal};
use crate::tolerances::SAME;
use serde_json::{Map, Value, json};

/// A scene in space whose bodies move parallel to a plane becomes one in the plane: hinges across it stay hinges, and
/// what they lock out of the plane goes. By the displacements and rotations out of the plane.
pub struct Planar;

impl Candidate for Planar {
    fn name(&self) -> &'static str {
        "planar"
    }

    fn propose(&self, facts: &Facts) -> Vec<Proposal> {
        (facts.dimension() == 3).then(|| proposal(facts)).flatten().into_iter().collect()
    }
}

fn proposal(facts: &Facts) -> Option<Proposal> {
    let plane = Plane::new(facts);
    let travel = facts.travel();
    let mut effect = 0.0f64;
    for body in elements(facts.scene(), "bodies") {
        let path = facts.path(text(body, "name"))?;
        let start = path.first()?;
        let normal = start.axes.each(|axis| dot(&axis, plane.normal()));
        let mut out = 0.0f64;
        let mut tilt = 0.0f64;
        for place in &path {
            let height = |r: &[f64; 3]| dot(r, plane.normal());
            let cosine: f64 = (0..3).map(|i| normal[i] * height(&place.axes[i])).sum();
            out = out.max((height(&place.r) - height(&start.r)).abs());
            tilt = tilt.max(cosine.clamp(-1.0, 1.0).acos());
        }
        let part = |own: f64, all: f64| if own > 0.0 { own / all } else { 0.0 };
        effect = effect.max(part(out, travel.shift)).max(part(tilt, travel.turn));
    }
    let scene = flattened(facts, &plane)?;
    let before = facts.scene().clone();
    let edit: Edit = Box::new(move |richest| {
        if *richest != before {
            return Err("the scene is no longer what it was".to_string());
        }
        *richest = scene.clone();
        Ok(())
    });
    let why = format!("bodies leave the plane by {} of their motion", percent(effect));
    Some(Proposal { subject: "the scene".to_string(), what: "the scene is planar".to_string(), why, effect, edit })
}

/// The scene in the plane; `None` where an element has no counterpart there.
fn flattened(facts: &Facts, plane: &Plane) -> Option<Value> {
    let mut scene = facts.scene().clone();
    scene["dimension"] = json!(2);
    // Coordinates of joints are turned the other way about some of them.
    let is_usual = plane.normal() == &[0.0, 0.0, 1.0];
    if scene.get("initial").is_some() && !is_usual {
        return None;
    }
    if scene["gravity"].is_array() {
        scene["gravity"] = plane.flat(&scene["gravity"])?;
    }
    if let Some(markers) = scene.get_mut("ground").and_then(|ground| ground.get_mut("markers")) {
        *markers = flat_markers(facts, plane, "ground", markers.as_object()?)?;
    }
    let map = |list: &str, change: &dyn Fn(&Value) -> Option<Vec<Value>>| -> Option<Value> {
        let all = elements(facts.scene(), list).iter().map(change).collect::<Option<Vec<_>>>()?;
        Some(json!(all.concat()))
    };
    let one = |element: Option<Value>| element.map(|element| vec![element]);
    scene["bodies"] = map("bodies", &|body| one(flat_body(facts, plane, body)))?;
    scene["joints"] = map("joints", &|joint| flat_joint(facts, plane, joint))?;
    scene["forces"] = map("forces", &|force| one(flat_force(facts, plane, force)))?;
    scene["outputs"] = map("outputs", &|output| Some(flat_output(facts, plane, output).unwrap_or_default()))?;
    for list in ["states", "inputs"] {
        for element in elements_mut(&mut scene, list) {
            plane.translate(element)?;
            if let Some(component) = element.get_mut("component") {
                *component = json!(plane.component(component.as_str()?)?);
            }
        }
    }
    Some(scene)
}

fn flat_markers(facts: &Facts, plane: &Plane, body: &str, markers: &Map<String, Value>) -> Option<Value> {
    let frame = facts.place(body)?;
    let axes = plane.seen_from(body, &frame);
    let zero = plane.angle(&world(&frame, &axes[0]));
    let one = |(name, marker): (&String, &Value)| -> Option<(String, Value)> {
        let position = flat(&axes, if marker.is_array() { marker } else { &marker["position"] })?;
        let place = facts.place(&format!("{body}.{name}"))?;
        let angle = plane.angle(&plane.marker(&place)?) - zero;
        let is_turned = angle.abs() > SAME;
        Some((name.clone(), if is_turned { json!({ "position": position, "angle": angle }) } else { position }))
    };
    Some(Value::Object(markers.iter().map(one).collect::<Option<_>>()?))
}

fn flat_body(facts: &Facts, plane: &Plane, body: &Value) -> Option<Value> {
    if !is_rigid(body) || body.get("shapes").is_some() {
        return None;
    }
    let mut own = body.clone();
    let name = text(body, "name");
    let frame = facts.place(name)?;
    let axes = plane.seen_from(name, &frame);
    if let Some(all) = body["inertia"].as_array() {
        own["inertia"] = moment(&axes[2], all)?;
    }
    if let Some(markers) = body["markers"].as_object() {
        own["markers"] = flat_markers(facts, plane, name, markers)?;
    }
    if let Some(free) = body["free"].as_array() {
        own["free"] =
            json!(free.iter().map(|name| freedom(plane, name.as_str()?)).collect::<Option<Vec<_>>>()?.concat());
    }
    if let Some(origin) = body.get("origin") {
        own["origin"] = flat(&axes, origin)?;
    }
    if let Some(initial) = own.get_mut("initial").and_then(Value::as_object_mut) {
        for key in ["position", "velocity"] {
            if let Some(given) = initial.get_mut(key) {
                *given = plane.flat(given)?;
            }
        }
        ["rotation", "z_axis", "x_axis"].iter().for_each(|key| drop(initial.shift_remove(*key)));
        let angle = plane.angle(&world(&frame, &axes[0]));
        if text(body, "type") == "rigid" && angle != 0.0 {
            initial.insert("angle".to_string(), json!(angle));
        }
        if let Some(spin) = initial.get_mut("angular_velocity").filter(|spin| spin.is_array()) {
            *spin = combined(&axes[2], spin)?;
        }
    }
    Some(own)
}

/// Moment of inertia n . J n about an axis, of xx, yy, zz, xy, xz, yz.
fn moment(n: &[f64; 3], inertia: &[Value]) -> Option<Value> {
    let pairs = [(0, 1), (0, 2), (1, 2)];
    let squares = n.iter().map(|x| x * x).chain(pairs.each(|(i, j)| 2.0 * n[i] * n[j]));
    let terms = squares.zip(inertia).filter(|(part, _)| *part != 0.0);
    let (parts, values): (Vec<f64>, Vec<Value>) = terms.map(|(part, value)| (part, value.clone())).unzip();
    combined(&parts, &json!(values))
}

/// The freedom in the plane that one in space is; none where it is out of the plane.
fn freedom(plane: &Plane, name: &str) -> Option<Vec<&'static str>> {
    let index = |names: [&str; 3]| names.iter().position(|own| *own == name);
    let of = |i: usize| plane.axes.iter().position(|axis| axis[i].abs() == 1.0);
    Some(match (index(["x", "y", "z"]), index(["rx", "ry", "rz"])) {
        (Some(i), _) => ["x", "y"].get(of(i)?).copied().into_iter().collect(),
        (_, Some(i)) => (of(i)? == 2).then_some("angle").into_iter().collect(),
        _ => return None,
    })
}

/// The joint in the plane; none where it locks nothing there.
fn flat_joint(facts: &Facts, plane: &Plane, joint: &Value) -> Option<Vec<Value>> {
    let first = joint["between"][0].as_str().and_then(|marker| facts.path(marker));
    let z = first.and_then(|path| path.first().copied())?.axes[2];
    let sign = plane.along(&z);
    let is_across = plane.contains(&z);
    let kind = match (text(joint, "type"), sign.is_some(), is_across) {
        ("planar", true, _) => return Some(Vec::new()),
        ("revolute" | "cylindrical" | "point_on_line", true, _) | ("spherical", ..) => "revolute",
        ("prismatic" | "cylindrical", _, true) => "prismatic",
        ("point_on_line", _, true) => "point_on_line",
        ("weld", ..) => "weld",
        ("distance", ..) => "distance",
        ("driver", ..) if text(joint, "coordinate") == "angle" && sign == Some(1.0) => "driver",
        _ => return None,
    };
    let first = joint["between"][0].as_str()?;
    let slides = ["prismatic", "point_on_line"].contains(&kind);
    if slides && dot(&plane.x_of(facts, first)?, &z) < 1.0 - SAME {
        return None;
    }
    let mut own = joint.clone();
    plane.translate(&mut own)?;
    own["type"] = json!(kind);
    joint.get("axis").is_none().then_some(vec![own])
}

fn flat_force(facts: &Facts, plane: &Plane, force: &Value) -> Option<Value> {
    let mut own = force.clone();
    let first = || facts.place(force["between"][0].as_str()?).map(|place| place.axes);
    match text(force, "type") {
        "spring_damper" => {}
        "torsion_spring" if plane.along(&first()?[2]) == Some(1.0) => {}
        "applied_force" => own["force"] = plane.flat(&force["force"])?,
        "applied_torque" => own["torque"] = plane.across(&force["torque"])?,
        "bushing" => {
            // The planar x axis is that of the marker, or its z axis where that lies in the plane.
            let across = first()?.iter().position(|axis| plane.along(axis).is_some())?;
            let kept = match across {
                2 => [0, 1, 5],
                other => [2, 1 - other, 3 + other],
            };
            for key in ["stiffness", "damping"] {
                if let Some(all) = force[key].as_array() {
                    own[key] = kept.iter().filter_map(|i| all.get(*i).cloned()).collect();
                }
            }
        }
        _ => return None,
    }
    plane.translate(&mut own)?;
    Some(own)
}
