//! Basis of the directions in which a mechanism is free to move, for matrices of a few hundred rows.

use super::Dynamics;
use crate::math::kkt::Pattern;
use crate::tolerances::initial as tolerances;
use nalgebra::DMatrix;

/// Number of velocities minus number of independent rows of G, at the state whose factors are in `dynamics`.
pub fn degrees_of_freedom(dynamics: &Dynamics) -> usize {
    let left_out = dynamics.kkt.left_out();
    let is_out = |row: &usize| left_out.contains(row) || dynamics.dropped.contains(row);
    let rank = (0..dynamics.lambda.len()).filter(|row| !is_out(row)).count();
    dynamics.vdot.len().saturating_sub(rank)
}

/// Z with G Z = 0 and Z^T M Z = I at the state whose terms and factors are in `dynamics`. Its rank is found by
/// pivoting, and is at most that of the factors. `None` where a solution is not finite.
///
/// Z is the pivoted Cholesky factor of Z Z^T. Where coordinates are nearly dependent, as powers of one variable are,
/// that has few correct digits: then the factor is computed in the metric of the diagonal of M, and made orthonormal in
/// the metric of M.
pub fn free_directions(dynamics: &mut Dynamics) -> Option<DMatrix<f64>> {
    let z = factor_of_solutions(dynamics, &diagonal(dynamics))?;
    if is_identity(&reduced_mass(dynamics, &z)) {
        return Some(z);
    }
    let metric: Vec<f64> = diagonal(dynamics).iter().map(|m| if *m > 0.0 { *m } else { 1.0 }).collect();
    let places = dynamics.structure.mass.entries.iter();
    let alone: Vec<f64> = places.map(|&(i, j)| if i == j { metric[i] } else { 0.0 }).collect();
    dynamics.kkt.factor(&alone, &dynamics.terms.g).ok()?;
    let found = factor_of_solutions(dynamics, &metric);
    dynamics.kkt.factor(&dynamics.terms.mass, &dynamics.terms.g).ok()?;
    // The second iteration removes the round-off of the first.
    (0..2).try_fold(found?, |z, _| {
        let l = reduced_mass(dynamics, &z).cholesky()?;
        l.l_dirty().solve_lower_triangular(&z.transpose()).map(|rows| rows.transpose())
    })
}

fn is_identity(gram: &DMatrix<f64>) -> bool {
    let n = gram.nrows();
    let mut places = (0..n).flat_map(|i| (0..n).map(move |j| (i, j)));
    places.all(|(i, j)| (gram[(i, j)] - if i == j { 1.0 } else { 0.0 }).abs() <= tolerances::ORTHONORMAL)
}

fn diagonal(dynamics: &Dynamics) -> Vec<f64> {
    let mut diagonal = vec![0.0; dynamics.vdot.len()];
    for (&(i, j), mass) in dynamics.structure.mass.entries.iter().zip(&dynamics.terms.mass) {
        diagonal[i] += if i == j { *mass } else { 0.0 };
    }
    diagonal
}

/// The pivoted Cholesky factor of Z Z^T in the metric of the present factors, whose diagonal is `masses`.
fn factor_of_solutions(dynamics: &mut Dynamics, masses: &[f64]) -> Option<DMatrix<f64>> {
    let n = dynamics.vdot.len();
    let mut rest = DMatrix::zeros(n, n);
    for j in 0..n {
        let mut unit: Vec<f64> = (0..n).map(|i| if i == j { 1.0 } else { 0.0 }).collect();
        // Z Z^T e_j: the accelerations due to a unit force along coordinate j.
        dynamics.kkt.solve_motion(&mut unit, &mut vec![0.0; dynamics.lambda.len()]).ok()?;
        rest.column_mut(j).copy_from_slice(&unit);
    }
    // Pivots are relative to 1 / m, independent of units; a direction without mass is relative to itself.
    let whole = masses.iter().enumerate().map(|(i, m)| if *m > 0.0 { 1.0 / *m } else { rest[(i, i)] });
    let whole: Vec<f64> = whole.collect();
    let mut columns = Vec::new();
    // Where masses differ much, round-off alone can look like one more direction.
    let most = degrees_of_freedom(dynamics);
    while columns.len() < most {
        let left = |i: usize| if whole[i] > 0.0 { rest[(i, i)] / whole[i] } else { 0.0 };
        let pivot = (0..n).max_by(|&i, &j| left(i).total_cmp(&left(j))).unwrap_or(0);
        if left(pivot) < tolerances::NO_DIRECTION {
            break;
        }
        let column = rest.column(pivot) / rest[(pivot, pivot)].sqrt();
        rest -= &column * column.transpose();
        columns.push(column);
    }
    Some(DMatrix::from_fn(n, columns.len(), |i, j| columns[j][i]))
}

/// Z^T M Z
fn reduced_mass(dynamics: &Dynamics, z: &DMatrix<f64>) -> DMatrix<f64> {
    let mut momenta = DMatrix::zeros(z.nrows(), z.ncols());
    for (from, mut to) in z.column_iter().zip(momenta.column_iter_mut()) {
        let from = from.clone_owned();
        dynamics.structure.mass.multiply_symmetric(&dynamics.terms.mass, from.as_slice(), to.as_mut_slice());
    }
    z.transpose() * momenta
}

/// Z^T A Z for a sparse A.
pub fn reduce(pattern: &Pattern, values: &[f64], z: &DMatrix<f64>) -> DMatrix<f64> {
    let mut product = DMatrix::zeros(z.nrows(), z.ncols());
    for (from, mut to) in z.column_iter().zip(product.column_iter_mut()) {
        pattern.multiply(values, from.clone_owned().as_slice(), to.as_mut_slice());
    }
    z.transpose() * product
}
