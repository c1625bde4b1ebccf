//! `simulate --check-error`: what is said is the error.

use super::*;

const PENDULUM_RTOL: &str = "rtol 1e-6, atol 1e-8";

/// A column of the trajectory, beside one that is far more accurate: the largest difference and that at the end.
fn error_of(place: &Place, name: &str, [own, exact]: [&str; 2]) -> [f64; 2] {
    let column = |folder: &str| -> Vec<f64> {
        let text = place.text(&format!("{folder}/trajectory.csv"));
        let index = text.lines().next().unwrap().split(',').position(|heading| heading == name).unwrap();
        text.lines().skip(1).map(|line| line.split(',').nth(index).unwrap().parse().unwrap()).collect()
    };
    let (own, exact) = (column(own), column(exact));
    let errors: Vec<f64> = own.iter().zip(&exact).map(|(own, exact)| (own - exact).abs()).collect();
    [errors.iter().fold(0.0, |most, error| error.max(most)), errors[errors.len() - 1]]
}

/// A tenth of the tolerance leaves about a tenth of the error, half the step of rk4 a sixteenth: the difference is the error
/// but for that.
#[test]
fn the_difference_is_the_error() {
    let place = Place::new(PENDULUM);
    let exact = ["--rtol", "1e-12", "--atol", "1e-12", "-o", "exact"];
    place.done(&[&["simulate", "scene.json", "--quiet", "--until", "5"], &exact[..]].concat());
    for (method, tenth) in [
        (&["--rtol", "1e-6", "--atol", "1e-8", "--integrator", "dopri5"][..], 0.3),
        (&["--integrator", "rk4", "--step", "0.01"], 0.1),
    ] {
        let args = ["simulate", "scene.json", "--until", "5", "-o", "own", "--check-error"];
        let text = place.done(&[&args[..], method].concat());
        assert!(text.contains("difference to ") && !text.contains("--check-error"), "{text}");
        let check = &place.json("own/summary.json")["check_error"];
        assert_eq!(keys(&check["outputs"]), ["theta", "pin"]);
        assert_eq!((&check["failure"], &check["outputs"]["pin"]["unit"]), (&Value::Null, &Value::from("N")));
        for name in ["theta", "pin"] {
            let [max, last] = error_of(&place, name, ["own", "exact"]);
            let told = |key: &str| check["outputs"][name][key].as_f64().unwrap();
            assert!((told("max") / max - 1.0).abs() < tenth, "{name}: {check} beside {max:e}");
            assert!((told("final") - last).abs() < tenth * max, "{name}: {check} beside {last:e}");
        }
        // The period grows with the amplitude: small changes grow with time, not exponentially.
        let amplified = check["amplification"].as_f64().unwrap();
        assert!((1.0..20.0).contains(&amplified), "{amplified}");
    }
    assert_eq!(place.json("own/summary.json")["check_error"]["step"], 0.005);
}

/// The steps of a run at 1e-9 and of one at a tenth of that are controlled alike, by 1e-11: their difference would be none.
#[test]
fn steps_at_their_tightest_are_compared_with_tighter_ones() {
    let place = Place::new(PENDULUM);
    let exact = ["--rtol", "1e-13", "--atol", "1e-15", "-o", "exact"];
    place.done(&[&["simulate", "scene.json", "--quiet"], &exact[..]].concat());
    let args = ["simulate", "scene.json", "--integrator", "esdirk34", "--projection", "none", "--check-error"];
    let text = place.done(&[&args[..], &["--rtol", "1e-9", "--atol", "1e-11", "-o", "own"]].concat());
    assert!(text.contains("difference to rtol 1e-12, atol 1e-14"), "{text}");
    let [max, _] = error_of(&place, "theta", ["own", "exact"]);
    let told = place.json("own/summary.json")["check_error"]["outputs"]["theta"]["max"].as_f64().unwrap();
    // Of order 3, a tenth of the tolerance leaves a fifth of the error.
    assert!(told > 0.3 * max && told < 2.0 * max, "{told:e} beside {max:e}");
}

#[test]
fn without_outputs_coordinates_are_compared() {
    let place = Place::new(parallelogram());
    let text =
        place.done(&["simulate", "scene.json", "-o", "here", "--check-error", "--rtol", "1e-6", "--atol", "1e-8"]);
    assert!(text.contains("difference to rtol 1e-7, atol 1e-9"), "{text}");
    let check = &place.json("here/summary.json")["check_error"];
    assert_eq!(check["outputs"]["beam.angle"]["unit"], "");
    assert!(check["outputs"]["beam.x"]["max"].as_f64().unwrap() < 1e-5, "{check}");
}

#[test]
fn without_the_option_it_is_said_that_nobody_has_measured() {
    let place = Place::new(PENDULUM);
    let text = place.done(&["simulate", "scene.json", "-o", "here", "--rtol", "1e-6", "--atol", "1e-8"]);
    assert!(
        text.contains(PENDULUM_RTOL) && text.contains("errors are estimated of single steps only: --check-error"),
        "{text}"
    );
    assert_eq!(place.json("here/summary.json")["check_error"], Value::Null);
    let fixed = place.done(&["simulate", "scene.json", "-o", "here", "--integrator", "rk4", "--step", "0.01"]);
    assert!(fixed.contains("nothing estimates the errors of fixed steps"), "{fixed}");
    let penalty = place.done(&["simulate", "scene.json", "-o", "here", "--formulation", "penalty"]);
    assert!(penalty.contains("the limit is the penalty, whose error O(1/penalty)"), "{penalty}");
}

/// A tolerance that goes over a singular state, and a tenth of it that is too near to round-off there: the bound is at
/// about 1e-14.
#[test]
fn a_second_run_that_fails_is_said_and_the_first_is_kept() {
    let mut scene: Value = serde_json::from_str(include_str!("../../models/n_four_bar.json")).unwrap();
    scene["simulation"] = serde_json::json!({ "t_end": 1, "output_step": 0.1, "integrator": "dop853" });
    let place = Place::new(scene.to_string());
    let output =
        place.run(&["simulate", "scene.json", "-o", "here", "--rtol", "5e-14", "--atol", "5e-14", "--check-error"]);
    assert_eq!(output.status.code(), Some(0), "{}", err(&output));
    let message = err(&output);
    assert!(
        message.starts_with("warning: the second run, with rtol 5e-15, atol 5e-15, ended at t = 0.72"),
        "{message}"
    );
    let summary = place.json("here/summary.json");
    assert_eq!((&summary["status"], summary["final"]["t"].as_f64()), (&"completed".into(), Some(1.0)));
    assert!(summary["check_error"]["failure"]["reason"].is_string(), "{summary}");
    assert_eq!(place.text("here/trajectory.csv").lines().count(), 12);
}

/// Small changes of a stiff motion cannot be carried by an explicit method.
#[test]
fn an_amplification_that_is_not_known_has_a_cause() {
    let place = Place::new(include_str!("../../models/quarter_car.json"));
    let method = ["--formulation", "ggl", "--integrator", "radau_iia", "--projection", "none"];
    let args = ["simulate", "scene.json", "--set", "c_strut=2e5", "--check-error", "-o", "here"];
    let text = place.done(&[&args[..], &method].concat());
    assert!(text.contains("amplifies small changes is not known: the fastest mode of the start"), "{text}");
    assert_eq!(place.json("here/summary.json")["check_error"]["amplification"], Value::Null);
}
