//! The constants of Radau IIA collocation, computed from their definition.

use faer::c64;
use nalgebra::{DMatrix, DVector};

/// Stages c_i are the zeros of P_s - P_{s-1} on [0, 1], c_s = 1; sum_j a_ij g(c_j) = int_0^{c_i} g for polynomials g of
/// degree s - 1. Source: Hairer, Wanner, Solving Ordinary Differential Equations II, IV.5 and IV.8.
pub struct Collocation {
    pub nodes: Vec<f64>,
    /// A, row by row; the last row is b.
    pub a: Vec<Vec<f64>>,
    /// The real eigenvalue of A.
    pub real: StageMode<f64>,
    /// One eigenvalue of each conjugate pair.
    pub pairs: Vec<StageMode<c64>>,
    /// d_i of the error estimate h (gamma_0 y'_0 + sum d_i Y'_i), the difference to a formula of order s that also uses
    /// y'_0; gamma_0 is the real eigenvalue. Source: the same, (8.17).
    pub error: Vec<f64>,
    /// The same where the polynomial of the stages is one through its values at the nodes of s - 2 stages: gamma_0 times
    /// the difference of y'_0 to that at 0.
    pub lower_error: Vec<f64>,
    /// 1 / prod_{j != i} (x_i - x_j) over the points 0, c_1 ... c_s of the continuous solution.
    barycentric: Vec<f64>,
}

/// An eigenvalue of A with its vectors: A u = value u, l A = value l, l u = 1.
pub struct StageMode<T> {
    pub value: T,
    pub right: Vec<T>,
    pub left: Vec<T>,
}

/// Legendre polynomials P_0 ... P_degree on [0, 1].
fn legendre(degree: usize, x: f64) -> Vec<f64> {
    let y = 2.0 * x - 1.0;
    let mut p = vec![1.0, y];
    for k in 1..degree {
        let k_ = k as f64;
        p.push(((2.0 * k_ + 1.0) * y * p[k] - k_ * p[k - 1]) / (k_ + 1.0));
    }
    p
}

/// int_0^x P_k
fn integral(k: usize, x: f64) -> f64 {
    let p = legendre(k + 1, x);
    if k == 0 { x } else { (p[k + 1] - p[k - 1]) / (2.0 * (2.0 * k as f64 + 1.0)) }
}

/// Zeros of P_s - P_{s-1} by bisection; they are simple, and further apart than the grid.
fn nodes(s: usize) -> Vec<f64> {
    let value = |x: f64| {
        let p = legendre(s, x);
        p[s] - p[s - 1]
    };
    let grid = 100 * s;
    let point = |i: usize| i as f64 / grid as f64;
    let brackets = (0..grid - 1).map(|i| (point(i), point(i + 1))).filter(|&(a, b)| value(a) * value(b) <= 0.0);
    let bisected = brackets.map(|(mut a, mut b)| {
        for _ in 0..60 {
            let middle = 0.5 * (a + b);
            if value(a) * value(middle) <= 0.0 { b = middle } else { a = middle }
        }
        0.5 * (a + b)
    });
    bisected.chain([1.0]).collect()
}

impl Collocation {
    /// The method with an odd number of stages s, of order 2 s - 1.
    pub fn new(s: usize) -> Self {
        let nodes = nodes(s);
        // Legendre polynomials as the basis, so that the systems are well conditioned.
        let basis = DMatrix::from_fn(s, s, |k, i| legendre(s, nodes[i])[k]);
        let basis = basis.lu();
        let weights = |moments: DVector<f64>| basis.solve(&moments).unwrap_or_else(|| DVector::zeros(s));
        let a: Vec<Vec<f64>> = nodes
            .iter()
            .map(|&c| weights(DVector::from_fn(s, |k, _| integral(k, c))).iter().copied().collect())
            .collect();
        let matrix = DMatrix::from_fn(s, s, |i, j| a[i][j]);
        let (real, pairs) = modes(&matrix);
        let error = weights(DVector::from_fn(s, |k, _| -real.value * legendre(s, 0.0)[k]));
        let points: Vec<f64> = [0.0].iter().chain(&nodes).copied().collect();
        let others = |i: usize| (0..=s).filter(move |&j| j != i);
        let product = |i: usize| others(i).map(|j| points[i] - points[j]).product::<f64>();
        let barycentric = (0..=s).map(|i| 1.0 / product(i)).collect();
        let error = error.iter().copied().collect();
        let mut method = Collocation { a, real, pairs, error, lower_error: Vec::new(), barycentric, nodes };
        method.lower_error = method.error_through(&self::nodes(s - 2));
        method
    }

