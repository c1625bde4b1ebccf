//! Two springs in line with a small body between.

use crate::error::percent;
use crate::simplify::edit::{add, elements, elements_mut, text};
use crate::simplify::held::{Tie, acting, are_all, remove_body};
use crate::simplify::{Candidate, Facts, Proposal};
use serde_json::{Value, json};

/// A body that only two springs hold, in line with each other, goes with its mass, and the springs become one: they pull
/// with one tension T = k_i (l_i - l_i0) + c_i l_i', so that, with k = k_1 k_2/(k_1 + k_2) and a distance d between the
/// springs on the body,
///
/// ```text
/// T = k (l - l_10 - l_20 - d) + c l' + O(l''),   c = (c_1 k_2^2 + c_2 k_1^2)/(k_1 + k_2)^2
/// ```
///
/// By the share of the body in the kinetic energy, and by how far it leaves the line along the motion. Both springs need
/// their stiffness: of a damper alone the place of the body would be a state.
pub struct SeriesSprings;

impl Candidate for SeriesSprings {
    fn name(&self) -> &'static str {
        "series_springs"
    }

    fn propose(&self, facts: &Facts) -> Vec<Proposal> {
        elements(facts.scene(), "bodies").iter().filter_map(|body| proposal(facts, body)).collect()
    }
}

fn proposal(facts: &Facts, body: &Value) -> Option<Proposal> {
    let name = text(body, "name").to_string();
    let acts = |list| acting(facts.scene(), list, &name);
    let forces: Vec<&Value> = acts("forces").collect();
    let is_plain = ["rigid", "point_mass"].contains(&text(body, "type"));
    let ([one, other], true, None) = (&forces[..], is_plain, acts("joints").chain(acts("states")).next()) else {
        return None;
    };
    let springs = [spring(facts, one, &name)?, spring(facts, other, &name)?];
    let bend = bend(facts, &springs)?;
    let effect = facts.kinetic_share(&name).max(bend);
    let width = facts.lengths([&springs[0].own, &springs[1].own])?[1];
    let combined = combined(&springs, width);
    Some(Proposal {
        subject: name.clone(),
        what: format!("{name} goes: {} and {} are one spring", springs[0].name(), springs[1].name()),
        why: format!(
            "it has {} of the kinetic energy, and leaves the line of both by {}",
            percent(facts.kinetic_share(&name)),
            percent(bend)
        ),
        effect,
        edit: Box::new(move |scene| replace(scene, &name, &springs, &combined)),
    })
}

/// The force as a linear spring at the body.
fn spring(facts: &Facts, force: &Value, body: &str) -> Option<Tie> {
    let is_linear = text(force, "type") == "spring_damper" && force.get("law").is_none();
    let is_stiff = facts.number(&force["stiffness"]).is_some_and(|k| k > 0.0);
    Tie::new(force, body).filter(|_| is_linear && is_stiff)
}

/// A number of a spring as a part of an expression.
fn number(spring: &Value, key: &str) -> String {
    match &spring[key] {
        Value::Null => "0".to_string(),
        Value::String(text) => format!("({text})"),
        number => format!("({number})"),
    }
}

/// Length of a spring without tension.
fn relaxed(spring: &Value) -> String {
    let [free, preload, k] = ["free_length", "preload", "stiffness"].map(|key| number(spring, key));
    if spring.get("preload").is_some() { format!("{free} + {preload}/{k}") } else { free }
}

/// Length of the broken line over that of the straight one, at most, relative to the displacements of the motion.
fn bend(facts: &Facts, [one, other]: &[Tie; 2]) -> Option<f64> {
    let path = |marker: &str| facts.path(marker);
    let ends = [path(&one.other)?, path(&one.own)?, path(&other.own)?, path(&other.other)?];
    let length = |a: &[f64; 3], b: &[f64; 3]| a.iter().zip(b).map(|(a, b)| (a - b).powi(2)).sum::<f64>().sqrt();
    let excess = |i: usize| {
        let r = ends.each_ref().map(|path| path[i].r);
        length(&r[0], &r[1]) + length(&r[1], &r[2]) + length(&r[2], &r[3]) - length(&r[0], &r[3])
    };
    let most = (0..ends[0].len()).map(excess).fold(0.0, f64::max);
    Some(most / facts.travel().shift).filter(|part| part.is_finite())
}

/// Both in series.
fn combined(springs: &[Tie; 2], width: f64) -> Value {
    let forces = springs.each_ref().map(|spring| &spring.element);
    let [[k1, k2], [c1, c2]] = ["stiffness", "damping"].map(|key| forces.map(|force| number(force, key)));
    let [one, other] = forces.map(relaxed);
    let name = format!("{}_{}", springs[0].name(), springs[1].name());
    let mut spring = json!({ "name": name, "type": "spring_damper",
                             "between": [springs[0].other, springs[1].other],
                             "stiffness": format!("{k1}*{k2}/({k1} + {k2})"),
                             "free_length": format!("{one} + {other} + {width}") });
    if forces.iter().any(|force| force.get("damping").is_some()) {
        spring["damping"] = json!(format!("({c1}*{k2}^2 + {c2}*{k1}^2)/({k1} + {k2})^2"));
    }
    spring
}

fn replace(scene: &mut Value, body: &str, springs: &[Tie; 2], combined: &Value) -> Result<(), String> {
    if !are_all(springs.iter(), scene, "forces", body) {
        return Err(format!("the springs at `{body}` are no longer what they were"));
    }
    // The tension of both is that of the one.
    let is_tension = |output: &Value| {
        text(output, "measure") == "force"
            && ["", "axial"].contains(&text(output, "component"))
            && springs.iter().any(|spring| spring.name() == text(output, "of"))
    };
    let tensions = elements_mut(scene, "outputs").filter(|output| is_tension(output));
    tensions.for_each(|output| output["of"] = combined["name"].clone());
    remove_body(scene, body)?;
    add(scene, "forces", combined.clone());
    Ok(())
}
