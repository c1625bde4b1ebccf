//! The index-3 augmented Lagrangian method: what it holds, and where others fail.

use crate::common::driven_pendulum::{DrivenPendulum, start};
use crate::common::{adaptive, distance, fixed, run, until};
use crate::scenes::shipped;
use holonom::math::Scalar;
use holonom::simulate::Span;
use holonom::system::Equations;

#[test]
fn constraints_hold_and_the_penalty_does_not_matter() {
    let (q, v) = start();
    let last = |penalty: &str| {
        let method = fixed("index3", &format!("ali3p:penalty={penalty}"), "none", 0.01);
        let run = run(&DrivenPendulum, &method, until(2.0), (&q, &v)).completed();
        let (position, velocity) = run.drift();
        // Lengths of 1 m and velocities of some m/s.
        assert!(position < 1e-15 && velocity < 1e-15, "{penalty}: {position:e} {velocity:e}");
        let (q, v, lambda) = run.last();
        [q, v, lambda].concat()
    };
    let usual = last("1e7");
    for penalty in ["1e3", "1e5"] {
        let found = distance(&last(penalty), &usual);
        assert!(found < 1e-10, "{penalty}: {found:e}");
    }
}

/// Against dop853 with errors of order 2, at the same steps as generalized_alpha without damping beyond its default.
#[test]
fn as_accurate_as_generalized_alpha() {
    for (name, end, step) in [("andrews", 0.02, 2e-5), ("slider_crank", 1.0, 1e-3), ("four_bar_spring", 1.0, 1e-3)] {
        let scene = shipped(name, &[]);
        let span = until(end);
        let last = |method| scene.run(&method, span).record.trajectory.rows.last().unwrap().clone();
        let exact = last(adaptive("index1", "dop853", "exact", 1e-11));
        let n = scene.system().dimensions();
        let error = |integrator: &str, step: f64| {
            let run = scene.run(&fixed("index3", integrator, "none", step), span);
            distance(&run.record.trajectory.rows.last().unwrap()[1..1 + n.q], &exact[1..1 + n.q])
        };
        let own = error("ali3p", step);
        let half = error("ali3p", 0.5 * step);
        let other = error("generalized_alpha", step);
        assert!((own / half).log2() > 1.7 && own < 5.0 * other, "{name}: {own:e} {half:e} {other:e}");
    }
}

/// The swing of the parallelogram: its closed equation.
struct Swing;

impl Equations for Swing {
    fn size(&self) -> (usize, usize) {
        (1, 0)
    }
    fn mass<S: Scalar>(&self, _t: S, _q: &[S], mass: &mut [S]) {
        mass[0] = S::one();
    }
    fn force<S: Scalar>(&self, _t: S, q: &[S], _v: &[S], f: &mut [S]) {
        f[0] = q[0].sin() * (-2.6 / 2.4 * 9.81 / 0.5);
    }
    fn phi<S: Scalar>(&self, _t: S, _q: &[S], _phi: &mut [S]) {}
}

/// The third link is redundant, and with enough speed all links pass through one line, where the rank falls again.
#[test]
fn redundant_rows_and_singular_positions_are_passed() {
    let scene = shipped("parallelogram_redundant", &[("angle0", 1.0), ("rate0", 12.0)]);
    let span = Span { start: 0.0, end: 2.0, output_step: 0.01 };
    let exact = run(&Swing, &adaptive("index1", "dop853", "none", 1e-12), span, (&[1.0], &[12.0])).completed();
    let angle: Vec<f64> = exact.record.trajectory.rows.iter().map(|row| row[1]).collect();
    assert!(angle.iter().any(|angle| *angle > std::f64::consts::PI), "it turns over");
    let error = |step: f64| {
        let run = scene.run(&fixed("index3", "ali3p", "none", step), span);
        assert!(run.record.drift.position.max < 1e-13 && run.record.drift.velocity.max < 1e-10);
        distance(&run.column("angle"), &angle)
    };
    let coarse = error(1e-3);
    let fine = error(5e-4);
    assert!(fine < 1e-4 && (coarse / fine).log2() > 1.7, "{coarse:e} {fine:e}");
}

/// The quaternion advances along the group.
#[test]
fn rotations_in_space_converge_with_order_two() {
    let scene = shipped("spinning_top", &[]);
    let span = until(0.2);
    let last = |method| scene.run(&method, span).record.trajectory.rows.last().unwrap().clone();
    let n = scene.system().dimensions();
    let exact = last(adaptive("index1", "dop853", "exact", 1e-12));
    let error = |step: f64| {
        let row = last(fixed("index3", "ali3p", "none", step));
        distance(&row[1..1 + n.q + n.v], &exact[1..1 + n.q + n.v])
    };
    let coarse = error(1e-3);
    let fine = error(5e-4);
    assert!(((coarse / fine).log2() - 2.0).abs() < 0.1, "{coarse:e} {fine:e}");
}
