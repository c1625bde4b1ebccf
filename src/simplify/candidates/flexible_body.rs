//! A flexible beam with fewer elements, a few modes, quasi-static, or rigid.

use super::beam_spring::massless;
use super::section::{area, expression};
use crate::error::percent;
use crate::math::array::Each;
use crate::scene::document::{elements, find_mut, remove, text};
use crate::simplify::held::{Tie, acting};
use crate::simplify::{Candidate, Edit, Facts, Proposal};
use serde_json::{Map, Value, json};

/// Numbers of fixed-interface modes that are tried.
const MODES: [u32; 4] = [0, 1, 2, 4];
/// Deflection by length that is assumed where the beam does not tell it.
const ASSUMED: f64 = 0.1;
/// Part of the bending moment by its own inertia or weight that a supported beam lacks without fixed-interface modes: the
/// parabola of its ends' rotations has q L^2/12 where the beam has q L^2/8 in its middle.
const LACKING: f64 = 1.0 / 3.0;

/// A `flexible_beam` becomes rigid (straight and uniform ones), keeps a few Craig-Bampton modes in a floating frame, or
/// none but the static ones, moves as it is in such a frame, or has a half, a quarter or an eighth of its elements. Its
/// deflection by its length says how much a rigid one may be off, which falls with the fourth power of the number of
/// elements or modes; small displacements in a frame err by its square, and static modes in what its own inertia bends,
/// for which its share of the kinetic energy stands.
///
/// Static modes alone (Guyan, Reduction of stiffness and mass matrices, AIAA Journal 3, 1965) are the quasi-static
/// deflection: the beam bends under loads at its markers as at rest, exactly, and takes its own inertia with that shape,
/// so that the equations keep their form. Without inertia at all a deflection is an algebraic unknown, but for a
/// straight beam between two pins at its ends, which is a spring EA/L then: by its share of the kinetic energy.
pub struct FlexibleBody;

impl Candidate for FlexibleBody {
    fn name(&self) -> &'static str {
        "flexible_body"
    }

    fn propose(&self, facts: &Facts) -> Vec<Proposal> {
        let beams = elements(facts.scene(), "bodies").iter().filter(|body| text(body, "type") == "flexible_beam");
        beams.flat_map(|beam| alternatives(facts, beam)).collect()
    }
}

fn alternatives(facts: &Facts, beam: &Value) -> Vec<Proposal> {
    let name = text(beam, "name").to_string();
    let deflection = facts.deformation(&name).or_else(|| bend(facts, beam)).unwrap_or(ASSUMED);
    let proposal = |what: String, effect: f64, edit: Edit| Proposal {
        subject: name.clone(),
        what: format!("{name} {what}"),
        why: format!("it bends by {} of its length", percent(deflection)),
        effect,
        edit,
    };
    let set = |key: &'static str, number: u32| -> Edit {
        let name = name.clone();
        Box::new(move |scene| {
            find_mut(scene, "bodies", &name)?[key] = json!(number);
            Ok(())
        })
    };
    let finer = |n: u32| deflection / f64::from(n).powi(4);
    // Small displacements in a floating frame err by the square of the deflection.
    let is_absolute = text(beam, "frame") == "absolute";
    let nonlinear = if is_absolute { deflection.powi(2) } else { 0.0 };
    let count = |key: &str| facts.number(&beam[key]).map(|n| n as u32);
    let mesh = count("elements");
    let modes = count("modes");
    let mut all: Vec<Proposal> = Vec::new();
    if let Some(rigid) = rigid(facts, beam) {
        let (name, name_of) = (name.clone(), name.clone());
        let edit = move |scene: &mut Value| {
            *find_mut(scene, "bodies", &name)? = rigid.clone();
            drop_elastic_outputs(scene, &name);
            Ok(())
        };
        let effect = between_pins(facts, &name_of).unwrap_or(deflection);
        all.push(proposal("becomes rigid".to_string(), effect, Box::new(edit)));
    }
    let floating = |keep: Option<Edit>| -> Edit {
        let name = name.clone();
        Box::new(move |scene| {
            find_mut(scene, "bodies", &name)?["frame"] = json!("floating");
            keep.as_ref().map_or(Ok(()), |keep| keep(scene))
        })
    };
    if mesh.is_some() {
        let fewer = MODES.into_iter().filter(|k| modes.is_none_or(|modes| *k < modes));
        all.extend(fewer.map(|k| {
            let (what, lost) = match k {
                0 => ("deflects as at rest".to_string(), LACKING * deflection * facts.kinetic_share(&name)),
                k => (format!("keeps {k} of its modes"), finer(1 + k)),
            };
            proposal(what, nonlinear + lost, floating(Some(set("modes", k))))
        }));
    }
    if is_absolute {
        all.push(proposal("bends in a floating frame".to_string(), nonlinear, floating(None)));
    }
    all.extend(massless(facts, beam));
    if let (Some(n), None) = (mesh, modes) {
        let fewer = [8, 4, 2].each(|part| n / part).into_iter().filter(|n| *n > 0);
        all.extend(fewer.map(|k| proposal(format!("has {k} of its {n} elements"), finer(k), set("elements", k))));
    }
    all
}

