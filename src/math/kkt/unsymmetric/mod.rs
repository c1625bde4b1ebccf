//! The saddle-point system of implicit methods, whose upper block is not symmetric.

use crate::tolerances;

mod columns;
mod dense;
mod dense_rows;
mod field;
mod matrix;
mod sparse;

/// Matrices of implicit methods with one entry in so many, or more, have dense factors. Unit: `[1]`. Why: measured on
/// chains (factor and three solves, dense : sparse, microseconds): 20 rows (half full) 5 : 6, 40 (a third) 16 : 12, 100
/// (an eighth) 88 : 32, 1000 20769 : 320, 100,000 - : 37,740; complex ones 7 : 9, 26 : 17, 149 : 43, 63920 : 400, - :
/// 50,270.
const DENSE_PART: usize = 3;

/// Matrices of implicit methods with up to so many rows have dense factors, whatever their entries. Unit: `[1]`. Why:
/// up to 20 rows dense and sparse factors take the same time, and partial pivoting tells more near singular states than
/// pivots on the diagonal. Test: `implicit_steps_from_a_change_point_end`, on 17 rows.
const DENSE_ROWS: usize = 20;

/// A pivot of the scaled matrix of an implicit method below which it is singular. Unit: `[1]`. Why: below
/// ROUND_OFF_OF_FACTORS, since stiffness h^2 over masses makes pivots small where no rank is lost. Test:
/// `solves_what_it_multiplied`.
const SINGULAR_ITERATION_MATRIX: f64 = 1e-14;
#[cfg(test)]
mod tests;
mod unpivoted;

pub use field::Field;

use super::ldlt::Ldlt;
use super::pivot::Rule;
use super::{Pattern, Singular};
use dense::DenseFactors;
use dense_rows::DenseRows;
use faer::sparse::SymbolicSparseColMat;
use matrix::SparseMatrix;
use sparse::Sparse;
use unpivoted::Unpivoted;

/// Factors and solves the system of an implicit step,
///
/// ```text
/// [ A        G^T ] [ a      ]   [ r1 ]
/// [ G + b L  0   ] [ lambda ] = [ r2 ]
/// ```
///
/// with A = M + c C + k K, each on its own pattern, and L (zero unless given) on that of G, all real (`T` = `f64`) or
/// complex (`c64`); G is real. LU with partial pivoting (faer), dense or sparse by the density of the matrix; nothing
/// allocates once the fill has been seen. With [`Unsymmetric::for_corrections`] sparse factors have their pivots on the
/// diagonal while that is stable, and only else partial pivoting. Rows and columns are scaled alike so that A and the
/// rows of G are of unit size and pivots are comparable.
///
/// Dropped rows of G have lambda zero, and r2 there is not read: those that [`Unsymmetric::drop_rows`] names,
/// else, if the matrix of all rows is singular, those that are dependent in the current values. That solves
/// consistent redundant constraints.
pub struct Unsymmetric<T> {
    n: usize,
    matrix: SparseMatrix<T>,
    /// Values of the whole matrix, with rows and columns scaled and G included.
    scaled: Vec<T>,
    scale: Vec<f64>,
    /// Further factor of each row, see [`DenseRows`].
    rank: Vec<f64>,
    /// Sizes of the rows and columns of A; `is_massless`: coordinates without mass.
    weight: Vec<f64>,
    is_massless: Vec<bool>,
    factors: Factors<T>,
    /// Factors of sparse matrices on the frozen order, and whether the present ones are these.
    unpivoted: Option<Unpivoted<T>>,
    is_unpivoted: bool,
    g: Pattern,
    /// Places of G and of G^T in the matrix.
    g_places: Vec<[u32; 2]>,
    /// Values of b L at the places of G.
    coupling: Vec<T>,
    /// Factors of G diag(weight)^-1 G^T, which stay sparse where G is, and the rows whose pivots collapse in them.
    redundancy: Option<(Ldlt, Vec<usize>)>,
    /// Rows of G that are dropped.
    left_out: Vec<bool>,
    keeps_rows: bool,
    right: Vec<T>,
    is_factored: bool,
    /// True if all entries so far are in the pattern.
    fits: bool,
}

/// Index of a value, and its place in the matrix.
pub type Places = Vec<(u32, u32)>;

enum Factors<T> {
    Dense(DenseFactors<T>),
    Sparse(Sparse<T>),
}

