//! Measured data in scenes: what the time loop does at their points, and what comes of them.

mod by_time;
mod half_car;
mod of_state;

use crate::scenes::{Ready, dop853, parse};
use holonom::method_spec::MethodSpec;
use holonom::simulate::{Method, Outcome, Span, simulate};

/// A mass of `m` kg that moves along x, pushed by `force`.
fn pushed(signal: &str, speed: f64, force: &str) -> Ready {
    parse(&format!(
        r#"{{ "name": "pushed", "dimension": 2, "signals": [{signal}],
            "bodies": [{{ "name": "m", "type": "rigid", "mass": 2, "inertia": 1, "free": ["x"],
                          "initial": {{ "velocity": [{speed}, 0] }} }}],
            "forces": [{{ "name": "push", "type": "applied_force", "at": "m", "force": ["{force}", 0] }}],
            "outputs": [{{ "name": "x", "measure": "position", "of": "m" }}],
            "simulation": {{ "t_end": 3 }} }}"#
    ))
}

/// A signal `f` through these points.
fn signal(points: impl IntoIterator<Item = (f64, f64)>, keys: &str) -> String {
    let points: Vec<String> = points.into_iter().map(|(x, y)| format!("[{x}, {y}]")).collect();
    format!(r#"{{ "name": "f", "points": [{}], {keys} }}"#, points.join(", "))
}

fn with(integrator: &str, tolerance: f64) -> Method {
    let named = MethodSpec::named;
    Method { integrator: named(integrator), projection: named("none"), ..dop853(tolerance) }
}

fn attempt(scene: &Ready, method: &Method, end: f64) -> Outcome {
    let mut recorder = holonom::analysis::Recorder::new(scene.system());
    let span = Span { start: 0.0, end, output_step: end };
    simulate(scene.system(), method, span, scene.0.start(), &mut recorder).unwrap()
}
