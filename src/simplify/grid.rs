//! Times of rows.

use crate::tolerances::SAME;

/// The number of rows without the last one, if that is between the times of rows: those from `start` on, `step` apart.
pub fn rows_on_grid(times: impl ExactSizeIterator<Item = f64>, start: f64, step: f64) -> usize {
    let count = times.len();
    let last = times.last().map_or(0.0, |end| (end - start) / step);
    if (last - last.round()).abs() > SAME { count - 1 } else { count }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_run_that_was_stopped_ends_on_a_row_that_others_have() {
        for (times, count) in [(&[0.0, 0.1, 0.15][..], 2), (&[0.0, 0.1, 0.2], 3), (&[], 0)] {
            assert_eq!(rows_on_grid(times.iter().copied(), 0.0, 0.1), count);
        }
        assert_eq!(rows_on_grid([0.5, 1.5, 2.0].into_iter(), 0.5, 1.0), 2);
    }
}