impl<T: Field> Unsymmetric<T> {
    /// For A with entries of M (one triangle) and of C and K, and for G; `None` if there is not enough memory.
    pub fn new(mass: &Pattern, tangent: &Pattern, g: &Pattern) -> Option<Self> {
        let places = matrix::places(mass, tangent, g)?;
        let size = places.nrows();
        let is_dense = size <= DENSE_ROWS || DENSE_PART * places.compute_nnz() >= size * size;
        Self::at(places, g, is_dense)
    }

    fn at(places: SymbolicSparseColMat<usize>, g: &Pattern, is_dense: bool) -> Option<Self> {
        let matrix = SparseMatrix::new(places, is_dense)?;
        let size = matrix.size();
        let border = if is_dense { None } else { DenseRows::of(&matrix, g.cols) };
        let place = |row: usize, col: usize| matrix.place(row, col).and_then(|place| u32::try_from(place).ok());
        let of_g = g.entries.iter().map(|&(i, j)| Some([place(g.cols + i, j)?, place(j, g.cols + i)?]));
        Some(Unsymmetric {
            g_places: of_g.collect::<Option<_>>()?,
            unpivoted: None,
            is_unpivoted: false,
            n: g.cols,
            scaled: vec![T::ZERO; matrix.values.len()],
            scale: vec![1.0; size],
            weight: vec![1.0; g.cols],
            is_massless: vec![false; g.cols],
            factors: if is_dense {
                Factors::Dense(DenseFactors::new(size)?)
            } else {
                Factors::Sparse(Sparse::new(&matrix.places, border.as_ref().map(|b| b.columns.as_slice()))?)
            },
            rank: border.map_or_else(|| vec![1.0; size], |border| border.rank),
            g: g.clone(),
            coupling: vec![T::ZERO; g.entries.len()],
            redundancy: None,
            left_out: vec![false; g.rows],
            keeps_rows: false,
            right: vec![T::ZERO; size],
            is_factored: false,
            fits: true,
            matrix,
        })
    }

    /// Assumes that all rows of G are independent: the matrix is then singular only if A is singular on the null space
    /// of G.
    pub fn keeping_rows(mut self) -> Self {
        self.keeps_rows = true;
        self
    }

    /// For corrections of an iteration, which tolerate more round-off than solutions: pivots below 1e-6 of the numbers
    /// whose difference they are lead to partial pivoting.
    pub fn for_corrections(mut self) -> Self {
        if matches!(self.factors, Factors::Sparse(_)) {
            self.unpivoted = Unpivoted::new(&self.matrix.places, self.n);
        }
        self
    }

    /// Drops these rows of G, and no others, from the next factorization on.
    pub fn drop_rows(&mut self, rows: &[usize]) {
        self.keeps_rows = true;
        self.left_out.fill(false);
        rows.iter().filter(|row| **row < self.g.rows).for_each(|row| self.left_out[*row] = true);
    }

    /// Starts a new matrix.
    pub fn clear(&mut self) {
        self.matrix.values.fill(T::ZERO);
        self.coupling.fill(T::ZERO);
        self.fits = true;
        self.is_factored = false;
    }

    /// Places of the entries of a part of A, or `None` where one is missing, for [`add_at`](Self::add_at).
    pub fn places(&self, pattern: &Pattern, is_symmetric: bool) -> Option<Places> {
        let place = |(row, col)| self.matrix.place(row, col).and_then(|place| u32::try_from(place).ok());
        let mut places = Vec::with_capacity(pattern.entries.len());
        for (k, &(i, j)) in pattern.entries.iter().enumerate() {
            places.push((k as u32, place((i, j))?));
            if is_symmetric && i != j {
                places.push((k as u32, place((j, i))?));
            }
        }
        Some(places)
    }

    /// A += factor B at the [`places`](Self::places) of B.
    pub fn add_at(&mut self, places: &Places, values: &[f64], factor: T) {
        for &(value, place) in places {
            self.matrix.values[place as usize] += factor * values[value as usize];
        }
    }

    /// Finds the coordinates without mass, which get another weight.
    pub fn see_mass(&mut self, mass: &Pattern, values: &[f64]) {
        self.is_massless.fill(true);
        let diagonal = mass.entries.iter().zip(values).filter(|((i, j), value)| i == j && **value != 0.0);
        diagonal.for_each(|((i, _), _)| self.is_massless[*i] = false);
    }

