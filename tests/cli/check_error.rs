//! `simulate --check-error`: error bars hold the error.

use super::*;

const PENDULUM_RTOL: &str = "rtol 1e-6, atol 1e-8";

/// A column of the trajectory, beside one that is far more accurate: the largest difference and that at the end.
fn error_of(place: &Place, name: &str, [own, exact]: [&str; 2]) -> [f64; 2] {
    let column = |folder: &str| -> Vec<f64> {
        let text = place.text(&format!("{folder}/trajectory.csv"));
        let index = text.lines().next().unwrap().split(',').position(|heading| heading == name).unwrap();
        text.lines().skip(1).map(|line| line.split(',').nth(index).unwrap().parse().unwrap()).collect()
    };
    let own = column(own);
    let exact = column(exact);
    let errors: Vec<f64> = own.iter().zip(&exact).map(|(own, exact)| (own - exact).abs()).collect();
    [errors.iter().fold(0.0, |most, error| error.max(most)), errors[errors.len() - 1]]
}

/// The true error lies within the bar, and the bar is not much wider: ten times the tolerance leaves about ten times the
/// error, a hundred times that of dop853 in a short run more, twice the step of rk4 sixteen times.
#[test]
fn the_bar_holds_the_error() {
    let place = Place::new(PENDULUM);
    let exact = ["--rtol", "1e-12", "--atol", "1e-12", "-o", "exact"];
    place.done(&[&["simulate", "scene.json", "--quiet", "--until", "5"], &exact[..]].concat());
    for method in [
        &["--rtol", "1e-6", "--atol", "1e-8", "--integrator", "dopri5"][..],
        &["--rtol", "1e-6", "--atol", "1e-8", "--integrator", "dop853"],
        &["--rtol", "1e-6", "--atol", "1e-8", "--method", "auto"],
        &["--integrator", "rk4", "--step", "0.01"],
    ] {
        let args = ["simulate", "scene.json", "--until", "5", "-o", "own", "--check-error"];
        let text = place.done(&[&args[..], method].concat());
        assert!(text.contains("error bar") && !text.contains("--check-error"), "{text}");
        let error = &place.json("own/summary.json")["error"];
        assert_eq!(keys(&error["outputs"]), ["theta", "pin"]);
        assert_eq!((&error["failure"], &error["outputs"]["pin"]["unit"]), (&Value::Null, &Value::from("N")));
        for name in ["theta", "pin"] {
            let [max, last] = error_of(&place, name, ["own", "exact"]);
            let told = |key: &str| error["outputs"][name][key].as_f64().unwrap();
            assert!(told("max") >= max && told("max") < 100.0 * max, "{name}: {error} beside {max:e}");
            assert!(told("final") >= last, "{name}: {error} beside {last:e}");
        }
        // The period grows with the amplitude: small changes grow with time, not exponentially.
        let amplified = error["amplification"].as_f64().unwrap();
        assert!((1.0..20.0).contains(&amplified), "{amplified}");
        assert!(error["work"].as_f64().unwrap() < 0.75, "{error}");
    }
    assert_eq!(place.json("own/summary.json")["error"]["step"], 0.02);
}

/// The steps of a run at 1e-9 and of one at ten times that are controlled alike, by 1e-11: their difference would be
/// none.
#[test]
fn steps_at_their_tightest_have_a_companion_with_longer_ones() {
    let place = Place::new(PENDULUM);
    let exact = ["--rtol", "1e-13", "--atol", "1e-15", "-o", "exact"];
    place.done(&[&["simulate", "scene.json", "--quiet"], &exact[..]].concat());
    let args = ["simulate", "scene.json", "--integrator", "esdirk34", "--projection", "none", "--check-error"];
    place.done(&[&args[..], &["--rtol", "1e-9", "--atol", "1e-11", "-o", "own"]].concat());
    let [max, _] = error_of(&place, "theta", ["own", "exact"]);
    let error = &place.json("own/summary.json")["error"];
    assert!(error["rtol"].as_f64().unwrap() > 5e-8, "{error}");
    let told = error["outputs"]["theta"]["max"].as_f64().unwrap();
    assert!(told >= max && told < 100.0 * max, "{told:e} beside {max:e}");
}

