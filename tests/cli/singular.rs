//! Singular states, as a user meets them.

use super::{Place, err, out};
use serde_json::Value;

const CASES: [(&str, &str); 2] = [
    ("slider_crank_singular", include_str!("../../models/slider_crank_singular.json")),
    ("slider_crank_singular_2", include_str!("../../models/slider_crank_singular_2.json")),
];

#[test]
fn passages_are_named_with_their_times() {
    let place = Place::new(CASES[0].1);
    let text = place.done(&["simulate", "scene.json", "--figures", "none", "-o", "out"]);
    assert!(text.contains("passed singular states at t = 0.759534549, 2.278603647, "), "{text}");
    assert!(text.contains("(7 in all)") && text.contains("rank 4 there, 5 beside"), "{text}");
    let found = &place.json("out/summary.json")["singularity"];
    assert_eq!(found["count"], 7);
    assert_eq!(found["passed"][0]["branch"], "kept");
    assert!((found["passed"][0]["t"].as_f64().unwrap() - 0.759534549049470).abs() < 1e-8);
    assert_eq!(found["passed"][0]["joints"], serde_json::json!(["bearing", "crank_pin", "slider"]));
}

/// A motion that left its branch is a failure, which names the state; the rows are kept, and no number in a file is none.
#[test]
fn a_motion_that_leaves_its_branch_is_told() {
    let plain = ["--projection", "none", "--step", "0.001"];
    for case in [0, 1] {
        let place = Place::new(CASES[case].1);
        let shared = ["simulate", "scene.json", "--figures", "none", "-o", "out", "--formulation", "index1"];
        let output = place.run(&[&shared[..], &plain].concat());
        assert_eq!(output.status.code(), Some(1), "{case}: {}", err(&output));
        assert!(err(&output).contains("the velocity jumped"), "{}", err(&output));
        assert!(err(&output).contains("come apart"), "{}", err(&output));
        let summary = place.json("out/summary.json");
        assert_eq!(summary["status"], "failed");
        let failure = &summary["failure"];
        let passed = summary["singularity"]["passed"].as_array().unwrap();
        let left = passed.iter().find(|passing| passing["branch"] == "left").unwrap();
        assert_eq!(failure["t"], left["t"]);
        assert!(failure["reason"].as_str().unwrap().contains("bearing, crank_pin, slider"), "{failure}");
        let quiet = place.run(&[&shared[..], &plain, &["--quiet", "--json"]].concat());
        assert_eq!(quiet.status.code(), Some(1));
        assert!(err(&quiet).contains("the velocity jumped"), "{}", err(&quiet));
        for file in ["trajectory.csv", "drift.csv", "energy.csv"] {
            let text = place.text(&format!("out/{file}"));
            let numbers = text.lines().skip(1).flat_map(|line| line.split(','));
            numbers.for_each(|cell| assert!(cell.parse::<f64>().is_ok_and(f64::is_finite), "{file}: {cell}"));
        }
    }
}

#[test]
fn check_tells_a_singular_start() {
    let place = Place::new(CASES[0].1);
    let folded = ["check", "scene.json", "--set", "phi0=1.5707963267948966", "--set", "w0=1"];
    let text = place.done(&folded);
    assert!(text.contains("the start is a singular state: rank 4 here, 5 beside it"), "{text}");
    assert!(text.contains("joint `slider`, row y: follows from bearing, crank_pin"), "{text}");
    let json: Value = serde_json::from_str(&out(&place.run(&[&folded[..], &["--json"]].concat()))).unwrap();
    assert_eq!((&json["rank"], &json["rank_beside"]), (&4.into(), &5.into()));
    let redundant = Place::new(super::parallelogram());
    let text = redundant.done(&["check", "scene.json"]);
    assert!(text.contains("redundant constraints") && !text.contains("singular state:"), "{text}");
}

/// At rest at a change point with unlike links, which no motion leaves.
#[test]
fn check_tells_that_no_simulation_begins() {
    let text = include_str!("../../models/parallelogram.json").replace("\"rate0\": 12", "\"rate0\": 0");
    let (first, second) = text.split_once("\"link2\"").unwrap();
    let unlike = format!("{first}\"link2\"{}", second.replacen("\"m_link\"", "\"3*m_link\"", 1));
    let refused = |scene: &str, level: &str| {
        let place = Place::new(scene);
        let args = ["scene.json", "--set", level];
        let began =
            place.run(&[&["simulate", "--until", "0.1", "--figures", "none"], &args[..]].concat()).status.success();
        let told = place.done(&[&["check"], &args[..]].concat()).contains("no simulation begins there");
        assert_eq!(told, !began);
        told
    };
    assert!(refused(&unlike, "angle0=pi/2") && !refused(&unlike, "angle0=1") && !refused(&text, "angle0=pi/2"));
}

#[test]
fn drift_tells_which_methods_leave_the_branch() {
    let place = Place::new(CASES[0].1);
    let text = place.done(&["drift", "scene.json", "--figures", "none"]);
    let told =
        |method: &str| text.lines().any(|line| line.trim_start().starts_with(&format!("{method} left its branch")));
    assert!(told("index1") && !told("manifold") && !told("exact"), "{text}");
}

/// Perturbations are carried over a singular state as the motion is.
#[test]
fn perturbations_pass_a_singular_state() {
    let place = Place::new(CASES[0].1);
    for command in [&["validate", "--at", "0"][..], &["transition", "--lyapunov", "2"]] {
        place.done(&[command, &["scene.json", "--figures", "none", "-o", "out"]].concat());
    }
}