    /// A += factor B, with both triangles of a symmetric B given by one.
    pub fn add(&mut self, pattern: &Pattern, values: &[f64], factor: T, is_symmetric: bool) {
        for (&(i, j), &value) in pattern.entries.iter().zip(values) {
            self.add_entry(i, j, factor * value);
            if is_symmetric && i != j {
                self.add_entry(j, i, factor * value);
            }
        }
    }

    /// b L += B, with the values of B at the places of G, times a factor for each row.
    pub fn couple(&mut self, values: &[f64], factor: impl Fn(usize) -> T) {
        let places = self.coupling.iter_mut().zip(&self.g.entries);
        places.zip(values).for_each(|((entry, &(row, _)), &value)| *entry += factor(row) * value);
    }

    /// A_ij += value
    pub fn add_entry(&mut self, row: usize, col: usize, value: T) {
        match self.matrix.place(row, col) {
            Some(place) if row < self.n && col < self.n => self.matrix.values[place] += value,
            _ => self.fits = false,
        }
    }

    /// Factors the matrix with these values of G.
    ///
    /// # Errors
    /// Values that are not finite or not in the pattern; a singular matrix, apart from dropped rows of G.
    pub fn factor(&mut self, g: &Pattern, values: &[f64]) -> Result<(), Singular> {
        if !self.fits || g.entries.len() != self.g.entries.len() || values.len() != g.entries.len() {
            return Err(Singular::Shape);
        }
        if !(values.iter().all(|x| x.is_finite()) && self.matrix.values.iter().all(|x| x.size().is_finite())) {
            return Err(Singular::NotFinite);
        }
        self.balance(values);
        if !self.keeps_rows {
            self.left_out.fill(false);
        }
        if self.factor_scaled(values) || !self.keeps_rows && self.leave_out(values) && self.factor_scaled(values) {
            self.is_factored = true;
            return Ok(());
        }
        Err(Singular::Collapsed)
    }

    /// Scales coordinates so that |A_ij| <= 1, and then rows of G to largest entry 1.
    fn balance(&mut self, g: &[f64]) {
        self.weight.fill(0.0);
        for (col, rows, values) in self.matrix.columns().take(self.n) {
            let mut largest = self.weight[col];
            for (&row, value) in rows.iter().zip(values).take_while(|(row, _)| **row < self.n) {
                let size = value.size();
                self.weight[row] = self.weight[row].max(size);
                largest = largest.max(size);
            }
            self.weight[col] = self.weight[col].max(largest);
        }
        let largest = self.weight.iter().fold(0.0, |largest: f64, x| largest.max(*x));
        let missing = if largest > 0.0 { largest } else { 1.0 };
        self.weight.iter_mut().filter(|size| **size == 0.0).for_each(|size| *size = missing);
        if self.is_massless.contains(&true) {
            self.weigh_massless(g, missing);
        }
        let (coordinates, rows) = self.scale.split_at_mut(self.n);
        coordinates.iter_mut().zip(&self.weight).for_each(|(scale, size)| *scale = size.sqrt().recip());
        rows.fill(0.0);
        for (&(i, j), value) in self.g.entries.iter().zip(g) {
            rows[i] = rows[i].max((value * coordinates[j]).abs());
        }
        rows.iter_mut().for_each(|size| *size = if *size > 0.0 { size.recip() } else { 1.0 });
    }

    /// Weight of coordinates without mass, which move with others by their constraints: that of the heaviest
    /// coordinate,
    ///
    /// ```text
    /// w_j = largest max_i (G_ij / max_k |G_ik|)^2
    /// ```
    ///
    /// Its own entries of A are only h^2 K, of reactions, or their round-off: scaled to 1 they would make rows of G
    /// that share it look dependent, with a sine of order h.
    fn weigh_massless(&mut self, g: &[f64], largest: f64) {
        let rows = &mut self.scale[self.n..];
        rows.fill(0.0);
        for (&(i, _), value) in self.g.entries.iter().zip(g) {
            rows[i] = rows[i].max(value.abs());
        }
        for (&(i, j), value) in self.g.entries.iter().zip(g).filter(|((_, j), _)| self.is_massless[*j]) {
            let reach = if rows[i] > 0.0 { value / rows[i] } else { 0.0 };
            self.weight[j] = self.weight[j].max(largest * reach * reach);
        }
    }

