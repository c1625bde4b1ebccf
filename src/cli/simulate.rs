//! `holonom simulate SCENE`

use super::common::{Output, command_line, fail};
use super::interrupt;
use super::run::{Done, Ready, RunOptions};
use crate::analysis::Record;
use crate::error::{Error, Result};
use crate::files::{mat, npz};
use crate::prepared::Model;
use crate::report::{self, Answer, Ending, Folder, RowFiles, Shown, Summary};
use crate::system::Scratch;
use crate::view::{Extras, ShownMotion, page};
use serde::Serialize;
use std::cell::RefCell;
use std::process::ExitCode;

#[derive(clap::Args)]
#[command(after_help = "Examples:
  holonom simulate models/andrews.json
  holonom simulate models/pendulum.json --set l=2 --until 3 --rtol 1e-10 --format csv,mat")]
pub struct Args {
    #[command(flatten)]
    options: RunOptions,
    #[command(flatten)]
    output: Output,
    /// Formats of the trajectory: text, arrays of NumPy, arrays of MATLAB
    #[arg(long, value_enum, value_name = "FORMAT[,FORMAT...]", value_delimiter = ',', default_value = "csv")]
    format: Vec<Format>,
    /// One panel an output in its figure (default: one for those of a unit whose ranges are alike)
    #[arg(long)]
    separate: bool,
    /// The page of `holonom view`, too
    #[arg(long, conflicts_with = "outputs_only")]
    view: bool,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
enum Format {
    Csv,
    Npz,
    Mat,
}

pub fn run(args: Args) -> Result<ExitCode> {
    let ready = args.options.ready(args.keeps_rows())?;
    let Ready { model, span, early, .. } = &ready;
    let talk = &args.options.common.talk;
    let mut folder = args.output.folder(&model.name)?;
    // Printed before a run that may take long, and not again.
    talk.warn(&early[model.doubts.len()..]);
    let bar = talk.progress(1000, &model.name);
    let fraction = |t: f64| (1000.0 * (t - span.start) / (span.end - span.start)) as u64;
    let rows = RefCell::new(args.row_files(&ready, &mut folder)?);
    let mut recorder = ready
        .recorder()
        .with_progress(|t| bar.set_position(fraction(t)))
        .with_stop(|| rows.borrow().stop().or_else(|| interrupt::stop(&folder)));
    if !args.keeps_rows() {
        recorder = recorder.with_rows(ready.curves(), |row| rows.borrow_mut().add(&row));
    }
    let mut done = ready.run(recorder)?;
    bar.finish_and_clear();
    let mut rows = rows.into_inner();
    if args.keeps_rows() {
        rows.add_all(&done.record);
    }
    rows.finish()?;
    if args.options.check_error && done.summary.failure.is_none() {
        let bar = talk.progress(1000, &format!("{}: the error", model.name));
        done = done.checked(&ready, |t| bar.set_position(fraction(t)), || interrupt::stop(&folder));
    }
    let Done { record, mut summary, .. } = done;
    summary.origin.command = command_line();
    let answer = Simulated { args: &args, prepared: model, record: &record, summary: &summary };
    talk.publish(folder, "summary", None, &answer)?;
    talk.warn(&summary.origin.warnings[early.len()..]);
    match &summary.failure {
        // What ended the second run is a warning.
        None if args.options.check_error && interrupt::is_asked() => Ok(ExitCode::from(1)),
        None => Ok(ExitCode::SUCCESS),
        Some(failure) => fail(Error::from(failure.clone())),
    }
}

impl Args {
    /// True if all rows are needed at the end: arrays have their size first, errors compare all rows of two runs, and a
    /// page shows the coordinates.
    fn keeps_rows(&self) -> bool {
        self.options.check_error || self.view || self.format.iter().any(|format| *format != Format::Csv)
    }

    fn row_files(&self, ready: &Ready, folder: &mut Folder) -> Result<RowFiles> {
        let (q, v) = ready.model.start();
        let columns = ready.columns();
        let headings = self.format.contains(&Format::Csv).then(|| columns.headings());
        let energy = ready.model.system().energy(0.0, q, v, &mut Scratch::default());
        RowFiles::new(folder, headings, energy.is_some())
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
        let outputs = report::outputs_figure(name, &record.trajectory, summary.error.as_ref(), &shown, args.separate);
        folder.figure("outputs", outputs)?;
        folder.figure("drift", report::drift_figure(name, record, &shown, length))?;
        folder.figure("energy", report::energy_figure(name, record, &shown))?;
        if args.view && shown.rows > 0 {
            let run = ShownMotion {
                rows: shown.rows,
                drift: &record.drift_rows,
                energy: &record.ledger_rows,
                bars: summary.error.as_ref(),
                ..ShownMotion::new(prepared, &record.trajectory)
            };
            folder.write(
                "view.html",
                page(&run, &Extras { notes: shown.note().into_iter().collect(), ..Extras::default() }).as_bytes(),
            )?;
        }
        Ok(())
    }
}
