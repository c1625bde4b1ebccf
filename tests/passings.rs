//! Singular states that a motion passes: their times, what depends on what there, and whether the motion kept to its
//! branch.

use crate::common::{adaptive, fixed, stepwise};
use crate::scenes::{Ready, model, parse, shipped};
use holonom::analysis::{Recorder, Singularity, SingularityBranch, dependent_nearby};
use holonom::scene::generate::n_four_bar;
use holonom::simulate::{Method, Span, simulate};

const CASES: [&str; 2] = ["slider_crank_singular", "slider_crank_singular_2"];
/// First passages, from a computation with 30 digits. Case 1 swings about the folded position, so that all passages are
/// odd multiples of the first.
const FIRST: [f64; 2] = [0.759534549049470, 0.391732135357512];

/// What a run says of singular states, failed or not.
fn watched(ready: &Ready, method: &Method, end: f64) -> Singularity {
    let mut recorder = Recorder::new(ready.system());
    let span = Span { start: 0.0, end, output_step: 0.1 };
    simulate(ready.system(), method, span, ready.0.start(), &mut recorder).unwrap();
    recorder.finish().singularity
}

#[test]
fn times_of_passages() {
    // The motion is good to 1e-9 and better; the lines that meet there are straight to 1e-9.
    let fine = fixed("index1", "rk4", "manifold", 1e-3);
    // Long steps: the fifth-degree interpolation between them is what counts.
    let long = adaptive("index1", "dop853", "manifold", 1e-8);
    for (method, tolerance) in [(&fine, 2e-9), (&long, 1e-6)] {
        for (case, first) in CASES.into_iter().zip(FIRST) {
            let found = watched(&shipped(case, &[]), method, 10.0);
            assert_eq!(found.count, if case == CASES[0] { 7 } else { 11 }, "{case}");
            assert!((found.passed[0].t - first).abs() < tolerance, "{case}: {}", found.passed[0].t);
            for (k, passing) in found.passed.iter().enumerate() {
                assert!(passing.is_singular && passing.branch == SingularityBranch::Kept, "{case}: {passing:?}");
                assert_eq!((passing.rank, passing.regular_rank), (Some(4), 5), "{case}: {passing:?}");
                assert_eq!(passing.joints, ["bearing", "crank_pin", "slider"]);
                if case == CASES[0] {
                    let expected = (2 * k + 1) as f64 * first;
                    // Errors of the motion grow along it.
                    assert!((passing.t - expected).abs() < 10.0 * tolerance, "{k}: {} {expected}", passing.t);
                }
            }
            let nearest = found.nearest.unwrap();
            assert!(nearest.rank_indicator < 1e-5, "{nearest:?}");
        }
    }
}

/// However long the steps: each passage is seen once, and none of these motions leaves its branch.
#[test]
fn every_passage_is_counted_and_none_is_called_left() {
    let scenes = [
        (shipped(CASES[0], &[]), 10.0, 7),
        (shipped(CASES[1], &[]), 10.0, 11),
        (shipped("parallelogram", &[]), 5.0, 16),
        (parse(&n_four_bar(2).to_string()), 10.0, 10),
    ];
    for (scene, end, count) in &scenes {
        for tolerance in [1e-5, 1e-6, 3e-7, 1e-7, 3e-8, 1e-8, 1e-9, 1e-10] {
            for (integrator, projection) in [("dop853", "manifold"), ("dop853", "exact"), ("dopri5", "exact")] {
                let found = watched(scene, &stepwise("index1", integrator, projection, tolerance), *end);
                let what = format!("{count}: {integrator} {projection} at {tolerance:e}: {found:?}");
                assert!(found.count == *count && found.failure().is_none(), "{what}");
            }
        }
    }
}

