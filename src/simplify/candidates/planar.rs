//! A mechanism in space whose motion stays in a plane.

use crate::error::percent;
use crate::simplify::edit::{elements, text, words};
use crate::simplify::{Candidate, Edit, Facts, Placed, Proposal};
use crate::tolerances::SAME;
use serde_json::{Map, Value, json};

/// A scene in space whose bodies move parallel to the x-y plane becomes one in the plane: hinges about z stay hinges, and
/// what they lock across the plane goes. By the displacements and rotations out of the plane.
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
    let travel = facts.travel();
    let mut effect = 0.0f64;
    for body in elements(facts.scene(), "bodies") {
        let path = facts.path(text(body, "name"))?;
        let (start, tilt) = (path.first()?, facts.relative(["ground", text(body, "name")])?.tilt);
        // The axes of the body have to begin in the plane.
        if !is_along(&start.axes[2]) {
            return None;
        }
        let out = path.iter().map(|place| (place.r[2] - start.r[2]).abs()).fold(0.0, f64::max);
        let part = |own: f64, all: f64| if own > 0.0 { own / all } else { 0.0 };
        effect = effect.max(part(out, travel.shift)).max(part(tilt, travel.turn));
    }
    let scene = flat(facts)?;
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

/// True if an axis is along z.
fn is_along(axis: &[f64; 3]) -> bool {
    (axis[2] - 1.0).abs() < SAME
}

/// True if it is square to z.
fn is_across(axis: &[f64; 3]) -> bool {
    axis[2].abs() < SAME
}

/// The scene in the plane; `None` where an element has no counterpart there.
fn flat(facts: &Facts) -> Option<Value> {
    let mut scene = facts.scene().clone();
    scene["dimension"] = json!(2);
    if let Some(gravity) = scene.get_mut("gravity") {
        cut(gravity);
    }
    if let Some(markers) = scene.get_mut("ground").and_then(|ground| ground.get_mut("markers")) {
        *markers = flat_markers(facts, "ground", markers.as_object()?)?;
    }
    let map = |list: &str, change: &dyn Fn(&Value) -> Option<Option<Value>>| -> Option<Value> {
        let all = elements(facts.scene(), list).iter().map(change).collect::<Option<Vec<_>>>()?;
        Some(json!(all.into_iter().flatten().collect::<Vec<_>>()))
    };
    scene["bodies"] = map("bodies", &|body| flat_body(facts, body).map(Some))?;
    scene["joints"] = map("joints", &|joint| flat_joint(facts, joint))?;
    scene["forces"] = map("forces", &|force| flat_force(force).map(Some))?;
    scene["outputs"] = map("outputs", &|output| Some(flat_output(output)))?;
    Some(scene)
}

/// Keeps the x and y of a vector.
fn cut(vector: &mut Value) {
    vector.as_array_mut().into_iter().for_each(|all| all.truncate(2));
}

fn flat_markers(facts: &Facts, body: &str, markers: &Map<String, Value>) -> Option<Value> {
    let frame = *facts.path(body)?.first()?;
    let one = |(name, marker): (&String, &Value)| -> Option<(String, Value)> {
        let mut position = if marker.is_array() { marker.clone() } else { marker["position"].clone() };
        cut(&mut position);
        let place = *facts.path(&format!("{body}.{name}"))?.first()?;
        let angle = turn(&place)? - turn(&frame)?;
        let flat = if marker.is_array() { position } else { json!({ "position": position, "angle": angle }) };
        Some((name.clone(), flat))
    };
    Some(Value::Object(markers.iter().map(one).collect::<Option<_>>()?))
}

/// Angle in the plane of the axis that a joint there goes by: x where z is across the plane, else z.
fn turn(place: &Placed) -> Option<f64> {
    let [x, _, z] = &place.axes;
    match (is_along(z), is_across(z)) {
        (true, _) => Some(x[1].atan2(x[0])),
        (_, true) => Some(z[1].atan2(z[0])),
        _ => None,
    }
}

fn flat_body(facts: &Facts, body: &Value) -> Option<Value> {
    if !["rigid", "point_mass"].contains(&text(body, "type")) {
        return None;
    }
    let (mut flat, name) = (body.clone(), text(body, "name"));
    if let Some(all) = body["inertia"].as_array() {
        flat["inertia"] = all.get(2)?.clone();
    }
    if let Some(markers) = body["markers"].as_object() {
        flat["markers"] = flat_markers(facts, name, markers)?;
    }
    if let Some(free) = body["free"].as_array() {
        let names = free.iter().filter_map(Value::as_str).filter(|name| ["x", "y", "rz"].contains(name));
        flat["free"] = names.map(|name| if name == "rz" { "angle" } else { name }).collect();
    }
    flat.get_mut("origin").into_iter().for_each(cut);
    if let Some(initial) = flat.get_mut("initial").and_then(Value::as_object_mut) {
        ["position", "velocity"].iter().filter_map(|key| initial.get_mut(*key).map(cut)).for_each(drop);
        if initial.shift_remove("rotation").is_some() {
            initial.insert("angle".to_string(), json!(turn(facts.path(name)?.first()?)?));
        }
        if let Some(spin) = initial.get_mut("angular_velocity") {
            *spin = spin.get(2)?.clone();
        }
    }
    Some(flat)
}

/// The joint in the plane; `Some(None)` where it locks nothing there.
fn flat_joint(facts: &Facts, joint: &Value) -> Option<Option<Value>> {
    let first = joint["between"][0].as_str().and_then(|marker| facts.path(marker));
    let z = first.and_then(|path| path.first().copied())?.axes[2];
    let kind = match (text(joint, "type"), is_along(&z), is_across(&z)) {
        ("planar", true, _) => return Some(None),
        ("revolute" | "cylindrical" | "point_on_line", true, _) | ("spherical", ..) => "revolute",
        ("prismatic" | "cylindrical", _, true) => "prismatic",
        ("point_on_line", _, true) => "point_on_line",
        ("weld", ..) => "weld",
        ("distance", ..) => "distance",
        ("driver", true, _) if text(joint, "coordinate") == "angle" => "driver",
        _ => return None,
    };
    let mut flat = joint.clone();
    flat["type"] = json!(kind);
    joint.get("axis").is_none().then_some(Some(flat))
}

fn flat_force(force: &Value) -> Option<Value> {
    let mut flat = force.clone();
    match text(force, "type") {
        "spring_damper" | "torsion_spring" => {}
        "applied_force" => flat.get_mut("force").into_iter().for_each(cut),
        "applied_torque" => flat["torque"] = force["torque"].get(2)?.clone(),
        "bushing" => {
            for key in ["stiffness", "damping"] {
                if let Some(all) = force[key].as_array() {
                    flat[key] = [0, 1, 5].iter().filter_map(|i| all.get(*i).cloned()).collect();
                }
            }
        }
        _ => return None,
    }
    Some(flat)
}

/// The output in the plane; `None` for what is zero there or has no name.
fn flat_output(output: &Value) -> Option<Value> {
    let mut flat = output.clone();
    let is_out = |word: &str| [".z", ".wx", ".wy", ".wz"].iter().any(|end| word.ends_with(end));
    match (text(output, "measure"), text(output, "component")) {
        ("expression", _) if words(text(output, "value")).any(is_out) => return None,
        ("angular_velocity", "z") => {
            flat.as_object_mut()?.shift_remove("component");
        }
        ("angular_velocity", component) if !component.is_empty() => return None,
        (_, "z" | "mx" | "my") => return None,
        _ => {}
    }
    Some(flat)
}