    /// Weights over the stages of -gamma_0 times the polynomial at 0 that has their values at `nodes`.
    fn error_through(&self, nodes: &[f64]) -> Vec<f64> {
        let at_zero = |j: usize| {
            let others = nodes.iter().enumerate().filter(|(m, _)| *m != j);
            others.map(|(_, node)| node / (node - nodes[j])).product::<f64>()
        };
        let weight = |i: usize| (0..nodes.len()).map(|j| at_zero(j) * self.stage_lagrange(i, nodes[j])).sum::<f64>();
        (0..self.stages()).map(|i| -self.real.value * weight(i)).collect()
    }

    pub fn stages(&self) -> usize {
        self.nodes.len()
    }

    /// Value at x of the i-th Lagrange polynomial over 0, c_1 ... c_s.
    pub fn lagrange(&self, i: usize, x: f64) -> f64 {
        let point = |j: usize| if j == 0 { 0.0 } else { self.nodes[j - 1] };
        (0..=self.stages()).filter(|j| *j != i).fold(self.barycentric[i], |product, j| product * (x - point(j)))
    }

    /// The same polynomial over c_1 ... c_s only, at x other than 0.
    pub fn stage_lagrange(&self, i: usize, x: f64) -> f64 {
        self.lagrange(i + 1, x) * self.nodes[i] / x
    }
}

/// The eigenvalues of A in the upper half-plane, with their vectors.
fn modes(a: &DMatrix<f64>) -> (StageMode<f64>, Vec<StageMode<c64>>) {
    let s = a.nrows();
    let mut values: Vec<c64> = a.complex_eigenvalues().iter().map(|value| c64::new(value.re, value.im)).collect();
    // The real one first, then the pairs by increasing imaginary part.
    values.retain(|value| value.im > -1e-9);
    values.sort_by(|x, y| x.im.total_cmp(&y.im));
    let complex = a.map(|entry| c64::new(entry, 0.0));
    let vectors: Vec<DVector<c64>> = values.iter().map(|&value| eigenvector(&complex, value)).collect();
    let conjugates = vectors.iter().skip(1).map(|vector| vector.map(|entry| entry.conj()));
    let all: Vec<DVector<c64>> = vectors.iter().cloned().chain(conjugates).collect();
    let right = DMatrix::from_columns(&all);
    let left = right.clone().try_inverse().unwrap_or_else(|| DMatrix::zeros(s, s));
    let mode = |k: usize| StageMode {
        value: values[k],
        right: right.column(k).iter().copied().collect(),
        left: left.row(k).iter().copied().collect(),
    };
    let real = mode(0);
    let parts = |x: &[c64]| x.iter().map(|x| x.re).collect();
    let real = StageMode { value: real.value.re, right: parts(&real.right), left: parts(&real.left) };
    (real, (1..values.len()).map(mode).collect())
}

