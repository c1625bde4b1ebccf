//! Functions of linear models take a scene and own equations alike.

use crate::examples::own_equations::Pendulum;
use holonom::linear::{State, at_rest, linearize, states, transition, validate};
use holonom::prelude::*;
use holonom::research::results::{Chart, Settings};
use holonom::system::MechanicalSystem;

const MASS: f64 = 2.0;
const LENGTH: f64 = 0.5;

fn scene() -> Model {
    Model::parse(
        r#"{ "name": "pendulum", "dimension": 2, "gravity": [0, -9.81],
            "bodies": [{ "name": "bob", "type": "point_mass", "mass": 2, "initial": { "position": [0.5, 0] } }],
            "joints": [{ "name": "rod", "type": "distance", "between": ["ground", "bob"], "length": 0.5 }] }"#,
    )
    .unwrap()
}

/// Frequency at rest, angle of a swing at a time and growth over it, and whether the check agrees.
fn all_of(system: &dyn MechanicalSystem) -> Result<Vec<f64>> {
    let hanging = State::new(0.0, [0.1, -(LENGTH * LENGTH - 0.01).sqrt()], [0.0, 0.0]);
    let rest = at_rest(system, &hanging)?;
    let model = linearize(system, &rest.state, &Linear::default())?;
    assert_eq!(model.a, rest.linearize(&Linear::default())?.a);
    let start = State::new(0.0, [LENGTH, 0.0], [0.0, 0.0]);
    let [late, early] = &states(system, "index1 + dop853 + manifold", &start, &[0.4, 0.1])?[..] else { unreachable!() };
    assert_eq!((early.t, late.t), (0.1, 0.4));
    let energy = |at: &State| 0.5 * MASS * at.v.iter().map(|v| v * v).sum::<f64>() + 9.81 * MASS * at.q[1];
    let growth = transition(system, &start, &Chart::MassOrthogonal, &[0.4])?[0].changes.q.norm();
    let check = validate(system, early, &Settings::default())?;
    assert!(check.verdict.ltv && check.verdict.lti, "{}", check.verdict.text);
    Ok(vec![model.eigenvalues()[0].im.abs(), energy(early), energy(late), late.q[0], growth])
}

#[test]
fn a_scene_and_own_equations_are_taken_alike() -> Result<()> {
    let model = scene();
    let of_scene = all_of(&model)?;
    let of_equations = all_of(&Pendulum { mass: MASS, length: LENGTH })?;
    for (a, b) in of_scene.iter().zip(&of_equations) {
        assert!((a - b).abs() <= 1e-6 * b.abs().max(1e-3), "{of_scene:?} {of_equations:?}");
    }
    let frequency = (9.81_f64 / LENGTH).sqrt();
    assert!((of_scene[0] - frequency).abs() < 1e-12 * frequency);
    assert!(of_scene[1].abs() < 1e-6 && of_scene[2].abs() < 1e-6, "{of_scene:?}");
    // The motion of the scene by its own method.
    let state = &model.states_at(&[0.4])?[0];
    assert!((state.q[0] - of_scene[3]).abs() < 1e-7);
    Ok(())
}

#[test]
fn states_begin_at_the_start() {
    let system = Pendulum { mass: MASS, length: LENGTH };
    let start = State::new(1.0, [LENGTH, 0.0], [0.0, 0.0]);
    assert_eq!(states(&system, Method::default(), &start, &[1.0]).unwrap(), std::slice::from_ref(&start));
    let error = states(&system, Method::default(), &start, &[0.5, 1.0]).unwrap_err().to_string();
    assert!(error.contains("cannot go to 0.5 s"), "{error}");
}

#[test]
fn a_start_off_the_constraints_is_named() {
    let system = Pendulum { mass: MASS, length: LENGTH };
    let open = ([1.1 * LENGTH, 0.0], [0.0, 0.0]);
    let error = simulate(&system, "index1 + dop853 + manifold", &open, 0.0..1.0).map(|_| ()).unwrap_err().to_string();
    assert!(error.contains("the constraint of `lambda1` is open by 0.05 at the start"), "{error}");
    assert!(error.contains("begin at a state that closes the constraints"), "{error}");
}
