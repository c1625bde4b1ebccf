//! The reference of accuracy.

use super::climb::{Checked, MethodRuns, check, climb, confirmed, nothing, same};
use super::given::GivenValues;
use crate::error::Result;
use crate::integrator;
use crate::simulate::Span;
use crate::study::metric::ErrorMetric;
use crate::study::run::{Motion, RunSample};
use crate::study::second_opinion::SecondOpinion;
use serde::{Deserialize, Serialize};
use std::time::Duration;

/// Reference values with their error.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Reference {
    /// The method or the file.
    pub from: String,
    /// The method or the tolerance that it was compared with.
    pub checked_by: String,
    /// True if that is another method, false if the reference's own at a looser tolerance.
    pub is_independent: bool,
    /// The largest relative difference between the two: smaller errors of runs cannot be measured.
    pub error: f64,
    /// The quantity with this difference.
    pub worst: String,
    /// The difference from a run of diffsol; none where it completed none.
    #[serde(default)]
    pub second_opinion: Option<SecondOpinion>,
    /// Steps from which those of fixed-step methods are chosen.
    pub pace: Pace,
    /// The values, with the sizes of the quantities.
    pub values: ErrorMetric,
}

/// Steps, extrapolated to rtol = 1, by the relation h = pace rtol^(1/p).
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Pace {
    /// Of an explicit method, s.
    pub explicit: f64,
    /// Of an implicit method, s.
    pub implicit: f64,
}

impl Reference {
    /// Computes the motion by the tightest runs that complete in the time allowed, and its error by another method, or
    /// by its own change with the tolerance; against values of a file where they are `given`. It is as accurate as
    /// `digits` need, and more where that costs little. All runs that it was found by are returned with it.
    ///
    /// # Errors
    /// A run error where no method completes; a file that lacks a quantity or the times.
    pub(super) fn find(
        motion: &Motion,
        given: Option<&GivenValues>,
        digits: u32,
        budget: Duration,
    ) -> Result<(Reference, Vec<RunSample>)> {
        let Motion { span, watched, .. } = motion;
        // One digit better than what is asked for.
        let wanted = 0.1 * 0.1f64.powf(f64::from(digits));
        let lines = climb(motion, wanted, budget)?;
        let pace = pace(&lines, *span);
        let mut checked = check(&lines, watched).ok_or_else(|| nothing(&lines, *span, budget))?;
        if let Some(given) = given {
            let best = checked.best;
            let values = ErrorMetric::new(&watched.columns, given.rows_at(watched, *span)?, &best.sizes);
            checked = Checked { by: Some(best), error: values.error(&best.rows), values, ..checked };
        }
        let from = given.map_or_else(|| checked.best.name(), |given| given.name.clone());
        let checked_by = checked.by.map_or("nothing".to_string(), RunSample::name);
        let is_independent = checked.by.is_some_and(|by| given.is_some() || !same(by, checked.best));
        let second_opinion = confirmed(&lines, &checked);
        let (error, worst) = checked.error;
        let values = checked.values;
        let reference = Reference { from, checked_by, is_independent, error, worst, second_opinion, pace, values };
        Ok((reference, lines.into_iter().flat_map(|line| line.runs).collect()))
    }

    /// Returns the digits up to which errors can be measured.
    pub fn digits(&self) -> f64 {
        super::cell::digits(self.error)
    }
}

/// Takes the loosest runs of the first two families; where one of them has none, that of the other.
fn pace(lines: &[MethodRuns], span: Span) -> Pace {
    let duration = span.end - span.start;
    // The mean step without the effect of the tolerance: h rtol^(-1/p).
    let pace = |run: &RunSample| {
        let order = integrator::find(&run.method.integrator).map_or(5, |entry| entry.order.max(5));
        duration / run.statistics.steps.max(1) as f64 * run.method.rtol.powf(-1.0 / order as f64)
    };
    let of = |line: usize| lines.get(line).and_then(|line| line.runs.first()).map(pace);
    let any = (0..lines.len()).find_map(of).unwrap_or(1e-3 * duration);
    Pace { explicit: of(0).unwrap_or(any), implicit: of(1).unwrap_or(any) }
}
