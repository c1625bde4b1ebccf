//! Rows that are dropped by name or by truncation.

use super::samples::{Random, Sample, distance};
use super::{agree, reachable, right_side, solved};
use crate::math::kkt::{Pattern, Reduced, SaddlePoint};

/// A mechanism with two more rows: combinations of others, plus a part of size `off` of their own.
fn redundant(off: f64, random: &mut Random) -> (Sample, Sample) {
    let reduced = Sample::mechanism(random);
    let mut sample = reduced.clone();
    sample.append(&[(3, 1.0), (8, 0.5)]);
    sample.append(&[(0, 2.0), (7, -1.0)]);
    for (k, (row, _)) in sample.g.entries.iter().enumerate() {
        sample.g_values[k] += if *row >= 20 { off * random.next() } else { 0.0 };
    }
    (reduced, sample)
}

/// Named rows are dropped for any pivots, from 1e-4, where nothing else would drop them, to round-off.
#[test]
fn dropped_rows_leave_the_motion_of_the_others() {
    let mut random = Random(21);
    for off in [1e-2, 1e-4, 1e-6, 1e-9, 0.0] {
        let (reduced, sample) = redundant(off, &mut random);
        let (r1, mut r2) = right_side(&sample, &mut random);
        let (a, _, _) = solved(&reduced, &r1, &r2[..20]);
        let mut solver = SaddlePoint::new(&sample.mass, &sample.g);
        solver.drop_rows(&[20, 21]);
        solver.factor(&sample.mass_values, &sample.g_values).unwrap();
        let mut top = r1.clone();
        solver.solve(&mut top, &mut r2).unwrap();
        assert!(distance(&top, &a) < 1e-10, "{off:e}: {:e}", distance(&top, &a));
        assert_eq!((solver.rank(), solver.inconsistency()), (20, 0.0), "{off:e}");
        assert!(solver.is_rank_deficient());
        let mut left_out = solver.left_out().to_vec();
        left_out.sort_unstable();
        assert_eq!(left_out, [20, 21]);
    }
}

/// Exactly dependent: the forces of all rows together are those of least norm, as without dropping any.
#[test]
fn dropped_rows_share_the_multipliers() {
    let mut random = Random(22);
    let (_, sample) = redundant(0.0, &mut random);
    let r1 = random.vector(21);
    let r2 = reachable(&sample, &mut random);
    let expected = sample.by_svd(&r1, &r2);
    let mut solver = SaddlePoint::new(&sample.mass, &sample.g);
    solver.drop_rows(&[20, 21]);
    solver.factor(&sample.mass_values, &sample.g_values).unwrap();
    let mut a = r1;
    let mut lambda = r2;
    solver.solve(&mut a, &mut lambda).unwrap();
    agree(&a, &lambda, expected, 1e-10);
}

#[test]
fn released_rows_count_again() {
    let mut random = Random(23);
    let sample = Sample::mechanism(&mut random);
    let (r1, r2) = right_side(&sample, &mut random);
    let (a, lambda, _) = solved(&sample, &r1, &r2);
    let mut solver = SaddlePoint::new(&sample.mass, &sample.g);
    for (dropped, rank) in [(&[4][..], 19), (&[], 20)] {
        solver.drop_rows(dropped);
        solver.factor(&sample.mass_values, &sample.g_values).unwrap();
        assert_eq!(solver.rank(), rank);
    }
    let mut top = r1;
    let mut bottom = r2;
    solver.solve(&mut top, &mut bottom).unwrap();
    assert!(solver.is_fast() && distance(&top, &a) < 1e-12 && distance(&bottom, &lambda) < 1e-12);
}

/// As [`dropped_rows_leave_the_motion_of_the_others`] and [`dropped_rows_share_the_multipliers`].
#[test]
fn the_dense_solver_drops_rows_too() {
    let mut random = Random(24);
    for off in [1e-2, 1e-6, 0.0] {
        let (reduced, sample) = redundant(off, &mut random);
        let r1 = random.vector(21);
        let r2 = reachable(&sample, &mut random);
        let (a, _, _) = solved(&reduced, &r1, &r2[..20]);
        let mut solver = Reduced::new(&sample.mass, &sample.g, 1e-10).unwrap();
        solver.drop_rows(&[20, 21]);
        solver.factor(&sample.mass_values, &sample.g_values, 0.0).unwrap();
        let mut top = r1.clone();
        let mut lambda = r2.clone();
        // What dropped rows ask for is not read.
        lambda[20] += 1.0;
        solver.solve(&mut top, &mut lambda).unwrap();
        assert!(solver.is_rank_deficient());
        assert!(distance(&top, &a) < 1e-11, "{off:e}: {:e}", distance(&top, &a));
        if off == 0.0 {
            let least = sample.by_svd(&r1, &r2).1;
            assert!(distance(&lambda, &least) < 1e-11, "lambda {:e}", distance(&lambda, &least));
        }
    }
}

/// Two rows that become parallel at s = 0: below 1e-4 of the reference value only what both ask for counts.
#[test]
fn nearly_dependent_rows_are_truncated() {
    let mass = Pattern::diagonal(3);
    let g = Pattern::dense(2, 3);
    let values = |s: f64| [1.0, 2.0, 0.5, 1.0, 2.0 + s, 0.5];
    let mut solver = SaddlePoint::new(&mass, &g);
    let mut right = |reference: f64, s: f64| {
        solver.rank_reference = reference;
        solver.factor_truncated(&[1.0, 1.0, 1.0], &values(s), 1e-4).unwrap();
        // Contradicting accelerations: solved for, they cost 1/s.
        let mut a = [0.0; 3];
        let mut lambda = [1.0, 1.0 + 1e-3];
        solver.solve(&mut a, &mut lambda).unwrap();
        (solver.rank(), solver.is_rank_deficient(), a[1])
    };
    for s in [1e-3, 1e-5, 1e-7, 1e-9] {
        // No reference value is known, or so small a one.
        for reference in [0.0, s] {
            let (rank, is_deficient, a) = right(reference, s);
            assert!(rank == 2 && !is_deficient && (a * s / 1e-3 - 1.0).abs() < 1e-2, "{reference} {s}: {rank} {a:e}");
        }
        let (rank, _, a) = right(1.0, s);
        let is_truncated = s < 1e-4;
        assert_eq!(rank, if is_truncated { 1 } else { 2 }, "{s}");
        assert!(!is_truncated || a.abs() < 1.0, "{s}: {a:e}");
    }
    // The rank indicator is still reported.
    let (rank, is_deficient, _) = right(1.0, 1e-5);
    assert!(rank == 1 && !is_deficient && (solver.rank_indicator() / 1e-5) < 1.0);
}
