//! What has no linear model, or no such one, and what the message says.

use crate::linearize::models::{at, request};
use crate::scenes::shipped;
use holonom::linearize::{Chart, Variation};
use std::f64::consts::FRAC_PI_2;

fn message(label: &str, method: &str, chart: Option<&str>) -> String {
    at(label, |variation, _| {
        let error = variation.linearize(&request(method, chart.map(Chart::parse))).unwrap_err();
        assert_eq!(error.exit_code(), 2, "{error}");
        error.to_string()
    })
}

fn says(found: &str, words: &[&str]) {
    words.iter().for_each(|word| assert!(found.contains(word), "`{word}` is not in: {found}"));
}

#[test]
fn unknown_names() {
    says(&message("four_bar_S1", "mcss", None), &["mcss", "mcs"]);
    says(&message("four_bar_S1", "baumgart", None), &["baumgarte"]);
    says(&message("four_bar_S1", "baumgarte:alfa=3", None), &["alfa", "alpha"]);
    says(&message("four_bar_S1", "mcs:form=index3", None), &["form", "takes no options"]);
    says(&message("four_bar_S1", "rcs:form=index4", None), &["index4", "index3, index1, index2, ggl"]);
    says(&message("four_bar_S1", "rcs:solver=svd", None), &["svd", "null_space, gsvd, qz"]);
    says(&message("four_bar_S1", "penalty:kind=soft", None), &["soft", "inertial, elastic"]);
    says(&message("four_bar_S1", "baumgarte:projected=maybe", None), &["maybe", "no, yes"]);
    says(&message("four_bar_S1", "mcs", Some("q9")), &["q9", "q1"]);
}

#[test]
fn unusable_numbers() {
    says(&message("four_bar_S1", "baumgarte:alpha=-1", None), &["alpha", "-1", "negative"]);
    says(&message("four_bar_S1", "baumgarte:alpha=big", None), &["alpha", "big", "number"]);
    says(&message("four_bar_S1", "penalty:penalty=0", None), &["penalty", "above zero"]);
    says(&message("four_bar_S1", "augmented_lagrangian:iterations=2.5", None), &["iterations", "2.5", "whole"]);
}

/// At S1 both rods AC and DB stand upright: C and D move along x only.
#[test]
fn coordinates_that_cannot_be_chosen() {
    says(&message("four_bar_S1", "mcs", Some("q2")), &["q2", "not independent", "independent here are: q"]);
    says(
        &message("four_bar_S1", "mcs", Some("q1,q3")),
        &["2 coordinates", "1 degrees of freedom", "independent here are: q"],
    );
    says(&message("double_pendulum_N1", "mcs", Some("q2")), &["1 coordinates", "2 degrees of freedom"]);
    says(&message("double_pendulum_N1", "mcs", Some("q1,q1")), &["not independent"]);
    says(&message("four_bar_S1", "baumgarte:projected=yes", Some("q4")), &["not independent"]);
}

/// Folded, crank and rod can turn together or against each other: with both directions the model would have four
/// eigenvalues that belong to no motion. A millionth of a radian beside it one is left, known to 1e-4 only.
#[test]
fn singular_states() {
    let near = "nearly dependent";
    for (phi0, problem) in
        [(FRAC_PI_2, "only 4 constraints"), (FRAC_PI_2 + 1e-6, near), (3.0 * FRAC_PI_2, "5 beside it")]
    {
        for w0 in [0.0, 2.0] {
            let scene = shipped("slider_crank_singular", &[("phi0", phi0), ("w0", w0)]);
            let (q, v) = scene.0.start();
            let error = Variation::new(scene.system(), 0.0, q, v).err().expect("singular");
            says(&error.to_string(), &["singular state", "t = 0 s", problem]);
        }
    }
    let flat = shipped("four_bar_spring", &[("p0", 0.0), ("w0", 0.0)]);
    let (q, v) = flat.0.start();
    let error = Variation::new(flat.system(), 0.0, q, v).err().expect("singular");
    says(&error.to_string(), &["singular state"]);
}

/// Dependent everywhere is not singular.
#[test]
fn redundant_constraints_are_no_obstacle() {
    for name in ["parallelogram_redundant", "bricard", "slider_crank_singular"] {
        let scene = shipped(name, &[]);
        let (q, v) = scene.0.start();
        Variation::new(scene.system(), 0.0, q, v).unwrap_or_else(|error| panic!("{name}: {error}"));
    }
}

/// Near the fold, but not as near, the equation of the crank angle: I(p) p'' + I'(p) p'^2 / 2 + g cos p = 0 with
/// I = 5/12 + 2 sin(p)^2 + 1/4.
#[test]
fn beside_a_singular_state() {
    for (beside, rate) in [(1e-3, 0.0), (1e-3, 2.0), (0.1, 2.0)] {
        let p = FRAC_PI_2 + beside;
        let scene = shipped("slider_crank_singular", &[("phi0", p), ("w0", rate)]);
        let (q, v) = scene.0.start();
        let mut variation = Variation::new(scene.system(), 0.0, q, v).unwrap();
        let found = variation.linearize(&request("mcs", Some(Chart::parse("crank.angle")))).unwrap();
        let (sin, cos) = p.sin_cos();
        let inertia = 5.0 / 12.0 + 0.25 + 2.0 * sin * sin;
        let acceleration = -(2.0 * sin * cos * rate * rate + 9.81 * cos) / inertia;
        // d/dp of I p'' + 2 sin cos p'^2 + g cos, and of p'.
        let stiffness = 4.0 * sin * cos * acceleration + 2.0 * (cos * cos - sin * sin) * rate * rate - 9.81 * sin;
        let known = [-stiffness / inertia, -4.0 * sin * cos * rate / inertia];
        let off = [found.a[(1, 0)] - known[0], found.a[(1, 1)] - known[1]];
        // Rounding, of the state as well, over the square of the rank indicator, 2.6 times the angle.
        assert!(off.iter().all(|x| x.abs() < 1e-13 / (beside * beside)), "{beside} {rate}: {off:?} of {known:?}");
    }
}
