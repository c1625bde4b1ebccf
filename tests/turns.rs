//! Angles in space that go through full turns, and parts that are deformed beyond what their theory holds for.

use crate::common::{adaptive, fixed, method, until};
use crate::scenes::{Ready, parse, shipped};
use holonom::simulate::{Method, Span};

/// A unit flywheel on a unit torsion spring, which starts with 3.5 rad/s: angle(t) = 3.5 sin t winds it up to 3.5 rad.
fn wound(free_angle: f64) -> Ready {
    parse(&format!(
        r#"{{ "name": "wound", "dimension": 3, "ground": {{ "markers": {{ "O": [0, 0, 0] }} }},
        "bodies": [{{ "name": "r", "type": "rigid", "mass": 1, "inertia": [1, 1, 1],
                     "initial": {{ "angular_velocity": [0, 0, 3.5] }} }}],
        "joints": [{{ "name": "O", "type": "revolute", "between": ["ground.O", "r"] }}],
        "forces": [{{ "name": "s", "type": "torsion_spring", "between": ["ground.O", "r"], "stiffness": 1,
                     "free_angle": {free_angle} }}],
        "outputs": [{{ "name": "angle", "measure": "angle", "of": "r" }}, {{ "name": "m", "measure": "force", "of": "s" }},
                    {{ "name": "speed", "measure": "angular_velocity", "of": "r", "component": "z" }}],
        "simulation": {{ "t_end": 4 }} }}"#
    ))
}

/// Every kind of step carries the turn: explicit, implicit, on the group, and those of another library with their own state.
#[test]
fn torsion_springs_wind_up_beyond_half_a_turn() {
    let methods: [(Method, f64); 6] = [
        (adaptive("index1", "dop853", "manifold", 1e-9), 1e-7),
        (adaptive("ggl", "radau_iia", "none", 1e-9), 1e-6),
        (adaptive("index3", "radau_iia", "none", 1e-9), 1e-6),
        (adaptive("index1", "bdf", "none", 1e-9), 1e-5),
        (adaptive("ggl", "bdf", "none", 1e-9), 1e-5),
        (fixed("index3", "generalized_alpha", "none", 1e-3), 1e-4),
    ];
    let scene = wound(0.0);
    for (method, tolerance) in methods {
        let motion = scene.run(&method, Span { start: 0.0, end: 4.0, output_step: 0.5 });
        let name = &method.integrator.name;
        let error = [
            motion.worst("angle", |t| 3.5 * t.sin()),
            motion.worst("speed", |t| 3.5 * t.cos()),
            motion.worst("m", |t| -3.5 * t.sin()),
        ];
        assert!(error.iter().all(|error| *error < tolerance), "{name}: {error:?}");
    }
    // The start is within half a turn of the free angle: 2 pi lies as 0 does.
    let motion = wound(std::f64::consts::TAU).run(&adaptive("index1", "dop853", "manifold", 1e-9), until(4.0));
    assert!(motion.worst("speed", |t| 3.5 * t.cos()) < 1e-7);
}

/// Angles that outputs watch are counted beside the motion: its steps are those of the scene without them, bit by bit.
#[test]
fn watched_angles_leave_the_motion_as_it_is() {
    let governor = std::fs::read_to_string(crate::scenes::model("flyball_governor")).unwrap();
    let mut scene: serde_json::Value = serde_json::from_str(&governor).unwrap();
    let watched = parse(&scene.to_string());
    scene["outputs"].as_array_mut().unwrap().retain(|output| output["measure"] != "angle");
    let alone = parse(&scene.to_string());
    for method in [
        adaptive("ggl", "radau_iia", "none", 1e-8),
        adaptive("index1", "dopri5", "manifold", 1e-6),
        adaptive("index1", "dop853", "none", 1e-6),
        adaptive("index2", "phem56", "none", 1e-6),
        adaptive("index3", "generalized_alpha", "none", 1e-4),
        fixed("index1", "radau_iia", "none", 1e-3),
    ] {
        let runs = [&watched, &alone].map(|ready| ready.run(&method, until(0.1)));
        let [watched, alone] = runs.each_ref().map(|run| {
            let trajectory = &run.record.trajectory;
            trajectory.row_state(trajectory.rows.last().unwrap())
        });
        let name = &method.integrator.name;
        assert_eq!(runs[0].outcome.statistics.steps, runs[1].outcome.statistics.steps, "{name}");
        assert_eq!((&watched.0[..alone.0.len()], watched.1), (alone.0, alone.1), "{name}");
    }
}

