//! Frequency response of a linear model.

use super::{Complex, Kind, LinearModel, Matrix};
use crate::math::eigen::ComplexMatrix;
use crate::tolerances;
use nalgebra::linalg::Hessenberg;
use rayon::prelude::*;
use std::f64::consts::TAU;

/// Least damping ratio of a peak that can be drawn, and the largest of one that points might miss. Unit: `[1]`. Why: a
/// millionth of the axis; the spacing of points.
const PEAKS: (f64, f64) = (1e-6, 0.2);

/// Returns H(i w) = (C (i w E - A)^-1 B + D) (i w)^r at frequencies in Hz, each n_y x n_u; none at a pole. Where an input
/// of the model is the derivative of order r of an input of the system, this is the response to the latter. What is below
/// round-off of the sum C x + D is zero.
///
/// Without E, A is brought to Hessenberg form once, and a frequency takes n^2 operations for each input (Laub, IEEE
/// Trans. Autom. Control 26, 1981); descriptor forms take an LU decomposition each.
pub fn frequency_response(model: &LinearModel, frequencies: &[f64]) -> Vec<Option<ComplexMatrix>> {
    let reduced = Reduced::new(model);
    frequencies.par_iter().map(|f| reduced.at(Complex::new(0.0, TAU * f))).collect()
}

/// (E, A), B and C in coordinates in which i w E - A is solved cheaply.
struct Reduced {
    a: Matrix,
    /// E; none: I.
    e: Option<Matrix>,
    b: Matrix,
    c: ComplexMatrix,
    d: ComplexMatrix,
    /// r of each input.
    orders: Vec<usize>,
    /// Norm of each row of C.
    sizes: Vec<f64>,
}

impl Reduced {
    fn new(model: &LinearModel) -> Self {
        let (a, e, b, c) = if let Some(e) = &model.e {
            // Rows of equations in different units are scaled to one size, since sizes decide on pivots.
            let scale: Vec<f64> = (0..e.nrows()).map(|i| e.row(i).amax().max(model.a.row(i).amax())).collect();
            let scaled = |matrix: &Matrix| {
                Matrix::from_fn(matrix.nrows(), matrix.ncols(), |i, j| matrix[(i, j)] / scale[i].max(f64::MIN_POSITIVE))
            };
            (scaled(&model.a), Some(scaled(e)), scaled(&model.b), model.c.clone())
        } else if model.a.nrows() < 3 {
            (model.a.clone(), None, model.b.clone(), model.c.clone())
        } else {
            let (q, h) = Hessenberg::new(model.a.clone()).unpack();
            (h, None, q.transpose() * &model.b, &model.c * q)
        };
        let sizes = model.c.row_iter().map(|row| row.norm()).collect();
        let complex = |matrix: &Matrix| matrix.map(Complex::from);
        Reduced { a, e, b, c: complex(&c), d: complex(&model.d), orders: model.orders.clone(), sizes }
    }

    fn at(&self, s: Complex<f64>) -> Option<ComplexMatrix> {
        let states = match &self.e {
            Some(e) => e.zip_map(&self.a, |e, a| s * e - a).lu().solve(&self.b.map(Complex::from)),
            None => self.hessenberg(s),
        };
        let states = states?;
        let mut response = &self.c * &states + &self.d;
        let sizes = states.column_iter().map(|x| x.norm());
        for ((mut column, x), d) in response.column_iter_mut().zip(sizes).zip(self.d.column_iter()) {
            for ((value, c), d) in column.iter_mut().zip(&self.sizes).zip(d.iter()) {
                if value.norm() < tolerances::ROUND_OFF_OF_FACTORS * (c * x + d.norm()) {
                    *value = Complex::ZERO;
                }
            }
        }
        response.column_iter_mut().zip(&self.orders).for_each(|(mut column, r)| column *= s.powu(*r as u32));
        response.iter().all(|x| x.re.is_finite() && x.im.is_finite()).then_some(response)
    }

    /// (s I - H)^-1 B by elimination with pivoting between neighbouring rows.
    fn hessenberg(&self, s: Complex<f64>) -> Option<ComplexMatrix> {
        let n = self.a.nrows();
        let mut matrix =
            ComplexMatrix::from_fn(
                n,
                n,
                |i, j| if i == j { s - self.a[(i, j)] } else { -Complex::from(self.a[(i, j)]) },
            );
        let mut x = self.b.map(Complex::from);
        for k in 0..n.saturating_sub(1) {
            if matrix[(k + 1, k)].norm() > matrix[(k, k)].norm() {
                (k..n).for_each(|j| matrix.swap((k, j), (k + 1, j)));
                x.swap_rows(k, k + 1);
            }
            if matrix[(k + 1, k)] == Complex::ZERO {
                continue;
            }
            let factor = matrix[(k + 1, k)] / matrix[(k, k)];
            (k + 1..n).for_each(|j| {
                let above = matrix[(k, j)];
                matrix[(k + 1, j)] -= factor * above
            });
            (0..x.ncols()).for_each(|j| {
                let above = x[(k, j)];
                x[(k + 1, j)] -= factor * above
            });
        }
        matrix.solve_upper_triangular_mut(&mut x).then_some(x)
    }
}

/// Range of frequencies of a response.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Resonances {
    /// Lowest frequency, Hz.
    pub from: f64,
    /// Highest frequency, Hz.
    pub to: f64,
}

/// Points across a resonance peak, in half widths from its top.
const ACROSS: [f64; 11] = [-10.0, -5.0, -2.0, -1.0, -0.5, 0.0, 0.5, 1.0, 2.0, 5.0, 10.0];

impl Resonances {
    /// A decade below the slowest physical mode to one above the fastest; 0.01 to 100 Hz where no mode has a frequency.
    pub fn around(model: &LinearModel) -> Self {
        let sizes = || model.modes.iter().filter(|mode| mode.kind == Kind::Physical).map(|mode| mode.frequency());
        let fastest = sizes().fold(0.0, f64::max);
        let slowest = sizes().filter(|f| *f > tolerances::EIGENVALUES_AGREE * fastest).fold(fastest, f64::min);
        if slowest > 0.0 && fastest.is_finite() {
            Resonances { from: slowest / 10.0, to: fastest * 10.0 }
        } else {
            Resonances { from: 0.01, to: 100.0 }
        }
    }

    /// Returns `count` frequencies in geometric progression, Hz.
    pub fn frequencies(&self, count: usize) -> Vec<f64> {
        let last = count.saturating_sub(1).max(1) as f64;
        let between = |k: usize| self.from * (self.to / self.from).powf(k as f64 / last);
        (0..count).map(|k| if k + 1 == count { self.to } else { between(k) }).collect()
    }

    /// Returns the same with more points at each lightly damped mode, so that no peak falls between two points.
    pub fn with_peaks(&self, count: usize, model: &LinearModel) -> Vec<f64> {
        let mut all = self.frequencies(count);
        for mode in model.modes.iter().filter(|mode| mode.kind == Kind::Physical && mode.value.im > 0.0) {
            let ratio = mode.damping().abs();
            if (PEAKS.0..PEAKS.1).contains(&ratio) {
                all.extend(ACROSS.iter().map(|width| (mode.value.im + width * mode.value.re.abs()) / TAU));
            }
        }
        all.retain(|f| (self.from..=self.to).contains(f));
        all.sort_by(f64::total_cmp);
        all.dedup();
        all
    }
}
