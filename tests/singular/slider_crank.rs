//! Slider-crank with equal links, folded seven or eleven times in 10 s.

use super::reference::{AT_REST, RUNNING};
use super::{adaptive, errors, fixed, last};
use crate::scenes::shipped;
use holonom::analysis::{Record, Recorder};
use holonom::simulate::{Method, Span, simulate};

const SECONDS: Span = Span { start: 0.0, end: 10.0, output_step: 1.0 };

const CASES: [(&str, &[[f64; 4]; 10]); 2] =
    [("slider_crank_singular", &AT_REST), ("slider_crank_singular_2", &RUNNING)];

/// Errors of the crank angle at 10 s with RK4 and one projection a step.
fn angle_errors(case: usize, steps: [f64; 4]) -> [f64; 4] {
    let (name, reference) = CASES[case];
    let scene = shipped(name, &[]);
    steps.map(|step| {
        let run = scene.run(&fixed("index1", "rk4", "manifold", step), SECONDS);
        (last(&run, "crank_angle") - reference[9][0]).abs()
    })
}

const STEPS: [f64; 4] = [0.01, 0.005, 0.002, 0.001];

/// The motion goes straight through, however a step ends beside the singular position, and keeps its order.
#[test]
fn rk4_with_projection_keeps_its_order_through_the_folds() {
    for (case, finest) in [(0, 2.6e-12), (1, 1.3e-9)] {
        let found = angle_errors(case, STEPS);
        assert!(found[3] < finest, "{found:?}");
        for (errors, steps) in found.windows(2).zip(STEPS.windows(2)) {
            let order = (errors[0] / errors[1]).ln() / (steps[0] / steps[1]).ln();
            assert!(order > 3.5, "order {order} from {found:?}");
        }
    }
}

fn rows_agree(method: &Method, bounds: [f64; 2]) {
    for ((name, reference), bound) in CASES.into_iter().zip(bounds) {
        let run = shipped(name, &[]).run(method, SECONDS);
        for (k, column) in ["crank_angle", "crank_rate", "slider_x", "slider_speed"].into_iter().enumerate() {
            let error = errors(&run, column, |row| reference[row - 1][k]);
            assert!(error < bound, "{name}: {column} is off by {error:e} with {}", method.integrator);
        }
        assert_eq!(run.outcome.statistics.rank_deficient, 0, "no state is singular to round-off");
    }
}

#[test]
fn rk4_with_projection_follows_the_reference() {
    rows_agree(&fixed("index1", "rk4", "manifold", 0.001), [1e-11, 1e-8]);
}

/// Half-explicit, whose stages hold the velocity constraints themselves.
#[test]
fn hem5_follows_the_reference() {
    rows_agree(&fixed("index2", "hem5", "manifold", 0.001), [1e-12, 1e-8]);
}

/// Minimal coordinates in the tangent space of a step's start.
#[test]
fn null_space_follows_the_reference() {
    rows_agree(&fixed("null_space", "rk4", "none", 0.001), [1e-11, 1e-8]);
}

/// Where the two motions cross, the velocities decide: released folded, with the links turning against each other, it
/// slides on.
#[test]
fn from_the_fold_it_follows_its_velocities() {
    let set = [("phi0", std::f64::consts::FRAC_PI_2), ("w0", 2.0)];
    let run = shipped("slider_crank_singular", &set).run(&fixed("index1", "rk4", "manifold", 0.001), SECONDS);
    let rates = run.column("crank_rate");
    for ((angle, rate), x) in run.column("crank_angle").into_iter().zip(rates).zip(run.column("slider_x")) {
        assert!((x - 2.0 * angle.cos()).abs() < 1e-12, "at {angle}");
        // Energy of the crank, whose angle the rod mirrors: inertia(angle) rate^2/2 + g sin(angle).
        let (s, c) = angle.sin_cos();
        let inertia = |s: f64, c: f64| 1.0 / 3.0 + 1.0 / 12.0 + 2.25 * s * s + 0.25 * c * c;
        let energy = 0.5 * inertia(s, c) * rate * rate + 9.81 * s - (0.5 * inertia(1.0, 0.0) * 4.0 + 9.81);
        // RK4's, and 1e-4 of an acceleration over the first step.
        assert!(energy.abs() < 1e-8, "at {angle}: {energy:e}");
    }
}

