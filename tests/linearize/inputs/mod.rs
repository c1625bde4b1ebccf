//! Inputs of drivers and roads: models against closed forms, simulated oscillations and perturbed simulations.

mod closed_forms;
mod moving;
mod simulated;
mod values;

use crate::scenes::{Ready, parse};
use holonom::linearize::{Complex, LinearModel, Variation, frequency_response};
use serde_json::Value;

type C = Complex<f64>;

/// A load of 2 kg on a spring (300 N/m, 4 N s/m) on a base of 1 kg, which is driven along x.
pub fn shaken(value: &str, input: &str) -> Ready {
    parse(&format!(
        r#"{{ "name": "shaken", "dimension": 2, "bodies": [
            {{ "name": "base", "type": "rigid", "mass": 1, "inertia": 1, "free": ["x"] }},
            {{ "name": "load", "type": "rigid", "mass": 2, "inertia": 1, "free": ["x"], "initial": {{ "position": [1, 0] }} }} ],
        "joints": [ {{ "name": "base", "type": "driver", "between": ["ground", "base"], "coordinate": "x", "value": "{value}" }} ],
        "forces": [ {{ "name": "spring", "type": "spring_damper", "between": ["base", "load"], "stiffness": 300,
            "damping": 4, "free_length": 1 }} ],
        "inputs": [ {{ "name": "shaker", "driver": "base"{input} }} ],
        "outputs": [ {{ "name": "x", "measure": "position", "of": "load", "component": "x" }},
            {{ "name": "force", "measure": "reaction", "of": "base" }} ] }}"#
    ))
}

/// A shipped scene, changed.
pub fn changed(name: &str, change: impl Fn(&mut Value)) -> Ready {
    let text = std::fs::read_to_string(crate::scenes::model(name)).unwrap();
    let mut json: Value = serde_json::from_str(&text).unwrap();
    change(&mut json);
    parse(&json.to_string())
}

pub fn variation(ready: &Ready) -> Variation<'_> {
    let (q, v) = ready.0.start();
    Variation::new(ready.system(), 0.0, q, v).unwrap()
}

/// Response of output `i` to input `j` at a frequency, Hz.
pub fn response(model: &LinearModel, (i, j): (usize, usize), frequency: f64) -> C {
    frequency_response(model, &[frequency])[0].as_ref().unwrap()[(i, j)]
}
