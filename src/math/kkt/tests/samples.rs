//! Systems for tests, and dense oracles.

use crate::math::kkt::{Lever, Pattern};
use faer::Mat;
use faer::linalg::solvers::Solve;

/// A repeatable sequence of numbers in [-1, 1].
pub struct Random(pub u64);

impl Random {
    pub fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (self.0 >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }
    pub fn vector(&mut self, n: usize) -> Vec<f64> {
        (0..n).map(|_| self.next()).collect()
    }
}

#[derive(Clone)]
pub struct Sample {
    pub mass: Pattern,
    pub mass_values: Vec<f64>,
    pub g: Pattern,
    pub g_values: Vec<f64>,
}

impl Sample {
    /// Full M = B B^T + I and full G.
    pub fn dense(n: usize, m: usize, random: &mut Random) -> Self {
        let b: Vec<Vec<f64>> = (0..n).map(|_| random.vector(n)).collect();
        let mass = Pattern::lower(n);
        let product = |i: usize, j: usize| b[i].iter().zip(&b[j]).map(|(x, y)| x * y).sum::<f64>();
        let mass_values = mass.entries.iter().map(|&(i, j)| product(i, j) + f64::from(u8::from(i == j))).collect();
        Sample { mass, mass_values, g: Pattern::dense(m, n), g_values: random.vector(n * m) }
    }

    /// Planar bodies of diagonal mass; joints of two rows between bodies (0 is the ground) at random points.
    pub fn planar(bodies: usize, joints: &[(usize, usize)], random: &mut Random) -> Self {
        let mut g = Pattern { rows: 2 * joints.len(), cols: 3 * bodies, entries: vec![] };
        let mut g_values = vec![];
        for (j, &(a, b)) in joints.iter().enumerate() {
            for (body, sign) in [(a, 1.0), (b, -1.0)].into_iter().filter(|(body, _)| *body > 0) {
                let at = 3 * (body - 1);
                for r in 0..2 {
                    g.entries.extend([(2 * j + r, at + r), (2 * j + r, at + 2)]);
                    g_values.extend([sign, sign * random.next()]);
                }
            }
        }
        let mass_values = (0..3 * bodies).map(|_| 1.5 + random.next()).collect();
        Sample { mass: Pattern::diagonal(3 * bodies), mass_values, g, g_values }
    }

    /// Bodies of a dimension with the points that join them (0 is the ground), as whole blocks [s I | a] of G, and rods
    /// of one row between the first bodies; also the blocks that are levers.
    pub fn points(
        dimension: usize,
        bodies: usize,
        joints: &[(usize, usize)],
        rods: usize,
        random: &mut Random,
    ) -> (Self, Vec<Lever>) {
        let width = dimension * (dimension + 1) / 2;
        let n = width * bodies;
        let mut g = Pattern { rows: 0, cols: n, entries: vec![] };
        let mut g_values = vec![];
        let mut levers = vec![];
        let pairs = joints.iter().map(|&pair| (pair, dimension)).chain((1..=rods).map(|k| ((k, k + 1), 1)));
        for ((a, b), rows) in pairs {
            for (body, sign) in [(a, -1.0), (b, 1.0)].into_iter().filter(|(body, _)| *body > 0) {
                if rows > 1 {
                    levers.push(Lever { first_entry: g.entries.len(), sign });
                }
                for (row, i) in (0..rows).flat_map(|row| (0..width).map(move |i| (row, i))) {
                    g.entries.push((g.rows + row, width * (body - 1) + i));
                    let translation = if i == row { sign } else { 0.0 };
                    g_values.push(if rows > 1 && i < dimension { translation } else { random.next() });
                }
            }
            g.rows += rows;
        }
        let mass_values = (0..n).map(|_| 1.5 + random.next()).collect();
        (Sample { mass: Pattern::diagonal(n), mass_values, g, g_values }, levers)
    }

    /// Seven bodies and ten joints in three loops, one degree of freedom (Andrews' mechanism): n = 21, m = 20.
    pub fn mechanism(random: &mut Random) -> Self {
        let joints = [(1, 0), (1, 2), (2, 3), (2, 4), (2, 6), (3, 0), (4, 5), (5, 0), (6, 7), (7, 0)];
        Self::planar(7, &joints, random)
    }

    /// Links one behind the other, from the ground.
    pub fn chain(links: usize, random: &mut Random) -> Self {
        let joints: Vec<_> = (0..links).map(|k| (k + 1, k)).collect();
        Self::planar(links, &joints, random)
    }

