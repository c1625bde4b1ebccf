//! Where the equations change their form, and what acts for a short time: nothing in time is stepped over.

mod by_clock;
mod gaps;
mod of_state;
mod sliding;

use crate::scenes::Ready;
use holonom::analysis::{Record, Recorder};
use holonom::method_spec::MethodSpec;
use holonom::simulate::{Method, Outcome, Span, simulate};

/// A method of every family that adapts its steps.
const ADAPTIVE: [[&str; 3]; 11] = [
    ["index1", "dopri5", "manifold"],
    ["index1", "dop853", "manifold"],
    ["index2", "phem56", "none"],
    ["index1", "radau_iia", "none"],
    ["ggl", "radau_iia", "none"],
    ["index3", "radau_iia", "none"],
    ["index1", "bdf", "none"],
    ["ggl", "bdf", "none"],
    ["index1", "esdirk34", "none"],
    ["ggl", "tr_bdf2", "none"],
    ["ggl", "generalized_alpha", "none"],
];

fn method([formulation, integrator, projection]: [&str; 3], tolerance: f64) -> Method {
    let spec = |text: &str| MethodSpec::parse(text).unwrap();
    Method {
        formulation: spec(formulation),
        integrator: spec(integrator),
        projection: spec(projection),
        rtol: tolerance,
        atol: tolerance,
        step: None,
    }
}

fn fixed(names: [&str; 3], step: f64) -> Method {
    Method { step: Some(step), ..method(names, 1e-8) }
}

/// A run that may fail, with rows at both ends only.
fn attempt(scene: &Ready, method: &Method, end: f64) -> (Outcome, Record) {
    let mut recorder = Recorder::new(scene.system());
    let span = Span { start: 0.0, end, output_step: end };
    let outcome = simulate(scene.system(), method, span, scene.0.start(), &mut recorder).unwrap();
    (outcome, recorder.finish())
}

/// A mass of 1 kg, free in the plane, pushed along x by an expression.
fn pushed(force: &str) -> Ready {
    crate::scenes::parse(&format!(
        r#"{{ "name": "pushed", "dimension": 2, "bodies": [{{ "name": "m", "type": "point_mass", "mass": 1 }}],
            "forces": [{{ "name": "push", "type": "applied_force", "at": "m", "force": ["{force}", 0] }}],
            "simulation": {{ "t_end": 10 }} }}"#
    ))
}
