//! Table of all runs.

use crate::compare::work_precision::{Cell, Outcome, WorkPrecision};
use crate::error::Result;
use crate::report::{cell as number, table};

const HEADINGS: [&str; 26] = [
    "formulation",
    "integrator",
    "projection",
    "rtol",
    "atol",
    "step",
    "status",
    "digits",
    "error",
    "worst",
    "cost",
    "cpu_seconds",
    "fastest",
    "slowest",
    "repeats",
    "position_drift",
    "velocity_drift",
    "steps",
    "rejected",
    "rhs_evaluations",
    "jacobian_evaluations",
    "factorizations",
    "newton_iterations",
    "projections",
    "row_evaluations",
    "reason",
];

/// Returns one row for each run, failures with their reason.
///
/// # Errors
/// Only those of the table's writer.
pub fn tradeoff_table(measured: &WorkPrecision) -> Result<Vec<u8>> {
    table(HEADINGS.map(String::from).into_iter(), measured.cells.iter().map(row))
}

fn row(cell: &Cell) -> Vec<String> {
    let method = &cell.method;
    let names = [&method.formulation, &method.integrator, &method.projection].map(ToString::to_string);
    let step = method.step.map_or(String::new(), number);
    let mut row: Vec<String> = names.into_iter().chain([number(method.rtol), number(method.atol), step]).collect();
    match &cell.outcome {
        Outcome::Completed { error, worst, drift, cpu_seconds, statistics: s } => {
            let extreme =
                |pick: fn(f64, f64) -> f64| cpu_seconds.iter().copied().reduce(pick).map_or(String::new(), number);
            let numbers = [cell.digits().unwrap_or(0.0), *error].map(number);
            row.extend(["completed".to_string()].into_iter().chain(numbers).chain([worst.clone()]));
            row.push(cell.cost.map_or(String::new(), number));
            row.extend([cell.seconds().map_or(String::new(), number), extreme(f64::min), extreme(f64::max)]);
            row.push(cpu_seconds.len().to_string());
            row.extend([drift.position, drift.velocity].map(number));
            let work = [
                s.steps,
                s.rejected,
                s.rhs_evaluations,
                s.jacobian_evaluations,
                s.factorizations,
                s.newton_iterations,
                s.projections,
                s.rows.rhs_evaluations,
            ];
            row.extend(work.map(|count| count.to_string()));
        }
        Outcome::Failed { cpu_seconds, .. } => {
            row.extend(["failed", "", "", "", ""].map(String::from).into_iter().chain([number(*cpu_seconds)]));
        }
        Outcome::TooSlow { cpu_seconds, .. } => {
            row.extend(["too_slow", "", "", "", ""].map(String::from).into_iter().chain([number(*cpu_seconds)]));
        }
        Outcome::Skipped { .. } => row.push("skipped".to_string()),
    }
    row.resize(HEADINGS.len() - 1, String::new());
    row.push(cell.reason().unwrap_or_default().to_string());
    row
}
