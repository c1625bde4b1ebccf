//! Step sizes: the norm of the error and the controller.

use super::Problem;
use crate::formulation::Halt;

/// Tolerated local error of component y: atol + rtol |y|.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tolerance {
    pub rtol: f64,
    pub atol: f64,
}

impl Tolerance {
    /// Tolerated error between two states.
    #[inline]
    pub fn weight(&self, from: f64, to: f64) -> f64 {
        self.atol + self.rtol * from.abs().max(to.abs())
    }

    /// Root mean square of `change` over the tolerated errors of `y`. The last component, the work, is not tested.
    pub fn norm(&self, y: &[f64], change: &[f64]) -> f64 {
        self.norm_between(y, y, change)
    }

    /// The same over a step.
    pub fn norm_between(&self, from: &[f64], to: &[f64], change: &[f64]) -> f64 {
        let n = from.len() - 1;
        let sum: f64 = (0..n).map(|i| (change[i] / self.weight(from[i], to[i])).powi(2)).sum();
        (sum / n as f64).sqrt()
    }
}

/// h_new = h safety err^-expo err_old^beta within [shrink, grow] h. Source: Hairer, Norsett, Wanner, Solving Ordinary
/// Differential Equations I, II.4 and the codes DOPRI5 and DOP853.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Control {
    pub exponent: f64,
    pub beta: f64,
    pub shrink: f64,
    pub grow: f64,
    /// max(err, 1e-4) of the last accepted step.
    pub last: f64,
}

/// Safety factor on the optimal step.
const SAFETY: f64 = 0.9;

impl Control {
    pub fn new(order: f64, beta: f64, shrink: f64, grow: f64) -> Self {
        Control { exponent: 1.0 / order - 0.75 * beta, beta, shrink, grow, last: 1e-4 }
    }

    /// The next step after one of size `h` with error `error`; `growing` is false right after a rejection.
    pub fn accept(&mut self, h: f64, error: f64, growing: bool) -> f64 {
        let factor = SAFETY * error.max(1e-16).powf(-self.exponent) * self.last.powf(self.beta);
        self.last = error.max(1e-4);
        h * factor.clamp(self.shrink, if growing { self.grow } else { 1.0 })
    }

    /// The step to try again after the error was too large.
    pub fn reject(&self, h: f64, error: f64) -> f64 {
        h * (SAFETY * error.powf(-self.exponent)).clamp(self.shrink, 1.0)
    }
}

/// A first step from the sizes of y, y' and y''. Source: Hairer, Norsett, Wanner, II.4, with one extra evaluation.
pub fn first_step(
    problem: &mut Problem,
    tolerance: &Tolerance,
    (t, span): (f64, f64),
    y: &[f64],
    slope: &[f64],
    order: usize,
) -> Result<f64, Halt> {
    let (d0, d1) = (tolerance.norm(y, y), tolerance.norm(y, slope));
    let guess = if d0 < 1e-10 || d1 < 1e-10 { 1e-6 } else { 0.01 * d0 / d1 };
    let guess = guess.min(span);
    let ahead: Vec<f64> = y.iter().zip(slope).map(|(y, slope)| y + guess * slope).collect();
    let mut next = vec![0.0; y.len()];
    problem.derivative(t + guess, &ahead, &mut next)?;
    let change: Vec<f64> = next.iter().zip(slope).map(|(next, slope)| next - slope).collect();
    let d2 = tolerance.norm(y, &change) / guess;
    let largest = d1.max(d2);
    let step = if largest <= 1e-15 { (guess * 1e-3).max(1e-6) } else { (0.01 / largest).powf(1.0 / order as f64) };
    Ok(step.min(100.0 * guess).min(span))
}