/// Largest displacement of the last marker of a beam, seen from the first, by its length.
fn bend(facts: &Facts, beam: &Value) -> Option<f64> {
    let name = text(beam, "name");
    let markers = beam["markers"].as_object()?;
    let first = format!("{name}.{}", markers.keys().next()?);
    let last = format!("{name}.{}", markers.keys().next_back()?);
    let shift = facts.relative(&first, &last)?.shift;
    Some(shift / facts.number(&beam["length"])?).filter(|_| first != last)
}

/// Change of the distance between the two pins of a beam, by that distance, which is all that bodies beside it see of how
/// it bends; `None` where anything else acts on it.
fn between_pins(facts: &Facts, name: &str) -> Option<f64> {
    let acts = |list| acting(facts.scene(), list, name);
    let joints: Vec<&Value> = acts("joints").collect();
    let elastic = acts("outputs").any(|output| facts.watched.iter().any(|watched| watched == text(output, "name")));
    let [first, second] = joints[..] else { return None };
    let is_pin = |joint: &Value| {
        ["spherical", "universal"].contains(&text(joint, "type"))
            || facts.dimension() == 2 && text(joint, "type") == "revolute"
    };
    let is_link = is_pin(first) && is_pin(second) && acts("forces").next().is_none() && !elastic;
    let [least, mean, largest] = facts.lengths(&Tie::new(first, name)?.own, &Tie::new(second, name)?.own)?;
    is_link.then(|| (largest - least) / mean)
}

/// The beam as a rigid body of the same mass and moments of inertia, in the numbers of the scene.
fn rigid(facts: &Facts, beam: &Value) -> Option<Value> {
    if beam.get("curvature").is_some() {
        return None;
    }
    let length = expression(&beam["length"])?;
    let [line, spin] = densities(beam, facts.dimension())?;
    let mass = format!("{line}*{length}");
    let across = json!(format!("{mass}*{length}^2/12"));
    let inertia = if facts.dimension() == 2 { across } else { json!([format!("{spin}*{length}"), across, across]) };
    // A section that changes along the beam has no number.
    facts.number(&json!(mass)).filter(|mass| *mass > 0.0)?;
    facts.number(&json!(spin))?;
    let mut origin = vec![json!(0); facts.dimension()];
    origin[0] = json!(format!("-{length}/2"));
    let initial: Map<String, Value> = beam["initial"].as_object().map_or_else(Map::new, |initial| {
        let kept = initial.iter().filter(|(key, _)| !key.starts_with("elastic"));
        kept.map(|(key, value)| (key.clone(), value.clone())).collect()
    });
    Some(json!({ "name": beam["name"], "type": "rigid", "mass": mass, "inertia": inertia, "origin": origin,
                 "markers": beam.get("markers").cloned().unwrap_or_else(|| json!({})), "initial": initial }))
}

/// Mass, kg/m, and polar moment of inertia, kg m, of a length of the beam.
fn densities(beam: &Value, dimension: usize) -> Option<[String; 2]> {
    let given = &beam["inertia"];
    if let Some(line) = expression(&given["rhoA"]) {
        let spin = match &given["rhoI"] {
            Value::Array(both) => format!("({} + {})", expression(&both[0])?, expression(&both[1])?),
            one if dimension == 3 => format!("2*{}", expression(one)?),
            _ => "0".to_string(),
        };
        return Some([line, spin]);
    }
    let density = expression(&beam["material"]["rho"])?;
    let section = &beam["section"];
    let (area, gyration) = area(section)?;
    Some([format!("{density}*{area}"), format!("{density}*{area}*{gyration}")])
}

/// Removes the outputs of a beam that a rigid body has not.
fn drop_elastic_outputs(scene: &mut Value, name: &str) {
    let elastic = ["deflection", "strain", "axial_force", "shear_force", "torque", "bending_moment"];
    let is_gone = |output: &Value| elastic.contains(&text(output, "measure")) && text(output, "of") == name;
    remove(scene, "outputs", is_gone);
}
