//! N four-bar linkages in a row, which pass flat: there N + 1 motions are possible.

use super::reference::{ONE_LOOP, TWO_LOOPS};
use super::{adaptive, errors, fixed, last};
use crate::common;
use crate::scenes::{Run, load, model, parse};
use holonom::scene::generate::n_four_bar;
use holonom::simulate::{Method, Span};

const SECONDS: Span = Span { start: 0.0, end: 10.0, output_step: 1.0 };

#[test]
fn one_and_two_loops_follow_the_reference() {
    for (n, reference) in [(1, &ONE_LOOP), (2, &TWO_LOOPS)] {
        let run = parse(&n_four_bar(n).to_string()).run(&fixed("index1", "rk4", "manifold", 0.001), SECONDS);
        for (k, name) in ["bar0.angle", "bar0.angle'", "B0_x", "B0_y"].into_iter().enumerate() {
            // The reference counts the angle from the first upright position, as the scene does.
            let error = errors(&run, name, |row| reference[row - 1][k]);
            // RK4's own error, of order four.
            assert!(error < 1e-9, "N = {n}: {name} is off by {error:e}");
        }
    }
}

/// Round-off over the rank indicator must not end Newton's method there: matrices from before the flat state pass it.
#[test]
fn generalized_alpha_passes_the_flat_position() {
    let scene = parse(&n_four_bar(10).to_string());
    for (formulation, step) in [("ggl", 1e-3), ("ggl", 5e-4), ("index3", 1e-3), ("index3", 5e-4)] {
        let span = Span { start: 0.0, end: 1.0, output_step: 0.5 };
        let run = scene.run(&fixed(formulation, "generalized_alpha", "none", step), span);
        let exact = scene.run(&fixed("index1", "rk4", "manifold", step), span);
        let error = last(&run, "bar0.angle") - last(&exact, "bar0.angle");
        // Order two: 18 h^2 with ggl and 24 h^2 with index3, with both steps.
        assert!(error.abs() < 25.0 * step * step, "{formulation} {step}: {error:e}");
        assert!(run.outcome.statistics.newton_iterations < 6 * run.outcome.statistics.steps);
    }
}

#[test]
fn forty_loops_pass_flat_ten_times() {
    let scene = load(&model("n_four_bar"), &[]);
    let run = scene.run(&scene.0.method, Span { output_step: 0.05, ..SECONDS });
    let x = last(&run, "B0_x");
    let y = last(&run, "B0_y");
    let error = (x - 0.180512226686728).hypot(y - 0.983572740582312);
    // RK4's error with the scene's step of 5 ms, of order four.
    assert!(error < 2e-7, "{error:e}");
    let energy = run.record.energy.unwrap();
    assert!(energy.relative_max_error.unwrap() < 2e-8, "{energy:?}");
    let heights = run.column("B0_y");
    assert_eq!(heights.windows(2).filter(|pair| pair[0] * pair[1] < 0.0).count(), 10);
    // All uprights alike: the last top stands 40 m from the first.
    for (first, last) in run.column("B0_x").into_iter().zip(run.column("last_x")) {
        assert!((last - first - 40.0).abs() < 1e-10, "{first} {last}");
    }
}

/// Steps that adapt go over the flat states too, at every accuracy.
#[test]
fn forty_loops_at_a_tolerance() {
    let scene = load(&model("n_four_bar"), &[]);
    for tolerance in [1e-6, 1e-9, 1e-11] {
        let run = scene.run(&adaptive("index1", "dop853", "manifold", tolerance), SECONDS);
        let error = (last(&run, "B0_x") - 0.180512226686728).hypot(last(&run, "B0_y") - 0.983572740582312);
        // The motion amplifies local errors some twenty times; round-off over the rank indicator at ten flat states is
        // 5e-11 to 1.3e-9, by chance, at tolerances a percent apart.
        assert!(error < (50.0 * tolerance).max(2e-9), "{tolerance:e}: {error:e}");
        assert!(run.outcome.statistics.steps < 300, "{tolerance:e}: {:?}", run.outcome.statistics);
    }
}

/// An absolute tolerance far below the relative one is below what round-off of positions of 40 m leaves of those that pass zero
/// where the loops are flat: that is put up with. At 1e-10 round-off decides which motions end there, with a message that
/// says so.
#[test]
fn forty_loops_at_a_small_absolute_tolerance() {
    let scene = load(&model("n_four_bar"), &[]);
    for (integrator, rtol) in [("dop853", 1e-6), ("dop853", 1e-8), ("dopri5", 1e-6), ("dopri5", 1e-8)] {
        for atol in [1e-10, 1e-12] {
            let run = scene.run(&Method { atol, ..adaptive("index1", integrator, "manifold", rtol) }, SECONDS);
            let error = (last(&run, "B0_x") - 0.180512226686728).hypot(last(&run, "B0_y") - 0.983572740582312);
            // As above; the reference has 12 digits.
            assert!(error < 50.0 * rtol, "{integrator}, {rtol:e}, {atol:e}: {error:e}");
        }
    }
}

