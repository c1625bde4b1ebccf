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
    for rtol in ["1e-9", "1e-4"] {
        let (names, because, _) = chosen(PENDULUM, &["--method", "auto", "--rtol", rtol]);
        assert_eq!(names, "index1 dop853 manifold");
        assert!(because.starts_with("not stiff: "), "{because}");
    }
}

#[test]
fn fast_decay_gets_an_implicit_one() {
    let (names, because, x) = chosen(&pair("1e6", "1e3", 0.0), &[]);
    assert_eq!(names, "ggl radau_iia none");
    assert!(because.starts_with("stiff. At t = ") && because.contains("decays at 1e6 1/s"), "{because}");
    assert!(because.contains("tried there, radau_iia comes "), "{because}");
    assert!(close(&x), "{x}");
}

#[test]
fn damping_that_an_explicit_method_follows_cheaply_gets_an_explicit_one() {
    let (names, because, x) = chosen(&pair("1", "0.1", 0.0), &[]);
    assert_eq!(names, "index1 dop853 manifold");
    assert!(because.contains("not stiff"), "{because}");
    assert!((x.as_f64().unwrap() - 0.58).abs() < 0.1, "{x}");
}

/// What is at rest is stepped over; what swings and is asked for is resolved, and the text says what would filter it.
#[test]
fn fast_oscillations_are_stepped_over_or_resolved() {
    let (names, because, x) = chosen(&pair("1e8", "0", 0.0), &[]);
    assert_eq!(names, "ggl radau_iia none");
    assert!(because.starts_with("stiff. ") && because.contains("swings at 320000 rad/s"), "{because}");
    assert!(close(&x), "{x}");
    let (names, because, _) = chosen(&pair("1e8", "0", 1e-3), &["--until", "0.1"]);
    assert_eq!(names, "index1 dop853 manifold");
    assert!(because.starts_with("fast, not stiff. ") && because.contains("generalized_alpha"), "{because}");
}

/// The flyball governor: its dampers turn with it, which costs Newton's iteration what stiffness costs an explicit method.
#[test]
fn stiff_directions_that_turn_are_counted() {
    let text = fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join("models/flyball_governor.json")).unwrap();
    let (names, because, _) = chosen(&text, &["--method", "auto", "--until", "1", "--set", "damping=2e4"]);
    assert_eq!(names, "index1 dop853 manifold");
    assert!(because.starts_with("fast, not stiff. "), "{because}");
    assert_eq!(chosen(&text, &["--method", "auto", "--until", "1"]).0, "ggl radau_iia none");
}

#[test]
fn redundant_rows_get_what_solves_them() {
    let beam = parallelogram();
    assert_eq!(chosen(&beam, &["--method", "auto"]).0, "index1 dop853 manifold");
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
    assert!(names.starts_with("index1 dop") && because.starts_with("not stiff: "), "{names}: {because}");
}

#[test]
fn the_reason_is_printed_and_only_where_auto_chose() {
    let place = Place::new(PENDULUM);
    let text = place.done(&["simulate", "scene.json", "--method", "auto"]);
    assert!(
        text.starts_with("pendulum: index1 + dop853 + manifold, rtol 1e-8, atol 1e-10\n  auto: not stiff:"),
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
    assert!(text.starts_with("pendulum: drift with dop853") && text.contains("auto: not stiff"), "{text}");
    let stiff = Place::new(pair("1e6", "1e3", 0.0)).done(&["drift", "scene.json", "--figures", "none"]);
    assert!(stiff.contains("drift with radau_iia") && stiff.lines().any(|row| row.starts_with("  ggl ")), "{stiff}");
}

/// A mass on a strong spring lies still until something passes by: what was stepped over asks for its steps from then on,
/// and the other way round once a damper has taken the motion away.
#[test]
fn the_method_changes_where_the_motion_does() {
    let place = Place::new(&pair("1e6", "if(t < 5, 0, 100)", 1e-2));
    let printed = place.done(&["simulate", "scene.json", "--json", "--figures", "none", "--rtol", "1e-6"]);
    let summary: Value = serde_json::from_str(&printed).unwrap();
    let legs = summary["method"]["legs"].as_array().unwrap();
    let names: Vec<&str> = legs.iter().map(|leg| leg["integrator"].as_str().unwrap()).collect();
    assert_eq!(names, ["dop853", "radau_iia"], "{legs:?}");
    assert!(legs[1]["from"].as_f64().unwrap() > 5.0, "{legs:?}");
    assert!(summary["energy"]["relative_max_error"].as_f64().unwrap() < 1e-4, "{}", summary["energy"]);
    // Rows go on through the change, each once.
    let rows = place.text("out/pair/trajectory.csv");
    let times: Vec<f64> = rows.lines().skip(1).map(|row| row.split(',').next().unwrap().parse().unwrap()).collect();
    assert_eq!(times.len(), 501);
    assert!(times.iter().enumerate().all(|(i, t)| (t - 0.02 * i as f64).abs() < 1e-9), "{times:?}");
    let text = place.done(&["simulate", "scene.json", "--figures", "none", "--rtol", "1e-6", "-o", "again"]);
    assert!(text.contains("s on by ggl + radau_iia. stiff. At t = "), "{text}");
}
