//! A state that follows at once.

use crate::error::percent;
use crate::formulation::Dynamics;
use crate::scene::document::{elements, elements_mut, find, remove, rename, text};
use crate::simplify::{Candidate, Facts, Proposal};
use crate::system::{OperatingPoint, Tangent};
use serde_json::Value;

/// A state whose rate falls with it, and fast, as that of a filter, becomes the value at which its rate is zero: of a
/// rate a + b x that is -a/b. By the largest lag |x'/b| behind that, relative to the range of the state.
pub struct QuasiStaticState;

impl Candidate for QuasiStaticState {
    fn name(&self) -> &'static str {
        "quasi_static_state"
    }

    fn propose(&self, facts: &Facts) -> Vec<Proposal> {
        let states = elements(facts.scene(), "states").iter().enumerate();
        states.filter_map(|(i, state)| proposal(facts, i, text(state, "name"))).collect()
    }
}

fn proposal(facts: &Facts, index: usize, name: &str) -> Option<Proposal> {
    let effect = lag(facts, index)?;
    let name = name.to_string();
    Some(Proposal {
        subject: name.clone(),
        what: format!("{name} follows at once"),
        why: format!("it lags by {} of its range", percent(effect)),
        effect,
        edit: Box::new(move |scene| settle(scene, &name)),
    })
}

/// Largest |x'/b| with b = dx'/dx < 0, relative to the range of the state.
fn lag(facts: &Facts, index: usize) -> Option<f64> {
    let system = facts.prepared.system();
    let n = system.dimensions();
    let place = n.v - n.states + index;
    let mut dynamics = Dynamics::new(system);
    let mut tangent = Tangent::new(&dynamics.structure.tangent);
    let entries = dynamics.structure.tangent.entries.iter().enumerate();
    let own: Vec<usize> = entries.filter(|(_, entry)| **entry == (place, place)).map(|(i, _)| i).collect();
    let mut lag = 0.0f64;
    let mut least = f64::INFINITY;
    let mut most = f64::NEG_INFINITY;
    for state in facts.few_states() {
        dynamics.solve(state.t, &state.q, &state.v, |_, _| 0.0).ok()?;
        let vdot = &dynamics.vdot;
        let lambda = &dynamics.lambda;
        let at = OperatingPoint { t: state.t, q: &state.q, v: &state.v, vdot, lambda };
        let is_known = system.tangent(at, &mut tangent, &mut dynamics.scratch);
        let slope = own.iter().map(|i| tangent.c[*i]).sum::<f64>();
        if !is_known || slope <= 0.0 {
            return None;
        }
        lag = lag.max((dynamics.vdot[place] / slope).abs());
        (least, most) = (least.min(state.v[place]), most.max(state.v[place]));
    }
    (most > least).then(|| lag / (most - least))
}

/// Puts the value at which the rate is zero in the place of the state.
fn settle(scene: &mut Value, name: &str) -> Result<(), String> {
    let rate = find(scene, "states", name).ok_or_else(|| format!("`{name}` is no longer there"))?["rate"].clone();
    let at = |x: &str| {
        let mut rate = rate.clone();
        rename(&mut rate, name, x);
        rate.as_str().unwrap_or("0").to_string()
    };
    let zero = at("0");
    let one = at("1");
    let value = format!("(({zero})/(({zero}) - ({one})))");
    remove(scene, "states", |state| text(state, "name") == name);
    let keys = [("states", "rate"), ("outputs", "value"), ("forces", "force"), ("forces", "torque"), ("forces", "law")];
    for (list, key) in keys {
        elements_mut(scene, list)
            .filter_map(|element| element.get_mut(key))
            .for_each(|text| rename(text, name, &value));
    }
    Ok(())
}
