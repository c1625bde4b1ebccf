//! `--method auto`: the method that carries a motion farthest for its work, found out on the way.
//!
//! An explicit method begins. Whenever the work since the last look has doubled, and wherever a run stops, the other one of
//! two may try from there ([`Contest`]); the better one goes on. So the whole costs no more than a few times what the better
//! one of both would, wherever along the motion that changes. All is counted in evaluations: a run is repeatable bit by bit.

use super::contest::{Contest, Mark, Quiet};
use super::{Checkpoint, Method, Outcome, Run, Sink, Span};
use crate::error::{Failure, Result, clock, short};
use crate::formulation::{Choice, Statistics};
use crate::integrator::Store;
use crate::system::MechanicalSystem;
use serde::Serialize;

/// A method with the reason for it, in one or two sentences, and the time from which on it carries the motion, s.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Leg {
    pub from: f64,
    #[serde(flatten)]
    pub method: Method,
    pub because: String,
}

/// Work before the first look, in evaluations.
const FIRST: f64 = 200.0;
/// An implicit method must come this much farther to take over, and an explicit one, which takes a few long steps before
/// stability holds them.
const WORTH: f64 = 1.5;
const WORTH_BACK: f64 = 3.0;
/// What comes no farther than this is no alternative.
const SLOWER: f64 = 0.5;
/// Runs that stop again within this part of the span are not helped by the other method.
const AGAIN: f64 = 1e-6;

/// The explicit method, and the one without a limit of stability.
fn candidates(rtol: f64, atol: f64) -> [Method; 2] {
    let method = |names: [&str; 3]| {
        let [formulation, integrator, projection] = names.map(Choice::named);
        Method { formulation, integrator, projection, rtol, atol, step: None }
    };
    [method(["index1", "dop853", "manifold"]), method(["ggl", "radau_iia", "none"])]
}

/// What a method that was named has against it at the beginning of a motion: how much farther an implicit one comes. `None`
/// where stability does not hold its steps, or nothing is known.
pub fn rival(system: &dyn MechanicalSystem, method: &Method, span: Span, start: (&[f64], &[f64])) -> Option<Contest> {
    let [_, implicit] = candidates(method.rtol, method.atol);
    let store = Store::default();
    let mut run = Run::unseen((system, &store), method, [span.start, span.end], flat(start)).ok()?;
    run.begin(&mut Quiet).ok()?;
    let mut window = FIRST;
    while window < MOST_ADVICE {
        let (mark, failure) = run.window(window, &mut Quiet);
        if failure.is_some() || run.t >= span.end {
            return None;
        }
        if let Some(hindered) = run.hindered(mark) {
            return run.contest(mark, hindered, &implicit, system).ok();
        }
        if run.has_shown_itself(mark) {
            return None;
        }
        window *= 2.0;
    }
    None
}

/// The choice for a motion from (q, v) over `span`, by its beginning.
///
/// # Errors
/// Bad input only: tolerances that are none.
pub fn advise(
    system: &dyn MechanicalSystem,
    (rtol, atol): (f64, f64),
    span: Span,
    start: (&[f64], &[f64]),
) -> Result<Leg> {
    let methods = candidates(rtol, atol);
    methods[0].check()?;
    let store = Store::default();
    let mut run = Run::unseen((system, &store), &methods[0], [span.start, span.end], flat(start))?;
    if let Err(Failure { reason, .. }) = run.begin(&mut Quiet) {
        // Whatever the method, the run will say so at its start.
        let because = format!("nothing was tried: {reason}");
        return Ok(Leg { from: span.start, method: methods[0].clone(), because });
    }
    let mut drive = Drive { system, methods: &methods, run, carrier: 0, spent: Statistics::default() };
    let unseen = Span { output_step: f64::INFINITY, ..span };
    let (mut chosen, mut because, mut window, mut failure) = (0, CALM.to_string(), FIRST, None);
    while window < MOST_ADVICE {
        let (mark, stopped) = drive.run.window(window, &mut Quiet);
        failure = failure.or(stopped);
        if drive.run.t >= span.end {
            break;
        }
        if let Some(look) = drive.look(mark, failure.as_ref())?.filter(|look| look.0 != chosen || because == CALM) {
            (chosen, because) = look;
        }
        if failure.is_some() || chosen == drive.carrier && drive.run.has_shown_itself(mark) {
            break;
        }
        if chosen != drive.carrier {
            failure = drive.change(chosen, &store, unseen)?;
        }
        window *= 2.0;
    }
    Ok(Leg { from: span.start, method: methods[chosen].clone(), because })
}

/// An advice looks at no more work than this at a time, in evaluations.
const MOST_ADVICE: f64 = 2e4;
const CALM: &str = "not stiff: accuracy, not stability, limits explicit steps";

