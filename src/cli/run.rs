//! One run, for the command `simulate` and for the Python package.

use super::common::Common;
use super::restart;
use crate::analysis::{Record, Recorder};
use crate::error::{Error, Result, Warning};
use crate::formulation::Statistics;
use crate::prepared::Model;
use crate::report::{MOST_COORDINATES, Summary, summarize};
use crate::simulate::{Checkpoint, Leg, Span, Start, Stiffness, Stop, spread};
use crate::study::{Completed, error_bars};
use crate::system::Dimensions;
use crate::trajectory::{Trajectory, recorded};
use std::path::PathBuf;
use std::time::Instant;

/// The scene, how to solve it, and from where.
#[derive(clap::Args)]
pub struct RunOptions {
    #[command(flatten)]
    pub common: Common,
    /// Leave coordinates, velocities and multipliers out of the trajectory
    #[arg(long)]
    pub outputs_only: bool,
    /// Give each output an error bar, from a second run with ten times the tolerance or twice the step
    #[arg(long)]
    pub check_error: bool,
    /// Go on from the end of another run of this scene, its summary.json, to a later --until
    #[arg(long, value_name = "FILE", conflicts_with_all = ["check_error", "equilibrium"])]
    start: Option<PathBuf>,
    /// The scene was changed on purpose since the run that --start names
    #[arg(long, requires = "start")]
    changed: bool,
}

/// A model with all that its run begins with.
pub struct Ready<'o> {
    pub model: Model,
    pub span: Span,
    /// Warnings from before the run, those of the model first.
    pub early: Vec<Warning>,
    options: &'o RunOptions,
    stiffness: Option<Stiffness>,
    saved: Option<Checkpoint>,
}

/// A run that has ended.
pub struct Done {
    pub record: Record,
    pub summary: Summary,
    legs: Vec<Leg>,
    statistics: Statistics,
}

impl RunOptions {
    /// Reads the scene, and the run that this one continues. All rows stay in memory if `keeps_rows`.
    pub fn ready(&self, keeps_rows: bool) -> Result<Ready<'_>> {
        let model = self.common.load()?;
        let span = self.span(&model, keeps_rows)?;
        let saved = self.start.as_ref().map(|path| restart::read(path, &model, self.changed)).transpose()?;
        let doubt = saved.as_ref().and_then(|saved| restart::doubt(saved, &model));
        let stiffness = model.stiffness(span);
        let of_method = stiffness.as_ref().map(Warning::from).into_iter().chain(model.method.doubts(model.system()));
        let early = model.doubts.iter().cloned().chain(of_method).chain(doubt).collect();
        Ok(Ready { model, span, early, options: self, stiffness, saved })
    }

    /// Returns the time span, if its rows fit into memory, or into a file.
    fn span(&self, model: &Model, keeps_rows: bool) -> Result<Span> {
        let Dimensions { q, v, lambda, .. } = model.system().dimensions();
        let outputs = recorded(model.system()).len();
        if self.outputs_only && outputs == 0 {
            return Err(Error::input("--outputs-only leaves nothing to write: the scene has no outputs")
                .hint("give it `outputs`, or run without --outputs-only"));
        }
        let columns = 1 + outputs + if self.outputs_only { 0 } else { q + v + lambda };
        self.common.span_with(model, columns, keeps_rows)
    }
}

impl Ready<'_> {
    /// The columns of the rows, without rows.
    pub fn columns(&self) -> Trajectory {
        let system = self.model.system();
        if self.options.outputs_only { Trajectory::of_outputs(system, 0) } else { Trajectory::new(system) }
    }

    /// A recorder of the columns.
    pub fn recorder(&self) -> Recorder<'_> {
        let recorder = Recorder::new(self.model.system()).with_jumps();
        if self.options.outputs_only { recorder.with_outputs_only() } else { recorder }
    }

    /// Number of coordinates whose curves are kept where rows are passed on.
    pub fn curves(&self) -> usize {
        if recorded(self.model.system()).is_empty() { MOST_COORDINATES } else { 0 }
    }

    /// Simulates, on all threads for large systems.
    pub fn run(&self, mut recorder: Recorder) -> Result<Done> {
        let Ready { model, span, early, stiffness, saved, .. } = self;
        let clock = Instant::now();
        let (q, v) = model.start();
        let start = saved.as_ref().map_or(Start::State(q, v), Start::Saved);
        let (outcome, legs, restart) =
            on_all_threads(|| model.simulate_from(&model.method, *span, start, &mut recorder))?;
        let seconds = clock.elapsed().as_secs_f64();
        let record = recorder.finish();
        let mut summary = summarize(model, stiffness.clone(), early, &outcome, &legs, &record, seconds);
        summary.restart = restart;
        Ok(Done { record, summary, legs, statistics: outcome.statistics })
    }
}

impl Done {
    /// Gives the outputs error bars by a second run; `show` gets its times, and `stop` ends it.
    #[must_use]
    pub fn checked(self, ready: &Ready, show: impl Fn(f64), stop: impl Fn() -> Option<Stop> + Sync) -> Done {
        let Done { record, summary, legs, statistics } = self;
        let run = Completed { span: ready.span, trajectory: &record.trajectory, legs: &legs, statistics };
        let bars = on_all_threads(|| error_bars(&ready.model, run, show, stop));
        Done { summary: summary.checked(bars), record, legs, statistics }
    }
}

/// Calls `work` with all threads for large systems: this one becomes one of the pool, unless there is one.
fn on_all_threads<R>(work: impl FnOnce() -> R) -> R {
    // An error says that there is a pool already, and then that one serves.
    let _ = rayon::ThreadPoolBuilder::new().use_current_thread().build_global();
    spread(work)
}
