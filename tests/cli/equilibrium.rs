//! `check --static`.

use super::*;

#[test]
fn the_equilibrium_is_told() {
    let place = Place::new(PENDULUM);
    let text = place.done(&["check", "scene.json", "--static"]);
    for word in [
        "static equilibrium at t = 0 s, stable",
        "linear systems",
        "moved rod.y: 0 -> -0.5",
        "multiplier there",
        "pin    ",
    ] {
        assert!(text.contains(word), "{word} in\n{text}");
    }
    assert!(!place.done(&["check", "scene.json"]).contains("static equilibrium at"));
    assert_eq!(place.files("."), ["scene.json"]);
}

#[test]
fn json_has_it_under_a_key() {
    let place = Place::new(PENDULUM);
    let check: Value = serde_json::from_str(&place.done(&["check", "scene.json", "--static", "--json"])).unwrap();
    let rest = &check["equilibrium"];
    let expected = [
        "converged",
        "t",
        "method",
        "iterations",
        "steps",
        "residual",
        "gap",
        "q",
        "lambda",
        "outputs",
        "stable",
        "stability",
        "free",
        "warnings",
    ];
    assert_eq!(keys(rest), expected);
    assert_eq!((&rest["converged"], &rest["stable"]), (&Value::from(true), &Value::from(true)));
    assert_eq!(keys(&rest["outputs"]), ["theta", "pin"]);
    assert!((rest["outputs"]["pin"].as_f64().unwrap() - 9.81).abs() < 1e-9);
    assert!((rest["q"]["rod.y"].as_f64().unwrap() + 0.5).abs() < 1e-12);
    assert!(rest["residual"].as_f64().unwrap() < 1e-9);
}

#[test]
fn a_time_may_be_given() {
    let pushed = PENDULUM.replace(r#""force": [0, 0]"#, r#""force": ["9.81*t", 0]"#);
    let place = Place::new(pushed);
    let args = ["check", "scene.json", "--static", "--json", "--at", "1"];
    let check: Value = serde_json::from_str(&place.done(&args)).unwrap();
    // Pushed as hard as pulled: half a right angle from hanging.
    let theta = check["equilibrium"]["outputs"]["theta"].as_f64().unwrap();
    assert!((theta + std::f64::consts::FRAC_PI_4).abs() < 1e-9, "{theta}");
    assert_eq!(check["equilibrium"]["t"], 1.0);
    assert_eq!(place.run(&["check", "scene.json", "--at", "1"]).status.code(), Some(2));
    assert_eq!(place.run(&["check", "scene.json", "--static", "--at", "inf"]).status.code(), Some(2));
}

#[test]
fn none_is_a_failed_run() {
    let place = Place::new(PENDULUM.replace(
        r#""joints": [ { "name": "A", "type": "revolute", "between": ["ground.O", "rod.A"] } ],"#,
        r#""joints": [ { "name": "A", "type": "equation", "expression": "rod.angle" } ],"#,
    ));
    let output = place.run(&["check", "scene.json", "--static", "--json"]);
    assert_eq!(output.status.code(), Some(1));
    let check: Value = serde_json::from_str(&out(&output)).unwrap();
    assert_eq!(check["equilibrium"]["converged"], false);
    let message = err(&output);
    assert!(message.contains("nothing holds `rod.y`") && message.contains("help: hold it"), "{message}");
    let text = out(&place.run(&["check", "scene.json", "--static"]));
    assert!(text.contains("no static equilibrium at t = 0 s"), "{text}");
}

#[test]
fn a_run_can_start_from_it() {
    let place = Place::new(PENDULUM);
    let run: Value = serde_json::from_str(&place.done(&["simulate", "scene.json", "--equilibrium", "--json"])).unwrap();
    let last = &run["final"];
    // Round-off of the rest position swings on.
    assert!((last["q"]["rod.y"].as_f64().unwrap() + 0.5).abs() < 1e-12, "{last}");
    assert!(last["v"].as_object().unwrap().values().all(|v| v.as_f64().unwrap().abs() < 1e-12), "{last}");
    assert!((last["outputs"]["pin"].as_f64().unwrap() - 9.81).abs() < 1e-9, "{last}");
    assert_eq!(run["warnings"], Value::Array(Vec::new()));
    let both = ["simulate", "scene.json", "--equilibrium", "--start", "out/pendulum/summary.json"];
    assert_eq!(place.run(&both).status.code(), Some(2));
    // Upright, Newton's method finds the nearest equilibrium at once.
    let upright = Place::new(
        PENDULUM.replace(r#""position": [0.5, 0], "angle": 0"#, r#""position": [0, 0.5], "angle": 1.5707963267948966"#),
    );
    let output = upright.run(&["drift", "scene.json", "--equilibrium", "--step", "0.05"]);
    assert_eq!(output.status.code(), Some(0));
    assert!(err(&output).contains("is unstable"), "{}", err(&output));
    let driven = Place::new(PENDULUM.replace(
        r#"{ "name": "A", "type": "revolute""#,
        r#"{ "name": "turn", "type": "driver", "between": ["ground.O", "rod"], "coordinate": "angle", "value": "2*t" },
           { "name": "A", "type": "revolute""#,
    ));
    let output = driven.run(&["simulate", "scene.json", "--equilibrium"]);
    assert_eq!(output.status.code(), Some(0), "{}", err(&output));
    assert!(err(&output).contains("drives move at the start"), "{}", err(&output));
}
