//! Dense LU with partial pivoting, unrolled by constant sizes.

const N: usize = 13;

pub struct Lu {
    pub matrix: [[f64; N]; N],
    pivots: [usize; N],
}

macro_rules! for_each_column {
    ($call:ident, $($arguments:expr),*) => {
        $call::<0>($($arguments),*); $call::<1>($($arguments),*); $call::<2>($($arguments),*);
        $call::<3>($($arguments),*); $call::<4>($($arguments),*); $call::<5>($($arguments),*);
        $call::<6>($($arguments),*); $call::<7>($($arguments),*); $call::<8>($($arguments),*);
        $call::<9>($($arguments),*); $call::<10>($($arguments),*); $call::<11>($($arguments),*);
        $call::<12>($($arguments),*);
    };
}

impl Lu {
    pub fn new() -> Self {
        Lu { matrix: [[0.0; N]; N], pivots: [0; N] }
    }

    /// Factors `matrix` in place.
    pub fn factor(&mut self) {
        for_each_column!(eliminate, &mut self.matrix, &mut self.pivots);
    }

    pub fn solve(&self, mut x: [f64; N]) -> [f64; N] {
        self.pivots.iter().enumerate().for_each(|(k, &pivot)| x.swap(k, pivot));
        for_each_column!(forward, &self.matrix, &mut x);
        for_each_column!(backward, &self.matrix, &mut x);
        x
    }
}

#[inline(always)]
fn eliminate<const K: usize>(a: &mut [[f64; N]; N], pivots: &mut [usize; N]) {
    let mut pivot = K;
    for i in K + 1..N {
        if a[i][K].abs() > a[pivot][K].abs() {
            pivot = i;
        }
    }
    pivots[K] = pivot;
    a.swap(K, pivot);
    let row = a[K];
    let inverse = 1.0 / row[K];
    for other in &mut a[K + 1..] {
        let factor = other[K] * inverse;
        other[K] = factor;
        for j in K + 1..N {
            other[j] -= factor * row[j];
        }
    }
}

#[inline(always)]
fn forward<const K: usize>(a: &[[f64; N]; N], x: &mut [f64; N]) {
    for i in K + 1..N {
        x[i] -= a[i][K] * x[K];
    }
}

/// Column N - 1 - K.
#[inline(always)]
fn backward<const K: usize>(a: &[[f64; N]; N], x: &mut [f64; N]) {
    let k = N - 1 - K;
    x[k] /= a[k][k];
    for i in 0..k {
        x[i] -= a[i][k] * x[k];
    }
}
