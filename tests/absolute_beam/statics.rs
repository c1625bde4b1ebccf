//! Equilibria by Newton's method with the exact tangent, and linear statics against beam theory.

use crate::scenes::{Ready, parse};
use holonom::prepared::AnyMechanism;
use holonom::system::{MechanicalSystem, Need, OperatingPoint, Scratch, Tangent, Terms};
use nalgebra::{DMatrix, DVector};

/// q in equilibrium with the loads at t = 1, reached in `steps` equal steps of t, which the loads of the scene grow with.
pub fn equilibrium(ready: &Ready, steps: usize) -> Vec<f64> {
    let mut q = ready.0.start().0.to_vec();
    let mut lambda = vec![0.0; ready.system().dimensions().lambda];
    for step in 1..=steps {
        balance(ready.system(), step as f64 / steps as f64, &mut q, &mut lambda);
    }
    q
}

/// Newton's method for G^T lambda = f, phi = 0.
pub fn balance(system: &dyn MechanicalSystem, t: f64, q: &mut [f64], lambda: &mut [f64]) {
    let n = system.dimensions();
    let structure = system.structure();
    let mut terms = Terms::new(system);
    let mut scratch = Scratch::default();
    let mut tangent = Tangent::new(&structure.tangent);
    let rest = vec![0.0; n.v];
    for _ in 0..40 {
        system.evaluate(t, q, &rest, Need::DYNAMICS, &mut terms, &mut scratch);
        let at = OperatingPoint { t, q, v: &rest, vdot: &rest, lambda };
        assert!(system.tangent(at, &mut tangent, &mut scratch));
        let mut matrix = DMatrix::<f64>::zeros(n.v + n.lambda, n.v + n.lambda);
        structure.tangent.entries.iter().zip(&tangent.k).for_each(|(&place, k)| matrix[place] += k);
        for (&(row, column), g) in structure.g.entries.iter().zip(&terms.g) {
            matrix[(n.v + row, column)] += g;
            matrix[(column, n.v + row)] += g;
        }
        let mut residual = DVector::<f64>::zeros(n.v + n.lambda);
        (0..n.v).for_each(|i| residual[i] = -terms.f[i]);
        (0..n.lambda).for_each(|i| residual[n.v + i] = terms.phi[i]);
        structure.g.multiply_transposed(&terms.g, lambda, residual.rows_mut(0, n.v).as_mut_slice());
        let step = matrix.lu().solve(&-residual).expect("the equilibrium is stable");
        let mut rate = vec![0.0; n.q];
        system.rate(q, &step.as_slice()[..n.v], &mut rate);
        q.iter_mut().zip(&rate).for_each(|(q, r)| *q += r);
        system.normalize(q);
        lambda.iter_mut().zip(&step.as_slice()[n.v..]).for_each(|(l, d)| *l += d);
        if step.rows(0, n.v).amax() < 1e-10 {
            return;
        }
    }
    panic!("no equilibrium at t = {t}");
}

/// Position of a marker at q.
pub fn place(ready: &Ready, q: &[f64], marker: &str) -> [f64; 3] {
    let rest = vec![0.0; ready.system().dimensions().v];
    let mut scratch = Scratch::default();
    match &ready.0.mechanism {
        AnyMechanism::Planar(m) => {
            let r = m.frames(q, &rest, &mut scratch)[m.model().markers.find(marker).unwrap()].r;
            [r[0].x, r[1].x, 0.0]
        }
        AnyMechanism::Spatial(m) => {
            m.frames(q, &rest, &mut scratch)[m.model().markers.find(marker).unwrap()].r.map(|x| x.x)
        }
    }
}

/// A cantilever of length 2 in space with the loads at its tip, as expressions of t.
fn cantilever(elements: usize, theory: &str, force: [&str; 3], torque: [&str; 3]) -> Ready {
    let ([fx, fy, fz], [mx, my, mz]) = (force, torque);
    parse(&format!(
        r#"{{ "name": "cantilever", "dimension": 3, "ground": {{ "markers": {{ "wall": [0, 0, 0] }} }},
        "bodies": [ {{ "name": "rod", "type": "flexible_beam", "frame": "absolute", "length": 2, "elements": {elements},
            "theory": "{theory}", "stiffness": {{ "EA": 1e4, "EI": [100, 300], "GJ": 60, "GA": [4e3, 3e3] }},
            "inertia": {{ "rhoA": 1, "rhoI": 0.1 }}, "markers": {{ "root": [0, 0, 0], "tip": [2, 0, 0] }} }} ],
        "joints": [ {{ "name": "clamp", "type": "weld", "between": ["ground.wall", "rod.root"] }} ],
        "forces": [
            {{ "name": "load", "type": "applied_force", "at": "rod.tip", "force": ["{fx}", "{fy}", "{fz}"] }},
            {{ "name": "moment", "type": "applied_torque", "at": "rod.tip", "torque": ["{mx}", "{my}", "{mz}"] }} ] }}"#
    ))
}

