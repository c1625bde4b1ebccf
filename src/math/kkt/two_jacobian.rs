//! The saddle-point system with G of one state for the reactions and of another for the constraints.

use super::system::{add_scaled, dot};
use super::{Pattern, SaddlePoint, Singular};
use crate::math::largest;
use crate::tolerances::math as tolerances;

/// ```text
/// [M   G1^T] [a     ]   [f]
/// [G2  0   ] [lambda] = [r]
/// ```
///
/// by the factors of the symmetric matrix with G1 in both blocks. Every b gives a pair (a, lambda) that satisfies the
/// upper rows exactly, with G1 a = b; GMRES finds the b with G2 a(b) = r. The map b -> G2 a(b) is the identity up to
/// `G2 - G1 = O(h)`, so about five back-substitutions gain ten digits, and a distant G2 costs more of them but does not
/// diverge.
///
/// Restarts compute the true residual, as in iterative refinement. Unlike a dense LU, it keeps the sparse factors,
/// and their treatment of dependent rows and massless coordinates.
pub struct TwoJacobianGmres {
    /// GMRES basis, by scaled rows.
    basis: Vec<Vec<f64>>,
    /// Columns of the triangular factor of the Hessenberg matrix.
    triangle: Vec<[f64; tolerances::GMRES_VECTORS + 1]>,
    rotations: Vec<(f64, f64)>,
    /// Right side of the least-squares problem, and its solution.
    reduced: [f64; tolerances::GMRES_VECTORS + 1],
    /// Size of each row, the unit of its residual.
    scale: Vec<f64>,
    force: Vec<f64>,
    diagonal: Vec<f64>,
    b: Vec<f64>,
    top: Vec<f64>,
    bottom: Vec<f64>,
}

/// The factored symmetric matrix with G2.
struct Pair<'p> {
    kkt: &'p mut SaddlePoint,
    pattern: &'p Pattern,
    g2: &'p [f64],
}

impl TwoJacobianGmres {
    /// For `n` coordinates and `m` constraints.
    pub fn new(n: usize, m: usize) -> Self {
        let most = tolerances::GMRES_VECTORS.min(m);
        TwoJacobianGmres {
            basis: vec![vec![0.0; m]; most + 1],
            triangle: vec![[0.0; tolerances::GMRES_VECTORS + 1]; most],
            rotations: vec![(1.0, 0.0); most],
            reduced: [0.0; tolerances::GMRES_VECTORS + 1],
            scale: vec![0.0; m],
            force: vec![0.0; n],
            diagonal: vec![0.0; n],
            b: vec![0.0; m],
            top: vec![0.0; n],
            bottom: vec![0.0; m],
        }
    }

    /// Solves with the factors `kkt` of M and G1. `top` is f on entry and a on return; `bottom` is a guess of G1 a on
    /// entry and lambda on return.
    ///
    /// # Errors
    /// [`Singular::Apart`] when the residual stays above 1e-9 of the rows, or above 1e-5 where rows of G1 are
    /// dependent; errors of the factors.
    pub fn solve(
        &mut self,
        kkt: &mut SaddlePoint,
        mass: (&Pattern, &[f64]),
        (pattern, g2): (&Pattern, &[f64]),
        r: &[f64],
        top: &mut [f64],
        bottom: &mut [f64],
    ) -> Result<(), Singular> {
        let mut pair = Pair { kkt, pattern, g2 };
        self.force.copy_from_slice(top);
        self.b.copy_from_slice(bottom);
        let mut last = f64::INFINITY;
        for cycle in 0..tolerances::GMRES_RESTARTS {
            top.copy_from_slice(&self.force);
            bottom.copy_from_slice(&self.b);
            pair.kkt.solve(top, bottom)?;
            if r.is_empty() {
                return Ok(());
            }
            if cycle == 0 {
                self.measure(&pair, mass, r, (top, bottom));
            }
            let residual = self.residual(&pair, r, top);
            let solved =
                if pair.kkt.is_rank_deficient() { tolerances::GMRES_CONSISTENT } else { tolerances::GMRES_SOLVED };
            if residual <= tolerances::GMRES_ROUND_OFF || residual <= solved && residual > 0.1 * last {
                return Ok(());
            }
            if residual.is_nan() || residual >= 0.9 * last {
                break;
            }
            last = residual;
            self.cycle(&mut pair)?;
        }
        Err(Singular::Apart)
    }

