//! A controller from the file alone: time-varying LQR keeps a disturbed double pendulum on its motion.

use super::{models, times};
use crate::scenes::{Ready, parse};
use holonom::linearize::flow::{Bundle, flow};
use holonom::linearize::{Chart, Matrix, State, along};
use holonom::report::Answer;
use holonom::report::linear::{AlongAnswer, ArrayFormat};
use serde_json::Value;

/// Two rods of 1 kg and 1 m with a motor at each, which gives the torque `u`.
fn rods(u: &[f64]) -> Ready {
    let rod = |name: &str, x: f64| {
        format!(
            r#"{{ "name": "{name}", "type": "rigid", "mass": 1, "inertia": "1/12",
                  "markers": {{ "A": [-0.5, 0], "B": [0.5, 0] }}, "initial": {{ "position": [{x}, 0], "angle": 0 }} }}"#
        )
    };
    let motor = |name: &str, at: &str, u: f64| {
        format!(r#"{{ "name": "{name}", "type": "applied_torque", "at": "{at}", "torque": {u} }}"#)
    };
    parse(&format!(
        r#"{{ "name": "rods", "dimension": 2, "gravity": [0, -9.81],
             "ground": {{ "markers": {{ "O": [0, 0] }} }},
             "bodies": [{}, {}],
             "joints": [
               {{ "name": "shoulder", "type": "revolute", "between": ["ground.O", "upper.A"] }},
               {{ "name": "elbow", "type": "revolute", "between": ["upper.B", "lower.A"] }}
             ],
             "forces": [{}, {}],
             "inputs": [{{ "name": "first", "force": "m1" }}, {{ "name": "second", "force": "m2" }}],
             "simulation": {{ "t_end": 2 }} }}"#,
        rod("upper", 0.5),
        rod("lower", 1.5),
        motor("m1", "upper", u[0]),
        motor("m2", "lower", u[1]),
    ))
}

/// The arrays of the file, by key and time.
struct File(Value);

impl File {
    fn matrix(&self, key: &str, k: usize) -> Matrix {
        let rows: Vec<Vec<f64>> = serde_json::from_value(self.0[key][k].clone()).unwrap();
        Matrix::from_fn(rows.len(), rows.first().map_or(0, Vec::len), |i, j| rows[i][j])
    }

    fn vector(&self, key: &str, k: usize) -> Matrix {
        let values: Vec<f64> = serde_json::from_value(self.0[key][k].clone()).unwrap();
        Matrix::from_column_slice(values.len(), 1, &values)
    }

    fn time(&self, k: usize) -> f64 {
        self.0["t"][k].as_f64().unwrap()
    }

    fn count(&self) -> usize {
        self.0["t"].as_array().unwrap().len()
    }

    /// The gains of u = -K x held over each interval: the backward recursion of Riccati with unit weights of x.
    fn gains(&self) -> Vec<Matrix> {
        let n = self.matrix("A", 0).nrows();
        let mut p = Matrix::identity(n, n) * 100.0;
        let mut gains = Vec::new();
        for k in (0..self.count() - 1).rev() {
            let h = self.time(k + 1) - self.time(k);
            let phi = self.matrix("Phi", k);
            let gamma = (&phi * self.matrix("B", k) + self.matrix("B", k + 1)) * (0.5 * h);
            let weight = Matrix::identity(2, 2) * (1e-4 * h) + gamma.transpose() * &p * &gamma;
            let gain = weight.lu().solve(&(gamma.transpose() * &p * &phi)).unwrap();
            p = Matrix::identity(n, n) * h + phi.transpose() * &p * (&phi - &gamma * &gain);
            gains.push(gain);
        }
        gains.reverse();
        gains
    }

    /// The model's state of a measured (q, v): z = R_left dq, y = R_left (dv - T z).
    fn state(&self, k: usize, state: &State) -> Matrix {
        let change =
            |measured: &[f64], key: &str| Matrix::from_column_slice(measured.len(), 1, measured) - self.vector(key, k);
        let left = self.matrix("R_left", k);
        let z = &left * change(&state.q, "q");
        let y = left * (change(&state.v, "v") - self.matrix("T", k) * &z);
        Matrix::from_iterator(z.len() + y.len(), 1, z.iter().chain(&y).copied())
    }
}

/// Follows the motion from a state, the torques held over each interval; returns the size of the model's state at the
/// end.
fn follow(file: &File, mut state: State, torques: impl Fn(usize, &Matrix) -> Vec<f64>) -> f64 {
    for k in 0..file.count() - 1 {
        let scene = rods(&torques(k, &file.state(k, &state)));
        let bundle = Bundle::of(&state);
        flow(scene.system(), &bundle, &[file.time(k + 1)], |end| {
            state = end.motion.clone();
            true
        })
        .unwrap();
    }
    file.state(file.count() - 1, &state).norm()
}

#[test]
fn a_controller_from_the_file_keeps_a_double_pendulum_on_its_motion() {
    let scene = rods(&[0.0; 2]);
    let (q, v) = scene.0.start();
    let start = State { t: 0.0, q: q.to_vec(), v: v.to_vec() };
    let found = along(scene.system(), &start, Some(&Chart::Intrinsic), &times(&start, 2.0, 101), |_| {}).unwrap();
    let answer = AlongAnswer { prepared: &scene.0, along: &found, formats: &[ArrayFormat::Json] };
    let file = File(serde_json::to_value(answer.json()).unwrap());
    let gains = file.gains();
    // Each rod turned by 0.05 rad more: the lower one by twice that where it hangs on the upper.
    let disturbed = |angle: f64| {
        let (sin, cos) = angle.sin_cos();
        let q = vec![0.5 * cos, 0.5 * sin, angle, 1.5 * cos, 1.5 * sin, angle];
        State { t: 0.0, q, v: vec![0.0; 6] }
    };
    let free = follow(&file, disturbed(0.05), |_, _| vec![0.0; 2]);
    let kept = follow(&file, disturbed(0.05), |k, x| (-(&gains[k] * x)).as_slice().to_vec());
    assert!(free > 0.05 && kept < 1e-3 * free, "{free} {kept}");
    // What the model foretells without a controller is what happens, to the square of the disturbance.
    let small = disturbed(1e-6);
    let foretold = found.whole().unwrap() * file.state(0, &small);
    let free = follow(&file, small, |_, _| vec![0.0; 2]);
    assert!((free / foretold.norm() - 1.0).abs() < 1e-2, "{free} {foretold}");
    assert_eq!(models(scene.system(), &start, "intrinsic", (2.0, 101)).models[0].states, ["u1", "u2", "u1'", "u2'"]);
}
