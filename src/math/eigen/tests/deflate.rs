use super::super::{Deflation, Matrix, Unsolved, deflate, dense, eigen, finite};
use super::samples::{Form, Mechanism, Random, chain, distance, random, residual, two_mass};
use crate::tolerances::RANK;

const WAYS: [Deflation; 2] = [Deflation::NullSpace, Deflation::Gsvd];
const FORMS: [Form; 4] = [Form::Index3, Form::Index2, Form::Index1, Form::Ggl];

#[test]
fn two_masses_swing_at_five() {
    for form in FORMS {
        let (a, e, ..) = two_mass().pencil(&form);
        let values = finite(&a, &e, Deflation::NullSpace).unwrap().values;
        let last = values[values.len() - 1];
        assert!(last.re.abs() < 1e-14 && (last.im - 5.0).abs() < 1e-14, "{last}");
    }
}

#[test]
fn both_ways_leave_the_finite_eigenvalues() {
    for (n, m, seed) in [(5, 2, 1), (9, 4, 2), (12, 6, 3), (30, 12, 4), (4, 4, 5), (4, 0, 6)] {
        let mechanism = random(n, m, seed);
        for form in FORMS {
            let (a, e, infinite, zeros) = mechanism.pencil(&form);
            for way in WAYS {
                let deflated = deflate(&a, &e, way, RANK).unwrap();
                assert_eq!(deflated.infinite(), infinite);
                assert!(deflated.gap > 1e6, "{}", deflated.gap);
                let error = distance(&eigen(&deflated.rate).unwrap().values, &mechanism.values(), zeros);
                assert!(error < 1e-10, "{way:?} {n}: {error}");
            }
        }
    }
}

#[test]
fn levels_are_the_blocks_of_the_forms() {
    let mechanism = random(7, 3, 8);
    let levels = [vec![3, 3, 3], vec![3, 3], vec![3], vec![6, 6]];
    for (form, expected) in FORMS.iter().zip(levels) {
        let (a, e, ..) = mechanism.pencil(form);
        for way in WAYS {
            assert_eq!(deflate(&a, &e, way, RANK).unwrap().levels, expected);
        }
    }
}

#[test]
fn basis_and_left_basis_reproduce_the_pencil() {
    for form in FORMS {
        let (a, e, ..) = random(8, 3, 4).pencil(&form);
        for way in WAYS {
            let d = deflate(&a, &e, way, RANK).unwrap();
            let eye = Matrix::identity(d.rate.nrows(), d.rate.nrows());
            assert!((&a * &d.basis - &e * &d.basis * &d.rate).amax() < 1e-11);
            assert!((&d.left * &a - &d.rate * &d.left * &e).amax() < 1e-10);
            assert!((&d.left * &e * &d.basis - eye).amax() < 1e-11);
            assert!((&d.e * &d.rate - &d.a).amax() < 1e-12);
        }
    }
}

#[test]
fn lifted_vectors_are_those_of_the_pencil() {
    for form in FORMS {
        let (a, e, ..) = random(8, 3, 4).pencil(&form);
        let found = finite(&a, &e, Deflation::NullSpace).unwrap();
        assert!(residual(&a, &e, &found.values, &found.right) < 1e-13);
        assert!(found.right.column_iter().all(|x| (x.norm() - 1.0).abs() < 1e-14));
        let conjugate: Vec<_> = found.values.iter().map(|value| value.conj()).collect();
        let has_left = |j: &usize| found.left.column(*j).norm() > 0.0;
        let rows: Vec<usize> = (0..conjugate.len()).filter(has_left).collect();
        let left = found.left.select_columns(&rows);
        let values: Vec<_> = rows.iter().map(|&j| conjugate[j]).collect();
        assert!(residual(&a.transpose(), &e.transpose(), &values, &left) < 1e-12);
        let product = left.adjoint() * dense::complex(&e) * found.right.select_columns(&rows);
        assert!((0..rows.len()).all(|j| (product[(j, j)] - 1.0).norm() < 1e-9));
        assert!(rows.len() >= 2 * (8 - 3));
    }
}

