//! A run that was saved at an accepted step, after one that was refused, or among the rows of one, and goes on from there is, bit by bit,
//! the run that went on by itself.

use crate::scenes::{Ready, parse, shipped};
use holonom::integrator::{self, Steps};
use holonom::method_spec::MethodSpec;
use holonom::projection;
use holonom::simulate::{Checkpoint, Method, Observation, Outcome, Sink, Span, Start, Stop, simulate_from};
use rayon::prelude::*;
use std::cell::Cell;

/// Steps of a run with fixed ones.
const STEPS: f64 = 40.0;

/// A mass on a spring whose floor it hits, pushed by a table, a pulse and a sine.
const EVENTS: &str = r#"{ "name": "events", "dimension": 2, "gravity": [0, -9.81],
    "parameters": { "l": 1 },
    "ground": { "markers": { "O": [0, 0] } },
    "bodies": [{ "name": "rod", "type": "rigid", "mass": 1, "inertia": "l^2/12", "markers": { "A": ["-l/2", 0], "B": ["l/2", 0] },
                 "initial": { "position": ["l/2", 0] } }],
    "joints": [{ "name": "O", "type": "revolute", "between": ["ground.O", "rod.A"] }],
    "forces": [
        { "name": "floor", "type": "applied_torque", "at": "rod", "torque": "if(rod.angle < -1, -200*(rod.angle + 1), 0)" },
        { "name": "push", "type": "applied_torque", "at": "rod",
          "torque": "table(t, 0, 0, 0.2, 1, 0.31, -2, 0.5, 3, 1, 0) + exp(-((t - 0.4)/0.003)^2) + if(t > 0.6, sin(40*t), 0)" }],
    "simulation": { "t_end": 1 } }"#;

fn cases() -> Vec<(Ready, f64)> {
    let shipped = |name: &str, end: f64| (shipped(name, &[]), end);
    vec![
        shipped("four_bar_spring", 0.4),
        (parse(EVENTS), 0.8),
        shipped("quarter_car", 0.7),
        shipped("half_car", 0.5),
        shipped("slider_crank_singular", 1.2),
        shipped("parallelogram_redundant", 0.3),
        shipped("bricard", 0.2),
        shipped("spinning_top", 0.05),
        shipped("flexible_pendulum", 0.02),
    ]
}

/// Methods whose solvers begin again where a run is continued.
const BY_DIFFSOL: [&str; 4] = ["tr_bdf2", "esdirk34", "tsit45", "diffsol"];

/// Everything that goes together and continues bit by bit.
fn methods(ready: &Ready, span: Span) -> Vec<Method> {
    let mut all = Vec::new();
    for entry in integrator::registry().iter().filter(|entry| !BY_DIFFSOL.contains(&entry.name)) {
        for formulation in entry.accepts() {
            for projection in projection::registry() {
                let step = (entry.steps == Steps::Fixed).then_some((span.end - span.start) / STEPS);
                let named = MethodSpec::named;
                let (formulation, integrator, projection) =
                    (named(formulation), named(entry.name), named(projection.name));
                let method = Method { formulation, integrator, projection, rtol: 1e-5, atol: 1e-7, step };
                all.push(method.clone());
                if entry.name == "dopri5" {
                    // No step is a binary fraction.
                    all.push(Method { step: Some((span.end - span.start) / 37.0), ..method });
                }
            }
        }
    }
    let (q, v) = ready.0.start();
    // Rattle takes no quaternions.
    let is_possible = |method: &Method| {
        simulate_from(ready.system(), method, span, Start::State(q, v), &mut Numbers::up_to(1)).is_ok()
    };
    all.retain(is_possible);
    all
}

/// Every number that a run shows; stops it after so many accepted states, or one attempt later, which may be refused.
struct Numbers {
    accepted: Vec<Vec<u64>>,
    rows: Vec<Vec<u64>>,
    most: usize,
    attempts: Cell<usize>,
}

impl Numbers {
    fn up_to(most: usize) -> Self {
        Numbers { accepted: Vec::new(), rows: Vec::new(), most, attempts: Cell::new(0) }
    }
}

fn bits(at: &Observation) -> Vec<u64> {
    let states = at.q.iter().chain(at.v).chain(at.vdot).chain(at.lambda);
    let residuals = at.phi.iter().chain(at.phi_dot).chain(at.phi_ddot);
    [at.t, at.work].iter().chain(states).chain(residuals).map(|x| x.to_bits()).collect()
}

impl Sink for Numbers {
    fn accepted(&mut self, state: &Observation) {
        self.accepted.push(bits(state));
    }

    fn row(&mut self, state: &Observation) {
        self.rows.push(bits(state));
    }

    fn stops(&self) -> Option<Stop> {
        let is_last = self.accepted.len() >= self.most;
        let is_over = is_last && self.attempts.get() == 0;
        self.attempts.set(self.attempts.get().saturating_sub(usize::from(is_last)));
        is_over.then(|| Stop { reason: "saved".to_string(), hint: String::new() })
    }
}

fn run(
    ready: &Ready,
    method: &Method,
    span: Span,
    start: Start,
    (most, attempts): (usize, usize),
) -> (Outcome, Option<Checkpoint>, Numbers) {
    let mut numbers = Numbers { attempts: Cell::new(attempts), ..Numbers::up_to(most) };
    let (outcome, saved) = simulate_from(ready.system(), method, span, start, &mut numbers).unwrap();
    (outcome, saved, numbers)
}

