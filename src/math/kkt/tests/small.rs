//! The dense factorization of a few unknowns against that over blocks.

use super::samples::{Random, Sample, distance};
use crate::math::kkt::blocks::{Blocks, Layout, Small};
use crate::math::kkt::pivot::Rule;

/// Rows that were dropped, the smallest ratio with the number of collapsed ones, and the solution.
type Found = (Vec<usize>, (f64, usize), Vec<f64>);

fn both(sample: &Sample, rule: Rule, random: &mut Random) -> [Found; 2] {
    let Sample { mass, mass_values, g, g_values } = sample;
    let (n, m) = sample.sizes();
    let mut blocks = Blocks::new(Layout::new(mass, g, &vec![false; n], &[]).into(), n);
    let mut small = Small::new(mass, g).unwrap();
    let (r1, r2) = (random.vector(n), random.vector(m));
    let solve = |solve: &mut dyn FnMut(&mut [f64], &mut [f64])| {
        let (mut a, mut lambda) = (r1.clone(), r2.clone());
        solve(&mut a, &mut lambda);
        [a, lambda].concat()
    };
    let mut skipped = [Vec::new(), Vec::new()];
    assert!(blocks.factor(mass_values, g_values, rule, &mut skipped[0]).is_ok());
    assert!(small.factor(mass_values, g_values, rule, &mut skipped[1]).is_ok());
    let [first, second] = skipped;
    [
        (first, blocks.smallest_ratio(rule.collapsed), solve(&mut |a, lambda| blocks.solve(a, lambda))),
        (second, small.smallest_ratio(rule.collapsed), solve(&mut |a, lambda| small.solve(a, lambda))),
    ]
}

/// Bit by bit where M is a body to the blocks; beyond, D is divided by before or after a subtraction, and M enters their
/// ratio.
#[test]
fn small_factors_are_those_over_blocks() {
    let mut random = Random(11);
    for n in 1..=8 {
        for m in 0..=n {
            let sample = Sample::dense(n, m, &mut random);
            let [blocks, small] = both(&sample, Rule::STRICT, &mut random);
            if n <= 3 {
                assert_eq!(blocks, small, "{n} {m}");
            } else {
                assert!(
                    distance(&blocks.2, &small.2) < 1e-13 && small.1.0 >= blocks.1.0,
                    "{n} {m}: {blocks:?} {small:?}"
                );
            }
        }
    }
}

/// The second of two equal rows is dropped, and has no multiplier.
#[test]
fn small_factors_drop_the_rows_that_blocks_drop() {
    let mut random = Random(12);
    for n in 3..=6 {
        let mut sample = Sample::dense(n, 3, &mut random);
        sample.g_values.copy_within(..n, n);
        let [blocks, small] = both(&sample, Rule::lenient(1e-12, &[1.0]), &mut random);
        assert_eq!((&small.0[..], small.2[n + 1]), (&[1][..], 0.0));
        assert_eq!((&blocks.0, blocks.1.1), (&small.0, small.1.1));
        assert!(distance(&blocks.2, &small.2) < 1e-13, "{n}: {blocks:?} {small:?}");
    }
}
