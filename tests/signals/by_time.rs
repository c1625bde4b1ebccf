//! Signals of t.

use super::{attempt, pushed, signal, with};
use crate::scenes::dop853;

const KNOTS: [(f64, f64); 6] = [(0.1, 1.0), (0.35, -2.0), (0.8, 3.0), (1.3, 0.5), (1.9, -1.0), (2.3, 1.0)];

/// Between points the force is linear, or constant: with steps that end on them only round-off is left. The impulse is the
/// area below the lines or steps, and the same in three periods.
#[test]
fn steps_end_on_the_points_of_lines_and_steps() {
    let lines = |pair: &[(f64, f64)]| 0.5 * (pair[0].1 + pair[1].1) * (pair[1].0 - pair[0].0);
    let steps = |pair: &[(f64, f64)]| pair[0].1 * (pair[1].0 - pair[0].0);
    let within = |area: fn(&[(f64, f64)]) -> f64| KNOTS.windows(2).map(area).sum::<f64>();
    let cases = [
        (r#""interpolation": "linear""#, 3.0, 0.1 + within(lines) + 0.7),
        (r#""interpolation": "previous""#, 3.0, 0.1 + within(steps) + 0.7),
        (r#""interpolation": "linear", "beyond": "repeat""#, 6.6, 3.0 * within(lines)),
        (r#""interpolation": "previous", "beyond": "repeat""#, 6.6, 3.0 * within(steps)),
    ];
    for (keys, end, impulse) in cases {
        let scene = pushed(&signal(KNOTS, keys), 0.0, "f(t)");
        for integrator in ["dopri5", "dop853", "radau_iia"] {
            let outcome = attempt(&scene, &with(integrator, 1e-4), end);
            assert!((2.0 * outcome.v[0] - impulse).abs() < 1e-12, "{keys} {integrator}: {outcome:?} {impulse}");
            let knots = end / 2.2 * 6.0;
            assert!((outcome.statistics.steps as f64) < 4.0 * knots + 20.0, "{integrator}: {:?}", outcome.statistics);
        }
    }
}

/// The same function as the expression `table`, bit by bit.
#[test]
fn a_table_is_a_linear_signal() {
    let points: Vec<String> = KNOTS.iter().map(|(x, y)| format!("{x}, {y}")).collect();
    let one = signal(KNOTS, r#""interpolation": "linear""#);
    let runs = ["f(t)".to_string(), format!("table(t, {})", points.join(", "))]
        .map(|force| attempt(&pushed(&one, 0.0, &force), &dop853(1e-8), 3.0));
    assert_eq!(runs[0], runs[1]);
}

/// A spline over points of a sine is that sine but for its own error, by every method; runs are repeated bit by bit.
#[test]
fn a_spline_over_a_sine_is_followed() {
    let sine = (0..=300).map(|k| f64::from(k) / 100.0).map(|t| (t, (5.0 * t).sin()));
    let scene = pushed(&signal(sine, r#""beyond": "error""#), 0.0, "f(t)");
    let speed = (1.0 - (15.0f64).cos()) / 10.0;
    for integrator in ["dopri5", "dop853", "radau_iia", "bdf"] {
        let [first, again] = [0, 1].map(|_| attempt(&scene, &with(integrator, 1e-8), 3.0));
        assert_eq!(first.failure, None, "{integrator}");
        assert!((first.v[0] - speed).abs() < 1e-7, "{integrator}: {} and not {speed}", first.v[0]);
        assert_eq!(first, again, "{integrator}");
    }
}

/// Among a thousand points that are zero a few are not: a pulse of 3 ms in 10 s.
#[test]
fn no_pulse_of_a_spline_is_missed() {
    let points = (0..=10_000).map(|k| (f64::from(k) / 1000.0, if k == 7123 { 1000.0 } else { 0.0 }));
    let scene = pushed(&signal(points, r#""interpolation": "cubic""#), 0.0, "f(t)");
    for integrator in ["dopri5", "dop853", "radau_iia", "bdf"] {
        let outcome = attempt(&scene, &with(integrator, 1e-8), 10.0);
        // The spline's cardinal function has the area of one interval; its ends are far.
        assert!((2.0 * outcome.v[0] - 1.0).abs() < 1e-5, "{integrator}: {}", outcome.v[0]);
    }
}

/// Steps of about the distance of two points end on them, and few are refused.
#[test]
fn steps_end_at_points_of_a_coarse_spline() {
    let rough = (0..=100).map(f64::from).map(|k| (0.03 * k, (k * k).sin()));
    let scene = pushed(&signal(rough, r#""interpolation": "cubic""#), 0.0, "f(t) - 100*m.x");
    let statistics = attempt(&scene, &dop853(1e-10), 3.0).statistics;
    assert!(statistics.steps < 260 && statistics.rejected < 130, "{statistics:?}");
}

/// The run ends where the signal does, and the state there is the last one.
#[test]
fn a_run_beyond_the_points_fails() {
    for interpolation in ["cubic", "linear", "previous"] {
        let keys = format!(r#""interpolation": "{interpolation}", "beyond": "error""#);
        let from_zero = KNOTS.map(|(x, y)| (x - 0.1, y));
        let scene = pushed(&signal(from_zero, &keys), 0.0, "1 + f(t)");
        for integrator in ["dopri5", "dop853", "radau_iia", "bdf"] {
            let outcome = attempt(&scene, &with(integrator, 1e-6), 3.0);
            let failure = outcome.failure.unwrap_or_else(|| panic!("{integrator}"));
            let expected =
                "the force `push` leaves the range of the signal `f`, which goes from 0 to 2.1999999999999997";
            assert_eq!((failure.reason.as_str(), outcome.t), (expected, 2.3 - 0.1), "{integrator}");
            assert_eq!(attempt(&scene, &with(integrator, 1e-6), 2.3 - 0.1).failure, None, "{integrator}");
        }
    }
}
