//! Factorization and solution of the saddle-point system, with the choice among fast, redundant-row and dense solve.

mod condition;
mod findings;
mod kept;
mod orders;

use super::alike::Alike;
use super::ldlt::Ldlt;
use super::rank_revealing::NullSpace;
use super::redundant_rows::RedundantRowSolve;
use super::system::System;
use super::{Analysis, Pattern, Singular};
use crate::math::{add, all_finite};
use crate::tolerances;
use kept::Kept;
use orders::Orders;
use std::sync::Arc;

/// Equations, n + m, up to which the dense factorization settles whether the motion is determined. Unit: `[equations]`.
/// Why: a wrong answer ends the run, so that more time is well spent than on a doubtful rank.
const DENSE_EQUATIONS_OF_MOTION: usize = 1500;

#[derive(Clone, Copy, PartialEq, Eq)]
enum Way {
    None,
    Ldlt { refine: bool },
    Kept,
    RedundantRowSolve,
    Dense,
}

/// Solver of [M G^T; G 0] with frozen patterns. Nothing allocates after the first use of each path. A solution depends
/// on the values, the rows that are dropped, and [`Self::rank_reference`], never on what was factored before.
pub struct SaddlePoint {
    /// Rows of G count as dependent when their pivot in the QR of G^T (unit rows, mass metric) falls below this
    /// fraction of the largest.
    pub rank_tolerance: f64,
    n: usize,
    m: usize,
    is_shaped: bool,
    system: System,
    alike: Option<Alike>,
    /// `None` if some rows always depend on others.
    fast: Option<Orders>,
    kept: Option<Box<Kept>>,
    skipping: Option<Box<RedundantRowSolve>>,
    dense: Option<Box<NullSpace>>,
    way: Way,
    /// Reference value of [`Self::rank_indicator`], that of a regular state, against which a
    /// truncated factorization compares; zero before it is known.
    pub rank_reference: f64,
    /// True if rows are dropped by [`Self::drop_rows`].
    drops_rows: bool,
    /// True if rows are dropped that are not surely dependent.
    is_truncated: bool,
    top: Vec<f64>,
    bottom: Vec<f64>,
    multipliers: Vec<f64>,
}

impl SaddlePoint {
    /// Symbolic factorization: M by its lower triangle (or any one of the two places of an entry), G by its entries.
    /// Coordinates without an entry on the diagonal of M are taken as massless.
    pub fn new(mass: &Pattern, g: &Pattern) -> Self {
        Self::sharing(&Arc::new(mass.clone()), &Arc::new(g.clone()), &Arc::default())
    }

    /// Like [`Self::new`], with the order of elimination that others found, which must be that of these patterns.
    pub fn sharing(mass: &Arc<Pattern>, g: &Arc<Pattern>, analysis: &Arc<Analysis>) -> Self {
        let is_shaped = mass.rows == mass.cols && mass.rows == g.cols && mass.is_inside() && g.is_inside();
        let empty = Arc::default();
        let (mass, g) = if is_shaped { (mass, g) } else { (&empty, &empty) };
        let n = mass.rows;
        let m = g.rows;
        SaddlePoint {
            rank_tolerance: 1e-10,
            n,
            m,
            is_shaped,
            system: System::of(mass.clone(), g.clone(), analysis.clone()),
            fast: (!analysis.is_crowded(g)).then(|| Orders::new(mass, g, analysis.clone())),
            alike: None,
            kept: None,
            skipping: None,
            dense: None,
            way: Way::None,
            rank_reference: 0.0,
            drops_rows: false,
            is_truncated: false,
            top: vec![0.0; n],
            bottom: vec![0.0; m],
            multipliers: vec![0.0; m],
        }
    }

    /// Factors the matrix with these values. A pivot collapses on the fast path when elimination reduces it to less
    /// than 1e-11 of its size; below 1e-7 solutions are refined once.
    pub fn factor(&mut self, mass: &[f64], g: &[f64]) -> Result<(), Singular> {
        if self.goes_fast(mass, g)? || self.factor_kept(None)? { Ok(()) } else { self.factor_rank_revealing() }
    }

    /// True if the fast path succeeds; the values are stored if not, or if solutions need a refinement.
    #[inline]
    fn goes_fast(&mut self, mass: &[f64], g: &[f64]) -> Result<bool, Singular> {
        (self.way, self.is_truncated) = (Way::None, false);
        let System { mass: m, g: j, .. } = &self.system;
        if !self.is_shaped || mass.len() != m.entries.len() || g.len() != j.entries.len() {
            return Err(Singular::Shape);
        }
        if !self.drops_rows && self.factor_fast(mass, g) {
            return Ok(true);
        }
        self.store_finite(mass, g)?;
        Ok(false)
    }

    #[cold]
    fn store_finite(&mut self, mass: &[f64], g: &[f64]) -> Result<(), Singular> {
        if !mass.iter().chain(g).all(|v| v.is_finite()) {
            return Err(Singular::NotFinite);
        }
        self.system.store(mass, g);
        Ok(())
    }

