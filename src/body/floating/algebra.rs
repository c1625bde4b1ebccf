//! Vectors and matrices of the plane or of space alike; angular quantities have three components in both.

use std::array::from_fn;

pub(super) type Matrix<const D: usize> = [[f64; D]; D];

/// w x u
#[inline]
pub(super) fn spin<const D: usize>(w: &[f64; 3], u: &[f64; D]) -> [f64; D] {
    from_fn(|k| match D {
        2 if k == 0 => -w[2] * u[1],
        2 => w[2] * u[0],
        _ => w[(k + 1) % 3] * u[(k + 2) % 3] - w[(k + 2) % 3] * u[(k + 1) % 3],
    })
}

/// int u x v out of int u v^T.
#[inline]
pub(super) fn axial<const D: usize>(m: &Matrix<D>) -> [f64; 3] {
    match D {
        2 => [0.0, 0.0, m[0][1] - m[1][0]],
        _ => [m[1][2] - m[2][1], m[2][0] - m[0][2], m[0][1] - m[1][0]],
    }
}

#[inline]
pub(super) fn trace<const D: usize>(m: &Matrix<D>) -> f64 {
    (0..D).map(|k| m[k][k]).sum()
}

/// m w
#[inline]
pub(super) fn times<const D: usize>(m: &Matrix<D>, w: &[f64; 3]) -> [f64; 3] {
    from_fn(|i| if i < D { (0..D).map(|j| m[i][j] * w[j]).sum() } else { 0.0 })
}

#[inline]
pub(super) fn transposed<const D: usize>(m: &Matrix<D>) -> Matrix<D> {
    from_fn(|i| from_fn(|j| m[j][i]))
}

/// tr(m) w - m w: with m = int v u^T this is int u x (w x v), and with the symmetric int u u^T the moment of momentum J w.
#[inline]
pub(super) fn swung<const D: usize>(m: &Matrix<D>, w: &[f64; 3]) -> [f64; 3] {
    let (trace, along) = (trace(m), times(m, w));
    from_fn(|k| trace * w[k] - along[k])
}

/// (w x u) . (w x v) summed, out of int u v^T: w.w tr(m) - w.m w.
#[inline]
pub(super) fn whirled<const D: usize>(m: &Matrix<D>, w: &[f64; 3]) -> f64 {
    dot3(w, &swung(m, w))
}

#[inline]
pub(super) fn dot3(a: &[f64; 3], b: &[f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

#[inline]
pub(super) fn cross3(a: &[f64; 3], b: &[f64; 3]) -> [f64; 3] {
    spin(a, b)
}

#[inline]
pub(super) fn add_scaled<const N: usize>(sum: &mut [f64; N], factor: f64, vector: &[f64; N]) {
    sum.iter_mut().zip(vector).for_each(|(sum, x)| *sum += factor * x);
}

#[inline]
pub(super) fn add_matrix<const D: usize>(sum: &mut Matrix<D>, factor: f64, matrix: &Matrix<D>) {
    sum.iter_mut().zip(matrix).for_each(|(sum, row)| add_scaled(sum, factor, row));
}

/// Unit vector.
#[inline]
pub(super) fn unit(k: usize) -> [f64; 3] {
    from_fn(|i| if i == k { 1.0 } else { 0.0 })
}
