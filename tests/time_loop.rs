//! The time loop: where steps and rows lie, what is counted, how a run fails.

use crate::common::driven_pendulum::{self, DrivenPendulum};
use crate::common::unconstrained::Exponential;
use crate::common::{Run, adaptive, fixed, method, run, until};
use holonom::analysis::Recorder;
use holonom::formulation::{Dynamics, Statistics, Work};
use holonom::math::Scalar;
use holonom::simulate::{Method, Observation, Outcome, Sink, Span, Stop, simulate};
use holonom::system::Equations;
use rayon::prelude::*;

fn pendulum(method: &Method, span: Span) -> Run {
    let (q, v) = driven_pendulum::start();
    run(&DrivenPendulum, method, span, (&q, &v))
}

fn exponential(method: &Method, span: Span) -> Run {
    let start = Exponential::exact(span.start);
    run(&Exponential, method, span, (&start[..1], &start[1..]))
}

fn bits(run: &Run) -> Vec<u64> {
    run.record.trajectory.rows.iter().flatten().map(|x| x.to_bits()).collect()
}

#[test]
fn fixed_steps_end_exactly_at_the_end() {
    let count = |step: f64, start: f64, end: f64| {
        let span = Span { start, end, output_step: end - start };
        let run = exponential(&fixed("index1", "rk4", "none", step), span).completed();
        assert_eq!(run.outcome.t, end);
        assert_eq!(run.record.trajectory.rows.last().unwrap()[0], end);
        run.outcome.statistics.steps
    };
    assert_eq!(count(10.0, 0.0, 1.0), 1);
    assert_eq!(count(0.3, 0.0, 1.0), 4);
    assert_eq!(count(0.25, 0.0, 1.0), 4);
    // 0.001 and 1/3000 are no binary fractions; adding them up would miss the end.
    assert_eq!(count(0.001, 0.0, 10.0), 10_000);
    assert_eq!(count(0.001, 0.1, 10.1), 10_000);
    assert_eq!(count(1.0 / 3000.0, -1.0, 1.0), 6000);
}

#[test]
fn rows_lie_at_exact_multiples() {
    for method in [adaptive("index1", "dopri5", "none", 1e-6), fixed("index1", "rk4", "none", 0.03)] {
        let times = |start: f64, end: f64, output_step: f64| -> Vec<f64> {
            let run = exponential(&method, Span { start, end, output_step }).completed();
            run.record.trajectory.times().collect()
        };
        let multiples = |start: f64, step: f64, n: u32| (0..n).map(move |k| start + f64::from(k) * step);
        // 2 s is a multiple of 0.1 s: 21 rows, the last at the end itself.
        let expected: Vec<f64> = multiples(0.0, 0.1, 20).chain([2.0]).collect();
        assert_eq!(times(0.0, 2.0, 0.1), expected);
        // 1.5 s is none of 0.4 s: one more row at the end.
        let expected: Vec<f64> = multiples(0.5, 0.4, 4).chain([2.0]).collect();
        assert_eq!(times(0.5, 2.0, 0.4), expected);
        // Rows closer than the steps, and an output step beyond the end.
        assert_eq!(times(0.0, 0.1, 0.0001).len(), 1001);
        assert_eq!(times(0.0, 0.1, 5.0), [0.0, 0.1]);
    }
}

#[test]
fn rows_between_steps_are_on_the_manifold_too() {
    let method = fixed("index1", "dopri5", "manifold:sweeps=2", 0.05);
    let run = pendulum(&method, Span { output_step: 0.01, ..until(2.0) }).completed();
    // Interpolated to h^5, which two sweeps bring to round-off in phi and to its square in phi'.
    assert!(run.record.drift_rows.iter().all(|[phi, phi_dot, _]| *phi < 1e-15 && *phi_dot < 1e-11));
}

#[test]
fn rows_do_not_change_the_steps() {
    let method = adaptive("index1", "dop853", "manifold", 1e-8);
    let few = pendulum(&method, until(2.0)).completed();
    let many = pendulum(&method, Span { output_step: 0.001, ..until(2.0) }).completed();
    let steps = |run: &Run| {
        let statistics = Statistics { rows: Work::default(), ..run.outcome.statistics };
        Outcome { statistics, ..run.outcome.clone() }
    };
    assert_eq!(steps(&few), steps(&many));
    assert_eq!(many.record.trajectory.rows.len(), 2001);
}

