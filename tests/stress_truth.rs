//! What maps over extremes say is so: what was left out is not called failed, and what completes is not called right.

use crate::common::readings;
use holonom::clock;
use holonom::method_spec::MethodSpec;
use holonom::plot::{Align, Item, ItemForm};
use holonom::prepared::Overrides;
use holonom::report::stress::{sentences, stress_figure};
use holonom::study::stress::{
    Cell, CellQuantity, Limits, Map, MapAxis, Status, Stressed, Subject, find, maps, pair, stress,
};
use holonom::tolerances::WRONG_MOTION;
use std::path::Path;
use std::time::Duration;

fn scene(name: &str, overrides: Overrides) -> Subject<'static> {
    clock::count_readings();
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("models").join(name).with_extension("json");
    Subject::load(&path, &overrides).unwrap()
}

fn map(subject: &Subject, name: &str) -> Map {
    maps(subject, &[name.to_string()]).unwrap().remove(0)
}

/// As many steps and rows for each cell as it takes.
fn within(all: Duration) -> Limits {
    Limits { cell: readings(200_000), all }
}

/// The map of gains of Heun's method at these steps, whole.
fn gains(name: &str, steps: [f64; 4]) -> Stressed {
    let subject = scene(name, Overrides::default());
    let mut map = map(&subject, "gain");
    map.methods.retain(|method| method.label == "heun");
    map.x = MapAxis::of(find("step").unwrap(), steps.to_vec());
    stress(&subject, map, within(Duration::MAX), &|| {})
}

fn robot_arm() -> Stressed {
    gains("robot_arm", [5e-4, 0.001, 0.002, 0.005])
}

fn slider_crank() -> Stressed {
    gains("slider_crank", [5e-4, 0.002, 0.005, 0.01])
}

/// As if the budget had ended before these cells.
fn without(whole: &Stressed, left_out: impl Fn(&Cell) -> bool) -> Stressed {
    let blank = |cell: &Cell| {
        if left_out(cell) {
            Cell { status: Status::LeftOut, drift: None, error: None, holds: None, errors: vec![], ..cell.clone() }
        } else {
            cell.clone()
        }
    };
    let cells = whole.cells.iter().map(blank).collect();
    Stressed { map: whole.map.clone(), watched: whole.watched.clone(), second_opinion: None, cells }
}

fn row(stressed: &Stressed, label: &str) -> usize {
    stressed.map.y.entries.iter().position(|entry| entry.label == label).unwrap()
}

#[test]
fn what_was_left_out_has_not_failed() {
    for whole in [robot_arm(), slider_crank()] {
        // The finest step costs most: of it nothing is known, and of the gains at the second neither.
        let is_gain = |cell: &Cell| whole.map.y.entries[cell.row].value.is_some();
        let part = without(&whole, |cell| cell.column == 0 || cell.column == 1 && is_gain(cell));
        let count = part.cells.iter().filter(|cell| cell.status == Status::LeftOut).count();
        let held = |sentence: &str| sentence.split_once("manifold holds until h = ").unwrap().1[..5].to_string();
        for (full, sentence) in sentences(&whole).iter().zip(sentences(&part)) {
            assert!(!sentence.contains("completes with no gain") && !sentence.contains("holds at none"), "{sentence}");
            assert!(!full.contains("Not known") && sentence.contains(&format!("Not known: {count} left out")));
            assert_eq!(held(full), held(&sentence));
        }
        let verdict = &part.gains()[0];
        assert_eq!((verdict.left_out, verdict.steps[1].gains_ended), (count, 0));
        assert_eq!((verdict.steps[0].none.status, verdict.steps[0].none.holds), (Status::LeftOut, None));
        // A gain that diverges wherever it is run has failed; one that is left out has not.
        let far = without(&whole, |cell| is_gain(cell) && cell.status == Status::Completed);
        for sentence in sentences(&far) {
            assert!(sentence.contains("gains and steps that came to an end") || sentence.contains("no gain was run"));
        }
    }
}

#[test]
fn an_empty_map_says_so() {
    for (name, map_name) in [("robot_arm", "gain"), ("quarter_car", "stiffness")] {
        let subject = scene(name, Overrides::default());
        let stressed = stress(&subject, map(&subject, map_name), within(Duration::ZERO), &|| {});
        assert!(stressed.is_empty() && stress_figure(name, &stressed).is_none());
        let said = sentences(&stressed).join("\n");
        assert!(said.contains("there is no figure"), "{said}");
        assert!(said.contains("was not run to an end") || said.contains("the budget left out all 72 cells"), "{said}");
        assert!(stressed.cells.iter().all(|cell| cell.reason.as_ref().is_some_and(|why| why.contains("budget"))));
    }
}