/// Small loads: second-order terms are 1e-6 of the first.
#[test]
fn tip_deflection_is_that_of_beam_theory_with_any_number_of_elements() {
    let [x, y, z] = [2e-5 * 2.0 / 1e4, 3e-5 * 8.0 / 3.0 / 300.0, -1e-5 * 8.0 / 3.0 / 100.0];
    for (theory, shear) in [("euler_bernoulli", [0.0; 2]), ("timoshenko", [3e-5 * 2.0 / 4e3, -1e-5 * 2.0 / 3e3])] {
        for elements in [1, 2, 5] {
            let rod = cantilever(elements, theory, ["2e-5*t", "3e-5*t", "-1e-5*t"], ["0", "0", "0"]);
            let q = equilibrium(&rod, 1);
            let tip = place(&rod, &q, "rod.tip");
            for (found, expected) in [(tip[0] - 2.0, x), (tip[1], y + shear[0]), (tip[2], z + shear[1])] {
                assert!((found - expected).abs() < 1e-12, "{theory} {elements}: {found:e} {expected:e}");
            }
        }
    }
}

/// M = 2 pi EI/L rolls the beam into a circle: the element is exact in pure bending. Newton's last step is below 1e-10 rad.
#[test]
fn an_end_moment_bends_a_beam_into_a_circle() {
    for elements in [3, 4, 10] {
        let rod = cantilever(elements, "timoshenko", ["0"; 3], ["0", "0", "300*pi*t"]);
        let q = equilibrium(&rod, 10);
        let tip = place(&rod, &q, "rod.tip");
        assert!(tip.iter().all(|x| x.abs() < 1e-9), "{elements}: {tip:?}");
        let rod = cantilever(elements, "timoshenko", ["0"; 3], ["0", "-100*pi*t", "0"]);
        let q = equilibrium(&rod, 10);
        assert!(place(&rod, &q, "rod.tip").iter().all(|x| x.abs() < 1e-9));
    }
}

/// Torsion turns the tip by M L/GJ, also by more than a full turn over the length.
#[test]
fn an_end_torque_twists_a_beam_evenly() {
    for (elements, turns) in [(4, 1.25), (8, 3.0)] {
        let rod = cantilever(elements, "timoshenko", ["0"; 3], [&format!("60*{turns}*pi*t"), "0", "0"]);
        let q = equilibrium(&rod, 10);
        let twisted = |element: usize| {
            let [a, b] = [element, element + 1].map(|node| &q[7 * node + 3..7 * node + 5]);
            2.0 * (a[0] * b[1] - a[1] * b[0]).atan2(a[0] * b[0] + a[1] * b[1])
        };
        let each = std::f64::consts::TAU * turns / elements as f64;
        assert!((0..elements).all(|element| (twisted(element) - each).abs() < 1e-11), "{elements} {turns}");
    }
}

/// A beam that bends under its own weight, as a cantilever and with elements of unequal length: nodal loads of a
/// distributed load are exact.
#[test]
fn weight_bends_a_cantilever_as_distributed() {
    for (elements, marker) in [(1, 2.0), (2, 2.0), (3, 0.3), (5, 1.1)] {
        let rod = parse(&format!(
            r#"{{ "name": "weight", "dimension": 2, "gravity": [0, -1e-5], "ground": {{ "markers": {{ "wall": [0, 0] }} }},
            "bodies": [ {{ "name": "rod", "type": "flexible_beam", "frame": "absolute", "length": 2, "elements": {elements},
                "stiffness": {{ "EA": 1e4, "EI": 100 }}, "inertia": {{ "rhoA": 3 }},
                "markers": {{ "root": [0, 0], "some": [{marker}, 0], "tip": [2, 0] }} }} ],
            "joints": [ {{ "name": "clamp", "type": "weld", "between": ["ground.wall", "rod.root"] }} ] }}"#
        ));
        let q = equilibrium(&rod, 1);
        // w L^4/(8 EI) at the tip and w s^2 (6 L^2 - 4 L s + s^2)/(24 EI) at s; second-order terms are 1e-6 of these.
        let sag = |s: f64| -3e-5 * s * s * (24.0 - 8.0 * s + s * s) / 2400.0;
        for (name, s) in [("rod.tip", 2.0), ("rod.some", marker)] {
            let found = place(&rod, &q, name)[1];
            assert!((found - sag(s)).abs() < 1e-11, "{elements} {name}: {found:e} {:e}", sag(s));
        }
    }
}