    /// Factors; rows also count as dependent below this fraction of the reference value, such as 1e-4. Nearer to a
    /// singular state, accelerations have a larger error by round-off with these rows than without them, and so have
    /// velocities after a projection; the next projection farther away corrects the motion along them.
    #[inline]
    pub fn factor_truncated(&mut self, mass: &[f64], g: &[f64], part: f64) -> Result<(), Singular> {
        let is_fast = self.goes_fast(mass, g)?;
        if is_fast && self.is_regular(part) { Ok(()) } else { self.truncate(is_fast, part) }
    }

    /// Factors the stored values without rows that count as dependent.
    #[inline(never)]
    fn truncate(&mut self, is_fast: bool, part: f64) -> Result<(), Singular> {
        if !is_fast && self.factor_kept(Some(part))? {
            return Ok(());
        }
        let least = part * self.rank_reference;
        if least * least <= tolerances::ROUND_OFF_OF_SOLUTIONS {
            return if is_fast { Ok(()) } else { self.factor_rank_revealing() };
        }
        let skipping = self.skipping.get_or_insert_with(|| Box::new(RedundantRowSolve::new(&self.system)));
        let quality = skipping.factor(&self.system, least * least)?;
        // Coordinates with little mass of their own look the same as nearly dependent rows.
        if quality.replaced {
            return if is_fast { Ok(()) } else { self.factor_rank_revealing() };
        }
        (self.way, self.is_truncated) = (Way::RedundantRowSolve, quality.doubtful);
        Ok(())
    }

    /// True if there are rows that are dropped, or that depend on others over the same coordinates; the others are then
    /// factored.
    fn factor_kept(&mut self, part: Option<f64>) -> Result<bool, Singular> {
        if !self.drops_rows {
            let alike = self.alike.get_or_insert_with(|| Alike::new(&self.system.g));
            let rows = alike.dependent(&self.system.g_values, self.rank_tolerance);
            if rows.is_empty() {
                return Ok(false);
            }
            self.kept = self.kept.take().filter(|kept| kept.is_without(rows));
            self.kept.get_or_insert_with(|| Box::new(Kept::new(&self.system, rows)));
        }
        let Some(kept) = &mut self.kept else { return Ok(false) };
        (kept.inner.rank_tolerance, kept.inner.rank_reference) = (self.rank_tolerance, self.rank_reference);
        kept.factor(&self.system.mass_values, &self.system.g_values, part)?;
        (self.way, self.is_truncated) = (Way::Kept, kept.inner.is_truncated);
        Ok(true)
    }

    /// Drops these rows, and no others, from now on, whatever their pivots. Rows that depend on the others
    /// wherever phi = 0 do not where phi != 0: there their small pivots would lock the motion if they were kept.
    pub fn drop_rows(&mut self, rows: &[usize]) {
        self.drops_rows = rows.iter().any(|row| *row < self.m);
        self.kept = self.drops_rows.then(|| Box::new(Kept::new(&self.system, rows)));
        self.way = Way::None;
    }

    #[inline]
    fn factor_fast(&mut self, mass: &[f64], g: &[f64]) -> bool {
        let Some(orders) = &mut self.fast else { return false };
        let Some(quality) = orders.factor(&self.system, mass, g) else { return false };
        if quality.weak {
            self.system.store(mass, g);
        }
        self.way = Way::Ldlt { refine: quality.weak };
        true
    }

    fn factor_rank_revealing(&mut self) -> Result<(), Singular> {
        let total = self.n + self.m;
        let skipping = self.skipping.get_or_insert_with(|| Box::new(RedundantRowSolve::new(&self.system)));
        let mut quality = skipping.factor(&self.system, tolerances::ROUND_OFF_OF_SOLUTIONS)?;
        if total > tolerances::DENSE_EQUATIONS && quality.doubtful && !quality.replaced {
            // Round-off in pivots of dependent rows grows with the condition of the others. Null vectors tell them.
            skipping.factor(&self.system, tolerances::ROOT_OF_ROUND_OFF)?;
            if skipping.rank_indicator(&self.system) < self.rank_tolerance {
                self.way = Way::RedundantRowSolve;
                return Ok(());
            }
            quality = skipping.factor(&self.system, tolerances::ROUND_OFF_OF_SOLUTIONS)?;
        }
        let is_doubtful = quality.replaced || quality.doubtful;
        // In a large system it is not determined which nearly dependent rows are so, only whether dropping some, or
        // giving coordinates a little mass, still gives a solution.
        let is_accepted = if total <= tolerances::DENSE_EQUATIONS {
            !is_doubtful && skipping.rank_indicator(&self.system) < 0.1 * self.rank_tolerance
        } else if is_doubtful {
            match skipping.probe(&self.system) {
                Err(error) if total > DENSE_EQUATIONS_OF_MOTION => return Err(error),
                result => result.is_ok(),
            }
        } else {
            true
        };
        if is_accepted {
            self.way = Way::RedundantRowSolve;
            return Ok(());
        }
        let dense = self.dense.get_or_insert_with(|| Box::new(NullSpace::new(&self.system.mass, &self.system.g)));
        dense.factor(&self.system, self.rank_tolerance)?;
        self.way = Way::Dense;
        Ok(())
    }

