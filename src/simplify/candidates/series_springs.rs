//! Two springs in line with a small body between.

use crate::error::percent;
use crate::simplify::edit::{carrier, drop_references, elements, mentions, pair, remove, text};
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
    let acts = |list| elements(facts.scene(), list).iter().filter(|element| mentions(element, &name));
    let forces: Vec<&Value> = acts("forces").collect();
    let is_plain = ["rigid", "point_mass"].contains(&text(body, "type"));
    let ([one, other], true, None) = (&forces[..], is_plain, acts("joints").chain(acts("states")).next()) else {
        return None;
    };
    let springs = [Spring::new(facts, one, &name)?, Spring::new(facts, other, &name)?];
    let bend = bend(facts, &springs)?;
    let effect = facts.kinetic_share(&name).max(bend);
    let width = facts.lengths([&springs[0].own, &springs[1].own])?[1];
    let combined = combined(&springs, width);
    Some(Proposal {
        subject: name.clone(),
        what: format!("{name} goes: {} and {} are one spring", springs[0].name, springs[1].name),
        why: format!(
            "it has {} of the kinetic energy, and leaves the line of both by {}",
            percent(facts.kinetic_share(&name)),
            percent(bend)
        ),
        effect,
        edit: Box::new(move |scene| replace(scene, &name, &springs, &combined)),
    })
}

/// A spring at the body.
struct Spring {
    name: String,
    /// Its markers, on the body and beyond.
    own: String,
    other: String,
    /// As in the scene.
    force: Value,
}

impl Spring {
    fn new(facts: &Facts, force: &Value, body: &str) -> Option<Spring> {
        let [a, b] = pair(force)?;
        let (own, other) = if carrier(a) == body { (a, b) } else { (b, a) };
        let is_linear = text(force, "type") == "spring_damper" && force.get("law").is_none();
        let is_stiff = facts.number(&force["stiffness"]).is_some_and(|k| k > 0.0);
        (is_linear && is_stiff && carrier(other) != body).then(|| Spring {
            name: text(force, "name").to_string(),
            own: own.to_string(),
            other: other.to_string(),
            force: force.clone(),
        })
    }

    /// A number of it as a part of an expression.
    fn number(&self, key: &str) -> String {
        match &self.force[key] {
            Value::Null => "0".to_string(),
            Value::String(text) => format!("({text})"),
            number => format!("({number})"),
        }
    }

    /// Length without tension.
    fn relaxed(&self) -> String {
        let [free, preload, k] = ["free_length", "preload", "stiffness"].map(|key| self.number(key));
        if self.force.get("preload").is_some() { format!("{free} + {preload}/{k}") } else { free }
    }
}

/// Length of the broken line over that of the straight one, at most, relative to the displacements of the motion.
fn bend(facts: &Facts, [one, other]: &[Spring; 2]) -> Option<f64> {
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
fn combined(springs: &[Spring; 2], width: f64) -> Value {
    let [[k1, k2], [c1, c2]] = ["stiffness", "damping"].map(|key| springs.each_ref().map(|spring| spring.number(key)));
    let [one, other] = springs.each_ref().map(Spring::relaxed);
    let name = format!("{}_{}", springs[0].name, springs[1].name);
    let mut spring = json!({ "name": name, "type": "spring_damper",
                             "between": [springs[0].other, springs[1].other],
                             "stiffness": format!("{k1}*{k2}/({k1} + {k2})"),
                             "free_length": format!("{one} + {other} + {width}") });
    if springs.iter().any(|spring| spring.force.get("damping").is_some()) {
        spring["damping"] = json!(format!("({c1}*{k2}^2 + {c2}*{k1}^2)/({k1} + {k2})^2"));
    }
    spring
}

fn replace(scene: &mut Value, body: &str, springs: &[Spring; 2], combined: &Value) -> Result<(), String> {
    let there = |spring: &Spring| elements(scene, "forces").contains(&spring.force);
    if !springs.iter().all(there) {
        return Err(format!("the springs at `{body}` are no longer what they were"));
    }
    let is_own = |name: &str| springs.iter().any(|spring| spring.name == name);
    // The tension of both is that of the one.
    let is_tension = |output: &Value| {
        text(output, "measure") == "force"
            && ["", "axial"].contains(&text(output, "component"))
            && is_own(text(output, "of"))
    };
    let kept = |output: &Value| {
        let mut own = output.clone();
        if is_tension(output) {
            own["of"] = combined["name"].clone();
        }
        let names = [body, springs[0].name.as_str(), springs[1].name.as_str()];
        (is_tension(output) || !names.iter().any(|name| mentions(output, name))).then_some(own)
    };
    let outputs: Vec<Value> = elements(scene, "outputs").iter().filter_map(kept).collect();
    remove(scene, "bodies", |element| text(element, "name") == body);
    remove(scene, "forces", |force| is_own(text(force, "name")));
    [body, springs[0].name.as_str(), springs[1].name.as_str()].iter().for_each(|name| drop_references(scene, name));
    scene["outputs"] = json!(outputs);
    if let Some(forces) = scene["forces"].as_array_mut() {
        forces.push(combined.clone());
    }
    Ok(())
}
