//! Heavy symmetric top about a fixed tip: three point masses at the corners of an equilateral triangle square to the
//! axis, held by massless rods to the tip and to each other. A rigid body in space with q' = v and a constant mass
//! matrix, which symplectic methods want.
//!
//! ```text
//! m r_i'' = (0, 0, -m g) - (G^T lambda)_i,   i = 1, 2, 3
//! 0 = (|r_i|^2 - (height^2 + radius^2))/2
//! 0 = (|r_i - r_j|^2 - 3 radius^2)/2
//! ```
//!
//! Energy, the angular momentum about the vertical and the one about the axis stay: Goldstein, Classical Mechanics,
//! 5.7.

use holonom::math::Scalar;
use holonom::system::Equations;

/// Coordinates of the three masses, m.
pub struct HeavyTop;

const MASS: f64 = 0.1;
/// Of the triangle over the tip, and from its centre to a corner.
const HEIGHT: f64 = 0.1;
const RADIUS: f64 = 0.1;
const GRAVITY: f64 = 9.81;
/// Angle of the axis against the vertical at the start, and the angular velocity about the axis, rad/s.
const LEAN: f64 = 0.5;
const SPIN: f64 = 40.0;

/// Spinning about its resting axis, which then falls, precesses and rises again.
pub fn start() -> ([f64; 9], [f64; 9]) {
    let (sin, cos) = LEAN.sin_cos();
    let mut q = [0.0; 9];
    let mut v = [0.0; 9];
    for i in 0..3 {
        let (y, x) = (i as f64 * std::f64::consts::TAU / 3.0).sin_cos();
        let turned = |x: f64, y: f64, z: f64| [x, cos * y - sin * z, sin * y + cos * z];
        q[3 * i..3 * i + 3].copy_from_slice(&turned(RADIUS * x, RADIUS * y, HEIGHT));
        v[3 * i..3 * i + 3].copy_from_slice(&turned(-SPIN * RADIUS * y, SPIN * RADIUS * x, 0.0));
    }
    (q, v)
}

/// Angular momentum about the vertical through the tip, kg m^2/s.
pub fn vertical_momentum(q: &[f64], v: &[f64]) -> f64 {
    (0..3).map(|i| MASS * (q[3 * i] * v[3 * i + 1] - q[3 * i + 1] * v[3 * i])).sum()
}

impl Equations for HeavyTop {
    fn size(&self) -> (usize, usize) {
        (9, 6)
    }

    fn mass<S: Scalar>(&self, _t: S, _q: &[S], mass: &mut [S]) {
        mass.fill(S::zero());
        (0..9).for_each(|i| mass[10 * i] = S::constant(MASS));
    }

    fn force<S: Scalar>(&self, _t: S, _q: &[S], _v: &[S], f: &mut [S]) {
        f.fill(S::zero());
        [2, 5, 8].into_iter().for_each(|i| f[i] = S::constant(-MASS * GRAVITY));
    }

    fn phi<S: Scalar>(&self, _t: S, q: &[S], phi: &mut [S]) {
        let half_square = |r: [S; 3]| (r[0].square() + r[1].square() + r[2].square()) * 0.5;
        for i in 0..3 {
            let j = (i + 1) % 3;
            let corner: [S; 3] = std::array::from_fn(|k| q[3 * i + k]);
            let side = std::array::from_fn(|k| q[3 * i + k] - q[3 * j + k]);
            phi[i] = half_square(corner) - 0.5 * (HEIGHT * HEIGHT + RADIUS * RADIUS);
            phi[3 + i] = half_square(side) - 1.5 * RADIUS * RADIUS;
        }
    }

    fn potential(&self, _t: f64, q: &[f64]) -> Option<f64> {
        Some(MASS * GRAVITY * (q[2] + q[5] + q[8]))
    }
}
