//! Reduction of invariant spaces to modal coordinates.

use super::Quadratic;
use super::search::{Found, Space};
use crate::math::eigen::{Complex64, ComplexMatrix, Eigen, Matrix, Unsolved, eigen};
use crate::tolerances;

/// x' = A x + `inputs` f, (dq, s dq) = (P, U) x.
pub struct Modal {
    pub a: Matrix,
    pub space: Space,
    /// Coefficients of forces f along the directions, s x n.
    pub inputs: Matrix,
    pub states: Vec<String>,
}

/// Reduces the pencil to the invariant spaces. For the adjoint vectors (b, w = s b)
///
/// ```text
/// E: w^T M p + b^T C p + b^T M u      A: w^T M u - b^T K p
/// ```
///
/// Of its modes the `count` nearest to `shift`, a pair as one, each with its own coordinates. Eigenvalues without
/// independent vectors, such as the double zeros of rigid bodies, have a block of A together; all come where one does.
pub fn reduce(equations: &Quadratic, found: &Found, count: usize, shift: Complex64) -> Result<Modal, Unsolved> {
    let (Space { p, u }, Space { p: b, u: w }) = (&found.right, &found.left);
    let not_found = Unsolved::NotConverged { converged: p.ncols().min(b.ncols()), wanted: p.ncols().max(b.ncols()) };
    if p.ncols() != b.ncols() {
        return Err(not_found);
    }
    let mp = equations.mass.product(p);
    let mu = equations.mass.product(u);
    let e = w.transpose() * mp + b.transpose() * (equations.damping.product(p) + &mu);
    let a = w.transpose() * mu - b.transpose() * equations.stiffness.product(p);
    let lu = e.lu();
    let a = lu.solve(&a).ok_or(not_found)?;
    let inputs = lu.solve(&b.transpose()).ok_or(not_found)?;
    let solved = eigen(&a)?;
    let mut blocks = Blocks { columns: Vec::new(), rows: Vec::new(), a: Vec::new(), states: Vec::new() };
    let units = units(&solved);
    let chosen = chosen(&units, count, shift);
    let shared = chosen.iter().any(|unit| unit.is_defective);
    for (mode, unit) in chosen.iter().filter(|unit| !unit.is_defective).enumerate() {
        blocks.add(mode + 1, unit, &solved, p);
    }
    if shared {
        blocks.share(&units, &solved, &a)?;
    }
    let columns = Matrix::from_columns(&blocks.columns);
    let rows = Matrix::from_rows(&blocks.rows);
    Ok(Modal {
        a: blocks.matrix(),
        space: Space { p: p * &columns, u: u * columns },
        inputs: rows * inputs,
        states: blocks.states,
    })
}

/// A real eigenvalue, or the one of a pair with im > 0.
#[derive(Clone, Copy)]
struct ModeEigenvalue {
    column: usize,
    value: Complex64,
    is_defective: bool,
}

fn units(solved: &Eigen) -> Vec<ModeEigenvalue> {
    let all = solved.values.iter().enumerate().filter(|(_, value)| value.im >= 0.0);
    let unit = |(column, value): (usize, &Complex64)| {
        let left = solved.left.column(column).norm();
        ModeEigenvalue { column, value: *value, is_defective: !(left > 0.0 && left < tolerances::DEFECTIVE_MODE) }
    };
    all.map(unit).collect()
}

/// Returns the nearest ones, from the slowest. Defective real ones come from pairs, and two are one mode.
fn chosen(units: &[ModeEigenvalue], count: usize, shift: Complex64) -> Vec<ModeEigenvalue> {
    let mut order: Vec<usize> = (0..units.len()).collect();
    let far = |k: usize| (units[k].value - shift).norm();
    order.sort_by(|&i, &j| far(i).total_cmp(&far(j)));
    let mut halves = 0;
    order.retain(|&k| {
        let is_wanted = halves < 2 * count;
        halves += if units[k].is_defective && units[k].value.im == 0.0 { 1 } else { 2 };
        is_wanted
    });
    order.sort_unstable();
    order.into_iter().map(|k| units[k]).collect()
}

