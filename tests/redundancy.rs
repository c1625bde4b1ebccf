//! Redundant rows change neither the motion nor the work that it takes.

use crate::common::fixed;
use crate::scenes::{Ready, Run, parse};
use holonom::simulate::Span;
use serde_json::{Value, json};

fn rod(name: String, x: f64, y: f64, angle: f64) -> Value {
    json!({ "name": name, "type": "rigid", "mass": 1, "inertia": "1/12",
        "markers": { "A": [-0.5, 0], "M": [0, 0], "B": [0.5, 0] }, "initial": { "position": [x, y], "angle": angle } })
}

fn joint(name: String, kind: &str, a: &str, b: String) -> Value {
    json!({ "name": name, "type": kind, "between": [a, b] })
}

fn scene(ground: Value, bodies: Vec<Value>, joints: Vec<Value>) -> Ready {
    let scene = json!({ "name": "redundant", "dimension": 2, "gravity": [0, -9.81], "ground": { "markers": ground },
        "bodies": bodies, "joints": joints, "simulation": { "t_end": 1 } });
    parse(&scene.to_string())
}

/// So many crossed pairs of rods on top of each other, the lowest on a slide. With guides the left ends are on a vertical
/// line, where they are anyway: a redundant row each.
fn scissors(pairs: usize, has_guides: bool) -> Ready {
    let angle = 0.7_f64;
    let mut bodies = Vec::new();
    let mut joints = Vec::new();
    let pin = |name: String, a: String, b: String| joint(name, "revolute", &a, b);
    for k in 0..pairs {
        let x = 0.5 * angle.cos();
        let y = (k as f64 + 0.5) * angle.sin();
        bodies.extend([rod(format!("u{k}"), x, y, angle), rod(format!("d{k}"), x, y, -angle)]);
        joints.push(pin(format!("M{k}"), format!("u{k}.M"), format!("d{k}.M")));
        let Some(below) = k.checked_sub(1) else { continue };
        joints.push(pin(format!("L{k}"), format!("d{below}.A"), format!("u{k}.A")));
        joints.push(pin(format!("R{k}"), format!("u{below}.B"), format!("d{k}.B")));
        if has_guides {
            joints.push(joint(format!("G{k}"), "point_on_line", "ground.V", format!("u{k}.A")));
        }
    }
    joints.push(pin("base".to_string(), "ground.H".to_string(), "u0.A".to_string()));
    joints.push(joint("slide".to_string(), "point_on_line", "ground.H", "d0.B".to_string()));
    let upright = json!({ "position": [0, 0], "angle": "pi/2" });
    scene(json!({ "V": upright, "H": [0, 0] }), bodies, joints)
}

/// A double pendulum with its elbow made of so many joints.
fn copies(count: usize) -> Ready {
    let bodies = vec![rod("a".to_string(), 0.5, 0.0, 0.0), rod("b".to_string(), 1.5, 0.0, 0.0)];
    let elbow = |k: usize| joint(format!("J{k}"), "revolute", "a.B", "b.A".to_string());
    let shoulder = joint("O".to_string(), "revolute", "ground.O", "a.A".to_string());
    scene(json!({ "O": [0, 0] }), bodies, [shoulder].into_iter().chain((0..count).map(elbow)).collect())
}

fn run(ready: &Ready) -> Run {
    ready.run(&fixed("index1", "rk4", "manifold", 0.01), Span { start: 0.0, end: 0.1, output_step: 0.01 })
}

fn distance(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).fold(0.0, |distance, (a, b)| f64::max(distance, (a - b).abs()))
}

/// Pivots of dependent rows are 1e-12 here, for round-off over the square of the rank indicator, 0.002: taken seriously
/// they would make the mechanism rigid.
#[test]
fn guides_of_scissors() {
    let [plain, guided] = [false, true].map(|has_guides| run(&scissors(50, has_guides)));
    assert_eq!(plain.outcome.statistics.factorizations, guided.outcome.statistics.factorizations);
    assert_eq!(guided.outcome.statistics.rank_deficient, guided.outcome.statistics.steps + 1);
    // Round-off over the rank indicator, times accelerations of 1e2.
    assert!(distance(&plain.outcome.q, &guided.outcome.q) < 1e-10);
    assert!(guided.record.singularity.passed.is_empty(), "{:?}", guided.record.singularity.passed);
    assert!(guided.outcome.failure.is_none() && guided.record.drift.position.max < 1e-11);
}

/// Each carries its part, which is the least norm.
#[test]
fn a_thousand_copies_of_a_joint() {
    let one = run(&copies(1));
    let many = run(&copies(1000));
    assert_eq!(one.outcome.statistics.factorizations, many.outcome.statistics.factorizations);
    assert!(distance(&one.outcome.q, &many.outcome.q) < 1e-13);
    let lambda = |run: &Run| {
        let trajectory = &run.record.trajectory;
        trajectory.row_state(trajectory.rows.last().unwrap()).2.to_vec()
    };
    let one = lambda(&one);
    let many = lambda(&many);
    let shared: Vec<f64> =
        (0..many.len()).map(|row| if row < 2 { one[row] } else { one[2 + row % 2] / 1000.0 }).collect();
    assert!(distance(&many, &shared) < 1e-11);
}