/// Where stages fall at the flat states is chance: without the test of the energy one of these runs is 1000 tolerances
/// off. One stops, with a message.
#[test]
fn flat_states_are_passed_at_any_tolerance() {
    let scene = load(&model("n_four_bar"), &[]);
    let mut stopped = 0;
    for k in (-11..=11).step_by(2) {
        let tolerance = 1e-10 * (1.0 + 0.01 * f64::from(k));
        let method = adaptive("index1", "dop853", "manifold", tolerance);
        let span = Span { output_step: 10.0, ..SECONDS };
        let common::Run { outcome, record } = common::run(scene.system(), &method, span, scene.0.start());
        stopped += usize::from(outcome.failure.is_some());
        let run = Run { outcome, record };
        let error = (last(&run, "B0_x") - 0.180512226686728).hypot(last(&run, "B0_y") - 0.983572740582312);
        assert!(run.outcome.failure.is_some() || error < 500.0 * tolerance, "{tolerance:e}: {error:e}");
    }
    assert!(stopped <= 1, "{stopped}");
}

/// One passage in two hundred runs left the motion by 200 tolerances, and its energy balance showed it.
#[test]
fn no_passage_is_wrong_in_silence() {
    let scene = parse(&n_four_bar(2).to_string());
    let [x, y] = TOPS[0].1;
    let mut told = 0;
    let others = (0..40).map(|k| 1e-10 * 1.1f64.powi(k - 10));
    for tolerance in std::iter::once(1.0615201506010002e-10).chain(others) {
        let run =
            scene.run(&adaptive("index1", "dop853", "manifold", tolerance), Span { output_step: 0.05, ..SECONDS });
        let error = (last(&run, "B0_x") - x).hypot(last(&run, "B0_y") - y) / tolerance;
        let is_told = run.record.worst_step.is_alone();
        told += usize::from(is_told);
        // Steps at 1e-11 are at their tightest, and the reference has 12 digits.
        assert!(is_told || error < 100.0, "{tolerance:e}: {error} tolerances in silence");
    }
    assert!(told < 3, "{told} warnings");
}

#[test]
fn forty_loops_with_smaller_steps_come_closer() {
    let scene = load(&model("n_four_bar"), &[]);
    let found = [0.01, 0.005, 0.0025].map(|step| {
        let run = scene.run(&fixed("index1", "rk4", "manifold", step), SECONDS);
        (last(&run, "B0_x") - 0.180512226686728).hypot(last(&run, "B0_y") - 0.983572740582312)
    });
    for pair in found.windows(2) {
        assert!((pair[0] / pair[1]).log2() > 3.5, "order four: {found:?}");
    }
}

/// B0 at 10 s with five and ten loops: RK4 on the single equation theta'' = -k cos(theta), extrapolated to 1e-12.
const TOPS: [(usize, [f64; 2]); 3] = [
    (2, [TWO_LOOPS[9][2], TWO_LOOPS[9][3]]),
    (5, [0.2357891358436727, 0.9718042413048494]),
    (10, [0.2043535609910408, 0.978897145828039]),
];

/// The error of B0 at the end, of a run that should have passed flat ten times.
fn error_at_the_end(top: usize, integrator: &str, projection: &str, step: f64) -> f64 {
    let (n, [x, y]) = TOPS[top];
    let method = fixed("index1", integrator, projection, step);
    let run = parse(&n_four_bar(n).to_string()).run(&method, Span { output_step: 10.0, ..SECONDS });
    let found = &run.record.singularity;
    assert!(found.count == 10 && found.left().is_none(), "N = {n}, {integrator} {projection} {step}: {found:?}");
    (last(&run, "B0_x") - x).hypot(last(&run, "B0_y") - y)
}

/// Stages of a fixed step beside a flat state do not decide the branch, and smaller steps do not come nearer to it than
/// round-off allows: what is left at small steps is eps over the square of the rank indicator, some 1e-10.
#[test]
fn fixed_steps_go_over_flat_states_whatever_their_size() {
    for (top, integrator, projection, step) in [
        (0, "dop853", "manifold", 2e-3),
        (0, "dop853", "exact", 2e-3),
        (1, "dop853", "manifold", 5e-4),
        (2, "dop853", "manifold", 1e-3),
        (2, "dop853", "exact", 7e-4),
        (0, "dop853", "manifold", 2e-4),
        (0, "dopri5", "manifold", 5e-4),
        (0, "rk4", "manifold", 7e-4),
        (0, "rk4", "manifold", 2e-4),
        (2, "rk4", "manifold", 5e-4),
    ] {
        let error = error_at_the_end(top, integrator, projection, step);
        assert!(error < 1e-9, "{:?} {integrator} {projection}, {step} s: {error:e}", TOPS[top]);
    }
    let [coarse, fine] = [1e-3, 5e-4].map(|step| error_at_the_end(2, "rk4", "manifold", step));
    assert!(coarse < 5e-11 && fine < coarse / 8.0, "order four: {coarse:e} {fine:e}");
}