/// 1000 rad in steps of up to half a turn, and rows 100 rad apart.
#[test]
fn turns_are_counted_over_steps_not_over_rows() {
    let fast = parse(
        r#"{ "name": "fast", "dimension": 3, "ground": { "markers": { "O": [0, 0, 0] } },
        "bodies": [{ "name": "r", "type": "rigid", "mass": 1, "inertia": [1, 1, 1],
                     "initial": { "angular_velocity": [0, 0, 100] } }],
        "joints": [{ "name": "O", "type": "revolute", "between": ["ground.O", "r"] }],
        "outputs": [{ "name": "angle", "measure": "angle", "of": "r" }], "simulation": { "t_end": 10 } }"#,
    );
    for step in [1.0, 10.0] {
        let span = Span { start: 0.0, end: 10.0, output_step: step };
        let motion = fast.run(&method("index1", "dop853", "manifold"), span);
        let error = motion.worst("angle", |t| 100.0 * t);
        assert!(error < 0.1, "{step}: {error}");
    }
    let shaft = shipped("universal_shaft", &[]);
    let motion = shaft.tight(1e-9, 1.25, 0.35);
    assert!(motion.worst("input_angle", |t| 10.0 * t) < 1e-6);
    assert!(motion.worst("output_angle", |t| 10.0 * t) < 1e-6);
}

/// A body that may turn about one axis only has an angle for a coordinate; methods for q' = v take it with a counted turn.
#[test]
fn bodies_with_one_axis_stay_within_reach_of_rattle() {
    let guided = parse(
        r#"{ "name": "guided", "dimension": 3, "ground": { "markers": { "O": [0, 0, 0] } },
        "bodies": [{ "name": "r", "type": "rigid", "mass": 1, "inertia": [1, 1, 1], "free": ["rz"],
                     "initial": { "angular_velocity": [0, 0, 3.5] } }],
        "forces": [{ "name": "s", "type": "torsion_spring", "between": ["ground.O", "r"], "stiffness": 1 }],
        "outputs": [{ "name": "angle", "measure": "angle", "of": "r" }],
        "simulation": { "t_end": 4 } }"#,
    );
    let motion = guided.run(&fixed("index3", "rattle", "none", 1e-3), until(4.0));
    assert!(motion.worst("angle", |t| 3.5 * t.sin()) < 1e-4);
    assert!(motion.worst("r.rz", |t| 3.5 * t.sin()) < 1e-4);
}

/// A driver takes what it drives through five revolutions, there and back, in steps of any kind, and outputs count them.
#[test]
fn drivers_prescribe_several_revolutions() {
    let driven = parse(
        r#"{ "name": "driven", "dimension": 3, "ground": { "markers": { "O": [0, 0, 0] } },
        "bodies": [{ "name": "r", "type": "rigid", "mass": 1, "inertia": [1, 2, 3], "markers": { "A": [0.3, 0.1, 0] } }],
        "joints": [{ "name": "O", "type": "revolute", "between": ["ground.O", "r.A"] },
                   { "name": "drive", "type": "driver", "between": ["ground.O", "r.A"], "coordinate": "angle",
                     "value": "5*pi*(1 - cos(t))" }],
        "outputs": [{ "name": "angle", "measure": "angle", "of": "r.A" }],
        "simulation": { "t_end": 6 } }"#,
    );
    let value = |t: f64| 5.0 * std::f64::consts::PI * (1.0 - t.cos());
    for (method, tolerance) in [
        (adaptive("index1", "dop853", "manifold", 1e-9), 1e-9),
        (adaptive("index1", "dopri5", "none", 1e-8), 1e-5),
        (adaptive("ggl", "radau_iia", "none", 1e-9), 1e-9),
        (adaptive("index1", "bdf", "none", 1e-8), 1e-4),
        (adaptive("index2", "phem56", "none", 1e-8), 1e-5),
        (fixed("index3", "generalized_alpha", "none", 0.01), 1e-9),
        // Up to 2.9 rad a step.
        (fixed("index3", "radau_iia", "none", 0.2), 1e-9),
    ] {
        let motion = driven.run(&method, Span { start: 0.0, end: 6.0, output_step: 3.0 });
        let error = motion.worst("angle", value);
        assert!(error < tolerance, "{}: {error:e}", method.integrator.name);
    }
}