    /// Solves in place: (r1, r2) -> (a, lambda).
    pub fn solve(&mut self, top: &mut [f64], bottom: &mut [f64]) -> Result<(), Singular> {
        self.solve_for(top, bottom, true)
    }

    /// Solves for a; multipliers of dependent rows are any that are consistent with it.
    #[inline]
    pub fn solve_motion(&mut self, top: &mut [f64], bottom: &mut [f64]) -> Result<(), Singular> {
        self.solve_for(top, bottom, false)
    }

    /// Solves in place; if `is_least` is false, multipliers of dependent rows need not be those of least norm.
    #[inline]
    fn solve_for(&mut self, top: &mut [f64], bottom: &mut [f64], is_least: bool) -> Result<(), Singular> {
        if top.len() != self.n || bottom.len() != self.m {
            return Err(Singular::Shape);
        }
        let system = &self.system;
        let counts_all = !self.drops_rows;
        match (
            self.way,
            self.fast.as_mut().and_then(Orders::taken),
            &mut self.kept,
            &mut self.skipping,
            &mut self.dense,
        ) {
            (Way::Ldlt { refine: false }, Some(fast), ..) => fast.solve(top, bottom),
            (Way::Ldlt { refine: true }, Some(fast), ..) => {
                refine(fast, system, top, bottom, &mut self.top, &mut self.bottom)
            }
            (Way::Kept, _, Some(kept), ..) => kept.solve(system, top, bottom, counts_all, is_least)?,
            (Way::RedundantRowSolve, .., Some(skipping), _) => skipping.solve(system, top, bottom, is_least),
            (Way::Dense, .., Some(dense)) => dense.solve(system, top, bottom),
            _ => return Err(Singular::NotFactored),
        }
        finite(top, bottom)
    }

    /// Like [`Self::solve`] with one step of iterative refinement against these values, which are stored.
    pub fn solve_refined(
        &mut self,
        mass: &[f64],
        g: &[f64],
        top: &mut [f64],
        bottom: &mut [f64],
    ) -> Result<(), Singular> {
        let way = self.way;
        if let Way::Ldlt { .. } = way {
            if mass.len() != self.system.mass.entries.len() || g.len() != self.system.g.entries.len() {
                return Err(Singular::Shape);
            }
            self.system.store(mass, g);
            self.way = Way::Ldlt { refine: true };
        }
        let solved = self.solve(top, bottom);
        self.way = way;
        solved
    }

    /// The smallest correction in the mass metric that meets G d = b: [M G^T; G 0] [d; .] = [0; b].
    pub fn solve_projection(&mut self, bottom: &[f64], correction: &mut [f64]) -> Result<(), Singular> {
        if bottom.len() != self.m || correction.len() != self.n {
            return Err(Singular::Shape);
        }
        let mut lambda = std::mem::take(&mut self.multipliers);
        lambda.copy_from_slice(bottom);
        correction.fill(0.0);
        let result = self.solve_for(correction, &mut lambda, false);
        self.multipliers = lambda;
        result
    }
    /// The same for two right sides.
    pub fn solve_projections(&mut self, bottoms: [&[f64]; 2], corrections: [&mut [f64]; 2]) -> Result<(), Singular> {
        let [d, e] = corrections;
        let fits = bottoms.iter().all(|b| b.len() == self.m) && d.len() == self.n && e.len() == self.n;
        if let (true, Way::Ldlt { refine: false }, Some(fast)) =
            (fits, self.way, self.fast.as_mut().and_then(Orders::taken))
            && fast.project(bottoms, [&mut *d, &mut *e])
        {
            return finite(d, e);
        }
        self.solve_projection(bottoms[0], d)?;
        self.solve_projection(bottoms[1], e)
    }
}

/// Solves with one step of refinement against the values of the system.
fn refine(fast: &mut Ldlt, system: &System, top: &mut [f64], bottom: &mut [f64], a: &mut [f64], lambda: &mut [f64]) {
    a.copy_from_slice(top);
    lambda.copy_from_slice(bottom);
    fast.solve(a, lambda);
    system.residual(a, lambda, top, bottom);
    fast.solve(top, bottom);
    add(a, top);
    add(lambda, bottom);
}

fn finite(top: &[f64], bottom: &[f64]) -> Result<(), Singular> {
    if all_finite(top) && all_finite(bottom) { Ok(()) } else { Err(Singular::NotFinite) }
}