#[test]
fn runs_are_repeatable_bit_by_bit() {
    let method = adaptive("invariant_manifold", "dopri5", "full", 1e-7);
    let span = Span { output_step: 0.01, ..until(2.0) };
    let runs: Vec<_> = (0..4).into_par_iter().map(|_| pendulum(&method, span).completed()).collect();
    assert!(runs.iter().all(|run| bits(run) == bits(&runs[0]) && run.outcome == runs[0].outcome));
}

/// Evaluations a fixed step: the stages, and y' at the new state, which dopri5 has already where nothing moved it.
#[test]
fn work_is_counted() {
    let n = 50;
    for (integrator, projection, evaluations, sweeps) in [
        ("heun", "none", 2, 0),
        ("rk4", "none", 4, 0),
        ("rk4", "manifold", 4, 1),
        ("rk4", "manifold:sweeps=2", 4, 2),
        // One Newton step, and the evaluation that the velocities share with the test of the residual.
        ("rk4", "exact:iterations=1", 4, 2),
        ("dopri5", "none", 6, 0),
        ("dopri5", "velocity", 7, 1),
        ("dop853", "none", 12, 0),
        ("dop853", "manifold", 12, 1),
    ] {
        let counts =
            pendulum(&fixed("index1", integrator, projection, 0.02), until(1.0)).completed().outcome.statistics;
        assert_eq!((counts.steps, counts.rejected), (n, 0));
        assert_eq!(counts.rhs_evaluations, 1 + evaluations * n, "{integrator} {projection}");
        assert_eq!(counts.projections, sweeps * n, "{integrator} {projection}");
        assert_eq!(counts.factorizations, counts.rhs_evaluations + counts.projections, "{integrator} {projection}");
    }
    // Newton's method is quadratic: two steps to round-off, a third that shows it.
    let counts = pendulum(&fixed("index1", "rk4", "exact", 0.02), until(1.0)).completed().outcome.statistics;
    assert!(counts.projections <= 3 * n, "{counts:?}");
}

/// Two rows within each step and one at the end of every second: an evaluation and a projection each, and what the
/// interpolation takes; before them a look at the start, which counts no factorization. The work of the steps stays as it is without rows.
#[test]
fn work_of_rows_is_counted_beside_that_of_steps() {
    let rows = Span { output_step: 0.008, ..until(1.0) };
    for (formulation, integrator, projection, stages) in [
        ("index1", "rk4", "none", 0),
        ("index1", "rk4", "manifold", 0),
        ("index1", "dopri5", "manifold", 0),
        ("index1", "dop853", "manifold", 3),
        ("index2", "hem4", "manifold", 0),
        ("index2", "hem5", "none", 1),
        ("index2", "phem56", "manifold", 1),
    ] {
        let method = fixed(formulation, integrator, projection, 0.02);
        let [all, none] = [rows, until(1.0)].map(|span| pendulum(&method, span).completed().outcome.statistics);
        assert_eq!(all.of_steps(), none.of_steps(), "{integrator}");
        let Work { rhs_evaluations, factorizations, projections, .. } = all.rows;
        let sweeps = if projection == "none" { 0 } else { 100 };
        assert_eq!([rhs_evaluations, projections], [127 + 50 * stages, sweeps], "{integrator} {projection}");
        assert_eq!(factorizations, rhs_evaluations - 1 + projections, "{integrator} {projection}");
        // The look at the start, its row, and that at the end.
        assert_eq!(none.rows.rhs_evaluations, 3, "{integrator}");
    }
}

/// A step of its own to each row, of three stages or more, with a factorization.
#[test]
fn rows_of_radau_iia_cost_more_than_its_steps() {
    let method = adaptive("index2", "radau_iia", "none", 1e-8);
    let rows = Span { output_step: 1e-3, ..until(1.0) };
    let [all, none] = [rows, until(1.0)].map(|span| pendulum(&method, span).completed().outcome.statistics);
    assert_eq!(all.of_steps(), none.of_steps());
    assert!(all.rows.rhs_evaluations > 3000 && all.rows.factorizations > 900, "{all:?}");
    assert!(all.rows.newton_iterations > 900 && all.rows.rhs_evaluations > all.rhs_evaluations, "{all:?}");
}

/// Compares lambda and phi' of every accepted state with those of a fresh evaluation.
struct Fresh<'a>(Dynamics<'a>, u32);

