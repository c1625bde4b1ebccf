//! Dependent rows, and rows that become so.

use super::samples::{Random, Sample, distance};
use super::{agree, agreeing_with_svd, agrees_with_lu, reachable, solved};
use crate::math::kkt::alike::Alike;
use crate::math::kkt::rank_revealing::NullSpace;
use crate::math::kkt::redundant_rows::Least;
use crate::math::kkt::system::System;
use crate::math::kkt::{Pattern, SaddlePoint};

#[test]
fn redundant_rows_get_least_multipliers() {
    let mut random = Random(4);
    for _ in 0..10 {
        let mut sample = Sample::mechanism(&mut random);
        sample.append(&[(3, 1.0)]);
        sample.append(&[(0, 2.0), (7, -1.0)]);
        sample.append(&[(20, 30.0)]);
        let solver = agreeing_with_svd(&sample, &mut random, 1e-10);
        assert_eq!(solver.rank(), 20);
        assert!(solver.is_rank_deficient() && solver.rank_indicator() == 0.0 && solver.inconsistency() < 1e-13);
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
        let mut a = r1.clone();
        let mut lambda = r2.clone();
        dense.solve(&system, &mut a, &mut lambda);
        assert_eq!(dense.left_out().len(), copies);
        agree(&a, &lambda, sample.by_svd(&r1, &r2), 1e-11);
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
fn a_large_system_with_massless_bodies_and_redundant_rows() {
    let mut random = Random(8);
    let mut sample = Sample::chain(130, &mut random);
    sample.mass_values[30..33].fill(0.0);
    sample.mass_values[200] = 0.0;
    agrees_with_lu(&sample, &mut random, 1e-8);
    (0..10).for_each(|k| sample.append(&[(4 * k, 1.0), (100 + k, 0.5)]));
    assert_eq!(agreeing_with_svd(&sample, &mut random, 1e-8).rank(), 260);
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
        let mut a = [1.0, 0.5, -1.0];
        let mut lambda = [0.0, 0.0];
        solver.solve(&mut a, &mut lambda).unwrap();
        let mut velocity = [0.0; 2];
        g.multiply(&values(s), &a, &mut velocity);
        assert!(velocity.iter().all(|v| v.abs() < 1e-12), "at {s}: {velocity:?}");
        // In the limit G a = 0 for both rows (1, 2, 0.5) and (0, 1, 0); at s = 0 only for the first.
        assert!(a[1].abs() < 1e-6 || rank == 1, "at {s}: {a:?}");
    }
}

#[test]
fn redundant_rows_in_a_net() {
    let mut random = Random(14);
    let mut sample = Sample::net(16, &mut random);
    (0..40).for_each(|k| sample.append(&[(3 * k, 1.0), (3 * k + 50, -2.0)]));
    assert_eq!(agreeing_with_svd(&sample, &mut random, 1e-9).rank(), sample.sizes().1 - 40);
}

#[test]
fn the_fast_way_is_taken_wherever_it_can_be() {
    let mut random = Random(17);
    let good = Sample::mechanism(&mut random);
    let mut bad = good.clone();
    for (k, &(i, _)) in good.g.entries.iter().enumerate() {
        if i == 19 {
            bad.g_values[k] = 0.0;
        }
    }
    let mut solver = SaddlePoint::new(&good.mass, &good.g);
    for _ in 0..10 {
        solver.factor(&bad.mass_values, &bad.g_values).unwrap();
        assert_eq!(solver.rank(), 19);
    }
    solver.factor(&good.mass_values, &good.g_values).unwrap();
    assert!(solver.is_fast() && solver.rank() == 20);
}

/// By null vectors, which cost two solutions each, or by vectors of the range, which cost one, if these are fewer.
#[test]
fn least_multipliers_take_no_more_solutions_than_rows() {
    let mut random = Random(31);
    let reduced = Sample::chain(60, &mut random);
    for count in [10, 40, 64, 110, 240] {
        let mut sample = reduced.clone();
        let row = |k: usize| k % 110;
        (0..count).for_each(|k| sample.append(&[(row(k), 1.0), (row(k) + 5, -0.5), (row(k) + 9, 0.25)]));
        let (n, m) = sample.sizes();
        let mut system = System::new(&sample.mass, &sample.g);
        system.store(&sample.mass_values, &sample.g_values);
        let (_, _, mut solver) = solved(&reduced, &vec![0.0; n], &[0.0; 120]);
        let rows: Vec<usize> = (120..m).collect();
        let mut solutions = 0;
        let mut v = random.vector(m);
        let before = v.clone();
        let mut inverse = |top: &mut [f64], bottom: &mut [f64]| {
            solutions += 1;
            solver.solve(top, &mut bottom[..120]).unwrap();
            bottom[120..].fill(0.0);
        };
        Least::new(&sample.g).project(&system, &rows, &mut inverse, &mut v);
        assert_eq!(solutions, if count <= 120 { 2 * count } else { 120 });
        // The same force, and nothing along null vectors: e_j less its combination.
        let force = |v: &[f64]| {
            let mut force = vec![0.0; n];
            sample.g.multiply_transposed(&sample.g_values, v, &mut force);
            force
        };
        assert!(distance(&force(&v), &force(&before)) < 1e-11);
        for k in 0..count {
            let along = v[120 + k] - v[row(k)] + 0.5 * v[row(k) + 5] - 0.25 * v[row(k) + 9];
            assert!(along.abs() < 1e-11, "{count} rows: {along:e}");
        }
    }
}

/// Their right sides are not read, but what they miss of them is told.
#[test]
fn very_many_redundant_rows_carry_no_force() {
    let mut random = Random(33);
    let reduced = Sample::chain(400, &mut random);
    let mut sample = reduced.clone();
    (0..400).for_each(|k| sample.append(&[(2 * k, 1.0), ((2 * k + 5) % 800, -0.5)]));
    let mut system = System::new(&sample.mass, &sample.g);
    system.store(&sample.mass_values, &sample.g_values);
    let (_, _, mut solver) = solved(&reduced, &[0.0; 1200], &[0.0; 800]);
    let mut inverse = |top: &mut [f64], bottom: &mut [f64]| {
        solver.solve(top, &mut bottom[..800]).unwrap();
        bottom[800..].fill(0.0);
    };
    let rows: Vec<usize> = (800..1200).collect();
    let mut v = reachable(&sample, &mut random);
    for off in [0.0, 1.0] {
        v[900] += off;
        let before = v.clone();
        let missed = Least::new(&sample.g).project(&system, &rows, &mut inverse, &mut v);
        assert!((missed - off).abs() < 1e-8 && v == before, "{off}: {missed:e}");
    }
}

/// Copies of rows are found within their group, so that no factor couples all of them.
#[test]
fn copies_of_a_joint_share_its_force() {
    let mut random = Random(32);
    let reduced = Sample::planar(2, &[(1, 0), (1, 2)], &mut random);
    let mut sample = reduced.clone();
    (0..999).for_each(|_| [2, 3].into_iter().for_each(|row| sample.append(&[(row, 1.0)])));
    let mut alike = Alike::new(&sample.g);
    assert!(alike.is_crowded() && !Alike::new(&reduced.g).is_crowded());
    assert_eq!(alike.dependent(&sample.g_values, 1e-10), (4..2002).collect::<Vec<usize>>());
    let r1 = random.vector(6);
    let mut r2 = random.vector(4);
    let (a, lambda, _) = solved(&reduced, &r1, &r2);
    (0..999).for_each(|_| r2.extend([r2[2], r2[3]]));
    let (a_all, lambda_all, solver) = solved(&sample, &r1, &r2);
    assert_eq!((solver.rank(), solver.left_out().len()), (4, 1998));
    let shared: Vec<f64> = (0..2002).map(|k| if k < 2 { lambda[k] } else { lambda[2 + k % 2] / 1000.0 }).collect();
    assert!(distance(&a_all, &a) < 1e-12 && distance(&lambda_all, &shared) < 1e-12);
}
