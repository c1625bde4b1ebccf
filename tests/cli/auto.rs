//! `--method auto`: what it chooses, why, and that it runs.

use super::*;

/// A mass on a rail carries another on a spring of its own.
fn pair(stiffness: &str, damping: &str, stretch: f64) -> String {
    format!(
        r#"{{ "name": "pair", "dimension": 2, "ground": {{ "markers": {{ "O": [0, 0] }} }},
            "bodies": [
              {{ "name": "slow", "type": "point_mass", "mass": 1, "initial": {{ "position": [1.5, 0] }} }},
              {{ "name": "fast", "type": "point_mass", "mass": 1e-3, "initial": {{ "position": [{}, 0] }} }} ],
            "joints": [ {{ "name": "rail", "type": "equation", "expression": "slow.y" }},
                        {{ "name": "other", "type": "equation", "expression": "fast.y" }} ],
            "forces": [
              {{ "name": "soft", "type": "spring_damper", "between": ["ground.O", "slow"], "stiffness": 1,
                 "free_length": 1 }},
              {{ "name": "hard", "type": "spring_damper", "between": ["slow", "fast"], "stiffness": {stiffness},
                 "damping": {damping}, "free_length": 1 }} ],
            "outputs": [ {{ "name": "x", "measure": "position", "of": "slow" }} ],
            "simulation": {{ "t_end": 10, "method": "auto" }} }}"#,
        2.5 + stretch
    )
}

/// Simulates and returns the three names, the reason and the last x.
fn chosen(scene: &str, args: &[&str]) -> (String, String, Value) {
    let place = Place::new(scene);
    let printed = place.done(&[&["simulate", "scene.json", "--json", "--figures", "none"], args].concat());
    let summary: Value = serde_json::from_str(&printed).unwrap();
    let method = &summary["method"];
    let name = |key: &str| method[key].as_str().unwrap_or_default();
    let names = format!("{} {} {}", name("formulation"), name("integrator"), name("projection"));
    (names, name("chosen_because").to_string(), summary["final"]["outputs"]["x"].clone())
}

/// Where the slow mass is at 10 s while the pair moves as one.
fn close(x: &Value) -> bool {
    (x.as_f64().unwrap() - (1.0 + 0.5 * ((1.0 / 1.001f64).sqrt() * 10.0).cos())).abs() < 1e-5
}

#[test]
fn calm_motions_get_an_explicit_method() {
    for (rtol, expected) in [("1e-9", "index1 adams manifold"), ("1e-4", "index1 dop853 manifold")] {
        let (names, because, _) = chosen(PENDULUM, &["--method", "auto", "--rtol", rtol]);
        assert_eq!(names, expected);
        assert!(because.starts_with("not stiff"), "{because}");
    }
}

#[test]
fn fast_decay_gets_an_implicit_one() {
    let (names, because, x) = chosen(&pair("1e6", "1e3", 0.0), &[]);
    assert_eq!(names, "ggl radau_iia none");
    assert!(because.starts_with("stiff. At t = ") && because.contains("decays at 1e6 1/s"), "{because}");
    assert!(because.contains("tried there, radau_iia advances "), "{because}");
    assert!(close(&x), "{x}");
}

/// What is at rest is stepped over; what swings and is asked for is resolved, and the text says what would filter it.
#[test]
fn fast_oscillations_are_stepped_over_or_resolved() {
    let (names, because, x) = chosen(&pair("1e8", "0", 0.0), &[]);
    assert_eq!(names, "ggl radau_iia none");
    assert!(because.starts_with("stiff. ") && because.contains("swings at 320000 rad/s"), "{because}");
    assert!(close(&x), "{x}");
    let (names, because, _) = chosen(&pair("1e8", "0", 1e-3), &["--until", "0.1"]);
    assert_eq!(names, "index1 adams manifold");
    assert!(because.contains("not stiff"), "{because}");
}

#[test]
fn redundant_rows_get_what_solves_them() {
    let beam = parallelogram();
    assert_eq!(chosen(&beam, &["--method", "auto"]).0, "index1 adams manifold");
    let damper = r#""forces": [ { "name": "hinge", "type": "torsion_spring", "between": ["ground.P0", "link0.top"],
                     "stiffness": 0, "damping": 1e5 } ], "simulation""#;
    let (names, because, _) = chosen(&beam.replace("\"simulation\"", damper), &["--method", "auto"]);
    assert_eq!(names, "ggl radau_iia none");
    assert!(because.starts_with("stiff. "), "{because}");
}

#[test]
fn too_many_coordinates_for_all_modes_leave_the_fastest() {
    let place = Place::new("");
    place.done(&["generate", "chain", "--n", "150", "-o", "scene.json"]);
    let text = place.text("scene.json");
    let (names, because, _) = chosen(&text, &["--method", "auto", "--until", "0.01", "--output-step", "0.01"]);
    assert!(names.starts_with("index1 adams") && because.starts_with("not stiff"), "{names}: {because}");
}

#[test]
fn the_reason_is_printed_and_only_where_auto_chose() {
    let place = Place::new(PENDULUM);
    let text = place.done(&["simulate", "scene.json", "--method", "auto"]);
    assert!(
        text.starts_with("pendulum: index1 + adams + manifold, rtol 1e-8, atol 1e-10\n  auto: not stiff"),
        "{text}"
    );
    assert!(!place.done(&["simulate", "scene.json"]).contains("auto:"));
}

#[test]
fn a_named_integrator_goes_before_the_scenes_auto() {
    let (names, because, _) = chosen(&pair("1", "0", 0.0), &["--integrator", "dopri5"]);
    assert_eq!((names.as_str(), because.as_str()), ("index1 dopri5 manifold", ""));
}

#[test]
fn drift_compares_what_the_choice_goes_with() {
    let place = Place::new(PENDULUM);
    let text = place.done(&["drift", "scene.json", "--method", "auto", "--figures", "none"]);
    assert!(text.starts_with("pendulum: drift with adams") && text.contains("auto: not stiff"), "{text}");
    let stiff = Place::new(pair("1e6", "1e3", 0.0)).done(&["drift", "scene.json", "--figures", "none"]);
    assert!(stiff.contains("drift with radau_iia") && stiff.lines().any(|row| row.starts_with("  ggl ")), "{stiff}");
}

/// The state that is linearized is that of the automatic run, which goes where no step of dop853 would come to in time.
#[test]
fn linearize_follows_the_automatic_run() {
    let place = Place::new(pair("1e12", "1e9", 0.0));
    let text = place.done(&["linearize", "scene.json", "--at", "10"]);
    assert!(text.starts_with("pair at t = 10 s: linear model"), "{text}");
}
