//! The rotation of a section by its small rotation vector, orthogonal for any size of it.

use crate::body::cross;
use crate::math::Scalar;
use crate::math::array::from_fn;

/// Cayley's rotation by a vector a: it agrees with the rotation by a to second order and is orthogonal for any a,
///
/// ```text
/// R = 1 + (a~ + a~ a~/2)/(1 + a.a/4),   T = (1 - a~/2)/(1 + a.a/4),
/// ```
///
/// with T a' the angular velocity in the turned axes.
pub struct SmallTurn<S> {
    a: [S; 3],
    /// 1/(1 + a.a/4)
    pub factor: S,
}

impl<S: Scalar> SmallTurn<S> {
    #[inline]
    pub fn of(a: [S; 3]) -> Self {
        let square = a[0] * a[0] + a[1] * a[1] + a[2] * a[2];
        SmallTurn { a, factor: (square * 0.25 + 1.0).recip() }
    }

    /// R x
    #[inline]
    pub fn turned(&self, x: &[S; 3]) -> [S; 3] {
        let once = cross(&self.a, x);
        let twice = cross(&self.a, &once);
        from_fn(|k| x[k] + (once[k] + twice[k] * 0.5) * self.factor)
    }

    /// R^T x
    #[inline]
    pub fn back(&self, x: &[S; 3]) -> [S; 3] {
        let once = cross(&self.a, x);
        let twice = cross(&self.a, &once);
        from_fn(|k| x[k] + (twice[k] * 0.5 - once[k]) * self.factor)
    }

    /// T x
    #[inline]
    pub fn rate(&self, x: &[S; 3]) -> [S; 3] {
        let across = cross(&self.a, x);
        from_fn(|k| (x[k] - across[k] * 0.5) * self.factor)
    }

    /// T^T x
    #[inline]
    pub fn felt(&self, x: &[S; 3]) -> [S; 3] {
        let across = cross(&self.a, x);
        from_fn(|k| (x[k] + across[k] * 0.5) * self.factor)
    }
}
