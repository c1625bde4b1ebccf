//! Runs that change their method on the way.

use crate::scenes::{Ready, parse, shipped};
use holonom::analysis::{Record, Recorder};
use holonom::formulation::{Statistics, Work};
use holonom::method_spec::MethodSpec;
use holonom::prepared::{Model, Overrides};
use holonom::simulate::{Leg, Method, Outcome, Span, simulate, simulate_automatic};
use std::path::Path;

fn automatic(scene: &Ready, rtol: f64, span: Span) -> (Outcome, Vec<Leg>, Record) {
    let mut recorder = Recorder::new(scene.system());
    let start = scene.0.start();
    let (outcome, legs, _) =
        simulate_automatic(scene.system(), (rtol, 1e-2 * rtol), span, start, &mut recorder).unwrap();
    (outcome, legs, recorder.finish())
}

fn alone(scene: &Ready, names: [&str; 3], rtol: f64, span: Span) -> Outcome {
    let [formulation, integrator, projection] = names.map(MethodSpec::named);
    let method = Method { formulation, integrator, projection, rtol, atol: 1e-2 * rtol, step: None };
    simulate(scene.system(), &method, span, scene.0.start(), &mut Recorder::new(scene.system())).unwrap()
}

/// Largest difference of a coordinate, relative to the largest coordinate.
fn gap(a: &Outcome, b: &Outcome) -> f64 {
    let size = a.q.iter().fold(0.0f64, |size, q| size.max(q.abs()));
    a.q.iter().zip(&b.q).fold(0.0f64, |gap, (a, b)| gap.max((a - b).abs())) / size
}

fn integrators(legs: &[Leg]) -> Vec<&str> {
    legs.iter().map(|leg| leg.method.integrator.name.as_str()).collect()
}

const IMPLICIT: [&str; 3] = ["ggl", "radau_iia", "none"];

/// Fine finite elements that no step of dop853 goes over are left to what comes farther.
#[test]
fn a_bad_beginning_is_left() {
    let scene = shipped("spin_up_beam", &[]);
    let span = Span { output_step: 0.01, ..scene.span() };
    let (outcome, legs, record) = automatic(&scene, 1e-7, span);
    assert_eq!(integrators(&legs), ["adams", "radau_iia"]);
    assert!(outcome.failure.is_none() && legs[1].from < 0.01 * span.end, "{legs:?}");
    // Rows come each once, through the change.
    let times: Vec<f64> = record.trajectory.rows.iter().map(|row| row[0]).collect();
    assert_eq!(times.len(), (span.end / 0.01).round() as usize + 1);
    assert!(times.iter().enumerate().all(|(i, t)| (t - 0.01 * i as f64).abs() < 1e-9));
    // The work of forces is carried on.
    let energy = record.energy.as_ref().unwrap();
    assert!(energy.relative_max_error.unwrap() < 1e-4, "{energy:?}");
    // The same again, bit by bit, and near to the one method alone.
    assert_eq!(automatic(&scene, 1e-7, span).0, outcome);
    let alone = alone(&scene, IMPLICIT, 1e-7, span);
    assert!(gap(&alone, &outcome) < 1e-4, "{:e}", gap(&alone, &outcome));
    // All work is counted: that of the motion as that of one method is, that of the trials beside it.
    let own = legs.iter().fold(Statistics::default(), |sum, leg| sum + leg.statistics);
    assert_eq!(own, outcome.statistics);
    let trials: Vec<u64> = legs.iter().map(|leg| leg.tried().rhs_evaluations).collect();
    assert!(legs.iter().all(|leg| leg.tried().rows == Work::default()), "a trial makes no rows: {legs:?}");
    assert!(trials[0] > 0 && trials.iter().sum::<u64>() < own.rhs_evaluations, "{trials:?} beside {own:?}");
    assert!(own.rhs_evaluations < 2 * alone.statistics.rhs_evaluations, "{own:?} {:?}", alone.statistics);
}

