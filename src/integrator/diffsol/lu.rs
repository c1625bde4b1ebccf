//! Sparse LU factorization by faer for diffsol.

use diffsol_la::error::LaError;
use diffsol_la::{
    FaerContext, FaerSparseMat, FaerVec, LinearOp, LinearSolver, Matrix, MatrixCommon, Vector, VectorCommon,
};
use faer::dyn_stack::{MemBuffer, MemStack};
use faer::prelude::{Reborrow, ReborrowMut};
use faer::sparse::linalg::lu::{LuRef, NumericLu, SymbolicLu, factorize_symbolic_lu};
use faer::{Conj, Par};
use std::cell::RefCell;

/// PA = LU with a fixed fill-reducing order of the columns (COLAMD) and partial pivoting.
///
/// `diffsol::FaerSparseLU` panics on a matrix that has no factors. Here a solution by such factors is an error, after
/// which diffsol takes a smaller step.
#[derive(Default)]
pub struct SparseLu(Option<LuFactors>);

struct LuFactors {
    matrix: FaerSparseMat<f64>,
    symbolic: SymbolicLu<usize>,
    numeric: NumericLu<usize, f64>,
    factor_memory: MemBuffer,
    solve_memory: RefCell<MemBuffer>,
    is_factored: bool,
}

impl LuFactors {
    fn new(matrix: FaerSparseMat<f64>) -> Option<Self> {
        let symbolic = factorize_symbolic_lu(matrix.inner()[0].symbolic(), Default::default()).ok()?;
        let factor_memory = symbolic.factorize_numeric_lu_scratch::<f64>(Par::Seq, Default::default());
        let solve_memory = symbolic.solve_in_place_scratch::<f64>(1, Par::Seq);
        Some(LuFactors {
            matrix,
            symbolic,
            numeric: NumericLu::new(),
            factor_memory: MemBuffer::new(factor_memory),
            solve_memory: RefCell::new(MemBuffer::new(solve_memory)),
            is_factored: false,
        })
    }

    /// Factors the matrix. The pivoting of faer assumes finite numbers.
    fn factor(&mut self) {
        let matrix = &self.matrix.inner()[0];
        self.is_factored = matrix.val().iter().all(|value| value.is_finite());
        if self.is_factored {
            let stack = MemStack::new(&mut self.factor_memory);
            let factored =
                self.symbolic.factorize_numeric_lu(&mut self.numeric, matrix.rb(), Par::Seq, stack, Default::default());
            self.is_factored = factored.is_ok();
        }
    }
}

impl LinearSolver<FaerSparseMat<f64>> for SparseLu {
    fn set_sparsity<Op>(&mut self, op: &Op)
    where
        Op: LinearOp<T = f64, V = FaerVec<f64>, M = FaerSparseMat<f64>, C = FaerContext>,
    {
        let matrix = FaerSparseMat::new_from_sparsity(op.nrows(), op.ncols(), op.sparsity(), *op.context());
        self.0 = LuFactors::new(matrix);
    }

    fn set_linearisation<Op>(&mut self, op: &Op)
    where
        Op: LinearOp<T = f64, V = FaerVec<f64>, M = FaerSparseMat<f64>, C = FaerContext>,
    {
        if let Some(factors) = &mut self.0 {
            op.matrix_inplace(&mut factors.matrix);
            factors.factor();
        }
    }

    fn solve_in_place(&self, x: &mut FaerVec<f64>) -> Result<(), LaError> {
        let singular = || LaError::Other("the Newton matrix is singular".to_string());
        let factors = self.0.as_ref().filter(|factors| factors.is_factored).ok_or_else(singular)?;
        let mut memory = factors.solve_memory.borrow_mut();
        // The factors are those of this symbolic factorization: both are made in `set_sparsity`.
        let lu = LuRef::new_unchecked(&factors.symbolic, &factors.numeric);
        lu.solve_in_place_with_conj(Conj::No, x.inner_mut().rb_mut(), Par::Seq, MemStack::new(&mut memory));
        if x.inner().col_as_slice(0).iter().all(|x| x.is_finite()) { Ok(()) } else { Err(singular()) }
    }

    fn solve_transpose_in_place(&self, _: &mut FaerVec<f64>) -> Result<(), LaError> {
        Err(LaError::Other(
            "transposed systems arise in adjoint sensitivities only, which are not computed".to_string(),
        ))
    }
}