    /// Drops dependent rows; returns true if there are any. The order of elimination is frozen, so that the same rows of
    /// a mechanism are dropped from state to state.
    fn leave_out(&mut self, values: &[f64]) -> bool {
        let g = &self.g;
        let factors = || Ldlt::new(&Pattern::diagonal(g.cols), g, &vec![false; g.cols]);
        let (fast, skipped) = self.redundancy.get_or_insert_with(|| (factors(), Vec::with_capacity(g.rows)));
        let rule = Rule::lenient(tolerances::ROUND_OFF_OF_SOLUTIONS, &self.weight);
        if fast.factor(&self.weight, values, rule, skipped).is_err() {
            return false;
        }
        skipped.iter().for_each(|&row| self.left_out[row] = true);
        !skipped.is_empty()
    }

    /// Factors the scaled matrix; returns false if it is singular.
    fn factor_scaled(&mut self, g: &[f64]) -> bool {
        let mut scaled = self.scaled.iter_mut();
        for (col, rows, values) in self.matrix.columns() {
            let of_col = self.scale[col];
            for ((&row, value), scaled) in rows.iter().zip(values).zip(&mut scaled) {
                *scaled = *value * (self.rank[row] * self.scale[row] * of_col);
            }
        }
        let is_out = |row: usize| self.left_out[row];
        let entries = self.g.entries.iter().zip(&self.g_places).zip(g.iter().zip(&self.coupling));
        for ((&(i, j), &[below, beside]), (&value, &coupling)) in entries.filter(|((g, _), _)| !is_out(g.0)) {
            let scale = self.scale[self.n + i] * self.scale[j];
            self.scaled[below as usize] += T::real(value * scale);
            self.scaled[below as usize] += coupling * scale;
            self.scaled[beside as usize] += T::real(value * scale * self.rank[j]);
        }
        let ones = (0..self.g.rows).filter(|&row| is_out(row)).map(|row| self.n + row);
        for place in ones.filter_map(|k| self.matrix.place(k, k)) {
            self.scaled[place] = T::real(1.0);
        }
        self.is_unpivoted = self.unpivoted.as_mut().is_some_and(|factors| factors.factor(&self.scaled));
        if self.is_unpivoted {
            return true;
        }
        let smallest = match &mut self.factors {
            Factors::Dense(factors) => factors.factor(&self.scaled),
            Factors::Sparse(factors) => factors.factor(&self.matrix.places, &self.scaled),
        };
        smallest > SINGULAR_ITERATION_MATRIX
    }

    /// True for each row of G that is dropped.
    pub fn left_out(&self) -> &[bool] {
        &self.left_out
    }

    /// Solves in place.
    pub fn solve(&mut self, top: &mut [T], bottom: &mut [T]) -> Result<(), Singular> {
        if !self.is_factored || top.len() != self.n || bottom.len() != self.g.rows {
            return Err(Singular::NotFactored);
        }
        let (of_top, of_bottom) = self.right.split_at_mut(self.n);
        for (right, given, first) in [(of_top, &*top, 0), (of_bottom, &*bottom, self.n)] {
            let scale = self.scale[first..].iter().zip(&self.rank[first..]);
            for (right, (x, (scale, rank))) in right.iter_mut().zip(given.iter().zip(scale)) {
                *right = *x * (scale * rank);
            }
        }
        let rows = self.right[self.n..].iter_mut().zip(&self.left_out);
        rows.filter(|(_, out)| **out).for_each(|(right, _)| *right = T::ZERO);
        match (&mut self.factors, &mut self.unpivoted) {
            (_, Some(factors)) if self.is_unpivoted => factors.solve(&mut self.right),
            (Factors::Dense(factors), _) => factors.solve(&mut self.right),
            (Factors::Sparse(factors), _) => factors.solve(&mut self.right),
        }
        for (found, first) in [(top, 0), (bottom, self.n)] {
            let solution = self.right[first..].iter().zip(&self.scale[first..]);
            found.iter_mut().zip(solution).for_each(|(x, (right, scale))| *x = *right * *scale);
        }
        if self.right.iter().all(|x| x.size().is_finite()) { Ok(()) } else { Err(Singular::NotFinite) }
    }
}

/// The smallest magnitude; zero if one is NaN.
fn smallest<T: Field>(pivots: impl Iterator<Item = T>) -> f64 {
    pivots.map(T::size).fold(f64::INFINITY, |smallest, pivot| if pivot >= smallest { smallest } else { pivot.max(0.0) })
}
