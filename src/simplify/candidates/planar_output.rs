//! Outputs of a mechanism in space in the plane that it moves in.

use super::plane::Plane;
use crate::body::{cross, dot};
use crate::scene::document::{take, text};
use crate::simplify::Facts;
use crate::tolerances::SAME;
use serde_json::{Value, json};

/// The output in the plane, after others that it is made of; `None` for what is zero there or has no name.
pub fn flat_output(facts: &Facts, plane: &Plane, output: &Value) -> Option<Vec<Value>> {
    let measure = text(output, "measure");
    let component = text(output, "component");
    let turns = measure.starts_with("angle") || measure.starts_with("angular");
    let mut own = output.clone();
    match component {
        "x" | "y" | "z" | "mx" | "my" | "mz" => {}
        _ if turns => {}
        _ => {
            plane.translate(own.get_mut("value").unwrap_or(&mut Value::Null))?;
            return Some(vec![own]);
        }
    }
    let of = text(output, "of");
    let pair = ["joints", "forces"].iter().find_map(|list| facts.element(list, of));
    let pair = pair.filter(|_| turns).and_then(crate::scene::document::pair);
    // What is measured, and against what.
    let [base, end] = pair.unwrap_or([output["relative_to"].as_str().unwrap_or("ground"), of]);
    let frame = facts.place(base)?;
    let axis = frame.axes[["x", "y"].iter().position(|name| component.ends_with(name)).unwrap_or(2)];
    if turns || component.starts_with('m') {
        let is_x = |name: &str| Some((dot(&plane.x_of(facts, name)?, &facts.place(name)?.axes[0]) - 1.0).abs() < SAME);
        let sign = plane.along(&axis)?;
        if measure == "angle" && !(is_x(base)? && is_x(end)?) {
            return None;
        }
        if turns {
            drop(take(&mut own, "component"))
        } else {
            own["component"] = json!("mz")
        }
        return made_of(&own, &[(sign, None)], 0.0);
    }
    let x = plane.x_of(facts, base)?;
    let parts = [(dot(&axis, &x), Some("x")), (dot(&axis, &cross(plane.normal(), &x)), Some("y"))];
    let out = dot(&axis, plane.normal());
    let height = |name: &str| Some(dot(&facts.place(name)?.r, plane.normal()));
    let offset = if measure == "position" { out * (height(end)? - height(base)?) } else { 0.0 };
    made_of(&own, &parts, offset)
}

/// The output, or an expression of its own parts, each a factor with a component, plus an offset: `None` where these are
/// none, in a unit that an expression has not, or an integral over the run.
pub fn made_of(own: &Value, parts: &[(f64, Option<&str>)], offset: f64) -> Option<Vec<Value>> {
    let name = text(own, "name");
    let mut all = Vec::new();
    let mut sum = Vec::new();
    for (part, component) in parts.iter().filter(|(part, _)| part.abs() > SAME) {
        let mut output = own.clone();
        if let Some(component) = component {
            output["component"] = json!(component);
        }
        if (part - 1.0).abs() < SAME && offset.abs() < SAME {
            return Some(vec![output]);
        }
        output["name"] = json!(format!("{name}_{}", component.unwrap_or("part")));
        sum.push(format!("{part}*{}", text(&output, "name")));
        all.push(output);
    }
    if sum.is_empty() || own.get("unit").is_some() || text(own, "measure") == "work" {
        return None;
    }
    all.push(json!({ "name": name, "measure": "expression", "value": format!("{} + {offset}", sum.join(" + ")) }));
    Some(all)
}
