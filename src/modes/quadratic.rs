//! The frozen equations as one of second order, in sparse matrices.

use crate::formulation::degrees_of_freedom;
use crate::linearize::{Matrix, Variation};
use crate::math::kkt::{Field, Pattern};

/// The frozen index-3 pencil with dv = s p + [v, p] eliminated, in p = dq alone:
///
/// ```text
/// (s^2 M + s C + K) p + G^T dlambda = 0        C = C + M W
/// G p = 0                                      K = K + C W,   W = [v, .]
/// ```
///
/// with the K and C of a [`Variation`] on the right. W is exact; it is zero without rotations in space, and at rest.
/// Of a state xi p is dxi itself, of which the equations have no second derivative: its column of C is one of K, and
/// its 1 in M is one in C.
pub struct Quadratic {
    pub mass: Sparse,
    pub damping: Sparse,
    pub stiffness: Sparse,
    pub g: Sparse,
    /// W = [v, .].
    pub turn: Sparse,
    /// Eigenvalues that are finite: 2 (n - m), less one for each state xi, with m independent rows of G.
    pub finite: usize,
    /// Number of p that are dq; the others are dxi.
    pub moving: usize,
}

/// A sparse matrix by its entries; entries at one place add up.
#[derive(Clone)]
pub struct Sparse {
    pub pattern: Pattern,
    pub values: Vec<f64>,
}

impl Quadratic {
    /// The equations at the state of `variation`. Cost: linear in the entries of the matrices, and with moving
    /// rotations in space a bracket for each direction.
    pub fn new(variation: &Variation) -> Self {
        let structure = &variation.dynamics.structure;
        let terms = &variation.dynamics.terms;
        let part = |values: &[f64]| Sparse { pattern: Pattern::clone(&structure.tangent), values: values.to_vec() };
        let mut mass = Sparse::symmetric(&structure.mass, &terms.mass);
        let n = variation.system().dimensions();
        let k = part(&variation.tangent.k);
        let c = part(&variation.tangent.c);
        let turn = turn(variation);
        let mut stiffness = k.plus(c.times(&turn));
        let mut damping = c.plus(mass.times(&turn));
        damping.give(&mut stiffness, |_, j| j >= n.moving());
        mass.give(&mut damping, |_, j| j >= n.moving());
        Quadratic {
            stiffness,
            damping,
            g: Sparse { pattern: Pattern::clone(&structure.g), values: terms.g.clone() },
            finite: 2 * degrees_of_freedom(&variation.dynamics) - n.states,
            moving: n.moving(),
            mass,
            turn,
        }
    }

    /// Returns n, the number of directions.
    pub fn len(&self) -> usize {
        self.mass.pattern.rows
    }

    /// Returns the adjoint equations, whose p are the left vectors.
    pub fn transposed(&self) -> Self {
        Quadratic {
            mass: self.mass.clone(),
            damping: self.damping.transposed(),
            stiffness: self.stiffness.transposed(),
            g: self.g.clone(),
            turn: self.turn.clone(),
            finite: self.finite,
            moving: self.moving,
        }
    }

    /// Returns an upper estimate of the fastest rate, 1/s: sqrt(K / M) of the rows, or C / M where there is no K; 1
    /// where all is zero.
    pub fn fastest(&self) -> f64 {
        let mass = self.mass.row_sizes();
        let k = self.stiffness.row_sizes();
        let c = self.damping.row_sizes();
        let over = |top: &[f64]| {
            let ratios = top.iter().zip(&mass).filter(|(_, m)| **m > 0.0).map(|(x, m)| x / m);
            ratios.fold(0.0, f64::max)
        };
        let rate = over(&k).sqrt();
        let rate = if rate > 0.0 { rate } else { over(&c) };
        if rate > 0.0 && rate.is_finite() { rate } else { 1.0 }
    }
}

