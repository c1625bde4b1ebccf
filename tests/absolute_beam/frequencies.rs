//! Natural frequencies against closed forms, with observed orders.

use crate::scenes::{Ready, parse};
use holonom::system::{Need, OperatingPoint, Scratch, Tangent, Terms};
use nalgebra::{Cholesky, DMatrix, SymmetricEigen};
use std::f64::consts::PI;

/// rad/s in ascending order, at the start.
pub fn frequencies(ready: &Ready) -> Vec<f64> {
    squares(ready, 0.0, ready.0.start().0).into_iter().map(|square| square.max(0.0).sqrt()).collect()
}

/// Of frequencies about a place at rest, in ascending order: (Z^T K Z) x = w^2 (Z^T M Z) x with Z a basis of the motions
/// that the joints leave, none of which lambda does work over to second order.
pub fn squares(ready: &Ready, t: f64, q: &[f64]) -> Vec<f64> {
    let system = ready.system();
    let v = &vec![0.0; ready.system().dimensions().v][..];
    let n = system.dimensions();
    let structure = system.structure();
    let mut terms = Terms::new(system);
    let mut scratch = Scratch::default();
    let mut tangent = Tangent::new(&structure.tangent);
    system.evaluate(t, q, v, Need::DYNAMICS, &mut terms, &mut scratch);
    let lambda = vec![0.0; n.lambda];
    assert!(system.tangent(OperatingPoint { t, q, v, vdot: v, lambda: &lambda }, &mut tangent, &mut scratch));
    let mut k = DMatrix::<f64>::zeros(n.v, n.v);
    let mut m = DMatrix::<f64>::zeros(n.v, n.v);
    structure.tangent.entries.iter().zip(&tangent.k).for_each(|(&place, k_ij)| k[place] += k_ij);
    structure.mass.entries.iter().zip(&terms.mass).for_each(|(&place, m_ij)| m[place] += m_ij);
    let mut g = DMatrix::<f64>::zeros(n.lambda, n.v);
    structure.g.entries.iter().zip(&terms.g).for_each(|(&place, g_ij)| g[place] += g_ij);
    let squares = SymmetricEigen::new(g.transpose() * &g);
    // Rows of G have entries of size one or none.
    let free: Vec<usize> = (0..n.v).filter(|&i| squares.eigenvalues[i] < 1e-9).collect();
    let z = squares.eigenvectors.select_columns(&free);
    let k = z.transpose() * k * &z;
    let m = z.transpose() * m * &z;
    let inverse = Cholesky::new(m).expect("a node has mass and inertia").l().try_inverse().unwrap();
    let symmetric = &inverse * k * inverse.transpose();
    let mut squares: Vec<f64> = SymmetricEigen::new(symmetric).eigenvalues.iter().copied().collect();
    squares.sort_by(f64::total_cmp);
    squares
}