/// At 1e-13 the difference of two runs may be less than round-off.
#[test]
fn an_error_bar_is_not_below_round_off() {
    let place = Place::new(PENDULUM);
    let method = ["--rtol", "1e-13", "--atol", "1e-15", "--until", "0.1", "--output-step", "0.1"];
    place.done(&[&["simulate", "scene.json", "--check-error", "-o", "own"], &method[..]].concat());
    let summary = place.json("own/summary.json");
    let most = &summary["outputs"]["pin"]["max"];
    let bar = &summary["error"]["outputs"]["pin"]["max"];
    assert!(bar.as_f64().unwrap() >= 1e-14 * most.as_f64().unwrap(), "{summary}");
}

/// Arrays have the bar of each output at each row.
#[test]
fn arrays_have_the_error_bars() {
    let place = Place::new(PENDULUM);
    let format = ["--format", "npz,csv", "-o", "own", "--rtol", "1e-4", "--atol", "1e-6"];
    place.done(&[&["simulate", "scene.json", "--check-error"], &format[..]].concat());
    let archive = std::fs::read(place.path("own/trajectory.npz")).unwrap();
    for name in ["error_rows.npy", "error_columns.npy"] {
        assert!(archive.windows(name.len()).any(|window| window == name.as_bytes()), "{name}");
    }
}

#[test]
fn without_outputs_coordinates_are_compared() {
    let place = Place::new(parallelogram());
    let text =
        place.done(&["simulate", "scene.json", "-o", "here", "--check-error", "--rtol", "1e-6", "--atol", "1e-8"]);
    assert!(text.contains("from a companion with rtol 1e-4, atol 1e-6"), "{text}");
    let check = &place.json("here/summary.json")["error"];
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
    assert_eq!(place.json("here/summary.json")["error"], Value::Null);
    let fixed = place.done(&["simulate", "scene.json", "-o", "here", "--integrator", "rk4", "--step", "0.01"]);
    assert!(fixed.contains("nothing estimates the errors of fixed steps"), "{fixed}");
    let penalty = place.done(&["simulate", "scene.json", "-o", "here", "--formulation", "penalty"]);
    assert!(penalty.contains("no tolerance or step takes away the error O(1/penalty)"), "{penalty}");
}

/// At twice the step rk4 is beyond its limit of stability, 2.8 / |s|: a run at half the step takes its place.
#[test]
fn a_coarser_run_that_fails_is_replaced_by_a_finer_one() {
    let place = Place::new(include_str!("../../models/quarter_car.json"));
    let fixed = ["--set", "c_strut=5e4", "--integrator", "rk4", "--until", "0.5", "--check-error", "-o", "here"];
    let text = place.done(&[&["simulate", "scene.json", "--step", "0.0016"][..], &fixed].concat());
    let error = &place.json("here/summary.json")["error"];
    assert_eq!((&error["step"], &error["failure"]), (&Value::from(0.0008), &Value::Null), "{text}");
}

/// The companion has a tenth of the penalty, too: its bar holds the error of the penalty, which no tolerance has.
#[test]
fn the_bar_holds_the_error_of_a_penalty() {
    let place = Place::new(PENDULUM);
    let tight = ["--until", "2", "--rtol", "1e-10", "--atol", "1e-10"];
    place.done(&[&["simulate", "scene.json", "--quiet", "-o", "exact"], &tight[..]].concat());
    let penalty = ["--formulation", "penalty:penalty=1e4", "--projection", "none", "--integrator", "dopri5"];
    place.done(&[&["simulate", "scene.json", "--check-error", "-o", "own"], &tight[..], &penalty].concat());
    let [max, _] = error_of(&place, "theta", ["own", "exact"]);
    let told = place.json("own/summary.json")["error"]["outputs"]["theta"]["max"].as_f64().unwrap();
    assert!(max > 1e-8 && told >= max && told < 30.0 * max, "{told:e} beside {max:e}");
}

/// Small changes of a stiff motion cannot be carried by an explicit method.
#[test]
fn an_amplification_that_is_not_known_has_a_cause() {
    let place = Place::new(include_str!("../../models/quarter_car.json"));
    let method = ["--formulation", "ggl", "--integrator", "radau_iia", "--projection", "none"];
    let args = ["simulate", "scene.json", "--set", "c_strut=2e5", "--check-error", "-o", "here"];
    let text = place.done(&[&args[..], &method].concat());
    assert!(text.contains("amplifies small changes is not known: the fastest mode of the start"), "{text}");
    assert_eq!(place.json("here/summary.json")["error"]["amplification"], Value::Null);
}
