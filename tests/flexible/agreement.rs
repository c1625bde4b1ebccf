//! Both kinds of beams where deformations are small: they differ by the square of the load, and by the mesh.

use crate::flexible::beams::{EI, FLOATING, GA, LENGTH, Rod, THEORIES, at_rest, largest, place_outputs, scene};
use crate::flexible::brief;
use crate::scenes::{Run, parse};

const PLANE: &str = "xy";
const SPACE: &str = "xyz";

fn axes(dimension: usize) -> Vec<&'static str> {
    let all = if dimension == 2 { PLANE } else { SPACE };
    (0..all.len()).map(|i| &all[i..=i]).collect()
}

/// The tip of a cantilever under `load` N, m.
fn cantilever(dimension: usize, frame: &str, theory: &str, elements: usize, load: f64) -> Vec<f64> {
    let rod = Rod { dimension, frame, theory, elements, stiffness: 1.0, more: "" }.json();
    let (force, torque) = match dimension {
        2 => (format!("[{}, {load}]", 5.0 * load), format!("{}", -0.5 * load)),
        _ => (format!("[{}, {load}, {}]", 5.0 * load, -0.5 * load), format!("[{}, 0, 0]", 0.3 * load)),
    };
    let rest = format!(
        r#""joints": [ {{ "name": "clamp", "type": "weld", "between": ["ground.wall", "rod.root"] }} ],
        "forces": [ {{ "name": "load", "type": "applied_force", "at": "rod.tip", "force": {force} }},
            {{ "name": "moment", "type": "applied_torque", "at": "rod.tip", "torque": {torque} }} ],
        "outputs": [ {} ]"#,
        place_outputs(dimension, "rod.tip")
    );
    at_rest(&parse(&scene(dimension, &rod, &rest)), &axes(dimension))
}

fn gap(a: &[f64], b: &[f64]) -> f64 {
    largest(a.iter().zip(b).map(|(a, b)| a - b))
}

/// Linear statics are exact in both kinds with any mesh, so that the rest is of second order: half the load, a quarter.
#[test]
fn cantilevers_agree_to_the_square_of_the_load() {
    for (dimension, theory) in [2, 3].into_iter().flat_map(|d| THEORIES.map(|theory| (d, theory))) {
        for frame in FLOATING {
            let gaps = [0.5, 0.25, 0.125].map(|load| {
                let [a, b] = [frame, "absolute"].map(|frame| cantilever(dimension, frame, theory, 3, load));
                assert!(b[1] > 5e-3 * load, "{b:?}");
                gap(&a, &b)
            });
            println!("statics {dimension} {theory} {frame}: {}", brief(&gaps));
            // The tip moves by 7 mm a newton in the plane and by 16 mm in space; terms of third order leave 3.84 to 4.
            assert!(gaps[0] < 3e-4, "{gaps:?}");
            assert!(gaps.windows(2).all(|pair| (pair[0] / pair[1] - 4.0).abs() < 0.2), "{gaps:?}");
        }
    }
}

