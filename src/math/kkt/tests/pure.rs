//! A solution depends on the current values alone, never on earlier factorizations.

use super::samples::{Random, Sample};
use crate::math::kkt::{Reduced, SaddlePoint, Singular};

type Values = (Vec<f64>, Vec<f64>);
type Solution = Result<Vec<u64>, Singular>;

fn bits(a: &[f64], lambda: &[f64]) -> Vec<u64> {
    a.iter().chain(lambda).map(|x| x.to_bits()).collect()
}

fn right_side(n: usize) -> Vec<f64> {
    (0..n).map(|k| (1.0 + 1.7 * k as f64).sin()).collect()
}

/// Solutions with all rows, truncated, and with a row dropped.
fn solve(solver: &mut SaddlePoint, values: &Values, n: usize, m: usize) -> Vec<Solution> {
    let (mass, g) = values;
    solver.rank_reference = 0.3;
    let mut solved = |part: Option<f64>| {
        let factored = match part {
            Some(part) => solver.factor_truncated(mass, g, part),
            None => solver.factor(mass, g),
        };
        factored?;
        let mut top = right_side(n);
        let mut bottom = right_side(m);
        solver.solve(&mut top, &mut bottom)?;
        let rank_indicator = solver.rank_indicator();
        Ok([bits(&top, &bottom), vec![rank_indicator.to_bits()]].concat())
    };
    let mut found = vec![solved(None), solved(Some(1e-4)), solved(Some(1e-2))];
    solver.drop_rows(&[m - 1]);
    let mut top = right_side(n);
    let mut bottom = right_side(m);
    found.push(solver.factor(mass, g).and_then(|()| solver.solve(&mut top, &mut bottom)).map(|()| bits(&top, &bottom)));
    solver.drop_rows(&[]);
    found
}

/// Masses that vanish here and there, rows that depend on others or nearly so, rows of zeros, and what is not finite.
fn states(sample: &Sample, count: usize, random: &mut Random) -> Vec<Values> {
    let row = |k: usize| sample.g.entries[k].0;
    let mut state = |k: usize| {
        let mut mass = sample.mass_values.clone();
        let mut g: Vec<f64> = sample.g_values.iter().map(|g| g * (1.0 + 0.3 * random.next())).collect();
        let last = row(g.len() - 1);
        for (entry, g) in g.iter_mut().enumerate() {
            match k % 7 {
                1 if row(entry) == last => *g *= 1e-9,
                2 if row(entry) == last => *g = 0.0,
                3 => *g = sample.g_values[entry],
                _ => {}
            }
        }
        match k % 5 {
            1 => mass[0] = 0.0,
            2 => mass.iter_mut().step_by(3).for_each(|mass| *mass = 0.0),
            4 if k.is_multiple_of(2) => g[0] = f64::NAN,
            _ => {}
        }
        (mass, g)
    };
    (0..count).map(&mut state).collect()
}

/// 39 bodies on one, which is a hub, with a second joint to one of them.
fn star(random: &mut Random) -> Sample {
    let joints: Vec<(usize, usize)> = (2..=40).chain([7]).map(|body| (1, body)).collect();
    Sample::planar(40, &joints, random)
}

#[test]
fn a_used_saddle_point_solves_as_a_fresh_one() {
    let mut random = Random(31);
    let mut redundant = Sample::mechanism(&mut random);
    redundant.append(&[(3, 1.0), (8, 0.5)]);
    redundant.append(&[(0, 2.0), (7, -1.0)]);
    let samples = [
        Sample::mechanism(&mut random),
        redundant,
        Sample::chain(30, &mut random),
        star(&mut random),
        Sample::net(6, &mut random),
    ];
    for (k, sample) in samples.iter().enumerate() {
        let (n, m) = sample.sizes();
        let states = states(sample, 70, &mut random);
        let mut used = SaddlePoint::new(&sample.mass, &sample.g);
        for (i, state) in states.iter().enumerate() {
            let mut fresh = SaddlePoint::new(&sample.mass, &sample.g);
            assert_eq!(solve(&mut used, state, n, m), solve(&mut fresh, state, n, m), "sample {k}, state {i}");
        }
        let kinds = |is: fn(&SaddlePoint) -> bool| {
            let mut fresh = SaddlePoint::new(&sample.mass, &sample.g);
            states.iter().filter(|(mass, g)| fresh.factor(mass, g).is_ok() && is(&fresh)).count()
        };
        // The comparison is of more than one way.
        assert!(kinds(|solver| !solver.is_fast()) > 0, "sample {k}");
        assert!(k == 1 || kinds(SaddlePoint::is_fast) > 0, "sample {k}");
    }
}

#[test]
fn a_used_dense_solver_solves_as_a_fresh_one() {
    let mut random = Random(32);
    let sample = Sample::mechanism(&mut random);
    let (n, m) = sample.sizes();
    let make = || Reduced::new(&sample.mass, &sample.g, 1e-10).unwrap();
    let solve = |solver: &mut Reduced, (mass, g): &Values, reference: f64| -> Solution {
        let mut top = right_side(n);
        let mut bottom = right_side(m);
        solver.factor(mass, g, reference)?;
        solver.solve(&mut top, &mut bottom)?;
        Ok([bits(&top, &bottom), vec![solver.rank_indicator().to_bits()]].concat())
    };
    let mut used = make();
    for (i, state) in states(&sample, 70, &mut random).iter().enumerate() {
        for reference in [0.0, 0.05] {
            assert_eq!(solve(&mut used, state, reference), solve(&mut make(), state, reference), "state {i}");
        }
    }
}
