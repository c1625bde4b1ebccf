//! Eigenvalues of one step of an integrator about an equilibrium.

use crate::common::{fixed, run, until};
use crate::linearize::closed_forms::{crank_angle, rhombus};
use crate::linearize::systems::FourBar;
use holonom::linearize::Complex;
use nalgebra::{Matrix2, Vector2};
use std::f64::consts::FRAC_PI_2;

const SYSTEM: FourBar = FourBar { l0: std::f64::consts::SQRT_2, c1: 3.0 };

/// Crank angle and rate after a time, from others.
fn flow(method: &str, step: f64, end: f64, [p, rate]: [f64; 2]) -> Vector2<f64> {
    let (formulation, integrator) = method.split_once('+').unwrap();
    let method = holonom::simulate::Method { rtol: 1e-13, atol: 1e-13, ..fixed(formulation, integrator, "none", step) };
    let (q, v) = rhombus(p, rate);
    let run = run(&SYSTEM, &method, until(end), (&q, &v)).completed();
    let (q, v, _) = run.last();
    Vector2::new(q[1].atan2(q[0]), q[0] * v[1] - q[1] * v[0])
}

/// The matrix of the map by differences of order four: their error is 1e-12, and rounding as much.
fn map(method: &str, step: f64, end: f64) -> Matrix2<f64> {
    const SMALL: f64 = 1e-3;
    let column = |k: usize| {
        let at = |factor: f64| {
            let mut start = [FRAC_PI_2, 0.0];
            start[k] += factor * SMALL;
            flow(method, step, end, start)
        };
        (at(-2.0) - at(-1.0) * 8.0 + at(1.0) * 8.0 - at(2.0)) / (12.0 * SMALL)
    };
    Matrix2::from_columns(&[column(0), column(1)])
}

/// The eigenvalue with the positive imaginary part.
fn upper(matrix: Matrix2<f64>) -> Complex<f64> {
    matrix.complex_eigenvalues().iter().copied().max_by(|a, b| a.im.total_cmp(&b.im)).unwrap()
}

/// ln(mu)/h tends to lambda as h^p, where p is the order of the method.
#[test]
fn steps_have_the_exponentials_of_the_eigenvalues() {
    let [stiffness, damping] = crank_angle(FRAC_PI_2, 0.0, SYSTEM.c1);
    let exact = Complex::new(-damping / 2.0, (stiffness - damping * damping / 4.0).sqrt());
    for (method, order, steps) in [
        ("index1+rk4", 4.0, [0.1, 0.05]),
        ("index2+radau_iia", 5.0, [0.2, 0.1]),
        ("ggl+radau_iia", 5.0, [0.2, 0.1]),
        ("index3+generalized_alpha", 2.0, [0.02, 0.01]),
        ("ggl+generalized_alpha", 2.0, [0.02, 0.01]),
    ] {
        let off = steps.map(|h| (upper(map(method, h, h)).ln() / h - exact).norm());
        let found = (off[0] / off[1]).log2();
        println!("{method}: {off:?} order {found:.2}");
        assert!((found - order).abs() < 0.4, "{method}: {off:?} order {found:.2}");
    }
}
