use super::super::{Matrix, eigen};

/// A chain of n masses and n + 1 springs: omega = 2 sin(i pi / (2 (n + 1))).
#[test]
fn an_undamped_chain_by_its_stiffness() {
    let n = 60;
    let a = Matrix::from_fn(2 * n, 2 * n, |i, j| match (i < n, j < n) {
        (true, true) => 0.0,
        (true, false) => f64::from(u8::from(i == j - n)),
        (false, true) if i - n == j => -2.0,
        (false, true) => f64::from(u8::from((i - n).abs_diff(j) == 1)),
        (false, false) => 0.0,
    });
    let found = eigen(&a).unwrap();
    for (i, value) in found.values.iter().enumerate() {
        let known = 2.0 * ((i / 2 + 1) as f64 * std::f64::consts::PI / (2.0 * (n + 1) as f64)).sin();
        assert!(value.re == 0.0 && (value.norm() - known).abs() < 1e-13, "{i}: {value} {known}");
        assert!((value.im < 0.0) == (i % 2 == 0) && found.errors[i] < 1e-12, "{i}: {value}");
    }
    let values = nalgebra::DMatrix::from_diagonal(&nalgebra::DVector::from_vec(found.values.clone()));
    let complex = a.map(nalgebra::Complex::from);
    assert!((&complex * &found.right - &found.right * &values).norm() < 1e-12);
    assert!((found.left.adjoint() * &complex - &values * found.left.adjoint()).norm() < 1e-10);
    let eye = nalgebra::DMatrix::identity(2 * n, 2 * n);
    assert!((found.left.adjoint() * &found.right - eye).norm() < 1e-11);
    // With a little damping it is the other algorithm, and the same to first order.
    let mut damped = a.clone();
    (0..n).for_each(|i| damped[(n + i, n + i)] = -1e-9);
    let other = eigen(&damped).unwrap();
    let off = other.values.iter().zip(&found.values).map(|(a, b)| (a - b).norm()).fold(0.0, f64::max);
    assert!(off < 1e-9, "{off:e}");
    assert!(
        (other.conditioning / found.conditioning - 1.0).abs() < 1e-6,
        "{} {}",
        other.conditioning,
        found.conditioning
    );
}