/// Methods without factors of their own of the saddle-point matrix are followed as well.
#[test]
fn whatever_the_formulation() {
    let ready = shipped(CASES[0], &[]);
    for method in [
        fixed("augmented_lagrangian", "rk4", "manifold", 1e-3),
        fixed("augmented_lagrangian", "rk4", "none", 1e-3),
        fixed("index3", "ali3p", "none", 1e-3),
        fixed("index2", "hem5", "none", 1e-3),
        fixed("null_space", "rk4", "none", 1e-3),
    ] {
        let found = watched(&ready, &method, 10.0);
        let singular = found.passed.iter().filter(|passing| passing.is_singular).count();
        assert_eq!(singular, 7, "{:?}: {found:?}", method.integrator);
        // Null spaces may see one state before a passage as a near one of its own: g or w0 changed in the last digit
        // decides that.
        assert!(found.count == 7 || method.formulation.name == "null_space", "{:?}: {found:?}", method.integrator);
        assert!(found.left().is_none() && (found.passed[0].t - FIRST[0]).abs() < 1e-5, "{found:?}");
    }
}

/// Without stabilization every run leaves its branch, and says so; Baumgarte's, with the plain equations, does not.
#[test]
fn errors_that_turn_the_motion_are_told() {
    let plain = "baumgarte:alpha=6,beta=8.366600265340756,rank_tolerance=1e-10";
    for case in CASES {
        let ready = shipped(case, &[]);
        for method in [
            fixed("index1", "rk4", "none", 1e-3),
            fixed("index1", "rk4", "none", 2e-3),
            adaptive("index1", "dop853", "none", 1e-5),
            adaptive("index1", "dop853", "none", 1e-8),
            adaptive("index1", "dop853", "none", 1e-10),
            adaptive("index1", "dopri5", "none", 1e-7),
        ] {
            let found = watched(&ready, &method, 10.0);
            assert!(
                found.left().is_some(),
                "{case} {:?} {:?} {}: {found:?}",
                method.integrator,
                method.step,
                method.rtol
            );
        }
    }
    // Baumgarte's method meets the folds on placed steps with next to no drift.
    let found = watched(&shipped(CASES[1], &[]), &fixed(plain, "rk4", "none", 1e-3), 10.0);
    assert!(found.count == 11 && found.left().is_none(), "{found:?}");
}

#[test]
fn regular_motions_pass_none() {
    for (scene, end) in [("andrews", 0.03), ("robot_arm", 10.0), ("five_link_suspension", 2.5), ("bricard", 10.0)] {
        for projection in ["none", "manifold"] {
            let found = watched(&shipped(scene, &[]), &adaptive("index1", "dop853", projection, 1e-6), end);
            let rank_indicator = found.nearest.unwrap().rank_indicator;
            assert!(found.count == 0 && (1e-2..=1.0).contains(&rank_indicator), "{scene} {projection}: {found:?}");
        }
    }
    let free = watched(&shipped("quarter_car", &[]), &Method::default(), 1.0);
    assert_eq!(free, Singularity::default());
}

/// A rod longer than the crank by 1e-5: near the folded position the motion turns sharply, as the geometry makes
/// it, which is not an error.
#[test]
fn nearly_singular_geometry_is_no_error() {
    let text = std::fs::read_to_string(model(CASES[1])).unwrap();
    let mut scene: serde_json::Value = serde_json::from_str(&text).unwrap();
    let rod = scene["bodies"].as_array_mut().unwrap().iter_mut().find(|body| body["name"] == "rod").unwrap();
    rod["markers"]["slider"][0] = "1.00001*l".into();
    let found = watched(&parse(&scene.to_string()), &adaptive("index1", "dop853", "manifold", 1e-9), 3.0);
    assert!(found.count > 1, "{found:?}");
    for passing in &found.passed {
        assert!(!passing.is_singular && passing.branch == SingularityBranch::Kept, "{passing:?}");
        // The square of the rank indicator is 6 times the difference of the lengths, to first order in it.
        assert!((passing.rank_indicator / 6e-5_f64.sqrt() - 1.0).abs() < 1e-4, "{passing:?}");
    }
}

#[test]
fn a_singular_start_is_told_from_redundant_constraints() {
    let beside = |ready: &Ready| dependent_nearby(ready.system(), 0.0, ready.0.start().0).len();
    let half = std::f64::consts::FRAC_PI_2;
    assert_eq!(beside(&shipped(CASES[0], &[("phi0", half), ("w0", 1.0)])), 0, "folded");
    assert_eq!(beside(&shipped("parallelogram_redundant", &[])), 1, "redundant everywhere");
    assert_eq!(beside(&shipped("bricard", &[])), 1, "redundant on the constraints only");
    assert_eq!(beside(&shipped("andrews", &[])), 0);
}
