use super::super::{Complex, Matrix, Options, Partial, Scalar, Unsolved, dense, eigen, nearest};
use super::samples::{Form, Random, chain, residual};
use crate::math::kkt::Singular;
use nalgebra::DVector;

type C = Complex<f64>;

/// |apply(Q) - Q T| with T = Q^H apply(Q), over |T|.
fn residual_of<T: Scalar>(found: &Partial<T>, mut apply: impl FnMut(&[T], &mut [T]) -> Result<(), Unsolved>) -> f64 {
    let q = &found.basis;
    let mut image = q.clone();
    q.column_iter().zip(image.column_iter_mut()).for_each(|(x, mut y)| {
        apply(x.clone_owned().as_slice(), y.as_mut_slice()).unwrap();
    });
    let t = q.adjoint() * &image;
    (image - q * &t).norm() / t.norm()
}

fn diagonal(values: Vec<C>) -> impl FnMut(&[C], &mut [C]) -> Result<(), Unsolved> {
    move |x, y| {
        y.iter_mut().zip(x.iter().zip(&values)).for_each(|(y, (x, d))| *y = x * d);
        Ok(())
    }
}

#[test]
fn largest_of_a_diagonal() {
    let values: Vec<C> = (0..2000).map(|i| C::new(0.999f64.powi(i), 0.3 * f64::from(i % 7)) / 2.0).collect();
    let found = nearest(2000, 6, diagonal(values.clone()), Options::default()).unwrap();
    let mut expected = values.clone();
    expected.sort_by(|a, b| b.norm().total_cmp(&a.norm()));
    for (value, expected) in found.values.iter().zip(&expected) {
        assert!((value - expected).norm() < 1e-11, "{value} {expected}");
    }
    assert!(residual_of(&found, diagonal(values)) < 1e-10);
}

/// (A - sigma)^-1 of the second difference matrix by Thomas' algorithm.
fn shifted_tridiagonal(n: usize, sigma: C) -> impl FnMut(&[C], &mut [C]) -> Result<(), Unsolved> {
    move |x, y| {
        let d = C::new(2.0, 0.0) - sigma;
        let mut c = vec![C::ZERO; n];
        for i in 0..n {
            let pivot = if i == 0 { d } else { d + c[i - 1] };
            c[i] = -pivot.inv();
            y[i] = (x[i] + if i == 0 { C::ZERO } else { y[i - 1] }) / pivot;
        }
        for i in (0..n - 1).rev() {
            let next = y[i + 1];
            y[i] -= c[i] * next;
        }
        Ok(())
    }
}

#[test]
fn shift_and_invert_finds_the_nearest() {
    let n = 2000;
    let exact = |k: usize| 2.0 - 2.0 * (k as f64 * std::f64::consts::PI / (n as f64 + 1.0)).cos();
    let sigma = C::new(0.1, 1e-3);
    let found = nearest(n, 10, shifted_tridiagonal(n, sigma), Options::default()).unwrap();
    let mut all: Vec<f64> = (1..=n).map(exact).collect();
    all.sort_by(|a, b| (C::from(*a) - sigma).norm().total_cmp(&(C::from(*b) - sigma).norm()));
    for (theta, expected) in found.values.iter().zip(all) {
        let value = sigma + theta.inv();
        assert!((value - expected).norm() < 1e-11, "{value} {expected}");
    }
}

/// y = A x in real or complex numbers.
fn times<T: Scalar>(a: &Matrix) -> impl FnMut(&[T], &mut [T]) -> Result<(), Unsolved> {
    move |x, y| {
        let row = |i: usize| (0..a.ncols()).fold(T::ZERO, |sum, j| sum + x[j] * T::from_real(a[(i, j)]));
        y.iter_mut().enumerate().for_each(|(i, y)| *y = row(i));
        Ok(())
    }
}

