//! Both sides of a jump in tables, figures and summaries.

use super::*;

/// A mass of 2 kg on a rail, pushed by a force that falls from 10 N to 4 N at 0.3 s; x'' = 5, then 2.
fn pushed(force: &str) -> String {
    format!(
        r#"{{ "name": "pushed", "dimension": 2, "bodies": [
              {{ "name": "m", "type": "rigid", "mass": 2, "free": ["x"] }} ],
            "forces": [ {{ "name": "push", "type": "applied_force", "at": "m", "force": ["{force}", 0] }} ],
            "outputs": [ {{ "name": "x", "measure": "position", "of": "m", "component": "x" }},
                         {{ "name": "a", "measure": "acceleration", "of": "m", "component": "x" }},
                         {{ "name": "f", "measure": "force", "of": "push", "component": "x" }} ],
            "simulation": {{ "t_end": 1, "output_step": 0.25 }} }}"#
    )
}

/// Columns t and `a` of `trajectory.csv`.
fn accelerations(place: &Place, folder: &str) -> Vec<(f64, f64)> {
    let table = place.text(&format!("{folder}/trajectory.csv"));
    let headings: Vec<&str> = table.lines().next().unwrap().split(',').collect();
    let column = headings.iter().position(|heading| *heading == "a").unwrap();
    let cell = |line: &str, i: usize| line.split(',').nth(i).unwrap().parse().unwrap();
    table.lines().skip(1).map(|line| (cell(line, 0), cell(line, column))).collect()
}

fn close(found: &[(f64, f64)], expected: &[(f64, f64)]) {
    assert_eq!(found.len(), expected.len(), "{found:?}");
    for ((t, a), (time, expected)) in found.iter().zip(expected) {
        assert!((t - time).abs() < 1e-9 && (a - expected).abs() < 1e-9, "{found:?}");
    }
}

#[test]
fn a_jump_has_a_row_on_each_side() {
    let place = Place::new(pushed("if(t < 0.3, 10, 4)"));
    for more in [&[][..], &["--outputs-only"], &["--check-error"], &["--format", "csv,npz"]] {
        place.done(&[&["simulate", "scene.json", "-o", "here"], more].concat());
        let expected = [(0.0, 5.0), (0.25, 5.0), (0.3, 5.0), (0.3, 2.0), (0.5, 2.0), (0.75, 2.0), (1.0, 2.0)];
        close(&accelerations(&place, "here"), &expected);
        let lines = |name: &str| place.text(&format!("here/{name}")).lines().count();
        assert_eq!([lines("drift.csv"), lines("energy.csv")], [8, 8]);
    }
    // Of a row at the very time it is the side before; its time is not written three times.
    let place = Place::new(pushed("if(t < 0.5, 10, 4)"));
    place.done(&["simulate", "scene.json", "-o", "here"]);
    let expected = [(0.0, 5.0), (0.25, 5.0), (0.5, 5.0), (0.5, 2.0), (0.75, 2.0), (1.0, 2.0)];
    close(&accelerations(&place, "here"), &expected);
    place.done(&["plot", "scene.json", "--from", "here", "--stroboscope", "-o", "drawn"]);
}

/// A pulse of 1 ms between two rows is seen by its extremes, and by the mean of the square.
#[test]
fn extremes_are_from_both_sides() {
    let place = Place::new(pushed("if(t > 0.3 and t < 0.301, 1000, 0)"));
    place.done(&["simulate", "scene.json", "-o", "here"]);
    let output = place.json("here/summary.json")["outputs"]["f"].clone();
    let number = |key: &str| output[key].as_f64().unwrap();
    assert_eq!([number("min"), number("max")], [0.0, 1000.0]);
    assert!((number("t_max") - 0.3).abs() < 1e-9, "{output}");
    // Root of 1e6 N^2 over 1 ms of 1 s.
    assert!((number("rms") - 1e3f64.sqrt()).abs() < 1e-6, "{output}");
}

/// The table of a smooth law, and of one that has a kink, is as it was; a prescribed rate that jumps makes v jump.
#[test]
fn rows_are_added_where_a_column_jumps_alone() {
    for force in ["10*cos(t)", "10*abs(t - 0.3)", "table(t, 0, 1, 0.3, 2, 1, 0)"] {
        let place = Place::new(pushed(force));
        place.done(&["simulate", "scene.json", "-o", "here"]);
        assert_eq!(accelerations(&place, "here").len(), 5, "{force}");
    }
    let drive = r#""joints": [ { "name": "drive", "type": "driver", "between": ["ground", "m"], "coordinate": "x",
                                 "value": "max(0, t - 0.3)" } ], "outputs""#;
    let place = Place::new(pushed("0").replace(r#""outputs""#, drive));
    place.done(&["simulate", "scene.json", "-o", "here"]);
    assert_eq!(accelerations(&place, "here").len(), 7);
}

/// The bars do not take a jump for an error: that of a companion is elsewhere by the error of its motion alone.
#[test]
fn a_jump_is_no_error() {
    for at in ["0.3", "0.5"] {
        let place = Place::new(pushed(&format!("if(t < {at}, 10, 4) - m.x")));
        place.done(&["simulate", "scene.json", "--check-error", "-o", "here"]);
        let json = place.json("here/summary.json");
        for name in ["x", "a", "f"] {
            let bar = json["error"]["outputs"][name]["max"].as_f64().unwrap();
            assert!(bar < 1e-6, "{at}: {name} {bar:e}");
        }
        let opinion = &json["error"]["second_opinion"];
        assert!(!opinion.is_null() && opinion["difference"].as_f64().unwrap() < 1e-6, "{opinion}");
    }
}

/// A force that jumps a thousand times and more: the table is bounded, and says so.
#[test]
fn many_jumps_do_not_flood_the_table() {
    let place = Place::new(pushed("if(mod(t, 1e-3) < 5e-4, 1, 0)"));
    let output = place.run(&["simulate", "scene.json", "-o", "here", "--figures", "none"]);
    assert!(err(&output).contains("times: the table has a row on both sides of the first 1000"), "{}", err(&output));
    let rows = accelerations(&place, "here").len();
    assert!((2000..=2006).contains(&rows), "{rows}");
}
