//! Rows and columns that are nearly full, such as those of a frame with many elastic coordinates.

use super::Field;
use super::matrix::Matrix;
use crate::tolerances::math as tolerances;

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
    pub fn of<T: Field>(matrix: &Matrix<T>, n: usize) -> Option<DenseRows> {
        let size = matrix.size();
        let mut counts = vec![0_usize; size];
        matrix.entries().for_each(|(row, _)| counts[row] += 1);
        let many = (tolerances::LONG_ROW_OF_MEAN * matrix.values.len() / size.max(1)).max(tolerances::LONG_ROW);
        let is_long = |row: usize| row < n && counts[row] > many;
        let mut columns: Vec<bool> = (0..size).map(is_long).collect();
        matrix.entries().filter(|&(row, col)| col >= n && is_long(row)).for_each(|(_, col)| columns[col] = true);
        let width = columns.iter().filter(|column| **column).count();
        let rank = |row: usize| if is_long(row) { tolerances::LAST_CHOICE } else { 1.0 };
        let is_worth_it = width > 0 && width * width <= matrix.values.len();
        is_worth_it.then(|| DenseRows { rank: (0..size).map(rank).collect(), columns })
    }
}