#[test]
fn a_subspace_of_all_rows_gives_all_eigenvalues() {
    let a = Random(4).matrix(12, 12);
    let complex = nearest(12, 12, times::<C>(&a), Options::default()).unwrap();
    let real = nearest(12, 12, times::<f64>(&a), Options::default()).unwrap();
    assert!(residual_of(&complex, times(&a)) < 1e-12 && residual_of(&real, times(&a)) < 1e-12);
    let mut expected = eigen(&a).unwrap().values;
    expected.reverse();
    for (value, expected) in complex.values.iter().chain(&real.values).zip(expected.iter().chain(&expected)) {
        assert!((value.norm() - expected.norm()).abs() < 1e-12);
    }
}

/// Restarts in real numbers keep both of a pair: for any count the space is invariant and holds the largest.
#[test]
fn a_real_operator_has_real_spaces() {
    let n = 150;
    let a = Random(9).matrix(n, n);
    let mut expected = eigen(&a).unwrap().values;
    expected.sort_by(|a, b| b.norm().total_cmp(&a.norm()));
    for count in 1..12 {
        let options = Options { subspace: Some(2 * count + 12), repeats: true, ..Options::default() };
        let found = nearest(n, count, times::<f64>(&a), options).unwrap();
        assert!(found.values.len() - count <= 1 && found.values.len() == found.basis.ncols());
        assert!(found.values.iter().map(|value| value.im).sum::<f64>().abs() < 1e-12, "a pair is parted");
        for (value, expected) in found.values.iter().zip(&expected) {
            assert!((value.norm() - expected.norm()).abs() < 1e-10 * expected.norm(), "{value} {expected}");
        }
        assert!(residual_of(&found, times(&a)) < 1e-10);
    }
}

#[test]
fn invariant_subspaces_and_equal_eigenvalues() {
    // Rank two: the space is exhausted after two steps, again and again.
    let mut values = vec![C::ZERO; 300];
    (values[17], values[200]) = (C::new(3.0, 0.0), C::new(0.0, 2.0));
    let found = nearest(300, 3, diagonal(values), Options::default()).unwrap();
    assert!((found.values[0] - 3.0).norm() < 1e-13 && (found.values[1] - C::new(0.0, 2.0)).norm() < 1e-13);
    assert!(found.values[2].norm() < 1e-13);
    let equal = nearest(50, 4, diagonal(vec![C::new(2.0, 0.0); 50]), Options::default()).unwrap();
    assert!(equal.values.iter().all(|value| (value - 2.0).norm() < 1e-13));
    let zero = nearest(50, 4, diagonal(vec![C::ZERO; 50]), Options::default()).unwrap();
    assert_eq!(zero.values, [C::ZERO; 4]);
}

#[test]
fn a_defective_eigenvalue_converges_to_half_precision() {
    fn jordan<T: Scalar>(x: &[T], y: &mut [T]) -> Result<(), Unsolved> {
        (0..400).for_each(|i| y[i] = x[i] * T::from_real(1.0 / (1.0 + (i / 2) as f64)));
        y[0] += x[1];
        Ok(())
    }
    let complex = nearest(400, 3, jordan::<C>, Options::default()).unwrap();
    let real = nearest(400, 3, jordan::<f64>, Options::default()).unwrap();
    assert!(complex.values[..2].iter().chain(&real.values[..2]).all(|value| (value - 1.0).norm() < 1e-6));
    assert!(residual_of(&complex, jordan) < 1e-10 && residual_of(&real, jordan) < 1e-10);
}

