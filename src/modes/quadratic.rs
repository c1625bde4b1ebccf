//! The frozen equations as one of second order, in sparse matrices.

use crate::math::eigen::Matrix;
use crate::math::kkt::{Field, Pattern};

/// (s^2 M + s C + K) p + G^T lambda = 0, G p = 0.
pub struct Quadratic {
    pub mass: Sparse,
    pub damping: Sparse,
    pub stiffness: Sparse,
    pub g: Sparse,
    /// Number of eigenvalues that are finite.
    pub finite: usize,
}

/// A sparse matrix by its entries; entries at one place add up.
#[derive(Clone)]
pub struct Sparse {
    pub pattern: Pattern,
    pub values: Vec<f64>,
}

impl Quadratic {
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
            finite: self.finite,
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

impl Sparse {
    /// The entries that are not zero.
    pub fn without_zeros(pattern: &Pattern, values: &[f64]) -> Self {
        let nonzero = pattern.entries.iter().zip(values).filter(|(_, value)| **value != 0.0);
        let (entries, values) = nonzero.map(|(place, value)| (*place, *value)).unzip();
        Sparse { pattern: Pattern { entries, ..*pattern }, values }
    }

    /// Makes a symmetric matrix from one triangle.
    pub fn symmetric(lower: &Pattern, values: &[f64]) -> Self {
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

    pub fn plus(mut self, other: Self) -> Self {
        self.pattern.entries.extend(other.pattern.entries);
        self.values.extend(other.values);
        self
    }

    /// Moves the entries at these places to another matrix.
    pub fn give(&mut self, other: &mut Self, places: impl Fn(usize, usize) -> bool) {
        for (&(i, j), value) in self.pattern.entries.iter().zip(&mut self.values).filter(|((i, j), _)| places(*i, *j)) {
            other.pattern.entries.push((i, j));
            other.values.push(std::mem::take(value));
        }
    }

    pub fn times(&self, right: &Self) -> Self {
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
