//! Logarithms of rotations and of rigid motions.
//!
//! A rigid motion with rotation matrix R and displacement p is that of a screw of constant pitch and axis. Its
//! logarithm is (u, a): a the rotation vector of R and u = p - a x p/2 + c a x (a x p), with c = (1 - (|a|/2)
//! cot(|a|/2))/|a|^2 (Sonneville, Cardona and Bruls, Comput. Methods Appl. Mech. Engrg. 268 (2014) 451-474, appendix
//! A).

use super::Scalar;
use crate::math::array::{Each, from_fn};

/// The square of an angle up to which the series of the exponential map serve. Unit: `[rad^2]`. Why: the series leave
/// 1e-17 there, the closed forms beyond do not cancel much. Test: `both_forms_of_the_cotangent_agree`.
const SERIES_OF_ROTATIONS: f64 = 0.3;

/// Terms of the series of the exponential map and of the cotangent; those left out are below 1e-17 of the first.
const SERIES_TERMS: usize = 9;

/// A vector of space over any scalar.
pub type Vector<S> = [S; 3];

/// a.b
#[inline]
pub fn dot3<S: Scalar>(a: &Vector<S>, b: &Vector<S>) -> S {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// a x b
#[inline]
pub fn cross3<S: Scalar>(a: &Vector<S>, b: &Vector<S>) -> Vector<S> {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

/// Rotation vector, rad, of length pi at most, of the rotation with `r[i][j]`: component i of axis j. Smooth below pi;
/// there its sign changes.
pub fn rotation_vector<S: Scalar>(r: &[[S; 3]; 3]) -> Vector<S> {
    let (w, v) = quaternion(r);
    let square = dot3(&v, &v);
    // 2 atan(|v|/w)/|v|, by its series near zero, where |v| is not smooth.
    let factor = if square.value() < 0.01 * w.value() * w.value() {
        series(square / (w * w), |k| f64::from(1 - 2 * (k as i32 % 2)) / (2 * k + 1) as f64) * 2.0 / w
    } else {
        let size = square.sqrt();
        S::atan2(size, w) * 2.0 / size
    };
    v.each(|v| v * factor)
}

/// Scalar and vector part of the unit quaternion, the scalar part not negative. Shepperd's choice of the divisor: with
/// the largest of the four there is no cancellation.
pub fn quaternion<S: Scalar>(r: &[[S; 3]; 3]) -> (S, Vector<S>) {
    let trace = r[0][0] + r[1][1] + r[2][2];
    let skew = [r[2][1] - r[1][2], r[0][2] - r[2][0], r[1][0] - r[0][1]];
    if trace.value() > 0.0 {
        let twice = (trace + 1.0).sqrt();
        return (twice * 0.5, skew.each(|s| s / (twice * 2.0)));
    }
    let largest = (1..3).fold(0, |best, i| if r[i][i].value() > r[best][best].value() { i } else { best });
    let twice = (r[largest][largest] * 2.0 - trace + 1.0).sqrt();
    let sign = if skew[largest].value() < 0.0 { -1.0 } else { 1.0 };
    let part = |numerator: S| numerator / (twice * 2.0) * sign;
    let v = from_fn(|i| if i == largest { twice * 0.5 * sign } else { part(r[i][largest] + r[largest][i]) });
    (part(skew[largest]), v)
}

fn series<S: Scalar>(x: S, coefficient: impl Fn(usize) -> f64) -> S {
    (0..SERIES_TERMS - 1).rev().fold(S::constant(coefficient(SERIES_TERMS - 1)), |sum, k| sum * x + coefficient(k))
}

/// c = sum_k 2 zeta(2k + 2)/(2 pi)^(2k + 2) x^k with x = |a|^2; here up to k = 8.
const COTANGENT: [f64; SERIES_TERMS] = [
    1.0 / 12.0,
    1.0 / 720.0,
    1.0 / 30_240.0,
    1.0 / 1_209_600.0,
    1.0 / 47_900_160.0,
    691.0 / 1_307_674_368_000.0,
    1.0 / 74_724_249_600.0,
    3617.0 / 10_670_622_842_880_000.0,
    43_867.0 / 5_109_094_217_170_944_000.0,
];

/// c(x) with x = |a|^2; it has a pole at |a| = 2 pi.
#[inline]
pub fn cotangent<S: Scalar>(x: S) -> S {
    if x.value() < SERIES_OF_ROTATIONS {
        return series(x, |k| COTANGENT[k]);
    }
    let half = x.sqrt() * 0.5;
    (S::one() - half / half.tan()) / x
}

/// dc/dx.
#[inline]
pub fn cotangent_slope<S: Scalar>(x: S) -> S {
    if x.value() < SERIES_OF_ROTATIONS {
        // One term less than c; the missing term is below 1e-17 of the first.
        return series(x, |k| COTANGENT.get(k + 1).map_or(0.0, |c| c * (k + 1) as f64));
    }
    // With h = |a|/2 and b = h cot h: db/dx = (cot h - h/sin^2 h)/(8 h).
    let half = x.sqrt() * 0.5;
    let sine = half.sin();
    let cosine = half.cos();
    let cot = cosine / sine;
    let slope = (cot - half / (sine * sine)) / (half * 8.0);
    (-slope - (S::one() - half * cot) / x) / x
}

/// The displacement part u of the logarithm of the motion with rotation vector `a` and displacement `p`.
#[inline]
pub fn shift<S: Scalar>(a: &Vector<S>, p: &Vector<S>) -> Vector<S> {
    let turned = cross3(a, p);
    let twice = cross3(a, &turned);
    let c = cotangent(dot3(a, a));
    from_fn(|i| p[i] - turned[i] * 0.5 + c * twice[i])
}

/// Force and torque at the moved frame, in the axes of the first, that do the work n . du + m . da when the motion
/// changes: the transposed derivative of the logarithm. With W = 1 + \[a\]/2 + c \[a\]^2, du = W dr + (du/da) da and
/// da = W dw, dr and dw being the twist of the moved frame in its own axes.
pub fn pull_back<S: Scalar>(a: &Vector<S>, p: &Vector<S>, n: &Vector<S>, m: &Vector<S>) -> [Vector<S>; 2] {
    let x = dot3(a, a);
    let c = cotangent(x);
    let slope = cotangent_slope(x);
    let w = |v: &Vector<S>| -> Vector<S> {
        let turned = cross3(a, v);
        let twice = cross3(a, &turned);
        from_fn(|i| v[i] + turned[i] * 0.5 + c * twice[i])
    };
    // The gradient of n . u(a) = n . p - n . (a x p)/2 + c ((a . p)(a . n) - a^2 (n . p)).
    let ap = dot3(a, p);
    let an = dot3(a, n);
    let np = dot3(n, p);
    let along = slope * 2.0 * (ap * an - x * np) - c * 2.0 * np;
    let lever = cross3(n, p);
    let cp = c * an;
    let cn = c * ap;
    let gradient: Vector<S> = from_fn(|i| lever[i] * 0.5 + cp * p[i] + cn * n[i] + along * a[i]);
    [w(n), w(&from_fn(|i| m[i] + gradient[i]))]
}

/// [`shift`] in the plane, for a rotation by `a` about z.
#[inline]
pub fn planar_shift<S: Scalar>(a: S, p: [S; 2]) -> [S; 2] {
    let square = a * a;
    let along = S::one() - cotangent(square) * square;
    let across = a * 0.5;
    [along * p[0] + across * p[1], along * p[1] - across * p[0]]
}

/// [`pull_back`] in the plane: the components of the force, and the torque about z.
#[inline]
pub fn planar_pull_back<S: Scalar>(a: S, p: [S; 2], n: [S; 2], m: S) -> ([S; 2], S) {
    let square = a * a;
    let c = cotangent(square);
    let slope = cotangent_slope(square);
    let along = S::one() - c * square;
    let across = a * 0.5;
    let np = n[0] * p[0] + n[1] * p[1];
    let gradient = (n[0] * p[1] - n[1] * p[0]) * 0.5 - a * 2.0 * np * (c + square * slope);
    ([along * n[0] - across * n[1], along * n[1] + across * n[0]], m + gradient)
}

/// 1/(n + 1)!, indexed by n.
const INVERSE_FACTORIALS: [f64; 2 * SERIES_TERMS + 1] = {
    let mut all = [1.0; 2 * SERIES_TERMS + 1];
    let mut n = 1;
    while n < all.len() {
        all[n] = all[n - 1] / (n + 1) as f64;
        n += 1;
    }
    all
};

/// sin(a)/a, (1 - cos a)/a^2 and (a - sin a)/a^3 with x = a^2.
fn turning<S: Scalar>(x: S) -> [S; 3] {
    if x.value() < SERIES_OF_ROTATIONS {
        let sign = |k: usize| if k.is_multiple_of(2) { 1.0 } else { -1.0 };
        return from_fn(|first| series(x, |k| sign(k) * INVERSE_FACTORIALS[2 * k + first]));
    }
    let angle = x.sqrt();
    let sin = angle.sin();
    let cos = angle.cos();
    [sin / angle, (S::one() - cos) / x, (angle - sin) / (angle * x)]
}

/// The motion at part `part` of the screw with logarithm (u, a), as its axes (`axes[j]` is axis j) and its
/// shift.
pub fn exponential<S: Scalar>(u: &Vector<S>, a: &Vector<S>, part: f64) -> ([Vector<S>; 3], Vector<S>) {
    let a = a.each(|x| x * part);
    let [s1, s2, s3] = turning(dot3(&a, &a));
    let turn = |v: &Vector<S>, first: S, second: S| -> Vector<S> {
        let turned = cross3(&a, v);
        let twice = cross3(&a, &turned);
        from_fn(|i| v[i] + first * turned[i] + second * twice[i])
    };
    let axes = from_fn(|j| turn(&from_fn(|i| if i == j { S::one() } else { S::zero() }), s1, s2));
    (axes, turn(&u.each(|x| x * part), s2, s3))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::Dual;
    use std::f64::consts::PI;

    /// Logarithm and exponential undo each other for angles from nothing to nearly half a turn, at the bounds of the
    /// series too.
    #[test]
    fn the_logarithm_undoes_the_exponential() {
        for angle in [0.0, 1e-9, 1e-3, 0.19, 0.2, 0.21, 0.5, 0.547, 0.548, 1.0, 2.0, 2.1, 3.0, PI - 1e-6] {
            for axis in [[1.0, 0.0, 0.0], [0.0, 0.6, -0.8], [-0.48, 0.6, 0.64], [0.36, -0.48, -0.8]] {
                let u = [0.3, -1.0, 0.7];
                let a = axis.map(|x| x * angle);
                let (axes, p) = exponential(&u, &a, 1.0);
                let r = from_fn(|i| from_fn(|j| axes[j][i]));
                let back = rotation_vector::<f64>(&r);
                let shifted = shift(&back, &p);
                for i in 0..3 {
                    // Half a turn leaves the square root of the round-off of the trace, divided by nothing: 1e-15.
                    assert!((back[i] - a[i]).abs() < 4e-15, "{angle} {axis:?}: {back:?}");
                    assert!((shifted[i] - u[i]).abs() < 1e-14, "{angle} {axis:?}: {shifted:?}");
                }
            }
        }
    }

    /// In the plane as in space, at the bounds of the series too.
    #[test]
    fn the_plane_is_a_part_of_space() {
        let p = [0.3, -1.0];
        let n = [2.0, 0.7];
        let m = -0.4;
        for angle in [0.0, 1e-9, -1e-3, 0.2, -0.547, 0.548, 1.0, -2.1, 3.0] {
            let a = [0.0, 0.0, angle];
            let lifted = |[x, y]: [f64; 2]| [x, y, 0.0];
            let u = planar_shift(angle, p);
            let (force, torque) = planar_pull_back(angle, p, n, m);
            let [spatial_force, spatial_torque] = pull_back(&a, &lifted(p), &lifted(n), &[0.0, 0.0, m]);
            let pairs = [(lifted(u), shift(&a, &lifted(p))), (lifted(force), spatial_force)];
            for (plane, space) in pairs.into_iter().chain([([0.0, 0.0, torque], spatial_torque)]) {
                // Some roundings of numbers up to five.
                (0..3).for_each(|i| assert!((plane[i] - space[i]).abs() < 1e-14, "{angle}: {plane:?} {space:?}"));
            }
        }
    }

    /// Both forms of the exponential's factors agree where one takes over from the other, and so do their slopes.
    #[test]
    fn both_forms_of_the_turning_agree() {
        let below = turning(Dual::<f64, 1>::seeded(SERIES_OF_ROTATIONS * (1.0 - 1e-15), 0));
        let above = turning(Dual::<f64, 1>::seeded(SERIES_OF_ROTATIONS, 0));
        for (below, above) in below.iter().zip(&above) {
            assert!((below.re - above.re).abs() < 1e-15, "{below:?} {above:?}");
            // The closed form loses two digits in its slope there.
            assert!((below.eps[0] - above.eps[0]).abs() < 1e-14, "{below:?} {above:?}");
        }
    }

    /// c and dc/dx agree across the bound of the series, and dc/dx is the derivative of c.
    #[test]
    fn both_forms_of_the_cotangent_agree() {
        for x in [0.0, 0.1, SERIES_OF_ROTATIONS - 1e-12, SERIES_OF_ROTATIONS, 1.0, 5.0, 9.0] {
            let seeded = cotangent(Dual::<f64, 1>::seeded(x, 0));
            // 1 - b loses a digit and a half at the bound, its derivative the same again.
            assert!((seeded.eps[0] - cotangent_slope(x)).abs() < 1e-14, "{x}: {seeded:?}");
        }
        let below = cotangent(SERIES_OF_ROTATIONS * (1.0 - 1e-15));
        let above = cotangent(SERIES_OF_ROTATIONS * (1.0 + 1e-15));
        assert!((below - above).abs() < 1e-15);
        assert!(
            (cotangent_slope(SERIES_OF_ROTATIONS * (1.0 - 1e-15)) - cotangent_slope(SERIES_OF_ROTATIONS)).abs() < 1e-14
        );
    }
}
