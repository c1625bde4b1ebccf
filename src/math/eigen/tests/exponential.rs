use super::super::{Matrix, Unsolved, expm};
use super::samples::Random;

fn close(found: &Matrix, expected: &Matrix, tolerance: f64) -> bool {
    (found - expected).amax() <= tolerance * expected.amax().max(f64::MIN_POSITIVE)
}

/// exp(A) = exp(A / 2^k)^(2^k), the series for |A / 2^k| < 1/8.
fn series(a: &Matrix) -> Matrix {
    let halvings = (a.norm() * 8.0).max(1.0).log2().ceil() as i32;
    let small = a / 2f64.powi(halvings);
    let mut sum = Matrix::identity(a.nrows(), a.nrows());
    let mut term = Matrix::identity(a.nrows(), a.nrows());
    for k in 1..30 {
        term = &term * &small / f64::from(k);
        sum += &term;
    }
    (0..halvings).fold(sum, |power, _| &power * &power)
}

#[test]
fn closed_forms() {
    let w = 5.0;
    let h = 0.3;
    let oscillator = Matrix::from_row_slice(2, 2, &[0.0, 1.0, -w * w, 0.0]) * h;
    let (s, c) = f64::sin_cos(w * h);
    assert!(close(&expm(&oscillator).unwrap(), &Matrix::from_row_slice(2, 2, &[c, s / w, -w * s, c]), 1e-15));
    let nilpotent = Matrix::from_row_slice(3, 3, &[0.0, 2.0, 3.0, 0.0, 0.0, 4.0, 0.0, 0.0, 0.0]);
    let expected = Matrix::from_row_slice(3, 3, &[1.0, 2.0, 7.0, 0.0, 1.0, 4.0, 0.0, 0.0, 1.0]);
    assert!(close(&expm(&nilpotent).unwrap(), &expected, 1e-15));
    let stiff = Matrix::from_row_slice(2, 2, &[-1e6, 0.0, 1.0, -1.0]);
    let decays = expm(&stiff).unwrap();
    assert!((decays[(1, 1)] - (-1f64).exp()).abs() < 1e-9 && decays[(0, 0)].abs() < 1e-300);
}

#[test]
fn a_hump_does_not_spoil_it() {
    // Moler and Van Loan's example: exact [-0.7357588823, 0.5518190996; -1.4715175991, 1.1036382408].
    let found = expm(&Matrix::from_row_slice(2, 2, &[-49.0, 24.0, -64.0, 31.0])).unwrap();
    let slow = (-1f64).exp();
    let fast = (-17f64).exp();
    let exact = [-2.0 * slow + 3.0 * fast, 1.5 * slow - 1.5 * fast, -4.0 * slow + 4.0 * fast, 3.0 * slow - 2.0 * fast];
    assert!(close(&found, &Matrix::from_row_slice(2, 2, &exact), 1e-13));
}

#[test]
fn limits() {
    assert_eq!(expm(&Matrix::zeros(0, 0)).unwrap().nrows(), 0);
    assert_eq!(expm(&Matrix::zeros(3, 3)).unwrap(), Matrix::identity(3, 3));
    assert_eq!(expm(&Matrix::from_element(2, 2, f64::NAN)), Err(Unsolved::NotFinite));
    assert_eq!(expm(&(Matrix::identity(2, 2) * 1000.0)), Err(Unsolved::Overflow));
    assert_eq!(expm(&(Matrix::identity(1, 1) * 1000.0)), Err(Unsolved::Overflow));
    assert_eq!(expm(&(Matrix::identity(2, 2) * -1e300)).unwrap(), Matrix::zeros(2, 2));
    assert_eq!(expm(&Matrix::zeros(2, 3)), Err(Unsolved::Shape));
}

#[test]
fn agrees_with_the_series() {
    for seed in 0..256 {
        let mut random = Random(seed);
        let n = 1 + seed as usize % 7;
        let size = -0.9 + 2.1 * random.next();
        let a = random.matrix(n, n) * 10f64.powf(size);
        let found = expm(&a).unwrap();
        let error = (&found - series(&a)).amax() / found.amax();
        assert!(error < 1e-14 * (1.0 + a.norm()) * n as f64, "{seed}: {error}");
    }
}
