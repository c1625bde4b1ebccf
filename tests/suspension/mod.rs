//! The five-link suspension: against references, its kinematics, its limits and mirror images, its drift.

mod drift;
mod full_axle;
mod reference;

use crate::scenes::{Ready, Run, dop853, model, parse, shipped};
use holonom::method_spec::MethodSpec;
use holonom::simulate::{Method, Span};
use reference::STATES;
use serde_json::{Value, json};

/// Rod forces at rest in the design position, N.
const RODS_AT_REST: [f64; 5] = [-860.2, -3177.2, -197.0, 2553.5, 2034.8];

/// max |x - y|
fn apart(x: &[f64], y: &[f64]) -> f64 {
    assert_eq!(x.len(), y.len());
    x.iter().zip(y).fold(0.0, |largest: f64, (x, y)| largest.max((x - y).abs()))
}

fn until(end: f64, output_step: f64) -> Span {
    Span { start: 0.0, end, output_step }
}

fn extremes(values: &[f64]) -> (f64, f64) {
    values.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), &x| (low.min(x), high.max(x)))
}

fn rod_forces(run: &Run, row: usize) -> Vec<f64> {
    (1..=5).map(|rod| run.column(&format!("rod{rod}_force"))[row]).collect()
}

/// A shipped scene as JSON, to be changed.
fn scene(name: &str) -> Value {
    serde_json::from_str(&std::fs::read_to_string(model(name)).unwrap()).unwrap()
}

/// Largest errors against the reference: positions, velocities, rod forces relative to the largest of each rod, and the
/// forces of tyre and strut, N.
fn errors(run: &Run) -> [f64; 4] {
    let mut worst = [0.0; 4];
    assert_eq!(run.times().len(), STATES.len());
    for (i, (state, row)) in STATES.iter().zip(&run.record.trajectory.rows).enumerate() {
        assert!((run.times()[i] - state.t).abs() < 1e-12);
        let (q, v, lambda) = run.record.trajectory.row_state(row);
        assert_eq!(rod_forces(run, i), lambda, "the multiplier of a rod is its tension");
        // A quaternion and its negative are the same rotation.
        let sign = (q[4] * state.q[4]).signum();
        let turned: Vec<f64> = q.iter().enumerate().map(|(i, q)| if i < 4 { *q } else { sign * q }).collect();
        let scale = |rod: usize| STATES.iter().fold(0.0, |largest: f64, state| largest.max(state.rods[rod].abs()));
        let rods = (0..5).map(|rod| (lambda[rod] - state.rods[rod]).abs() / scale(rod)).fold(0.0, f64::max);
        // The strut is in tension where it pulls.
        let forces = [run.column("tyre_force")[i], -run.column("strut_force")[i]];
        let found = [apart(&turned, &state.q), apart(v, &state.v), rods, apart(&forces, &[state.tyre, state.strut])];
        worst.iter_mut().zip(found).for_each(|(worst, found)| *worst = found.max(*worst));
    }
    worst
}

fn check(run: &Run, bounds: [f64; 4]) {
    let found = errors(run);
    assert!(found.iter().zip(bounds).all(|(found, bound)| *found < bound), "{found:?}, not below {bounds:?}");
}

/// The reference is good to 12 digits (positions) and 11 (velocities); the tyre's spring of 2e5 N/m and the dampers
/// carry errors of 1e-12 m and 1e-10 m/s into forces of 5 kN.
#[test]
fn massless_rods_follow_the_reference() {
    let suspension = shipped("five_link_suspension", &[]);
    for projection in ["manifold", "exact"] {
        let method = Method { projection: MethodSpec::named(projection), ..dop853(1e-12) };
        check(&suspension.run(&method, until(2.5, 0.25)), [2e-12, 2e-10, 5e-10, 5e-7]);
    }
}

/// Collocation on both constraints shares nothing with the explicit method but the equations. Its errors are some tens of
/// tolerances where the bump begins within a step; velocities and forces have a digit or two less, as the tyre's spring is
/// stiff.
#[test]
fn an_implicit_method_agrees() {
    let suspension = shipped("five_link_suspension", &[]);
    for (tolerance, bounds) in [(1e-8, [2e-7, 4e-6, 2e-5, 4e-2]), (1e-13, [5e-12, 3e-10, 1e-9, 1e-6])] {
        let [formulation, integrator, projection] = ["ggl", "radau_iia", "none"].map(MethodSpec::named);
        let method = Method { formulation, integrator, projection, rtol: tolerance, atol: tolerance, step: None };
        check(&suspension.run(&method, until(2.5, 0.25)), bounds);
    }
}

