//! The motion that errors are measured against.

use super::subject::Subject;
use crate::choice::Choice;
use crate::measure::{Record, Recorder};
use crate::simulate::{Method, Stop, simulate};
use crate::trajectory::Trajectory;
use std::time::{Duration, Instant};

/// Outputs at the rows of a tight solution.
pub struct Reference {
    rows: Vec<Vec<f64>>,
    /// The largest value of each output.
    sizes: Vec<f64>,
}

const TIGHT: f64 = 1e-13;

impl Reference {
    /// The motion of the subject as it is, by `dop853` or, where that does not get there in time, `radau_iia`. None where
    /// neither does.
    pub fn of(subject: &Subject, allowed: Duration) -> Option<Self> {
        let choices = [("index1", "dop853", "manifold"), ("ggl", "radau_iia", "none")];
        choices.into_iter().find_map(|(formulation, integrator, projection)| {
            let [formulation, integrator, projection] = [formulation, integrator, projection].map(Choice::named);
            let method = Method { formulation, integrator, projection, rtol: TIGHT, atol: TIGHT, step: None };
            Self::by(subject, method, allowed)
        })
    }

    fn by(subject: &Subject, method: Method, allowed: Duration) -> Option<Self> {
        let mut case = subject.base.clone();
        case.method = method;
        let clock = Instant::now();
        let stop = || (clock.elapsed() > allowed).then(|| Stop::deadline(allowed));
        let rows = subject.with(&case, |system, span, start| {
            let mut recorder = Recorder::new(system).with_stop(stop);
            let outcome = simulate(system, &case.method, span, start, &mut recorder)?;
            Ok(outcome.failure.is_none().then(|| watched(&recorder.finish())))
        });
        let rows = rows.ok()??;
        let size = |i: usize| rows.iter().fold(0.0, |size: f64, row| size.max(row[i].abs()));
        let sizes = (0..rows.first()?.len()).map(size).collect();
        Some(Reference { rows, sizes })
    }

    /// The largest error of an output as a part of its largest value; none where rows are missing.
    pub fn error(&self, record: &Record) -> Option<f64> {
        let found = watched(record);
        if found.len() != self.rows.len() {
            return None;
        }
        let error = |(found, exact): (&Vec<f64>, &Vec<f64>)| {
            let values = found.iter().zip(exact).zip(&self.sizes).filter(|(_, size)| **size > 0.0);
            values.fold(0.0, |error: f64, ((found, exact), size)| error.max((found - exact).abs() / size))
        };
        Some(found.iter().zip(&self.rows).map(error).fold(0.0, f64::max))
    }
}

/// Outputs by row; coordinates where there are none.
fn watched(record: &Record) -> Vec<Vec<f64>> {
    let trajectory: &Trajectory = &record.trajectory;
    let row = |row: &Vec<f64>| match trajectory.outputs.is_empty() {
        true => trajectory.row_state(row).0.to_vec(),
        false => trajectory.row_outputs(row).to_vec(),
    };
    trajectory.rows.iter().map(row).collect()
}
