//! Solutions against dense oracles.

use super::fast::Fast;
use super::null_space::NullSpace;
use super::pivot::Rule;
use super::samples::{Random, Sample, distance};
use super::system::System;
use super::*;

fn solved(sample: &Sample, r1: &[f64], r2: &[f64]) -> (Vec<f64>, Vec<f64>, SaddlePoint) {
    let mut solver = SaddlePoint::new(&sample.mass, &sample.g);
    solver.factor(&sample.mass_values, &sample.g_values).unwrap();
    let (mut a, mut lambda) = (r1.to_vec(), r2.to_vec());
    solver.solve(&mut a, &mut lambda).unwrap();
    (a, lambda, solver)
}

fn right_side(sample: &Sample, random: &mut Random) -> (Vec<f64>, Vec<f64>) {
    let (n, m) = sample.sizes();
    (random.vector(n), random.vector(m))
}

/// G x for a random x: right sides without contradiction.
fn reachable(sample: &Sample, random: &mut Random) -> Vec<f64> {
    let (n, m) = sample.sizes();
    let mut b = vec![0.0; m];
    sample.g.multiply(&sample.g_values, &random.vector(n), &mut b);
    b
}

fn agrees_with_lu(sample: &Sample, random: &mut Random, tolerance: f64) {
    let (r1, r2) = right_side(sample, random);
    let (a, lambda, solver) = solved(sample, &r1, &r2);
    let (a_lu, lambda_lu) = sample.by_lu(&r1, &r2);
    assert!(!solver.is_rank_deficient());
    assert!(distance(&a, &a_lu) < tolerance, "a {:e}", distance(&a, &a_lu));
    assert!(distance(&lambda, &lambda_lu) < tolerance, "lambda {:e}", distance(&lambda, &lambda_lu));
}

#[test]
fn agrees_with_a_pivoted_lu() {
    let mut random = Random(1);
    for (n, m) in [(1, 0), (1, 1), (7, 6), (8, 8), (12, 4), (30, 20), (5, 0)] {
        agrees_with_lu(&Sample::dense(n, m, &mut random), &mut random, 1e-11);
    }
    for _ in 0..20 {
        agrees_with_lu(&Sample::mechanism(&mut random), &mut random, 1e-10);
    }
    agrees_with_lu(&Sample::chain(40, &mut random), &mut random, 1e-11);
}

#[test]
fn blocks_of_mass_and_repeated_entries_add() {
    let mut random = Random(2);
    let mut sample = Sample::mechanism(&mut random);
    for body in 0..7 {
        for (i, j, v) in [(1, 0, 0.2), (2, 0, -0.3), (2, 1, 0.1), (2, 2, 0.7)] {
            sample.mass.entries.push((3 * body + i, 3 * body + j));
            sample.mass_values.push(v);
        }
    }
    sample.g.entries.push(sample.g.entries[5]);
    sample.g_values.push(0.3);
    agrees_with_lu(&sample, &mut random, 1e-10);
}

/// The LU of the badly scaled matrix is no oracle, that of the same system in balanced coordinates is:
/// a = S a', r1 = S^-1 r1' with S = diag(M)^-1/2.
#[test]
fn mass_ratios_of_1e16() {
    let mut random = Random(3);
    let mut sample = Sample::mechanism(&mut random);
    for (i, v) in sample.mass_values.iter_mut().enumerate() {
        *v *= [1e-8, 1.0, 1e8][(i / 3) % 3];
    }
    let (r1, r2) = right_side(&sample, &mut random);
    let (a, lambda, _) = solved(&sample, &r1, &r2);
    let mut residual = (r1.clone(), r2.clone());
    let mut system = System::new(&sample.mass, &sample.g);
    system.store(&sample.mass_values, &sample.g_values);
    system.residual(&a, &lambda, &mut residual.0, &mut residual.1);
    for (i, (left, r)) in residual.0.iter().zip(&r1).enumerate() {
        let inertia = sample.mass_values[i] * a[i];
        assert!(left.abs() < 1e-12 * (inertia.abs() + r.abs() + lambda.iter().fold(0.0, |s: f64, v| s.max(v.abs()))));
    }
    assert!(residual.1.iter().all(|v| v.abs() < 1e-11), "{:?}", residual.1);
}

