//! Eigenvalues of real matrices: real ones and conjugate pairs, in an order that does not depend on the algorithm.

use super::{Complex, ComplexMatrix};
use faer::MatRef;
use std::cmp::Ordering;

/// A real eigenvalue, or the one of a pair with im > 0, whose vector has its real part in this column and its imaginary
/// part in the next.
#[derive(Clone, Copy, Debug)]
pub struct Unit {
    pub value: Complex<f64>,
    pub column: usize,
}

impl Unit {
    pub fn is_pair(&self) -> bool {
        self.value.im != 0.0
    }

    pub fn vector(&self, columns: MatRef<f64>) -> Vec<Complex<f64>> {
        let part = |i: usize| if self.is_pair() { columns[(i, self.column + 1)] } else { 0.0 };
        (0..columns.nrows()).map(|i| Complex::new(columns[(i, self.column)], part(i))).collect()
    }
}

/// Units of eigenvalues in the order of LAPACK's real routines: pairs in neighbouring places, im > 0 first.
pub fn units(re: impl Fn(usize) -> f64, im: impl Fn(usize) -> f64, n: usize) -> Vec<Unit> {
    let mut found = Vec::new();
    let mut column = 0;
    while column < n {
        let is_pair = im(column) != 0.0 && column + 1 < n;
        found.push(Unit { value: Complex::new(re(column), if is_pair { im(column) } else { 0.0 }), column });
        column += if is_pair { 2 } else { 1 };
    }
    found
}

/// Order by magnitude, then real, then imaginary part.
pub fn compare(a: &Complex<f64>, b: &Complex<f64>) -> Ordering {
    a.norm().total_cmp(&b.norm()).then(a.re.total_cmp(&b.re)).then(a.im.total_cmp(&b.im))
}

/// All eigenvalues, the conjugate with im < 0 first.
pub fn values(units: &[Unit]) -> Vec<Complex<f64>> {
    units.iter().flat_map(|unit| both(unit, unit.value.conj(), unit.value)).collect()
}

/// Vectors of the units in the same order as [`values`].
pub fn matrix(units: &[Unit], vectors: &[Vec<Complex<f64>>], n: usize) -> ComplexMatrix {
    let conjugate = |vector: &[Complex<f64>]| vector.iter().map(Complex::conj).collect();
    let columns = units.iter().zip(vectors).flat_map(|(unit, vector)| both(unit, conjugate(vector), vector.clone()));
    let columns: Vec<Vec<Complex<f64>>> = columns.collect();
    ComplexMatrix::from_fn(n, columns.len(), |i, j| columns[j][i])
}

fn both<T>(unit: &Unit, conjugate: T, itself: T) -> impl Iterator<Item = T> {
    unit.is_pair().then_some(conjugate).into_iter().chain([itself])
}
