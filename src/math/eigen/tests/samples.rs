//! Mechanisms as pencils, with eigenvalues known otherwise.

use super::super::{Complex, ComplexMatrix, Matrix, dense, eigen};

pub struct Random(pub u64);

impl Random {
    /// Next number in (-1, 1).
    pub fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        ((self.0 >> 33) as f64) / (1u64 << 30) as f64 - 1.0
    }

    pub fn matrix(&mut self, rows: usize, cols: usize) -> Matrix {
        Matrix::from_fn(rows, cols, |_, _| self.next())
    }

    pub fn powers(&mut self, n: usize, largest: f64) -> Vec<f64> {
        (0..n).map(|_| 10f64.powf(largest * self.next())).collect()
    }
}

#[derive(Clone)]
pub struct Mechanism {
    pub m: Matrix,
    pub c: Matrix,
    pub k: Matrix,
    pub g: Matrix,
}

pub fn two_mass() -> Mechanism {
    Mechanism {
        m: Matrix::from_diagonal(&nalgebra::dvector![1.0, 3.0]),
        c: Matrix::zeros(2, 2),
        k: Matrix::from_diagonal(&nalgebra::dvector![100.0, 0.0]),
        g: Matrix::from_row_slice(1, 2, &[-1.0, 1.0]),
    }
}

pub fn random(n: usize, m: usize, seed: u64) -> Mechanism {
    let mut random = Random(seed);
    let a = random.matrix(n, n);
    let k = random.matrix(n, n);
    let c = random.matrix(n, n);
    Mechanism {
        m: &a * a.transpose() + Matrix::identity(n, n),
        c: c * 0.3,
        k: &k + k.transpose(),
        g: random.matrix(m, n),
    }
}

/// Links of three coordinates each, joined end to end by two rows, hanging: 7 rows a link at index 3.
pub fn chain(links: usize) -> Mechanism {
    let n = 3 * links;
    let mut mass = Matrix::identity(n, n);
    let mut k = Matrix::zeros(n, n);
    let mut g = Matrix::zeros(2 * links, n);
    for i in 0..links {
        mass[(3 * i + 2, 3 * i + 2)] = 1.0 / 12.0;
        // Restoring moment by the weight of the links below.
        k[(3 * i + 2, 3 * i + 2)] = 9.81 * (links - i) as f64 - 4.9;
        // End of the link before, and start of this one, x and z: angles act at half a length across.
        (g[(2 * i, 3 * i)], g[(2 * i, 3 * i + 2)], g[(2 * i + 1, 3 * i + 1)]) = (1.0, -0.5, 1.0);
        if i > 0 {
            let j = 3 * (i - 1);
            (g[(2 * i, j)], g[(2 * i, j + 2)], g[(2 * i + 1, j + 1)]) = (-1.0, -0.5, -1.0);
        }
    }
    Mechanism { m: mass, c: Matrix::zeros(n, n), k, g }
}

pub enum Form {
    Index3,
    Index2,
    Index1,
    Ggl,
}

impl Mechanism {
    /// Returns A, E, the number of infinite eigenvalues, and the number of zero ones in addition to the finite ones.
    pub fn pencil(&self, form: &Form) -> (Matrix, Matrix, usize, usize) {
        let (m, n) = self.g.shape();
        let size = 2 * n + m * if matches!(form, Form::Ggl) { 2 } else { 1 };
        let mut a = Matrix::zeros(size, size);
        let mut e = Matrix::zeros(size, size);
        e.view_mut((0, 0), (n, n)).fill_with_identity();
        e.view_mut((n, n), (n, n)).copy_from(&self.m);
        a.view_mut((0, n), (n, n)).fill_with_identity();
        a.view_mut((n, 0), (n, n)).copy_from(&-&self.k);
        a.view_mut((n, n), (n, n)).copy_from(&-&self.c);
        a.view_mut((n, 2 * n), (n, m)).copy_from(&-self.g.transpose());
        match form {
            Form::Index3 => a.view_mut((2 * n, 0), (m, n)).copy_from(&self.g),
            Form::Index2 => a.view_mut((2 * n, n), (m, n)).copy_from(&self.g),
            Form::Index1 => e.view_mut((2 * n, n), (m, n)).copy_from(&self.g),
            Form::Ggl => {
                a.view_mut((0, 2 * n + m), (n, m)).copy_from(&-self.g.transpose());
                a.view_mut((2 * n, 0), (m, n)).copy_from(&self.g);
                a.view_mut((2 * n + m, n), (m, n)).copy_from(&self.g);
            }
        }
        match form {
            Form::Index3 => (a, e, 3 * m, 0),
            Form::Index2 => (a, e, 2 * m, m),
            Form::Index1 => (a, e, m, 2 * m),
            Form::Ggl => (a, e, 4 * m, 0),
        }
    }

    /// Eigenvalues of R^T (M s^2 + C s + K) R with G R = 0, by magnitude.
    pub fn values(&self) -> Vec<Complex<f64>> {
        let (m, n) = self.g.shape();
        let r = dense::svd(&self.g).unwrap().v.columns(m, n - m).into_owned();
        let reduce = |matrix: &Matrix| r.transpose() * matrix * &r;
        let mass = reduce(&self.m).lu();
        let d = n - m;
        let mut a = Matrix::zeros(2 * d, 2 * d);
        a.view_mut((0, d), (d, d)).fill_with_identity();
        a.view_mut((d, 0), (d, d)).copy_from(&-mass.solve(&reduce(&self.k)).unwrap());
        a.view_mut((d, d), (d, d)).copy_from(&-mass.solve(&reduce(&self.c)).unwrap());
        eigen(&a).unwrap().values
    }
}

/// Largest |found - expected| / |expected|, each paired with the nearest that is left; those of `zeros` expected ones
/// are left out of `found`.
pub fn distance(found: &[Complex<f64>], expected: &[Complex<f64>], zeros: usize) -> f64 {
    assert_eq!(found.len(), expected.len() + zeros);
    let mut left: Vec<Complex<f64>> = found[zeros..].to_vec();
    let mut largest: f64 = 0.0;
    for value in expected {
        let nearest = (0..left.len()).min_by(|&i, &j| (left[i] - value).norm().total_cmp(&(left[j] - value).norm()));
        let near = left.swap_remove(nearest.unwrap());
        largest = largest.max((near - value).norm() / value.norm().max(1e-300));
    }
    largest
}

/// Largest |A x - lambda E x| / (|A| + |lambda| |E|) over the columns x of norm 1.
pub fn residual(a: &Matrix, e: &Matrix, values: &[Complex<f64>], x: &ComplexMatrix) -> f64 {
    let a = dense::complex(a);
    let e = dense::complex(e);
    let mut largest: f64 = 0.0;
    for (j, value) in values.iter().enumerate() {
        let x = x.columns(j, 1);
        let size = a.norm() + value.norm() * e.norm();
        largest = largest.max((&a * x - (&e * x) * *value).norm() / size / x.norm());
    }
    largest
}
