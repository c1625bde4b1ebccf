//! Numbers and linear algebra below the mechanics.

pub(crate) mod array;
mod dual;
#[doc(hidden)]
pub mod eigen;
pub mod expression;
mod interval;
#[doc(hidden)]
pub mod kkt;
mod lagrange;
#[doc(hidden)]
pub mod memory;
#[doc(hidden)]
pub mod newton;
pub(crate) mod polyline;
mod regime;
#[doc(hidden)]
pub mod rotation;
mod scalar;
#[doc(hidden)]
pub mod screw;
mod side;
#[doc(hidden)]
pub mod signal;
mod taylor;
#[doc(hidden)]
pub mod threads;

pub use dual::Dual;
#[doc(hidden)]
pub use dual::Rate;
#[doc(hidden)]
pub use interval::Interval;
#[doc(hidden)]
pub use lagrange::{lagrange, lagrange_rate};
#[doc(hidden)]
pub use regime::{Piece, Thresholds, piece_of, piece_of_whole, whole_below};
pub use regime::{Regime, Time};
pub use scalar::Scalar;
#[doc(hidden)]
pub use scalar::Unary;
pub(crate) use scalar::operators;
#[doc(hidden)]
pub use side::Side;
pub use taylor::Taylor;

/// True if no entry is infinite or NaN, of which 0 x is NaN; in four sums so that it vectorizes.
#[doc(hidden)]
pub fn all_finite(x: &[f64]) -> bool {
    let (chunks, rest) = x.as_chunks::<4>();
    let mut sums = [0.0; 4];
    for chunk in chunks {
        (0..4).for_each(|i| sums[i] += 0.0 * chunk[i]);
    }
    sums.iter().sum::<f64>() + rest.iter().map(|x| 0.0 * x).sum::<f64>() == 0.0
}

/// x^T y of equal lengths, in four sums so that it vectorizes.
#[inline]
pub(crate) fn dot(x: &[f64], y: &[f64]) -> f64 {
    let ((xs, x_rest), (ys, y_rest)) = (x.as_chunks::<4>(), y.as_chunks::<4>());
    let rest: f64 = x_rest.iter().zip(y_rest).map(|(x, y)| x * y).sum();
    let mut sums = [0.0; 4];
    for (x, y) in xs.iter().zip(ys) {
        for k in 0..4 {
            sums[k] += x[k] * y[k];
        }
    }
    (sums[0] + sums[1]) + (sums[2] + sums[3]) + rest
}

/// Euclidean norm of x.
pub(crate) fn norm(x: &[f64]) -> f64 {
    dot(x, x).sqrt()
}

/// max |x_i|; zero for an empty slice; NaN is ignored.
#[doc(hidden)]
pub fn largest(x: &[f64]) -> f64 {
    x.iter().fold(0.0, |largest, x| f64::max(largest, x.abs()))
}

/// max |x_i / units_i|, as [`largest`].
#[doc(hidden)]
pub fn largest_in(units: &[f64], x: &[f64]) -> f64 {
    x.iter().zip(units).fold(0.0, |largest, (x, unit)| f64::max(largest, (x / unit).abs()))
}

/// The least and the largest of some values, NaN ignored; infinity and minus infinity without any.
pub(crate) fn bounds(values: impl IntoIterator<Item = f64>) -> (f64, f64) {
    values.into_iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), x| (low.min(x), high.max(x)))
}