#[test]
fn redundant_rows_get_least_multipliers() {
    let mut random = Random(4);
    for _ in 0..10 {
        let mut sample = Sample::mechanism(&mut random);
        sample.append(&[(3, 1.0)]);
        sample.append(&[(0, 2.0), (7, -1.0)]);
        sample.append(&[(20, 30.0)]);
        let r1 = random.vector(21);
        let r2 = reachable(&sample, &mut random);
        let (a, lambda, solver) = solved(&sample, &r1, &r2);
        let (a_svd, lambda_svd) = sample.by_svd(&r1, &r2);
        assert_eq!(solver.rank(), 20);
        assert!(solver.is_rank_deficient() && solver.smallest_pivot_ratio() == 0.0 && solver.inconsistency() < 1e-13);
        assert!(distance(&a, &a_svd) < 1e-10, "a {:e}", distance(&a, &a_svd));
        assert!(distance(&lambda, &lambda_svd) < 1e-10, "lambda {:e}", distance(&lambda, &lambda_svd));
    }
}

#[test]
fn the_dense_way_agrees_with_the_pseudo_inverse() {
    let mut random = Random(5);
    for copies in [0, 1, 4] {
        let mut sample = Sample::dense(12, 7, &mut random);
        (0..copies).for_each(|k| sample.append(&[(k, 3.0), (k + 1, -1.0)]));
        let r1 = random.vector(12);
        let r2 = reachable(&sample, &mut random);
        let mut system = System::new(&sample.mass, &sample.g);
        system.store(&sample.mass_values, &sample.g_values);
        let mut dense = NullSpace::new(&sample.mass, &sample.g);
        dense.factor(&system, 1e-10).unwrap();
        let (mut a, mut lambda) = (r1.clone(), r2.clone());
        dense.solve(&system, &mut a, &mut lambda);
        let (a_svd, lambda_svd) = sample.by_svd(&r1, &r2);
        assert_eq!(dense.rank(), 7);
        assert!(distance(&a, &a_svd) < 1e-11, "a {:e}", distance(&a, &a_svd));
        assert!(distance(&lambda, &lambda_svd) < 1e-11, "lambda {:e}", distance(&lambda, &lambda_svd));
    }
}

#[test]
fn contradicting_right_sides_are_met_in_the_least_squares_sense() {
    let mut random = Random(6);
    let mut sample = Sample::mechanism(&mut random);
    sample.append(&[(3, 1.0)]);
    let mut r2 = vec![0.0; 21];
    (r2[3], r2[20]) = (1.0, 2.0);
    let (a, _, solver) = solved(&sample, &[0.0; 21], &r2);
    let mut reached = vec![0.0; 21];
    sample.g.multiply(&sample.g_values, &a, &mut reached);
    assert!((reached[3] - 1.5).abs() < 1e-11 && (reached[20] - 1.5).abs() < 1e-11);
    assert!((solver.inconsistency() - 0.5_f64.sqrt()).abs() < 1e-12);
}

#[test]
fn massless_coordinates_move_with_their_constraints() {
    let mut random = Random(7);
    let mut sample = Sample::mechanism(&mut random);
    sample.mass_values[3..6].fill(0.0);
    sample.mass_values[10] = 0.0;
    agrees_with_lu(&sample, &mut random, 1e-9);
    // Structurally massless.
    sample.mass.entries.retain(|&(i, _)| i != 10);
    sample.mass_values.remove(10);
    agrees_with_lu(&sample, &mut random, 1e-9);
    // A row between massless coordinates only: no order without pivoting works.
    let mut sample = Sample::dense(6, 2, &mut random);
    sample.mass = Pattern::diagonal(6);
    sample.mass_values = vec![1.0, 1.0, 1.0, 1.0, 0.0, 0.0];
    sample.g_values = vec![0.0, 0.0, 0.0, 0.0, 1.0, 2.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0];
    agrees_with_lu(&sample, &mut random, 1e-12);
}

#[test]
fn a_large_system_with_massless_bodies_and_redundant_rows() {
    let mut random = Random(8);
    let mut sample = Sample::chain(130, &mut random);
    sample.mass_values[30..33].fill(0.0);
    sample.mass_values[200] = 0.0;
    agrees_with_lu(&sample, &mut random, 1e-8);
    (0..10).for_each(|k| sample.append(&[(4 * k, 1.0), (100 + k, 0.5)]));
    let r1 = random.vector(390);
    let r2 = reachable(&sample, &mut random);
    let (a, lambda, solver) = solved(&sample, &r1, &r2);
    let (a_svd, lambda_svd) = sample.by_svd(&r1, &r2);
    assert_eq!(solver.rank(), 260);
    assert!(distance(&a, &a_svd) < 1e-8, "a {:e}", distance(&a, &a_svd));
    assert!(distance(&lambda, &lambda_svd) < 1e-8, "lambda {:e}", distance(&lambda, &lambda_svd));
}

