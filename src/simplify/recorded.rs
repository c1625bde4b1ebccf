//! A run of the full model with its states.

use super::grid::rows_on_grid;
use super::run::counted;
use crate::analysis::{Singularity, SingularityWatch, Sizes};
use crate::error::{Failure, INTERRUPTED, Result};
use crate::linearize::State;
use crate::prepared::Model;
use crate::simulate::{Method, Observation, Sink, Span};
use crate::study::{Motion, Watched};
use crate::system::{MechanicalSystem, Scratch};

/// Watched rows, states and sizes of a run.
#[derive(Clone, Default)]
pub struct Recorded {
    /// Values of the watched outputs at each time.
    pub rows: Vec<Vec<f64>>,
    /// Sizes of the motion.
    pub sizes: Sizes,
    /// Why and when it was stopped; none where it is complete.
    pub stopped: Option<Failure>,
    /// Counted work.
    pub work: f64,
    /// State of each row.
    pub states: Vec<State>,
    /// Rows of G that were found redundant, at most.
    pub redundant: Vec<usize>,
    /// Singular states on the way.
    pub singularity: Singularity,
}

impl Recorded {
    /// Time of the last row, s.
    pub fn end(&self) -> f64 {
        self.states.last().map_or(f64::NEG_INFINITY, |state| state.t)
    }

    /// Forgets the last row of a run that was stopped if that is where it was stopped, between the rows of others.
    pub fn end_on_grid(&mut self, span: Span) {
        if self.stopped.is_some() {
            let times = self.states.iter().map(|state| state.t);
            let count = rows_on_grid(times, span.start, span.output_step);
            self.rows.truncate(count);
            self.states.truncate(count);
        }
    }
}

/// Runs a model by `method` over its own span, until `is_stopped`, and records it.
///
/// # Errors
/// Bad input, and the failure of a run that does not complete for another reason.
pub fn record(
    prepared: &Model,
    watched: &Watched,
    method: &Method,
    is_stopped: &(dyn Fn() -> bool + Sync),
) -> Result<Recorded> {
    let system = prepared.system();
    let mut recorder = RunRecorder {
        system,
        watched,
        scratch: Scratch::default(),
        scales: system.facts().scales.clone(),
        recorded: Recorded::default(),
        watch: SingularityWatch::new(system),
    };
    let motion = Motion::of(prepared, prepared.span()?, watched.clone(), is_stopped);
    let outcome = motion.simulate(method, None, &mut recorder)?.outcome;
    let work = counted(prepared, method, outcome.statistics);
    let singularity = recorder.watch.finish();
    let left = singularity.failure();
    let recorded = Recorded { work, singularity, ..recorder.recorded };
    match outcome.failure.or(left) {
        None => Ok(recorded),
        Some(failure) if failure.reason == INTERRUPTED => Ok(Recorded { stopped: Some(failure), ..recorded }),
        Some(failure) => {
            Err(Failure { reason: format!("the full model does not complete: {}", failure.reason), ..failure }.into())
        }
    }
}

struct RunRecorder<'a> {
    system: &'a dyn MechanicalSystem,
    watched: &'a Watched,
    scratch: Scratch,
    scales: Vec<f64>,
    recorded: Recorded,
    watch: SingularityWatch<'a>,
}

impl Sink for RunRecorder<'_> {
    fn accepted(&mut self, state: &Observation) {
        self.watch.add(state);
    }

    fn row(&mut self, state: &Observation) {
        let Recorded { rows, sizes, states, redundant, .. } = &mut self.recorded;
        sizes.add(self.system, state, &self.scales, &mut self.scratch);
        states.push(State { t: state.t, q: state.q.to_vec(), v: state.v.to_vec() });
        if state.dropped.len() > redundant.len() {
            *redundant = state.dropped.to_vec();
        }
        rows.push(self.watched.read_row(self.system, state, &mut self.scratch));
    }
}
