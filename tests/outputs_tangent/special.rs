//! States where sizes and angles have no slope: derivatives are numbers there, zero for the sizes.

use crate::outputs_tangent::compare::tangent;
use crate::outputs_tangent::measures::mechanism;
use holonom::system::{MechanicalSystem, OperatingPoint, OutputTangent};

/// All coordinates, velocities and multipliers zero, quaternions at rest.
fn at_zero(system: &dyn MechanicalSystem) -> OutputTangent {
    let n = system.dimensions();
    let names = system.facts().names.q.clone();
    let q: Vec<f64> = names.iter().map(|name| if name.ends_with(".qw") { 1.0 } else { 0.0 }).collect();
    let v = vec![0.0; n.v];
    let lambda = vec![0.0; n.lambda];
    tangent(system, OperatingPoint { t: 0.0, q: &q, v: &v, vdot: &v, lambda: &lambda })
}

fn scene(dimension: usize) -> String {
    let (inertia, zero, stiffness, force) = match dimension {
        2 => ("0.4", "0, 0", "1, 2, 3", r#""-d.x'", 0"#),
        _ => ("[0.4, 0.5, 0.6]", "0, 0, 0", "1, 2, 3, 4, 5, 6", r#"0, 0, "-d.z'""#),
    };
    format!(
        r#"{{ "name": "special", "dimension": {dimension}, "ground": {{ "markers": {{ "w": [{zero}] }} }},
        "bodies": [ {{ "name": "b", "type": "rigid", "mass": 1, "inertia": {inertia} }},
            {{ "name": "d", "type": "point_mass", "mass": 1 }} ],
        "joints": [ {{ "name": "joint", "type": "weld", "between": ["ground.w", "b"] }} ],
        "forces": [
            {{ "name": "bushing", "type": "bushing", "between": ["ground.w", "b"], "stiffness": [{stiffness}] }},
            {{ "name": "spring", "type": "spring_damper", "between": ["ground.w", "d"], "stiffness": 2 }},
            {{ "name": "push", "type": "applied_force", "at": "d", "force": [{force}] }} ],
        "inputs": [ {{ "name": "u", "force": "push", "component": "x" }} ],
        "outputs": [
            {{ "name": "distance", "measure": "distance", "between": ["b", "d"] }},
            {{ "name": "rate", "measure": "distance_rate", "between": ["b", "d"] }},
            {{ "name": "reaction", "measure": "reaction", "of": "joint" }},
            {{ "name": "bushing", "measure": "force", "of": "bushing" }},
            {{ "name": "spring", "measure": "force", "of": "spring" }},
            {{ "name": "push", "measure": "force", "of": "push" }},
            {{ "name": "size", "measure": "expression", "value": "sqrt(d.x^2 + d.y^2)" }},
            {{ "name": "x", "measure": "position", "of": "d", "component": "x" }} ] }}"#
    )
}

#[test]
fn sizes_at_zero_have_no_slope() {
    for dimension in [2, 3] {
        let mechanism = mechanism(&scene(dimension));
        let system = mechanism.system();
        let found = at_zero(system);
        let position = system.facts().outputs.len() - 1;
        for matrix in [&found.q, &found.v, &found.lambda, &found.u] {
            assert!(matrix.rows(0, position).iter().all(|slope| *slope == 0.0), "{dimension}: {matrix}");
        }
        let d = system.facts().names.v.iter().position(|name| name == "d.x'").unwrap();
        assert_eq!(found.q[(position, d)], 1.0);
    }
}

/// Where the first axis of one marker is along the third of the other, there is no angle between them.
#[test]
fn an_angle_without_a_plane_has_no_slope() {
    let mechanism = mechanism(
        r#"{ "name": "gimbal", "dimension": 3,
        "ground": { "markers": { "w": { "position": [0, 0, 0], "z_axis": [1, 0, 0] } } },
        "bodies": [ { "name": "b", "type": "rigid", "mass": 1, "inertia": [1, 1, 1] } ],
        "outputs": [ { "name": "angle", "measure": "angle", "of": "b", "relative_to": "ground.w" } ] }"#,
    );
    assert!(at_zero(mechanism.system()).q.iter().all(|slope| slope.is_finite()));
}