/// Static modes alone are exact under loads at markers: F L^3/(3 EI), with F L/GA of the shear.
#[test]
fn static_modes_bend_as_at_rest() {
    let load = 1e-4;
    let length = LENGTH;
    for (frame, theory) in FLOATING.into_iter().flat_map(|frame| THEORIES.map(|theory| (frame, theory))) {
        let rod = Rod { dimension: 2, frame, theory, elements: 4, stiffness: 1.0, more: r#""modes": 0,"# }.json();
        let rest = format!(
            r#""joints": [ {{ "name": "clamp", "type": "weld", "between": ["ground.wall", "rod.root"] }} ],
            "forces": [ {{ "name": "load", "type": "applied_force", "at": "rod.tip", "force": [0, {load}] }} ],
            "outputs": [ {} ]"#,
            place_outputs(2, "rod.tip")
        );
        let ready = parse(&scene(2, &rod, &rest));
        // Three coordinates of the frame, and those of the two markers that it does not stand at.
        assert_eq!(ready.system().dimensions().v, 9, "{frame}");
        let shear = if theory == "timoshenko" { load * length / GA[0] } else { 0.0 };
        let exact = load * length.powi(3) / (3.0 * EI[1]) + shear;
        let found = at_rest(&ready, &["y"])[0];
        // Rotations of 7e-7 leave their squares.
        assert!((found / exact - 1.0).abs() < 1e-9, "{frame} {theory}: {found:e} {exact:e}");
    }
}

/// An arm that swings to and fro on a drive, in space with a force at its tip across its plane; stiffness times
/// `stiffness`. Nothing starts suddenly, which would set off waves that no mesh follows.
fn arm(dimension: usize, frame: &str, theory: &str, elements: usize, stiffness: f64) -> Run {
    let rod = Rod { dimension, frame, theory, elements, stiffness, more: "" }.json();
    let force = if dimension == 2 { "[0, 0]" } else { r#"[0, 0, "2*(1 - cos(4*t))^2"]"# };
    let rest = format!(
        r#""forces": [ {{ "name": "push", "type": "applied_force", "at": "rod.tip", "force": {force} }} ],
        "joints": [ {{ "name": "o", "type": "revolute", "between": ["ground.wall", "rod.root"] }},
            {{ "name": "drive", "type": "driver", "between": ["ground.wall", "rod.root"], "coordinate": "angle",
               "value": "0.2*(1 - cos(4*t))^2" }} ],
        "outputs": [ {} ]"#,
        place_outputs(dimension, "rod.tip")
    );
    parse(&scene(dimension, &rod, &rest)).tight(1e-9, 0.8, 0.02)
}

/// A pendulum in the plane that falls from level.
fn pendulum(frame: &str, elements: usize) -> Run {
    let rod = Rod { dimension: 2, frame, theory: "timoshenko", elements, stiffness: 4.0, more: "" }.json();
    let rest = format!(
        r#""gravity": [0, -9.81],
        "joints": [ {{ "name": "o", "type": "revolute", "between": ["ground.wall", "rod.root"] }} ],
        "outputs": [ {} ]"#,
        place_outputs(2, "rod.tip")
    );
    parse(&scene(2, &rod, &rest)).tight(1e-9, 0.8, 0.02)
}

fn apart(dimension: usize, a: &Run, b: &Run) -> f64 {
    axes(dimension).iter().fold(0.0, |most: f64, axis| most.max(gap(&a.column(axis), &b.column(axis))))
}

/// Deformations fall with 1/stiffness, the difference with its square.
#[test]
fn arms_agree_to_the_square_of_the_deformation() {
    for (dimension, theory) in [(2, "timoshenko"), (2, "euler_bernoulli"), (3, "timoshenko")] {
        let stiff = [4.0, 8.0, 16.0];
        let absolute = stiff.map(|stiffness| arm(dimension, "absolute", theory, 12, stiffness));
        for frame in FLOATING {
            let floating = stiff.map(|stiffness| arm(dimension, frame, theory, 6, stiffness));
            let gaps: Vec<f64> = floating.iter().zip(&absolute).map(|(a, b)| apart(dimension, a, b)).collect();
            println!("arm {dimension} {theory} {frame}: {}", brief(&gaps));
            assert!(gaps.windows(2).all(|pair| (3.0..5.5).contains(&(pair[0] / pair[1]))), "{frame}: {gaps:?}");
        }
    }
}

/// One beam of few elements against the other of many, stiff enough for the mesh to be what is left.
#[test]
fn pendulums_agree_as_the_mesh_is_refined() {
    let fine = pendulum("chord", 16);
    // Lumped masses have a moment of inertia of their own, off by h^3 of the whole: eight times less. The others differ in
    // the high modes that the sudden fall sets off, and by the square of the deformation.
    for (frame, fall) in [("absolute", 6.0..9.0), ("tangent", 3.5..6.0), ("chord", 2.5..4.5)] {
        let gaps = [2, 4, 8].map(|n| apart(2, &pendulum(frame, n), &fine));
        println!("{frame}, 2, 4, 8 elements: {}", brief(&gaps));
        assert!(gaps.windows(2).all(|pair| fall.contains(&(pair[0] / pair[1]))), "{frame}: {gaps:?}");
    }
}
