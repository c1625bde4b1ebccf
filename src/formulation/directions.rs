//! Basis of the directions in which a mechanism is free to move, for matrices of a few hundred rows.

use super::Dynamics;
use super::linearized::write_diagonal;
use crate::math::dot;
use crate::math::kkt::Pattern;
use crate::system::Dimensions;
use crate::tolerances;
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
    let z = any_directions(dynamics)?;
    Some(states_last(z, dynamics.system.dimensions()))
}

/// States have no constraints and a mass of one: their directions are unit vectors.
fn states_last(mut z: DMatrix<f64>, Dimensions { v, states, .. }: Dimensions) -> DMatrix<f64> {
    if states > 0 {
        let moves = |j: &usize| z.view((v - states, *j), (states, 1)).amax() < 0.5;
        let moving: Vec<usize> = (0..z.ncols()).filter(moves).collect();
        z = z.select_columns(&moving).resize_horizontally(moving.len() + states, 0.0);
        z.view_mut((v - states, moving.len()), (states, states)).fill_with_identity();
    }
    z
}

fn any_directions(dynamics: &mut Dynamics) -> Option<DMatrix<f64>> {
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
    places.all(|(i, j)| (gram[(i, j)] - if i == j { 1.0 } else { 0.0 }).abs() <= tolerances::SIX_DIGITS)
}

fn diagonal(dynamics: &Dynamics) -> Vec<f64> {
    let mut diagonal = vec![0.0; dynamics.vdot.len()];
    write_diagonal(&dynamics.structure.mass, &dynamics.terms.mass, &mut diagonal);
    diagonal
}

/// The pivoted Cholesky factor of Z Z^T in the metric of the present factors, whose diagonal is `masses`.
fn factor_of_solutions(dynamics: &mut Dynamics, masses: &[f64]) -> Option<DMatrix<f64>> {
    let n = masses.len();
    // Where masses differ much, round-off alone can look like one more direction.
    let most = degrees_of_freedom(dynamics);
    let mut rest = Rest { whole: vec![0.0; n], columns: Vec::with_capacity(most * n), dynamics };
    for (i, &mass) in masses.iter().enumerate() {
        rest.whole[i] = if mass > 0.0 { 1.0 / mass } else { rest.column(i)?[i].max(0.0) };
    }
    for _ in 0..most {
        let mut pivot = rest.probed()?;
        let mut column = rest.column(pivot)?;
        if rest.is_round_off(column[pivot], pivot) {
            pivot = rest.largest()?;
            column = rest.column(pivot)?;
        }
        if rest.is_round_off(column[pivot], pivot) {
            break;
        }
        let length = column[pivot].sqrt();
        rest.columns.extend(column.iter().map(|x| x / length));
    }
    let columns = rest.columns;
    Some(DMatrix::from_vec(n, columns.len() / n.max(1), columns))
}

/// Z Z^T less the columns of its factor that are found.
struct Rest<'d, 'a> {
    dynamics: &'d mut Dynamics<'a>,
    /// Pivots are relative to 1 / m, independent of units; a direction without mass is relative to itself.
    whole: Vec<f64>,
    columns: Vec<f64>,
}

impl Rest<'_, '_> {
    /// Its product with forces: the accelerations that they cause, but along the columns.
    fn times(&mut self, mut forces: Vec<f64>) -> Option<Vec<f64>> {
        let columns = self.columns.chunks_exact(forces.len().max(1));
        let parts: Vec<f64> = columns.clone().map(|column| dot(column, &forces)).collect();
        self.dynamics.kkt.solve_motion(&mut forces, &mut vec![0.0; self.dynamics.lambda.len()]).ok()?;
        for (column, part) in columns.zip(parts) {
            forces.iter_mut().zip(column).for_each(|(x, z)| *x -= part * z);
        }
        Some(forces)
    }

    fn column(&mut self, j: usize) -> Option<Vec<f64>> {
        self.times((0..self.whole.len()).map(|i| f64::from(u8::from(i == j))).collect())
    }

    fn is_round_off(&self, pivot: f64, j: usize) -> bool {
        !(pivot > 0.0 && pivot >= tolerances::RANK * self.whole[j])
    }

    /// A coordinate with at least the n-th part of the largest pivot: the one that forces without symmetry move most.
    fn probed(&mut self) -> Option<usize> {
        let found = self.columns.len() as f64;
        let force = |(i, whole): (usize, &f64)| {
            if *whole > 0.0 { (1.0 + found + 0.7 * i as f64 * (i as f64 + 3.0)).sin() / whole.sqrt() } else { 0.0 }
        };
        let moved = self.times(self.whole.iter().enumerate().map(force).collect())?;
        Some(self.pivot(moved.iter().map(|x| x * x)))
    }

    /// The coordinate with the largest pivot, by all columns.
    fn largest(&mut self) -> Option<usize> {
        let pivots: Option<Vec<f64>> = (0..self.whole.len()).map(|j| Some(self.column(j)?[j])).collect();
        Some(self.pivot(pivots?.into_iter()))
    }

    /// The place of the largest value in units of `whole`.
    fn pivot(&self, values: impl Iterator<Item = f64>) -> usize {
        let shares = values.zip(&self.whole).map(|(x, whole)| if *whole > 0.0 { x / whole } else { 0.0 });
        shares.enumerate().max_by(|a, b| a.1.total_cmp(&b.1)).map_or(0, |(i, _)| i)
    }
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
