//! Drift of the constrained robot arm under every stabilization, against values computed by an independent program.
//!
//! The motion amplifies a perturbation about 1e4 times over the 10 s, so drifts of different programs agree only where
//! they are well above round-off, and solutions only at small steps.

use crate::common::equations::robot_arm::{END, RobotArm, START};
use crate::common::{Run, adaptive, distance, fixed, run, until};
use crate::scenes::shipped;
use holonom::simulate::{Method, Span};
use rayon::prelude::*;

/// What Newton's method leaves of G v makes accelerations of 1e6 m/s^2 in steps of 1e-15 s, to which the error estimate
/// shrank them, each accepted.
#[test]
fn steps_with_ggl_are_as_long_as_with_index1() {
    let arm = shipped("robot_arm", &[]);
    let steps = |formulation: &str| {
        let method = Method { atol: 1e-7, ..adaptive(formulation, "tr_bdf2", "none", 1e-5) };
        arm.run(&method, until(2.0)).outcome.statistics.steps
    };
    let [found, other] = ["ggl", "index1"].map(steps);
    assert!(found <= other, "{found} steps, with index1 {other}");
}

const STEPS: [f64; 3] = [0.01, 0.005, 0.001];

/// Formulation, projection, and (max |G v + phi_t|, max |phi|) over [0, 10] for each of the steps.
type Line = (&'static str, &'static str, [(f64, f64); 3]);

/// Gains g1 = 2 alpha = 12 and g0 = beta^2 = 70.
const BAUMGARTE: &str = "baumgarte:alpha=6,beta=8.366600265340756";

const HEUN: [Line; 8] = [
    ("index1", "none", [(f64::NAN, f64::NAN), (4.71e-3, 1.13e-2), (6.57e-5, 5.57e-5)]),
    (BAUMGARTE, "none", [(5.12e-1, 2.46e-2), (5.17e-2, 1.58e-3), (6.02e-4, 3.83e-5)]),
    ("index1", "position", [(1.86, 1.36e-3), (3.73e-1, 4.99e-4), (1.62e-2, 2.36e-9)]),
    ("index1", "velocity", [(5e-15, 7.43e-3), (4e-15, 1.58e-3), (4e-15, 5.80e-5)]),
    ("index1", "manifold", [(6.21e-2, 1.08e-5), (3.82e-3, 3.51e-8), (5.59e-5, 5.06e-12)]),
    ("index1", "manifold:sweeps=2", [(2.98e-5, 3.0e-12), (1.56e-6, 6e-15), (1.46e-10, 8e-16)]),
    ("index1", "full", [(7.21e-6, 6.29e-7), (3.28e-7, 3.54e-8), (3.89e-11, 5.27e-12)]),
    ("index1", "exact:iterations=1", [(3e-15, 1.69e-6), (4e-15, 6.62e-8), (4e-15, 5.39e-12)]),
];

/// `alpha = 1/h` stands for the step's own gains.
const RK4: [Line; 7] = [
    ("index1", "none", [(9.25e-3, 3.04e-2), (4.03e-4, 1.55e-3), (6.57e-7, 2.54e-6)]),
    (BAUMGARTE, "none", [(5.04e-3, 2.63e-4), (2.68e-4, 1.44e-5), (4.28e-7, 2.40e-8)]),
    ("baumgarte:alpha=1/h", "none", [(8.45e-2, 5.88e-4), (4.81e-2, 1.58e-4), (9.21e-3, 5.54e-6)]),
    ("invariant_manifold:field=both,gamma=1/h", "none", [(2.71e-2, 6.43e-4), (4.76e-3, 1.22e-4), (6.90e-5, 3.79e-6)]),
    ("index1", "manifold", [(2.19e-3, 8.72e-9), (4.96e-5, 6.05e-12), (1.74e-8, 8e-16)]),
    ("index1", "manifold:sweeps=2", [(1.97e-7, 6e-16), (7.5e-11, 7e-16), (1e-14, 7e-16)]),
    ("index1", "full", [(4.22e-7, 9.74e-8), (3.04e-10, 8.2e-11), (6e-15, 8e-16)]),
];