/// Through JSON.
fn written(saved: &Checkpoint) -> Checkpoint {
    let read: Checkpoint = serde_json::from_str(&serde_json::to_string(saved).unwrap()).unwrap();
    assert_eq!(&read, saved);
    read
}

/// What is saved, without the counters of work unless that is the same.
fn values(saved: &Checkpoint, is_more_work: bool) -> serde_json::Value {
    let mut values = serde_json::to_value(saved).unwrap();
    if is_more_work {
        ["statistics", "factored", "progress"].iter().for_each(|counter| {
            values.as_object_mut().unwrap().remove(*counter);
        });
    }
    values
}

/// Where the run that goes on differs from the one that went on, if it does; how many restarts were compared.
fn compared(ready: &Ready, method: &Method, span: Span) -> Result<usize, String> {
    let (q, v) = ready.0.start();
    let start = Start::State(q, v);
    let (whole, last, all) = run(ready, method, span, start, (usize::MAX, 0));
    let Some(last) = last else { return Ok(0) };
    let count = all.accepted.len();
    let mut stops = vec![(1, 0), (count / 2, 0), (count / 2, 1), (count - 1, 0)];
    stops.retain(|(place, _)| (1..count).contains(place));
    stops.dedup();
    for &stop in &stops {
        let (_, saved, first) = run(ready, method, span, start, stop);
        let (Some(saved), place) = (saved, first.accepted.len()) else {
            return Err(format!("{stop:?}: nothing saved"));
        };
        if place == count {
            continue;
        }
        if first.accepted != all.accepted[..place] {
            return Err(format!("{place}: the run to be saved is another one"));
        }
        let (outcome, saved, rest) = run(ready, method, span, Start::Saved(&written(&saved)), (usize::MAX, 0));
        // Where the form of the equations changes at the saved state, the run shows it with v' before, and this one after that.
        let length = 2 + q.len() + v.len();
        if rest.accepted[0][..length] != all.accepted[place - 1][..length] {
            return Err(format!("{place} of {count}: another state"));
        }
        if let Some(k) = (1..=count - place).find(|k| rest.accepted.get(*k) != all.accepted.get(place - 1 + k)) {
            return Err(format!("{place} of {count}: differs {k} steps later"));
        }
        let shown = all.rows.len().saturating_sub(rest.rows.len() - 1);
        if rest.rows[1..] != all.rows[shown..] {
            return Err(format!("{place} of {count}: other rows"));
        }
        // A step that was left among its rows is taken, and counted, again.
        let times = [&first.accepted, &first.rows].map(|shown| shown.last().map(|bits| f64::from_bits(bits[0])));
        let is_among_rows = times[1] > times[0];
        if (outcome.t, &outcome.q, &outcome.v) != (whole.t, &whole.q, &whole.v) {
            return Err(format!("{place} of {count}: {outcome:?} {whole:?}"));
        }
        if !is_among_rows && outcome.statistics != whole.statistics {
            return Err(format!("{place} of {count}: {:?} {:?}", outcome.statistics, whole.statistics));
        }
        let saved = saved.map(|saved| values(&saved, is_among_rows));
        if saved.as_ref() != Some(&values(&last, is_among_rows)) {
            return Err(format!("{place} of {count}: saved\n{saved:?}\n{last:?}"));
        }
    }
    Ok(stops.len())
}

#[test]
fn a_run_that_goes_on_is_the_one_that_went_on() {
    let mut wrong = Vec::new();
    for (ready, end) in cases() {
        let span = Span { start: 0.0, end, output_step: end / 7.0 };
        let methods = methods(&ready, span);
        let found: Vec<_> = methods.par_iter().map(|method| (method, compared(&ready, method, span))).collect();
        let name = &ready.0.name;
        let told = |(method, found): &(&Method, Result<usize, String>)| {
            Some(format!("{name}, {}: {}", method.triple(), found.as_ref().err()?))
        };
        wrong.extend(found.iter().filter_map(told));
        let restarts: usize = found.iter().filter_map(|(_, found)| found.as_ref().ok()).sum();
        // Most methods go together with the scene, and come five steps far.
        assert!(restarts > 2 * methods.len(), "{name}: {restarts} restarts of {} runs", methods.len());
    }
    assert!(wrong.is_empty(), "{} differ:\n{}", wrong.len(), wrong.join("\n"));
}

/// The solvers of diffsol begin again: the run is the same within a hundred tolerances, and its checkpoint says so.
#[test]
fn a_run_by_diffsol_goes_on_within_the_tolerance() {
    let ready = shipped("pendulum", &[]);
    let rtol = 1e-7;
    let span = Span { start: 0.0, end: 1.0, output_step: 0.5 };
    let (q, v) = ready.0.start();
    for integrator in BY_DIFFSOL {
        for formulation in integrator::find(&MethodSpec::named(integrator)).unwrap().accepts() {
            let [formulation, integrator, projection] = [formulation, integrator, "none"].map(MethodSpec::named);
            let method = Method { formulation, integrator, projection, rtol, atol: rtol, step: None };
            let (whole, ..) = run(&ready, &method, span, Start::State(q, v), (usize::MAX, 0));
            let (_, saved, _) = run(&ready, &method, span, Start::State(q, v), (7, 0));
            let saved = saved.unwrap();
            assert!(!saved.is_exact(), "{}", method.triple());
            let (outcome, ..) = run(&ready, &method, span, Start::Saved(&saved), (usize::MAX, 0));
            let error = crate::common::distance(&outcome.q, &whole.q);
            assert!(outcome.failure.is_none() && error < 100.0 * rtol, "{}: {error:e}", method.triple());
        }
    }
}
