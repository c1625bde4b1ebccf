use super::*;

const METHODS: [&str; 10] = [
    "index1",
    "baumgarte",
    "baumgarte:alpha",
    "invariant_manifold",
    "position",
    "velocity",
    "manifold",
    "manifold:sweeps=2",
    "full",
    "exact",
];

fn runs(json: &str) -> Vec<Value> {
    serde_json::from_str::<Value>(json).unwrap()["runs"].as_array().unwrap().clone()
}

#[test]
fn every_stabilization_has_a_row() {
    let place = Place::new(PENDULUM);
    let text = place.done(&["drift", "scene.json", "-o", "here"]);
    assert!(text.starts_with("pendulum: drift with dop853, rtol 1e-8, atol 1e-10\n"), "{text}");
    let rows: Vec<&str> = text.lines().skip(3).take_while(|line| !line.is_empty()).map(str::trim).collect();
    assert_eq!(rows.len(), METHODS.len(), "{text}");
    rows.iter().zip(METHODS).for_each(|(row, method)| assert!(row.starts_with(method), "{row}"));
    assert_eq!(place.files("here"), ["stabilizations.csv", "stabilizations.json", "stabilizations.svg"]);
}

#[test]
fn json_and_table_agree() {
    let place = Place::new(PENDULUM);
    let printed = place.done(&["drift", "scene.json", "-o", "here", "--json", "--figures", "png"]);
    assert_eq!(printed, place.text("here/stabilizations.json"));
    let rows = runs(&printed);
    let header = place.text("here/stabilizations.csv").lines().next().unwrap().to_string();
    assert!(header.starts_with("t,position index1,velocity index1,position baumgarte,"), "{header}");
    assert_eq!(rows.len(), METHODS.len());
    for row in &rows {
        assert_eq!((&row["status"], &row["failure"]), (&"completed".into(), &Value::Null));
        assert!(header.contains(row["method"].as_str().unwrap()));
    }
    let drift = |i: usize| rows[i]["drift"]["position"]["max"].as_f64().unwrap();
    assert!(drift(0) > 1e-10 && drift(9) < 1e-14, "index1 {} exact {}", drift(0), drift(9));
    assert!(fs::read(place.path("here/stabilizations.png")).unwrap().starts_with(b"\x89PNG"));
}

#[test]
fn runs_that_all_fail_are_a_failure() {
    let place = Place::new(PENDULUM.replace(r#""force": [0, 0]"#, r#""force": ["sqrt(0.5 - t)", 0]"#));
    let output = place.run(&["drift", "scene.json", "-o", "here", "--figures", "none"]);
    assert_eq!(output.status.code(), Some(1));
    assert!(out(&output).contains("index1 FAILED at t = ") && err(&output).starts_with("error: stopped at t = "));
    assert_eq!(place.files("here"), ["stabilizations.csv", "stabilizations.json"]);
    let rows = runs(&place.text("here/stabilizations.json"));
    assert!(rows.iter().all(|row| row["status"] == "failed"));
}

/// Implicit methods go with other equations: these are compared.
#[test]
fn every_integrator_is_compared_on_what_it_goes_with() {
    let place = Place::new(PENDULUM);
    let rows = |more: &[&str]| -> Vec<String> {
        let args =
            [&["drift", "scene.json", "--until", "0.1", "--json", "--figures", "none", "-o", "here"], more].concat();
        let rows = runs(&place.done(&args));
        rows.iter().map(|row| row["method"].as_str().unwrap().to_string()).collect()
    };
    let implicit = rows(&["--integrator", "radau_iia"]);
    assert!(
        ["index1", "baumgarte", "manifold", "index2", "index3", "ggl", "stabilized_index1"]
            .iter()
            .all(|name| implicit.iter().any(|row| row == name)),
        "{implicit:?}"
    );
    assert!(implicit.iter().all(|row| !row.starts_with("invariant_manifold")), "{implicit:?}");
    assert_eq!(rows(&["--integrator", "generalized_alpha", "--step", "0.01"])[0], "index3");
}

/// One of what is compared would be replaced by all of them.
#[test]
fn a_formulation_or_projection_is_refused() {
    let place = Place::new(PENDULUM);
    for (option, value) in [("--formulation", "baumgarte"), ("--projection", "manifold")] {
        let output = place.run(&["drift", "scene.json", option, value, "-o", "here"]);
        assert_eq!(output.status.code(), Some(2));
        assert!(err(&output).contains(option) && err(&output).contains("`drift` compares every"), "{}", err(&output));
        assert!(!place.path("here").exists());
    }
}
