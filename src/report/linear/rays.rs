//! Lines of constant damping in the complex plane.

const RATIOS: [f64; 16] = [1e-4, 2e-4, 5e-4, 0.001, 0.002, 0.005, 0.01, 0.02, 0.05, 0.1, 0.2, 0.3, 0.5, 0.7, 0.9, 0.97];
/// Angles of the lines from the imaginary axis in the figure, degrees: the first and last, and the least between two.
const FIRST: f64 = 9.0;
const LAST: f64 = 80.0;
const BETWEEN: f64 = 14.0;

/// A ray of constant damping from the origin to the border of the axes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Ray {
    pub ratio: f64,
    pub end: (f64, f64),
}

/// Returns rays that are well apart in the figure: real parts from `low` (below zero), imaginary ones up to `high`,
/// with `pixels` per unit along both.
pub(super) fn rays(low: f64, high: f64, pixels: (f64, f64)) -> Vec<Ray> {
    if !(low < 0.0 && high > 0.0) {
        return Vec::new();
    }
    let mut found: Vec<Ray> = Vec::new();
    let mut before = FIRST - BETWEEN;
    for ratio in RATIOS {
        let x = -ratio;
        let y = (1.0 - ratio * ratio).sqrt();
        let angle = (-x * pixels.0).atan2(y * pixels.1).to_degrees();
        if (before + BETWEEN..=LAST).contains(&angle) {
            let size = (low / x).min(high / y);
            found.push(Ray { ratio, end: (size * x, size * y) });
            before = angle;
        }
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rays_end_at_the_axes_and_look_apart() {
        for (low, high) in [(-1.0, 1.0), (-2.0, 100.0), (-500.0, 300.0)] {
            let pixels = (300.0 / -low, 300.0 / high);
            let found = rays(low, high, pixels);
            assert!((1..=6).contains(&found.len()), "{low} {high} {found:?}");
            for ray in found {
                let (x, y) = ray.end;
                assert!((x - low).abs() < 1e-9 * -low || (y - high).abs() < 1e-9 * high);
                assert!((-x / x.hypot(y) - ray.ratio).abs() < 1e-12);
            }
        }
        assert!(rays(0.0, 1.0, (1.0, 1.0)).is_empty() && rays(-1.0, 0.0, (1.0, 1.0)).is_empty());
    }
}