/// Every row and column has its label. What the budget left out looks unlike what diverged, as the legend says.
#[test]
fn the_figure_names_its_cells() {
    let whole = gains("robot_arm", [0.05, 0.005, 0.01, 0.02]);
    let part = without(&whole, |cell| cell.column == 1);
    let figure = stress_figure("robot_arm", &part).unwrap();
    let panel = &figure.panels[0];
    assert_eq!(panel.x.names, ["0.005", "0.01", "0.02", "0.05"]);
    let rows: Vec<&String> = part.map.y.entries.iter().map(|entry| &entry.label).collect();
    assert_eq!(panel.y.names.iter().collect::<Vec<_>>(), rows);
    let tint = |word: &str| panel.keys.iter().find(|(label, _)| label == word).unwrap().1;
    let left_out = tint("– left out");
    let diverged = tint("∞ diverged");
    assert_ne!(left_out, diverged);
    let at = |item: &Item, column: f64, row: f64| item.spots[0].at == (column, row);
    let drawn = |column: usize, row: usize| {
        let (x, y) = (column as f64, row as f64);
        let cell = panel.items.iter().find(|item| item.form == ItemForm::Cell && at(item, x - 0.5, y - 0.5)).unwrap();
        let word = panel.items.iter().find(|item| item.form != ItemForm::Cell && at(item, x, y));
        (cell.tint, word.map(|word| word.form.clone()))
    };
    assert!((0..rows.len()).all(|row| drawn(0, row).0 == left_out));
    for cell in part.cells.iter().filter(|cell| cell.status == Status::Diverged) {
        let column = [3, 0, 1, 2][cell.column];
        assert_eq!(drawn(column, cell.row), (diverged, Some(ItemForm::Text("∞".to_string(), Align::Middle))));
    }
}

#[test]
fn what_completes_need_not_be_right() {
    for (whole, most, step) in [(robot_arm(), "0.002", "0.005"), (slider_crank(), "0.005", "0.01")] {
        let manifold = row(&whole, "manifold");
        let off = whole.cells.iter().find(|cell| cell.row == manifold && cell.holds == Some(false)).unwrap();
        assert!(off.status == Status::Completed && off.error.unwrap() > WRONG_MOTION && off.worst.is_some(), "{off:?}");
        for sentence in sentences(&whole) {
            assert!(sentence.contains(&format!("manifold holds until h = {most} (error ")), "{sentence}");
            assert!(sentence.contains(&format!(", at {step} it completes with outputs ")), "{sentence}");
        }
        // Neither outputs nor energy are far off where a cell holds.
        let is_within = |cell: &Cell| {
            cell.error.unwrap() <= WRONG_MOTION
                && cell.relative_energy_error.is_none_or(|part| part <= WRONG_MOTION)
                && cell.drift.is_some()
        };
        assert!(whole.cells.iter().filter(|cell| cell.holds == Some(true)).all(is_within));
        assert!(whole.cells.iter().any(|cell| cell.relative_energy_error.is_some_and(|part| part > WRONG_MOTION)));
    }
}

/// The gain that drifts least is many times as far off as none: 8 times in theta1 of the robot arm.
#[test]
fn drifting_least_is_not_being_nearest() {
    for (whole, output) in [(robot_arm(), "theta1"), (slider_crank(), "crank_speed")] {
        let verdict = &whole.gains()[0];
        let none = row(&whole, "none");
        let watched = whole.watched.iter().position(|name| name == output).unwrap();
        let ratio = |column: usize| {
            let best = verdict.steps[column].best?.gain;
            let row = whole.map.y.entries.iter().position(|entry| entry.value == Some(best))?;
            let [gain, none] = [row, none].map(|row| &whole.cell(0, row, column).unwrap().errors);
            Some(gain.get(watched)? / none.get(watched)?)
        };
        let worst = (0..4).filter_map(ratio).fold(0.0, f64::max);
        let told = verdict.farther.as_ref().unwrap();
        assert!(worst > 7.0 && told.ratio >= worst, "{output}: {worst} {told:?}");
        let said = &sentences(&whole)[0];
        assert!(said.contains(&format!("times as far off as none in {}", told.output)), "{said}");
    }
}

/// The energy of a level pendulum, and the outputs across the plane of motion of others, are zero.
#[test]
fn what_is_zero_by_physics_spoils_no_errors() {
    for (name, time) in [("pendulum", 1.0), ("parallelogram", 0.2), ("bricard", 0.05)] {
        let dopri5 = Some(MethodSpec::named("dopri5"));
        let subject = scene(name, Overrides { integrator: dopri5, step: None, ..Overrides::default() });
        let [x, y] = [("tolerance", 1e-6), ("time", time)].map(|(name, at)| MapAxis::of(find(name).unwrap(), vec![at]));
        let stressed = stress(&subject, pair(&subject, x, y, CellQuantity::Error), within(Duration::MAX), &|| {});
        let cell = &stressed.cells[0];
        assert!(cell.error.is_some_and(|error| error > 0.0 && error < 1e-3), "{name}: {cell:?}");
    }
}

/// Each corner has its own motion, and its own reference.
#[test]
fn corners_have_references() {
    for name in ["quarter_car", "five_link_suspension"] {
        let subject = scene(name, Overrides { until: Some(0.5), ..Overrides::default() });
        let mut map = map(&subject, "stiffness");
        map.x = MapAxis::of(find("stiffness").unwrap(), vec![1e2, 1e5]);
        map.y = MapAxis::of(find("mass_ratio").unwrap(), vec![1.0, 100.0]);
        let stressed = stress(&subject, map, within(Duration::MAX), &|| {});
        for cell in &stressed.cells {
            assert!(cell.error.is_some_and(|error| error > 0.0 && error < 1e-4), "{name}: {cell:?}");
        }
    }
}
