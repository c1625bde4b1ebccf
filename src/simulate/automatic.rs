//! `--method auto`: choice between explicit and implicit methods during the run, by the time simulated per work.
//!
//! An explicit method begins. Whenever the work since the last comparison has doubled, and wherever a run stops, an
//! implicit one, or the explicit one again, may try from there ([`Contest`]); the better one continues. So the total
//! cost is at most a few times that of the better method on each part of the motion. Work is counted in evaluations: a
//! run is repeatable bit by bit. An implicit method that takes over early begins at the start: errors of explicit steps
//! are too small to matter, and still far from the slow motion in the norm of the stiff forces that it would have to
//! follow.

use super::checkpoint::flat;
use super::contest::{Contest, Mark, Quiet, unseen};
use super::first_explicit::first_explicit;
use super::{Method, Outcome, Sink, Span, TimeLoop};
use crate::error::{Failure, Result, clock, two_digits};
use crate::formulation::Statistics;
use crate::method_spec::MethodSpec;
use crate::system::MechanicalSystem;
use crate::tolerances;
use serde::Serialize;

/// Work before automatic choice looks at the steps first. Unit: `[evaluations]`. Why: short runs try nothing.
const IMPLICIT_TRIED: f64 = 200.0;

/// How much farther a method must come for the same work to take over. Unit: `[1]`. Why: an explicit method takes a few
/// long steps before stability limits them.
const WORTH: f64 = 2.0;

/// Up to here a motion is begun again by a method that takes over. Unit: `[1]` of the span. Why: it costs that method
/// no more of its work. Test: `what_takes_over_early_begins_at_the_start`.
const BEGINNING: f64 = 0.1;

/// A part of a run with one method, and the reason for that method in one or two sentences.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Leg {
    /// Time from which on the method is used, s.
    pub from: f64,
    /// The method.
    #[serde(flatten)]
    pub method: Method,
    /// The reason for it.
    pub because: String,
    /// Work of the method itself.
    pub statistics: Statistics,
    /// Work of the other methods, which were tried.
    pub trials: Vec<Trial>,
}

/// Work of a method that was tried.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Trial {
    /// Its integrator.
    pub integrator: String,
    /// Work of all its trials.
    pub statistics: Statistics,
}

const CALM: &str = "not stiff: accuracy, not stability, limits explicit steps";

fn method(formulation: &str, integrator: &str, projection: &str, tolerances: (f64, f64)) -> Method {
    let (rtol, atol) = tolerances;
    let formulation = MethodSpec::named(formulation);
    let integrator = MethodSpec::named(integrator);
    let projection = MethodSpec::named(projection);
    Method { formulation, integrator, projection, rtol, atol, step: None }
}

/// The implicit method that solves whatever is given to it: L-stable, of high order.
fn implicit(tolerances: (f64, f64)) -> Method {
    method("ggl", "radau_iia", "none", tolerances)
}

/// Index of the method that a run begins with among the candidates.
const FIRST: usize = 0;

/// The explicit method that a run begins with, and the implicit one that takes over where stability limits its steps.
pub fn known_methods(system: &dyn MechanicalSystem, tolerances: (f64, f64)) -> [Method; 2] {
    let explicit = first_explicit(system, tolerances.0);
    [method("index1", explicit, "manifold", tolerances), implicit(tolerances)]
}

/// Compares a given method with an implicit one at the beginning of a motion. `None` where stability does not limit its
/// steps, or nothing is known.
pub fn rival(system: &dyn MechanicalSystem, method: &Method, span: Span, start: (&[f64], &[f64])) -> Option<Contest> {
    let methods = [method.clone(), implicit((method.rtol, method.atol))];
    let mut drive = Drive::new(system, methods, unseen(span), flat(system, span.start, start).ok()?).ok()?;
    drive.run.begin(&mut Quiet(None)).ok()?;
    let is_enough = |drive: &Drive, mark, changes| drive.contest.is_some() || changes || drive.is_known(mark);
    drive.go(&mut Quiet(None), is_enough).ok()?;
    drive.contest
}

/// The one method for a motion from (q, v) over `span`, chosen at its beginning from the explicit method that a run
/// would begin with and `radau_iia`, and the reason.
///
/// # Errors
/// Bad input only: tolerances that are not positive.
pub fn advise(
    system: &dyn MechanicalSystem,
    tolerances: (f64, f64),
    span: Span,
    start: (&[f64], &[f64]),
) -> Result<(Method, String)> {
    let mut drive = Drive::chosen(system, tolerances, unseen(span), flat(system, span.start, start)?)?;
    if let Err(Failure { reason, .. }) = drive.run.begin(&mut Quiet(None)) {
        // Any method fails so: the run will report it at its start.
        return Ok((drive.leg.method, format!("nothing was tried: {reason}")));
    }
    drive.go(&mut Quiet(None), |drive, mark, changes| !changes && drive.is_known(mark))?;
    let Leg { method, because, .. } = drive.leg;
    Ok((method, because))
}