#[test]
fn a_singular_configuration_is_passed() {
    // Two rows that become parallel at s = 0.
    let mass = Pattern::diagonal(3);
    let g = Pattern::dense(2, 3);
    let mut solver = SaddlePoint::new(&mass, &g);
    let values = |s: f64| [1.0, 2.0, 0.5, 1.0, 2.0 + s, 0.5];
    for (s, rank) in [(1.0, 2), (1e-3, 2), (1e-5, 2), (1e-8, 2), (1e-13, 1), (0.0, 1), (-1e-8, 2), (-1.0, 2)] {
        solver.factor(&[1.0, 2.0, 3.0], &values(s)).unwrap();
        assert_eq!(solver.rank(), rank, "at {s}");
        let (mut a, mut lambda) = ([1.0, 0.5, -1.0], [0.0, 0.0]);
        solver.solve(&mut a, &mut lambda).unwrap();
        let mut velocity = [0.0; 2];
        g.multiply(&values(s), &a, &mut velocity);
        assert!(velocity.iter().all(|v| v.abs() < 1e-12), "at {s}: {velocity:?}");
        // In the limit G a = 0 for both rows (1, 2, 0.5) and (0, 1, 0); at s = 0 only for the first.
        assert!(a[1].abs() < 1e-6 || rank == 1, "at {s}: {a:?}");
    }
}

#[test]
fn an_undetermined_motion_is_an_error_that_names_the_coordinate() {
    let mut random = Random(9);
    for bodies in [5, 200] {
        let mut sample = Sample::chain(bodies, &mut random);
        sample.mass = Pattern::diagonal(3 * bodies + 1);
        sample.mass_values.push(0.0);
        sample.g.cols += 1;
        let mut solver = SaddlePoint::new(&sample.mass, &sample.g);
        let expected = Err(Singular::Undetermined { coordinate: 3 * bodies });
        assert_eq!(solver.factor(&sample.mass_values, &sample.g_values), expected);
        assert_eq!(
            solver.solve(&mut vec![0.0; 3 * bodies + 1], &mut vec![0.0; 2 * bodies]),
            Err(Singular::NotFactored)
        );
        sample.mass_values[3 * bodies] = 1.0;
        assert_eq!(solver.factor(&sample.mass_values, &sample.g_values), Ok(()));
    }
}

#[test]
fn what_is_not_finite_is_an_error() {
    let mut random = Random(10);
    for sample in [Sample::mechanism(&mut random), Sample::net(18, &mut random)] {
        let (n, m) = sample.sizes();
        let mut solver = SaddlePoint::new(&sample.mass, &sample.g);
        for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
            for k in [0, 7, sample.g_values.len() - 1] {
                let mut values = sample.g_values.clone();
                values[k] = bad;
                assert_eq!(solver.factor(&sample.mass_values, &values), Err(Singular::NotFinite));
            }
            let mut values = sample.mass_values.clone();
            values[n / 2] = bad;
            assert_eq!(solver.factor(&values, &sample.g_values), Err(Singular::NotFinite));
        }
        solver.factor(&sample.mass_values, &sample.g_values).unwrap();
        let mut top = vec![1.0; n];
        top[3] = f64::NAN;
        assert_eq!(solver.solve(&mut top, &mut vec![0.0; m]), Err(Singular::NotFinite));
        assert_eq!(solver.solve(&mut [0.0], &mut []), Err(Singular::Shape));
        assert_eq!(solver.factor(&[1.0], &[]), Err(Singular::Shape));
    }
}

#[test]
fn units_of_rows_do_not_change_the_motion() {
    let mut random = Random(11);
    let mut sample = Sample::mechanism(&mut random);
    let (r1, mut r2) = right_side(&sample, &mut random);
    let (a, _, solver) = solved(&sample, &r1, &r2);
    let unit = |j: usize| [1e-6, 1.0, 1e6][j % 3];
    for (&(j, _), v) in sample.g.entries.iter().zip(&mut sample.g_values) {
        *v *= unit(j);
    }
    r2.iter_mut().enumerate().for_each(|(j, v)| *v *= unit(j));
    let (scaled, _, other) = solved(&sample, &r1, &r2);
    assert!(distance(&scaled, &a) < 1e-11);
    assert!((solver.smallest_pivot_ratio() / other.smallest_pivot_ratio() - 1.0).abs() < 1e-9);
    sample.append(&[(4, 1.0), (5, 1.0)]);
    let r2 = reachable(&sample, &mut random);
    let (a, _, solver) = solved(&sample, &r1, &r2);
    let (expected, _) = sample.by_lu_without_last(&r1, &r2);
    assert!(solver.rank() == 20 && distance(&a, &expected) < 1e-9);
}

