//! Figures of a run.

use holonom::analysis::{Drift, Ledger, Record, Singularity, ValidityRange, WorstRow, WorstStep};
use holonom::report::{Shown, drift_figure, energy_figure, outputs_figure};
use holonom::system::{Column, Names};
use holonom::trajectory::Trajectory;

/// Rows at times of 0.01 s with one constraint and the energies of a motion without work.
fn record(drift: impl Fn(f64) -> f64, kinetic: impl Fn(f64) -> f64, potential: impl Fn(f64) -> f64) -> Record {
    let times: Vec<f64> = (0..100).map(|k| 0.01 * f64::from(k)).collect();
    let names = Names { lambda: vec!["rod".into()], ..Names::default() };
    let rows = times.iter().map(|t| vec![*t, 0.0]).collect();
    let ledger = |t: &f64| {
        let kinetic = kinetic(*t);
        let potential = potential(*t);
        Ledger { kinetic, potential, work: 0.0, error: kinetic + potential - 100.0 }
    };
    Record {
        trajectory: Trajectory { names, outputs: Vec::new(), rows },
        last: None,
        rows: times.len(),
        jumps: 0,
        gaps: Vec::new(),
        extremes: Vec::new(),
        worst_step: WorstStep::default(),
        worst_row: WorstRow::default(),
        drift: Drift::default(),
        energy: None,
        singularity: Singularity::default(),
        range: ValidityRange::default(),
        drift_rows: times.iter().map(|t| [drift(*t); 3]).collect(),
        ledger_rows: times.iter().map(ledger).collect(),
    }
}

#[test]
fn axes_have_units() {
    let column = |name: &str, unit: &str| Column { name: name.into(), unit: unit.into() };
    let outputs = vec![column("a", "m/s^2"), column("b", "m/s^2"), column("alpha", "rad/s^2")];
    let rows = vec![vec![0.0, 1.0, 2.0, 3.0], vec![1.0, 2.0, 3.0, 4.0]];
    let run = Trajectory { names: Names::default(), outputs, rows };
    let figure = outputs_figure("run", &run, None, &Shown::all(&run), false).unwrap();
    let labels: Vec<&str> = figure.panels.iter().map(|panel| panel.y.label.as_str()).collect();
    assert_eq!(labels, ["acceleration (m/s^2)", "alpha (rad/s^2)"]);
    let apart = outputs_figure("run", &run, None, &Shown::all(&run), true).unwrap();
    let labels: Vec<&str> = apart.panels.iter().map(|panel| panel.y.label.as_str()).collect();
    assert_eq!(labels, ["a (m/s^2)", "b (m/s^2)", "alpha (rad/s^2)"]);
}

#[test]
fn drift_axes_end_at_round_off() {
    let record = record(|t| if t < 0.5 { 0.0 } else { 1e-12 * t }, |_| 1.0, |_| 99.0);
    let figure = drift_figure("run", &record, &Shown::all(&record.trajectory), 0.05).unwrap();
    let panel = &figure.panels[0];
    let values = || panel.series.iter().flat_map(|series| series.points.iter().map(|point| point.1));
    assert_eq!(values().fold(f64::INFINITY, f64::min), 1e-17);
    assert_eq!(panel.title, "round-off: values below 10^-17 are drawn at 10^-17");
    assert!(values().any(|value| value > 9e-13));
}

#[test]
fn energies_far_from_zero_are_drawn_as_changes() {
    let swing = |t: f64| 1.0 - (9.0 * t).cos();
    let high = record(|_| 0.0, swing, |t| 1e6 - swing(t));
    let figure = energy_figure("run", &high, &Shown::all(&high.trajectory)).unwrap();
    assert_eq!((figure.panels.len(), figure.panels[0].y.label.as_str()), (2, "energy − x₀ (J)"));
    let names: Vec<&str> = figure.panels[0].series.iter().map(|series| series.label.as_str()).collect();
    assert_eq!(names, ["kinetic, x₀ = 0 J", "potential, x₀ = 1e6 J"]);
    let low = record(|_| 0.0, swing, |t| -swing(t));
    let figure = energy_figure("run", &low, &Shown::all(&low.trajectory)).unwrap();
    let names: Vec<&str> = figure.panels[0].series.iter().map(|series| series.label.as_str()).collect();
    assert_eq!(names, ["kinetic", "potential", "total less work"]);
}
