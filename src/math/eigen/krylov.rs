//! A few eigenvalues of a large operator.

mod schur;

use super::conjugates;
use super::{Complex, ComplexMatrix, Unsolved, dense};
use nalgebra::{DVector, DVectorView};
use schur::Ordered;

type C = Complex<f64>;
type Vector = DVector<C>;

/// How [`nearest`] iterates.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Options {
    /// Size of the subspace; at least `count` + 2 are taken, at most n.
    pub subspace: Option<usize>,
    /// |apply(x) - theta x| of a converged pair, over the largest |theta|.
    pub tolerance: f64,
    pub restarts: usize,
}

impl Default for Options {
    fn default() -> Self {
        Options { subspace: None, tolerance: 1e-12, restarts: 300 }
    }
}

/// Some eigenvalues of an operator, see [`nearest`].
#[derive(Clone, Debug, PartialEq)]
pub struct Partial {
    /// Of largest magnitude, largest first.
    pub values: Vec<C>,
    /// In columns of norm 1.
    pub right: ComplexMatrix,
    /// |apply(x) - theta x| / |theta|
    pub residuals: Vec<f64>,
    /// How often the operator was applied.
    pub applications: usize,
}

/// The `count` eigenvalues theta of largest magnitude of the operator y = `apply`(x) of dimension n.
///
/// With `apply` = (A - sigma E)^-1 E these belong to the eigenvalues lambda = sigma + 1/theta of A x = lambda E x nearest
/// to sigma, with the same vectors. Infinite eigenvalues have theta = 0 and do not disturb.
///
/// Krylov-Schur method (Stewart, "A Krylov-Schur algorithm for large eigenproblems", SIAM J. Matrix Anal. Appl. 23, 2001),
/// from a fixed start vector. Each step costs an application and 8 n m operations, m the size of the subspace; memory is
/// n m numbers.
///
/// # Errors
/// What `apply` returns; no convergence within the restarts, with how many did; results that are not finite.
pub fn nearest(
    n: usize,
    count: usize,
    apply: impl FnMut(&[C], &mut [C]) -> Result<(), Unsolved>,
    options: Options,
) -> Result<Partial, Unsolved> {
    let count = count.min(n);
    let m = options.subspace.unwrap_or(2 * count + 20).max(count + 2).min(n);
    let mut space = Krylov::new(n, m, apply);
    if count == 0 {
        return Ok(Partial {
            values: Vec::new(),
            right: ComplexMatrix::zeros(n, 0),
            residuals: Vec::new(),
            applications: 0,
        });
    }
    let mut converged = 0;
    for _ in 0..=options.restarts {
        space.extend()?;
        let ritz = Ritz::of(&space.h, space.rest, count)?;
        converged = ritz.converged(options.tolerance);
        if converged == count {
            return space.finish(ritz);
        }
        // More than the wanted ones are kept, which speeds up convergence; those that have converged count as kept.
        let kept = (count + (m - count) / 3 + converged / 2).min(m - 1);
        space.contract(&Ordered::of(&space.h)?, kept);
    }
    Err(Unsolved::NotConverged { converged, wanted: count })
}

/// apply(V) = V H + rest e_m^T with orthonormal V, n x m.
struct Krylov<F> {
    apply: F,
    /// m + 1 columns, the last one the direction of the rest.
    v: ComplexMatrix,
    h: ComplexMatrix,
    rest: f64,
    /// Columns of V and H that are known.
    size: usize,
    /// What the rest of a contracted space is coupled to: its row below H.
    below: Vec<C>,
    starts: u64,
    applications: usize,
}

/// A vector of which less than this is left after orthogonalization lies in the space.
const INSIDE: f64 = 1e-14;

impl<F: FnMut(&[C], &mut [C]) -> Result<(), Unsolved>> Krylov<F> {
    fn new(n: usize, m: usize, apply: F) -> Self {
        let mut space = Krylov {
            apply,
            v: ComplexMatrix::zeros(n, m + 1),
            h: ComplexMatrix::zeros(m, m),
            rest: 0.0,
            size: 0,
            below: Vec::new(),
            starts: 0,
            applications: 0,
        };
        space.start(0);
        space
    }

    /// Puts a new direction in column k, orthogonal to those before it; zero where these are all.
    fn start(&mut self, k: usize) {
        self.starts += 1;
        let mut state = self.starts;
        let mut fresh = Vector::from_fn(self.v.nrows(), |_, _| {
            // A linear congruential generator (Knuth's): any direction will do that is always the same.
            state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
            C::new((state >> 33) as f64 / (1u64 << 31) as f64 - 0.5, 0.0)
        });
        fresh /= C::from(fresh.norm());
        self.orthogonalize(&mut fresh, k);
        let norm = fresh.norm();
        if norm > INSIDE {
            self.v.set_column(k, &(fresh / C::from(norm)));
        } else {
            self.v.column_mut(k).fill(C::ZERO);
        }
    }

