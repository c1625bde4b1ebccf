//! Work-precision measurements of all methods, and recommendations.

use super::{Args, Question};
use crate::cli::common::fail;
use crate::cli::interrupt;
use crate::error::{Error, Result};
use crate::files;
use crate::prepared::Model;
use crate::report::tradeoff::MethodsAnswer;
use crate::report::{Folder, write_whole};
use crate::scene;
use crate::study::Motion;
use crate::study::work_precision::{GivenValues, Lack, Runner, WorkPrecision};
use std::hash::{DefaultHasher, Hash, Hasher};
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::time::{Duration, Instant};

pub fn run(args: &Args, prepared: &Model) -> Result<ExitCode> {
    let given = args.reference(prepared).as_deref().map(GivenValues::read).transpose()?;
    let question = args.question(prepared, args.budget, given)?;
    let folder = args.output.folder(&prepared.name)?;
    let place = folder.path().join("tradeoff.json");
    let mut measured = question.begin(args, prepared, &place)?;
    question.measure(args, prepared, &place, &mut measured)?;
    report(args, prepared, &measured, folder)
}

impl Question {
    /// Returns the results so far: none, or those that `--resume` finds.
    fn begin(&self, args: &Args, prepared: &Model, place: &Path) -> Result<WorkPrecision> {
        let span = prepared.span()?;
        let rows = self.plan.rows;
        let fresh = WorkPrecision {
            fingerprint: fingerprint(args, rows)?,
            ..WorkPrecision::fresh(&prepared.name, span.start, span.end, rows)
        };
        if args.resume { resumed(place, fresh) } else { Ok(fresh) }
    }

    fn measure(self, args: &Args, prepared: &Model, place: &Path, measured: &mut WorkPrecision) -> Result<()> {
        let span = prepared.span()?;
        let bar = args.talk.progress(1000, &prepared.name);
        let clock = Instant::now();
        let mut saved = Instant::now();
        let watch = |measured: &WorkPrecision, next: &str| {
            bar.set_position((1e3 * clock.elapsed().as_secs_f64() / args.budget.as_secs_f64()) as u64);
            bar.set_message(next.to_string());
            if saved.elapsed() > Duration::from_secs(5) {
                saved = Instant::now();
                // A failure to save is reported at the end.
                let _ = save(place, measured);
            }
        };
        let motion = Motion::of(prepared, span, self.watched, &interrupt::is_asked);
        Runner::new(motion, &self.plan, watch).run(measured)
    }
}

fn report(args: &Args, prepared: &Model, measured: &WorkPrecision, folder: Folder) -> Result<ExitCode> {
    // Methods and tolerances are those of the cells.
    let origin = args.talk.origin_of(&prepared.parameters);
    args.talk.publish(folder, "tradeoff", origin, &MethodsAnswer::new(measured, &args.named(), args.digits))?;
    match (interrupt::is_asked(), measured.lacks(args.digits)) {
        (true, _) => fail("interrupted\n  help: go on with --resume"),
        (_, Some(Lack { why, hint, is_all: true })) => fail(format!("no recommendation: {why}\n  help: {hint}")),
        _ => Ok(ExitCode::SUCCESS),
    }
}

impl Args {
    /// Returns the table of reference values: that of the command line, or that of the scene.
    fn reference(&self, prepared: &Model) -> Option<PathBuf> {
        let own = || Some(scene::folder(Some(&self.scene.path)).join(prepared.reference.as_ref()?));
        self.reference.clone().or_else(own)
    }

    /// Returns the scene as on the command line, with its changes.
    fn named(&self) -> String {
        let set = self.scene.set.iter().map(|(name, value)| format!(" --set {name}={value}"));
        let until = self.until.iter().map(|until| format!(" --until {until}"));
        [self.scene.path.display().to_string()].into_iter().chain(set).chain(until).collect()
    }
}

fn save(place: &Path, measured: &WorkPrecision) -> Result<()> {
    let text = serde_json::to_string_pretty(measured).map_err(|error| Error::file(place, error))?;
    write_whole(place, text.as_bytes())
}

/// Returns a hash of all that makes measurements comparable: the scene, its changes, the compared quantities and times.
fn fingerprint(args: &Args, rows: usize) -> Result<String> {
    let mut hasher = DefaultHasher::new();
    scene::read_text(&args.scene.path)?.hash(&mut hasher);
    let set: Vec<(&str, String)> =
        args.scene.set.iter().map(|(name, value)| (name.as_str(), value.to_string())).collect();
    (set, args.until.map(f64::to_bits), &args.outputs, rows, &args.reference).hash(&mut hasher);
    Ok(format!("{:016x}", hasher.finish()))
}

/// Returns the results of an earlier measurement.
fn resumed(place: &Path, fresh: WorkPrecision) -> Result<WorkPrecision> {
    let wrong = |problem: &str| Error::file(place, format!("{problem}; leave out --resume to begin anew"));
    let text = files::read_text(place).map_err(|_| wrong("there is no measurement to go on with"))?;
    let measured: WorkPrecision =
        serde_json::from_str(&text).map_err(|error| wrong(&format!("this is no measurement ({error})")))?;
    if measured.fingerprint == fresh.fingerprint {
        Ok(measured)
    } else {
        Err(wrong("this is a measurement of another scene, or with other options"))
    }
}
