//! A beam between two pins as a spring.

use super::section::{area, expression};
use super::two_force_link::PinnedLink;
use crate::math::array::Each;
use crate::scene::document::{add, elements, elements_mut, remove, text};
use crate::simplify::{Facts, Proposal};
use crate::tolerances::SAME;
use serde_json::{Value, json};

/// A straight beam between pins at its two ends as a spring without mass.
pub fn massless(facts: &Facts, beam: &Value) -> Option<Proposal> {
    let name = text(beam, "name");
    let link = PinnedLink::between_pins(facts, beam).filter(|_| beam.get("curvature").is_none())?;
    let ends = link.pins.each_ref().each(|pin| on_line(facts, beam, &pin.own));
    let stiffness = format!("{}/({})", axial_stiffness(beam)?, link.length);
    let gap = (ends[0]? - ends[1]?).abs();
    let length = facts.number(&beam["length"])?;
    // A section that changes along the beam has no number.
    facts.number(&json!(stiffness))?;
    let mut spring = json!({ "name": name, "type": "spring_damper", "between": link.others(), "stiffness": stiffness,
                             "free_length": link.length });
    if let Some(beta) = expression(&beam["damping"]["rayleigh"]["stiffness"]) {
        spring["damping"] = json!(format!("{beta}*{stiffness}"));
    }
    let edit = move |scene: &mut Value| {
        let axial =
            |output: &&Value| text(output, "measure") == "axial_force" && text(output, "of") == text(&spring, "name");
        let tensions: Vec<Value> = elements(scene, "outputs").iter().filter(axial).cloned().collect();
        link.replace(scene)?;
        as_spring(scene, &spring, tensions);
        Ok(())
    };
    let is_whole = (gap - length).abs() <= SAME * length;
    is_whole.then(|| Proposal::without_mass(facts, name, "becomes a spring without mass", Box::new(edit)))
}

/// Place of a marker along a beam; `None` where it is beside the line.
fn on_line(facts: &Facts, beam: &Value, marker: &str) -> Option<f64> {
    let given = &beam["markers"][marker.split_once('.')?.1];
    let position = given.as_array().or_else(|| given["position"].as_array())?;
    let all = position.iter().map(|x| facts.number(x)).collect::<Option<Vec<f64>>>()?;
    all[1..].iter().all(|x| *x == 0.0).then_some(all[0])
}

/// EA as a part of an expression.
fn axial_stiffness(beam: &Value) -> Option<String> {
    let given = expression(&beam["stiffness"]["EA"]);
    given.or_else(|| Some(format!("{}*{}", expression(&beam["material"]["E"])?, area(&beam["section"])?.0)))
}

/// The distance that has come in the place of a beam as a spring, with the outputs of its tension.
fn as_spring(scene: &mut Value, spring: &Value, tensions: Vec<Value>) {
    let name = text(spring, "name");
    remove(scene, "joints", |joint| text(joint, "name") == name);
    let is_reaction = |output: &Value| text(output, "measure") == "reaction" && text(output, "of") == name;
    // Components in the world are those on the second body of a pin.
    let is_gone = |output: &Value| is_reaction(output) && !["", "axial"].contains(&text(output, "component"));
    remove(scene, "outputs", is_gone);
    tensions.into_iter().for_each(|tension| add(scene, "outputs", tension));
    let is_tension = |output: &&mut Value| {
        is_reaction(output) || text(output, "measure") == "axial_force" && text(output, "of") == name
    };
    for output in elements_mut(scene, "outputs").filter(is_tension) {
        let unit = output.get("unit").cloned();
        *output = json!({ "name": output["name"], "measure": "force", "of": name });
        unit.into_iter().for_each(|unit| output["unit"] = unit);
    }
    add(scene, "forces", spring.clone());
}
