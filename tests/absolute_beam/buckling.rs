//! Loads at which beams buckle: where the least square of a frequency is zero, and where no more load is borne.

use crate::absolute_beam::frequencies::squares;
use crate::absolute_beam::shooting::{Rod, moment, position, solve};
use crate::absolute_beam::statics::{balance, equilibrium};
use crate::scenes::{Ready, parse};
use nalgebra::Vector3;
use std::f64::consts::PI;

/// A cantilever of length 1 with EI = 1 about y and GJ = 1 under a force that grows with t, N.
fn cantilever(elements: usize, stiff: f64, force: [f64; 3]) -> Ready {
    let [x, y, z] = force.map(|force| format!("\"{force}*t\""));
    parse(&format!(
        r#"{{ "name": "column", "dimension": 3, "ground": {{ "markers": {{ "wall": [0, 0, 0] }} }},
        "bodies": [ {{ "name": "rod", "type": "flexible_beam", "frame": "absolute", "length": 1, "elements": {elements},
            "stiffness": {{ "EA": 1e8, "EI": [1, {stiff}], "GJ": 1 }}, "inertia": {{ "rhoA": 1, "rhoI": 1e-4 }},
            "markers": {{ "root": [0, 0, 0], "tip": [1, 0, 0] }} }} ],
        "joints": [ {{ "name": "clamp", "type": "weld", "between": ["ground.wall", "rod.root"] }} ],
        "forces": [ {{ "name": "load", "type": "applied_force", "at": "rod.tip", "force": [{x}, {y}, {z}] }} ] }}"#
    ))
}

/// Where f is zero between two places.
fn root(mut f: impl FnMut(f64) -> f64, [mut low, mut high]: [f64; 2]) -> f64 {
    let below = f(low).is_sign_positive();
    assert_ne!(below, f(high).is_sign_positive());
    for _ in 0..36 {
        let middle = 0.5 * (low + high);
        if f(middle).is_sign_positive() == below { low = middle } else { high = middle }
    }
    0.5 * (low + high)
}

/// The load along a direction at which it buckles, by shooting, and relative errors of 4, 8 and 16 elements.
fn critical(stiff: f64, direction: [f64; 3], range: [f64; 2]) -> (f64, [f64; 3]) {
    let rod = Rod::slender(1.0, [1.0, 1.0, stiff]);
    let exact = root(|load| rod.stability(direction.map(|d| d * load)), range);
    let errors = [4, 8, 16].map(|elements| {
        let least = |load: f64| {
            let rod = cantilever(elements, stiff, direction.map(|d| d * load));
            squares(&rod, 1.0, &equilibrium(&rod, 4))[0]
        };
        root(least, range) / exact - 1.0
    });
    println!("along {direction:?}, EI = 1 and {stiff}: {exact:.6}, {errors:?}");
    (exact, errors)
}

fn orders(errors: [f64; 3]) -> [f64; 2] {
    [0, 1].map(|i| (errors[i] / errors[i + 1]).log2())
}

/// pi^2/4; its shortening by P/EA leaves 2e-8.
#[test]
fn a_column() {
    let (exact, errors) = critical(50.0, [-1.0, 0.0, 0.0], [2.0, 3.0]);
    assert!((exact / (PI * PI / 4.0) - 1.0).abs() < 1e-9, "{exact}");
    assert!(orders(errors).iter().all(|order| (order - 4.0).abs() < 0.3) && errors[2] < 2e-7, "{errors:?}");
}

/// 4.0126 sqrt(EI GJ)/L^2 of a beam that does not bend before it buckles (S. P. Timoshenko, J. M. Gere, Theory of Elastic
/// Stability, 1961, section 6.3), and more of one that does. Bending and torsion together: order 2.
#[test]
fn a_cantilever_buckles_sideways() {
    for stiff in [50.0, 1e3, 1e6] {
        let (exact, errors) = critical(stiff, [0.0, 1.0, 0.0], [3.0, 5.0]);
        assert!(stiff < 1e6 || (exact - 4.0126).abs() < 1e-4, "{exact}");
        assert!(orders(errors).iter().all(|order| (order - 2.0).abs() < 0.02) && errors[2] < 1.1e-3, "{errors:?}");
    }
}

/// Half of an arch of radius 1 over 1.2 rad, hinged at its ends, from its crown: the end rises against the crown.
const HALF: f64 = 0.6;

/// The largest value between two places, by golden sections.
fn peak(mut f: impl FnMut(f64) -> f64, [mut low, mut high]: [f64; 2]) -> f64 {
    let golden = (5f64.sqrt() - 1.0) / 2.0;
    for _ in 0..36 {
        let [a, b] = [high - golden * (high - low), low + golden * (high - low)];
        if f(a) < f(b) { low = a } else { high = b }
    }
    f(0.5 * (low + high))
}

fn end_of_the_arch(rise: f64) -> [f64; 2] {
    [HALF.sin(), HALF.cos() - 1.0 + rise]
}

/// Half the load of the arch that has sunk this far, with EI = 1 and EA = 1e5.
fn borne(sunk: f64) -> f64 {
    let forces = Vector3::new(1e5, f64::INFINITY, f64::INFINITY);
    let rod = Rod { curvature: Vector3::new(0.0, 0.0, -1.0), forces, ..Rod::slender(HALF, [1.0; 3]) };
    let steps = 10;
    let found = (1..=steps).fold(Vector3::zeros(), |guess, step| {
        let [x, y] = end_of_the_arch(sunk * f64::from(step) / f64::from(steps));
        solve(guess, 1.0, |unknown| {
            let end = rod.end(&Vector3::new(unknown.x, unknown.y, 0.0), &Vector3::new(0.0, 0.0, unknown.z));
            Vector3::new(position(&end).x - x, position(&end).y - y, moment(&end).z)
        })
    });
    found.y
}

#[test]
fn an_arch_bears_no_more() {
    let exact = peak(borne, [0.05, 0.12]);
    let errors = [4, 8, 16].map(|elements| {
        let [x, y] = end_of_the_arch(0.0);
        let arch = parse(&format!(
            r#"{{ "name": "arch", "dimension": 2, "ground": {{ "markers": {{ "crown": [0, 0] }} }},
            "bodies": [ {{ "name": "rod", "type": "flexible_beam", "frame": "absolute", "length": {HALF},
                "elements": {elements}, "curvature": -1, "stiffness": {{ "EA": 1e5, "EI": 1 }},
                "inertia": {{ "rhoA": 1 }}, "markers": {{ "root": [0, 0], "tip": [{HALF}, 0] }} }} ],
            "joints": [ {{ "name": "clamp", "type": "weld", "between": ["ground.crown", "rod.root"] }},
                {{ "name": "across", "type": "equation", "expression": "rod.tip.x - {x}" }},
                {{ "name": "rises", "type": "equation", "expression": "rod.tip.y - {y} - t" }} ] }}"#
        ));
        let bears = |sunk: f64| {
            let mut q = arch.0.start().0.to_vec();
            let mut lambda = vec![0.0; arch.system().dimensions().lambda];
            (1..=10).for_each(|step| balance(arch.system(), sunk * f64::from(step) / 10.0, &mut q, &mut lambda));
            -lambda[lambda.len() - 1]
        };
        peak(bears, [0.05, 0.12]) / exact - 1.0
    });
    println!("arch: {exact:.6} {errors:?}");
    // Order 4 down to what is left of EA/h times the last change of Newton's method.
    assert!(errors[0].abs() < 2e-3 && errors[1].abs() < 1.2e-4 && errors[2].abs() < 1e-5, "{errors:?}");
}
