//! The equations at one s, factored.

use super::Quadratic;
use crate::math::eigen::{Scalar, Unsolved};
use crate::math::kkt::{Pattern, Singular, Unsymmetric};

/// (A - sigma E)^-1 E of the pencil in x = (p, s p), by the factors of [sigma^2 M + sigma C + K, G^T; G, 0]; real for a
/// real sigma.
pub struct Shifted<'a, T> {
    quadratic: &'a Quadratic,
    pub sigma: T,
    matrix: Unsymmetric<T>,
    /// Scale of p and s p in vectors: the square roots of the masses, and those over a rate.
    pub scale: Vec<f64>,
    top: Vec<T>,
    bottom: Vec<T>,
}

impl<'a, T: Scalar> Shifted<'a, T> {
    /// Factors the equations at sigma; `rate`, 1/s, is the scale of the eigenvalues.
    ///
    /// # Errors
    /// sigma is an eigenvalue, to rounding.
    pub fn new(quadratic: &'a Quadratic, sigma: T, rate: f64) -> Result<Self, Unsolved> {
        let n = quadratic.len();
        let none = Pattern { rows: n, cols: n, entries: Vec::new() };
        let mut all = quadratic.stiffness.pattern.clone();
        all.entries.extend(quadratic.damping.pattern.entries.iter().chain(&quadratic.mass.pattern.entries));
        let matrix = Unsymmetric::new(&none, &all, &quadratic.g.pattern);
        let mut matrix = matrix.ok_or(Singular::Shape)?;
        let parts =
            [(&quadratic.mass, sigma * sigma), (&quadratic.damping, sigma), (&quadratic.stiffness, T::from_real(1.0))];
        parts.iter().for_each(|(part, factor)| matrix.add(&part.pattern, &part.values, *factor, false));
        matrix.factor(&quadratic.g.pattern, &quadratic.g.values)?;
        let bottom = vec![T::ZERO; quadratic.g.pattern.rows];
        Ok(Shifted { quadratic, sigma, matrix, scale: scale(quadratic, rate), top: vec![T::ZERO; n], bottom })
    }

    /// Solves (sigma^2 M + sigma C + K) p + G^T lambda = f, G p = 0 for p; in place.
    pub fn solve(&mut self, f: &mut [T]) -> Result<(), Unsolved> {
        self.bottom.fill(T::ZERO);
        Ok(self.matrix.solve(f, &mut self.bottom)?)
    }

    /// Computes y = (A - sigma E)^-1 E x of scaled vectors:
    ///
    /// ```text
    /// (sigma^2 M + sigma C + K) p + G^T lambda = -(M (u0 + sigma p0) + C p0),   u = p0 + sigma p
    /// ```
    pub fn apply(&mut self, x: &[T], y: &mut [T]) -> Result<(), Unsolved> {
        let n = self.quadratic.len();
        let sigma = self.sigma;
        y.iter_mut().zip(x.iter().zip(&self.scale)).for_each(|(y, (x, scale))| *y = x.unscale(*scale));
        let (p, u) = y.split_at_mut(n);
        u.iter_mut().zip(p.iter()).for_each(|(u, p)| *u += sigma * *p);
        let mut right = std::mem::take(&mut self.top);
        right.fill(T::ZERO);
        self.quadratic.mass.add_product(u, T::from_real(-1.0), &mut right);
        self.quadratic.damping.add_product(p, T::from_real(-1.0), &mut right);
        self.solve(&mut right)?;
        for (i, next) in right.iter().enumerate() {
            u[i] = (p[i] + sigma * *next) * self.scale[n + i];
            p[i] = *next * self.scale[i];
        }
        self.top = right;
        Ok(())
    }
}

fn scale(quadratic: &Quadratic, rate: f64) -> Vec<f64> {
    let mut sizes = quadratic.mass.row_sizes();
    let largest = sizes.iter().fold(0.0f64, |largest, m| largest.max(*m));
    let missing = if largest > 0.0 { largest } else { 1.0 };
    sizes.iter_mut().for_each(|m| *m = if *m > 0.0 { m.sqrt() } else { missing.sqrt() });
    let rates: Vec<f64> = sizes.iter().map(|size| size / rate).collect();
    [sizes, rates].concat()
}
