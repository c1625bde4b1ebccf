//! Outputs in the unit that the scene asks for.

use super::*;

/// A level bar that a motor holds at its end, with everything in two units.
const HELD: &str = r#"{
  "name": "held", "dimension": 2, "gravity": [0, -10],
  "ground": { "markers": { "O": [0, 0] } },
  "bodies": [ { "name": "bar", "type": "rigid", "mass": 2, "inertia": 1, "markers": { "O": [-0.5, 0] },
    "initial": { "position": [0.5, 0] } } ],
  "joints": [ { "name": "pin", "type": "revolute", "between": ["ground.O", "bar.O"] },
    { "name": "motor", "type": "driver", "between": ["ground.O", "bar.O"], "coordinate": "angle", "value": "VALUE" } ],
  "forces": [ { "name": "spring", "type": "torsion_spring", "between": ["ground.O", "bar.O"], "stiffness": 3, "free_angle": 0 },
    { "name": "push", "type": "applied_torque", "at": "bar", "torque": 0 } ],
  "outputs": [ { "name": "motor", "measure": "reaction", "of": "motor" },
    { "name": "motor_small", "measure": "reaction", "of": "motor", "unit": "N mm" },
    { "name": "angle", "measure": "angle", "of": "bar" },
    { "name": "degrees", "measure": "angle", "of": "bar", "unit": "deg" },
    { "name": "rate", "measure": "angular_velocity", "of": "bar", "unit": "rpm" },
    { "name": "spring", "measure": "force", "of": "spring" }, { "name": "push", "measure": "force", "of": "push" },
    { "name": "load", "measure": "reaction", "of": "pin", "component": "y", "unit": "kN" } ],
  "simulation": { "t_end": 0.5, "output_step": 0.1 } }"#;

#[test]
fn columns_and_summary_are_converted() {
    let place = Place::new(HELD.replace("VALUE", "2*t"));
    let text = place.done(&["simulate", "scene.json", "-o", "here"]);
    let json = place.json("here/summary.json");
    let value = |name: &str| json["final"]["outputs"][name].as_f64().unwrap();
    // At a steady rate the motor holds the weight's moment and the spring.
    let expected = 2.0 * 10.0 * 0.5 * 1f64.cos() + 3.0 * 1.0;
    assert!((value("motor") - expected).abs() < 1e-6, "{}", value("motor"));
    assert!((value("motor_small") - 1e3 * value("motor")).abs() < 1e-9);
    assert!((value("angle") - 1.0).abs() < 1e-9 && (value("degrees") - 1f64.to_degrees()).abs() < 1e-6);
    assert!((value("rate") - 60.0 / std::f64::consts::PI).abs() < 1e-6);
    for line in ["motor ", "spring ", "push "] {
        let row = text.lines().find(|row| row.trim_start().starts_with(line)).unwrap();
        assert!(row.ends_with("N m"), "{row}");
    }
    let table = place.text("here/trajectory.csv");
    let last: Vec<&str> = table.lines().last().unwrap().split(',').collect();
    let column = table.lines().next().unwrap().split(',').position(|heading| heading == "degrees").unwrap();
    assert_eq!(last[column].parse::<f64>().unwrap(), value("degrees"));
    assert!(place.text("here/outputs.svg").contains("angle (deg)") || place.text("here/outputs.svg").contains("(deg)"));
}

