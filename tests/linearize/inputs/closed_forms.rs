//! Transfer functions of displacements against closed forms, by every method.

use super::{C, changed, response, shaken, variation};
use crate::linearize::models::model;
use holonom::linearize::{Chart, LinearModel, modal};
use nalgebra::{Matrix2, Vector2};
use std::f64::consts::TAU;

const EXACT: [&str; 8] = [
    "mcs",
    "rcs",
    "rcs:form=index2",
    "rcs:form=index1",
    "rcs:form=ggl",
    "baumgarte",
    "force_projection:alpha=3",
    "baumgarte:projected=yes",
];
const PENALTIES: [&str; 3] = ["penalty:penalty=1e9", "penalty:penalty=1e9,kind=elastic", "augmented_lagrangian"];

/// x/u = (c s + k)/(m s^2 + c s + k), and the force of the drive.
fn shaken_base(frequency: f64) -> [C; 2] {
    let s = C::new(0.0, TAU * frequency);
    let spring = s * 4.0 + 300.0;
    let x = spring / (s * s * 2.0 + spring);
    [x, s * s + spring * (C::new(1.0, 0.0) - x)]
}

fn agrees(model: &LinearModel, closed: impl Fn(f64) -> Vec<C>, limit: f64) {
    for frequency in [0.05, 0.7, 1.95, 8.0, 60.0] {
        for (i, exact) in closed(frequency).into_iter().enumerate() {
            let off = (response(model, (i, 0), frequency) - exact).norm() / exact.norm();
            assert!(off < limit, "{} {i} at {frequency} Hz: {off:e}", model.method);
        }
    }
}

#[test]
fn a_driven_base() {
    let scene = shaken("0", "");
    let mut variation = variation(&scene);
    for (methods, limit) in [(&EXACT[..], 1e-8), (&PENALTIES[..], 1e-3)] {
        for method in methods {
            let model = model(&mut variation, method, None);
            assert_eq!(model.inputs, ["shaker''"]);
            assert!(model.states.ends_with(&["shaker".to_string(), "shaker'".to_string()]), "{:?}", model.states);
            agrees(&model, |f| shaken_base(f).to_vec(), limit);
            let physical = model.modes.iter().filter(|mode| mode.kind == holonom::linearize::Kind::Physical).count();
            assert_eq!(physical, 2, "{method}: the states of inputs are no modes");
        }
    }
    for chart in [Chart::MassOrthogonal, Chart::Frozen, Chart::parse("load.x")] {
        agrees(&model(&mut variation, "mcs", Some(chart)), |f| shaken_base(f).to_vec(), 1e-10);
    }
    agrees(&modal(&mut variation, 1, C::ZERO).unwrap(), |f| shaken_base(f).to_vec(), 1e-8);
}

/// M y'' + C y' + K y = (c_tyre s + k_tyre) road for wheel and body.
fn quarter_car(frequency: f64) -> Vec<C> {
    let s = C::new(0.0, TAU * frequency);
    let strut = s * 2200.0 + 34000.0;
    let tyre = s * 150.0 + 200000.0;
    let matrix = Matrix2::new(s * s * 38.0 + strut + tyre, -strut, -strut, s * s * 400.0 + strut);
    let y = matrix.lu().solve(&Vector2::new(tyre, C::ZERO)).unwrap();
    vec![y[1], y[0], y[1] - y[0], strut * (y[1] - y[0]), tyre * (C::new(1.0, 0.0) - y[0])]
}

#[test]
fn a_road_under_a_quarter_car() {
    let scene = changed("quarter_car", |json| json["inputs"] = serde_json::json!([{ "name": "road", "tyre": "tyre" }]));
    let mut variation = variation(&scene);
    for method in EXACT.iter().chain(&PENALTIES[..1]) {
        let model = model(&mut variation, method, None);
        assert_eq!((model.inputs[0].as_str(), model.states.last().unwrap().as_str()), ("road'", "road"));
        agrees(&model, quarter_car, 1e-8);
    }
    agrees(&modal(&mut variation, 2, C::ZERO).unwrap(), quarter_car, 1e-8);
}

/// Without a damper in the tyre no rate of the road is needed, and no state.
#[test]
fn an_undamped_road_is_an_input_itself() {
    let scene = changed("quarter_car", |json| {
        json["inputs"] = serde_json::json!([{ "name": "road", "tyre": "tyre" }]);
        json["parameters"]["c_tyre"] = 0.into();
    });
    let model = model(&mut variation(&scene), "mcs", None);
    assert_eq!((model.inputs, model.states.len()), (vec!["road".to_string()], 4));
}

/// The second driver holds what the input of the first would move.
#[test]
fn a_driver_that_is_held_is_refused() {
    let scene = crate::scenes::parse(
        r#"{ "name": "held", "dimension": 2,
        "bodies": [ { "name": "base", "type": "rigid", "mass": 1, "inertia": 1 } ],
        "joints": [ { "name": "a", "type": "driver", "between": ["ground", "base"], "coordinate": "x", "value": 0 },
            { "name": "b", "type": "driver", "between": ["ground", "base"], "coordinate": "x", "value": 0 } ],
        "inputs": [ { "name": "u", "driver": "a" } ] }"#,
    );
    let request = crate::linearize::models::request("rcs", None);
    let error = variation(&scene).linearize(&request).unwrap_err().to_string();
    assert!(error.contains("the input `u` moves a driver that other constraints hold"), "{error}");
}