/// A planar beam with length, EI and rhoA of one, held at its ends by joints of these types.
fn beam(elements: usize, rotary: f64, left: &str, right: &str) -> Ready {
    let joint = |kind: &str, end: &str| match kind {
        "" => String::new(),
        kind => format!(r#"{{ "name": "{end}", "type": "{kind}", "between": ["ground.{end}", "rod.{end}"] }}"#),
    };
    let joints =
        [joint(left, "a"), joint(right, "b")].into_iter().filter(|joint| !joint.is_empty()).collect::<Vec<_>>();
    let inertia = if rotary > 0.0 { format!(r#", "rhoI": {rotary}"#) } else { String::new() };
    parse(&format!(
        r#"{{ "name": "beam", "dimension": 2, "ground": {{ "markers": {{ "a": [0, 0], "b": [1, 0] }} }},
        "bodies": [ {{ "name": "rod", "type": "flexible_beam", "frame": "absolute", "length": 1, "elements": {elements},
            "stiffness": {{ "EA": 1e6, "EI": 1 }}, "inertia": {{ "rhoA": 1 {inertia} }}, "markers": {{ "a": [0, 0], "b": [1, 0] }} }} ],
        "joints": [ {} ] }}"#,
        joints.join(", ")
    ))
}

/// Relative errors of frequency number `which` with so many elements.
fn errors<const N: usize>(elements: [usize; N], which: usize, exact: f64, make: impl Fn(usize) -> Ready) -> [f64; N] {
    elements.map(|n| frequencies(&make(n))[which] / exact - 1.0)
}

/// The mass of half an element sits off the ends, which turn freely here, and adds the inertia rho A h^3/72 about them:
/// the square of a frequency is too low by (k h)^3/(18 k), k = n pi. Rotary inertia r of the section lowers it as Rayleigh
/// has it: w^2 = k^4/(1 + r k^2).
#[test]
fn a_pinned_beam_converges_with_the_third_power() {
    for mode in [1u8, 2, 3] {
        let k = f64::from(mode) * PI;
        let rotary = 1e-4;
        let exact = k * k / (1.0 + rotary * k * k).sqrt();
        let errors = errors([4, 8, 16, 32], usize::from(mode) - 1, exact, |n| beam(n, rotary, "revolute", "revolute"));
        println!("pinned, mode {mode}: {errors:?}");
        let expected = -k * k / 32.0f64.powi(3) / 36.0;
        assert!((errors[3] / expected - 1.0).abs() < 0.1, "{errors:?} {expected}");
    }
}

/// Fourth power between clamped ends, third where an end is free.
#[test]
fn clamped_and_free_beams_converge() {
    // Roots of cos cosh = -1 and cos cosh = 1.
    let cases = [
        ("weld", "", 0, 1.875_104_068_711_961, 3.0),
        ("weld", "", 1, 4.694_091_132_974_175, 3.0),
        ("weld", "weld", 0, 4.730_040_744_862_704, 4.0),
        ("weld", "weld", 1, 7.853_204_624_095_838, 4.0),
        ("", "", 3, 4.730_040_744_862_704, 3.0),
        ("", "", 4, 7.853_204_624_095_838, 3.0),
    ];
    for (left, right, which, k, power) in cases {
        let errors = errors([4, 8, 16, 32], which, k * k, |n| beam(n, 0.0, left, right));
        let orders: Vec<f64> = errors.windows(2).map(|pair| (pair[0] / pair[1]).abs().log2()).collect();
        println!("{left:>4} {right:>4}, k = {k:.3}: {errors:?}, orders {orders:?}");
        // The small inertia that nodes without one are given costs 5e-5 (k h)^2, which shows below 1e-5.
        assert!(orders[1] > power - 0.2 && (orders[2] > power - 0.2 || errors[3].abs() < 1e-5), "{orders:?}");
    }
}

/// A rod clamped at one end swings along itself and about itself at (2 n - 1) pi/2 c/L.
#[test]
fn axial_and_torsional_frequencies_converge_with_the_second_power() {
    let rod = |elements: usize, ea: f64, gj: f64| {
        parse(&format!(
            r#"{{ "name": "rod", "dimension": 3, "ground": {{ "markers": {{ "a": [0, 0, 0] }} }},
            "bodies": [ {{ "name": "rod", "type": "flexible_beam", "frame": "absolute", "length": 1, "elements": {elements},
                "stiffness": {{ "EA": {ea}, "EI": 1e6, "GJ": {gj} }}, "inertia": {{ "rhoA": 1, "rhoI": 0.5 }},
                "markers": {{ "a": [0, 0, 0] }} }} ],
            "joints": [ {{ "name": "a", "type": "weld", "between": ["ground.a", "rod.a"] }} ] }}"#
        ))
    };
    for (what, ea, gj) in [("axial", 1.0, 1e4), ("torsion", 1e4, 1.0)] {
        let errors = errors([4, 8, 16], 0, PI / 2.0, |n| rod(n, ea, gj));
        println!("{what}: {errors:?}");
        // w is too low by (k h)^2/24, k = pi/2.
        let expected = -(PI / 32.0).powi(2) / 24.0;
        assert!((errors[2] / expected - 1.0).abs() < 0.01, "{errors:?} {expected}");
    }
}
