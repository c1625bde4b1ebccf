//! Error bars of a run, from a companion: the same run by the same methods, but coarser.

use super::companion::{Companion, Completed, RunPart, RunWatch, companion, differences, largest_of};
use super::run::Motion;
use super::second_opinion::{SecondOpinion, second_opinion};
use super::watched::Watched;
use crate::error::{Failure, Result};
use crate::linearize::amplified;
use crate::prepared::Model;
use crate::simulate::{Method, Stop};
use crate::tolerances;
use serde::{Serialize, Serializer};
use std::time::Duration;

/// What is known of the error of a run.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ErrorBars {
    /// Relative tolerance of the companion.
    pub rtol: f64,
    /// Absolute tolerance of the companion.
    pub atol: f64,
    /// Fixed step of the companion, s; none with an error estimate.
    pub step: Option<f64>,
    /// Evaluations of the companion over those of the run.
    pub work: f64,
    /// Error bars over the rows; of coordinates where the scene has no outputs.
    #[serde(serialize_with = "by_name")]
    pub outputs: Vec<(String, ErrorBar)>,
    /// Difference of the run from one of diffsol; none where the companion ended early.
    pub second_opinion: Option<SecondOpinion>,
    /// Factor by which the motion amplifies small changes of its start, or the reason why it is not known.
    #[serde(serialize_with = "if_known")]
    pub amplification: Result<f64, String>,
    /// Reason why the companion ended early; the bars are those up to there.
    pub failure: Option<Failure>,
}

/// Half width of the interval around the computed values of a quantity that holds the true ones.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ErrorBar {
    /// Largest over the rows, in `unit`.
    pub max: f64,
    /// At the last row, in `unit`.
    #[serde(rename = "final")]
    pub last: f64,
    /// Unit; empty where it is not known.
    pub unit: String,
    /// At each row that both runs have.
    #[serde(skip)]
    pub rows: Vec<f64>,
}

/// Gives each output an error bar, and compares the run with one of diffsol and with motions nearby. `show` is called
/// with the times, `stop` asked whether the run should end.
pub fn error_bars(
    prepared: &Model,
    run: Completed,
    show: impl Fn(f64),
    stop: impl Fn() -> Option<Stop> + Sync,
) -> ErrorBars {
    let bars = ErrorBars::of(prepared, run, (&show, &stop));
    let opinion = bars.failure.is_none().then(|| confirm(prepared, &run, &|| stop().is_some())).flatten();
    let amplification = amplified(prepared, run.span, |t| {
        show(t);
        stop().is_none()
    });
    ErrorBars { second_opinion: opinion, amplification: amplification.map_err(|error| format!("{error:#}")), ..bars }
}

impl ErrorBars {
    /// The bars alone, from a companion of the run.
    pub fn of(prepared: &Model, run: Completed, watch: RunWatch) -> ErrorBars {
        let companion = companion(prepared, &run, &RunPart::of(prepared, &run), watch);
        let Method { rtol, atol, step, .. } = companion.method;
        ErrorBars {
            rtol,
            atol,
            step,
            work: companion.statistics.rhs_evaluations as f64 / (run.statistics.rhs_evaluations as f64).max(1.0),
            outputs: bars(&run, &companion),
            second_opinion: None,
            amplification: Err(String::new()),
            failure: companion.failure,
        }
    }
}

/// Compares the run with one of diffsol.
fn confirm(prepared: &Model, run: &Completed, is_stopped: &(dyn Fn() -> bool + Sync)) -> Option<SecondOpinion> {
    let parts = RunPart::of(prepared, run);
    let longest = parts.iter().max_by(|a, b| a.duration().total_cmp(&b.duration()))?;
    let watched = Watched::new(prepared.system(), &[]).ok()?;
    let motion = Motion { counts_start: true, ..Motion::of(prepared, run.span, watched, is_stopped) };
    Some(second_opinion(&motion, &run.rows_of_span(), &longest.method, Duration::MAX.into()))
}

/// Differences are taken over so many rows of a hundred to each side: they pass through zero, errors do as well, but
/// elsewhere.
const NEIGHBOURS: usize = 10;

fn bars(run: &Completed, companion: &Companion) -> Vec<(String, ErrorBar)> {
    let trajectory = run.trajectory;
    let part = companion.part;
    let rows = differences(trajectory, &companion.rows);
    let bar = |(i, (name, unit)): (usize, (&str, &str))| {
        let round_off = tolerances::ROUND_OFF_OF_SUMS * largest_of(trajectory, i);
        let differences: Vec<f64> = rows.iter().map(|row| part * row[i] + round_off).collect();
        let rows = envelope(&differences);
        let max = rows.iter().copied().fold(f64::NAN, f64::max);
        let last = rows.last().copied().unwrap_or(f64::NAN);
        (name.to_string(), ErrorBar { max, last, unit: unit.to_string(), rows })
    };
    if trajectory.outputs.is_empty() {
        return trajectory.names.q.iter().map(|name| (name.as_str(), "")).enumerate().map(bar).collect();
    }
    trajectory.named_outputs().enumerate().map(bar).collect()
}

/// The largest of the differences around each row; those without a value do not count.
fn envelope(differences: &[f64]) -> Vec<f64> {
    let reach = differences.len() * NEIGHBOURS / 100;
    let around = |i: usize| &differences[i.saturating_sub(reach)..(i + reach + 1).min(differences.len())];
    (0..differences.len()).map(|i| around(i).iter().copied().fold(0.0, f64::max)).collect()
}

fn by_name<S: Serializer>(outputs: &[(String, ErrorBar)], serializer: S) -> Result<S::Ok, S::Error> {
    serializer.collect_map(outputs.iter().map(|(name, bar)| (name, bar)))
}

fn if_known<S: Serializer>(amplification: &Result<f64, String>, serializer: S) -> Result<S::Ok, S::Error> {
    amplification.as_ref().ok().serialize(serializer)
}