/// Rows within steps, beside folds and elsewhere, hold the mirror image as steps do, and their drift is counted.
#[test]
fn rows_are_as_good_as_steps() {
    let scene = shipped(CASES[1].0, &[]);
    for (output_step, tolerance) in [(0.05, 1e-10), (0.02, 1e-10), (0.01, 1e-8)] {
        let method = adaptive("index1", "dop853", "manifold", tolerance);
        let run = scene.run(&method, Span { output_step, ..SECONDS });
        let column = |name| run.record.trajectory.column(name).unwrap();
        let rates = column("crank.angle'").into_iter().zip(column("rod.angle'"));
        for (angle, (crank, rod)) in column("crank.angle").into_iter().zip(rates) {
            // Round-off of the velocities over the square of the rank indicator.
            let round_off = 1e-14 / angle.cos().powi(2);
            assert!((crank + rod).abs() < 10.0 * tolerance + round_off, "at {angle}: {:e}", crank + rod);
        }
        let rows = run.record.drift_rows.iter().fold(0.0, |largest: f64, [_, velocity, _]| largest.max(*velocity));
        let counted = run.record.drift.velocity.max;
        assert!(rows <= counted && counted < 10.0 * tolerance, "{rows:e} {counted:e}");
    }
}

/// What was computed, whether or not the run came to its end.
fn record(name: &str, method: &Method) -> Record {
    let scene = shipped(name, &[]);
    let mut recorder = Recorder::new(scene.system());
    let span = Span { output_step: 0.01, ..SECONDS };
    simulate(scene.system(), method, span, scene.0.start(), &mut recorder).unwrap();
    recorder.finish()
}

/// Angle of the rod against the crank's mirror image: zero on the branch that slides, nonzero on that which turns.
fn off_branch(record: &Record) -> f64 {
    let column = |name| record.trajectory.column(name).unwrap();
    let sums =
        column("crank.angle").into_iter().zip(column("rod.angle")).map(|(crank, rod)| (0.5 * (crank + rod)).sin());
    sums.fold(0.0, |largest, sum| largest.max(sum.abs()))
}

/// Gains g1 = 2 alpha = 12 and g0 = beta^2 = 70.
const BAUMGARTE: &str = "baumgarte:alpha=6,beta=8.366600265340756";

/// A drift delta turns the crossing of the two branches into a pair of hyperbolas sqrt(delta) apart: what drifts by more
/// than a step passes over is led round onto the other branch, or pushed off by multipliers that grow as 1/distance.
#[test]
fn without_projection_the_links_turn_off_the_branch() {
    for (name, _) in CASES {
        assert!(off_branch(&record(name, &fixed("index1", "rk4", "manifold", 0.001))) < 1e-12);
        let left = record(name, &fixed("index1", "rk4", "none", 0.001));
        assert!(off_branch(&left) > 0.01, "{name}: {}", off_branch(&left));
        assert!(left.drift.position.relative_max > 1e-3, "{name}: {:?}", left.drift.position);
    }
}

/// Steps placed over the folds meet them with the little drift that Baumgarte's method leaves, slow or fast.
#[test]
fn baumgarte_passes_when_steps_are_placed() {
    for (case, step) in [(0, 1e-3), (1, 1e-3), (1, 5e-4), (1, 2.5e-4)] {
        let found = record(CASES[case].0, &fixed(BAUMGARTE, "rk4", "none", step));
        let drift = &found.drift.position;
        assert!(off_branch(&found) < 1e-9 && drift.relative_max < 1e-10, "{} {step}: {drift:?}", CASES[case].0);
    }
}

/// A row beside a fold, between steps that are not near it: one sweep of its projection left the force in the pin two
/// thousand tolerances off.
#[test]
fn rows_beside_the_folds_are_as_right_as_others() {
    let scene = shipped("slider_crank_singular", &[]);
    let span = Span { output_step: 0.02, ..SECONDS };
    let method = |projection, tolerance| Method {
        atol: 1e-2 * tolerance,
        ..adaptive("index1", "dop853", projection, tolerance)
    };
    let exact = scene.run(&method("exact", 1e-12), span).column("crank_pin_force");
    let run = scene.run(&method("manifold", 1e-3), span);
    let size = exact.iter().fold(0.0f64, |size, force| size.max(force.abs()));
    let error = errors(&run, "crank_pin_force", |row| exact[row]) / size;
    assert!(error < 1e-2, "{error:e}");
}
