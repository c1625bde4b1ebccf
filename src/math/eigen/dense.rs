//! Dense decompositions of faer on matrices of nalgebra.

use super::{Complex, ComplexMatrix, Matrix, Unsolved};
use crate::math::kkt::Field;
use faer::linalg::matmul::matmul;
use faer::traits::Conjugate;
use faer::{Accum, MatMut, MatRef, Par};
use nalgebra::DMatrix;

pub fn view<T>(matrix: &DMatrix<T>) -> MatRef<'_, T> {
    MatRef::from_column_major_slice(matrix.as_slice(), matrix.nrows(), matrix.ncols())
}

pub fn copy<T: nalgebra::Scalar + Copy>(matrix: MatRef<T>) -> DMatrix<T> {
    DMatrix::from_fn(matrix.nrows(), matrix.ncols(), |i, j| matrix[(i, j)])
}

/// The product A B.
pub fn product<T: Field + 'static, A: Conjugate<Canonical = T>>(a: MatRef<A>, b: MatRef<T>) -> DMatrix<T> {
    let mut product = DMatrix::from_element(a.nrows(), b.ncols(), T::ZERO);
    let to = MatMut::from_column_major_slice_mut(product.as_mut_slice(), a.nrows(), b.ncols());
    matmul(to, Accum::Replace, a, b, T::real(1.0), Par::Seq);
    product
}

/// The product of a real and a complex matrix, by products of real ones.
pub fn times(a: &Matrix, x: &ComplexMatrix) -> ComplexMatrix {
    let of = |part: Matrix| product(view(a), view(&part));
    of(x.map(|x| x.re)).zip_map(&of(x.map(|x| x.im)), Complex::new)
}

/// The size of finite square matrices of equal size; an error for others.
pub fn square(matrices: &[&Matrix]) -> Result<usize, Unsolved> {
    let n = matrices.first().map_or(0, |first| first.nrows());
    if matrices.iter().any(|matrix| matrix.shape() != (n, n)) {
        return Err(Unsolved::Shape);
    }
    if matrices.iter().all(|matrix| is_finite(matrix)) { Ok(n) } else { Err(Unsolved::NotFinite) }
}

pub fn is_finite(matrix: &Matrix) -> bool {
    matrix.iter().all(|x| x.is_finite())
}

/// Singular value decomposition U diag(s) V^T with square U and V and descending s.
pub struct Svd {
    pub u: Matrix,
    pub s: Vec<f64>,
    pub v: Matrix,
}

pub fn svd(matrix: &Matrix) -> Result<Svd, Unsolved> {
    let least = matrix.nrows().min(matrix.ncols());
    if least == 0 {
        let eye = |n| Matrix::identity(n, n);
        return Ok(Svd { u: eye(matrix.nrows()), s: Vec::new(), v: eye(matrix.ncols()) });
    }
    faer::set_global_parallelism(Par::Seq);
    let svd = view(matrix).svd().map_err(|_| Unsolved::NotConverged { converged: 0, wanted: least })?;
    let s = svd.S().column_vector().iter().copied().collect();
    Ok(Svd { u: copy(svd.U()), s, v: copy(svd.V()) })
}

/// Singular values in descending order.
pub fn singular_values<T: faer::traits::ComplexField<Real = f64>>(matrix: &DMatrix<T>) -> Result<Vec<f64>, Unsolved> {
    faer::set_global_parallelism(Par::Seq);
    view(matrix).singular_values().map_err(|_| Unsolved::NotConverged { converged: 0, wanted: matrix.ncols() })
}

/// Largest over smallest singular value; infinite if the smallest is round-off, 1 without columns.
pub fn condition<T: faer::traits::ComplexField<Real = f64>>(matrix: &DMatrix<T>) -> Result<f64, Unsolved> {
    if matrix.is_empty() {
        return Ok(1.0);
    }
    let values = singular_values(matrix)?;
    let largest = values[0];
    let smallest = values[values.len() - 1];
    let is_zero = smallest <= largest * f64::EPSILON * matrix.nrows() as f64;
    Ok(if is_zero { f64::INFINITY } else { largest / smallest })
}

pub fn complex(matrix: &Matrix) -> ComplexMatrix {
    matrix.map(|x| Complex::new(x, 0.0))
}

/// Scales columns to Euclidean norm 1, without overflow; zero columns stay zero.
pub fn normalize(matrix: &mut ComplexMatrix) {
    for mut column in matrix.column_iter_mut() {
        let largest = column.iter().fold(0.0, |largest: f64, x| largest.max(x.re.abs()).max(x.im.abs()));
        if largest > 0.0 {
            // By division, since the reciprocal of a denormal number overflows.
            column.iter_mut().for_each(|x| *x = Complex::new(x.re / largest, x.im / largest));
            let norm = column.norm();
            column.iter_mut().for_each(|x| *x /= norm);
        }
    }
}

/// The power of two nearest to x > 0.
pub fn power_of_two(x: f64) -> f64 {
    x.log2().round().exp2()
}

/// Pseudo-random numbers in (-1, 1), the same for the same seed: a start direction.
pub fn direction(n: usize, seed: u64) -> impl Iterator<Item = f64> {
    let mut state = seed;
    (0..n).map(move |_| {
        // A linear congruential generator (Knuth's).
        state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (state >> 33) as f64 / (1u64 << 30) as f64 - 1.0
    })
}
