//! Linear models of a scene by time, and what they show.

use super::{Complex, Kind, Linear, LinearModel, Matrix};
use crate::error::Result;
use crate::prepared::Model;
use std::fmt;

impl Model {
    /// The linear model at a time of the motion, which is simulated up to there.
    ///
    /// # Errors
    /// A time outside of the run, a motion that ends before; see [`linearize`](super::linearize).
    pub fn linearize_at(&self, t: f64, linear: &Linear) -> Result<LinearModel> {
        let state = self.states_at(&[t])?.swap_remove(0);
        state.variation(self)?.linearize(linear)
    }
}

impl LinearModel {
    /// The finite eigenvalues, 1/s: physical ones first, each kind from the slowest.
    pub fn eigenvalues(&self) -> Vec<Complex<f64>> {
        let finite = self.modes.iter().filter(|mode| mode.kind != Kind::Infinite);
        finite.map(|mode| mode.clean_value()).collect()
    }
}

/// The matrices with the names of their rows, then the eigenvalues.
impl fmt::Display for LinearModel {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(out, "{} in the chart {} at t = {} s", self.method, self.chart, self.point.t)?;
        writeln!(out, "inputs: {}", self.inputs.join(", "))?;
        write_matrix(out, "A", &self.a, &self.states)?;
        write_matrix(out, "B", &self.b, &self.states)?;
        write_matrix(out, "C", &self.c, &self.outputs)?;
        write_matrix(out, "D", &self.d, &self.outputs)?;
        for mode in self.modes.iter().filter(|mode| mode.kind != Kind::Infinite) {
            let value = mode.clean_value();
            let kind = mode.kind.name();
            let frequency = mode.frequency();
            writeln!(out, "{:12.5e} {:+12.5e}i 1/s  {frequency:11.4e} Hz  {kind}", value.re, value.im)?;
        }
        Ok(())
    }
}

fn write_matrix(out: &mut fmt::Formatter<'_>, name: &str, matrix: &Matrix, rows: &[String]) -> fmt::Result {
    if matrix.is_empty() {
        return Ok(());
    }
    writeln!(out, "{name}:")?;
    let width = rows.iter().map(|row| row.chars().count()).max().unwrap_or(0);
    for (row, label) in matrix.row_iter().zip(rows) {
        write!(out, "  {label:width$}")?;
        row.iter().try_for_each(|x| write!(out, " {x:12.5e}"))?;
        writeln!(out)?;
    }
    Ok(())
}