    /// Sizes of the rows: |r_i| + sum_j |G2_ij| (max |a| + p_j), where a is that of the guess or the one that r
    /// requires, if that is larger: a guess of zero gives no size, and rows without a right side take that of the
    /// others. p_j = (|f_j| + sum_k |G2_kj lambda_k|)/M_jj bounds the accelerations of the single forces, whose
    /// round-off is in a.
    fn measure(&mut self, pair: &Pair, (mass, values): (&Pattern, &[f64]), r: &[f64], (a, lambda): (&[f64], &[f64])) {
        let entries = || pair.pattern.entries.iter().zip(pair.g2);
        self.top.iter_mut().zip(&self.force).for_each(|(p, f)| *p = f.abs());
        entries().for_each(|(&(k, j), value)| self.top[j] += (value * lambda[k]).abs());
        self.diagonal.fill(0.0);
        mass.add_diagonal(values, &mut self.diagonal);
        self.top.iter_mut().zip(&self.diagonal).for_each(|(p, m)| *p = if *m > 0.0 { *p / m } else { 0.0 });
        self.bottom.fill(0.0);
        entries().for_each(|(&(i, j), value)| self.bottom[i] += value.abs() * self.top[j]);
        self.scale.fill(0.0);
        for (&(i, _), value) in pair.pattern.entries.iter().zip(pair.g2) {
            self.scale[i] += value.abs();
        }
        let asked = r.iter().zip(&self.scale).filter(|(_, row)| **row > 0.0).map(|(r, row)| r.abs() / row);
        let most = asked.fold(largest(a), f64::max);
        let sizes = r.iter().zip(&self.bottom);
        self.scale.iter_mut().zip(sizes).for_each(|(scale, (r, p))| *scale = *scale * most + p + r.abs());
        self.scale.iter_mut().filter(|scale| **scale == 0.0).for_each(|scale| *scale = 1.0);
    }

    /// Writes r - G2 a by scaled rows into the first basis vector and returns its norm.
    fn residual(&mut self, pair: &Pair, r: &[f64], a: &[f64]) -> f64 {
        let residual = &mut self.basis[0];
        residual.copy_from_slice(r);
        pair.pattern.subtract(pair.g2, a, residual);
        residual.iter_mut().zip(&self.scale).for_each(|(residual, scale)| *residual /= scale);
        leave_out(pair.kkt, residual);
        dot(residual, residual).sqrt()
    }

    /// One cycle of GMRES from the residual in the first basis vector; updates b.
    fn cycle(&mut self, pair: &mut Pair) -> Result<(), Singular> {
        let norm = dot(&self.basis[0], &self.basis[0]).sqrt();
        self.basis[0].iter_mut().for_each(|x| *x /= norm);
        self.reduced[0] = norm;
        let mut count = 0;
        while count < self.triangle.len() {
            self.apply(pair, count)?;
            self.orthogonalize(count);
            self.rotate(count);
            // A direction that changes no constraint: dependent rows.
            if self.triangle[count][count].abs() < 1e-12 {
                break;
            }
            count += 1;
            if self.reduced[count].abs() <= tolerances::GMRES_GAIN * norm {
                break;
            }
        }
        self.add_combination(count);
        Ok(())
    }

    /// Writes G2 a(b) by scaled rows, for basis vector `k` as b, into basis vector k + 1.
    fn apply(&mut self, pair: &mut Pair, k: usize) -> Result<(), Singular> {
        self.top.fill(0.0);
        let scaled = self.basis[k].iter().zip(&self.scale);
        self.bottom.iter_mut().zip(scaled).for_each(|(b, (x, scale))| *b = x * scale);
        pair.kkt.solve(&mut self.top, &mut self.bottom)?;
        let image = &mut self.basis[k + 1];
        image.fill(0.0);
        pair.pattern.multiply(pair.g2, &self.top, image);
        image.iter_mut().zip(&self.scale).for_each(|(image, scale)| *image /= scale);
        leave_out(pair.kkt, image);
        Ok(())
    }

    /// Gram-Schmidt of basis vector k + 1 against those before; the coefficients are column k.
    fn orthogonalize(&mut self, k: usize) {
        let (before, next) = self.basis.split_at_mut(k + 1);
        let next = &mut next[0];
        for (x, coefficient) in before.iter().zip(&mut self.triangle[k]) {
            *coefficient = dot(x, next);
            add_scaled(-*coefficient, x, next);
        }
        let norm = dot(next, next).sqrt();
        self.triangle[k][k + 1] = norm;
        if norm > 0.0 {
            next.iter_mut().for_each(|x| *x /= norm);
        }
    }

    /// Givens rotations that make column k triangular.
    fn rotate(&mut self, k: usize) {
        let column = &mut self.triangle[k];
        for (i, &(cos, sin)) in self.rotations[..k].iter().enumerate() {
            (column[i], column[i + 1]) = (cos * column[i] + sin * column[i + 1], cos * column[i + 1] - sin * column[i]);
        }
        let length = column[k].hypot(column[k + 1]);
        let (cos, sin) = if length > 0.0 { (column[k] / length, column[k + 1] / length) } else { (1.0, 0.0) };
        self.rotations[k] = (cos, sin);
        column[k] = length;
        self.reduced[k + 1] = -sin * self.reduced[k];
        self.reduced[k] *= cos;
    }

    /// b += the combination of the first `count` basis vectors of least residual.
    fn add_combination(&mut self, count: usize) {
        for i in (0..count).rev() {
            let sum: f64 = (i + 1..count).map(|j| self.triangle[j][i] * self.reduced[j]).sum();
            self.reduced[i] = (self.reduced[i] - sum) / self.triangle[i][i];
        }
        for (x, &factor) in self.basis.iter().zip(&self.reduced[..count]) {
            for ((b, x), scale) in self.b.iter_mut().zip(x).zip(&self.scale) {
                *b += factor * x * scale;
            }
        }
    }
}

/// Sets the entries of dropped rows to zero.
fn leave_out(kkt: &SaddlePoint, rows: &mut [f64]) {
    rows.iter_mut().enumerate().filter(|(row, _)| kkt.is_dropped(*row)).for_each(|(_, value)| *value = 0.0);
}
