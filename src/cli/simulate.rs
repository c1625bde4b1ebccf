//! `holonom simulate SCENE`

use super::common::{Common, Output, tell};
use super::{interrupt, restart};
use crate::analysis::{Record, Recorder};
use crate::compare::check_error;
use crate::error::{Error, Result, Warning};
use crate::files::{mat, npz};
use crate::prepared::PreparedScene;
use crate::report::{self, Folder, Sealed, Summary, summarize};
use crate::simulate::{Span, Start};
use crate::trajectory::recorded;
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
    /// Run again at a tenth of the tolerance, or half the step, and tell by how much each output differs
    #[arg(long)]
    check_error: bool,
    /// Go on from the end of another run of this scene, its summary.json, to a later --until
    #[arg(long, value_name = "FILE", conflicts_with_all = ["check_error", "equilibrium"])]
    start: Option<PathBuf>,
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
    let saved = args.start.as_ref().map(|path| restart::read(path, &prepared)).transpose()?;
    let doubt = saved.as_ref().and_then(|saved| restart::doubt(saved, &prepared));
    let mut folder = args.output.folder(&prepared.name)?;
    let stiffness = prepared.stiffness(span);
    // Printed before a run that may take long, and not again.
    let of_method = stiffness.as_ref().map(Warning::from).into_iter().chain(prepared.method.doubts(prepared.system()));
    let early: Vec<Warning> = prepared.doubts.iter().cloned().chain(of_method).chain(doubt).collect();
    args.common.talk.warn(&early[prepared.doubts.len()..]);
    let bar = args.common.talk.progress(1000, &prepared.name);
    let fraction = |t: f64| (1000.0 * (t - span.start) / (span.end - span.start)) as u64;
    let mut recorder = Recorder::new(prepared.system())
        .with_progress(|t| bar.set_position(fraction(t)))
        .with_stop(|| interrupt::stop(&folder));
    if args.outputs_only {
        recorder = recorder.with_outputs_only();
    }
    let clock = Instant::now();
    let (q, v) = prepared.start();
    let start = saved.as_ref().map_or(Start::State(q, v), Start::Saved);
    let (outcome, legs, saved) = prepared.simulate_from(&prepared.method, span, start, &mut recorder)?;
    let seconds = clock.elapsed().as_secs_f64();
    let record = recorder.finish();
    bar.finish_and_clear();
    let mut summary = summarize((&prepared, stiffness, &early), (&outcome, &legs), &record, seconds);
    (summary.origin.command, summary.restart) = (std::env::args().collect(), saved);
    let summary = match args.check_error && summary.failure.is_none() {
        true => {
            let bar = args.common.talk.progress(1000, &format!("{}: the error", prepared.name));
            let watch = (|t: f64| bar.set_position(fraction(t)), || interrupt::stop(&folder));
            let check = check_error(&prepared, span, &record.trajectory, watch);
            bar.finish_and_clear();
            summary.checked(check)
        }
        false => summary,
    };
    let sealed = write((&prepared, &record, &summary), &mut folder, &args)?;
    let written = args.common.talk.finish(folder)?;
    args.common.talk.print(&sealed, || summary.text(&units(&record)))?;
    args.common.talk.tell_files(&written)?;
    args.common.talk.warn(&summary.origin.warnings[early.len()..]);
    Ok(match &summary.failure {
        None => ExitCode::SUCCESS,
        Some(failure) => {
            tell(format!("error: {}", Error::from(failure.clone())));
            ExitCode::from(1)
        }
    })
}

impl Args {
    /// Returns the time span, if its rows fit into memory.
    fn span(&self, prepared: &PreparedScene) -> Result<Span> {
        if !self.outputs_only {
            return self.common.span(prepared);
        }
        match recorded(prepared.system()).len() {
            0 => Err(Error::input("--outputs-only leaves nothing to write: the scene has no outputs")
                .hint("give it `outputs`, or run without --outputs-only")),
            outputs => self.common.span_with(prepared, 1 + outputs),
        }
    }
}

fn write<'s>(
    (prepared, record, summary): (&PreparedScene, &Record, &'s Summary),
    folder: &mut Folder,
    Args { output, format, .. }: &Args,
) -> Result<Sealed<&'s Summary>> {
    let arrays = || report::trajectory_arrays(&record.trajectory);
    for format in format {
        match format {
            Format::Csv => folder.write("trajectory.csv", &report::trajectory_table(&record.trajectory)?)?,
            Format::Npz => folder.write("trajectory.npz", &npz::write(&arrays())?)?,
            Format::Mat => folder.write("trajectory.mat", &mat::write(&arrays())?)?,
        }
    }
    folder.write("drift.csv", &report::drift_table(record)?)?;
    if record.energy.is_some() {
        folder.write("energy.csv", &report::energy_table(record)?)?;
    }
    output.figure(folder, "outputs", report::outputs_figure(&prepared.name, &record.trajectory))?;
    output.figure(folder, "drift", report::drift_figure(&format!("{}: drift", prepared.name), record))?;
    output.figure(folder, "energy", report::energy_figure(&format!("{}: energy", prepared.name), record))?;
    folder.seal("summary.json", summary)
}

fn units(record: &Record) -> Vec<(String, String)> {
    record.trajectory.outputs.iter().map(|column| (column.name.clone(), column.unit.clone())).collect()
}
