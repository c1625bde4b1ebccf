//! Driver inputs of mechanisms in motion: perturbed simulations follow the model, and A belongs to its chart.

use crate::scenes::{Ready, parse};
use holonom::linearize::flow::{Bundle, Pulse, flow};
use holonom::linearize::{Changes, Chart, Matrix, State, Variation, minimal};
use holonom::validate::{Settings, validate};

/// A pendulum at the end of a crank that is turned ever faster.
fn planar() -> Ready {
    parse(
        r#"{ "name": "crank", "dimension": 2, "gravity": [0, -9.81], "ground": { "markers": { "O": [0, 0] } },
        "bodies": [
            { "name": "crank", "type": "rigid", "mass": 1, "inertia": 0.1, "markers": { "O": [0, 0], "P": [0.5, 0] } },
            { "name": "bob", "type": "rigid", "mass": 2, "inertia": 0.05, "markers": { "P": [-0.4, 0.1] },
              "initial": { "position": [0.9, -0.1] } } ],
        "joints": [ { "name": "O", "type": "revolute", "between": ["ground.O", "crank.O"] },
            { "name": "P", "type": "revolute", "between": ["crank.P", "bob.P"] },
            { "name": "motor", "type": "driver", "between": ["ground.O", "crank.O"], "coordinate": "angle", "value": "2*t + t^2" } ],
        "inputs": [ { "name": "turn", "driver": "motor" } ],
        "simulation": { "t_end": 1, "rtol": 1e-11, "atol": 1e-12 } }"#,
    )
}

/// A rigid body on a ball joint at the end of an arm that a drive turns.
fn spatial() -> Ready {
    parse(
        r#"{ "name": "arm", "dimension": 3, "gravity": [0, 0, -9.81], "ground": { "markers": { "O": [0, 0, 0] } },
        "bodies": [
            { "name": "arm", "type": "rigid", "mass": 1, "inertia": [0.1, 0.2, 0.15], "markers": { "O": [0, 0, 0], "P": [0.5, 0, 0.1] } },
            { "name": "top", "type": "rigid", "mass": 2, "inertia": [0.05, 0.07, 0.09], "markers": { "P": [0.1, 0.05, 0.3] },
              "initial": { "position": [0.4, -0.05, -0.2], "angular_velocity": [1, 0.5, 3] } } ],
        "joints": [ { "name": "O", "type": "revolute", "between": ["ground.O", "arm.O"] },
            { "name": "P", "type": "spherical", "between": ["arm.P", "top.P"] },
            { "name": "motor", "type": "driver", "between": ["ground.O", "arm.O"], "coordinate": "angle", "value": "2*t + t^2" } ],
        "inputs": [ { "name": "turn", "driver": "motor" } ],
        "simulation": { "t_end": 1, "rtol": 1e-11, "atol": 1e-12 } }"#,
    )
}

/// Order of the variational equations in the size of a pulse, and relative error of the frozen model half-way.
fn pulse(scene: &Ready, state: &State, horizon: f64) -> (Option<f64>, f64) {
    let settings = Settings { horizon: Some(horizon), directions: Vec::new(), ..Settings::default() };
    let found = validate(scene.system(), state, &settings).unwrap();
    (found.inputs[0].order_ltv.order, found.inputs[0].error_lti)
}

/// In the intrinsic chart, where a unit of the acceleration has no part: a missing term of the displacement or its rate
/// leaves an error that does not fall with the width of the pulse.
#[test]
fn the_model_of_a_turned_crank_follows_pulses_of_its_drive() {
    for scene in [planar(), spatial()] {
        let state = &scene.0.states_at(&[0.4]).unwrap()[0];
        let order = pulse(&scene, state, 1.0).0.unwrap();
        let [wide, narrow] = [0.1, 0.02].map(|horizon| pulse(&scene, state, horizon).1);
        println!("{}: order {order:.2}, errors {wide:.1e} and {narrow:.1e}", scene.0.name);
        assert!((order - 2.0).abs() < 0.2, "{order}");
        assert!(narrow < 0.3 * wide && narrow < 0.04, "{wide:e} {narrow:e}");
    }
}

/// The models along the motion, in one constant chart, give the change by a pulse to the error of their integration.
#[test]
fn models_in_a_constant_chart_follow_a_pulse_of_the_drive() {
    let scene = planar();
    let width = 0.2;
    let steps = 200;
    let times: Vec<f64> = (0..=2 * steps).map(|i| 0.4 + width * i as f64 / (2 * steps) as f64).collect();
    let all = scene.0.states_at(&times).unwrap();
    let pulse = Pulse { input: 0, start: 0.4, width: 2.0 * width };
    let rates = |i: usize, x: &Matrix| -> Matrix {
        let mut variation = Variation::new(scene.system(), times[i], &all[i].q, &all[i].v).unwrap();
        let model = minimal(&mut variation, &Chart::parse("bob.angle")).unwrap();
        let [u, rate, second] = pulse.jet(times[i]);
        model.built.a * x
            + model.built.input_states.a * Matrix::from_column_slice(2, 1, &[u, rate])
            + model.built.b * second
    };
    let mut x = Matrix::zeros(2, 1);
    let h = width / steps as f64;
    for i in (0..2 * steps).step_by(2) {
        let k1 = rates(i, &x);
        let k2 = rates(i + 1, &(&x + &k1 * (0.5 * h)));
        let k3 = rates(i + 1, &(&x + &k2 * (0.5 * h)));
        let k4 = rates(i + 2, &(&x + &k3 * h));
        x += (k1 + (k2 + k3) * 2.0 + k4) * (h / 6.0);
    }
    let n = all[0].v.len();
    let columns = Changes { q: Matrix::zeros(n, 1), v: Matrix::zeros(n, 1) };
    let bundle = Bundle { columns, driven: vec![1.0], pulse: Some(pulse), ..Bundle::of(&all[0]) };
    let mut end = Matrix::zeros(2, 1);
    flow(scene.system(), &bundle, &[0.4 + width], |snapshot| {
        let angle = scene.system().facts().names.v.iter().position(|name| name == "bob.angle'").unwrap();
        end = Matrix::from_column_slice(2, 1, &[snapshot.columns.q[(angle, 0)], snapshot.columns.v[(angle, 0)]]);
        true
    })
    .unwrap();
    assert!((&end - &x).amax() < 1e-6 * end.amax() && end.amax() > 0.1, "{end} {x}");
}
