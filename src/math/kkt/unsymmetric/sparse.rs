//! LU with partial pivoting on a frozen pattern, its columns in an order that keeps L and U sparse.

use super::Field;
use faer::dyn_stack::{MemBuffer, MemStack, StackReq};
use faer::perm::PermRef;
use faer::sparse::linalg::colamd;
use faer::sparse::linalg::lu::simplicial::{
    SimplicialLu, factorize_simplicial_numeric_lu, factorize_simplicial_numeric_lu_scratch, solve_in_place_scratch,
};
use faer::sparse::{SparseColMatRef, SymbolicSparseColMat};
use faer::{Conj, MatMut, Par};

/// Gilbert and Peierls's method (faer's simplicial LU), column by column without dense blocks: linear in the number of
/// bodies of chains and trees. Memory grows only when other pivots make more fill than before.
pub(super) struct Sparse<T> {
    size: usize,
    factors: SimplicialLu<usize, T>,
    columns: [Vec<usize>; 2],
    rows: [Vec<usize>; 2],
    memory: MemBuffer,
}

impl<T: Field> Sparse<T> {
    /// `None` if there is not enough memory. Columns of `last` come after all others.
    pub fn new(pattern: &SymbolicSparseColMat<usize>, last: Option<&[bool]>) -> Option<Self> {
        let size = pattern.nrows();
        let zeros = || [vec![0; size], vec![0; size]];
        let mut columns = zeros();
        let [order, places] = &mut columns;
        let mut memory = MemBuffer::try_new(colamd::order_scratch::<usize>(size, size, pattern.compute_nnz())).ok()?;
        let control = colamd::Control::default();
        colamd::order(order, places, pattern.as_ref(), control, MemStack::new(&mut memory)).ok()?;
        if let Some(last) = last {
            order.sort_by_key(|&column| last[column]);
            order.iter().enumerate().for_each(|(place, &column)| places[column] = place);
        }
        let request = StackReq::or(
            factorize_simplicial_numeric_lu_scratch::<usize, T>(size, size),
            solve_in_place_scratch::<usize, T>(size, 1, Par::Seq),
        );
        let memory = MemBuffer::try_new(request).ok()?;
        Some(Sparse { size, factors: SimplicialLu::new(), columns, rows: zeros(), memory })
    }

    /// Factors the matrix with these values at the places of the pattern, and returns the smallest pivot.
    pub fn factor(&mut self, pattern: &SymbolicSparseColMat<usize>, values: &[T]) -> f64 {
        let matrix = SparseColMatRef::new(pattern.as_ref(), values);
        let columns = PermRef::new_checked(&self.columns[0], &self.columns[1], self.size);
        let [rows, places] = &mut self.rows;
        let stack = MemStack::new(&mut self.memory);
        match factorize_simplicial_numeric_lu(rows, places, &mut self.factors, matrix, columns, stack) {
            Ok(()) => super::smallest(self.pivots()),
            // A column without any pivot.
            Err(_) => 0.0,
        }
    }

    /// The diagonal of U, which stands last in each column.
    fn pivots(&self) -> impl Iterator<Item = T> {
        let upper = self.factors.u_factor_unsorted();
        (0..self.size).map(move |j| upper.val_of_col(j).last().copied().unwrap_or(T::ZERO))
    }

    /// Solves in place.
    pub fn solve(&mut self, right: &mut [T]) {
        let columns = PermRef::new_checked(&self.columns[0], &self.columns[1], self.size);
        let rows = PermRef::new_checked(&self.rows[0], &self.rows[1], self.size);
        let right = MatMut::from_column_major_slice_mut(right, self.size, 1);
        let stack = MemStack::new(&mut self.memory);
        self.factors.solve_in_place_with_conj(rows, columns, Conj::No, right, Par::Seq, stack);
    }
}
