use super::super::{Matrix, Unsolved, generalized};
use super::samples::{Form, Random, chain, distance, random, residual, two_mass};

#[test]
fn finite_eigenvalues_are_those_of_the_projection() {
    let mechanisms = [two_mass(), random(5, 2, 1), random(9, 4, 2), random(12, 6, 3)];
    for (i, mechanism) in mechanisms.iter().enumerate() {
        for form in [Form::Index3, Form::Index2, Form::Index1, Form::Ggl] {
            let (a, e, infinite, zeros) = mechanism.pencil(&form);
            let split = generalized(&a, &e).unwrap().split(infinite).unwrap();
            let error = distance(&split.values, &mechanism.values(), zeros);
            assert!(error < 1e-10, "{i}: {error}");
            assert!(split.gap > 1e2);
            let simple = split.right.columns(zeros, split.values.len() - zeros).into_owned();
            assert!(simple.column_iter().all(|x| (x.norm() - 1.0).abs() < 1e-14));
            assert!(residual(&a, &e, &split.values[zeros..], &simple) < 1e-13);
        }
    }
}

#[test]
fn conjugates_are_exact() {
    let (a, e, infinite, _) = random(6, 2, 9).pencil(&Form::Index3);
    let found = generalized(&a, &e).unwrap();
    assert!(found.alpha.iter().zip(&found.beta).all(|(alpha, beta)| {
        let at = |x| found.alpha.iter().zip(&found.beta).any(|pair| pair == (&x, beta));
        at(alpha.conj())
    }));
    let split = found.split(infinite).unwrap();
    assert!(split.values.iter().all(|x| split.values.contains(&x.conj())));
}

#[test]
fn many_infinite_eigenvalues_are_told_apart() {
    for links in [9, 12, 15, 20] {
        for form in [Form::Index3, Form::Index1] {
            let mechanism = chain(links);
            let (a, e, infinite, zeros) = mechanism.pencil(&form);
            let found = generalized(&a, &e).unwrap();
            let split = found.split(infinite).unwrap();
            let error = distance(&split.values, &mechanism.values(), zeros);
            eprintln!("QZ n = {}: error {error:.1e}, gap {:.1e}", a.nrows(), split.gap);
            assert!(error < 1e-9);
        }
    }
}

#[test]
fn scaling_of_rows_columns_and_time_does_not_matter() {
    let mut worst: f64 = 0.0;
    for seed in 0..10 {
        let mechanism = random(5, 2, seed);
        let mut numbers = Random(seed + 100);
        for form in [Form::Index3, Form::Index2, Form::Ggl] {
            let (a, e, infinite, zeros) = mechanism.pencil(&form);
            let n = a.nrows();
            let rows = numbers.powers(n, 8.0);
            let cols = numbers.powers(n, 8.0);
            let scaled = |x: &Matrix, s: f64| Matrix::from_fn(n, n, |i, j| x[(i, j)] * rows[i] * cols[j] * s);
            let split = generalized(&scaled(&a, 1e6), &scaled(&e, 1.0)).unwrap().split(infinite).unwrap();
            let expected: Vec<_> = mechanism.values().iter().map(|x| x * 1e6).collect();
            let error = distance(&split.values, &expected, zeros);
            worst = worst.max(error);
        }
    }
    assert!(worst < 1e-9, "{worst}");
}

#[test]
fn a_doubtful_split_is_an_error() {
    let (a, e, infinite, _) = two_mass().pencil(&Form::Index3);
    let found = generalized(&a, &e).unwrap();
    assert!(matches!(found.split(infinite + 1), Err(Unsolved::Doubtful { .. })));
    assert!(matches!(found.split(infinite - 1), Err(Unsolved::Doubtful { .. })));
    assert_eq!(found.split(6), Err(Unsolved::Shape));
}

#[test]
fn nonsense_is_an_error() {
    let eye = Matrix::identity(2, 2);
    assert_eq!(generalized(&eye, &Matrix::zeros(3, 3)), Err(Unsolved::Shape));
    assert_eq!(generalized(&eye, &(&eye * f64::NAN)), Err(Unsolved::NotFinite));
    assert_eq!(generalized(&Matrix::zeros(2, 2), &Matrix::zeros(2, 2)), Err(Unsolved::SingularPencil { dependent: 2 }));
    assert!(generalized(&Matrix::zeros(0, 0), &Matrix::zeros(0, 0)).unwrap().split(0).unwrap().values.is_empty());
}