    /// Subtracts what lies in the first k columns, twice; returns how much of each that was.
    fn orthogonalize(&self, vector: &mut Vector, k: usize) -> Vector {
        let known = self.v.columns(0, k);
        let mut total = Vector::zeros(k);
        for _ in 0..2 {
            let part = known.ad_mul(vector);
            *vector -= known * &part;
            total += part;
        }
        total
    }

    /// Up to m columns.
    fn extend(&mut self) -> Result<(), Unsolved> {
        let m = self.h.ncols();
        while self.size < m {
            let k = self.size;
            let mut next = Vector::zeros(self.v.nrows());
            (self.apply)(self.v.column(k).clone_owned().as_slice(), next.as_mut_slice())?;
            self.applications += 1;
            if !next.iter().all(|x| x.is_finite()) {
                return Err(Unsolved::NotFinite);
            }
            let before = next.norm();
            let part = self.orthogonalize(&mut next, k + 1);
            self.h.view_mut((0, k), (k + 1, 1)).copy_from(&part);
            for (j, coupling) in std::mem::take(&mut self.below).into_iter().enumerate() {
                self.h[(k, j)] = coupling;
            }
            let after = next.norm();
            self.size += 1;
            let is_inside = after <= INSIDE * before;
            self.rest = if is_inside { 0.0 } else { after };
            match is_inside {
                true => self.start(k + 1),
                false => self.v.set_column(k + 1, &(next / C::from(after))),
            }
            if self.size < m {
                self.h[(k + 1, k)] = C::from(self.rest);
            }
        }
        Ok(())
    }

    /// Keeps the leading `kept` Schur vectors.
    fn contract(&mut self, schur: &Ordered, kept: usize) {
        let m = self.h.ncols();
        let v = self.v.columns(0, m) * schur.q.columns(0, kept);
        let last = self.v.column(m).clone_owned();
        self.v.columns_mut(0, kept).copy_from(&v);
        self.v.set_column(kept, &last);
        self.h.fill(C::ZERO);
        self.h.view_mut((0, 0), (kept, kept)).copy_from(&schur.t.view((0, 0), (kept, kept)));
        self.below = (0..kept).map(|j| schur.q[(m - 1, j)] * self.rest).collect();
        self.size = kept;
    }

    fn finish(mut self, ritz: Ritz) -> Result<Partial, Unsolved> {
        let mut right = self.v.columns(0, self.h.ncols()) * &ritz.vectors;
        dense::normalize(&mut right);
        let mut residuals = Vec::new();
        for (x, theta) in right.column_iter().zip(&ritz.values) {
            residuals.push(self.residual(x, *theta)?);
        }
        Ok(Partial { values: ritz.values, right, residuals, applications: self.applications })
    }

    fn residual(&mut self, x: DVectorView<C>, theta: C) -> Result<f64, Unsolved> {
        let mut image = Vector::zeros(x.len());
        (self.apply)(x.clone_owned().as_slice(), image.as_mut_slice())?;
        self.applications += 1;
        let size = if theta == C::ZERO { 1.0 } else { theta.norm() };
        Ok((image - x * theta).norm() / size)
    }
}

/// Eigenvalues of H, largest first.
struct Ritz {
    values: Vec<C>,
    vectors: ComplexMatrix,
    /// |apply(x) - theta x|
    residuals: Vec<f64>,
}

impl Ritz {
    fn of(h: &ComplexMatrix, rest: f64, count: usize) -> Result<Ritz, Unsolved> {
        let m = h.nrows();
        faer::set_global_parallelism(faer::Par::Seq);
        let eigen = dense::view(h).eigen().map_err(|_| Unsolved::NotConverged { converged: 0, wanted: count })?;
        let all: Vec<C> = eigen.S().column_vector().iter().copied().collect();
        let mut order: Vec<usize> = (0..m).collect();
        order.sort_by(|&i, &j| conjugates::compare(&all[j], &all[i]));
        order.truncate(count);
        let mut vectors = ComplexMatrix::from_fn(m, count, |i, j| eigen.U()[(i, order[j])]);
        dense::normalize(&mut vectors);
        let residuals = (0..count).map(|j| rest * vectors[(m - 1, j)].norm()).collect();
        Ok(Ritz { values: order.iter().map(|&j| all[j]).collect(), vectors, residuals })
    }

    fn converged(&self, tolerance: f64) -> usize {
        let size = self.values.first().map_or(0.0, |theta| theta.norm());
        self.residuals.iter().filter(|residual| **residual <= tolerance * size).count()
    }
}
