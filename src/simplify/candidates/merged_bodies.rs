//! Two bodies that hardly move against each other.

use crate::error::percent;
use crate::simplify::edit::{carrier, drop_references, elements, find_mut, pair, remove, rename, text};
use crate::simplify::facts::product;
use crate::simplify::{Candidate, Facts, Placed, Proposal, Relative};
use serde_json::{Value, json};
use std::array::from_fn;

/// Two rigid bodies that a joint connects become one, as they are to each other at the start: joints between the two go. By
/// their motion against each other, which a weld does not let them have.
pub struct MergedBodies;

impl Candidate for MergedBodies {
    fn name(&self) -> &'static str {
        "merged_bodies"
    }

    fn propose(&self, facts: &Facts) -> Vec<Proposal> {
        let travel = facts.travel();
        let pairs = elements(facts.scene(), "joints").iter().filter_map(pair).map(|pair| pair.map(carrier));
        pairs.filter_map(|pair| proposal(facts, pair, &travel)).collect()
    }
}

fn proposal(facts: &Facts, [first, second]: [&str; 2], travel: &Relative) -> Option<Proposal> {
    let merged = Merged::new(facts, [first, second])?;
    let effect = facts.relative([first, second])?.part(travel);
    Some(Proposal {
        subject: format!("{first}, {second}"),
        what: format!("{first} and {second} become one body"),
        why: format!("they move against each other by {} of what bodies do", percent(effect)),
        effect,
        edit: Box::new(move |scene| merged.replace(scene)),
    })
}

/// The body that two make.
struct Merged {
    /// The two, as they are in the richest model.
    parts: [Value; 2],
    body: Value,
    /// Markers of the second with their new names, its own frame last.
    markers: Vec<(String, String)>,
}

type Tensor = [[f64; 3]; 3];

/// Mass, centre of mass and inertia about that, in the frame of the first body's origin.
struct Solid {
    mass: f64,
    centre: [f64; 3],
    inertia: Tensor,
}

impl Merged {
    fn new(facts: &Facts, names: [&str; 2]) -> Option<Merged> {
        let is_free = |body: &Value| text(body, "type") == "rigid" && body.get("free").is_none();
        let of = |name: &str| facts.element("bodies", name).filter(|body| is_free(body));
        let parts = [of(names[0])?, of(names[1])?];
        let base = *facts.path(names[0])?.first()?;
        let place = |marker: &str| Some(seen(&base, facts.path(marker)?.first()?));
        let dimension = facts.dimension();
        let solid = |i: usize| solid(facts, parts[i], &place(names[i])?);
        let whole = sum(&solid(0)?, &solid(1)?);
        let mut body = parts[0].clone();
        // Assembly would share the motion of the first alone among both.
        body["initial"] = facts.initial(names[0])?;
        body["mass"] = json!(whole.mass);
        body["origin"] = json!(whole.centre.map(|x| -x)[..dimension]);
        let j = whole.inertia;
        body["inertia"] = match dimension {
            2 => json!(j[2][2]),
            _ => json!([j[0][0], j[1][1], j[2][2], j[0][1], j[0][2], j[1][2]]),
        };
        let own = parts[1]["markers"].as_object().into_iter().flatten().map(|(marker, _)| marker);
        let renamed = |marker: &String| {
            let (from, to) = (format!("{}.{marker}", names[1]), format!("{}_{marker}", names[1]));
            (from, to)
        };
        let mut markers: Vec<(String, String)> = own.map(renamed).collect();
        markers.push((names[1].to_string(), names[1].to_string()));
        for (from, to) in &mut markers {
            body["markers"][&*to] = place(from)?.marker(dimension);
            *to = format!("{}.{to}", names[0]);
        }
        Some(Merged { parts: parts.map(Clone::clone), body, markers })
    }

