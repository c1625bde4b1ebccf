//! Runs that change their method on the way.

mod scenes;

use holonom::measure::Recorder;
use holonom::simulate::{Leg, Outcome, Span, simulate_automatic};
use scenes::{Ready, parse, shipped};

/// Begins with a method named, whether it is a good one or not.
fn begun_with(scene: &Ready, names: [&str; 3], span: Span) -> (Outcome, Vec<Leg>, holonom::measure::Record) {
    let [formulation, integrator, projection] = names.map(holonom::formulation::Choice::named);
    let method = holonom::simulate::Method { formulation, integrator, projection, rtol: 1e-7, atol: 1e-9, step: None };
    let first = Leg { from: span.start, method, because: String::new() };
    let mut recorder = Recorder::new(scene.system());
    let (outcome, legs, _) = simulate_automatic(scene.system(), &first, span, scene.0.start(), &mut recorder).unwrap();
    (outcome, legs, recorder.finish())
}

const EXPLICIT: [&str; 3] = ["index1", "dop853", "manifold"];
const IMPLICIT: [&str; 3] = ["ggl", "radau_iia", "none"];

/// Whatever a run begins with, it goes on with what comes farther: fine finite elements that no step of dop853 goes over,
/// and a pendulum that has nothing fast.
#[test]
fn a_bad_beginning_is_left() {
    for (scene, first, then) in
        [(shipped("spin_up_beam", &[]), EXPLICIT, "radau_iia"), (shipped("pendulum", &[]), IMPLICIT, "dop853")]
    {
        let span = Span { output_step: 0.01, ..scene.span() };
        let (outcome, legs, record) = begun_with(&scene, first, span);
        let names: Vec<&str> = legs.iter().map(|leg| leg.method.integrator.name.as_str()).collect();
        assert_eq!(names, [first[1], then], "{legs:?}");
        assert!(outcome.failure.is_none() && legs[1].from < 0.2 * span.end, "{legs:?}");
        // Rows come each once, through the change.
        let times: Vec<f64> = record.trajectory.rows.iter().map(|row| row[0]).collect();
        assert_eq!(times.len(), (span.end / 0.01).round() as usize + 1);
        assert!(times.iter().enumerate().all(|(i, t)| (t - 0.01 * i as f64).abs() < 1e-9));
        // The work of forces is carried on.
        let energy = record.energy.as_ref().unwrap();
        assert!(energy.relative_max_error.unwrap() < 1e-4, "{energy:?}");
        // The same again, bit by bit, and near to the one method alone.
        let (again, ..) = begun_with(&scene, first, span);
        assert_eq!(again, outcome);
        let other = if first == EXPLICIT { IMPLICIT } else { EXPLICIT };
        let (alone, legs, _) = begun_with(&scene, other, span);
        assert_eq!(legs.len(), 1, "{legs:?}");
        let size = alone.q.iter().fold(0.0f64, |size, q| size.max(q.abs()));
        let gap = alone.q.iter().zip(&outcome.q).fold(0.0f64, |gap, (a, b)| gap.max((a - b).abs())) / size;
        assert!(gap < 1e-4, "{gap:e}");
    }
}

/// A force that has no value beyond a place stops one method, and then the other: the run ends with the reason, and what it
/// had.
#[test]
fn where_both_methods_stop_the_run_does() {
    let scene = parse(
        r#"{ "name": "wall", "dimension": 2, "bodies": [{ "name": "m", "type": "point_mass", "mass": 1,
            "initial": { "position": [1, 0], "velocity": [-1, 0] } }],
            "joints": [{ "name": "rail", "type": "equation", "expression": "m.y" }],
            "forces": [{ "name": "f", "type": "applied_force", "at": "m", "force": ["1/m.x^2*sqrt(m.x - 0.5)", 0] }] }"#,
    );
    let (outcome, legs, record) = begun_with(&scene, EXPLICIT, Span { start: 0.0, end: 5.0, output_step: 0.1 });
    let failure = outcome.failure.expect("nothing is defined beyond x = 0.5");
    assert!(legs.len() >= 2 && failure.t > 0.3 && failure.t < 5.0, "{legs:?} {failure:?}");
    assert!(record.trajectory.rows.len() > 3);
}