/// At rest before the bump, at a loose tolerance too: the first step does not go over it.
#[test]
fn a_loose_tolerance_sees_the_bump() {
    let suspension = shipped("five_link_suspension", &[]);
    let exact = suspension.tight(1e-10, 2.5, 0.25).column("chassis_height");
    for formulation in ["ggl", "index3", "index2"] {
        let [formulation, integrator, projection] = [formulation, "radau_iia", "none"].map(MethodSpec::named);
        let method = Method { formulation, integrator, projection, rtol: 1e-6, atol: 1e-6, step: None };
        let found = suspension.run(&method, until(2.5, 0.25)).column("chassis_height");
        assert!(apart(&found, &exact) < 1e-4, "{}: {:e}", method.triple(), apart(&found, &exact));
    }
}

#[test]
fn rods_as_bodies_follow_the_reference() {
    let run = shipped("five_link_suspension_rods", &[]).tight(1e-12, 2.5, 0.1);
    let height = run.column("chassis_height");
    let off = [height[6] - 0.06672382953461, height[25] - 0.004084069828015];
    assert!(off.iter().all(|off| off.abs() < 2e-12), "{off:?}");
}

#[test]
fn both_start_in_static_equilibrium() {
    for name in ["five_link_suspension", "five_link_suspension_rods", "full_axle"] {
        let ready = shipped(name, &[]);
        // The preload has 12 digits: 5e-9 N on 38 kg.
        let fastest = apart(&ready.start().vdot, &vec![0.0; ready.start().vdot.len()]);
        assert!(fastest < 1e-9, "{name} starts with {fastest:e} m/s^2 or rad/s^2");
    }
    let run = shipped("five_link_suspension", &[]).tight(1e-9, 0.1, 0.1);
    assert!(apart(&rod_forces(&run, 0), &RODS_AT_REST) < 0.05, "{:?}", rod_forces(&run, 0));
}

/// Over the bump and the dip. The peak of the tyre force is sharp: 7.18 kN in rows of 10 ms, 7.19 kN in rows of 1 ms.
#[test]
fn travel_and_tyre_force_stay_in_their_ranges() {
    let run = shipped("five_link_suspension", &[]).tight(1e-9, 2.5, 0.001);
    let (low, high) = extremes(&run.column("wheel_travel"));
    assert!((low + 0.055).abs() < 5e-4 && (high - 0.051).abs() < 5e-4, "{low} {high}");
    let (low, high) = extremes(&run.column("tyre_force"));
    assert!((low - 1190.0).abs() < 5.0 && (high - 7190.0).abs() < 5.0, "{low} {high}");
    let coarse: Vec<f64> = run.column("tyre_force").into_iter().step_by(10).collect();
    assert!((extremes(&coarse).1 - 7180.0).abs() < 5.0, "{:?}", extremes(&coarse));
}

/// As the rods lose their mass, they carry what massless rods carry, and the wheel moves as on those.
#[test]
fn light_rods_are_massless_rods() {
    let span = until(1.0, 0.1);
    let massless = shipped("five_link_suspension", &[]).run(&dop853(1e-10), span);
    let run = |density: f64| {
        let light = [("density", density), ("strut_preload", 3945.39689838)];
        let run = shipped("five_link_suspension_rods", &light).run(&dop853(1e-10), span);
        let rows = 0..run.times().len();
        let force = rows.map(|row| apart(&rod_forces(&run, row), &rod_forces(&massless, row))).fold(0.0, f64::max);
        (apart(&run.column("chassis_height"), &massless.column("chassis_height")), force)
    };
    let heavy = run(3e-3);
    let light = run(3e-4);
    // Proportional to the mass.
    assert!((heavy.0 / light.0 - 10.0).abs() < 0.1 && (heavy.1 / light.1 - 10.0).abs() < 0.1, "{heavy:?} {light:?}");
    assert!(light.0 < 1e-5 && light.1 < 0.1, "{light:?}");
}

/// Camber and toe at both ends of the travel, in degrees, as position problems.
#[test]
fn kinematics_reach_the_known_camber_and_toe() {
    for (travel, camber, toe) in [(-0.08, 1.56, -0.41), (0.08, -1.62, 0.21)] {
        let run = shipped("five_link_kinematics", &[("travel", travel), ("stroke", 0.0)]).tight(1e-9, 0.1, 0.1);
        let at = |name: &str| run.column(name)[0].to_degrees();
        assert!((run.column("wheel_travel")[0] - travel).abs() < 1e-12);
        // The known values are rounded to a hundredth.
        assert!(
            (at("camber") - camber).abs() < 0.005 && (at("toe") - toe).abs() < 0.005,
            "{} {}",
            at("camber"),
            at("toe")
        );
    }
}

/// Driven up and down, the wheel passes through the solutions of the position problems.
#[test]
fn the_driven_wheel_passes_through_the_position_problems() {
    let driven = shipped("five_link_kinematics", &[]).tight(1e-11, 1.0, 0.125);
    for (row, travel) in driven.column("wheel_travel").into_iter().enumerate() {
        let held = shipped("five_link_kinematics", &[("travel", travel), ("stroke", 0.0)]).tight(1e-9, 0.1, 0.1);
        for name in ["camber", "toe", "track_change", "wheelbase_change"] {
            let off = (driven.column(name)[row] - held.column(name)[0]).abs();
            assert!(off < 1e-9, "{name} at {travel} m is off by {off:e}");
        }
    }
}

