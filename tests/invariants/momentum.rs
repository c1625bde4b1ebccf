//! Momenta of bodies from the columns of a trajectory.

use crate::scenes::Run;
use serde_json::Value;

/// Linear momentum and the one about the origin, of a row. In the plane three numbers, in space six.
pub fn momentum(scene: &Value, run: &Run, row: usize) -> Vec<f64> {
    let bodies = scene["bodies"].as_array().unwrap();
    let of = |body: &Value| if scene["dimension"] == 2 { planar(body, run, row) } else { spatial(body, run, row) };
    bodies.iter().map(of).reduce(|a, b| a.iter().zip(&b).map(|(a, b)| a + b).collect()).unwrap()
}

fn values<const N: usize>(body: &Value, run: &Run, row: usize, names: [&str; N]) -> [f64; N] {
    names.map(|name| run.column(&format!("{}.{name}", body["name"].as_str().unwrap()))[row])
}

fn planar(body: &Value, run: &Run, row: usize) -> Vec<f64> {
    let [x, y, vx, vy, turning] = values(body, run, row, ["x", "y", "x'", "y'", "angle'"]);
    let mass = body["mass"].as_f64().unwrap();
    let inertia = body["inertia"].as_f64().unwrap();
    vec![mass * vx, mass * vy, mass * (x * vy - y * vx) + inertia * turning]
}

fn spatial(body: &Value, run: &Run, row: usize) -> Vec<f64> {
    let [position, velocity] = [["x", "y", "z"], ["x'", "y'", "z'"]].map(|names| values(body, run, row, names));
    let [w, x, y, z] = values(body, run, row, ["qw", "qx", "qy", "qz"]);
    let spin = values(body, run, row, ["wx", "wy", "wz"]);
    let mass = body["mass"].as_f64().unwrap();
    let own: [f64; 3] = std::array::from_fn(|i| body["inertia"][i].as_f64().unwrap() * spin[i]);
    // p + 2 w (u x p) + 2 u x (u x p): from the body's axes to those of the world.
    let u = [x, y, z];
    let once = cross([x, y, z], own);
    let twice = cross(u, once);
    let orbital = cross(position, velocity);
    let angular = (0..3).map(|i| mass * orbital[i] + own[i] + 2.0 * (w * once[i] + twice[i]));
    velocity.iter().map(|v| mass * v).chain(angular).collect()
}

fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}
