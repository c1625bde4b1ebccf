//! Stability limits of the steps of explicit methods.

use crate::math::array::Each;

/// What a step may grow a radian, in ln |x|, at the limit of stability. Unit: `[1]`. Why: all but a few methods grow a
/// little on the imaginary axis, however short the steps. Test: `limits_are_those_of_the_books`.
const STABILITY_GROWTH: f64 = 1e-3;

/// Steps of abs(z) in which a limit is sought, before it is refined.
const STRIDE_TO_LIMIT: f64 = 0.01;

/// Stability region of a method for a mode x' = lambda x.
#[derive(Clone, Debug, PartialEq)]
pub enum Stability {
    /// A step multiplies x by the polynomial R(h lambda), given by its coefficients of 1, z, z^2 ...
    Polynomial(Vec<f64>),
    /// |h lambda| < 2, and h c/2 < 0.8 for the damping c, so that the iteration of the first half converges.
    Leapfrog,
}

impl Stability {
    /// Region of an explicit Runge-Kutta method, row i with i entries at most: R(z) = 1 + sum_k z^k b^T A^(k-1) 1.
    pub fn of<'a>(row: impl Fn(usize) -> &'a [f64], b: &[f64]) -> Self {
        let dot = |x: &[f64], y: &[f64]| x.iter().zip(y).map(|(x, y)| x * y).sum::<f64>();
        let mut powers = vec![1.0; b.len()];
        let mut coefficients = vec![1.0];
        for _ in 0..b.len() {
            coefficients.push(dot(b, &powers));
            powers = (0..b.len()).map(|i| dot(row(i), &powers)).collect();
        }
        Stability::Polynomial(coefficients)
    }

    /// The largest |h lambda| for lambda along -decay + i swing up to which no mode grows faster than the exact one.
    pub fn limit(&self, decay: f64, swing: f64) -> f64 {
        let rate = decay.hypot(swing);
        let direction = if rate > 0.0 { [-decay / rate, swing / rate] } else { [-1.0, 0.0] };
        let Stability::Polynomial(coefficients) = self else {
            // c is twice the damping rate of an oscillation, and the faster rate of an overdamped mode.
            let damping = if swing > 0.0 { 2.0 } else { 1.0 } * direction[0].abs();
            // A contraction of 0.8 comes to round-off in a hundred rounds.
            return f64::min(2.0, 2.0 * 0.8 / damping);
        };
        let holds = |size: f64| excess(coefficients, direction.each(|x| x * size)) <= STABILITY_GROWTH * size;
        let mut size = STRIDE_TO_LIMIT;
        while size < 50.0 && holds(size) {
            size += STRIDE_TO_LIMIT;
        }
        let mut low = size - STRIDE_TO_LIMIT;
        let mut high = size;
        for _ in 0..20 {
            let middle = 0.5 * (low + high);
            *(if holds(middle) { &mut low } else { &mut high }) = middle;
        }
        low
    }

    /// Exponent by which a step of size `h` makes the mode grow beyond its own growth; below zero where it does not.
    pub fn growth(&self, decay: f64, swing: f64, h: f64) -> f64 {
        match self {
            Stability::Polynomial(coefficients) => excess(coefficients, [-decay * h, swing * h]),
            Stability::Leapfrog if decay.hypot(swing) * h < self.limit(decay, swing) => 0.0,
            Stability::Leapfrog => f64::INFINITY,
        }
    }
}

/// ln |R(z)|, minus Re z where that is positive, by Horner's rule.
fn excess(coefficients: &[f64], z: [f64; 2]) -> f64 {
    let [re, im] = coefficients
        .iter()
        .rev()
        .fold([0.0, 0.0], |[re, im], coefficient| [re * z[0] - im * z[1] + coefficient, re * z[1] + im * z[0]]);
    re.hypot(im).ln() - z[0].max(0.0)
}

#[cfg(test)]
mod tests {
    use super::Stability;

    /// The classical method: 2.785 on the real axis, 2 sqrt 2 on the imaginary one (Hairer, Wanner II, IV.2).
    #[test]
    fn limits_are_those_of_the_books() {
        let rows: [&[f64]; 4] = [&[], &[0.5], &[0.0, 0.5], &[0.0, 0.0, 1.0]];
        let stability = Stability::of(|i| rows[i], &[1.0 / 6.0, 1.0 / 3.0, 1.0 / 3.0, 1.0 / 6.0]);
        let off = |limit: f64, expected: f64| (limit - expected).abs();
        assert!(off(stability.limit(1.0, 0.0), 2.7853) < 2e-3 && off(stability.limit(0.0, 1.0), 8f64.sqrt()) < 2e-2);
        let euler = Stability::of(|_| &[], &[1.0]);
        assert!(off(euler.limit(3.0, 0.0), 2.0) < 5e-3 && off(euler.limit(0.0, 5.0), 2e-3) < 1e-2);
    }
}