type ColumnVector = nalgebra::DVector<f64>;
type RowVector = nalgebra::RowDVector<f64>;

/// Coordinates: x = columns z, z = rows x.
struct Blocks {
    columns: Vec<ColumnVector>,
    rows: Vec<RowVector>,
    /// Diagonal blocks of A.
    a: Vec<Matrix>,
    states: Vec<String>,
}

impl Blocks {
    /// Adds a mode whose largest change of a coordinate is 1: x = 2 Re(c v) has the coordinates 2 Re(c), -2 Im(c) along
    /// Re(v) and Im(v).
    fn add(&mut self, number: usize, unit: &ModeEigenvalue, solved: &Eigen, p: &Matrix) {
        let shape = p.map(Complex64::from) * solved.right.column(unit.column);
        let largest = shape.iter().copied().fold(Complex64::ZERO, |a, b| if b.norm() > a.norm() { b } else { a });
        let size = if largest.norm() > 0.0 { largest } else { Complex64::from(1.0) };
        let right = solved.right.column(unit.column) / size;
        let left = solved.left.column(unit.column).map(|y| y.conj() * size).transpose();
        let value = unit.value;
        self.columns.push(right.map(|x| x.re));
        if value.im == 0.0 {
            self.rows.push(left.map(|y| y.re));
            self.a.push(Matrix::from_element(1, 1, value.re));
            self.states.push(format!("mode{number}"));
            return;
        }
        self.columns.push(right.map(|x| x.im));
        self.rows.push(left.map(|y| 2.0 * y.re));
        self.rows.push(left.map(|y| -2.0 * y.im));
        self.a.push(Matrix::from_row_slice(2, 2, &[value.re, value.im, -value.im, value.re]));
        self.states.extend([format!("mode{number}.re"), format!("mode{number}.im")]);
    }

    /// Adds one block for all defective eigenvalues: the complement to which all other vectors are orthogonal.
    fn share(&mut self, units: &[ModeEigenvalue], solved: &Eigen, a: &Matrix) -> Result<(), Unsolved> {
        let rest: Vec<&ModeEigenvalue> = units.iter().filter(|unit| !unit.is_defective).collect();
        let real = |vectors: &ComplexMatrix| -> Vec<ColumnVector> {
            let parts = |unit: &&ModeEigenvalue| {
                let vector = vectors.column(unit.column);
                let both = [vector.map(|x| x.re), vector.map(|x| x.im)];
                both.into_iter().take(if unit.value.im == 0.0 { 1 } else { 2 })
            };
            rest.iter().flat_map(parts).collect()
        };
        let right = complement(&real(&solved.left), a.nrows());
        let left = complement(&real(&solved.right), a.nrows()).transpose();
        let rows = (&left * &right).lu().solve(&left);
        let rows = rows.ok_or(Unsolved::NotConverged { converged: rest.len(), wanted: units.len() })?;
        self.a.push(&rows * a * &right);
        self.states.extend((1..=right.ncols()).map(|k| format!("shared{k}")));
        self.columns.extend(right.column_iter().map(|column| column.clone_owned()));
        self.rows.extend(rows.row_iter().map(|row| row.clone_owned()));
        Ok(())
    }

    fn matrix(&self) -> Matrix {
        let mut a = Matrix::zeros(self.columns.len(), self.columns.len());
        let mut start = 0;
        for block in &self.a {
            a.view_mut((start, start), block.shape()).copy_from(block);
            start += block.nrows();
        }
        a
    }
}

/// Returns an orthonormal basis of the orthogonal complement of independent columns.
fn complement(columns: &[ColumnVector], n: usize) -> Matrix {
    let mut all = Matrix::zeros(n, n);
    all.column_iter_mut().zip(columns).for_each(|(mut to, from)| to.copy_from(&from.normalize()));
    let basis = all.qr().q();
    basis.columns(columns.len(), n - columns.len()).clone_owned()
}
