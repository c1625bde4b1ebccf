//! LU with partial pivoting on a full matrix.

use super::Field;
use faer::dyn_stack::{MemBuffer, MemStack, StackReq};
use faer::linalg::lu::partial_pivoting::{factor, solve};
use faer::perm::PermRef;
use faer::{MatMut, MatRef, Par, Spec};

pub(super) struct DenseFactors<T> {
    size: usize,
    /// L and U, column by column.
    factors: Vec<T>,
    rows: Vec<usize>,
    places: Vec<usize>,
    memory: MemBuffer,
}

impl<T: Field> DenseFactors<T> {
    /// `None` if there is not enough memory.
    pub fn new(size: usize) -> Option<Self> {
        let request = StackReq::or(
            factor::lu_in_place_scratch::<usize, T>(size, size, Par::Seq, Spec::default()),
            solve::solve_in_place_scratch::<usize, T>(size, 1, Par::Seq),
        );
        Some(DenseFactors {
            size,
            factors: vec![T::ZERO; size * size],
            rows: vec![0; size],
            places: vec![0; size],
            memory: MemBuffer::try_new(request).ok()?,
        })
    }

    /// Factors the matrix with these values, column by column, and returns the smallest pivot.
    pub fn factor(&mut self, values: &[T]) -> f64 {
        self.factors.copy_from_slice(values);
        let matrix = MatMut::from_column_major_slice_mut(&mut self.factors, self.size, self.size);
        let stack = MemStack::new(&mut self.memory);
        factor::lu_in_place(matrix, &mut self.rows, &mut self.places, Par::Seq, stack, Spec::default());
        super::smallest(self.factors.iter().step_by(self.size + 1).copied())
    }

    /// Solves in place.
    pub fn solve(&mut self, right: &mut [T]) {
        let factors = MatRef::from_column_major_slice(&self.factors, self.size, self.size);
        let order = PermRef::new_checked(&self.rows, &self.places, self.size);
        let right = MatMut::from_column_major_slice_mut(right, self.size, 1);
        solve::solve_in_place(factors, factors, order, right, Par::Seq, MemStack::new(&mut self.memory));
    }
}