    fn replace(&self, scene: &mut Value) -> Result<(), String> {
        let [first, second] = self.parts.each_ref().map(|part| text(part, "name").to_string());
        for (name, part) in [(&first, &self.parts[0]), (&second, &self.parts[1])] {
            if find_mut(scene, "bodies", name)? != part {
                return Err(format!("`{name}` is no longer what it was"));
            }
        }
        *find_mut(scene, "bodies", &first)? = self.body.clone();
        remove(scene, "bodies", |body| text(body, "name") == second);
        for (from, to) in &self.markers {
            for list in ["joints", "forces", "states", "outputs"] {
                let elements = scene.get_mut(list).and_then(Value::as_array_mut).into_iter().flatten();
                elements.for_each(|element| rename(element, from, to));
            }
        }
        for list in ["joints", "forces"] {
            let is_inner =
                |element: &&Value| pair(element).is_some_and(|pair| pair.iter().all(|m| carrier(m) == first));
            let inner = elements(scene, list).iter().filter(is_inner);
            let gone: Vec<String> = inner.map(|element| text(element, "name").to_string()).collect();
            remove(scene, list, |element| gone.iter().any(|name| name == text(element, "name")));
            gone.iter().for_each(|name| drop_references(scene, name));
        }
        Ok(())
    }
}

/// A placement in the axes of another and from its origin.
fn seen(base: &Placed, place: &Placed) -> Placed {
    let local = |vector: [f64; 3]| base.axes.map(|axis| product(&axis, &vector));
    Placed {
        r: local(from_fn(|i| place.r[i] - base.r[i])),
        axes: place.axes.map(local),
        turn: place.turn - base.turn,
        ..*place
    }
}

/// A rigid body with its origin at `place`.
fn solid(facts: &Facts, body: &Value, place: &Placed) -> Option<Solid> {
    let given = |values: &Value, i: usize| facts.number(&values[i]);
    let origin: [f64; 3] = from_fn(|i| given(&body["origin"], i).unwrap_or(0.0));
    let own: Tensor = match &body["inertia"] {
        Value::Array(all) => {
            let part = |i: usize| if i < all.len() { facts.number(&all[i]) } else { Some(0.0) };
            let [xx, yy, zz, xy, xz, yz] = [part(0)?, part(1)?, part(2)?, part(3)?, part(4)?, part(5)?];
            [[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]]
        }
        moment => {
            let moment = facts.number(moment)?;
            from_fn(|i| from_fn(|j| if i == j { moment } else { 0.0 }))
        }
    };
    // axes[k] is the k-th axis of the body: a vector x of it is sum x_k axes[k].
    let turned = |i: usize, j: usize| {
        let terms = (0..9).map(|k| (k / 3, k % 3));
        terms.map(|(k, l)| place.axes[k][i] * own[k][l] * place.axes[l][j]).sum::<f64>()
    };
    Some(Solid {
        mass: facts.number(&body["mass"])?,
        centre: from_fn(|i| place.r[i] - (0..3).map(|k| origin[k] * place.axes[k][i]).sum::<f64>()),
        inertia: from_fn(|i| from_fn(|j| turned(i, j))),
    })
}

/// Both together, by the theorem of parallel axes.
fn sum(a: &Solid, b: &Solid) -> Solid {
    let mass = a.mass + b.mass;
    let centre: [f64; 3] = match mass > 0.0 {
        true => from_fn(|i| (a.mass * a.centre[i] + b.mass * b.centre[i]) / mass),
        false => a.centre,
    };
    let about = |solid: &Solid, i: usize, j: usize| {
        let arm: [f64; 3] = from_fn(|k| solid.centre[k] - centre[k]);
        let square = if i == j { product(&arm, &arm) } else { 0.0 };
        solid.inertia[i][j] + solid.mass * (square - arm[i] * arm[j])
    };
    Solid { mass, centre, inertia: from_fn(|i| from_fn(|j| about(a, i, j) + about(b, i, j))) }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Two halves of a rod of 2 kg and 2 m.
    #[test]
    fn halves_make_a_whole() {
        let half = |x: f64| Solid {
            mass: 1.0,
            centre: [x, 0.0, 0.0],
            inertia: [[0.0; 3], [0.0, 1.0 / 12.0, 0.0], [0.0, 0.0, 1.0 / 12.0]],
        };
        let whole = sum(&half(0.5), &half(1.5));
        assert_eq!((whole.mass, whole.centre), (2.0, [1.0, 0.0, 0.0]));
        assert!((whole.inertia[2][2] - 2.0 * 4.0 / 12.0).abs() < 1e-15 && whole.inertia[0][0] == 0.0);
    }
}
