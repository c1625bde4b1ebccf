//! Position sweeps: branches against closed forms.

use holonom::sweep::{Family, Nearest, Point, Sweep};
use std::f64::consts::TAU;

/// Crank `a` at the origin, coupler `b`, rocker `c` at (g, 0); the crank is held at `angle`. The guess is that of
/// angle 1 whatever the angle, so that only the neighbour shows the branch.
fn four_bar([a, b, c, g]: [f64; 4]) -> Family {
    let scene = format!(
        r#"{{ "name": "four_bar", "dimension": 2, "parameters": {{ "angle": 1 }},
        "ground": {{ "markers": {{ "B": [{g}, 0] }} }},
        "bodies": [
            {{ "name": "C", "type": "point_mass", "mass": 1, "initial": {{ "position": ["{a}*cos(1)", "{a}*sin(1)"] }} }},
            {{ "name": "D", "type": "point_mass", "mass": 1, "initial": {{ "position": [{g}, {c}] }} }} ],
        "joints": [
            {{ "name": "x", "type": "equation", "expression": "C.x - {a}*cos(angle)" }},
            {{ "name": "y", "type": "equation", "expression": "C.y - {a}*sin(angle)" }},
            {{ "name": "coupler", "type": "distance", "between": ["C", "D"], "length": {b} }},
            {{ "name": "rocker", "type": "distance", "between": ["ground.B", "D"], "length": {c} }} ],
        "outputs": [{{ "name": "rocker", "measure": "expression", "value": "atan2(D.y, D.x - {g})" }}] }}"#
    );
    Family::parse(&scene).unwrap()
}

/// The rocker's angle on the branch with D above the line from C to B.
fn rocker([a, b, c, g]: [f64; 4], angle: f64) -> f64 {
    let x = a * angle.cos() - g;
    let y = a * angle.sin();
    let d = x.hypot(y);
    y.atan2(x) - ((c * c + d * d - b * b) / (2.0 * c * d)).acos()
}

/// Difference of two angles, in [-pi, pi].
fn apart(a: f64, b: f64) -> f64 {
    let turns = ((a - b) / TAU).round();
    (a - b - turns * TAU).abs()
}

fn sweep(family: &Family, range: &str) -> Sweep {
    family.sweep(&range.parse().unwrap(), |_| ()).unwrap()
}

const ROCKING: [f64; 4] = [1.0, 3.5, 3.0, 4.0];

#[test]
fn a_branch_is_kept_however_far_the_values_are_apart() {
    for count in [2, 3, 4, 5, 81] {
        let sweep = sweep(&four_bar(ROCKING), &format!("angle=-7..14:{count}"));
        assert_eq!((sweep.points.len(), sweep.limits.len()), (count, 0));
        for Point { value, outputs, .. } in &sweep.points {
            let error = apart(outputs[0], rocker(ROCKING, *value));
            assert!(error < 1e-10, "{count} values, at {value}: {error:e}");
        }
    }
}

#[test]
fn both_ends_are_found() {
    // b + c = 3 is the greatest distance of C from B: cos(angle) = (a^2 + g^2 - 9)/(2 a g).
    let lengths = [1.8, 1.4, 1.6, 2.1];
    let end = ((1.8f64.powi(2) + 2.1f64.powi(2) - 9.0) / (2.0 * 1.8 * 2.1)).acos();
    for range in ["angle=-3..3:31", "angle=3..-3:31"] {
        let sweep = sweep(&four_bar(lengths), range);
        let sign = (sweep.range.to - sweep.range.from).signum();
        let found: Vec<f64> = sweep.limits.iter().map(|limit| limit.point.value).collect();
        assert!((found[0] + sign * end).abs() < 1e-6 && (found[1] - sign * end).abs() < 1e-6, "{found:?}, not {end}");
        assert!(sweep.points.is_sorted_by(|a, b| (b.value - a.value) * sign > 0.0));
        assert!(sweep.points.iter().all(|point| point.value.abs() < end) && sweep.points.len() == 17);
        let Nearest { value, rank_indicator } = sweep.nearest_singular;
        assert!((value.abs() - end).abs() < 1e-6 && rank_indicator < 1e-3, "{value} {rank_indicator:e}");
        assert!(sweep.limits.iter().all(|limit| limit.reason.contains("cannot all be closed")), "{:?}", sweep.limits);
        assert_eq!(sweep.limits[0].unreached, -1.8 * sign);
    }
}

