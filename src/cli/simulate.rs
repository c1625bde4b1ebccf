//! `holonom simulate SCENE`

use super::common::{Common, Output, command_line, fail};
use super::{interrupt, restart};
use crate::analysis::{Record, Recorder};
use crate::error::{Error, Result, Warning};
use crate::files::{mat, npz};
use crate::prepared::Model;
use crate::report::{self, Answer, Ending, Folder, RowFiles, Shown, Summary, summarize};
use crate::simulate::{Span, Start, spread};
use crate::study::{Completed, error_bars};
use crate::system::{Dimensions, Scratch};
use crate::trajectory::{Trajectory, recorded};
use crate::view::{Extras, Run, page};
use serde::Serialize;
use std::cell::RefCell;
use std::path::PathBuf;
use std::process::ExitCode;
use std::time::Instant;

#[derive(clap::Args)]
#[command(after_help = "Examples:
  holonom simulate models/andrews.json
  holonom simulate models/pendulum.json --set l=2 --until 3 --rtol 1e-10 --format csv,mat")]
pub struct Args {
    #[command(flatten)]
    common: Common,
    #[command(flatten)]
    output: Output,
    /// Formats of the trajectory: text, arrays of NumPy, arrays of MATLAB
    #[arg(long, value_enum, value_name = "FORMAT[,FORMAT...]", value_delimiter = ',', default_value = "csv")]
    format: Vec<Format>,
    /// Leave coordinates, velocities and multipliers out of the trajectory
    #[arg(long)]
    outputs_only: bool,
    /// One panel an output in its figure (default: one for those of a unit whose ranges are alike)
    #[arg(long)]
    separate: bool,
    /// The page of `holonom view`, too
    #[arg(long, conflicts_with = "outputs_only")]
    view: bool,
    /// Give each output an error bar, from a second run with ten times the tolerance or twice the step
    #[arg(long)]
    check_error: bool,
    /// Go on from the end of another run of this scene, its summary.json, to a later --until
    #[arg(long, value_name = "FILE", conflicts_with_all = ["check_error", "equilibrium"])]
    start: Option<PathBuf>,
    /// The scene was changed on purpose since the run that --start names
    #[arg(long, requires = "start")]
    changed: bool,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
enum Format {
    Csv,
    Npz,
    Mat,
}

pub fn run(args: Args) -> Result<ExitCode> {
    let prepared = args.common.load()?;
    let span = args.span(&prepared)?;
    let saved = args.start.as_ref().map(|path| restart::read(path, &prepared, args.changed)).transpose()?;
    let doubt = saved.as_ref().and_then(|saved| restart::doubt(saved, &prepared));
    let mut folder = args.output.folder(&prepared.name)?;
    let stiffness = prepared.stiffness(span);
    // Printed before a run that may take long, and not again.
    let of_method = stiffness.as_ref().map(Warning::from).into_iter().chain(prepared.method.doubts(prepared.system()));
    let early: Vec<Warning> = prepared.doubts.iter().cloned().chain(of_method).chain(doubt).collect();
    args.common.talk.warn(&early[prepared.doubts.len()..]);
    let bar = args.common.talk.progress(1000, &prepared.name);
    let fraction = |t: f64| (1000.0 * (t - span.start) / (span.end - span.start)) as u64;
    let rows = RefCell::new(args.row_files(&prepared, &mut folder)?);
    let mut recorder = Recorder::new(prepared.system())
        .with_jumps()
        .with_progress(|t| bar.set_position(fraction(t)))
        .with_stop(|| rows.borrow().stop().or_else(|| interrupt::stop(&folder)));
    if args.outputs_only {
        recorder = recorder.with_outputs_only();
    }
    if !args.keeps_rows() {
        let coordinates = if recorded(prepared.system()).is_empty() { report::MOST_COORDINATES } else { 0 };
        recorder = recorder.with_rows(coordinates, |row| rows.borrow_mut().add(&row));
    }
    let clock = Instant::now();
    let (q, v) = prepared.start();
    let start = saved.as_ref().map_or(Start::State(q, v), Start::Saved);
    let (outcome, legs, saved) =
        on_all_threads(|| prepared.simulate_from(&prepared.method, span, start, &mut recorder))?;
    let seconds = clock.elapsed().as_secs_f64();
    let record = recorder.finish();
    bar.finish_and_clear();
    let mut rows = rows.into_inner();
    if args.keeps_rows() {
        rows.add_all(&record);
    }
    rows.finish()?;
    let mut summary = summarize((&prepared, stiffness, &early), (&outcome, &legs), &record, seconds);
    summary.origin.command = command_line();
    summary.restart = saved;
    let summary = if args.check_error && summary.failure.is_none() {
        let bar = args.common.talk.progress(1000, &format!("{}: the error", prepared.name));
        let show = |t: f64| bar.set_position(fraction(t));
        let stop = || interrupt::stop(&folder);
        let run = Completed { span, trajectory: &record.trajectory, legs: &legs, statistics: outcome.statistics };
        summary.checked(on_all_threads(|| error_bars(&prepared, run, show, stop)))
    } else {
        summary
    };
    let answer = Simulated { args: &args, prepared: &prepared, record: &record, summary: &summary };
    args.common.talk.publish(folder, "summary", None, &answer)?;
    args.common.talk.warn(&summary.origin.warnings[early.len()..]);
    match &summary.failure {
        // What ended the second run is a warning.
        None if args.check_error && interrupt::is_asked() => Ok(ExitCode::from(1)),
        None => Ok(ExitCode::SUCCESS),
        Some(failure) => fail(Error::from(failure.clone())),
    }
}

/// Calls `work` with all threads for large systems: this one becomes one of the pool, unless there is one.
fn on_all_threads<R>(work: impl FnOnce() -> R) -> R {
    // An error says that there is a pool already, and then that one serves.
    let _ = rayon::ThreadPoolBuilder::new().use_current_thread().build_global();
    spread(work)
}

impl Args {
    /// Returns the time span, if its rows fit into memory, or into a file.
    fn span(&self, prepared: &Model) -> Result<Span> {
        let Dimensions { q, v, lambda, .. } = prepared.system().dimensions();
        let outputs = recorded(prepared.system()).len();
        if self.outputs_only && outputs == 0 {
            return Err(Error::input("--outputs-only leaves nothing to write: the scene has no outputs")
                .hint("give it `outputs`, or run without --outputs-only"));
        }
        let columns = 1 + outputs + if self.outputs_only { 0 } else { q + v + lambda };
        self.common.span_with(prepared, columns, self.keeps_rows())
    }

