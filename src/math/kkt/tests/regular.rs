//! Systems of full rank.

use super::samples::{Random, Sample, distance};
use super::{agrees_with_lu, reachable, right_side, solved};
use crate::math::kkt::blocks::{Blocks, Layout};
use crate::math::kkt::ldlt::Ldlt;
use crate::math::kkt::pivot::Rule;
use crate::math::kkt::supernodal::Supernodal;
use crate::math::kkt::system::System;
use crate::math::kkt::{Pattern, SaddlePoint};

#[test]
fn agrees_with_a_pivoted_lu() {
    let mut random = Random(1);
    for (n, m) in [(1, 0), (1, 1), (7, 6), (8, 8), (12, 4), (30, 20), (5, 0)] {
        agrees_with_lu(&Sample::dense(n, m, &mut random), &mut random, 1e-12);
    }
    for _ in 0..20 {
        agrees_with_lu(&Sample::mechanism(&mut random), &mut random, 1e-12);
    }
    agrees_with_lu(&Sample::chain(40, &mut random), &mut random, 1e-12);
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

/// No LU of the badly scaled matrix is an oracle, but the residual is.
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
    assert!((solver.rank_indicator() / other.rank_indicator() - 1.0).abs() < 1e-9);
    sample.append(&[(4, 1.0), (5, 1.0)]);
    let r2 = reachable(&sample, &mut random);
    let (a, _, solver) = solved(&sample, &r1, &r2);
    let (expected, _) = sample.by_lu_without_last(&r1, &r2);
    // The right side contradicts itself by an ulp of 1e6, 1e-10; so does the null vector, which has 1e-10 / 1e-6 = 1e-4
    // of the rows in units of 1e-6. Their product is 1e-8 of such a unit.
    assert!(solver.rank() == 20 && distance(&a, &expected) < 1e-8);
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
        let layout = Layout::new(&sample.mass, &sample.g, &late, &[]);
        for mut fast in [
            Ldlt::Blocks(Box::new(Blocks::new(layout.into(), n))),
            Ldlt::Supernodal(Box::new(Supernodal::new(&sample.mass, &sample.g, &late).unwrap())),
        ] {
            let mut skipped = vec![];
            fast.factor(&sample.mass_values, &sample.g_values, Rule::STRICT, &mut skipped).ok().unwrap();
            let mut a = r1.clone();
            let mut lambda = r2.clone();
            fast.solve(&mut a, &mut lambda);
            results.push([a, lambda].concat());
        }
        assert!(distance(&results[0], &results[1]) < 1e-9, "{n} {m}: {:e}", distance(&results[0], &results[1]));
    }
}

#[test]
fn bodies_levers_and_single_entries_agree() {
    let mut random = Random(14);
    let joints = [(1, 0), (1, 2), (2, 3), (2, 4), (2, 6), (3, 0), (4, 5), (5, 0), (6, 7), (7, 0)];
    // Bodies are found by the sequence of their entries, so a sequence turned round has none.
    // Products of inertia, and a centre of mass beside the origin.
    let (inertia, offset): (&[_], &[_]) = (&[(4, 3), (5, 3), (5, 4)], &[(4, 0), (3, 1), (5, 4)]);
    for (dimension, rods, products) in
        [(2, 0, &[][..]), (3, 0, &[]), (2, 1, &[]), (3, 3, &[]), (3, 0, inertia), (3, 3, inertia), (3, 0, offset)]
    {
        let (mut sample, levers) = Sample::points(dimension, 7, &joints, rods, &mut random);
        for (body, (i, j)) in (0..7).flat_map(|body| products.iter().map(move |&pair| (6 * body, pair))) {
            sample.mass.entries.push((body + i, body + j));
            sample.mass_values.push(0.2 * random.next());
        }
        let mut turned = sample.clone();
        turned.g.entries.reverse();
        turned.g_values.reverse();
        let (n, _) = sample.sizes();
        let (r1, r2) = right_side(&sample, &mut random);
        let late = vec![false; n];
        let results = [(&sample, levers.as_slice()), (&sample, &[]), (&turned, &[])].map(|(sample, levers)| {
            let layout = Layout::new(&sample.mass, &sample.g, &late, levers);
            let mut blocks = Blocks::new(layout.into(), n);
            blocks.factor(&sample.mass_values, &sample.g_values, Rule::STRICT, &mut vec![]).ok().unwrap();
            let of = |blocks: &mut Blocks, top: &[f64], bottom: &[f64]| {
                let mut a = top.to_vec();
                let mut lambda = bottom.to_vec();
                blocks.solve(&mut a, &mut lambda);
                [a, lambda]
            };
            // Two at once go through the same operations as one after the other.
            let (other, mut pair): (Vec<f64>, _) = (r2.iter().rev().copied().collect(), [vec![9.0; n], vec![9.0; n]]);
            let [first, second] = &mut pair;
            blocks.project([&r2, &other], [first, second]);
            let mut alone = |bottom: &[f64]| of(&mut blocks, &vec![0.0; n], bottom)[0].clone();
            let alone = [alone(&r2), alone(&other)];
            assert_eq!(pair, alone);
            of(&mut blocks, &r1, &r2).concat()
        });
        // Round-off of some hundred operations, times a condition number of some hundred.
        assert!(distance(&results[0], &results[2]) < 1e-11 && distance(&results[1], &results[2]) < 1e-11);
    }
}

#[test]
fn the_order_of_the_rows_of_a_joint_does_not_move_the_rank_indicator() {
    let mut random = Random(17);
    for dimension in [2, 3] {
        // The last joint closes the only loop.
        let (sample, _) = Sample::points(dimension, 3, &[(0, 1), (1, 2), (2, 3), (3, 0)], 0, &mut random);
        let mut swapped = sample.clone();
        for row in swapped.g.entries.iter_mut().map(|(row, _)| row) {
            *row = *row / dimension * dimension + (dimension - 1 - *row % dimension);
        }
        let ratio = |sample: &Sample| {
            let (n, _) = sample.sizes();
            let layout = Layout::new(&sample.mass, &sample.g, &vec![false; n], &[]);
            let mut blocks = Blocks::new(layout.into(), n);
            blocks.factor(&sample.mass_values, &sample.g_values, Rule::STRICT, &mut vec![]).ok().unwrap();
            blocks.smallest_ratio(0.0).0
        };
        // Round-off of a hundred operations.
        assert!((ratio(&sample) / ratio(&swapped) - 1.0).abs() < 1e-12, "{} {}", ratio(&sample), ratio(&swapped));
    }
}

#[test]
fn a_hub_does_not_couple_everything() {
    let mut random = Random(15);
    // Body 1 is joined to 400 others: a hub.
    let joints: Vec<_> = (2..402).map(|k| (k, 1)).collect();
    let sample = Sample::planar(401, &joints, &mut random);
    let late = [vec![true; 3], vec![false; 1200]].concat();
    assert!(Layout::new(&sample.mass, &sample.g, &late, &[]).len < 12 * sample.g.rows);
    let mut solver = SaddlePoint::new(&sample.mass, &sample.g);
    solver.factor(&sample.mass_values, &sample.g_values).unwrap();
    let (r1, r2) = right_side(&sample, &mut random);
    let mut a = r1.clone();
    let mut lambda = r2.clone();
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
    let mut a = r1.clone();
    let mut lambda = r2.clone();
    solver.solve_refined(&sample.mass_values, &sample.g_values, &mut a, &mut lambda).unwrap();
    assert!(distance(&a, &sample.by_lu(&r1, &r2).0) < 1e-10);
}
