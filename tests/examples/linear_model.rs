//! A linear model at an equilibrium: eigenvalues of a pendulum that hangs at rest.

use holonom::linear::{State, at_rest};
use holonom::prelude::*;

#[test]
fn a_pendulum_swings_at_its_frequency() -> Result<()> {
    let pendulum = Model::parse(
        r#"{ "name": "pendulum", "dimension": 2, "gravity": [0, -9.81],
            "bodies": [{ "name": "rod", "type": "rigid", "mass": 2, "inertia": 0.3,
                         "markers": { "A": [0, 0.5] }, "initial": { "position": [0.1, -0.5], "angle": 0.2 } }],
            "joints": [{ "name": "pivot", "type": "revolute", "between": ["ground", "rod.A"] }],
            "forces": [{ "name": "drive", "type": "applied_torque", "at": "rod", "torque": 0 }],
            "inputs": [{ "name": "torque", "force": "drive" }],
            "outputs": [{ "name": "angle", "measure": "angle", "of": "rod" }] }"#,
    )?;
    // Of a state of the motion in its place: `pendulum.linearize_at(0.5, &Linear::default())`.
    let rest = at_rest(&pendulum, &State::start(&pendulum))?;
    let model = rest.linearize(&Linear::default())?;

    // (J + m l^2) theta'' + m g l theta = torque
    let (inertia, stiffness): (f64, f64) = (0.3 + 2.0 * 0.25, 2.0 * 9.81 * 0.5);
    let frequency = (stiffness / inertia).sqrt();
    assert!((model.eigenvalues()[0].im.abs() - frequency).abs() < 1e-13 * frequency);
    let gain = (&model.c * model.a.clone().try_inverse().expect("A is regular here") * &model.b)[(0, 0)];
    assert!((gain + 1.0 / stiffness).abs() < 1e-13, "static: -C A^-1 B is the compliance");
    Ok(())
}
