//! A body whose rotation does not matter.

use super::merged_bodies::{PLACES, packed};
use crate::body::dot;
use crate::error::percent;
use crate::math::array::Each;
use crate::scene::document::{elements, elements_mut, find_mut, mentions, rename, rename_in_scene, text};
use crate::simplify::{Candidate, Facts, Proposal};
use crate::tolerances::SAME;
use serde_json::{Value, json};

/// A rigid body on which all acts at its centre of mass becomes a point mass there, hinges in space becoming spherical:
/// its rotation goes, with its inertia. By what that has of the kinetic energy.
pub struct PointMass;

impl Candidate for PointMass {
    fn name(&self) -> &'static str {
        "point_mass"
    }

    fn propose(&self, facts: &Facts) -> Vec<Proposal> {
        elements(facts.scene(), "bodies").iter().filter_map(|body| proposal(facts, body)).collect()
    }
}

fn proposal(facts: &Facts, body: &Value) -> Option<Proposal> {
    let name = text(body, "name").to_string();
    let is_shaped = ["free", "shapes", "origin"].iter().any(|key| body.get(key).is_some());
    let markers: Vec<String> = body["markers"].as_object()?.keys().map(|marker| format!("{name}.{marker}")).collect();
    let acts = |marker: &str| {
        ["joints", "forces"].iter().any(|list| elements(facts.scene(), list).iter().any(|e| mentions_marker(e, marker)))
    };
    let reach = SAME * facts.travel().shift;
    let is_off =
        |marker: &String| acts(marker) && facts.lengths(&name, marker).is_none_or(|[.., largest]| largest > reach);
    if text(body, "type") != "rigid" || is_shaped || markers.iter().any(is_off) {
        return None;
    }
    let effect = rotation(facts, body)?;
    let what = format!("{name} becomes a point mass");
    let why = format!("its rotation has {} of the kinetic energy", percent(effect));
    Some(Proposal {
        subject: name.clone(),
        what,
        why,
        effect,
        edit: Box::new(move |scene| reduce(scene, &name, &markers)),
    })
}

fn mentions_marker(element: &Value, marker: &str) -> bool {
    let mut without = element.clone();
    rename(&mut without, marker, "");
    without != *element
}

/// Largest kinetic energy of the rotation of a body, relative to that of all bodies together.
fn rotation(facts: &Facts, body: &Value) -> Option<f64> {
    let inertia = packed(&body["inertia"])?;
    let moments: Vec<f64> = inertia.iter().map(|moment| facts.number(moment)).collect::<Option<_>>()?;
    let path = facts.path(text(body, "name"))?;
    let energies = path.iter().map(|place| {
        let spin = place.axes.each(|axis| dot(&axis, &place.spin));
        let terms = PLACES.iter().zip(&moments).map(|((i, j), moment)| {
            let part = 0.5 * moment * spin[*i] * spin[*j];
            if i == j { part } else { 2.0 * part }
        });
        terms.sum::<f64>()
    });
    Some(energies.fold(0.0, f64::max) / facts.kinetic_energy()).filter(|share| share.is_finite())
}

fn reduce(scene: &mut Value, name: &str, markers: &[String]) -> Result<(), String> {
    let body = find_mut(scene, "bodies", name)?;
    if text(body, "type") != "rigid" {
        return Err(format!("`{name}` is no longer rigid"));
    }
    let mut point = json!({ "name": name, "type": "point_mass", "mass": body["mass"], "initial": {} });
    for key in ["position", "velocity"] {
        if let Some(given) = body["initial"].get(key) {
            point["initial"][key] = given.clone();
        }
    }
    *body = point;
    let is_spatial = scene["dimension"] == 3;
    for joint in elements_mut(scene, "joints") {
        if is_spatial && mentions(joint, name) && ["revolute", "universal"].contains(&text(joint, "type")) {
            joint["type"] = json!("spherical");
        }
    }
    markers.iter().for_each(|marker| rename_in_scene(scene, marker, name));
    Ok(())
}