/// Eigenvector by inverse iteration. A real eigenvalue gets a real vector.
fn eigenvector(a: &DMatrix<c64>, value: c64) -> DVector<c64> {
    let s = a.nrows();
    let shift = value + c64::new(1e-10, 0.0);
    let lu = (a - DMatrix::identity(s, s) * shift).lu();
    let mut vector = DVector::from_element(s, c64::new(1.0, 0.0));
    for _ in 0..3 {
        vector = lu.solve(&vector).unwrap_or(vector);
        vector /= c64::new(vector.norm(), 0.0);
    }
    vector
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Hairer and Wanner II, table 5.6: the nodes and weights of order 5 in closed form.
    #[test]
    fn three_stages_are_those_of_the_book() {
        let three = Collocation::new(3);
        let root = 6.0f64.sqrt();
        let close = |found: f64, exact: f64| assert!((found - exact).abs() < 2e-15, "{found} {exact}");
        close(three.nodes[0], (4.0 - root) / 10.0);
        close(three.nodes[1], (4.0 + root) / 10.0);
        close(three.a[0][0], (88.0 - 7.0 * root) / 360.0);
        close(three.a[0][1], (296.0 - 169.0 * root) / 1800.0);
        close(three.a[1][2], (-2.0 - 3.0 * root) / 225.0);
        close(three.a[2][1], (16.0 + root) / 36.0);
        // The eigenvalues of A^-1 are those of the book's (8.7).
        close(three.real.value, 1.0 / (3.0 + 3.0f64.powf(2.0 / 3.0) - 3.0f64.powf(1.0 / 3.0)));
    }

    #[test]
    fn every_number_of_stages_fulfils_its_conditions() {
        for s in [3, 5, 7] {
            let method = Collocation::new(s);
            assert_eq!((method.stages(), method.pairs.len()), (s, (s - 1) / 2));
            let moment = |weights: &[f64], k: i32| -> f64 {
                weights.iter().zip(&method.nodes).map(|(a, c)| a * c.powi(k)).sum()
            };
            for k in 0..2 * s as i32 - 1 {
                let exact = 1.0 / f64::from(k + 1);
                assert!((moment(&method.a[s - 1], k) - exact).abs() < 1e-15, "b, {s} stages, degree {k}");
            }
            for k in 0..s as i32 {
                for (row, c) in method.a.iter().zip(&method.nodes) {
                    assert!((moment(row, k) - c.powi(k + 1) / f64::from(k + 1)).abs() < 2e-15);
                }
                let rest = if k == 0 { method.real.value } else { 0.0 };
                assert!((moment(&method.error, k) + rest).abs() < 1e-14, "error, {s} stages, degree {k}");
                let lower = (moment(&method.lower_error, k) + rest).abs();
                assert_eq!(
                    lower < 1e-14,
                    k < s as i32 - 2,
                    "error of two stages less, {s} stages, degree {k}: {lower}"
                );
            }
            for mode in &method.pairs {
                let product = |i: usize| -> c64 { (0..s).map(|j| mode.right[j] * method.a[i][j]).sum() };
                let left: c64 = mode.left.iter().zip(&mode.right).map(|(l, u)| l * u).sum();
                assert!((left - 1.0).norm() < 1e-12);
                assert!((0..s).all(|i| (product(i) - mode.value * mode.right[i]).norm() < 1e-13));
            }
        }
    }

    /// Interpolation reproduces a polynomial.
    #[test]
    fn lagrange_polynomials_are_one_at_their_points() {
        let method = Collocation::new(5);
        let value = |x: f64| 1.0 + x * (2.0 - x * (0.5 + x * x));
        for x in [0.1, 0.3, 1.0, 1.7] {
            let stages = (0..5).map(|i| method.stage_lagrange(i, x) * value(method.nodes[i]));
            let sum: f64 = stages.sum();
            assert!((sum - value(x)).abs() < 1e-13, "{x} {sum}");
            let all: f64 =
                (0..6).map(|i| method.lagrange(i, x) * value(if i == 0 { 0.0 } else { method.nodes[i - 1] })).sum();
            assert!((all - value(x)).abs() < 1e-13, "{x} {all}");
        }
    }
}