/// A run that may change its method.
pub(crate) struct Drive<'a> {
    system: &'a dyn MechanicalSystem,
    /// That of the start, explicit, and the other one.
    methods: [Method; 2],
    pub span: Span,
    /// The flat state at the start.
    start: Vec<f64>,
    pub run: TimeLoop<'a>,
    /// Index of the present method.
    current: usize,
    /// Number of methods that failed at the present state.
    stopped: usize,
    /// Work until the next comparison, in evaluations.
    window: f64,
    /// Result of the last trial.
    contest: Option<Contest>,
    /// The legs before, and that of the present method.
    legs: Vec<Leg>,
    leg: Leg,
}

impl<'a> Drive<'a> {
    /// A run from the flat state `start` by the known methods.
    pub fn chosen(
        system: &'a dyn MechanicalSystem,
        tolerances: (f64, f64),
        span: Span,
        start: Vec<f64>,
    ) -> Result<Self> {
        let methods = known_methods(system, tolerances);
        methods[FIRST].check()?;
        Drive::new(system, methods, span, start)
    }

    /// The present method.
    pub fn method(&self) -> &Method {
        &self.methods[self.current]
    }

    /// The method that may take over.
    fn other(&self) -> &Method {
        &self.methods[1 - self.current]
    }

    fn new(system: &'a dyn MechanicalSystem, methods: [Method; 2], span: Span, start: Vec<f64>) -> Result<Self> {
        Ok(Drive {
            system,
            span,
            run: TimeLoop::new(system, &methods[FIRST], span, start.clone())?,
            start,
            current: FIRST,
            stopped: 0,
            window: IMPLICIT_TRIED,
            contest: None,
            legs: Vec::new(),
            leg: Leg::of(span.start, &methods[FIRST], CALM.to_string()),
            methods,
        })
    }

    /// Continues to the end, to a failure that all methods have, or until `is_enough`, which is called after each
    /// comparison with the mark from which the work is measured, and true if the method should change.
    pub fn go(
        &mut self,
        sink: &mut dyn Sink,
        is_enough: impl Fn(&Self, Mark, bool) -> bool,
    ) -> Result<Option<Failure>> {
        let mut mark = self.run.mark();
        let mut failure = None;
        loop {
            if failure.is_none() {
                (mark, failure) = self.run.window(self.window, f64::INFINITY, sink, |_, _, _| false);
                let is_over = failure.is_none() && self.run.is_paused(sink);
                self.window *= if is_over { 1.0 } else { 2.0 };
            }
            if self.is_over(failure.as_ref(), sink) {
                break;
            }
            let next = self.look(mark, failure.as_ref())?;
            if is_enough(self, mark, next.is_some()) {
                break;
            }
            let wins = failure.is_none();
            failure = match next {
                Some(because) if wins && self.begins_again() => self.begin_again(because, sink)?,
                Some(because) => self.change(because)?,
                None => None,
            };
        }
        Ok(failure)
    }

    fn is_over(&mut self, failure: Option<&Failure>, sink: &dyn Sink) -> bool {
        if failure.is_none() {
            return self.run.is_paused(sink);
        }
        let is_again = self.run.t - self.leg.from < tolerances::SIX_DIGITS * (self.span.end - self.span.start);
        self.stopped = if is_again { self.stopped + 1 } else { 1 };
        sink.stops().is_some() || self.stopped == self.methods.len()
    }

    /// True if the work since `mark` is representative of the motion: a good part of what is left at that pace.
    fn is_known(&self, mark: Mark) -> bool {
        // Evaluations; a tenth of the work that is left says enough of it.
        self.window > 2e4 || self.run.mark().work > 0.1 * self.run.left(mark)
    }

    /// The reason for the other method, if it should continue: after the work since `mark`, or after a failure.
    fn look(&mut self, mark: Mark, failure: Option<&Failure>) -> Result<Option<String>> {
        if let Some(Failure { t, reason, .. }) = failure {
            return Ok(Some(format!("{} stopped at t = {} s: {reason}", self.method().triple(), clock(*t))));
        }
        let Some((contest, work)) = self.run.contest(mark, self.other(), self.system)? else { return Ok(None) };
        let other = self.other().clone();
        self.leg.add(&other, work);
        self.contest = Some(contest);
        let wins = contest.gain > WORTH;
        let because = words(&contest, self.method(), &other, self.current == FIRST, wins);
        if !wins && self.leg.because == CALM {
            self.leg.because.clone_from(&because);
        }
        Ok(wins.then_some(because))
    }