impl Sample {
    fn by_lu_without_last(&self, r1: &[f64], r2: &[f64]) -> (Vec<f64>, Vec<f64>) {
        let mut sample = self.clone();
        sample.g.rows -= 1;
        let kept = self.g.entries.iter().zip(&self.g_values).filter(|(e, _)| e.0 < sample.g.rows);
        (sample.g.entries, sample.g_values) = kept.map(|(e, v)| (*e, *v)).unzip();
        sample.by_lu(r1, &r2[..sample.g.rows])
    }
}

#[test]
fn a_long_chain_agrees_with_a_sparse_lu() {
    use faer::linalg::solvers::Solve;
    use faer::sparse::{SparseColMat, Triplet};
    let mut random = Random(12);
    let sample = Sample::chain(1000, &mut random);
    let (n, m) = sample.sizes();
    let mut triplets: Vec<_> = sample.mass_values.iter().enumerate().map(|(i, v)| Triplet::new(i, i, *v)).collect();
    for (&(j, i), v) in sample.g.entries.iter().zip(&sample.g_values) {
        triplets.extend([Triplet::new(n + j, i, *v), Triplet::new(i, n + j, *v)]);
    }
    let lu = SparseColMat::try_new_from_triplets(n + m, n + m, &triplets).unwrap().sp_lu().unwrap();
    let (r1, r2) = right_side(&sample, &mut random);
    let mut x = faer::Mat::from_fn(n + m, 1, |i, _| if i < n { r1[i] } else { r2[i - n] });
    lu.solve_in_place(&mut x);
    let (a, lambda, _) = solved(&sample, &r1, &r2);
    let x: Vec<f64> = (0..n + m).map(|i| x[(i, 0)]).collect();
    assert!(distance(&a, &x[..n]) < 1e-9 && distance(&lambda, &x[n..]) < 1e-9);
}

#[test]
fn both_ways_of_elimination_agree() {
    let mut random = Random(13);
    for mut sample in [Sample::mechanism(&mut random), Sample::chain(50, &mut random), Sample::net(12, &mut random)] {
        let (n, m) = sample.sizes();
        // The last coordinate of the mechanism has no mass and comes late.
        let late: Vec<bool> = (0..n).map(|i| n == 21 && i == 20).collect();
        if n == 21 {
            sample.mass_values[20] = 0.0;
        }
        let (r1, r2) = right_side(&sample, &mut random);
        let mut results = vec![];
        for mut fast in [
            Fast::Compiled(Box::new(compiled::Compiled::new(symbolic::Symbolic::new(&sample.mass, &sample.g, &late)))),
            Fast::blocked(&sample.mass, &sample.g, &late),
        ] {
            let mut skipped = vec![];
            fast.factor(&sample.mass_values, &sample.g_values, Rule::STRICT, &mut skipped).ok().unwrap();
            let (mut a, mut lambda) = (r1.clone(), r2.clone());
            fast.solve(&mut a, &mut lambda);
            results.push([a, lambda].concat());
        }
        assert!(distance(&results[0], &results[1]) < 1e-9, "{n} {m}: {:e}", distance(&results[0], &results[1]));
    }
}

#[test]
fn redundant_rows_in_a_net() {
    let mut random = Random(14);
    let mut sample = Sample::net(16, &mut random);
    (0..40).for_each(|k| sample.append(&[(3 * k, 1.0), (3 * k + 50, -2.0)]));
    let (n, m) = sample.sizes();
    let r1 = random.vector(n);
    let r2 = reachable(&sample, &mut random);
    let (a_svd, lambda_svd) = sample.by_svd(&r1, &r2);
    let (a, lambda, solver) = solved(&sample, &r1, &r2);
    assert_eq!(solver.rank(), m - 40);
    assert!(distance(&a, &a_svd) < 1e-9, "a {:e}", distance(&a, &a_svd));
    assert!(distance(&lambda, &lambda_svd) < 1e-9, "lambda {:e}", distance(&lambda, &lambda_svd));
}

