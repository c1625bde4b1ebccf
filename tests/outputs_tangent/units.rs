//! Outputs in other units than those of the SI.

use crate::outputs_tangent::compare::{outputs, tangent};
use crate::scenes::dop853;
use holonom::analysis::Recorder;
use holonom::prepared::Model;
use holonom::scene::Elements;
use holonom::simulate::simulate;
use holonom::system::OperatingPoint;
use serde_json::Value;
use std::path::Path;

/// Another unit of a measure, and how many of it are one of the SI.
fn other(measure: &str, component: &str) -> Option<(&'static str, f64)> {
    Some(match measure {
        "angle" => ("deg", 180.0 / std::f64::consts::PI),
        "angular_velocity" => ("rpm", 30.0 / std::f64::consts::PI),
        "position" | "distance" | "deflection" => ("mm", 1e3),
        "velocity" | "distance_rate" => ("km/h", 3.6),
        "reaction" if component.starts_with('m') => ("kN m", 1e-3),
        "reaction" | "axial_force" => ("kN", 1e-3),
        "bending_moment" => ("N mm", 1e3),
        "energy" => ("kJ", 1e-3),
        _ => return None,
    })
}

/// A shipped scene as it is, the same in other units, and the factor of each output.
fn both(name: &str) -> (Model, Model, Vec<f64>) {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("models/{name}.json"));
    let plain: Value = serde_json::from_str(&std::fs::read_to_string(path).unwrap()).unwrap();
    let mut changed = plain.clone();
    let mut factors = Vec::new();
    for output in changed["outputs"].as_array_mut().unwrap() {
        let component = output["component"].as_str().unwrap_or_default().to_string();
        let unit = other(output["measure"].as_str().unwrap(), &component);
        factors.push(unit.map_or(1.0, |(_, factor)| factor));
        if let Some((unit, _)) = unit {
            output["unit"] = unit.into();
        }
    }
    let prepared = |json: &Value| {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("models");
        Model::new(Elements::default().parse_in(&folder, &json.to_string(), &[]).unwrap(), &Default::default()).unwrap()
    };
    (prepared(&plain), prepared(&changed), factors)
}

fn near(found: f64, expected: f64, what: &str) {
    assert!((found - expected).abs() <= 1e-11 * expected.abs(), "{what}: {found}, expected {expected}");
}

#[test]
fn values_and_derivatives_are_in_the_unit() {
    for name in
        ["pendulum", "slider_crank", "spatial_slider_crank", "spinning_top", "full_axle", "flexible_slider_crank_fe"]
    {
        let (plain, changed, factors) = both(name);
        assert!(factors.iter().any(|factor| *factor != 1.0), "{name}");
        let state = |prepared: &Model| prepared.assembly.clone();
        let a = state(&plain);
        let at = OperatingPoint { t: plain.start_time(), q: &a.q, v: &a.v, vdot: &a.vdot, lambda: &a.lambda };
        let [values, others] = [&plain, &changed].map(|prepared| outputs(prepared.system(), at));
        let [slopes, scaled] = [&plain, &changed].map(|prepared| tangent(prepared.system(), at));
        for (i, factor) in factors.iter().enumerate() {
            near(others[i], factor * values[i], name);
            let pairs = [
                (&slopes.q, &scaled.q),
                (&slopes.v, &scaled.v),
                (&slopes.lambda, &scaled.lambda),
                (&slopes.u, &scaled.u),
            ];
            for (plain, changed) in pairs {
                plain.row(i).iter().zip(changed.row(i).iter()).for_each(|(x, y)| near(*y, factor * x, name));
            }
        }
    }
}

/// An angle in space is known up to full turns, in its own unit.
#[test]
fn turns_are_joined_in_the_unit() {
    let (plain, changed, factors) = both("spinning_top");
    let run = |prepared: &Model| {
        let mut recorder = Recorder::new(prepared.system());
        simulate(prepared.system(), &dop853(1e-9), prepared.span().unwrap(), prepared.start(), &mut recorder).unwrap();
        recorder.finish().trajectory
    };
    let plain = run(&plain);
    let changed = run(&changed);
    let last =
        |trajectory: &holonom::trajectory::Trajectory| trajectory.row_outputs(trajectory.rows.last().unwrap()).to_vec();
    assert_eq!(plain.rows.len(), changed.rows.len());
    for ((x, y), factor) in last(&plain).iter().zip(last(&changed)).zip(factors) {
        assert!((y - factor * x).abs() < 1e-9 * (1.0 + y.abs()), "{y} {x} {factor}");
    }
}
