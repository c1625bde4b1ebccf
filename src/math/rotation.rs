//! Rotations in space: unit quaternions p = [w, x, y, z] and their matrices.

use super::Scalar;
use super::screw::{cotangent, cross3, dot3, quaternion};
use crate::math::array::{Each, from_fn};

/// Row-major 3 x 3 matrix.
pub type Matrix3 = [[f64; 3]; 3];

/// The body's axes in the world (columns of R). A quaternion that is not of unit length is scaled, so that the stages
/// of an integrator see a rotation.
#[inline]
pub fn axes_from_quaternion<S: Scalar>(p: &[S]) -> [[S; 3]; 3] {
    let [w, x, y, z] = [p[0], p[1], p[2], p[3]];
    let s = S::constant(2.0) / (w * w + x * x + y * y + z * z);
    let xs = x * s;
    let ys = y * s;
    let zs = z * s;
    let wx = w * xs;
    let wy = w * ys;
    let wz = w * zs;
    let xx = x * xs;
    let xy = x * ys;
    let xz = x * zs;
    let yy = y * ys;
    let yz = y * zs;
    let zz = z * zs;
    let one = S::one();
    [[one - (yy + zz), xy + wz, xz - wy], [xy - wz, one - (xx + zz), yz + wx], [xz + wy, yz - wx, one - (xx + yy)]]
}

/// R with `R[i][j]`: world component i of body axis j.
pub fn matrix_from_quaternion(p: &[f64; 4]) -> Matrix3 {
    let axes = axes_from_quaternion(p);
    from_fn(|i| from_fn(|j| axes[j][i]))
}

/// p' = p (0, w) / 2 with w in the body's axes; linear in p.
#[inline]
pub fn quaternion_rate<S: Scalar>(p: &[S], w: &[S], rate: &mut [S]) {
    rate[0] = (p[1] * w[0] + p[2] * w[1] + p[3] * w[2]) * -0.5;
    rate[1] = (p[0] * w[0] + p[2] * w[2] - p[3] * w[1]) * 0.5;
    rate[2] = (p[0] * w[1] + p[3] * w[0] - p[1] * w[2]) * 0.5;
    rate[3] = (p[0] * w[2] + p[1] * w[1] - p[2] * w[0]) * 0.5;
}

/// Rotation by |a| about a: [cos |a|/2, sin(|a|/2) a/|a|].
pub fn quaternion_from_vector(a: &[f64; 3]) -> [f64; 4] {
    let angle = (a[0] * a[0] + a[1] * a[1] + a[2] * a[2]).sqrt();
    // sin(x/2)/x tends to 1/2.
    let factor = if angle < 1e-8 { 0.5 } else { (0.5 * angle).sin() / angle };
    [(0.5 * angle).cos(), factor * a[0], factor * a[1], factor * a[2]]
}

/// a' of the rotation vector `a` of p0^-1 p, with w in the axes of p: w + a x w/2 + c a x (a x w), see
/// `screw`. Smooth below 2 pi; w itself where the axis is fixed.
pub fn rotation_vector_rate(a: &[f64; 3], w: &[f64; 3]) -> [f64; 3] {
    let across = cross3(a, w);
    let twice = cross3(a, &across);
    let c = cotangent(dot3(a, a));
    from_fn(|i| w[i] + 0.5 * across[i] + c * twice[i])
}

/// Unit quaternion of the rotation with these axes, `axes[i]` being the i-th.
pub fn quaternion_from_axes(axes: &Matrix3) -> [f64; 4] {
    let (w, [x, y, z]) = quaternion(&from_fn(|i| axes.each(|axis| axis[i])));
    [w, x, y, z]
}

/// Product p r: the rotation r about axes that are rotated by p.
pub fn quaternion_product(p: &[f64; 4], r: &[f64; 4]) -> [f64; 4] {
    let mut product = [0.0; 4];
    product[0] = p[0] * r[0] - p[1] * r[1] - p[2] * r[2] - p[3] * r[3];
    for (i, j, k) in [(1, 2, 3), (2, 3, 1), (3, 1, 2)] {
        product[i] = p[0] * r[i] + p[i] * r[0] + p[j] * r[k] - p[k] * r[j];
    }
    product
}

#[cfg(test)]
mod tests {
    use super::*;

    /// p0^-1 p = exp(a) along a motion: its difference quotient, h^2 + round-off/h, against p (0, w)/2.
    #[test]
    fn rotation_vectors_move_as_their_quaternions() {
        let w = [0.3, -1.1, 0.7];
        let h = 1e-5;
        for size in [0.0, 1e-3, 0.8, 3.0, 5.0] {
            let a = [0.6, 0.0, 0.8].map(|x: f64| x * size);
            let rate = rotation_vector_rate(&a, &w);
            let at = |s: f64| quaternion_from_vector(&from_fn(|i| a[i] + s * rate[i]));
            let mut exact = [0.0; 4];
            quaternion_rate(&at(0.0), &w, &mut exact);
            for (i, exact) in exact.iter().enumerate() {
                let quotient = (at(h)[i] - at(-h)[i]) / (2.0 * h);
                assert!((quotient - exact).abs() < 1e-9, "{size} {i} {quotient} {exact}");
            }
        }
    }
}
