//! `simulate --start FILE`.

use super::*;

/// The last row of a trajectory.
fn last(place: &Place, folder: &str) -> String {
    place.text(&format!("{folder}/trajectory.csv")).lines().last().unwrap().to_string()
}

fn summary(place: &Place, folder: &str) -> Value {
    place.json(&format!("{folder}/summary.json"))
}

/// What is said of bad input.
fn refused(place: &Place, args: &[&str]) -> String {
    let output = place.run(args);
    assert_eq!(output.status.code(), Some(2), "{args:?}");
    err(&output)
}

/// Fixed steps of the whole and of its parts are the same.
#[test]
fn a_run_in_two_parts_is_bit_by_bit_the_whole() {
    let place = Place::new(PENDULUM);
    let simulate = |rest: &[&str]| {
        let method = ["simulate", "scene.json", "--integrator", "rk4", "--step", "0.01", "--quiet"];
        place.done(&[&method[..], rest].concat())
    };
    simulate(&["-o", "whole"]);
    simulate(&["-o", "first", "--until", "0.4"]);
    simulate(&["-o", "second", "--start", "first/summary.json"]);
    assert_eq!(last(&place, "second"), last(&place, "whole"));
    let [whole, second] = ["whole", "second"].map(|folder| summary(&place, folder));
    assert_eq!(second["statistics"], whole["statistics"]);
    assert_eq!(second["restart"]["y"], whole["restart"]["y"]);
    // The second trajectory begins where the first one ended.
    let text = place.text("second/trajectory.csv");
    assert!(text.lines().nth(1).unwrap().starts_with("0.4,"), "{text}");
    assert_eq!(text.lines().count(), 1 + 7);
}

#[test]
fn another_method_begins_anew_and_says_so() {
    let place = Place::new(PENDULUM);
    place.done(&["simulate", "scene.json", "-o", "first", "--until", "0.4", "--quiet"]);
    place.done(&["simulate", "scene.json", "-o", "second", "--start", "first/summary.json", "--rtol", "1e-9"]);
    let warnings = summary(&place, "second")["warnings"].to_string();
    assert!(warnings.contains("begins anew"), "{warnings}");
    place.done(&["simulate", "scene.json", "-o", "third", "--start", "first/summary.json"]);
    assert_eq!(summary(&place, "third")["warnings"], Value::Array(vec![]));
}

#[test]
fn what_does_not_go_on_is_refused() {
    let place = Place::new(PENDULUM);
    place.done(&["simulate", "scene.json", "-o", "first", "--quiet"]);
    let check = |file: &str, words: &str| {
        let error = refused(&place, &["simulate", "scene.json", "--start", file, "--until", "2"]);
        assert!(error.contains(words), "{error}");
    };
    let error = refused(&place, &["simulate", "scene.json", "--start", "first/summary.json"]);
    assert!(error.contains("go on to a later one with --until"), "{error}");
    check("none.json", "none.json");
    check("scene.json", "no summary of a run");
    let broken = place.text("first/summary.json").replace("\"pieces\": []", "\"pieces\": [7]");
    fs::write(place.path("broken.json"), broken).unwrap();
    check("broken.json", "of another system");
    fs::write(place.path("other.json"), place.text("first/summary.json").replace("rod.x", "bar.x")).unwrap();
    check("other.json", "bar.x");
}

/// A file that was changed by hand is checked like any start.
#[test]
fn a_state_that_no_run_has_left_is_refused() {
    let place = Place::new(PENDULUM);
    place.done(&["simulate", "scene.json", "-o", "first", "--quiet"]);
    let changed = |change: &dyn Fn(&mut Value)| {
        let mut summary = summary(&place, "first");
        change(&mut summary);
        fs::write(place.path("changed.json"), summary.to_string()).unwrap();
        ["simulate", "scene.json", "--start", "changed.json", "--until", "2", "-o", "second"]
    };
    let open = refused(&place, &changed(&|summary| summary["restart"]["y"][0] = 0.5.into()));
    assert!(open.contains("is open by") && open.contains("at the saved state"), "{open}");
    let count = refused(&place, &changed(&|summary| summary["restart"]["statistics"]["steps"] = u64::MAX.into()));
    assert!(count.contains("of another system"), "{count}");
    // The number of the next row follows from the time.
    place.done(&changed(&|summary| summary["restart"]["next_row"] = u64::MAX.into()));
    let rows = place.text("second/trajectory.csv").lines().count();
    place.done(&changed(&|_| ()));
    assert_eq!(place.text("second/trajectory.csv").lines().count(), rows);
}

/// A run goes on in the scene that it began in, unless the user says that the scene was changed on purpose.
#[test]
fn a_changed_scene_is_refused_unless_it_is_meant() {
    let place = Place::new(PENDULUM);
    place.done(&["simulate", "scene.json", "-o", "first", "--quiet"]);
    let moon = PENDULUM.replace("-9.81", "-1.62");
    assert_ne!(moon, PENDULUM);
    fs::write(place.path("scene.json"), moon).unwrap();
    let args = ["simulate", "scene.json", "--start", "first/summary.json", "--until", "2", "-o", "second"];
    let error = refused(&place, &args);
    assert!(error.contains("it was changed since") && error.contains("--changed"), "{error}");
    place.done(&[&args[..], &["--changed"]].concat());
}

/// The terms of a run that goes on by another method are those of its first state.
#[test]
fn drift_begins_at_the_state_where_another_method_goes_on() {
    let place = Place::new("");
    let scene = concat!(env!("CARGO_MANIFEST_DIR"), "/models/double_pendulum.json");
    place.done(&["simulate", scene, "--until", "2", "-o", "half"]);
    let on = ["--start", "half/summary.json", "--until", "3", "-o", "whole"];
    for integrator in ["dop853", "adams"] {
        place.done(&[&["simulate", scene, "--integrator", integrator][..], &on].concat());
        let drift = summary(&place, "whole")["drift"]["position"]["max"].as_f64().unwrap();
        assert!(drift < 1e-14, "{integrator}: {drift:e}");
    }
}
