//! Differences of what a system computes; K and C against those of the residual r = M v' + G^T lambda - f.
#![allow(dead_code)]

use holonom::system::{MechanicalSystem, Need, OperatingPoint, Scratch, Tangent, Terms};

/// r at (q, v) with v' and lambda held.
fn residual(system: &dyn MechanicalSystem, t: f64, q: &[f64], v: &[f64], vdot: &[f64], lambda: &[f64]) -> Vec<f64> {
    let mut terms = Terms::new(system);
    let mut scratch = Scratch::default();
    let structure = system.structure();
    system.evaluate(t, q, v, Need::DYNAMICS, &mut terms, &mut scratch);
    let mut r: Vec<f64> = terms.f.iter().map(|f| -f).collect();
    structure.mass.multiply_symmetric(&terms.mass, vdot, &mut r);
    structure.g.multiply_transposed(&terms.g, lambda, &mut r);
    r
}

/// sum_j |M_ij v'_j|
fn inertial(system: &dyn MechanicalSystem, t: f64, q: &[f64], v: &[f64], vdot: &[f64]) -> Vec<f64> {
    let mut terms = Terms::new(system);
    system.evaluate(t, q, v, Need::DYNAMICS, &mut terms, &mut Scratch::default());
    let [mass, vdot] = [&terms.mass[..], vdot].map(|x| x.iter().map(|x| x.abs()).collect::<Vec<_>>());
    let mut sums = vec![0.0; v.len()];
    system.structure().mass.multiply_symmetric(&mass, &vdot, &mut sums);
    sums
}

fn dense(pattern: &holonom::math::kkt::Pattern, values: &[f64], column: usize) -> Vec<f64> {
    let mut unit = vec![0.0; pattern.cols];
    unit[column] = 1.0;
    let mut product = vec![0.0; pattern.rows];
    pattern.multiply(values, &unit, &mut product);
    product
}

/// A deterministic stir of the state, so that no term is zero by accident.
pub fn stirred(values: &[f64], size: f64) -> Vec<f64> {
    values.iter().enumerate().map(|(i, x)| x + size * (1.0 + 2.3 * i as f64).sin()).collect()
}

/// The derivatives of r at a state agree with differences.
pub fn check(system: &dyn MechanicalSystem, at: OperatingPoint, what: &str) {
    let OperatingPoint { t, q, v, vdot, lambda } = at;
    let pattern = system.structure().tangent;
    let mut tangent = Tangent::new(&pattern);
    assert!(system.tangent(at, &mut tangent, &mut Scratch::default()));
    let h = 1e-6;
    let inertial = inertial(system, t, q, v, vdot);
    for j in 0..v.len() {
        let mut direction = vec![0.0; v.len()];
        direction[j] = 1.0;
        let mut rate = vec![0.0; q.len()];
        system.rate(q, &direction, &mut rate);
        let along = |s: f64| -> Vec<f64> { q.iter().zip(&rate).map(|(q, r)| q + s * r).collect() };
        let faster = |s: f64| -> Vec<f64> { v.iter().zip(&direction).map(|(v, d)| v + s * d).collect() };
        let r = |q: &[f64], v: &[f64]| residual(system, t, q, v, vdot, lambda);
        let k = (r(&along(h), v), r(&along(-h), v));
        let c = (r(q, &faster(h)), r(q, &faster(-h)));
        for (name, values, (plus, minus)) in [("K", &tangent.k, k), ("C", &tangent.c, c)] {
            let exact = dense(&pattern, values, j);
            // Differences with h = 1e-6 lose ten digits of the largest force, reactions and what M v' is summed of included.
            let scale = plus.iter().chain(&exact).chain(lambda).chain(&inertial).fold(1.0f64, |s, x| s.max(x.abs()));
            for (i, exact) in exact.iter().enumerate() {
                let difference = (plus[i] - minus[i]) / (2.0 * h);
                let error = (difference - exact).abs();
                assert!(error < 3e-8 * scale, "{what} {name}[{i},{j}]: {exact} against {difference}");
            }
        }
    }
}

/// q moved by `s` along the velocity direction v: one step of RK4 for q' = N(q) v, exact to s^5.
pub fn moved(system: &dyn MechanicalSystem, q: &[f64], v: &[f64], s: f64) -> Vec<f64> {
    let rate = |q: &[f64]| {
        let mut rate = vec![0.0; q.len()];
        system.rate(q, v, &mut rate);
        rate
    };
    let ahead = |k: &[f64], h: f64| -> Vec<f64> { q.iter().zip(k).map(|(q, k)| q + h * k).collect() };
    let k1 = rate(q);
    let k2 = rate(&ahead(&k1, 0.5 * s));
    let k3 = rate(&ahead(&k2, 0.5 * s));
    let k4 = rate(&ahead(&k3, s));
    let mean: Vec<f64> = (0..q.len()).map(|i| (k1[i] + 2.0 * (k2[i] + k3[i]) + k4[i]) / 6.0).collect();
    let mut q = ahead(&mean, s);
    system.normalize(&mut q);
    q
}

/// d f/ds at zero by central differences of order four.
pub fn slope(f: impl Fn(f64) -> Vec<f64>) -> Vec<f64> {
    const H: f64 = 1e-4;
    let [a, b, c, d] = [-2.0, -1.0, 1.0, 2.0].map(|i| f(i * H));
    (0..a.len()).map(|i| (a[i] - 8.0 * b[i] + 8.0 * c[i] - d[i]) / (12.0 * H)).collect()
}
