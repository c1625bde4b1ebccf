//! The motion that errors are measured against.

use super::subject::{Case, Subject};
use crate::method_spec::MethodSpec;
use crate::simulate::Method;
use crate::study::budget::{Budget, Limit};
use crate::study::metric::ErrorMetric;
use crate::study::second_opinion::{SecondOpinion, second_opinion};
use crate::tolerances;
use std::time::Duration;

/// Result of the search for a reference.
pub(super) enum ReferenceSearch {
    /// It takes more time; the part of the motion completed.
    Pending(f64),
    /// The watched quantities along an accurate solution, and its method.
    Found(Box<(ErrorMetric, Method)>),
    /// No method completes the motion.
    Hopeless,
}

/// An explicit and an implicit method, one of which suits.
const METHODS: [[&str; 3]; 2] = [["index1", "dop853", "manifold"], ["ggl", "radau_iia", "none"]];

impl ReferenceSearch {
    /// Simulates the motion of the case, by the first method that completes it within the CPU time allowed to each.
    pub fn run(subject: &Subject, case: &Case, cpu: Duration, budget: &Budget) -> Self {
        let mut longest = None;
        for names in METHODS {
            let [formulation, integrator, projection] = names.map(MethodSpec::named);
            let rtol = tolerances::TIGHTEST;
            let method = Method { formulation, integrator, projection, rtol, atol: rtol, step: None };
            let case = Case { method, ..case.clone() };
            let search = subject.with(&case, |motion| {
                let run = motion.run(&case.method, Limit { cpu, wall: budget.left() })?;
                Ok(match &run.failure {
                    None => {
                        ReferenceSearch::Found(Box::new((ErrorMetric::of(&motion.watched, &run), case.method.clone())))
                    }
                    Some(failure) if run.is_too_slow => {
                        ReferenceSearch::Pending((failure.t - motion.span.start) / case.duration)
                    }
                    Some(_) => ReferenceSearch::Hopeless,
                })
            });
            match search {
                Ok(ReferenceSearch::Pending(part)) => longest = Some(part.max(longest.unwrap_or(0.0))),
                Ok(ReferenceSearch::Hopeless) | Err(_) => {}
                Ok(found) => return found,
            }
        }
        longest.map_or(ReferenceSearch::Hopeless, ReferenceSearch::Pending)
    }
}

/// Compares a reference with a run of diffsol within the CPU time allowed.
pub(super) fn confirmed(
    subject: &Subject,
    case: &Case,
    reference: &ErrorMetric,
    cpu: Duration,
) -> Option<SecondOpinion> {
    subject.with(case, |motion| Ok(second_opinion(motion, &reference.rows, &case.method, cpu.into()))).ok()
}
