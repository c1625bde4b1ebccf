//! The table of drifts of the suspension under RK4 with h = 0.01 s.

use super::*;

/// Rods held by (|d|^2 - L^2)/2 = 0, as the table was computed. With |d| - L the velocities and positions drift to
/// the same, times L; what one projection leaves hangs on the form of the constraints: 1.6e-13 in the place of 5.8e-13.
fn squared_rods() -> Ready {
    let mut scene = scene("five_link_suspension");
    for (i, joint) in scene["joints"].as_array_mut().unwrap().iter_mut().enumerate() {
        let rod = i + 1;
        let square = |axis: &str| format!("(carrier.B{rod}.{axis} - chassis.A{rod}.{axis})^2");
        let squares = ["x", "y", "z"].map(square).join(" + ");
        *joint = json!({ "name": format!("rod{rod}"), "type": "equation",
            "expression": format!("({squares} - length{rod}^2)/2") });
    }
    let is_of_rod = |output: &Value| output["measure"] == "reaction";
    scene["outputs"].as_array_mut().unwrap().retain(|output| !is_of_rod(output));
    parse(&scene.to_string())
}

fn method(formulation: &str, projection: &str) -> Method {
    let [formulation, projection] = [formulation, projection].map(|text| MethodSpec::parse(text).unwrap());
    Method { formulation, projection, integrator: MethodSpec::named("rk4"), step: Some(0.01), ..Method::default() }
}

/// Largest |phi|, |phi'| and error of the heights and positions, at the steps.
fn row(ready: &Ready, method: &Method, exact: &Run) -> [f64; 3] {
    let run = ready.run(method, until(2.5, 0.01));
    let rows = run.record.trajectory.rows.iter().zip(&exact.record.trajectory.rows);
    let position = |row: &[f64]| exact.record.trajectory.row_state(row).0[..4].to_vec();
    let error = rows.map(|(row, exact)| apart(&run.record.trajectory.row_state(row).0[..4], &position(exact)));
    [run.record.drift.position.max, run.record.drift.velocity.max, error.fold(0.0, f64::max)]
}

/// Formulation, projection, and the table: position drift, velocity drift, position error.
const TABLE: [(&str, &str, [f64; 3]); 5] = [
    ("index1", "none", [1.9e-4, 1.0e-4, 4.7e-4]),
    // (g1, g0) = (12, 70) and (2/h, 1/h^2) in phi'' + g1 phi' + g0 phi = 0.
    ("baumgarte:alpha=6,beta=8.366600265340756", "none", [4.6e-6, 5.8e-5, 3.1e-5]),
    ("baumgarte:alpha=100,beta=100", "none", [6.6e-6, 9.6e-4, 3.1e-5]),
    ("index1", "manifold", [5.8e-13, 1.2e-7, 3.1e-5]),
    ("index1", "manifold:sweeps=2", [7e-17, 1e-13, 3.1e-5]),
];

#[test]
fn drifts_are_those_of_the_table() {
    let exact = shipped("five_link_suspension", &[]).tight(1e-12, 2.5, 0.01);
    let ready = squared_rods();
    for (formulation, projection, expected) in TABLE {
        let found = row(&ready, &method(formulation, projection), &exact);
        for (found, expected) in found.into_iter().zip(expected) {
            // Two digits are known; 1e-16 is round-off, of which the size alone is.
            let slack = if expected < 1e-15 {
                4.0 * expected
            } else if expected < 1e-12 {
                expected
            } else {
                0.05 * expected
            };
            assert!((found - expected).abs() < slack, "{formulation} {projection}: {found:e}, not {expected:e}");
        }
    }
}

/// The shipped scene holds |d| - L. One sweep a step keeps the order and costs no accuracy; a second leaves round-off.
#[test]
fn lengths_in_metres_drift_alike() {
    let exact = shipped("five_link_suspension", &[]).tight(1e-12, 2.5, 0.01);
    let ready = shipped("five_link_suspension", &[]);
    // Lengths of the rods lie between 0.277 and 0.458 m.
    for (formulation, projection, [position, velocity, error]) in TABLE {
        let found = row(&ready, &method(formulation, projection), &exact);
        assert!((found[2] - error).abs() < 0.05 * error, "{formulation} {projection}: {found:?}");
        if !projection.starts_with("manifold") {
            let between = |found: f64, expected: f64| found > expected / 0.46 && found < expected / 0.27;
            assert!(between(found[0], position) && between(found[1], velocity), "{formulation}: {found:?}");
        }
    }
}