/// One degree of freedom a wheel: the moving suspension has the camber and toe that its travel alone determines.
#[test]
fn camber_and_toe_follow_from_the_travel() {
    let run = shipped("five_link_suspension", &[]).tight(1e-11, 1.0, 0.1);
    for (row, travel) in run.column("wheel_travel").into_iter().enumerate() {
        let held = shipped("five_link_kinematics", &[("travel", travel), ("stroke", 0.0)]).tight(1e-9, 0.1, 0.1);
        for name in ["camber", "toe"] {
            let off = (run.column(name)[row] - held.column(name)[0]).abs();
            assert!(off < 1e-9, "{name} at {travel} m is off by {off:e}");
        }
    }
}

/// `track_change` against the lowest of many points on the wheel's rim.
#[test]
fn track_changes_with_the_lowest_point_of_the_wheel() {
    let mut scene = scene("five_link_kinematics");
    scene["parameters"]["travel"] = json!(0.06);
    scene["bodies"][0]["markers"]["rim"] =
        json!(["hub_x - com_x + tyre_radius*sin(angle)", "hub_y - com_y", "hub_z - com_z - tyre_radius*cos(angle)"]);
    let outputs = scene["outputs"].as_array_mut().unwrap();
    outputs.push(json!({ "name": "rim_z", "measure": "position", "of": "carrier.rim", "component": "z" }));
    outputs.push(json!({ "name": "rim_y", "measure": "position", "of": "carrier.rim", "component": "y" }));
    let at = |angle: f64| {
        let mut scene = scene.clone();
        scene["parameters"]["angle"] = json!(angle);
        parse(&scene.to_string()).tight(1e-9, 0.1, 0.1)
    };
    let runs: Vec<Run> = (-100..=100).map(|i| at(f64::from(i) * 1e-3)).collect();
    let lowest = runs.iter().min_by(|a, b| a.column("rim_z")[0].total_cmp(&b.column("rim_z")[0])).unwrap();
    let outward = -0.8251 - lowest.column("rim_y")[0];
    let off = (lowest.column("track_change")[0] - outward).abs();
    // The lowest of the points is half a step of 1e-3 rad off at most, and there y changes with the rim's slope against
    // the road, which camber and toe leave at a hundredth.
    assert!(off < 1e-6, "{off:e}");
}

/// A reaction in the axes of a marker is the same vector as in the axes of the world.
#[test]
fn reactions_are_vectors_in_any_axes() {
    let mut scene = scene("five_link_suspension_rods");
    let outputs = scene["outputs"].as_array_mut().unwrap();
    let mut watch = |name: &str, of: &str, component: Option<&str>, to: Option<&str>| {
        let mut output = json!({ "name": name, "measure": "reaction", "of": of });
        component.into_iter().for_each(|component| output["component"] = json!(component));
        to.into_iter().for_each(|to| output["relative_to"] = json!(to));
        outputs.push(output);
    };
    for axis in ["x", "y", "z"] {
        watch(&format!("world_{axis}"), "rod4_outer", Some(axis), None);
        watch(&format!("rod_{axis}"), "rod4_outer", Some(axis), Some("rod4.A"));
        watch(&format!("world_m{axis}"), "rod4_inner", Some(&format!("m{axis}")), None);
        watch(&format!("rod_m{axis}"), "rod4_inner", Some(&format!("m{axis}")), Some("rod4.A"));
    }
    watch("size", "rod4_outer", None, None);
    for axis in ["x", "y", "z"] {
        let along = format!("(rod4.B.{axis} - rod4.A.{axis})/length4");
        outputs.push(json!({ "name": format!("along_{axis}"), "measure": "expression", "value": along }));
    }
    let run = parse(&scene.to_string()).tight(1e-9, 1.0, 0.1);
    let column = |name: &str, axis: &str| run.column(&format!("{name}{axis}"));
    let dot = |a: &str, b: &str, row: usize| -> f64 {
        ["x", "y", "z"].iter().map(|axis| column(a, axis)[row] * column(b, axis)[row]).sum()
    };
    for row in 0..run.times().len() {
        let square = run.column("size")[row].powi(2);
        assert!((dot("rod_", "rod_", row) - square).abs() < 1e-12 * square);
        assert!((dot("world_", "along_", row) - run.column("rod4_force")[row]).abs() < 1e-9);
        let torque = dot("world_m", "along_", row) - run.column("rod_mz")[row];
        assert!(torque.abs() < 1e-12 && dot("world_m", "world_m", row) > 0.0, "{torque:e}");
    }
}
