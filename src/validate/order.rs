//! Observed orders of convergence.

use crate::math::bounds;
use serde::Serialize;

/// Points that an observed order needs.
const SLOPE_POINTS: usize = 4;

/// Errors this factor above rounding are not disturbed by it. Unit: `[1]`.
const ABOVE_ROUNDING: f64 = 30.0;

/// Observed order of errors as a power of a size.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Decay {
    /// Slope of log error over log size; none where fewer than four points are above rounding.
    pub order: Option<f64>,
    /// Decades of the size over which the slope was taken.
    pub decades: f64,
    /// Range of sizes over which it was taken, largest and smallest.
    pub range: [f64; 2],
    /// True if all errors are rounding, but perhaps the few of the largest sizes, which may reach another piece of the
    /// equations: the model is exact along this direction.
    pub is_exact: bool,
}

/// Fits the slope by least squares over the points whose error is at most `largest` of their size and above the
/// rounding error `floor`; both in the unit of the errors.
pub fn decay(sizes: &[f64], errors: &[f64], largest: impl Fn(f64) -> f64, floor: f64) -> Decay {
    let points = sizes
        .iter()
        .zip(errors)
        .filter(|(size, error)| error.is_finite() && **error > ABOVE_ROUNDING * floor && **error <= largest(**size));
    let logs: Vec<(f64, f64)> = points.map(|(size, error)| (size.log10(), error.log10())).collect();
    let is_exact = is_exact(sizes, errors, ABOVE_ROUNDING * floor);
    let (low, high) = bounds(logs.iter().map(|(x, _)| *x));
    let enough = logs.len() >= SLOPE_POINTS;
    Decay {
        order: enough.then(|| slope(&logs)),
        decades: if enough { high - low } else { 0.0 },
        range: if enough { [10f64.powf(high), 10f64.powf(low)] } else { [0.0; 2] },
        is_exact,
    }
}

fn is_exact(sizes: &[f64], errors: &[f64], rounding: f64) -> bool {
    let finite = sizes.iter().zip(errors).filter(|(_, error)| error.is_finite());
    let (at, above): (Vec<_>, Vec<_>) = finite.partition(|(_, error)| **error <= rounding);
    let largest = at.iter().fold(0.0, |most: f64, (size, _)| most.max(**size));
    let few = above.len() <= at.len() && at.len() >= SLOPE_POINTS;
    above.is_empty() || few && above.iter().all(|(size, _)| **size > largest)
}

fn slope(points: &[(f64, f64)]) -> f64 {
    let n = points.len() as f64;
    let mean = |pick: fn(&(f64, f64)) -> f64| points.iter().map(pick).sum::<f64>() / n;
    let x = mean(|p| p.0);
    let y = mean(|p| p.1);
    let product: f64 = points.iter().map(|p| (p.0 - x) * (p.1 - y)).sum();
    product / points.iter().map(|p| (p.0 - x).powi(2)).sum::<f64>()
}

#[cfg(test)]
mod tests {
    use super::decay;

    #[test]
    fn slope_of_a_power_above_rounding() {
        let sizes: Vec<f64> = (0..12).map(|i| 10f64.powf(-0.5 * i as f64)).collect();
        let errors: Vec<f64> = sizes.iter().map(|x| 3.0 * x * x + 1e-9).collect();
        let found = decay(&sizes, &errors, |_| 1.0, 1e-9);
        // A rounding error of a thirtieth at the smallest point changes the slope by less than a hundredth.
        assert!((found.order.unwrap() - 2.0).abs() < 0.01, "{found:?}");
        assert!(found.decades > 2.9 && !found.is_exact);
        assert!(decay(&sizes, &[1e-10; 12], |_| 1.0, 1e-9).is_exact);
        let mut saturated = [1e-10; 12];
        saturated[0] = 0.1;
        assert!(decay(&sizes, &saturated, |_| 1.0, 1e-9).is_exact);
        saturated.swap(0, 6);
        assert!(!decay(&sizes, &saturated, |_| 1.0, 1e-9).is_exact);
        assert!(decay(&sizes[..3], &errors[..3], |_| 1.0, 1e-9).order.is_none());
    }
}