/// A damper that no explicit step goes over, for a while.
#[test]
fn the_explicit_method_comes_back() {
    let scene = parse(
        r#"{ "name": "brake", "dimension": 2, "bodies": [{ "name": "m", "type": "point_mass", "mass": 1,
            "initial": { "position": [1, 0] } }],
            "joints": [{ "name": "rail", "type": "equation", "expression": "m.y" }],
            "forces": [{ "name": "f", "type": "applied_force", "at": "m",
                         "force": ["-10*sin(m.x) - if(t < 20, 1e4, 0)*m.x'", 0] }] }"#,
    );
    let span = Span { start: 0.0, end: 120.0, output_step: 1.0 };
    let (outcome, legs, _) = automatic(&scene, 1e-7, span);
    assert_eq!(integrators(&legs), ["adams", "radau_iia", "adams"], "{legs:?}");
    assert!(outcome.failure.is_none() && legs[2].from > 20.0 && legs[2].from < 60.0, "{legs:?}");
    let alone = alone(&scene, IMPLICIT, 1e-10, span);
    assert!(gap(&alone, &outcome) < 1e-5, "{:e}", gap(&alone, &outcome));
}

/// A motion that its driver determines is where the joints are closed: the sweep after its last step leaves round-off,
/// however loose the tolerance.
#[test]
fn a_driven_motion_ends_where_its_joints_close() {
    for name in ["slider_crank_offset", "universal_shaft", "five_link_kinematics"] {
        let scene = shipped(name, &[]);
        let tight = automatic(&scene, 1e-12, scene.span()).0;
        for tolerance in [1e-3, 1e-6, 1e-9] {
            let gap = gap(&automatic(&scene, tolerance, scene.span()).0, &tight);
            // A few operations on lengths of a metre.
            assert!(gap < 1e-14, "{name} {tolerance:e}: {gap:e}");
        }
    }
}

/// Steps go on for nearly half a turn, and rows whose own step does not converge lie on the polynomial of it: at a
/// constant speed there is no torque at any.
#[test]
fn rows_of_a_shaft_that_turns_are_as_right_as_its_steps() {
    let scene = shipped("rotating_shaft", &[]);
    for rtol in [1e-3, 1e-7, 1e-8] {
        let (outcome, legs, record) = automatic(&scene, rtol, scene.span());
        assert!(outcome.failure.is_none() && integrators(&legs)[1..] == ["radau_iia"], "{legs:?}");
        let torque = record.trajectory.column("drive_torque").unwrap();
        let largest = torque.iter().fold(0.0f64, |largest, torque| largest.max(torque.abs()));
        println!("{rtol:e}: {largest:e}");
        // Of 25 J; what steps of dop853 leave in stiff modes is below 1e-7 N m.
        assert!(largest < 1e-6, "{rtol:e}: {largest:e}");
    }
}

/// What steps of dop853 leave in the stiff modes of the shaft, radau_iia would have to follow: from their state on it took
/// four times the steps that it takes from the start.
#[test]
fn what_takes_over_early_begins_at_the_start() {
    let scene = shipped("rotating_shaft", &[]);
    let (outcome, legs, record) = automatic(&scene, 1e-6, scene.span());
    assert_eq!(integrators(&legs), ["adams", "radau_iia"]);
    assert!(legs[1].from > 0.0 && legs[1].because.ends_with("it began again at the start"), "{legs:?}");
    let alone = alone(&scene, IMPLICIT, 1e-6, scene.span());
    let [steps, own] = [legs[1].statistics.steps, alone.statistics.steps];
    // One more ends where the other method was.
    assert!(steps <= own + 3, "{steps} beside {own}");
    // Rows come each once, and states each later than the one before.
    let rows = &record.trajectory.rows;
    assert_eq!(rows.len(), (scene.span().end / scene.span().output_step).round() as usize + 1);
    assert!(rows.windows(2).all(|pair| pair[0][0] < pair[1][0]) && outcome.failure.is_none());
}

