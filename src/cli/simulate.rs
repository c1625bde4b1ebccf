//! `holonom simulate SCENE`

use super::common::{Common, Output, tell};
use super::{interrupt, restart};
use crate::analysis::{Record, Recorder};
use crate::compare::check_error;
use crate::error::{Result, Warning};
use crate::prepared::PreparedScene;
use crate::report::{self, Folder, Summary, summarize};
use crate::simulate::Start;
use std::path::PathBuf;
use std::process::ExitCode;
use std::time::Instant;

#[derive(clap::Args)]
pub struct Args {
    #[command(flatten)]
    common: Common,
    #[command(flatten)]
    output: Output,
    /// Run again at a tenth of the tolerance, or half the step, and tell by how much each output differs
    #[arg(long)]
    check_error: bool,
    /// Go on from the end of another run of this scene, its summary.json, to a later --until
    #[arg(long, value_name = "FILE", conflicts_with_all = ["check_error", "equilibrium"])]
    start: Option<PathBuf>,
}

pub fn run(args: Args) -> Result<ExitCode> {
    let prepared = args.common.load()?;
    let span = args.common.span(&prepared)?;
    let saved = args.start.as_ref().map(|path| restart::read(path, &prepared)).transpose()?;
    let doubt = saved.as_ref().and_then(|saved| restart::doubt(saved, &prepared));
    let mut folder = args.output.folder(&prepared.name)?;
    let stiffness = prepared.stiffness(span);
    // Printed before a run that may take long, and not again.
    let of_method =
        stiffness.as_ref().map(Warning::from).into_iter().chain(prepared.method.beyond_reach(prepared.system()));
    let early: Vec<Warning> = prepared.doubts.iter().cloned().chain(of_method).chain(doubt).collect();
    args.common.talk.warn(&early[prepared.doubts.len()..]);
    let bar = args.common.talk.progress(1000, &prepared.name);
    let fraction = |t: f64| (1000.0 * (t - span.start) / (span.end - span.start)) as u64;
    let mut recorder = Recorder::new(prepared.system())
        .with_progress(|t| bar.set_position(fraction(t)))
        .with_stop(|| interrupt::stop(&folder));
    let clock = Instant::now();
    let (q, v) = prepared.start();
    let start = saved.as_ref().map_or(Start::State(q, v), Start::Saved);
    let (outcome, legs, saved) = prepared.simulate_from(&prepared.method, span, start, &mut recorder)?;
    let seconds = clock.elapsed().as_secs_f64();
    let record = recorder.finish();
    bar.finish_and_clear();
    let summary = Summary {
        command: std::env::args().collect(),
        restart: saved,
        ..summarize((&prepared, stiffness, &early), (&outcome, &legs), &record, seconds)
    };
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
    write(&prepared, &record, &summary, &mut folder, &args.output)?;
    let written = folder.finish()?;
    args.common.talk.print(&summary, || summary.text(&units(&record)))?;
    args.common.talk.tell_files(&written)?;
    args.common.talk.warn(&summary.warnings[early.len()..]);
    Ok(match &summary.failure {
        None => ExitCode::SUCCESS,
        Some(failure) => {
            tell(format!("error: {}", crate::error::Error::from(failure.clone())));
            ExitCode::from(1)
        }
    })
}

fn write(
    prepared: &PreparedScene,
    record: &Record,
    summary: &Summary,
    folder: &mut Folder,
    output: &Output,
) -> Result<()> {
    folder.write("trajectory.csv", &report::trajectory_table(&record.trajectory)?)?;
    folder.write("drift.csv", &report::drift_table(record)?)?;
    if record.energy.is_some() {
        folder.write("energy.csv", &report::energy_table(record)?)?;
    }
    output.figure(folder, "outputs", report::outputs_figure(&prepared.name, record))?;
    output.figure(folder, "drift", report::drift_figure(&format!("{}: drift", prepared.name), record))?;
    output.figure(folder, "energy", report::energy_figure(&format!("{}: energy", prepared.name), record))?;
    folder.write_json("summary.json", summary)
}

fn units(record: &Record) -> Vec<(String, String)> {
    record.trajectory.outputs.iter().map(|column| (column.name.clone(), column.unit.clone())).collect()
}