/// Returns W, column by column, where the velocity of the state rotates anything.
fn turn(variation: &Variation) -> Sparse {
    let n = variation.velocities();
    let system = variation.system();
    let v = &variation.point.v;
    let mut turn = Sparse { pattern: Pattern { rows: n, cols: n, entries: Vec::new() }, values: Vec::new() };
    // Along no axis, so that every rotation shows.
    let (any, mut out): (Vec<f64>, _) = ((0..n).map(|i| (i as f64 + 1.0).sqrt()).collect(), vec![0.0; n]);
    system.bracket(v, &any, &mut out);
    if out.iter().all(|x| *x == 0.0) {
        return turn;
    }
    let mut unit = vec![0.0; n];
    for j in 0..n {
        unit[j] = 1.0;
        system.bracket(v, &unit, &mut out);
        unit[j] = 0.0;
        for (i, value) in out.iter().enumerate().filter(|(_, value)| **value != 0.0) {
            turn.pattern.entries.push((i, j));
            turn.values.push(*value);
        }
    }
    turn
}

impl Sparse {
    /// Makes a symmetric matrix from one triangle.
    fn symmetric(lower: &Pattern, values: &[f64]) -> Self {
        let mut full = Sparse { pattern: lower.clone(), values: values.to_vec() };
        for (&(i, j), value) in lower.entries.iter().zip(values).filter(|((i, j), _)| i != j) {
            full.pattern.entries.push((j, i));
            full.values.push(*value);
        }
        full
    }

    fn transposed(&self) -> Self {
        let Pattern { rows, cols, entries } = &self.pattern;
        let entries = entries.iter().map(|&(i, j)| (j, i)).collect();
        Sparse { pattern: Pattern { rows: *cols, cols: *rows, entries }, values: self.values.clone() }
    }

    fn plus(mut self, other: Self) -> Self {
        self.pattern.entries.extend(other.pattern.entries);
        self.values.extend(other.values);
        self
    }

    /// Moves the entries at these places to another matrix.
    fn give(&mut self, other: &mut Self, places: impl Fn(usize, usize) -> bool) {
        for (&(i, j), value) in self.pattern.entries.iter().zip(&mut self.values).filter(|((i, j), _)| places(*i, *j)) {
            other.pattern.entries.push((i, j));
            other.values.push(std::mem::take(value));
        }
    }

    fn times(&self, right: &Self) -> Self {
        let mut rows = vec![Vec::new(); right.pattern.rows];
        right.pattern.entries.iter().zip(&right.values).for_each(|(&(l, j), value)| rows[l].push((j, *value)));
        let pattern = Pattern { rows: self.pattern.rows, cols: right.pattern.cols, entries: Vec::new() };
        let mut product = Sparse { pattern, values: Vec::new() };
        for (&(i, l), left) in self.pattern.entries.iter().zip(&self.values) {
            for &(j, right) in &rows[l] {
                product.pattern.entries.push((i, j));
                product.values.push(left * right);
            }
        }
        product
    }

    /// Returns the largest magnitude of an entry in each row.
    pub fn row_sizes(&self) -> Vec<f64> {
        let mut sizes = vec![0.0f64; self.pattern.rows];
        for (&(i, _), value) in self.pattern.entries.iter().zip(&self.values) {
            sizes[i] = sizes[i].max(value.abs());
        }
        sizes
    }

    /// y += factor A x
    pub fn add_product<T: Field>(&self, x: &[T], factor: T, y: &mut [T]) {
        for (&(i, j), value) in self.pattern.entries.iter().zip(&self.values) {
            y[i] += factor * x[j] * *value;
        }
    }

    /// Returns A X.
    pub fn product(&self, x: &Matrix) -> Matrix {
        let mut product = Matrix::zeros(self.pattern.rows, x.ncols());
        for (from, mut to) in x.column_iter().zip(product.column_iter_mut()) {
            self.pattern.multiply(&self.values, from.clone_owned().as_slice(), to.as_mut_slice());
        }
        product
    }
}
