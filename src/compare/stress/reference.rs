//! The motion that errors are measured against.

use super::deadline::Shift;
use super::subject::Case;
use super::subject::Subject;
use crate::compare::work_precision::{Allowed, ErrorMetric, Motion, SecondOpinion, Watched, sample, second_opinion};
use crate::method_spec::MethodSpec;
use crate::simulate::Method;
use crate::tolerances::report as tolerances;
use std::time::Duration;

/// Result of the search for a reference.
pub(super) enum Search {
    /// It takes more time; the part of the motion completed.
    Pending(f64),
    /// The watched quantities along an accurate solution, and its method.
    Found(Box<(ErrorMetric, Method)>),
    /// No method completes the motion.
    Hopeless,
}

/// An explicit and an implicit method, one of which suits.
const METHODS: [[&str; 3]; 2] = [["index1", "dop853", "manifold"], ["ggl", "radau_iia", "none"]];

impl Search {
    /// Simulates the motion of the case, by the first method that completes it within the CPU time allowed to each.
    pub fn run(subject: &Subject, case: &Case, allowed: Duration, shift: Shift) -> Self {
        let mut search = Search::Hopeless;
        for names in METHODS {
            let [formulation, integrator, projection] = names.map(MethodSpec::named);
            let method = Method {
                formulation,
                integrator,
                projection,
                rtol: tolerances::REFERENCE_RTOL,
                atol: tolerances::REFERENCE_RTOL,
                step: None,
            };
            match Self::by(subject, Case { method, ..case.clone() }, allowed, shift) {
                Search::Hopeless => {}
                Search::Pending(part) => search = Search::Pending(part.max(search.part())),
                found => return found,
            }
        }
        search
    }

    fn part(&self) -> f64 {
        if let Search::Pending(part) = self { *part } else { 0.0 }
    }

    fn by(subject: &Subject, case: Case, cpu: Duration, shift: Shift) -> Self {
        let found = subject.with(&case, |system, span, start| {
            let between = (span.start, span.end);
            let is_stopped = &|| false;
            let motion = Motion { system, start, between, ratio: 1.0, counts_start: true, is_stopped };
            let watched = Watched::new(system, &[])?;
            let wall = shift.left();
            let run = sample(&motion, &watched, &case.method, span, Allowed { cpu, wall })?;
            Ok(match run.failure {
                None => {
                    let reference = ErrorMetric::new(&watched.columns, run.rows, &run.sizes);
                    Search::Found(Box::new((reference, case.method.clone())))
                }
                Some(failure) if run.is_too_slow => Search::Pending((failure.t - span.start) / case.duration),
                Some(_) => Search::Hopeless,
            })
        });
        found.unwrap_or(Search::Hopeless)
    }
}

/// Compares a reference with a run of diffsol within the CPU time allowed.
pub(super) fn confirmed(
    subject: &Subject,
    case: &Case,
    reference: &ErrorMetric,
    cpu: Duration,
) -> Option<SecondOpinion> {
    let compared = subject.with(case, |system, span, start| {
        let between = (span.start, span.end);
        let is_stopped = &|| false;
        let motion = Motion { system, start, between, ratio: 1.0, counts_start: true, is_stopped };
        let watched = Watched::new(system, &[])?;
        let allowed = Allowed { cpu, wall: cpu.saturating_mul(2) };
        Ok(second_opinion(&motion, &watched, span, (&reference.rows, &case.method), allowed))
    });
    compared.ok()
}
