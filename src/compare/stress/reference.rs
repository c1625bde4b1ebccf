//! The motion that errors are measured against.

use super::deadline::{Deadline, Limits};
use super::subject::Case;
use super::subject::Subject;
use crate::analysis::{Record, Recorder, Sizes, scales};
use crate::method_spec::MethodSpec;
use crate::simulate::{Method, Observation, Sink, Stop, simulate};
use crate::system::{Column, MechanicalSystem, Scratch};
use crate::tolerances::report as tolerances;
use crate::trajectory::Trajectory;
use std::time::Duration;

/// Rows of the watched quantities: outputs, or coordinates where the scene names none.
pub(super) type WatchedRows = Vec<Vec<f64>>;

/// The watched quantities along an accurate solution.
pub(super) struct Reference {
    pub names: Vec<String>,
    rows: WatchedRows,
    /// Scale of each quantity.
    scales: Vec<f64>,
}

/// Result of the search for a reference.
pub(super) enum Search {
    /// It takes more time; the part of the motion completed.
    Pending(f64),
    Found(Reference),
    /// No method completes the motion.
    Hopeless,
}

/// An explicit and an implicit method, one of which suits.
const METHODS: [[&str; 3]; 2] = [["index1", "dop853", "manifold"], ["ggl", "radau_iia", "none"]];

impl Search {
    /// Simulates the motion of the case, by the first method that completes it within the CPU time allowed to each.
    pub fn run(subject: &Subject, case: &Case, allowed: Duration, limits: Limits) -> Self {
        let mut search = Search::Hopeless;
        for names in METHODS {
            let [formulation, integrator, projection] = names.map(MethodSpec::named);
            let method = Method {
                formulation,
                integrator,
                projection,
                rtol: tolerances::REFERENCE_RTOL,
                atol: tolerances::REFERENCE_RTOL,
                step: None,
            };
            match Self::by(subject, Case { method, ..case.clone() }, allowed, limits) {
                Search::Hopeless => {}
                Search::Pending(part) => search = Search::Pending(part.max(search.part())),
                found => return found,
            }
        }
        search
    }

    fn part(&self) -> f64 {
        if let Search::Pending(part) = self { *part } else { 0.0 }
    }

    fn by(subject: &Subject, case: Case, allowed: Duration, limits: Limits) -> Self {
        let deadline = Deadline::new(allowed, limits);
        let found = subject.with(&case, |system, span, start| {
            let recorder = Recorder::new(system).with_stop(|| deadline.is_over().then(|| Stop::deadline(allowed)));
            let (sizes, scales, scratch) = (Sizes::default(), system.scales(), Scratch::default());
            let mut measured = Measured { recorder, system, sizes, scales, scratch };
            let outcome = simulate(system, &case.method, span, start, &mut measured)?;
            let Measured { recorder, sizes, .. } = measured;
            Ok(match outcome.failure {
                None => Search::Found(Reference::new(system, &recorder.finish(), &sizes)),
                Some(_) if deadline.is_over() => Search::Pending((outcome.t - span.start) / case.duration),
                Some(_) => Search::Hopeless,
            })
        });
        found.unwrap_or(Search::Hopeless)
    }
}

impl Reference {
    fn new(system: &dyn MechanicalSystem, record: &Record, sizes: &Sizes) -> Self {
        let rows = watched(record);
        let columns = match record.trajectory.outputs.is_empty() {
            true => system.names().q.into_iter().map(|name| Column { name, unit: String::new() }).collect(),
            false => record.trajectory.outputs.clone(),
        };
        let scales = scales(&columns, &rows, sizes);
        Reference { names: columns.into_iter().map(|column| column.name).collect(), rows, scales }
    }

    /// Returns the largest difference of each quantity over its scale; infinite where rows are missing.
    pub fn errors(&self, rows: &WatchedRows) -> Vec<f64> {
        let error = |i: usize| {
            let pairs = rows.iter().zip(&self.rows).map(|(found, exact)| (found[i], exact[i]));
            // Where the output is not defined, there is nothing to compare.
            let differences = pairs.filter(|pair| pair.1.is_finite()).map(|(found, exact)| (found - exact).abs());
            differences.fold(0.0, |most: f64, one| if one > most || one.is_nan() { one } else { most }) / self.scales[i]
        };
        let is_whole = rows.len() == self.rows.len();
        (0..self.names.len()).map(|i| if is_whole { error(i) } else { f64::INFINITY }).collect()
    }
}

pub(super) fn watched(record: &Record) -> WatchedRows {
    let trajectory: &Trajectory = &record.trajectory;
    let row = |row: &Vec<f64>| match trajectory.outputs.is_empty() {
        true => trajectory.row_state(row).0.to_vec(),
        false => trajectory.row_outputs(row).to_vec(),
    };
    trajectory.rows.iter().map(row).collect()
}

/// Records a motion with the sizes that its errors are relative to.
struct Measured<'a> {
    recorder: Recorder<'a>,
    system: &'a dyn MechanicalSystem,
    sizes: Sizes,
    scales: Vec<f64>,
    scratch: Scratch,
}

impl Sink for Measured<'_> {
    fn accepted(&mut self, state: &Observation) {
        self.recorder.accepted(state);
    }

    fn row(&mut self, state: &Observation) {
        self.sizes.add(self.system, state, &self.scales, &mut self.scratch);
        self.recorder.row(state);
    }

    fn stops(&self) -> Option<Stop> {
        self.recorder.stops()
    }
}