    /// A square grid of points in the plane, rods along all its edges.
    pub fn net(side: usize, random: &mut Random) -> Self {
        let point = |x: usize, y: usize| 2 * (y * side + x);
        let mut pairs = vec![];
        for y in 0..side {
            for x in 0..side {
                if x + 1 < side {
                    pairs.push((point(x, y), point(x + 1, y)));
                }
                if y + 1 < side {
                    pairs.push((point(x, y), point(x, y + 1)));
                }
            }
        }
        let n = 2 * side * side;
        let entries = pairs.iter().enumerate().flat_map(|(j, &(a, b))| [(j, a), (j, a + 1), (j, b), (j, b + 1)]);
        let g = Pattern { rows: pairs.len(), cols: n, entries: entries.collect() };
        let g_values = random.vector(g.entries.len());
        Sample { mass: Pattern::diagonal(n), mass_values: vec![1.0; n], g, g_values }
    }

    /// Appends the combination sum c_k row_k as a row of G.
    pub fn append(&mut self, combination: &[(usize, f64)]) {
        let row = self.g.rows;
        self.g.rows += 1;
        for &(from, c) in combination {
            for k in 0..self.g.entries.len() {
                let (i, j) = self.g.entries[k];
                if i == from {
                    self.g.entries.push((row, j));
                    self.g_values.push(c * self.g_values[k]);
                }
            }
        }
    }

    pub fn sizes(&self) -> (usize, usize) {
        (self.mass.rows, self.g.rows)
    }

    pub fn matrix(&self) -> Mat<f64> {
        let (n, m) = self.sizes();
        let mut k = Mat::zeros(n + m, n + m);
        for (&(i, j), v) in self.mass.entries.iter().zip(&self.mass_values) {
            k[(i, j)] += v;
            if i != j {
                k[(j, i)] += v;
            }
        }
        for (&(j, i), v) in self.g.entries.iter().zip(&self.g_values) {
            k[(n + j, i)] += v;
            k[(i, n + j)] += v;
        }
        k
    }

    /// (a, lambda) by full-pivot LU.
    pub fn by_lu(&self, r1: &[f64], r2: &[f64]) -> (Vec<f64>, Vec<f64>) {
        self.apply(r1, r2, |rhs| self.matrix().full_piv_lu().solve(&rhs))
    }

    /// (a, lambda) by the pseudo-inverse: least squares and least norm. With M positive definite its null space is that
    /// of G^T, so the least norm is that of lambda.
    pub fn by_svd(&self, r1: &[f64], r2: &[f64]) -> (Vec<f64>, Vec<f64>) {
        self.apply(r1, r2, |rhs| {
            let k = self.matrix();
            let svd = k.svd().unwrap();
            let u = svd.U();
            let s = svd.S().column_vector();
            let v = svd.V();
            let mut c = u.transpose() * &rhs;
            for i in 0..c.nrows() {
                c[(i, 0)] = if s[i] > 1e-11 * s[0] { c[(i, 0)] / s[i] } else { 0.0 };
            }
            v * c
        })
    }

    /// As `by_lu` without the last row of G.
    pub fn by_lu_without_last(&self, r1: &[f64], r2: &[f64]) -> (Vec<f64>, Vec<f64>) {
        let mut sample = self.clone();
        sample.g.rows -= 1;
        let kept = self.g.entries.iter().zip(&self.g_values).filter(|(e, _)| e.0 < sample.g.rows);
        (sample.g.entries, sample.g_values) = kept.map(|(e, v)| (*e, *v)).unzip();
        sample.by_lu(r1, &r2[..sample.g.rows])
    }

    fn apply(&self, r1: &[f64], r2: &[f64], f: impl FnOnce(Mat<f64>) -> Mat<f64>) -> (Vec<f64>, Vec<f64>) {
        let n = r1.len();
        let rhs = Mat::from_fn(n + r2.len(), 1, |i, _| if i < n { r1[i] } else { r2[i - n] });
        let x = f(rhs);
        ((0..n).map(|i| x[(i, 0)]).collect(), (n..n + r2.len()).map(|i| x[(i, 0)]).collect())
    }
}

/// max |x - y| / max |y|.
pub fn distance(x: &[f64], y: &[f64]) -> f64 {
    let size = y.iter().fold(1e-300, |s: f64, v| s.max(v.abs()));
    x.iter().zip(y).fold(0.0, |d: f64, (x, y)| d.max((x - y).abs())) / size
}
