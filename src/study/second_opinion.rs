//! Confirmation of reference values by diffsol.

use super::budget::Limit;
use super::metric::ErrorMetric;
use super::run::{Motion, with_tolerance};
use crate::integrator;
use crate::method_spec::MethodSpec;
use crate::simulate::Method;
use serde::{Deserialize, Serialize};
use std::fmt;
use std::time::Duration;

/// Methods of diffsol that confirm others, which share no code with them: for motions that are not stiff, and for stiff
/// ones.
pub(super) const METHODS: [[&str; 3]; 2] = [["index1", "tsit45", "exact"], ["ggl", "diffsol", "none"]];

/// Largest relative difference that confirms a run, to two digits.
const CONFIRMED: f64 = 1e-2;

/// CPU time for a second opinion. On what is very stiff diffsol can take hundreds of times as long as the run that it
/// confirms, and nobody waits for that.
const LONGEST: Duration = Duration::from_secs(5);

/// Difference of a run of diffsol from reference values.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct SecondOpinion {
    /// The method of diffsol with its tolerance.
    pub method: String,
    /// Largest relative difference; none where the run did not complete.
    pub difference: Option<f64>,
    /// Quantity with the largest difference, or the reason why the run did not complete.
    pub about: String,
}

impl SecondOpinion {
    /// The difference between the rows of a completed run and the values of `metric`, of which one is from `method`.
    pub(super) fn of(method: String, metric: &ErrorMetric, rows: &[Vec<f64>]) -> Self {
        let (difference, about) = metric.error(rows);
        SecondOpinion { method, difference: Some(difference), about }
    }
}

/// Compares `rows`, values of the watched quantities along the motion that `of` computed, with a run of diffsol at its
/// tolerance: by an explicit method where `of` is one. It is given up after [`LONGEST`].
pub(crate) fn second_opinion(motion: &Motion, rows: &[Vec<f64>], of: &Method, limit: Limit) -> SecondOpinion {
    let is_explicit = integrator::find(&of.integrator).is_ok_and(|entry| entry.follows_fields());
    let [formulation, integrator, projection] = METHODS[usize::from(!is_explicit)].map(MethodSpec::named);
    let Method { rtol, atol, .. } = if of.step.is_some() { Method::default() } else { of.clone() };
    let method = Method { formulation, integrator, projection, rtol, atol, step: None };
    let limit = Limit { cpu: limit.cpu.min(LONGEST), wall: limit.wall.min(3 * LONGEST) };
    let name = with_tolerance(&method);
    let failed = |reason: String| SecondOpinion { method: name.clone(), difference: None, about: reason };
    match motion.run(&method, limit) {
        Ok(run) => match &run.failure {
            Some(failure) => failed(failure.reason.clone()),
            None => SecondOpinion::of(name, &ErrorMetric::of(&motion.watched, &run), rows),
        },
        Err(error) => failed(format!("{error:#}")),
    }
}

impl fmt::Display for SecondOpinion {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        let SecondOpinion { method, difference, about } = self;
        match difference {
            Some(difference) if *difference <= CONFIRMED => write!(
                out,
                "confirmed by diffsol, which shares no code with it: {method} differs by {difference:.0e} ({about})"
            ),
            Some(difference) => write!(
                out,
                "not confirmed by diffsol, which shares no code with it: {method} differs by {difference:.0e} ({about})"
            ),
            None => write!(out, "not confirmed by diffsol: {method} did not complete: {about}"),
        }
    }
}
