//! Factor and solve allocate nothing after their first use.

use crate::common::counting::count;
use holonom::math::kkt::{Field, Pattern, Reduced, SaddlePoint, Unsymmetric};

/// Allocations of a few rounds of factor, solve, projection and refinement, after a first one.
fn allocations(mass: &Pattern, mass_values: &[f64], g: &Pattern, g_values: &[f64]) -> usize {
    let mut solver = SaddlePoint::new(mass, g);
    let mut top = vec![1.0; g.cols];
    let mut bottom = vec![0.0; g.rows];
    let mut correction = vec![0.0; g.cols];
    let mut round = || {
        solver.factor(mass_values, g_values).unwrap();
        top.fill(1.0);
        bottom.fill(0.0);
        solver.solve(&mut top, &mut bottom).unwrap();
        bottom.fill(0.0);
        solver.solve_projection(&bottom, &mut correction).unwrap();
        solver.solve_refined(mass_values, g_values, &mut top, &mut bottom).unwrap();
    };
    round();
    let before = count();
    (0..70).for_each(|_| round());
    count() - before
}

/// Rods between neighbours in a row of `points` points in the plane, with the last `copies` rods given twice.
fn rods(points: usize, copies: usize) -> (Pattern, Vec<f64>) {
    let mut g = Pattern { rows: points - 1 + copies, cols: 2 * points, entries: vec![] };
    let mut values = vec![];
    for row in 0..g.rows {
        let k = if row < points - 1 { row } else { row - copies };
        let angle = 1.0 + k as f64;
        for (column, value) in [(2 * k, angle.cos()), (2 * k + 1, angle.sin())] {
            g.entries.extend([(row, column), (row, column + 2)]);
            values.extend([value, -value]);
        }
    }
    (g, values)
}

#[test]
fn nothing_is_allocated_after_the_first_round() {
    for points in [8, 500] {
        for copies in [0, 3] {
            let (g, values) = rods(points, copies);
            let n = 2 * points;
            assert_eq!(allocations(&Pattern::diagonal(n), &vec![1.0; n], &g, &values), 0, "{points} {copies}");
            let mut mass = vec![1.0; n];
            mass[n - 1] = 0.0;
            assert_eq!(allocations(&Pattern::diagonal(n), &mass, &g, &values), 0, "massless {points} {copies}");
        }
    }
}

#[test]
fn nor_by_dense_blocks_or_by_the_dense_way() {
    let full = |n: usize, m: usize| -> Vec<f64> { (0..n * m).map(|k| ((k * k) as f64).sin()).collect() };
    let g = Pattern::dense(150, 300);
    assert_eq!(allocations(&Pattern::diagonal(300), &vec![1.0; 300], &g, &full(150, 300)), 0);
    // Two rows at an angle of 1e-8 need the dense way.
    let g = Pattern::dense(2, 3);
    assert_eq!(allocations(&Pattern::diagonal(3), &[1.0; 3], &g, &[1.0, 2.0, 3.0, 1.0, 2.0, 3.0 + 1e-8]), 0);
}

#[test]
fn nor_by_the_dense_solver() {
    for (points, copies) in [(8, 0), (8, 3), (40, 0)] {
        let (g, values) = rods(points, copies);
        let mass = Pattern::diagonal(2 * points);
        let mut solver = Reduced::new(&mass, &g, 1e-10).unwrap();
        let mass = vec![1.0; g.cols];
        let mut top = vec![1.0; g.cols];
        let mut bottom = vec![0.0; g.rows];
        let mut round = || {
            solver.factor(&mass, &values, 0.0).unwrap();
            top.fill(1.0);
            bottom.fill(0.0);
            solver.solve(&mut top, &mut bottom).unwrap();
        };
        round();
        let before = count();
        (0..10).for_each(|_| round());
        assert_eq!(count(), before, "{points} {copies}");
    }
}

/// Rounds of factor and solve of an implicit method's matrix, whose pivots change from round to round.
fn unsymmetric<T: Field>(points: usize, copies: usize) {
    let (g, values) = rods(points, copies);
    let mass = Pattern::diagonal(g.cols);
    let tangent = Pattern::diagonal(g.cols);
    let mut system = Unsymmetric::<T>::new(&mass, &tangent, &g).unwrap();
    let mut top = vec![T::real(1.0); g.cols];
    let mut bottom = vec![T::real(1.0); g.rows];
    let stiffness: Vec<f64> = (0..g.cols).map(|k| (k as f64).sin()).collect();
    let mut round = |k: u32| {
        system.clear();
        system.add(&mass, &vec![1.0; g.cols], T::real(1.0), true);
        system.add(&tangent, &stiffness, T::real(0.05 * f64::from(k % 8)), false);
        system.factor(&g, &values).unwrap();
        let before = count();
        system.solve(&mut top, &mut bottom).unwrap();
        assert_eq!(count(), before);
    };
    (0..8).for_each(&mut round);
    let before = count();
    (0..16).for_each(&mut round);
    // One for the masses.
    assert_eq!(count() - before, 16, "{points} {copies}");
}

#[test]
fn nor_by_the_matrix_of_implicit_methods() {
    for points in [4, 100] {
        for copies in [0, 3] {
            unsymmetric::<f64>(points, copies);
            unsymmetric::<faer::c64>(points, copies);
        }
    }
}