/// A double pair with one vector beside real eigenvalues: blocks of two rows change places with each other and with
/// single ones.
#[test]
fn defective_pairs_of_a_real_operator() {
    let n = 300;
    let mut a = Matrix::from_diagonal(&DVector::from_fn(n, |i, _| 0.9 / (1.0 + i as f64)));
    for (at, size) in [(100, 0.5), (102, 0.5), (200, 1.0), (202, 1.0)] {
        a.view_mut((at, at), (2, 2)).copy_from(&(Matrix::from_row_slice(2, 2, &[0.6, 0.8, -0.8, 0.6]) * size));
    }
    (a[(100, 102)], a[(101, 103)], a[(200, 202)], a[(201, 203)]) = (1.0, 1.0, 1.0, 1.0);
    let found = nearest(n, 10, times::<f64>(&a), Options::default()).unwrap();
    let expected = [1.0, 1.0, 1.0, 1.0, 0.9, 0.5, 0.5, 0.5, 0.5, 0.45];
    for (value, expected) in found.values.iter().zip(expected) {
        assert!((value.norm() - expected).abs() < 1e-6, "{value} {expected}");
    }
    assert!(residual_of(&found, times(&a)) < 1e-10);
}

#[test]
fn failures_are_reported() {
    let few = Options { restarts: 1, tolerance: 1e-15, ..Options::default() };
    let close: Vec<C> = (0..2000).map(|i| C::new(1.0 + 1e-6 * f64::from(i), 0.0)).collect();
    let Err(Unsolved::NotConverged { converged, wanted: 5 }) = nearest(2000, 5, diagonal(close), few) else { panic!() };
    assert!(converged < 5);
    let fails = |_: &[C], _: &mut [C]| Err(Singular::NotFactored.into());
    assert_eq!(nearest(5, 1, fails, Options::default()), Err(Unsolved::Operator(Singular::NotFactored)));
    let broken = |_: &[C], y: &mut [C]| {
        y.fill(C::new(f64::NAN, 0.0));
        Ok(())
    };
    assert_eq!(nearest(5, 1, broken, Options::default()), Err(Unsolved::NotFinite));
    assert!(nearest(0, 3, diagonal(Vec::new()), Options::default()).unwrap().values.is_empty());
}

#[test]
fn the_same_every_time() {
    let values: Vec<C> = Matrix::from_fn(200, 1, |i, _| 1.0 / (1.0 + i as f64)).iter().map(|x| C::from(*x)).collect();
    let once = nearest(200, 4, diagonal(values.clone()), Options::default());
    assert_eq!(once, nearest(200, 4, diagonal(values), Options::default()));
}

/// (A - sigma E)^-1 E of a chain at index 3: infinite eigenvalues in blocks of three are eigenvalues zero of it.
#[test]
fn infinite_eigenvalues_do_not_disturb() {
    let mechanism = chain(20);
    let (a, e, ..) = mechanism.pencil(&Form::Index3);
    let sigma = C::new(0.0, 3.0);
    let lu = (dense::complex(&a) - dense::complex(&e) * sigma).lu();
    let n = a.nrows();
    let e = dense::complex(&e);
    let apply = |x: &[C], y: &mut [C]| {
        let image = lu.solve(&(&e * DVector::from_column_slice(x))).ok_or(Singular::NotFactored)?;
        y.copy_from_slice(image.as_slice());
        Ok(())
    };
    let found = nearest(n, 6, apply, Options::default()).unwrap();
    let mut exact = mechanism.values();
    exact.sort_by(|x, y| (x - sigma).norm().total_cmp(&(y - sigma).norm()));
    for (theta, exact) in found.values.iter().zip(exact) {
        let value = sigma + theta.inv();
        assert!((value - exact).norm() < 1e-11 * exact.norm(), "{value} {exact}");
    }
    let mut image = found.basis.clone();
    found.basis.column_iter().zip(image.column_iter_mut()).for_each(|(x, mut y)| {
        apply(x.clone_owned().as_slice(), y.as_mut_slice()).unwrap();
    });
    let t = found.basis.adjoint() * image;
    let solved = dense::view(&t).eigen().unwrap();
    let values: Vec<C> = solved.S().column_vector().iter().map(|theta| sigma + theta.inv()).collect();
    let vectors = &found.basis * dense::copy(solved.U());
    assert!(residual(&a, &e.map(|x| x.re), &values, &vectors) < 1e-13);
}
