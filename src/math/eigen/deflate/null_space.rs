//! A level of deflation by the left null space of E.

use super::super::{Matrix, Unsolved, dense};
use super::level::{Coupling, Level, Ranks};

/// The next level; `None` if E has an inverse.
///
/// U2^T E = 0 makes U2^T A x = 0 algebraic: x = X1 z with U2^T A X1 = 0. This removes as many unknowns as equations, if
/// these are independent; if not, a combination of equations is 0 = 0 and the pencil singular.
pub fn level(a: &Matrix, e: &Matrix, ranks: &mut Ranks) -> Result<Option<Level>, Unsolved> {
    let n = a.nrows();
    let of_e = dense::svd(e)?;
    let rank = ranks.rank(&of_e.s);
    if rank == n {
        return Ok(None);
    }
    let p = [of_e.u.columns(0, rank).into_owned(), of_e.u.columns(rank, n - rank).into_owned()];
    let algebraic = p[1].transpose() * a;
    let of_a = dense::svd(&algebraic)?;
    let independent = ranks.rank(&of_a.s);
    if independent < n - rank {
        return Err(Unsolved::SingularPencil { dependent: n - rank - independent });
    }
    let x = [of_a.v.columns(n - rank, rank).into_owned(), of_a.v.columns(0, n - rank).into_owned()];
    let block = |matrix: &Matrix, k: usize| p[0].transpose() * matrix * &x[k];
    Ok(Some(Level {
        a: block(a, 0),
        e: block(e, 0),
        corner: algebraic * &x[1],
        coupling: Coupling::UpperRight { a: block(a, 1), e: block(e, 1) },
        p,
        x,
    }))
}