    /// True if all rows are needed at the end: arrays have their size first, errors compare all rows of two runs, and a
    /// page shows the coordinates.
    fn keeps_rows(&self) -> bool {
        self.check_error || self.view || self.format.iter().any(|format| *format != Format::Csv)
    }

    fn row_files(&self, prepared: &Model, folder: &mut Folder) -> Result<RowFiles> {
        let (system, (q, v)) = (prepared.system(), prepared.start());
        let trajectory = if self.outputs_only { Trajectory::of_outputs(system, 0) } else { Trajectory::new(system) };
        let headings = self.format.contains(&Format::Csv).then(|| trajectory.headings());
        RowFiles::new(folder, headings, system.energy(0.0, q, v, &mut Scratch::default()).is_some())
    }
}

struct Simulated<'a> {
    args: &'a Args,
    prepared: &'a Model,
    record: &'a Record,
    summary: &'a Summary,
}

impl Answer for Simulated<'_> {
    fn json(&self) -> impl Serialize {
        self.summary
    }

    fn text(&self) -> String {
        self.summary.text()
    }

    fn write(&self, folder: &mut Folder, _: &str) -> Result<()> {
        let Simulated { args, prepared, record, summary } = self;
        let arrays = || report::trajectory_arrays(&record.trajectory, summary.error.as_ref());
        for format in &args.format {
            match format {
                Format::Csv => {}
                Format::Npz => folder.write("trajectory.npz", &npz::write(&arrays())?)?,
                Format::Mat => folder.write("trajectory.mat", &mat::write(&arrays())?)?,
            }
        }
        let name = &prepared.name;
        let length = prepared.system().facts().length;
        let ending = Ending::of(summary.failure.as_ref(), &record.drift, record.energy.as_ref());
        let shown = Shown::of_run(ending, record, length);
        let outputs = report::outputs_figure(name, (&record.trajectory, summary.error.as_ref()), &shown, args.separate);
        folder.figure("outputs", outputs)?;
        folder.figure("drift", report::drift_figure(name, record, &shown, length))?;
        folder.figure("energy", report::energy_figure(name, record, &shown))?;
        if args.view && shown.rows > 0 {
            let run = Run {
                rows: shown.rows,
                drift: &record.drift_rows,
                energy: &record.ledger_rows,
                bars: summary.error.as_ref(),
                ..Run::new(prepared, &record.trajectory)
            };
            folder.write(
                "view.html",
                page(&run, &Extras { notes: shown.note().into_iter().collect(), ..Extras::default() }).as_bytes(),
            )?;
        }
        Ok(())
    }
}
