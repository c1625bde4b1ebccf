//! Messages and columns as a user reads them.

use super::*;

#[test]
fn other_formats_are_named() {
    let table = [
        ("name: pendulum\ndimension: 2\n", "this is YAML, not JSON"),
        ("---\n- a\n", "this is YAML, not JSON"),
        ("<?xml version=\"1.0\"?>\n<robot/>", "this is XML, not JSON"),
        ("# scene\nname = \"x\"\n", "this is TOML, not JSON"),
        ("[scene]\nname = \"x\"\n", "this is TOML, not JSON"),
        ("{ \"name\": nope }", "text without quotes"),
    ];
    for (text, message) in table {
        let output = Place::new(text).run(&["check", "scene.json"]);
        let said = err(&output);
        assert!(output.status.code() == Some(2) && said.contains(message) && said.contains("help:"), "{text}: {said}");
        assert!(!said.contains("ident"), "{said}");
    }
}

#[test]
fn a_rate_that_cannot_stand_somewhere_is_told() {
    let rate = r#""joints": [ { "name": "roll", "type": "equation", "expression": "rod.x' - rod.angle'" },"#;
    let output = Place::new(PENDULUM.replace(r#""joints": ["#, rate)).run(&["check", "scene.json"]);
    assert!(err(&output).contains("help: a rate of this order cannot stand here; `rod.x` can"), "{}", err(&output));
}

#[test]
fn parameters_are_set_by_expressions() {
    let place = Place::new(
        PENDULUM
            .replace(r#""gravity""#, r#""parameters": { "m": 2, "k": 1 }, "gravity""#)
            .replace(r#""outputs": ["#, r#""outputs": [ { "name": "shown", "measure": "expression", "value": "k" },"#),
    );
    place.done(&["simulate", "scene.json", "--set", "k=pi/2*m", "--until", "1/4", "-o", "here"]);
    let json = place.json("here/summary.json");
    assert_eq!(json["final"]["outputs"]["shown"].as_f64(), Some(std::f64::consts::PI));
    assert_eq!(json["t_end"].as_f64(), Some(0.25));
    let output = place.run(&["check", "scene.json", "--set", "k=k/2"]);
    assert!(output.status.code() == Some(2) && err(&output).starts_with("error: at --set (`k`): "), "{}", err(&output));
}

#[test]
fn a_parameter_and_an_output_of_one_name_have_a_column_each() {
    let place = Place::new(
        PENDULUM
            .replace(r#""gravity""#, r#""parameters": { "theta": 0.1 }, "gravity""#)
            .replace(r#""angle": 0 }"#, r#""angle": "theta" }"#),
    );
    place.done(&["kinematics", "scene.json", "theta=0..1:3", "-o", "here"]);
    let table = place.text("here/kinematics.csv");
    let headings: Vec<&str> = table.lines().next().unwrap().split(',').collect();
    assert_eq!(headings[0], "parameters.theta");
    assert_eq!(headings.iter().filter(|heading| **heading == "theta").count(), 1, "{headings:?}");
}
