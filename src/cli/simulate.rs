//! `holonom simulate SCENE`

use super::common::{Common, Output, print, tell};
use super::interrupt;
use crate::error::Result;
use crate::measure::{Record, Recorder};
use crate::report::{self, Folder, Summary, summarize};
use crate::simulate::simulate;
use crate::study::Study;
use crate::trajectory::{Gap, Trajectory};
use std::process::ExitCode;
use std::time::Instant;

#[derive(clap::Args)]
pub struct Args {
    #[command(flatten)]
    common: Common,
    #[command(flatten)]
    output: Output,
}

/// Joints that are open by this part of the scene's size at the end deserve a warning.
const MEANINGLESS: f64 = 1e-2;

pub fn run(args: Args) -> Result<ExitCode> {
    let study = args.common.load()?;
    let span = args.common.span(&study)?;
    let mut folder = args.output.folder(&study.name)?;
    let stiffness = study.stiffness(span);
    if let Some(stiffness) = stiffness.as_ref().filter(|_| !args.common.talk.quiet) {
        tell(format!("warning: {stiffness}\n  help: {}", stiffness.advice));
    }
    let bar = args.common.talk.progress(1000, &study.name);
    let fraction = |t: f64| (1000.0 * (t - span.start) / (span.end - span.start)) as u64;
    let mut recorder = Recorder::new(study.system())
        .with_progress(|t| bar.set_position(fraction(t)))
        .with_stop(|| interrupt::stop(&folder));
    let clock = Instant::now();
    let outcome = simulate(study.system(), &study.method, span, study.start(), &mut recorder)?;
    let seconds = clock.elapsed().as_secs_f64();
    let record = recorder.finish();
    bar.finish_and_clear();
    let summary = Summary { stiffness, ..summarize(&study, &study.method, &outcome, &record, seconds) };
    write(&study, &record, &summary, &mut folder, &args.output)?;
    let written = folder.finish()?;
    args.common.talk.print(&summary, || summary.text(&units(&record)))?;
    if !args.common.talk.json && !args.common.talk.quiet {
        print(&format!("\nwritten to {}\n", written.listing()))?;
    }
    if !args.common.talk.quiet {
        warn(&summary, &record.trajectory);
    }
    Ok(match &summary.failure {
        None => ExitCode::SUCCESS,
        Some(failure) => {
            tell(format!("error: {}", crate::error::Error::from(failure.clone())));
            ExitCode::from(1)
        }
    })
}

/// What makes a motion doubtful although it was computed to the end.
fn warn(summary: &Summary, trajectory: &Trajectory) {
    for Gap { name, first, count } in trajectory.gaps() {
        tell(format!(
            "warning: the output `{name}` has no finite value at {count} of {} times, first at t = {first:.6} s: its cells are \
             empty\n  help: look for what it is not defined for",
            trajectory.rows.len()
        ));
    }
    let open = summary.drift.position.relative_final;
    if open > MEANINGLESS {
        tell(format!(
            "warning: the joints have come apart by {open:.1e} of the scene's size: the motion is not that of the scene\n  \
             help: choose a projection such as `manifold`, or a smaller step"
        ));
    }
}

fn write(study: &Study, record: &Record, summary: &Summary, folder: &mut Folder, output: &Output) -> Result<()> {
    folder.write("trajectory.csv", &report::trajectory_table(&record.trajectory)?)?;
    folder.write("drift.csv", &report::drift_table(record)?)?;
    if record.energy.is_some() {
        folder.write("energy.csv", &report::energy_table(record)?)?;
    }
    output.figure(folder, "outputs", report::outputs_figure(&study.name, record))?;
    output.figure(folder, "drift", report::drift_figure(&format!("{}: drift", study.name), record))?;
    output.figure(folder, "energy", report::energy_figure(&format!("{}: energy", study.name), record))?;
    folder.write_json("summary.json", summary)
}

fn units(record: &Record) -> Vec<(String, String)> {
    record.trajectory.outputs.iter().map(|column| (column.name.clone(), column.unit.clone())).collect()
}
