//! Links between two points: which pull, which push.

use super::bench::mechanism;
use super::candidates::PinnedLink;
use super::facts::{Facts, PlacedMarker};
use super::held::Tie;
use crate::body::{norm, sub};
use crate::scene::document::{elements, text};
use crate::tolerances::SAME;
use serde::Serialize;
use serde_json::{Value, json};

/// Force along a link between two points, tension positive, in small motions about the start.
#[derive(Clone, Debug, Serialize)]
pub struct RodForce {
    /// Name of the `distance`, or of the body between two pins.
    pub name: String,
    /// Force at the start, N.
    pub at_start: f64,
    /// Least force, N.
    pub least: f64,
    /// Largest force, N.
    pub most: f64,
}

/// Outputs from which the force along a link follows: their sum with weights that depend on the state.
struct AxialForce {
    name: String,
    outputs: Vec<Value>,
    /// A row for each state.
    weights: Vec<Vec<f64>>,
}

/// The links of a scene that carry a force at the start: each `distance`, and each rigid body without loads between two
/// pins, whose force is the mean of those at its ends. None where constraints are redundant: their forces are then not
/// determined by the motion.
pub fn rods(facts: &Facts) -> Vec<RodForce> {
    if !facts.redundant.is_empty() {
        return Vec::new();
    }
    let distances = elements(facts.scene(), "joints").iter().filter(|joint| text(joint, "type") == "distance");
    let links = elements(facts.scene(), "bodies").iter().filter_map(|body| link(facts, body));
    let sources: Vec<AxialForce> = distances.map(|joint| distance(facts, text(joint, "name"))).chain(links).collect();
    let mut all = forces(facts, &sources).unwrap_or_default();
    let largest = all.iter().map(|rod| rod.most.max(-rod.least)).fold(0.0, f64::max);
    all.retain(|rod| rod.at_start.abs() > SAME * largest);
    all
}

fn distance(facts: &Facts, name: &str) -> AxialForce {
    let output = json!({ "measure": "reaction", "of": name, "component": "axial" });
    AxialForce { name: name.to_string(), outputs: vec![output], weights: vec![vec![1.0]; facts.states().len()] }
}

/// Half the difference of the forces on the link at its ends, along it: tension pulls it outwards at both.
fn link(facts: &Facts, body: &Value) -> Option<AxialForce> {
    let (name, PinnedLink { pins, .. }) = (text(body, "name"), PinnedLink::new(facts, body)?);
    let components = &["x", "y", "z"][..facts.dimension()];
    let output =
        |(pin, component): (&Tie, &&str)| json!({ "measure": "reaction", "of": pin.name(), "component": component });
    let outputs = pins.iter().flat_map(|pin| components.iter().map(move |component| (pin, component))).map(output);
    let along = |(first, second): (PlacedMarker, PlacedMarker)| {
        let gap = sub(&second.r, &first.r);
        let size = norm(&gap);
        // A reaction acts on the second body of its joint.
        let signs = [-0.5, 0.5].into_iter().zip(&pins).map(|(part, pin)| if pin.is_second { part } else { -part });
        signs.flat_map(|sign| gap[..components.len()].iter().map(move |x| sign * x / size)).collect()
    };
    let weights = facts.path(&pins[0].own)?.into_iter().zip(facts.path(&pins[1].own)?).map(along).collect();
    Some(AxialForce { name: name.to_string(), outputs: outputs.collect(), weights })
}

fn forces(facts: &Facts, sources: &[AxialForce]) -> Option<Vec<RodForce>> {
    let mut outputs: Vec<Value> = sources.iter().flat_map(|source| source.outputs.clone()).collect();
    let mut scene = facts.scene().clone();
    let mut prefix = "rod".to_string();
    while elements(&scene, "outputs").iter().any(|output| text(output, "name").starts_with(&prefix)) {
        prefix.push('_');
    }
    let names: Vec<String> = (0..outputs.len()).map(|i| format!("{prefix}{i}")).collect();
    outputs.iter_mut().zip(&names).for_each(|(output, name)| output["name"] = json!(name));
    scene["outputs"] = json!([elements(&scene, "outputs"), &outputs].concat());
    let rows = facts.read(&mechanism(&facts.source, &names, &scene).ok()?, &names, facts.states().iter())?;
    if names.is_empty() {
        return None;
    }
    let mut rods = Vec::new();
    let mut first = 0;
    for source in sources {
        let columns = first..first + source.outputs.len();
        first = columns.end;
        let sum = |(row, weights): (&Vec<f64>, &Vec<f64>)| -> f64 {
            row[columns.clone()].iter().zip(weights).map(|(value, weight)| value * weight).sum()
        };
        rods.extend(rod(&source.name, rows.iter().zip(&source.weights).map(sum).collect()));
    }
    Some(rods)
}

/// Returns the rod with these forces over the states; none without states.
fn rod(name: &str, forces: Vec<f64>) -> Option<RodForce> {
    let least = forces.iter().copied().reduce(f64::min)?;
    let largest = forces.iter().copied().reduce(f64::max)?;
    Some(RodForce { name: name.to_string(), at_start: *forces.first()?, least, most: largest })
}
