//! The fastest mode alone, at any size.

use super::{Sparse, SpectralMode};
use crate::math::array::Each;
use crate::math::{dot, norm};

/// The fastest modes, by power iteration of (x, v) -> (v, -Z Z^T (K x + C v)); `accelerate` returns Z Z^T f, the
/// accelerations due to a force f alone, and `None` where these are not finite.
pub fn fastest(
    k: &Sparse,
    c: &Sparse,
    mut accelerate: impl FnMut(Vec<f64>) -> Option<Vec<f64>>,
) -> Option<Vec<SpectralMode>> {
    let n = k.pattern.rows;
    // An arbitrary vector with components in all directions and no symmetry.
    let mut x = accelerate((0..n).map(|i| (1.0 + i as f64).sqrt().fract() - 0.5).collect())?;
    let mut v = vec![0.0; n];
    let mut follow = |x: &[f64], v: &[f64]| {
        let mut force = vec![0.0; n];
        k.add_product(x, -1.0, &mut force);
        c.add_product(v, -1.0, &mut force);
        accelerate(force)
    };
    // A few per cent are left where others are as fast.
    for _ in 0..60 {
        let a = follow(&x, &v)?;
        let size = norm(&a) + norm(&v);
        if size == 0.0 {
            return Some(vec![SpectralMode { decay: 0.0, swing: 0.0 }]);
        }
        (x, v) = (v, a);
        x.iter_mut().chain(&mut v).for_each(|x| *x /= size);
    }
    let a = follow(&x, &v)?;
    let jerk = follow(&v, &a)?;
    // Positions are scaled to the size of velocities.
    let unit = ((norm(&v) + norm(&a)) / (norm(&x) + norm(&v))).max(f64::MIN_POSITIVE);
    let state = |x: &[f64], v: &[f64]| x.iter().map(|x| unit * x).chain(v.iter().copied()).collect::<Vec<f64>>();
    Some(fit(&state(&x, &v), &state(&v, &a), &state(&a, &jerk)))
}

/// The roots of s^2 + p s + r with the least |y2 + p y1 + r y0|, the faster one last.
fn fit(y0: &[f64], y1: &[f64], y2: &[f64]) -> Vec<SpectralMode> {
    let [a, b, d] = [dot(y1, y1), dot(y1, y0), dot(y0, y0)];
    let [f, g] = [-dot(y1, y2), -dot(y0, y2)];
    let determinant = a * d - b * b;
    if determinant <= 1e-8 * a * d {
        return vec![SpectralMode { decay: if d > 0.0 { -b / d } else { 0.0 }, swing: 0.0 }];
    }
    let p = (f * d - b * g) / determinant;
    let r = (a * g - b * f) / determinant;
    let square = r - 0.25 * p * p;
    let root = square.abs().sqrt();
    if square > 0.0 {
        vec![SpectralMode { decay: 0.5 * p, swing: root }]
    } else {
        [-1.0, 1.0].each(|sign| SpectralMode { decay: 0.5 * p + sign * root.copysign(p), swing: 0.0 }).to_vec()
    }
}
