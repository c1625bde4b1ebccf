//! The directions in which a mechanism is free to move, for matrices of a few hundred rows.

use super::Dynamics;
use crate::math::kkt::Pattern;
use nalgebra::DMatrix;

/// What is left of a column of Z Z^T, over the column without constraints, where Z is complete.
const NOTHING: f64 = 1e-10;

/// Velocities less independent rows of G, at the state whose factors `dynamics` holds.
pub fn degrees_of_freedom(dynamics: &Dynamics) -> usize {
    let left_out = dynamics.kkt.left_out();
    let is_out = |row: &usize| left_out.contains(row) || dynamics.held.contains(row);
    let rank = (0..dynamics.lambda.len()).filter(|row| !is_out(row)).count();
    dynamics.vdot.len().saturating_sub(rank)
}

/// Z with G Z = 0 and Z^T M Z = I at the state whose terms and factors `dynamics` holds: the pivoted Cholesky factor of
/// Z Z^T. Its rank shows by itself, at most that of the factors. None where a solution is not finite.
pub fn free_directions(dynamics: &mut Dynamics) -> Option<DMatrix<f64>> {
    let n = dynamics.vdot.len();
    let mut rest = DMatrix::zeros(n, n);
    for j in 0..n {
        let mut unit: Vec<f64> = (0..n).map(|i| if i == j { 1.0 } else { 0.0 }).collect();
        // Z Z^T e_j: the accelerations that a force along coordinate j alone gives.
        dynamics.kkt.solve_motion(&mut unit, &mut vec![0.0; dynamics.lambda.len()]).ok()?;
        rest.column_mut(j).copy_from_slice(&unit);
    }
    let mut free = vec![0.0; n];
    for (&(i, j), mass) in dynamics.structure.mass.entries.iter().zip(&dynamics.terms.mass) {
        free[i] += if i == j { *mass } else { 0.0 };
    }
    // Over 1 / m, so that units do not count; a direction without mass has itself for a measure.
    free.iter_mut().enumerate().for_each(|(i, m)| *m = if *m > 0.0 { 1.0 / *m } else { rest[(i, i)] });
    let mut columns = Vec::new();
    // Where masses differ much, rounding alone can look like one direction more.
    let most = degrees_of_freedom(dynamics);
    while columns.len() < most {
        let left = |i: usize| if free[i] > 0.0 { rest[(i, i)] / free[i] } else { 0.0 };
        let pivot = (0..n).max_by(|&i, &j| left(i).total_cmp(&left(j))).unwrap_or(0);
        if left(pivot) < NOTHING {
            break;
        }
        let column = rest.column(pivot) / rest[(pivot, pivot)].sqrt();
        rest -= &column * column.transpose();
        columns.push(column);
    }
    Some(DMatrix::from_fn(n, columns.len(), |i, j| columns[j][i]))
}

/// Z^T A Z for a sparse A.
pub fn reduce(pattern: &Pattern, values: &[f64], z: &DMatrix<f64>) -> DMatrix<f64> {
    let mut product = DMatrix::zeros(z.nrows(), z.ncols());
    for (from, mut to) in z.column_iter().zip(product.column_iter_mut()) {
        pattern.multiply(values, from.clone_owned().as_slice(), to.as_mut_slice());
    }
    z.transpose() * product
}
