//! Interpolation over a step.

use super::{Problem, Step, StepStart};
use crate::formulation::StepError;

/// (1 - 1/sqrt 5)/2, a node of Lobatto's rule: the largest error of the quartic, of theta^2 (1 - theta)^2 (theta -
/// 1/2), is the smallest here.
const NODE: f64 = 0.276_393_202_250_021;

/// Writes the cubic through both ends of a step with their slopes, whose error is O(h^4).
pub(super) fn cubic(step: Step, theta: f64, out: &mut [f64]) {
    for (i, out) in out.iter_mut().enumerate() {
        let [f0, f1, f2] = rows(step, i);
        *out = step.from.y[i] + theta * (f0 + (1.0 - theta) * (f1 + theta * f2));
    }
}

/// F0 to F2 of [`Hermite`], for component `i`.
fn rows(Step { from, to, slope }: Step, i: usize) -> [f64; 3] {
    let h = from.h;
    let change = to[i] - from.y[i];
    [change, h * from.slope[i] - change, 2.0 * change - h * (slope[i] + from.slope[i])]
}

/// The polynomial of Hairer's codes: y + theta (F0 + (1 - theta) (F1 + theta (F2 + (1 - theta) (F3 + ...)))), in which
/// F0 to F2 are the cubic Hermite interpolant and further rows are the method's own.
pub(super) struct Hermite {
    rows: Vec<Vec<f64>>,
}

impl Hermite {
    /// Memory for states of length `len`, with `beyond` rows after the cubic ones.
    pub fn new(len: usize, beyond: usize) -> Self {
        Hermite { rows: vec![vec![0.0; len]; 3 + beyond] }
    }

    /// Sets F0 to F2 from the states and slopes at both ends of a step.
    pub fn prepare(&mut self, step: Step) {
        for i in 0..step.to.len() {
            for (row, value) in self.rows.iter_mut().zip(rows(step, i)) {
                row[i] = value;
            }
        }
    }

    /// F3 and further rows, which the method fills.
    pub fn beyond(&mut self) -> &mut [Vec<f64>] {
        &mut self.rows[3..]
    }

    /// F3 from y' evaluated on the cubic itself at [`NODE`], so that the error over a step is O(h^5).
    ///
    /// Source: Enright, Jackson, Norsett, Thomsen, ACM Trans. Math. Softw. 12 (1986) 193-218. `y` and `slope` are
    /// scratch.
    pub fn raise(
        &mut self,
        problem: &mut Problem,
        step: Step,
        y: &mut [f64],
        slope: &mut [f64],
    ) -> Result<(), StepError> {
        let StepStart { t, h, .. } = step.from;
        cubic(step, NODE, y);
        problem.derivative(t + NODE * h, y, slope)?;
        let [f0, f1, f2, f3] = &mut self.rows[..] else { return Ok(()) };
        let middle = 1.0 - 2.0 * NODE;
        for i in 0..f3.len() {
            let cubic = f0[i] + middle * f1[i] + NODE * (2.0 - 3.0 * NODE) * f2[i];
            f3[i] = (h * slope[i] - cubic) / (2.0 * NODE * (1.0 - NODE) * middle);
        }
        Ok(())
    }

    /// The state at the fraction `theta` of the step, which began at `from`.
    pub fn interpolate(&self, theta: f64, from: &[f64], out: &mut [f64]) {
        out.fill(0.0);
        for (i, row) in self.rows.iter().enumerate().rev() {
            let factor = if i % 2 == 0 { theta } else { 1.0 - theta };
            out.iter_mut().zip(row).for_each(|(out, f)| *out = (*out + f) * factor);
        }
        out.iter_mut().zip(from).for_each(|(out, y)| *out += y);
    }
}
