//! Vectors and matrices of the plane or of space; angular quantities have three components in both.

use crate::body::dot;
use crate::math::Scalar;
use crate::math::array::from_fn;
use std::ops::Mul;

pub(super) type Tensor<S, const D: usize> = [[S; D]; D];

/// w x u
#[inline]
pub(super) fn spin<S: Scalar, const D: usize>(w: &[S; 3], u: &[S; D]) -> [S; D] {
    from_fn(|k| match D {
        2 if k == 0 => -w[2] * u[1],
        2 => w[2] * u[0],
        _ => w[(k + 1) % 3] * u[(k + 2) % 3] - w[(k + 2) % 3] * u[(k + 1) % 3],
    })
}

/// int u x v from m = int u v^T.
#[inline]
pub(super) fn axial<S: Scalar, const D: usize>(m: &Tensor<S, D>) -> [S; 3] {
    match D {
        2 => [S::zero(), S::zero(), m[0][1] - m[1][0]],
        _ => [m[1][2] - m[2][1], m[2][0] - m[0][2], m[0][1] - m[1][0]],
    }
}

#[inline]
pub(super) fn trace<S: Scalar, const D: usize>(m: &Tensor<S, D>) -> S {
    (1..D).fold(m[0][0], |sum, k| sum + m[k][k])
}

/// Product m w; in the plane of the x and y components.
#[inline]
pub(super) fn times<S: Scalar, const D: usize>(m: &Tensor<S, D>, w: &[S; 3]) -> [S; 3] {
    from_fn(|i| if i < D { (1..D).fold(m[i][0] * w[0], |sum, j| sum + m[i][j] * w[j]) } else { S::zero() })
}

#[inline]
pub(super) fn transposed<S: Scalar, const D: usize>(m: &Tensor<S, D>) -> Tensor<S, D> {
    from_fn(|i| from_fn(|j| m[j][i]))
}

/// tr(m) w - m w: with m = int v u^T this is int u x (w x v), and with the symmetric int u u^T the moment of momentum J
/// w.
#[inline]
pub(super) fn swung<S: Scalar, const D: usize>(m: &Tensor<S, D>, w: &[S; 3]) -> [S; 3] {
    let trace = trace(m);
    let along = times(m, w);
    from_fn(|k| trace * w[k] - along[k])
}

/// int (w x u) . (w x v) from m = int u v^T: w.w tr(m) - w.m w.
#[inline]
pub(super) fn whirled<S: Scalar, const D: usize>(m: &Tensor<S, D>, w: &[S; 3]) -> S {
    dot(w, &swung(m, w))
}

#[inline]
pub(super) fn add_scaled<S, T, const N: usize>(sum: &mut [S; N], factor: S, vector: &[T; N])
where
    S: Scalar + Mul<T, Output = S>,
    T: Copy,
{
    sum.iter_mut().zip(vector).for_each(|(sum, &x)| *sum += factor * x);
}

#[inline]
pub(super) fn add_matrix<S, T, const D: usize>(sum: &mut Tensor<S, D>, factor: S, matrix: &Tensor<T, D>)
where
    S: Scalar + Mul<T, Output = S>,
    T: Copy,
{
    sum.iter_mut().zip(matrix).for_each(|(sum, row)| add_scaled(sum, factor, row));
}
