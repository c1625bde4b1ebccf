//! Evaluation without memory: y' and lambda at a state depend on that, the scene and what is settled for a step, never on what
//! was evaluated before.

use crate::scenes::{load, models};
use holonom::analysis::Recorder;
use holonom::formulation::{self, Dynamics};
use holonom::integrator::Problem;
use holonom::method_spec::MethodSpec;
use holonom::simulate::{Method, Span, simulate};
use holonom::system::MechanicalSystem;
use rayon::prelude::*;

/// Larger systems are left to the sparse formulations.
const DENSE: usize = 60;
/// States that a used solver has seen before each that is compared.
const SEEN: usize = 25;

struct State {
    t: f64,
    y: Vec<f64>,
}

/// States of the motion by the scene's own method, as many off the constraints, one far away and one that is none.
fn states(path: &std::path::Path) -> (crate::scenes::Ready, Vec<State>) {
    let ready = load(path, &[]);
    let system = ready.system();
    let span = ready.span();
    let end = span.start + 0.1 * (span.end - span.start);
    let mut recorder = Recorder::new(system);
    let some = Span { start: span.start, end, output_step: (end - span.start) / 6.0 };
    let _ = simulate(system, &ready.0.method, some, ready.0.start(), &mut recorder).unwrap();
    let record = recorder.finish();
    let of = |row: &Vec<f64>| {
        let (q, v, _) = record.trajectory.row_state(row);
        State { t: row[0], y: [q, v, &[0.0]].concat() }
    };
    let on: Vec<State> = record.trajectory.rows.iter().map(of).collect();
    let off = |(k, state): (usize, &State)| {
        let size = [1e-9, 1e-4, 0.1, 10.0][k % 4];
        let moved = |(i, y): (usize, &f64)| y + size * (1.3 * i as f64 + k as f64).sin();
        State { t: state.t, y: state.y.iter().enumerate().map(moved).collect() }
    };
    let mut all: Vec<State> = on.iter().enumerate().map(off).collect();
    all.extend([State { t: 0.0, y: vec![0.0; on[0].y.len()] }, State { t: 0.0, y: vec![1e200; on[0].y.len()] }]);
    // Those of the motion are looked at after the worst.
    all.extend(on);
    (ready, all)
}

fn problem<'s>(system: &'s dyn MechanicalSystem, formulation: &MethodSpec, settled: &[f64]) -> Problem<'s> {
    let mut problem = Problem::new(Dynamics::new(system), formulation::make(formulation, system).unwrap());
    problem.formulation.recall(settled);
    problem.dynamics.refer_to(0.4, 0.2);
    problem
}

/// y', v', lambda and what is said of the rank; within a step from the state, and beside it.
fn evaluated(problem: &mut Problem, State { t, y }: &State) -> Vec<Result<Vec<u64>, String>> {
    let mut evaluate = |begins: bool| {
        let mut slope = vec![0.0; y.len()];
        let begun = if begins { problem.begin_step(*t, y) } else { Ok(()) };
        let found = begun.and_then(|()| problem.derivative(*t, y, &mut slope));
        let dynamics = &problem.dynamics;
        let numbers = slope.iter().chain(&dynamics.vdot).chain(&dynamics.lambda).chain(&dynamics.rank_indicator);
        let bits = numbers.map(|x| x.to_bits()).chain([u64::from(dynamics.is_rank_deficient)]);
        found.map(|()| bits.collect()).map_err(|halt| halt.to_string())
    };
    let found = [evaluate(false), evaluate(true)];
    let mut end = y.clone();
    let ended = problem.end_step(*t, &mut end).map(|()| end.iter().map(|x| x.to_bits()).collect());
    found.into_iter().chain([ended.map_err(|halt| halt.to_string())]).collect()
}

fn fields(system: &dyn MechanicalSystem) -> impl Iterator<Item = MethodSpec> {
    let is_small = system.dimensions().v <= DENSE;
    let all = formulation::registry().iter();
    all.filter(move |entry| is_small || entry.dae.is_some() || entry.name == "penalty")
        .map(|entry| MethodSpec::named(entry.name))
}

#[test]
fn a_used_solver_solves_as_a_fresh_one() {
    models().par_iter().for_each(|path| {
        let (ready, states) = states(path);
        let system = ready.system();
        for formulation in fields(system) {
            let mut first = problem(system, &formulation, &[]);
            let start = states.last().unwrap();
            let (q, v) = first.split(&start.y);
            first.formulation.settle(start.t, q, v, &mut first.dynamics);
            let settled = first.formulation.settled();
            let mut used = problem(system, &formulation, &settled);
            for (i, state) in states.iter().enumerate() {
                (0..SEEN).for_each(|k| drop(evaluated(&mut used, &states[(7 * i + 3 * k) % states.len()])));
                let fresh = evaluated(&mut problem(system, &formulation, &settled), state);
                assert_eq!(evaluated(&mut used, state), fresh, "{path:?}, {formulation}, state {i}");
            }
        }
    });
}

#[test]
fn two_threads_find_the_same() {
    models().par_iter().for_each(|path| {
        let (ready, states) = states(path);
        let system = ready.system();
        let method = Method { rtol: 1e-6, atol: 1e-8, ..ready.0.method.clone() };
        let all = || {
            let mut problem = problem(system, &MethodSpec::named("index1"), &[]);
            let found: Vec<_> = states.iter().map(|state| evaluated(&mut problem, state)).collect();
            let mut recorder = Recorder::new(system);
            let Span { start, end, .. } = ready.span();
            let span = Span { start, end: start + 0.02 * (end - start), output_step: end };
            let outcome = simulate(system, &method, span, ready.0.start(), &mut recorder).unwrap();
            (found, outcome)
        };
        let (one, other) = std::thread::scope(|scope| {
            let [one, other] = [scope.spawn(all), scope.spawn(all)];
            (one.join().unwrap(), other.join().unwrap())
        });
        assert!(one == other, "{path:?}");
    });
}
