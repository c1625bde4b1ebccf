//! Rows and columns that are nearly full, such as those of a frame with many elastic coordinates.

use super::Field;
use super::matrix::SparseMatrix;

/// Entries of long rows are pivots only where all others are below this part. Unit: `[1]`. Why: they grow before their
/// turn comes, by an estimate to some tens for beams of 10,000 elements.
const LAST_CHOICE: f64 = 1e-4;

/// Columns that are eliminated last. An early pivot in a dense row fills all columns that follow; so does the column of
/// a multiplier that has only dense rows to take its pivot from.
pub(super) struct DenseRows {
    /// Factor of each row, which lowers the priority of dense rows in the choice of pivots.
    pub rank: Vec<f64>,
    pub columns: Vec<bool>,
}

impl DenseRows {
    /// `None` if there is no dense row, or so many that they would fill more than they save. Columns from `n` on are
    /// those of multipliers.
    pub fn of<T: Field>(matrix: &SparseMatrix<T>, n: usize) -> Option<DenseRows> {
        let size = matrix.size();
        let mut counts = vec![0_usize; size];
        matrix.entries().for_each(|(row, _)| counts[row] += 1);
        // Eliminated early, rows that are long beside the mean fill the factors.
        let many = (12 * matrix.values.len() / size.max(1)).max(50);
        let is_long = |row: usize| row < n && counts[row] > many;
        let mut columns: Vec<bool> = (0..size).map(is_long).collect();
        matrix.entries().filter(|&(row, col)| col >= n && is_long(row)).for_each(|(_, col)| columns[col] = true);
        let width = columns.iter().filter(|column| **column).count();
        let rank = |row: usize| if is_long(row) { LAST_CHOICE } else { 1.0 };
        let is_worth_it = width > 0 && width * width <= matrix.values.len();
        is_worth_it.then(|| DenseRows { rank: (0..size).map(rank).collect(), columns })
    }
}
