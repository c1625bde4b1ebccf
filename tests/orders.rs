//! Convergence orders of every accepted triple formulation x integrator x projection in q, v and lambda, and the
//! orders of the drift.

use crate::common::driven_pendulum::{DrivenPendulum, start};
use crate::common::orders::{self, END, Rows, integrators, steps};
use crate::common::{fixed, run, until};
use holonom::integrator::IntegratorEntry;
use holonom::simulate::{Method, Span};

const LEVELS: [(&str, std::ops::Range<usize>); 3] = [("q", 1..5), ("v", 5..9), ("lambda", 9..11)];

/// q, v and lambda at eight times.
fn solution(method: &Method) -> Rows {
    let (q, v) = start();
    let span = Span { output_step: END / 8.0, ..until(END) };
    run(&DrivenPendulum, method, span, (&q, &v)).completed().record.trajectory.rows
}

fn errors(rows: &Rows, reference: &Rows) -> [f64; 3] {
    LEVELS.map(|(_, columns)| orders::error(rows, reference, &columns))
}

#[test]
fn every_triple_has_the_order_of_its_integrator() {
    check_orders(|entry| (steps(entry), 0.3));
}

/// Of order 8 the next term of the interpolation's error still counts at steps that leave errors of 1e-12: found 7.49 to 8.49,
/// and 0.2 farther off at steps a fifth longer.
#[test]
fn rows_between_steps_have_the_order_of_the_steps() {
    check_orders(|entry| match entry.order {
        8 => ([41, 49], 0.55),
        _ => (steps(entry).map(|n| n + 1), 0.3),
    });
}

/// In these two numbers of steps, to so much.
fn check_orders(of: impl Fn(&IntegratorEntry) -> ([usize; 2], f64) + Sync) {
    let reference = solution(&fixed("index1", "dop853", "exact", END / 160.0));
    orders::check(&LEVELS, &reference, of, solution);
}

/// A low penalty solves another problem, with the same order: its own solution at fine steps is the reference, and not
/// that of the equations of motion, from which it stays away. Without projections, which would take it there.
#[test]
fn a_low_penalty_has_the_order_of_its_integrator_and_an_error_of_its_own() {
    let formulation = "penalty:penalty=1e4,omega=1";
    let solution = |formulation, integrator, projection, n: usize| {
        solution(&fixed(formulation, integrator, projection, END / n as f64))
    };
    let reference = solution(formulation, "dop853", "none", 160);
    // 1e-4 of the accelerations; measured.
    let [q, v, lambda] = errors(&reference, &solution("index1", "dop853", "exact", 160));
    assert!(q > 1e-5 && v > 1e-5 && lambda > 1e-5, "{q:e} {v:e} {lambda:e}");
    for entry in integrators().filter(|entry| entry.takes("penalty")) {
        let [coarse, fine] = steps(entry);
        let found = [coarse, fine].map(|n| errors(&solution(formulation, entry.name, "none", n), &reference));
        for level in 0..3 {
            let order = (found[0][level] / found[1][level]).ln() / (fine as f64 / coarse as f64).ln();
            assert!((order - entry.order as f64).abs() < 0.3, "{}: {order:.2}, {found:?}", entry.name);
        }
    }
}

/// Orders of max |phi| and max |G v + phi_t| from halving the step of index 1 with this projection.
fn drift_orders(integrator: &str, projection: &str, steps: usize) -> [f64; 2] {
    let (q, v) = start();
    let drift = |steps: usize| {
        let method = fixed("index1", integrator, projection, END / steps as f64);
        run(&DrivenPendulum, &method, until(END), (&q, &v)).completed().drift()
    };
    let coarse = drift(steps);
    let fine = drift(2 * steps);
    [(coarse.0 / fine.0).log2(), (coarse.1 / fine.1).log2()]
}

/// Ascher, Chin, Reich, Numer. Math. 67 (1994): one sweep leaves 2 (p + 1) where H F = I.
#[test]
fn drift_has_its_orders() {
    // At these steps the smallest of the drifts is still 100 times above its round-off of 2e-16.
    for (integrator, p, steps) in [("heun", 2.0, 96), ("rk4", 4.0, 16)] {
        let expect = |projection: &str, orders: [Option<f64>; 2]| {
            let found = drift_orders(integrator, projection, steps);
            for (found, expected) in found.into_iter().zip(orders).filter_map(|(f, e)| Some((f, e?))) {
                assert!((found - expected).abs() < 0.35, "{integrator} {projection}: {found:.2}, not {expected}");
            }
        };
        let double = 2.0 * (p + 1.0);
        expect("none", [Some(p), Some(p)]);
        expect("manifold", [Some(double), Some(p + 1.0)]);
        // phi is at round-off after the second sweep.
        expect("manifold:sweeps=2", [None, Some(double)]);
        expect("full", [Some(double), Some(double)]);
        expect("full:metric=mass", [Some(double), Some(double)]);
        // One Newton step, then the velocities, which are linear and so at round-off.
        expect("exact:iterations=1", [Some(double), None]);
    }
}

#[test]
fn projections_that_end_at_round_off() {
    let (q, v) = start();
    let drift = |projection: &str| {
        let method = fixed("index1", "rk4", projection, END / 32.0);
        run(&DrivenPendulum, &method, until(END), (&q, &v)).completed().drift()
    };
    // A few units in the last place of squared lengths and their rates.
    let round_off = 4.0 * f64::EPSILON;
    assert!(drift("manifold:sweeps=2").0 < round_off);
    assert!(drift("velocity").1 < round_off);
    let (position, velocity) = drift("exact");
    assert!(position < round_off && velocity < round_off);
    assert!(drift("position:sweeps=2").0 < round_off);
    // Holding one level alone leaves the other as it was, or worse.
    assert!(drift("velocity").0 > 1e-6 && drift("position").1 > 1e-5);
}
