//! The matrix in parts against the whole one.

use super::samples::{Random, Sample, distance};
use super::{reachable, right_side};
use crate::math::kkt::Lever;
use crate::math::kkt::blocks::{Blocks, Layout};
use crate::math::kkt::parts::{Division, Parts};
use crate::math::kkt::pivot::Rule;
use crate::math::threads::spread;

/// Solutions of both, and the rows that both drop; by the threads of the pool, too, to the bit.
fn both(
    sample: &Sample,
    late: &[bool],
    levers: &[Lever],
    r1: &[f64],
    r2: &[f64],
    count: usize,
    rule: Rule,
) -> [(Vec<f64>, Vec<usize>); 2] {
    let (n, _) = sample.sizes();
    let mut top = r1.to_vec();
    let mut bottom = r2.to_vec();
    let mut skipped = vec![];
    let mut whole = Blocks::new(Layout::new(&sample.mass, &sample.g, late, levers).into(), n);
    whole.factor(&sample.mass_values, &sample.g_values, rule, &mut skipped).ok().unwrap();
    whole.solve(&mut top, &mut bottom);
    let expected = ([top, bottom].concat(), skipped);
    let division = Division::new(&sample.mass, &sample.g, late, levers, count).unwrap();
    assert_eq!(division.parts.len(), count);
    let mut parts = Parts::new(division.into());
    let mut solved = || {
        let mut top = r1.to_vec();
        let mut bottom = r2.to_vec();
        let mut skipped = vec![];
        parts.factor(&sample.mass_values, &sample.g_values, rule, &mut skipped).ok().unwrap();
        parts.solve(&mut top, &mut bottom);
        assert!(parts.smallest_ratio(0.0).0 > 0.0);
        ([top, bottom].concat(), skipped)
    };
    let found = solved();
    assert_eq!(spread(solved), found, "other threads give the same");
    [expected, found]
}

fn agrees(sample: &Sample, late: &[bool], levers: &[Lever], random: &mut Random) {
    let (r1, r2) = right_side(sample, random);
    for count in [2, 3, 4, 8] {
        let [(expected, _), (found, _)] = both(sample, late, levers, &r1, &r2, count, Rule::STRICT);
        // Round-off of some hundred operations in another order.
        assert!(distance(&found, &expected) < 1e-13, "{count}: {:e}", distance(&found, &expected));
    }
}

/// Bodies that are joined to the one before, and some to another one near it, numbered without order.
fn scattered(bodies: usize, random: &mut Random) -> Vec<(usize, usize)> {
    let mut number: Vec<usize> = (1..=bodies).collect();
    for k in (1..bodies).rev() {
        number.swap(k, ((1.0 + random.next()) * 0.5 * k as f64) as usize);
    }
    let loops = (4..bodies).step_by(5).map(|k| (k, k - 3));
    let mut joints: Vec<_> =
        (1..bodies).map(|k| (k, k - 1)).chain(loops).map(|(a, b)| (number[a], number[b])).collect();
    joints.push((number[0], 0));
    joints
}

#[test]
fn parts_solve_what_the_whole_does() {
    let mut random = Random(31);
    let chain = Sample::chain(200, &mut random);
    agrees(&chain, &[false; 600], &[], &mut random);
    for dimension in [2, 3] {
        let joints = scattered(120, &mut random);
        let (sample, levers) = Sample::points(dimension, 120, &joints, 3, &mut random);
        agrees(&sample, &vec![false; sample.g.cols], &levers, &mut random);
    }
    // Coordinates without mass come behind their multipliers, wherever the separator is.
    let mut massless = Sample::chain(200, &mut random);
    let late: Vec<bool> = (0..600).map(|i| i % 9 == 2).collect();
    late.iter().zip(&mut massless.mass_values).filter(|(late, _)| **late).for_each(|(_, mass)| *mass = 0.0);
    agrees(&massless, &late, &[], &mut random);
}

#[test]
fn coupled_coordinates_stay_in_one_part() {
    let mut random = Random(32);
    // Pairs of bodies that M couples.
    let mut sample = Sample::chain(150, &mut random);
    for pair in 0..75 {
        sample.mass.entries.extend([(6 * pair + 3, 6 * pair), (6 * pair + 5, 6 * pair + 2)]);
        sample.mass_values.extend([0.2, -0.1]);
    }
    agrees(&sample, &[false; 450], &[], &mut random);
}

#[test]
fn a_hub_and_separate_mechanisms_are_divided() {
    let mut random = Random(33);
    // Body 1 is joined to 400 others; then ten chains on the ground.
    let joints: Vec<_> = (2..402).map(|k| (k, 1)).collect();
    let star = Sample::planar(401, &joints, &mut random);
    agrees(&star, &[vec![true; 3], vec![false; 1200]].concat(), &[], &mut random);
    let joints: Vec<_> = (1..101).map(|k| (k, if k % 10 == 1 { 0 } else { k - 1 })).collect();
    let chains = Sample::planar(100, &joints, &mut random);
    agrees(&chains, &[false; 300], &[], &mut random);
}

#[test]
fn as_many_rows_are_dropped_in_parts() {
    let mut random = Random(34);
    let mut sample = Sample::chain(120, &mut random);
    for row in [10, 70, 150, 230] {
        sample.append(&[(row, 1.5), (row - 3, -0.5)]);
    }
    let r1 = random.vector(360);
    let r2 = reachable(&sample, &mut random);
    let rule = Rule::lenient(1e-13, &sample.mass_values);
    for count in [2, 4] {
        let [expected, found] = both(&sample, &[false; 360], &[], &r1, &r2, count, rule);
        assert_eq!((found.1.len(), expected.1.len()), (4, 4));
        // Multipliers of dependent rows are any of many, the motion is the same, to round-off as above.
        assert!(distance(&found.0[..360], &expected.0[..360]) < 1e-13);
    }
}

#[test]
fn a_collapsed_pivot_is_told_by_its_number_in_the_whole() {
    let mut random = Random(35);
    let mut sample = Sample::chain(100, &mut random);
    sample.append(&[(130, 2.0)]);
    let division = Division::new(&sample.mass, &sample.g, &[false; 300], &[], 4).unwrap();
    let mut parts = Parts::new(division.into());
    let collapsed = parts.factor(&sample.mass_values, &sample.g_values, Rule::STRICT, &mut vec![]).err();
    assert!([Some(300 + 130), Some(300 + 200)].contains(&collapsed), "{collapsed:?}");
}

#[test]
fn what_is_coupled_everywhere_is_not_divided() {
    let mut random = Random(36);
    let net = Sample::net(100, &mut random);
    assert!(Division::new(&net.mass, &net.g, &vec![false; net.g.cols], &[], 4).is_none());
}
