use super::super::{Matrix, assign};
use super::samples::Random;

fn total(cost: &Matrix, columns: &[usize]) -> f64 {
    columns.iter().enumerate().map(|(i, &j)| cost[(i, j)]).sum()
}

/// Least cost of rows from `row` on with the unused columns, by trying all.
fn least(cost: &Matrix, row: usize, used: &mut Vec<usize>) -> f64 {
    if row == cost.nrows() {
        return 0.0;
    }
    let mut best = f64::INFINITY;
    for j in 0..cost.ncols() {
        if !used.contains(&j) {
            used.push(j);
            best = best.min(cost[(row, j)] + least(cost, row + 1, used));
            used.pop();
        }
    }
    best
}

#[test]
fn no_other_is_cheaper() {
    for seed in 0..256 {
        let mut random = Random(seed);
        let rows = seed as usize % 6;
        let more = seed as usize / 6 % 3;
        // Coarse ones have many ties.
        let coarse = seed % 2 == 0;
        let cost = random.matrix(rows, rows + more).map(|x| if coarse { (3.0 * x).round() } else { x });
        let found = assign(&cost);
        let mut columns = found.clone();
        columns.sort_unstable();
        columns.dedup();
        assert_eq!(columns.len(), rows);
        assert!((total(&cost, &found) - least(&cost, 0, &mut Vec::new())).abs() < 1e-12, "{cost}");
    }
}

#[test]
fn more_rows_than_columns_leaves_some_over() {
    let cost = Matrix::from_column_slice(3, 1, &[3.0, 1.0, 2.0]);
    let found = assign(&cost);
    assert_eq!(found[1], 0);
    assert!(found[0] >= 1 && found[2] >= 1);
}

#[test]
fn what_is_not_finite_is_avoided() {
    let inf = f64::INFINITY;
    let nan = f64::NAN;
    assert_eq!(assign(&Matrix::from_row_slice(2, 2, &[1.0, nan, 1.0, 100.0])), [0, 1]);
    assert_eq!(assign(&Matrix::from_row_slice(2, 2, &[inf, 5.0, 1.0, inf])), [1, 0]);
    assert_eq!(assign(&Matrix::from_element(2, 2, inf)).len(), 2);
}

#[test]
fn three_hundred_rows() {
    let mut random = Random(1);
    let cost = random.matrix(300, 300);
    assert!(total(&cost, &assign(&cost)) < -290.0);
}
