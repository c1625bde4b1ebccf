use super::super::{Complex, Matrix, Unsolved, dense, eigen};
use super::samples::{Random, distance, residual};

fn c(re: f64, im: f64) -> Complex<f64> {
    Complex::new(re, im)
}

#[test]
fn an_oscillator_has_conjugate_eigenvalues() {
    let found = eigen(&Matrix::from_row_slice(2, 2, &[0.0, 1.0, -25.0, 0.0])).unwrap();
    assert!((found.values[1] - c(0.0, 5.0)).norm() < 2e-15 && found.values[0] == found.values[1].conj());
    assert_eq!(found.right.column(0).map(|x| x.conj()), found.right.column(1));
    assert!((found.conditioning - 5.0).abs() < 1e-13);
}

#[test]
fn no_rows_and_one_row() {
    let none = eigen(&Matrix::zeros(0, 0)).unwrap();
    assert!(none.values.is_empty() && none.conditioning == 1.0);
    let one = eigen(&Matrix::from_element(1, 1, -3.0)).unwrap();
    assert_eq!((one.values[0], one.left[(0, 0)] * one.right[(0, 0)]), (c(-3.0, 0.0), c(1.0, 0.0)));
    assert_eq!(eigen(&Matrix::zeros(3, 3)).unwrap().values, [c(0.0, 0.0); 3]);
}

#[test]
fn nonsense_is_an_error() {
    for bad in [f64::NAN, f64::INFINITY] {
        assert_eq!(eigen(&Matrix::from_element(3, 3, bad)), Err(Unsolved::NotFinite));
    }
    assert_eq!(eigen(&Matrix::zeros(2, 3)), Err(Unsolved::Shape));
}

#[test]
fn left_and_right_vectors_are_biorthogonal() {
    for (n, seed) in [(2, 1), (7, 2), (14, 3), (40, 4), (120, 5)] {
        let a = Random(seed).matrix(n, n);
        let found = eigen(&a).unwrap();
        let eye = Matrix::identity(n, n);
        assert!(residual(&a, &eye, &found.values, &found.right) < 1e-14, "{n}");
        let conjugate: Vec<_> = found.values.iter().map(|value| value.conj()).collect();
        assert!(residual(&a.transpose(), &eye, &conjugate, &found.left) < 1e-13, "{n}");
        let product = found.left.adjoint() * &found.right - dense::complex(&eye);
        assert!(product.norm() < 1e-11, "{n}: {}", product.norm());
        assert!(found.values.iter().filter(|x| x.im != 0.0).all(|x| found.values.contains(&x.conj())));
    }
}

#[test]
fn a_defective_eigenvalue_has_no_left_vector() {
    let a = Matrix::from_row_slice(3, 3, &[0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, -2.0]);
    let found = eigen(&a).unwrap();
    assert_eq!(found.conditioning, f64::INFINITY);
    assert_eq!(found.left.column(0).norm(), 0.0);
    assert_eq!(found.left[(2, 2)] * found.right[(2, 2)], c(1.0, 0.0));
    // A chain so long that back substitution overflows.
    for n in [25, 60] {
        let a = Matrix::from_fn(n, n, |i, j| if j == i + 1 { 100.0 } else { f64::from(i == j) });
        let found = eigen(&a).unwrap();
        assert!(found.values.iter().all(|value| *value == c(1.0, 0.0)));
        assert!(found.right.iter().chain(found.left.iter()).all(|x| x.is_finite()));
    }
}

#[test]
fn equal_eigenvalues_with_all_vectors_are_biorthogonal() {
    let mut random = Random(3);
    let s = random.matrix(4, 4);
    let a = &s * Matrix::from_diagonal(&nalgebra::dvector![2.0, 2.0, 2.0, -1.0]) * s.clone().try_inverse().unwrap();
    let found = eigen(&a).unwrap();
    let product = found.left.adjoint() * &found.right;
    assert!((product - dense::complex(&Matrix::identity(4, 4))).norm() < 1e-7);
}

#[test]
fn balancing_keeps_badly_scaled_states_accurate() {
    for seed in 0..20 {
        let mut random = Random(seed);
        let n = 8;
        let a = random.matrix(n, n);
        let d = random.powers(n, 8.0);
        let scaled = Matrix::from_fn(n, n, |i, j| a[(i, j)] * d[i] / d[j]);
        let plain = eigen(&a).unwrap();
        let found = eigen(&scaled).unwrap();
        assert!(distance(&found.values, &plain.values, 0) < 1e-12 * plain.conditioning);
    }
}

#[test]
fn extreme_sizes_neither_hang_nor_overflow() {
    for size in [1e-300, 1e-160, 1e160, 1e300] {
        let a = Matrix::from_row_slice(2, 2, &[0.0, size, -size, 0.0]);
        let found = eigen(&a).unwrap();
        assert!((found.values[1].im / size - 1.0).abs() < 1e-15, "{size}");
    }
    let mixed = Matrix::from_row_slice(3, 3, &[1.0, 1e200, 3.0, 1e-200, 2.0, 1e-150, 1.0, 1e150, 3.0]);
    assert!(eigen(&mixed).unwrap().right.iter().all(|x| x.is_finite()));
}

#[test]
fn any_matrix_has_eigenvalues_that_sum_to_its_trace() {
    for seed in 0..256 {
        let mut random = Random(seed);
        let n = 1 + seed as usize % 8;
        let zeros = random.next().abs();
        let a = Matrix::from_fn(n, n, |_, _| if random.next().abs() < zeros { 0.0 } else { random.next() });
        let found = eigen(&a).unwrap();
        let sum: Complex<f64> = found.values.iter().sum();
        assert!((sum - a.trace()).norm() < 1e-13 * n as f64, "{seed}");
        assert!(found.left.iter().chain(found.right.iter()).all(|x| x.is_finite()), "{seed}");
        assert!(found.values.windows(2).all(|pair| pair[0].norm() <= pair[1].norm()), "{seed}");
    }
}

/// The error of a double eigenvalue with one vector is far below the value itself.
#[test]
fn a_defective_value_is_not_taken_for_zero() {
    let a = Matrix::from_row_slice(3, 3, &[-5.0, 1.0, 0.0, 0.0, -5.0, 0.0, 0.0, 0.0, 20.0]);
    let found = eigen(&a).unwrap();
    for (value, error) in found.values.iter().zip(&found.errors) {
        assert!(value.norm() > 4.9 && *error < 1e-5, "{value}: {error:e}");
    }
}