#[test]
fn a_hub_does_not_couple_everything() {
    let mut random = Random(15);
    // Body 1 carries 400 others.
    let joints: Vec<_> = (2..402).map(|k| (k, 1)).collect();
    let sample = Sample::planar(401, &joints, &mut random);
    let symbolic = symbolic::Symbolic::new(&sample.mass, &sample.g, &[vec![true; 3], vec![false; 1200]].concat());
    assert!(symbolic.rows.len() < 10 * sample.g.rows);
    let mut solver = SaddlePoint::new(&sample.mass, &sample.g);
    solver.factor(&sample.mass_values, &sample.g_values).unwrap();
    let (r1, r2) = right_side(&sample, &mut random);
    let (mut a, mut lambda) = (r1.clone(), r2.clone());
    solver.solve(&mut a, &mut lambda).unwrap();
    let mut left = r2.clone();
    sample.g.subtract(&sample.g_values, &a, &mut left);
    assert!(left.iter().all(|v| v.abs() < 1e-12));
}

#[test]
fn projections_and_refinement() {
    let mut random = Random(16);
    let sample = Sample::mechanism(&mut random);
    let (r1, r2) = right_side(&sample, &mut random);
    let (_, _, mut solver) = solved(&sample, &r1, &r2);
    let mut correction = vec![9.0; 21];
    solver.solve_projection(&r2, &mut correction).unwrap();
    assert!(distance(&correction, &sample.by_lu(&[0.0; 21], &r2).0) < 1e-10);
    // The factor of values nearby, refined against the true ones.
    let near: Vec<f64> = sample.g_values.iter().map(|v| v * (1.0 + 1e-9 * random.next())).collect();
    solver.factor(&sample.mass_values, &near).unwrap();
    let (mut a, mut lambda) = (r1.clone(), r2.clone());
    solver.solve_refined(&sample.mass_values, &sample.g_values, &mut a, &mut lambda).unwrap();
    assert!(distance(&a, &sample.by_lu(&r1, &r2).0) < 1e-10);
}

#[test]
fn the_fast_way_is_given_up_and_tried_again() {
    let mut random = Random(17);
    let good = Sample::mechanism(&mut random);
    let mut bad = good.clone();
    for (k, &(i, _)) in good.g.entries.iter().enumerate() {
        // Row 19 becomes row 17 (both have two entries, but in other columns), so make both zero instead.
        if i == 19 {
            bad.g_values[k] = 0.0;
        }
    }
    let mut solver = SaddlePoint::new(&good.mass, &good.g);
    for _ in 0..10 {
        solver.factor(&bad.mass_values, &bad.g_values).unwrap();
        assert_eq!(solver.rank(), 19);
    }
    let mut calls = 0;
    while solver.smallest_pivot_ratio() == 0.0 {
        solver.factor(&good.mass_values, &good.g_values).unwrap();
        assert_eq!(solver.rank(), 20);
        calls += 1;
    }
    assert!(calls <= 64 && calls > 40, "{calls}");
}

#[test]
fn dependent_rows_are_named_with_what_they_depend_on() {
    let mut random = Random(18);
    let mut sample = Sample::mechanism(&mut random);
    sample.append(&[(3, 1e6)]);
    sample.append(&[(0, 2.0), (7, -1.0)]);
    sample.append(&[]);
    sample.append(&[(20, 1.0), (8, 1e6)]);
    let found = dependent_rows(&sample.g, &sample.g_values, 1e-10);
    assert_eq!(found.rank, 20);
    assert_eq!(found.rows.iter().map(|r| r.row).collect::<Vec<_>>(), [20, 21, 22, 23]);
    let expected = [vec![(3, 1e6)], vec![(0, 2.0), (7, -1.0)], vec![], vec![(3, 1e6), (8, 1e6)]];
    for (row, expected) in found.rows.iter().zip(expected) {
        assert_eq!(row.combination.len(), expected.len(), "{row:?}");
        for (got, want) in row.combination.iter().zip(expected) {
            assert!(got.0 == want.0 && (got.1 / want.1 - 1.0).abs() < 1e-9, "{row:?}");
        }
    }
}

#[test]
fn condition_numbers() {
    let mut random = Random(19);
    let sample = Sample::chain(110, &mut random);
    let small = Sample::chain(5, &mut random);
    let of = |s: &Sample| condition_number(&s.mass, &s.mass_values, &s.g, &s.g_values);
    assert!(of(&small) > 1.0 && of(&small) < 1e4);
    let mut scaled = small.clone();
    scaled.g_values.iter_mut().for_each(|v| *v *= 1e6);
    assert!((of(&scaled) / of(&small) - 1.0).abs() < 0.1);
    scaled.append(&[(0, 1.0)]);
    assert_eq!(of(&scaled), f64::INFINITY);
    // Both sides of the switch to iterations, on nearly the same system.
    let longer = Sample::chain(130, &mut Random(19));
    let ratio = of(&longer) / of(&sample);
    assert!(ratio > 0.2 && ratio < 20.0, "{ratio}");
}
