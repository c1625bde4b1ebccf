//! How errors grow over thousands of periods of a pendulum, by method: the law of each, against the closed form. The same
//! over a million periods: `cargo bench --bench million_periods`.

#[allow(dead_code, reason = "the bench uses all of it")]
mod pendulum;

use crate::common::{fixed, stepwise};
use holonom::simulate::Method;
use pendulum::{AMPLITUDE, GRAVITY, Mark, period, phase, run};

fn marks(method: &Method, periods: &[f64]) -> Vec<Mark> {
    run(method, periods, |mark| println!("{} {mark:?}", method.integrator.name)).unwrap()
}

#[test]
fn phase_of_known_states() {
    let (sin, cos) = AMPLITUDE.sin_cos();
    assert!((phase(&[sin, -cos], &[0.0, 0.0]) - 0.25).abs() < 1e-15);
    assert!((phase(&[-sin, -cos], &[0.0, 0.0]) - 0.75).abs() < 1e-15);
    let fastest = (2.0 * GRAVITY * (1.0 - cos)).sqrt();
    assert!(phase(&[0.0, -1.0], &[fastest, 0.0]) < 1e-15);
    assert!((phase(&[0.0, -1.0], &[-fastest, 0.0]) - 0.5).abs() < 1e-15);
}

/// Laws of growth between 100 and 1000 periods, from what was reached and what its growth is: within a tenth, or a
/// quarter where steps and stages are chosen: that the pattern of both settles is measured as 1.21.
fn grows(found: impl Fn(&Mark) -> f64, marks: &[Mark], (order, chosen): (i32, bool)) {
    let ratio = found(&marks[1]) / found(&marks[0]) / 10f64.powi(order);
    assert!((ratio - 1.0).abs() < if chosen { 0.25 } else { 0.1 }, "{ratio}: {marks:?}");
}

/// Symmetric and symplectic: the energy stays, and the phase is that of another frequency, which is known.
#[test]
fn rattle_keeps_energy_and_runs_ahead_linearly() {
    let run = |steps: f64| marks(&fixed("index3", "rattle", "none", period() / steps), &[100.0, 1000.0]);
    let coarse = run(50.0);
    let fine = run(100.0);
    for (marks, largest) in [(&coarse, 5.6e-3), (&fine, 1.4e-3)] {
        grows(|mark| mark.phase, marks, (1, false));
        let [first, last] = [marks[0].largest, marks[1].largest];
        assert!(last < largest && last < 1.0001 * first, "{first:e} {last:e}");
        // Roundings of 1 m and of 4 m/s.
        assert!(marks[1].drift[0] < 1e-15 && marks[1].drift[1] < 4e-15, "{:?}", marks[1].drift);
    }
    // Order 2, and the next term of (1/50)^2.
    let ratio = coarse[1].phase / fine[1].phase;
    assert!((ratio - 4.0).abs() < 0.02, "{ratio}");
    let known = recurrence(50.0, 1000.0);
    assert!((coarse[1].phase - known).abs() < 1e-8, "{} {known}", coarse[1].phase);
}

/// Rattle on a circle is, with the turn D of a step, sin D_{n+1} = sin D_n - h^2 g sin theta_n: phase, in periods, ahead of
/// the closed form.
fn recurrence(steps: f64, periods: f64) -> f64 {
    let h = period() / steps;
    let mut theta = AMPLITUDE;
    let mut sin_turn = -0.5 * h * h * GRAVITY * AMPLITUDE.sin();
    let mut passages = 0;
    let count = (steps * periods).round() as usize;
    for _ in 0..count {
        let before = theta;
        theta += sin_turn.asin();
        sin_turn -= h * h * GRAVITY * theta.sin();
        passages += usize::from(before < 0.0 && theta >= 0.0);
    }
    // v_1 = (chord_0 + chord_1)/(2 h) along the circle, as the reactions are normal to it.
    let before = sin_turn + h * h * GRAVITY * theta.sin();
    let rate = 0.5 * (before + sin_turn) / h;
    let (sin, cos) = theta.sin_cos();
    (passages as f64 - periods) + (phase(&[sin, -cos], &[rate * cos, rate * sin]) - 0.25)
}

/// Projection holds the constraints, not the energy: that drifts by the local error, linearly, and takes the frequency
/// with it, so that the phase goes quadratically.
#[test]
fn dop853_and_radau_drift_in_energy_linearly_and_in_phase_quadratically() {
    let at = [100.0, 1000.0];
    for (method, energy, phase) in [
        (stepwise("index1", "dop853", "manifold", 1e-10), 6.2e-8, 2.3e-6),
        (stepwise("index1", "dop853", "manifold", 1e-13), 3.7e-11, 1.4e-9),
        (stepwise("ggl", "radau_iia", "none", 1e-10), 4.2e-7, 1.5e-5),
        (stepwise("ggl", "radau_iia", "none", 1e-13), 1.8e-9, 6.4e-8),
    ] {
        let marks = marks(&method, &at);
        grows(|mark| mark.energy, &marks, (1, method.integrator.name == "radau_iia"));
        grows(|mark| mark.phase, &marks, (2, method.integrator.name == "radau_iia"));
        // As measured, and a tenth.
        assert!(marks[1].largest < energy && marks[1].phase.abs() < phase, "{:?}", marks[1]);
        assert!(marks[1].drift[0] < 1e-11 && marks[1].drift[1] < 2e-9, "{:?}", marks[1].drift);
    }
}