fn arm(formulation: &str, integrator: &str, projection: &str, step: f64) -> Run {
    let formulation = formulation.replace("1/h", &(1.0 / step).to_string());
    run(&RobotArm, &fixed(&formulation, integrator, projection, step), until(10.0), START.motion())
}

/// Two digits where the value is well above the round-off of phi and phi' (1e-16 to 1e-15); a bound where it is not.
fn agrees(found: f64, expected: f64) -> bool {
    if expected < 1e-13 { found < 1e-13 } else { (found / expected - 1.0).abs() < 0.01 }
}

fn check(integrator: &str, table: &[Line]) {
    table.par_iter().for_each(|&(formulation, projection, ref entries)| {
        for (step, &(velocity, position)) in STEPS.into_iter().zip(entries).filter(|(_, entry)| !entry.0.is_nan()) {
            let found = arm(formulation, integrator, projection, step).completed().drift();
            let what = format!("{integrator} {formulation} {projection} h = {step}: {found:?}");
            assert!(agrees(found.0, position) && agrees(found.1, velocity), "{what}");
        }
    });
}

#[test]
fn drift_with_heun() {
    check("heun", &HEUN);
}

#[test]
fn drift_with_rk4() {
    check("rk4", &RK4);
}

#[test]
fn unstabilized_heun_comes_apart_and_keeps_what_it_computed() {
    let span = Span { output_step: 0.5, ..until(10.0) };
    let Run { outcome, record } = run(&RobotArm, &fixed("index1", "heun", "none", 0.01), span, START.motion());
    let failure = outcome.failure.unwrap();
    assert!(failure.reason.contains("the joints have come apart"), "{failure:?}");
    assert!(failure.hint.contains("manifold"), "{failure:?}");
    // It leaves the constraint near 7 s and doubles its rates from then on.
    assert!(failure.t > 5.0 && failure.t < 10.0, "{failure:?}");
    assert_eq!(outcome.t, failure.t);
    let rows = &record.trajectory.rows;
    // Every half second from the start, and the last good state.
    assert_eq!(rows.len(), 2 + (failure.t / 0.5) as usize);
    assert_eq!(rows.last().unwrap()[0], failure.t);
    assert!(rows.iter().flatten().all(|x| x.is_finite()));
    assert!(outcome.q.iter().chain(&outcome.v).all(|x| x.is_finite()));
}

#[test]
fn end_state() {
    let method = adaptive("index1", "dop853", "manifold", 1e-13);
    let run = run(&RobotArm, &method, until(10.0), START.motion()).completed();
    let (q, v, lambda) = run.last();
    // The tolerance times the amplification of 1e4.
    assert!(distance(q, END.q) < 1e-9 && distance(v, END.v) < 1e-9, "{q:?} {v:?}");
    // lambda changes by about 1e2 N for 1 rad or 1 rad/s.
    assert!(distance(lambda, END.lambda) < 1e-7, "{lambda:?}");
}

#[test]
fn stabilization_lowers_the_error_of_the_solution() {
    let span = Span { output_step: 0.05, ..until(10.0) };
    let rows = |method| run(&RobotArm, &method, span, START.motion()).completed().record.trajectory.rows;
    let reference = rows(adaptive("index1", "dop853", "manifold", 1e-14));
    // Largest error of angles (rad) and rates (rad/s) over the rows with RK4 and h = 0.001.
    for (formulation, projection, expected) in
        [("index1", "none", 5.4e-3), (BAUMGARTE, "none", 5.6e-4), ("index1", "manifold", 1.2e-4)]
    {
        let rows = rows(fixed(formulation, "rk4", projection, 0.001));
        let errors = rows.iter().zip(&reference).map(|(row, exact)| distance(&row[1..5], &exact[1..5]));
        let error = errors.fold(0.0, f64::max);
        // 1.237e-4 is known as 1.2e-4.
        assert!((error / expected - 1.0).abs() < 0.04, "{formulation} {projection}: {error:e}");
    }
}