/// What begins with a swing that the other method follows at a higher cost, and turns stiff, is not begun again.
#[test]
fn what_begins_badly_for_it_the_other_method_takes_over_on_the_way() {
    let scene = parse(
        r#"{ "name": "caught", "dimension": 2, "bodies": [{ "name": "m", "type": "point_mass", "mass": 1,
            "initial": { "position": [1, 0] } }],
            "joints": [{ "name": "rail", "type": "equation", "expression": "m.y" }],
            "forces": [{ "name": "f", "type": "applied_force", "at": "m",
                         "force": ["if(t < 20, -1e4*m.x, -10*sin(m.x) - 1e4*m.x')", 0] }] }"#,
    );
    let span = Span { start: 0.0, end: 120.0, output_step: 1.0 };
    let (outcome, legs, record) = automatic(&scene, 1e-7, span);
    assert_eq!(integrators(&legs), ["adams", "radau_iia"], "{legs:?}");
    let last = &legs[1];
    assert!(last.from > 20.0 && last.from < 27.0 && !last.because.contains("began again"), "{legs:?}");
    // The work that the attempt took is counted, and is no more than that of the swing.
    assert!(legs[0].tried().rhs_evaluations < 2 * legs[0].statistics.rhs_evaluations, "{legs:?}");
    assert!(outcome.failure.is_none() && record.trajectory.rows.len() == 121);
}

/// The work of output rows does not count.
#[test]
fn rows_do_not_change_the_choice() {
    for (name, end, output_steps) in [("pid_arm", 12.0, [0.003, 1.0]), ("fekete", 200.0, [1.0, 50.0])] {
        let scene = shipped(name, &[]);
        let [dense, sparse] = output_steps.map(|output_step| {
            let (_, legs, _) = automatic(&scene, 1e-6, Span { end, output_step, ..scene.span() });
            legs.into_iter().map(|leg| leg.method).collect::<Vec<_>>()
        });
        assert_eq!(dense, sparse, "{name}");
    }
}

/// What is left of a short run is less than a trial costs.
#[test]
fn short_runs_try_nothing() {
    let (outcome, legs, _) = automatic(&shipped("quarter_car", &[]), 1e-3, shipped("quarter_car", &[]).span());
    assert!(outcome.failure.is_none() && outcome.statistics.rhs_evaluations < 1000, "{:?}", outcome.statistics);
    assert!(legs.len() == 1 && legs[0].trials.is_empty(), "{legs:?}");
}

/// Left behind by a looser rtol, atol would govern; left behind by a tighter one it is what the scene asks for.
#[test]
fn a_looser_rtol_takes_atol_along() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("models/andrews.json");
    let atol = |rtol, atol| {
        Model::load_with(&path, &Overrides { rtol: Some(rtol), atol, ..Overrides::default() }).unwrap().method.atol
    };
    assert_eq!([atol(1e-3, None), atol(1e-12, None), atol(1e-3, Some(1e-7))], [1e-5, 1e-11, 1e-7]);
}

/// A force that has no value beyond a place stops one method, and then the other: the run ends with the reason, and
/// what it had.
#[test]
fn where_both_methods_stop_the_run_does() {
    let scene = parse(
        r#"{ "name": "wall", "dimension": 2, "bodies": [{ "name": "m", "type": "point_mass", "mass": 1,
            "initial": { "position": [1, 0], "velocity": [-1, 0] } }],
            "joints": [{ "name": "rail", "type": "equation", "expression": "m.y" }],
            "forces": [{ "name": "f", "type": "applied_force", "at": "m", "force": ["1/m.x^2*sqrt(m.x - 0.5)", 0] }] }"#,
    );
    let (outcome, legs, record) = automatic(&scene, 1e-7, Span { start: 0.0, end: 5.0, output_step: 0.1 });
    let failure = outcome.failure.expect("nothing is defined beyond x = 0.5");
    assert!(legs.len() >= 2 && failure.t > 0.3 && failure.t < 5.0, "{legs:?} {failure:?}");
    assert!(record.trajectory.rows.len() > 3);
}

/// A linkage without events, one whose road has hundreds of points, and a loose tolerance.
#[test]
fn tight_tolerances_of_smooth_motions_begin_with_adams() {
    for (name, rtol, expected) in
        [("andrews", 1e-6, "adams"), ("andrews", 1e-3, "dop853"), ("half_car", 1e-6, "dop853")]
    {
        let scene = shipped(name, &[]);
        let (outcome, legs, _) = automatic(&scene, rtol, Span { output_step: 1.0, ..scene.span() });
        assert!(outcome.failure.is_none() && legs[0].method.integrator.name == expected, "{name}: {legs:?}");
    }
}