    /// Continues the motion with another method.
    fn change(&mut self, because: String) -> Result<Option<Failure>> {
        let next = self.run.rival(self.other(), self.system, self.span)?;
        let before = self.replace(next, because);
        Ok(self.run.go_on(&before.problem.dynamics.dropped, before.h).err())
    }

    /// True if the motion so far costs an implicit method little: it may begin at the start, where no errors of steps
    /// of the first method excite stiff modes, which it would have to follow.
    fn begins_again(&self) -> bool {
        let is_early = self.run.t - self.span.start < BEGINNING * (self.span.end - self.span.start);
        is_early && self.legs.is_empty()
    }

    /// Continues the motion with another method, which comes to the present time from the start, unseen. From the
    /// present state where it does not come there for the work that this took.
    fn begin_again(&mut self, because: String, sink: &mut dyn Sink) -> Result<Option<Failure>> {
        let other = self.other().clone();
        let mut next = TimeLoop::new(self.system, &other, self.span, self.start.clone())?;
        let mut quiet = Quiet(Some(sink));
        if next.begin(&mut quiet).is_err() || !next.reaches(&self.run, &mut quiet) {
            self.leg.add(&other, next.statistics());
            return self.change(because);
        }
        self.replace(next, format!("{because}; it began again at the start"));
        Ok(None)
    }

    /// Replaces the run by one that is at the same time; returns the one before.
    fn replace(&mut self, next: TimeLoop<'a>, because: String) -> TimeLoop<'a> {
        self.current = 1 - self.current;
        let before = std::mem::replace(&mut self.run, next);
        (self.run.until, self.run.roots) = (before.until, before.roots);
        let begun = Leg::of(before.t, self.method(), because);
        let ended = std::mem::replace(&mut self.leg, begun);
        self.legs.push(Leg { statistics: before.statistics(), ..ended });
        before
    }

    pub fn finish(mut self, failure: Option<Failure>, sink: &mut dyn Sink) -> (Outcome, Vec<Leg>) {
        let outcome = self.run.finish(failure, sink);
        let statistics = self.statistics();
        self.legs.push(Leg { statistics: outcome.statistics, ..self.leg });
        (Outcome { statistics, ..outcome }, self.legs)
    }

    /// Work of all methods.
    pub fn statistics(&self) -> Statistics {
        self.legs.iter().fold(self.run.statistics(), |sum, leg| sum + leg.statistics)
    }
}

impl Leg {
    /// The leg of a run that is continued from a checkpoint.
    pub fn going_on(from: f64, method: &Method, statistics: Statistics) -> Self {
        Leg { statistics, ..Leg::of(from, method, "the method of the run that goes on".to_string()) }
    }

    /// A leg before any work.
    fn of(from: f64, method: &Method, because: String) -> Self {
        Leg { from, method: method.clone(), because, statistics: Statistics::default(), trials: Vec::new() }
    }

    /// Counts the work of a trial.
    fn add(&mut self, method: &Method, work: Statistics) {
        let integrator = &method.integrator.name;
        match self.trials.iter_mut().find(|trial| trial.integrator == *integrator) {
            Some(trial) => trial.statistics = trial.statistics + work,
            None => self.trials.push(Trial { integrator: integrator.clone(), statistics: work }),
        }
    }

    /// Work of all trials.
    pub fn tried(&self) -> Statistics {
        self.trials.iter().fold(Statistics::default(), |sum, trial| sum + trial.statistics)
    }
}

const FILTER: &str = ". Where only the slow motion is wanted, generalized_alpha on ggl damps the oscillation away";

fn words(contest: &Contest, method: &Method, other: &Method, is_explicit: bool, wins: bool) -> String {
    let Contest { t, mode, step, gain } = contest;
    let own = &method.integrator.name;
    let other = &other.integrator.name;
    let kind = match (is_explicit, wins) {
        (true, true) | (false, false) => "stiff",
        (true, false) if *gain < tolerances::NO_ALTERNATIVE => "not stiff",
        (true, false) => "fast, not stiff",
        (false, true) => "no longer stiff",
    };
    let verdict = if wins { "advances" } else { "advances only" };
    let filter = if kind == "fast, not stiff" { FILTER } else { "" };
    format!(
        "{kind}. At t = {} s the fastest mode {mode} and {own} takes steps of {} s; tried there, {other} {verdict} {} \
         times as far for the same work{filter}",
        two_digits(*t),
        two_digits(*step),
        two_digits(*gain)
    )
}