impl Sink for Fresh<'_> {
    fn accepted(&mut self, state: &Observation) {
        self.0.solve(state.t, state.q, state.v, |_, _| 0.0).unwrap();
        assert_eq!(self.0.lambda, state.lambda);
        assert_eq!(self.0.terms.phi_dot, state.phi_dot);
        self.1 += 1;
    }
}

#[test]
fn observed_terms_are_those_of_the_accepted_state() {
    let (q, v) = driven_pendulum::start();
    for projection in ["none", "manifold", "exact"] {
        for integrator in ["dopri5", "dop853"] {
            let mut fresh = Fresh(Dynamics::new(&DrivenPendulum), 0);
            let method = method("index1", integrator, projection);
            simulate(&DrivenPendulum, &method, until(1.0), (&q, &v), &mut fresh).unwrap();
            assert!(fresh.1 > 5);
        }
    }
}

#[test]
fn an_inconsistent_start_is_refused_by_name() {
    // The pivot has moved 0.3 m by 0.5 s.
    let method = adaptive("index1", "dopri5", "manifold", 1e-6);
    let Run { outcome, .. } = pendulum(&method, Span { start: 0.5, ..until(2.0) });
    let failure = outcome.failure.unwrap();
    assert!(failure.t == 0.5 && failure.reason.contains("consistent"), "{failure:?}");
}

/// A force that is not a number after 0.5 s.
struct Spoilt;

impl Equations for Spoilt {
    fn size(&self) -> (usize, usize) {
        (1, 0)
    }
    fn mass<S: Scalar>(&self, _t: S, _q: &[S], mass: &mut [S]) {
        mass[0] = S::one();
    }
    fn force<S: Scalar>(&self, t: S, q: &[S], _v: &[S], f: &mut [S]) {
        f[0] = if t.value() > 0.5 { S::constant(f64::NAN) } else { -q[0] };
    }
    fn phi<S: Scalar>(&self, _t: S, _q: &[S], _phi: &mut [S]) {}
}

#[test]
fn forces_that_are_no_numbers_end_the_run_where_they_begin() {
    let span = Span { output_step: 0.1, ..until(1.0) };
    for (method, slack) in [
        (fixed("index1", "rk4", "none", 0.1), 0.0),
        (adaptive("index1", "dopri5", "none", 1e-8), 1e-12),
        (adaptive("index1", "dop853", "manifold", 1e-8), 1e-12),
    ] {
        let Run { outcome, record } = run(&Spoilt, &method, span, (&[1.0], &[0.0]));
        let failure = outcome.failure.unwrap();
        // An adaptive method closes in by steps a quarter of the last.
        assert!(failure.t <= 0.5 && failure.t >= 0.5 - slack, "{failure:?}");
        assert!(failure.reason.contains("the force on `v1` is infinite or not a number"), "{failure:?}");
        assert_eq!(outcome.t, failure.t);
        assert!((outcome.q[0] - 0.5_f64.cos()).abs() < 1e-6);
        assert!(record.trajectory.rows.len() >= 5);
        assert!(record.trajectory.rows.iter().flatten().all(|x| x.is_finite()));
    }
    // From the start on: there is no row that could be right.
    let span = Span { start: 0.6, ..span };
    let Run { outcome, record } = run(&Spoilt, &method("index1", "dopri5", "none"), span, (&[1.0], &[0.0]));
    assert_eq!((outcome.failure.unwrap().t, record.trajectory.rows.len()), (0.6, 0));
}

/// What ends a run from outside is told as any failure is, and the last state stays.
#[test]
fn a_run_is_stopped_between_steps() {
    use std::cell::Cell;
    let system = Exponential;
    let asked = Cell::new(0);
    let stop = || {
        asked.set(asked.get() + 1);
        (asked.get() > 5).then(|| Stop { reason: "enough".to_string(), hint: "ask again".to_string() })
    };
    let mut recorder = Recorder::new(&system).with_stop(stop);
    let start = Exponential::exact(0.0);
    let span = Span { start: 0.0, end: 1.0, output_step: 1.0 };
    let method = fixed("index1", "rk4", "none", 0.01);
    let outcome = simulate(&system, &method, span, (&start[..1], &start[1..]), &mut recorder).unwrap();
    let failure = outcome.failure.unwrap();
    assert_eq!((failure.reason.as_str(), failure.hint.as_str()), ("enough", "ask again"));
    assert_eq!((outcome.statistics.steps, failure.t), (5, 0.05));
    assert_eq!(recorder.finish().trajectory.times().last(), Some(0.05));
}
