//! Slider-crank with equal links, folded seven or eleven times in 10 s.

use super::reference::{AT_REST, RUNNING};
use super::scenes::shipped;
use super::{errors, fixed, last};
use holonom::measure::{Record, Recorder};
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
        assert!(off_branch(&left) > 0.1, "{name}: {}", off_branch(&left));
        assert!(left.drift.position.relative_max > 1e-3, "{name}: {:?}", left.drift.position);
    }
}

/// Slow passings leave Baumgarte's method time to pull back; fast ones do not always.
#[test]
fn baumgarte_passes_when_slow_and_comes_apart_when_fast() {
    let method = fixed(BAUMGARTE, "rk4", "none", 0.001);
    let slow = record(CASES[0].0, &method);
    assert!(off_branch(&slow) < 1e-10 && slow.drift.position.relative_max < 1e-11, "{:?}", slow.drift.position);
    // It depends on where steps end.
    let comes_apart = [5e-4, 2.5e-4].map(|step| {
        let fast = record(CASES[1].0, &fixed(BAUMGARTE, "rk4", "none", step));
        fast.drift.position.relative_max > 1.0 || off_branch(&fast) > 0.1
    });
    assert!(comes_apart.contains(&true));
}
