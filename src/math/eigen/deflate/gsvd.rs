//! A level of deflation by the generalized singular value decomposition.

use super::super::{Matrix, Unsolved, dense};
use super::level::{Coupling, Level, Ranks};
use faer::Par;

/// The next level; `None` if E has an inverse.
///
/// A = U C H, E = V S H with C^2 + S^2 = I (Golub and Van Loan, "Matrix Computations", section 6.1.6, by QR of [A; E]
/// and SVD of a block of Q). The columns X2 of H^-1 with s = 0 have E X2 = 0, and A X2 = U2 is orthonormal; along the
/// others x = X1 z the equations orthogonal to U2 do not contain X2, which follows from U2.
pub fn level(a: &Matrix, e: &Matrix, ranks: &mut Ranks) -> Result<Option<Level>, Unsolved> {
    let n = a.nrows();
    if n == 0 {
        return Ok(None);
    }
    let (q, r) = stacked(a, e);
    let independent = ranks.rank(&dense::svd(&r)?.s);
    if independent < n {
        return Err(Unsolved::SingularPencil { dependent: n - independent });
    }
    let q_a = q.rows(0, n);
    let q_e = q.rows(n, n);
    let cosines = dense::svd(&q_e.into_owned())?;
    let rank = ranks.rank(&cosines.s);
    if rank == n {
        return Ok(None);
    }
    let w = [cosines.v.columns(0, rank).into_owned(), cosines.v.columns(rank, n - rank).into_owned()];
    let images = q_a * &w[1];
    let full = complete(&images);
    let p = [full.columns(n - rank, rank).into_owned(), full.columns(0, n - rank).into_owned()];
    let kept = [q_a * &w[0], q_e * &w[0]];
    let block = |k: usize, of: &Matrix| p[k].transpose() * of;
    let solve = |w: &Matrix| r.solve_upper_triangular(w).ok_or(Unsolved::SingularPencil { dependent: 1 });
    Ok(Some(Level {
        a: block(0, &kept[0]),
        e: block(0, &kept[1]),
        corner: block(1, &images),
        coupling: Coupling::LowerLeft { a: block(1, &kept[0]), e: block(1, &kept[1]) },
        x: [solve(&w[0])?, solve(&w[1])?],
        p,
    }))
}

/// The thin QR factors of [A; E].
fn stacked(a: &Matrix, e: &Matrix) -> (Matrix, Matrix) {
    let n = a.nrows();
    let both = Matrix::from_fn(2 * n, n, |i, j| if i < n { a[(i, j)] } else { e[(i - n, j)] });
    faer::set_global_parallelism(Par::Seq);
    let qr = dense::view(&both).qr();
    (dense::copy(qr.compute_thin_Q().as_ref()), dense::copy(qr.thin_R()))
}

/// An orthogonal matrix whose first columns span those given.
fn complete(columns: &Matrix) -> Matrix {
    dense::copy(dense::view(columns).qr().compute_Q().as_ref())
}