/// Integrates `system` from (q, v), which should be consistent, over `span`, by the method of `first` and others where these
/// come farther. Returns the methods in their order, and where a run by the last of them can go on.
///
/// # Errors
/// Bad input only, as in [`simulate`](super::simulate).
pub fn simulate_automatic(
    system: &dyn MechanicalSystem,
    first: &Leg,
    span: Span,
    start: (&[f64], &[f64]),
    sink: &mut dyn Sink,
) -> Result<(Outcome, Vec<Leg>, Option<Checkpoint>)> {
    span.check()?;
    let methods = candidates(first.method.rtol, first.method.atol);
    let carrier = usize::from(first.method.integrator != methods[0].integrator);
    let store = Store::default();
    let run = Run::new((system, &store), &methods[carrier], span, flat(start))?;
    let mut drive = Drive { system, methods: &methods, run, carrier, spent: Statistics::default() };
    let mut legs = vec![first.clone()];
    let mut failure = drive.run.begin(sink).err();
    let has_begun = failure.is_none();
    // What was found out before is not asked again at once.
    let mut window = 2.0 * FIRST;
    while failure.is_none() && drive.run.t < span.end {
        let mark;
        (mark, failure) = drive.run.window(window, sink);
        window *= 2.0;
        let since = drive.run.t - legs[legs.len() - 1].from;
        let is_stopped =
            failure.is_some() && (sink.stops().is_some() || legs.len() > 1 && since < AGAIN * (span.end - span.start));
        if is_stopped || failure.is_none() && drive.run.t >= span.end {
            break;
        }
        let Some((carrier, because)) = drive.look(mark, failure.as_ref())? else { continue };
        if carrier != drive.carrier {
            failure = drive.change(carrier, &store, span)?;
            legs.push(Leg { from: drive.run.t, method: methods[carrier].clone(), because });
        }
    }
    let saved = has_begun.then(|| drive.run.checkpoint(&methods[drive.carrier]));
    let outcome = drive.run.finish(failure, sink);
    Ok((Outcome { statistics: drive.spent + outcome.statistics, ..outcome }, legs, saved))
}

/// (q, v), and no work so far.
fn flat((q, v): (&[f64], &[f64])) -> Vec<f64> {
    [q, v, &[0.0]].concat()
}

/// A run that may change its method.
struct Drive<'s, 'a> {
    system: &'s dyn MechanicalSystem,
    methods: &'a [Method; 2],
    run: Run<'a>,
    carrier: usize,
    /// By the methods before; trials are not counted.
    spent: Statistics,
}

impl<'s: 'a, 'a> Drive<'s, 'a> {
    /// Which method should go on and why, where that is a question: after the work since `mark`, or after a failure.
    fn look(&self, mark: Mark, failure: Option<&Failure>) -> Result<Option<(usize, String)>> {
        let other = 1 - self.carrier;
        let names = [self.carrier, other].map(|i| self.methods[i].integrator.name.as_str());
        if let Some(Failure { t, reason, .. }) = failure {
            return Ok(Some((other, format!("{} stopped at t = {} s: {reason}", names[0], clock(*t)))));
        }
        let Some(hindered) = self.run.hindered(mark) else { return Ok(None) };
        let contest = self.run.contest(mark, hindered, &self.methods[other], self.system)?;
        let wins = contest.gain > if self.carrier == 0 { WORTH } else { WORTH_BACK };
        Ok(Some((if wins { other } else { self.carrier }, words(&contest, names, wins))))
    }

    /// Hands the motion on to another method.
    fn change(&mut self, carrier: usize, store: &'a Store<'s>, span: Span) -> Result<Option<Failure>> {
        let next = Run::new((self.system, store), &self.methods[carrier], span, self.run.y.clone())?;
        let before = std::mem::replace(&mut self.run, next);
        self.carrier = carrier;
        self.spent = self.spent + before.problem.dynamics.statistics;
        (self.run.t, self.run.rows.next) = (before.t, before.rows.next);
        Ok(self.run.go_on(&before.problem.dynamics.held).err())
    }
}

const FILTER: &str = ". Where only the slow motion is wanted, generalized_alpha on ggl damps the oscillation away";

fn words(Contest { t, mode, step, gain }: &Contest, [own, other]: [&str; 2], wins: bool) -> String {
    let two = |x: f64| short(format!("{x:.1e}").parse().unwrap_or(x));
    let kind = match (own, wins) {
        ("dop853", true) => "stiff",
        ("dop853", false) if *gain < SLOWER => "not stiff",
        ("dop853", false) => "fast, not stiff",
        (_, true) => "no longer stiff",
        _ => "stiff",
    };
    let verdict = if wins { "comes" } else { "comes only" };
    let filter = if kind == "fast, not stiff" { FILTER } else { "" };
    format!(
        "{kind}. At t = {} s the fastest mode {mode} and {own} takes steps of {} s; tried there, {other} {verdict} {} times as \
         far for the same work{filter}",
        two(*t),
        two(*step),
        two(*gain)
    )
}
