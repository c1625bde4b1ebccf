//! Table of all runs.

use crate::formulation::Statistics;
use crate::report::cell as number;
use crate::report::tables::{TableColumn, optional};
use crate::study::work_precision::{Cell, Outcome};

/// A row for each run; empty cells where it has no value.
pub const COLUMNS: [TableColumn<Cell>; 26] = [
    ("formulation", |cell| cell.method.formulation.to_string()),
    ("integrator", |cell| cell.method.integrator.to_string()),
    ("projection", |cell| cell.method.projection.to_string()),
    ("rtol", |cell| number(cell.method.rtol)),
    ("atol", |cell| number(cell.method.atol)),
    ("step", |cell| optional(cell.method.step)),
    ("status", |cell| status(cell).to_string()),
    ("digits", |cell| optional(cell.digits())),
    ("error", |cell| optional(cell.error())),
    ("worst", |cell| worst(cell).to_string()),
    ("cost", |cell| optional(cell.cost.filter(|_| cell.error().is_some()))),
    ("cpu_seconds", |cell| optional(seconds(cell).iter().copied().reduce(f64::min))),
    ("fastest", |cell| optional(cell.seconds())),
    ("slowest", |cell| optional(cell.seconds().and_then(|_| seconds(cell).iter().copied().reduce(f64::max)))),
    ("repeats", |cell| cell.error().map_or(String::new(), |_| seconds(cell).len().to_string())),
    ("position_drift", |cell| optional(cell.drift().map(|drift| drift.position))),
    ("velocity_drift", |cell| optional(cell.drift().map(|drift| drift.velocity))),
    ("steps", |cell| work(cell, |work| work.steps)),
    ("rejected", |cell| work(cell, |work| work.rejected)),
    ("rhs_evaluations", |cell| work(cell, |work| work.rhs_evaluations)),
    ("jacobian_evaluations", |cell| work(cell, |work| work.jacobian_evaluations)),
    ("factorizations", |cell| work(cell, |work| work.factorizations)),
    ("newton_iterations", |cell| work(cell, |work| work.newton_iterations)),
    ("projections", |cell| work(cell, |work| work.projections)),
    ("row_evaluations", |cell| work(cell, |work| work.rows.rhs_evaluations)),
    ("reason", |cell| cell.reason().unwrap_or_default().to_string()),
];

fn status(cell: &Cell) -> &'static str {
    match cell.outcome {
        Outcome::Completed { .. } => "completed",
        Outcome::Failed { .. } => "failed",
        Outcome::TooSlow { .. } => "too_slow",
        Outcome::Skipped { .. } => "skipped",
    }
}

fn worst(cell: &Cell) -> &str {
    if let Outcome::Completed { worst, .. } = &cell.outcome { worst } else { "" }
}

fn seconds(cell: &Cell) -> &[f64] {
    match &cell.outcome {
        Outcome::Completed { cpu_seconds, .. } => cpu_seconds,
        Outcome::Failed { cpu_seconds, .. } | Outcome::TooSlow { cpu_seconds, .. } => std::slice::from_ref(cpu_seconds),
        Outcome::Skipped { .. } => &[],
    }
}

/// Counted work of a completed run.
fn work(cell: &Cell, count: fn(&Statistics) -> u64) -> String {
    match &cell.outcome {
        Outcome::Completed { statistics, .. } => count(statistics).to_string(),
        _ => String::new(),
    }
}