/// Without a projection the mesh drifts by more than half a tooth, 2 pi/400 here, and does not jump to the next gap.
#[test]
fn gears_keep_their_gap_however_far_drift_goes() {
    let mesh = parse(
        r#"{ "name": "mesh", "dimension": 3,
        "ground": { "markers": { "a": [0, 0, 0], "b": [1, 0, 0] } },
        "bodies": [
            { "name": "one", "type": "rigid", "mass": 1, "inertia": [1, 1, 1], "initial": { "angular_velocity": [0, 0, 8] } },
            { "name": "two", "type": "rigid", "mass": 1, "inertia": [1, 1, 1],
              "initial": { "position": [1, 0, 0], "angular_velocity": [0, 0, -8] } }],
        "joints": [
            { "name": "a", "type": "revolute", "between": ["ground.a", "one"] },
            { "name": "b", "type": "revolute", "between": ["ground.b", "two"] },
            { "name": "mesh", "type": "gear", "between": ["one", "two"], "carrier": ["ground.a", "ground.b"],
              "teeth": [400, 800] }],
        "simulation": { "t_end": 20 } }"#,
    );
    let q = &mesh.start().q;
    let v = mesh.start().v.clone();
    // A rate of the mesh that opens it by 0.02 rad/s, which index 1 does not see.
    let open: Vec<f64> = v.iter().enumerate().map(|(i, v)| if i == 5 { v + 0.02 } else { *v }).collect();
    let run =
        crate::common::run(mesh.system(), &fixed("index1", "rk4", "none", 0.01), until(2.0), (q, &open)).completed();
    let drift = run.record.drift.position.last;
    assert!((drift - 0.04).abs() < 1e-3, "{drift}");
}

/// A beam whose tip goes as far as it is long, linear in a floating frame: it is told, and one within its range is not.
#[test]
fn parts_beyond_their_theory_are_told() {
    let beam = |force: f64| {
        parse(&format!(
            r#"{{ "name": "beam", "dimension": 2, "ground": {{ "markers": {{ "O": [0, 0] }} }},
            "bodies": [{{ "name": "b", "type": "flexible_beam", "frame": "floating", "length": 1, "elements": 4,
                "material": {{ "E": 1e6, "nu": 0.3, "rho": 1000 }},
                "section": {{ "rectangle": {{ "height": 0.01, "width": 0.01 }} }},
                "markers": {{ "A": [0, 0], "B": [1, 0] }} }}],
            "joints": [{{ "name": "c", "type": "weld", "between": ["ground.O", "b.A"] }}],
            "forces": [{{ "name": "f", "type": "applied_force", "at": "b.B", "force": [0, {force}] }}],
            "simulation": {{ "t_end": 12 }} }}"#
        ))
    };
    let method = adaptive("ggl", "radau_iia", "none", 1e-5);
    // F l^3/(3 E I) at rest, and about twice that where the load comes at once.
    for (force, at_rest, warnings) in [(-2.5e-3, 1.0, 1), (-2e-5, 8e-3, 0)] {
        let range = beam(force).run(&method, until(12.0)).record.range;
        let most = range.parts[0].deformation;
        assert!((most / (2.0 * at_rest) - 1.0).abs() < 0.2, "{most}");
        assert_eq!(range.warnings().len(), warnings, "{:?}", range.warnings());
    }
}

/// An element of a spatial beam that is bent to a circle comes near to half a turn; in four elements it does not.
#[test]
fn elements_that_may_lose_a_turn_are_told() {
    let bend = |elements: usize| {
        parse(&format!(
            r#"{{ "name": "circle", "dimension": 3, "ground": {{ "markers": {{ "O": [0, 0, 0] }} }},
            "bodies": [{{ "name": "b", "type": "flexible_beam", "frame": "absolute", "length": 1, "elements": {elements},
                "material": {{ "E": 1e6, "nu": 0.3, "rho": 1000 }}, 
                "section": {{ "rectangle": {{ "height": 0.02, "width": 0.02 }} }},
                "markers": {{ "A": [0, 0, 0], "B": [1, 0, 0] }} }}],
            "joints": [{{ "name": "c", "type": "weld", "between": ["ground.O", "b.A"] }}],
            "forces": [{{ "name": "m", "type": "applied_torque", "at": "b.B", "torque": [0, 0, "0.035*smoothstep(t/5)"] }}],
            "simulation": {{ "t_end": 8 }} }}"#
        ))
    };
    for (elements, warnings) in [(1, 1), (4, 0)] {
        let range = bend(elements).run(&adaptive("ggl", "radau_iia", "none", 1e-4), until(8.0)).record.range;
        assert_eq!(range.warnings().len(), warnings, "{:?}", range.parts);
    }
}
