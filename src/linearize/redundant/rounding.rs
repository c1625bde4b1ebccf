//! Matrices of a pencil with entries below rounding set to zero.

use crate::formulation::DaeRow;
use crate::linearize::changes::beside;
use crate::linearize::{Matrix, Variation};

/// K, C, G, Gd and -(Gdd, G1) of a pencil.
pub struct PencilParts {
    pub k: Matrix,
    pub c: Matrix,
    pub g: Matrix,
    pub gd: Matrix,
    pub rows: Matrix,
}

impl PencilParts {
    /// Returns the coefficients of (dq, dv) in the row 0 = c_2 (G dv' + ...) + c_1 (Gd dq + G dv) + c_0 G dq.
    pub fn row(&self, row: DaeRow) -> Matrix {
        let PencilParts { g, gd, rows, .. } = self;
        let still = Matrix::zeros(g.nrows(), g.ncols());
        rows * row.acceleration - beside(gd, g) * row.velocity - beside(g, &still) * row.position
    }

    /// Sets entries to zero that are smaller than rounding of the largest. Scaling a pencil by the size of its entries
    /// would weight 1e-30 in the place of a zero like any other entry, and ranks would be wrong.
    pub fn clean(&mut self, variation: &Variation) {
        let mass = variation.mass();
        // Directions without mass of their own give no finite ratio.
        let root = |j: usize| mass[(j, j)].max(0.0).sqrt();
        let scaled = |matrix: &Matrix| {
            Matrix::from_fn(matrix.nrows(), matrix.ncols(), |i, j| over(matrix[(i, j)], root(i) * root(j)))
        };
        let k = scaled(&self.k);
        let c = scaled(&self.c);
        // The highest frequency, 1/s, that springs or dampers give.
        let rate = largest(k.iter()).sqrt().max(largest(c.iter()));
        drop_small(&mut self.k, &k, |_| rate * rate);
        drop_small(&mut self.c, &c, |_| rate);
        let n = mass.nrows();
        let of_rows = |matrix: &Matrix| {
            Matrix::from_fn(matrix.nrows(), matrix.ncols(), |i, j| over(matrix[(i, j)], root(j % n.max(1))))
        };
        let g = of_rows(&self.g);
        let gd = of_rows(&self.gd);
        let both = of_rows(&self.rows);
        let size: Vec<f64> = g.row_iter().map(|row| largest(row.iter())).collect();
        drop_small(&mut self.g, &g, |i| size[i]);
        drop_small(&mut self.gd, &gd, |i| size[i] * rate);
        let [mut of_q, mut of_v] = [self.rows.columns(0, n).clone_owned(), self.rows.columns(n, n).clone_owned()];
        drop_small(&mut of_q, &both.columns(0, n).clone_owned(), |i| size[i] * rate * rate);
        drop_small(&mut of_v, &both.columns(n, n).clone_owned(), |i| size[i] * rate);
        self.rows.columns_mut(0, n).copy_from(&of_q);
        self.rows.columns_mut(n, n).copy_from(&of_v);
    }
}

/// Returns the largest finite value.
fn largest<'m>(sizes: impl Iterator<Item = &'m f64>) -> f64 {
    sizes.filter(|size| size.is_finite()).fold(0.0, |largest, size| largest.max(*size))
}

fn over(entry: f64, scale: f64) -> f64 {
    if scale > 0.0 { entry.abs() / scale } else { f64::INFINITY }
}

/// Sets entries to zero whose size is below rounding of the `usual` size in their row.
fn drop_small(matrix: &mut Matrix, sizes: &Matrix, usual: impl Fn(usize) -> f64) {
    for ((i, j), size) in (0..sizes.ncols()).flat_map(|j| (0..sizes.nrows()).map(move |i| (i, j))).zip(sizes.iter()) {
        // A tenth of what rounds the largest: frequencies a million times lower keep five digits.
        if *size < 1e-17 * usual(i) {
            matrix[(i, j)] = 0.0;
        }
    }
}
