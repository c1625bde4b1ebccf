//! The cheapest method for a model whose own error is a tenth of the promise.

use super::base::{METHOD, accuracy, at};
use super::bench::Bench;
use super::run::ModelRun;
use super::search::{FoundModel, NUMERICAL, Trial};
use super::source::write_method;
use crate::error::percent;
use crate::method_spec::MethodSpec;
use crate::simulate::{Method, known_methods};

/// The loosest tolerance that is tried.
const LOOSEST: f64 = 0.01;
/// The first tolerance that is tried, of what is promised.
const FIRST: f64 = 0.01;
/// Steps from one tolerance, or fixed step, to the next.
const TIGHTER: f64 = 0.1;
const LONGER: f64 = 2.0;
/// Tolerances of one method.
const TOLERANCES: usize = 4;
/// A method is taken if it costs so much less.
const CHEAPER: f64 = 0.9;
/// At so many times the cost of the best one a method is given up.
const DEARER: f64 = 1.5;
/// Tries methods and tolerances on the model that is found, and takes the cheapest that keeps the promise: the scene's own
/// method, those that an automatic choice knows, and the best of them without its projection.
pub fn cheapest(bench: &mut Bench, found: &mut FoundModel) {
    let own = found.run.method.clone();
    let exact = found.run.rows.clone();
    try_method(bench, found, &exact, own.clone());
    let system = bench.mechanism(&found.scene);
    let known = system.map(|model| known_methods(model.system(), (first(bench, &own), own.atol)));
    for method in known.into_iter().flatten().filter(|method| method.triple() != own.triple()) {
        try_method(bench, found, &exact, Method { rtol: own.rtol, atol: own.atol, ..method });
    }
    let none = MethodSpec::named("none");
    let bare = Method { projection: none, ..found.run.method.clone() };
    if bare != found.run.method && bare.triple() != own.triple() && !bench.is_over(0) {
        attempt(bench, found, &exact, &bare);
    }
}

/// The first tolerance that is tried.
fn first(bench: &Bench, own: &Method) -> f64 {
    // A scene may ask for less than the loosest tolerance that is tried.
    (FIRST * bench.promise.within).clamp(own.rtol, LOOSEST.max(own.rtol))
}

/// From a loose tolerance to tighter ones until one will do; where the first does, to looser ones.
fn try_method(bench: &mut Bench, found: &mut FoundModel, exact: &[Vec<f64>], own: Method) {
    let mut method = match own.step {
        Some(step) => Method { step: Some(LONGER * step), ..own.clone() },
        None => at(&own, first(bench, &own)),
    };
    let mut known = None;
    for _ in 0..TOLERANCES {
        if method == found.run.method || bench.is_over(0) {
            return;
        }
        let verdict = attempt(bench, found, exact, &method);
        if verdict == NumericsVerdict::Dear || *known.get_or_insert(verdict) != verdict {
            return;
        }
        method = match (verdict, method.step) {
            (NumericsVerdict::Good, Some(step)) => Method { step: Some(LONGER * step), ..method },
            (NumericsVerdict::Good, None) if method.rtol < LOOSEST => at(&method, (method.rtol / TIGHTER).min(LOOSEST)),
            (NumericsVerdict::Poor, None) if TIGHTER * method.rtol > own.rtol => at(&method, TIGHTER * method.rtol),
            _ => return,
        };
    }
}

/// What is known of a method at a tolerance.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum NumericsVerdict {
    /// It keeps the promise.
    Good,
    /// It does not.
    Poor,
    /// It takes much longer than the best one.
    Dear,
}

/// Runs the model by a method, and takes that if it is good and cheaper.
fn attempt(bench: &mut Bench, found: &mut FoundModel, exact: &[Vec<f64>], method: &Method) -> NumericsVerdict {
    let mut scene = found.scene.clone();
    write_method(&mut scene, method);
    let what = format!("{} at {}", method.triple(), accuracy(method));
    let result = bench.run(&scene, &what, DEARER * found.run.seconds);
    let mut reason = result.as_ref().map_or_else(Clone::clone, |run| refusal(bench, run, exact));
    let best = bench.cost(&found.run);
    let seconds = result.as_ref().map_or(0.0, |run| bench.cost(run));
    let is_cheaper = seconds < CHEAPER * best;
    if let (Ok(run), true) = (&result, reason.is_empty() && is_cheaper) {
        reason = found.take(bench, scene, run).err().unwrap_or_default();
    }
    let is_good = reason.is_empty();
    let is_dear = seconds > DEARER * best || result.as_ref().is_ok_and(|run| run.is_too_slow);
    let verdict = if is_dear {
        NumericsVerdict::Dear
    } else if is_good {
        NumericsVerdict::Good
    } else {
        NumericsVerdict::Poor
    };
    if is_good && !is_cheaper {
        reason = "it costs as much".to_string();
    }
    found.trials.push(Trial {
        candidate: METHOD.to_string(),
        subjects: vec![method.triple()],
        what: vec![what],
        why: "its own error is a tenth of the promise".to_string(),
        estimated: NUMERICAL * bench.promise.within,
        run: result.ok(),
        is_kept: is_good && is_cheaper,
        reason,
    });
    verdict
}

/// Reason to refuse a method; empty if it is good.
fn refusal(bench: &Bench, run: &ModelRun, exact: &[Vec<f64>]) -> String {
    let numerical = bench.promise.difference(exact, &run.rows).unwrap_or(f64::INFINITY);
    let is_coarse = numerical > NUMERICAL * bench.promise.within;
    let reason = run.refusal(bench.promise.within);
    reason.or_else(|| is_coarse.then(|| format!("its own error is {}", percent(numerical)))).unwrap_or_default()
}
