//! The least norm of transition matrices over the units of their states.

use crate::math::eigen::Matrix;

/// min over s of the largest norm of diag(1, 1/s) X diag(1, s), and of that of the start, 1. It is convex in log s:
/// Sezginer, Overton, IEEE Trans. Automatic Control 35 (1990) 229-230.
pub fn least_norm(matrices: &[Matrix], k: usize) -> f64 {
    let largest = |power: f64| {
        let norms = matrices.iter().map(|matrix| scaled(matrix, k, 10f64.powf(power)).singular_values().max());
        norms.fold(1.0, f64::max)
    };
    // Powers of ten of 1/s; (2/3)^20 of twelve decades is a hundredth of a power of e.
    let [mut low, mut high] = [-4.0, 8.0];
    for _ in 0..20 {
        let third = (high - low) / 3.0;
        if largest(low + third) < largest(high - third) { high -= third } else { low += third }
    }
    largest(0.5 * (low + high))
}

/// The first `k` states are z.
fn scaled(matrix: &Matrix, k: usize, rate: f64) -> Matrix {
    let mut scaled = matrix.clone();
    let rest = matrix.nrows() - k;
    scaled.columns_mut(k, rest).scale_mut(rate);
    scaled.rows_mut(k, rest).unscale_mut(rate);
    scaled
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The exact transition matrices of z'' = a z.
    fn at(a: f64, t: f64) -> Matrix {
        let w = f64::abs(a).sqrt();
        let (c, s) = if a < 0.0 { ((w * t).cos(), (w * t).sin()) } else { ((w * t).cosh(), (w * t).sinh()) };
        Matrix::from_row_slice(2, 2, &[c, s / w, a.signum() * s * w, c])
    }

    #[test]
    fn only_what_grows_counts() {
        let along = |a: f64| (1..=20).map(|i| at(a, 0.1 * f64::from(i))).collect::<Vec<Matrix>>();
        // An oscillation at 300 rad/s: 1; a saddle: e^(w t).
        assert!((least_norm(&along(-9e4), 1) - 1.0).abs() < 1e-2);
        assert!((least_norm(&along(9.0), 1) / f64::exp(6.0) - 1.0).abs() < 1e-2);
        // Free flight: the error that remains comes from the finite range in which s is sought.
        assert!((least_norm(&[Matrix::from_row_slice(2, 2, &[1.0, 2.0, 0.0, 1.0])], 1) - 1.0).abs() < 1e-2);
    }
}