/// A mechanism whose last row of G is the sum of the first two.
fn redundant() -> Mechanism {
    let mut mechanism = random(7, 3, 11);
    let sum = mechanism.g.row(0) + mechanism.g.row(1);
    mechanism.g.set_row(2, &sum);
    mechanism
}

#[test]
fn redundant_constraints_make_the_pencil_singular() {
    for form in FORMS {
        let (a, e, ..) = redundant().pencil(&form);
        let dependent = if matches!(form, Form::Ggl) { 2 } else { 1 };
        for way in WAYS {
            assert_eq!(deflate(&a, &e, way, RANK), Err(Unsolved::SingularPencil { dependent }));
        }
    }
}

#[test]
fn scaling_of_rows_columns_and_time_does_not_matter() {
    let mut worst: f64 = 0.0;
    for seed in 0..20 {
        let mechanism = random(6, 2, seed);
        let mut numbers = Random(seed + 100);
        for form in FORMS {
            let (a, e, infinite, zeros) = mechanism.pencil(&form);
            let n = a.nrows();
            let rows = numbers.powers(n, 8.0);
            let cols = numbers.powers(n, 8.0);
            let scaled = |x: &Matrix, s: f64| Matrix::from_fn(n, n, |i, j| x[(i, j)] * rows[i] * cols[j] * s);
            for way in WAYS {
                let deflated = deflate(&scaled(&a, 1e-6), &scaled(&e, 1.0), way, RANK).unwrap();
                assert_eq!(deflated.infinite(), infinite);
                let expected: Vec<_> = mechanism.values().iter().map(|x| x * 1e-6).collect();
                let error = distance(&eigen(&deflated.rate).unwrap().values, &expected, zeros);
                worst = worst.max(error);
            }
        }
    }
    assert!(worst < 1e-9, "{worst}");
}

#[test]
fn chains_are_deflated() {
    for links in [9, 20, 40] {
        for form in FORMS {
            let mechanism = chain(links);
            let (a, e, infinite, zeros) = mechanism.pencil(&form);
            for way in WAYS {
                let deflated = deflate(&a, &e, way, RANK).unwrap();
                let error = distance(&eigen(&deflated.rate).unwrap().values, &mechanism.values(), zeros);
                eprintln!("{way:?} n = {}: {error:.1e}, gap {:.1e}", a.nrows(), deflated.gap);
                assert_eq!(deflated.infinite(), infinite);
                assert!(error < 1e-9);
            }
            assert_eq!(finite(&a, &e, Deflation::NullSpace).unwrap().values.len(), a.nrows() - infinite);
        }
    }
}

#[test]
fn small_cases() {
    let eye = Matrix::identity(2, 2);
    let none = finite(&Matrix::zeros(0, 0), &Matrix::zeros(0, 0), Deflation::NullSpace).unwrap();
    assert!(none.values.is_empty());
    // Algebraic equations only.
    let algebraic = finite(&eye, &Matrix::zeros(2, 2), Deflation::NullSpace).unwrap();
    assert_eq!((algebraic.values.len(), algebraic.deflated.levels), (0, vec![2]));
    let plain = finite(&(&eye * 3.0), &(&eye * 2.0), Deflation::NullSpace).unwrap();
    assert!(plain.values.iter().all(|x| (x - 1.5).norm() < 1e-15) && plain.deflated.levels.is_empty());
    for way in WAYS {
        let nothing = deflate(&Matrix::zeros(2, 2), &Matrix::zeros(2, 2), way, RANK);
        assert_eq!(nothing, Err(Unsolved::SingularPencil { dependent: 2 }));
    }
    assert_eq!(finite(&eye, &Matrix::zeros(3, 3), Deflation::NullSpace), Err(Unsolved::Shape));
}
