//! `holonom simulate SCENE --check-error`

use super::common::Talk;
use super::interrupt;
use crate::error::Failure;
use crate::linearize::{State, amplification};
use crate::measure::{CheckError, Recorder, closer};
use crate::report::Folder;
use crate::simulate::{Method, Span, stiffness};
use crate::study::Study;
use crate::system::Loaded;
use crate::trajectory::Trajectory;

/// Times up to which the growth of small changes is looked at.
const TIMES: u32 = 20;

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

/// How much the motion amplifies small changes; none where there are too many, or too fast ones for the explicit method that
/// carries them.
fn amplified(study: &Study, span: Span, goes_on: impl FnMut(f64) -> bool) -> Option<f64> {
    let start = State::start(study);
    let state =
        Loaded { t: start.t, q: &start.q, v: &start.v, vdot: &study.assembly.vdot, lambda: &study.assembly.lambda };
    if stiffness(study.system(), &Method::default(), state, span).is_some() {
        return None;
    }
    let time = |i: u32| span.start + (span.end - span.start) * f64::from(i) / f64::from(TIMES);
    amplification(study.system(), &start, &(1..=TIMES).map(time).collect::<Vec<f64>>(), goes_on).ok()
}