#[test]
fn an_end_that_is_a_value_of_the_range_is_reached() {
    // The piston of a crank 1 and a rod 2 between its dead positions.
    let scene = r#"{ "name": "piston", "dimension": 2, "parameters": { "x": 2 }, "ground": { "markers": { "O": [0, 0] } },
        "bodies": [
            { "name": "pin", "type": "point_mass", "mass": 1, "initial": { "position": [0.3, 0.9] } },
            { "name": "piston", "type": "point_mass", "mass": 1, "initial": { "position": ["x", 0] } } ],
        "joints": [
            { "name": "crank", "type": "distance", "between": ["ground.O", "pin"], "length": 1 },
            { "name": "rod", "type": "distance", "between": ["pin", "piston"], "length": 2 },
            { "name": "drive", "type": "equation", "expression": "piston.x - x" },
            { "name": "guide", "type": "equation", "expression": "piston.y" } ] }"#;
    let sweep = sweep(&Family::parse(scene).unwrap(), "x=1..3:9");
    assert!(sweep.limits.is_empty(), "{:?}", sweep.limits);
    let pins: Vec<f64> = [0, 8].map(|i: usize| sweep.points[i].q[0]).to_vec();
    assert!((pins[0] + 1.0).abs() < 1e-6 && (pins[1] - 1.0).abs() < 1e-6, "{pins:?}");
    assert!(sweep.nearest_singular.rank_indicator < 1e-6);
}

#[test]
fn the_sweep_goes_to_a_range_beside_the_scenes_own_value() {
    let sweep = sweep(&four_bar(ROCKING), "angle=4..5:3");
    let found: Vec<f64> = sweep.points.iter().map(|point| point.value).collect();
    assert_eq!((found, &sweep.own, sweep.own_value), (vec![4.0, 4.5, 5.0], &None, 1.0));
    sweep.points.iter().for_each(|point| assert!(apart(point.outputs[0], rocker(ROCKING, point.value)) < 1e-10));
    let beyond = four_bar([1.8, 1.4, 1.6, 2.1]).sweep(&"angle=2..3:3".parse().unwrap(), |_| ());
    let message = beyond.unwrap_err().to_string();
    assert!(message.starts_with("from its own value angle = 1 the mechanism can be moved to 1.7"), "{message}");
}

#[test]
fn what_is_held_follows_the_scene() {
    // A rod at an angle that nothing but `hold` keeps.
    let scene = r#"{ "name": "held", "dimension": 2, "parameters": { "angle": 0.2 }, "ground": { "markers": { "O": [0, 0] } },
        "bodies": [{ "name": "rod", "type": "rigid", "mass": 1, "inertia": 1, "markers": { "A": [-1, 0] },
            "initial": { "angle": "angle" } }],
        "joints": [{ "name": "pin", "type": "revolute", "between": ["ground.O", "rod.A"] }],
        "outputs": [{ "name": "angle", "measure": "angle", "of": "rod" }], "assembly": { "hold": ["rod.angle"] } }"#;
    let sweep = sweep(&Family::parse(scene).unwrap(), "angle=-4..7:5");
    assert!(sweep.limits.is_empty());
    for Point { value, q, outputs, .. } in &sweep.points {
        assert!((q[0] - value.cos()).abs() < 1e-12 && (q[1] - value.sin()).abs() < 1e-12 && outputs[0] == q[2]);
        assert!((q[2] - value).abs() < 1e-12);
    }
}

#[test]
fn a_singular_state_is_passed_and_told() {
    // A kite folds flat at angle 0, where C and B coincide.
    let sweep = sweep(&four_bar([2.0, 1.5, 1.5, 2.0]), "angle=-1..1:5");
    assert_eq!((sweep.points.len(), sweep.nearest_singular.value), (5, 0.0));
    assert!(sweep.nearest_singular.rank_indicator < 1e-6);
}

#[test]
fn values_beyond_what_expressions_are_defined_for_are_ends() {
    let scene = r#"{ "name": "root", "dimension": 2, "parameters": { "a": 1, "y": "sqrt(2 - a)" },
        "bodies": [{ "name": "p", "type": "point_mass", "mass": 1, "initial": { "position": [0, "y"] } }],
        "joints": [{ "name": "y", "type": "equation", "expression": "p.y - y" }] }"#;
    let sweep = sweep(&Family::parse(scene).unwrap(), "a=0..3:4");
    let [limit] = sweep.limits.as_slice() else { panic!("{:?}", sweep.limits) };
    assert_eq!(sweep.points.len(), 3);
    assert!((limit.point.value - 2.0).abs() < 1e-6 && limit.reason.contains("sqrt(2 - a)"), "{limit:?}");
}

#[test]
fn redundant_constraints_are_not_singular() {
    let family = Family::parse(include_str!("../models/parallelogram_redundant.json")).unwrap();
    let sweep = sweep(&family, "angle0=0.5..1.2:5");
    // The rank indicator depends on the order of elimination and on which dependent row is dropped. It is never below
    // the smallest singular value of the unit rows that are left, with the held one: 0.033 to 0.093 here over all
    // choices of that row.
    assert!(sweep.limits.is_empty() && sweep.nearest_singular.rank_indicator > 0.03, "{:?}", sweep.nearest_singular);
}
