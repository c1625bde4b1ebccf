//! Interpolation over a step.

use super::From;

/// The polynomial of Hairer's codes: y + theta (F0 + (1 - theta) (F1 + theta (F2 + (1 - theta) (F3 + ...)))), in which F0
/// to F2 make the cubic Hermite interpolant of order 3 and further rows are the method's own.
pub(super) struct Hermite {
    rows: Vec<Vec<f64>>,
}

impl Hermite {
    /// For states of length `len`, with `beyond` rows beyond the cubic.
    pub fn new(len: usize, beyond: usize) -> Self {
        Hermite { rows: vec![vec![0.0; len]; 3 + beyond] }
    }

    /// F0 to F2 from the states and slopes at both ends.
    pub fn prepare(&mut self, from: From, h: f64, to: &[f64], slope: &[f64]) {
        for i in 0..from.y.len() {
            let change = to[i] - from.y[i];
            self.rows[0][i] = change;
            self.rows[1][i] = h * from.slope[i] - change;
            self.rows[2][i] = 2.0 * change - h * (slope[i] + from.slope[i]);
        }
    }

    /// F3 and on, which the method fills.
    pub fn beyond(&mut self) -> &mut [Vec<f64>] {
        &mut self.rows[3..]
    }

    pub fn interpolate(&self, theta: f64, from: &[f64], out: &mut [f64]) {
        out.fill(0.0);
        for (i, row) in self.rows.iter().enumerate().rev() {
            let factor = if i % 2 == 0 { theta } else { 1.0 - theta };
            out.iter_mut().zip(row).for_each(|(out, f)| *out = (*out + f) * factor);
        }
        out.iter_mut().zip(from).for_each(|(out, y)| *out += y);
    }
}
