//! Scaling of a pencil A - lambda E.

use super::{Matrix, dense};
use crate::tolerances;

/// Sweeps at most: a few are usual, some tens where units are far apart.
const BALANCE_SWEEPS: usize = 100;

/// D1 A D2 / time and D1 E D2, all by powers of two, so without rounding.
pub struct Balanced {
    pub a: Matrix,
    pub e: Matrix,
    /// Diagonal of D1.
    pub rows: Vec<f64>,
    /// Diagonal of D2.
    pub cols: Vec<f64>,
    /// Unit of time: lambda = time mu, with mu the eigenvalues of the balanced pencil.
    pub time: f64,
}

/// Chooses the unit of time by the sizes of all entries, then makes rows and columns of |A| / time + |E| sum to about 1
/// (as Lemonnier and Van Dooren, "Balancing regular matrix pencils", SIAM J. Matrix Anal. Appl. 28, 2006, with sums for
/// squares). Entries are at most about 1 then, so round-off is known by its size. A few n^2 operations for each sweep.
pub fn balance(a: &Matrix, e: &Matrix) -> Balanced {
    let n = a.nrows();
    let time = time(a, e);
    // First divide both by the largest entry, against overflow of sums.
    let size = dense::power_of_two((a.amax() / time).max(e.amax()).clamp(f64::MIN_POSITIVE, 1e300));
    let rows = vec![1.0 / size; n];
    let mut balanced = Balanced { a: a / time / size, e: e / size, rows, cols: vec![1.0; n], time };
    for _ in 0..BALANCE_SWEEPS {
        if !balanced.sweep() {
            break;
        }
    }
    balanced
}

/// The t with which logarithms of all |D1 A D2| / t and |D1 E D2| are nearest to zero by least squares over D1, D2 and
/// t (Curtis and Reid, "On the automatic scaling of matrices for Gaussian elimination", IMA J. Appl. Math. 10, 1972),
/// so that it does not depend on the given scaling: for M s^2 + K the mean of omega. By alternating minimization.
fn time(a: &Matrix, e: &Matrix) -> f64 {
    let n = a.nrows();
    let entries = logarithms(a, e);
    let mut cols = vec![0.0; n];
    let mut time = 0.0;
    for _ in 0..BALANCE_SWEEPS {
        let rows = means(n, entries.iter().map(|x| (x.row, x.time(time) - x.size - cols[x.col])));
        cols = means(n, entries.iter().map(|x| (x.col, x.time(time) - x.size - rows[x.row])));
        let of_a = entries.iter().filter(|x| x.is_of_a);
        let next = means(1, of_a.map(|x| (0, x.size + rows[x.row] + cols[x.col])))[0];
        let change: f64 = next - time;
        time = next;
        if change.abs() < 1e-3 {
            break;
        }
    }
    time.round().clamp(-1000.0, 1000.0).exp2()
}

struct Logarithm {
    row: usize,
    col: usize,
    size: f64,
    is_of_a: bool,
}

impl Logarithm {
    fn time(&self, time: f64) -> f64 {
        if self.is_of_a { time } else { 0.0 }
    }
}

fn logarithms(a: &Matrix, e: &Matrix) -> Vec<Logarithm> {
    [(a, true), (e, false)].into_iter().flat_map(|(matrix, is_of_a)| of_one(matrix, is_of_a)).collect()
}

fn of_one(matrix: &Matrix, is_of_a: bool) -> Vec<Logarithm> {
    let n = matrix.nrows();
    let rows: Vec<f64> = matrix.row_iter().map(|row| row.amax()).collect();
    let cols: Vec<f64> = matrix.column_iter().map(|col| col.amax()).collect();
    let places = (0..n * n).map(|k| (k % n, k / n));
    places
        .filter(|&(row, col)| matrix[(row, col)].abs() > tolerances::ROUNDED_ZERO * rows[row].min(cols[col]))
        .map(|(row, col)| Logarithm { row, col, size: matrix[(row, col)].abs().log2(), is_of_a })
        .filter(|entry| entry.size.is_finite())
        .collect()
}

/// Mean of the values of each index; zero if there are none.
fn means(n: usize, values: impl Iterator<Item = (usize, f64)>) -> Vec<f64> {
    let mut sums = vec![0.0; n];
    let mut counts = vec![0.0; n];
    for (place, value) in values {
        sums[place] += value;
        counts[place] += 1.0;
    }
    sums.iter().zip(counts).map(|(sum, count)| sum / f64::max(count, 1.0)).collect()
}

impl Balanced {
    /// Scales all rows and columns once; returns true if anything changed.
    fn sweep(&mut self) -> bool {
        let mut moved = false;
        for i in 0..self.rows.len() {
            let Some(factor) = factor(sum(self.a.row(i).iter()) + sum(self.e.row(i).iter())) else { continue };
            self.a.row_mut(i).scale_mut(factor);
            self.e.row_mut(i).scale_mut(factor);
            self.rows[i] *= factor;
            moved = true;
        }
        for j in 0..self.cols.len() {
            let Some(factor) = factor(sum(self.a.column(j).iter()) + sum(self.e.column(j).iter())) else { continue };
            self.a.column_mut(j).scale_mut(factor);
            self.e.column_mut(j).scale_mut(factor);
            self.cols[j] *= factor;
            moved = true;
        }
        moved
    }
}

fn sum<'a>(entries: impl Iterator<Item = &'a f64>) -> f64 {
    entries.map(|x| x.abs()).sum()
}

/// Factor by which a row or column is scaled; `None` if it needs no scaling.
fn factor(sum: f64) -> Option<f64> {
    let factor = (sum > 0.0 && sum.is_finite()).then(|| dense::power_of_two(sum).recip())?;
    (factor != 1.0 && factor.is_finite()).then_some(factor)
}
