//! Signals of the state: events at points, ends, steps that see what is between, linear models.

use super::{attempt, pushed, signal, with};
use crate::scenes::{dop853, parse};
use holonom::linearize::{Chart, Linear, Variation};
use holonom::method_spec::MethodSpec;

/// Work of a force of lines over the way: the kinetic energy at the end says that each kink was met.
#[test]
fn lines_over_the_way_do_their_work() {
    let knots = (0..=20).map(|k| (0.25 * f64::from(k), (f64::from(k) * 1.7).sin())).collect::<Vec<_>>();
    let work: f64 = knots.windows(2).map(|pair| 0.125 * (pair[0].1 + pair[1].1)).sum();
    let end = knots[20].1;
    let scene = pushed(&signal(knots, r#""interpolation": "linear""#), 4.0, "f(m.x)");
    for integrator in ["dopri5", "dop853", "radau_iia", "bdf"] {
        let outcome = attempt(&scene, &with(integrator, 1e-10), 1.5);
        let after = end * (outcome.q[0] - 5.0);
        let gained = outcome.v[0] * outcome.v[0] - 16.0;
        assert!(outcome.q[0] > 5.0, "{integrator}");
        // bdf ends on points by its dense output.
        let allowed = if integrator == "bdf" { 1e-6 } else { 1e-9 };
        assert!((gained - work - after).abs() < allowed, "{integrator}: {gained} and not {}", work + after);
    }
}

/// Flat for hundreds of metres but for a bump of some decimetres, which steps of seconds would go over.
#[test]
fn no_bump_of_a_spline_is_missed() {
    let points = (0..=4000).map(|k| (0.1 * f64::from(k), if k == 3210 { 60.0 } else { 0.0 }));
    let scene = pushed(&signal(points, r#""interpolation": "cubic""#), 40.0, "f(m.x)");
    for integrator in ["dopri5", "dop853", "radau_iia", "bdf"] {
        let outcome = attempt(&scene, &with(integrator, 1e-9), 9.9);
        let work = outcome.v[0] * outcome.v[0] - 1600.0;
        // The spline has the area of one interval.
        assert!((work - 6.0).abs() < 1e-4, "{integrator}: {work}");
    }
}

/// Where the motion turns back at once it does not fail; where it leaves the points it does.
#[test]
fn only_what_leaves_the_points_fails() {
    let keys = r#""interpolation": "cubic", "beyond": "error""#;
    let spring = || signal([(-1.0, 2.0), (0.0, 0.0), (1.0, -2.0)], keys);
    // x'' = -x from 0 with the speed 0.999999, then with 1.01.
    let turns = attempt(&pushed(&spring(), 0.999_999, "f(m.x)"), &dop853(1e-10), 20.0);
    assert_eq!(turns.failure, None);
    assert!((turns.q[0] - 0.999_999 * 20f64.sin()).abs() < 1e-8);
    let leaves = attempt(&pushed(&spring(), 1.01, "f(m.x)"), &dop853(1e-10), 20.0);
    let at = (1.0 / 1.01f64).asin();
    assert!(leaves.failure.is_some_and(|failure| failure.reason.contains("signal `f`")));
    assert!((leaves.t - at).abs() < 1e-9 && (leaves.q[0] - 1.0).abs() < 1e-9, "{} {:?}", leaves.t, leaves.q);
}

/// x'' = f(x)/m about x_0: eigenvalues +-sqrt(f'(x_0)/m), here of the parabola 3 x - x^2 at 0.5 with m = 2.
#[test]
fn linear_models_see_the_slope() {
    let scene = pushed(&signal([0.0, 0.7, 2.0].map(|x| (x, 3.0 * x - x * x)), r#""beyond": "hold""#), 0.0, "f(m.x)");
    let mut variation = Variation::new(scene.system(), 0.0, &[0.5], &[0.0]).unwrap();
    let request = Linear { method: MethodSpec::named("mcs"), chart: Some(Chart::Frozen) };
    let model = variation.linearize(&request).unwrap();
    let mut values: Vec<f64> = model.modes.iter().map(|mode| mode.value.re).collect();
    values.sort_by(f64::total_cmp);
    assert!((values[0] + 1.0).abs() < 1e-12 && (values[1] - 1.0).abs() < 1e-12, "{values:?}");
}

/// A bead on a measured track, y = f(x): from rest it has sqrt(2 g h) wherever it comes. phi'' has f''.
#[test]
fn a_bead_on_a_measured_track_keeps_its_energy() {
    let points: Vec<String> = (-10..=10).map(|k| f64::from(k) / 5.0).map(|x| format!("[{x}, {}]", x.cosh())).collect();
    let scene = parse(&format!(
        r#"{{ "name": "track", "dimension": 2, "gravity": [0, -9.81],
            "signals": [{{ "name": "track", "points": [{}] }}],
            "bodies": [{{ "name": "bead", "type": "point_mass", "mass": 1,
                          "initial": {{ "position": [-1.1, 1.7] }} }}],
            "joints": [{{ "name": "on", "type": "equation", "expression": "bead.y - track(bead.x)" }}],
            "assembly": {{ "hold": ["bead.x"] }},
            "outputs": [{{ "name": "energy", "measure": "energy" }}],
            "simulation": {{ "t_end": 3 }} }}"#,
        points.join(", ")
    ));
    let run = scene.tight(1e-11, 3.0, 0.05);
    let start = run.column("energy")[0];
    assert!((start - 9.81 * 1.1f64.cosh()).abs() < 1e-3);
    assert!(run.worst("energy", |_| start) < 1e-8);
    assert!(run.record.drift.position.max < 1e-13, "{:?}", run.record.drift);
}
