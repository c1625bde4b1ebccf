//! Lagrange's polynomials.

/// Value at `x` of the polynomial of least degree that is one at `points[i]` and zero at the other points.
pub fn lagrange(points: &[f64], i: usize, x: f64) -> f64 {
    factors(points, i, x).map(|(above, below)| above / below).product()
}

/// The derivative of [`lagrange`] at `x`.
pub fn lagrange_rate(points: &[f64], i: usize, x: f64) -> f64 {
    let without = |k: usize| factors(points, i, x).enumerate().filter(move |(j, _)| *j != k);
    let term = |(k, (_, below)): (usize, (f64, f64))| {
        without(k).map(|(_, (above, below))| above / below).product::<f64>() / below
    };
    factors(points, i, x).enumerate().map(term).sum()
}

/// x - x_j and x_i - x_j of all other points.
fn factors(points: &[f64], i: usize, x: f64) -> impl Iterator<Item = (f64, f64)> {
    let own = points[i];
    points.iter().enumerate().filter(move |(j, _)| *j != i).map(move |(_, point)| (x - point, own - point))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A cubic and its derivative, with four points, to the rounding of some ten operations.
    #[test]
    fn polynomials_are_reproduced() {
        let points = [0.3, -0.2, -1.0, -1.1];
        let cubic = |x: f64| 1.0 + x * (2.0 - x * (0.5 + 3.0 * x));
        let rate = |x: f64| 2.0 - x * (1.0 + 9.0 * x);
        for x in [0.3, 0.0, 1.5, -1.05] {
            let sum = |weight: fn(&[f64], usize, f64) -> f64| -> f64 {
                points.iter().enumerate().map(|(i, point)| weight(&points, i, x) * cubic(*point)).sum()
            };
            let value = sum(lagrange) - cubic(x);
            let slope = sum(lagrange_rate) - rate(x);
            assert!(value.abs() < 1e-12 && slope.abs() < 1e-12, "{x}: {value:e} {slope:e}");
        }
    }
}
