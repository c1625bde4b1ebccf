//! Scaling of a pencil A - lambda E.

use super::{Matrix, dense};

/// D1 A D2 / time and D1 E D2, all by powers of two, so without rounding.
pub struct Balanced {
    pub a: Matrix,
    pub e: Matrix,
    /// D1
    pub rows: Vec<f64>,
    /// D2
    pub cols: Vec<f64>,
    /// lambda = time mu
    pub time: f64,
}

/// Of rows and columns, and of these and the time.
const SWEEPS: usize = 4;
const ROUNDS: usize = 6;

/// Makes rows and columns of |A| / time + |E| sum to about 1 and both parts equally large (as Lemonnier and Van Dooren,
/// "Balancing regular matrix pencils", SIAM J. Matrix Anal. Appl. 28, 2006, with sums for squares). Entries are at most
/// about 1 then, and what is round-off can be told by its size.
pub fn balance(a: &Matrix, e: &Matrix) -> Balanced {
    let n = a.nrows();
    let mut balanced = Balanced { a: a.clone(), e: e.clone(), rows: vec![1.0; n], cols: vec![1.0; n], time: 1.0 };
    balanced.equate(largest_inverse(&balanced.e));
    for _ in 0..ROUNDS {
        balanced.set_time();
        for _ in 0..SWEEPS {
            balanced.sweep();
        }
    }
    balanced
}

/// A power of two that takes the largest entry to about 1.
fn largest_inverse(matrix: &Matrix) -> f64 {
    let largest = matrix.amax();
    if largest > 0.0 { dense::power_of_two(largest.clamp(1e-300, 1e300)).recip() } else { 1.0 }
}

impl Balanced {
    /// Multiplies both by a number, against overflow of sums.
    fn equate(&mut self, factor: f64) {
        self.a *= factor;
        self.e *= factor;
        self.rows.iter_mut().for_each(|row| *row *= factor);
    }

    fn set_time(&mut self) {
        let (a, e) = (sum(self.a.iter()), sum(self.e.iter()));
        if a > 0.0 && e > 0.0 {
            let factor = dense::power_of_two((a / e).clamp(1e-300, 1e300));
            self.a /= factor;
            self.time *= factor;
        }
    }

    fn sweep(&mut self) {
        for i in 0..self.rows.len() {
            let Some(factor) = factor(sum(self.a.row(i).iter()) + sum(self.e.row(i).iter())) else { continue };
            self.a.row_mut(i).scale_mut(factor);
            self.e.row_mut(i).scale_mut(factor);
            self.rows[i] *= factor;
        }
        for j in 0..self.cols.len() {
            let Some(factor) = factor(sum(self.a.column(j).iter()) + sum(self.e.column(j).iter())) else { continue };
            self.a.column_mut(j).scale_mut(factor);
            self.e.column_mut(j).scale_mut(factor);
            self.cols[j] *= factor;
        }
    }
}

fn sum<'a>(entries: impl Iterator<Item = &'a f64>) -> f64 {
    entries.map(|x| x.abs()).sum()
}

/// None where there is nothing to scale.
fn factor(sum: f64) -> Option<f64> {
    let factor = (sum > 0.0 && sum.is_finite()).then(|| dense::power_of_two(sum).recip())?;
    (factor != 1.0 && factor.is_finite()).then_some(factor)
}