#[test]
fn linear_models_are_converted() {
    let place = Place::new(PENDULUM.replace(
        r#"{ "name": "pin","#,
        r#"{ "name": "degrees", "measure": "angle", "of": "rod", "unit": "deg" },
    { "name": "kilo", "measure": "reaction", "of": "A", "unit": "kN" }, { "name": "pin","#,
    ));
    place.done(&["linearize", "scene.json", "-o", "here"]);
    let json = place.json("here/linear-0.json");
    let row = |i: usize| json["C"][i].as_array().unwrap().iter().map(|x| x.as_f64().unwrap()).collect::<Vec<f64>>();
    let close = |a: f64, b: f64| (a - b).abs() <= 1e-12 * b.abs();
    assert!(row(1).iter().zip(row(0)).all(|(deg, rad)| close(*deg, rad.to_degrees())) && row(0)[0] != 0.0);
    assert!(row(2).iter().zip(row(3)).all(|(kilo, newton)| close(*kilo, 1e-3 * newton)));
}

#[test]
fn units_of_something_else_are_refused() {
    let table = [
        ("deg", "kN", "`kN` is a unit of force, not of angle\n  help: choose one of rad, mrad, deg, arcmin, rev"),
        ("deg", "degs", "there is no unit `degs` of angle\n  help: did you mean `deg`? choose one of"),
        ("N mm", "N", "`N` is a unit of force, not of torque"),
        ("rpm", "rad", "`rad` is a unit of angle, not of angular velocity"),
    ];
    for (unit, wrong, message) in table {
        let scene =
            HELD.replace("VALUE", "0").replace(&format!("\"unit\": \"{unit}\""), &format!("\"unit\": \"{wrong}\""));
        let output = Place::new(scene).run(&["check", "scene.json"]);
        assert_eq!(output.status.code(), Some(2), "{}", err(&output));
        assert!(err(&output).contains(message) && err(&output).contains(".unit"), "{}", err(&output));
    }
}

/// An expression is in SI units and shown in the unit that is named; a word that is no unit names the axis.
#[test]
fn expressions_are_converted_to_units_that_are_known() {
    let scene = PENDULUM.replace(
        r#"{ "name": "pin","#,
        r#"{ "name": "double", "measure": "expression", "value": "2*theta", "unit": "deg" },
    { "name": "half", "measure": "expression", "value": "double/4" },
    { "name": "score", "measure": "expression", "value": "2*theta", "unit": "points" }, { "name": "pin","#,
    );
    let place = Place::new(scene.replace(r#""t_end""#, r#""reference": "table.csv", "t_end""#));
    place.done(&["simulate", "scene.json", "-o", "here"]);
    let json = place.json("here/summary.json");
    let value = |name: &str| json["final"]["outputs"][name].as_f64().unwrap();
    let close = |a: f64, b: f64| (a - b).abs() <= 1e-12 * b.abs();
    assert!(close(value("double"), 2.0 * value("theta").to_degrees()), "{}", value("double"));
    assert!(close(value("half"), 0.5 * value("theta")), "others read it in SI units: {}", value("half"));
    assert_eq!(value("score"), 2.0 * value("theta"));
    assert_eq!([&json["outputs"]["double"]["unit"], &json["outputs"]["score"]["unit"]], ["deg", "points"]);
    place.done(&["linearize", "scene.json", "-o", "here"]);
    let json = place.json("here/linear-0.json");
    let first = |i: usize| json["C"][i].as_array().unwrap().iter().map(|x| x.as_f64().unwrap()).sum::<f64>();
    assert!(first(0) != 0.0 && close(first(1), 2.0 * first(0).to_degrees()), "{}", json["C"]);
    assert!(close(first(2), 0.5 * first(0)) && close(first(3), 2.0 * first(0)), "{}", json["C"]);
    // A reference table is in the units of the outputs: with the row above as its end, there is no error.
    fs::write(place.path("table.csv"), format!("t,double\n1,{}\n", value("double"))).unwrap();
    let methods = ["--formulation", "index1", "--integrator", "dop853", "--outputs", "double", "--budget", "2s"];
    place.done(&[&["tradeoff", "scene.json", "-o", "trade", "--figures", "none"], &methods[..]].concat());
    let reference = place.json("trade/tradeoff.json")["reference"].clone();
    assert!(reference["error"].as_f64().unwrap() < 1e-6, "{}", reference["error"]);
}
