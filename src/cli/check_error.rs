//! `holonom simulate SCENE --check-error`

use super::common::Talk;
use super::interrupt;
use crate::error::Failure;
use crate::linearize::amplified;
use crate::measure::{CheckError, Recorder, closer};
use crate::report::Folder;
use crate::simulate::Span;
use crate::study::Study;
use crate::trajectory::Trajectory;

/// Runs the study again with closer steps, and compares the `first` run with that.
pub fn check_error(study: &Study, span: Span, first: &Trajectory, (talk, folder): (&Talk, &Folder)) -> CheckError {
    let bar = talk.progress(1000, &format!("{}: the error", study.name));
    let show = |t: f64| bar.set_position((1000.0 * (t - span.start) / (span.end - span.start)) as u64);
    let method = closer(&study.method);
    let mut recorder = Recorder::new(study.system()).with_progress(show).with_stop(|| interrupt::stop(folder));
    let outcome = study.simulate(&method, span, &mut recorder);
    let second = recorder.finish();
    let failure = match outcome {
        Ok((outcome, _)) => second.singularity.failure().or(outcome.failure),
        Err(error) => Some(Failure { t: span.start, reason: error.to_string(), hint: String::new() }),
    };
    let growth = amplified(study, span, |t| {
        show(t);
        !interrupt::is_asked()
    });
    bar.finish_and_clear();
    CheckError { amplification: growth, ..CheckError::new(first, &second.trajectory, &method, failure) }
}
