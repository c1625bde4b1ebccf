//! Solutions against dense oracles.

mod dropped;
mod pure;
mod redundant;
mod regular;
mod reports;
mod samples;

use super::SaddlePoint;
use samples::{Random, Sample, distance};

pub fn solved(sample: &Sample, r1: &[f64], r2: &[f64]) -> (Vec<f64>, Vec<f64>, SaddlePoint) {
    let mut solver = SaddlePoint::new(&sample.mass, &sample.g);
    solver.factor(&sample.mass_values, &sample.g_values).unwrap();
    let (mut a, mut lambda) = (r1.to_vec(), r2.to_vec());
    solver.solve(&mut a, &mut lambda).unwrap();
    (a, lambda, solver)
}

pub fn right_side(sample: &Sample, random: &mut Random) -> (Vec<f64>, Vec<f64>) {
    let (n, m) = sample.sizes();
    (random.vector(n), random.vector(m))
}

/// G x for a random x: right sides without contradiction.
pub fn reachable(sample: &Sample, random: &mut Random) -> Vec<f64> {
    let (n, m) = sample.sizes();
    let mut b = vec![0.0; m];
    sample.g.multiply(&sample.g_values, &random.vector(n), &mut b);
    b
}

pub fn agrees_with_lu(sample: &Sample, random: &mut Random, tolerance: f64) {
    let (r1, r2) = right_side(sample, random);
    let (a, lambda, solver) = solved(sample, &r1, &r2);
    let (a_lu, lambda_lu) = sample.by_lu(&r1, &r2);
    assert!(!solver.is_rank_deficient());
    assert!(distance(&a, &a_lu) < tolerance, "a {:e}", distance(&a, &a_lu));
    assert!(distance(&lambda, &lambda_lu) < tolerance, "lambda {:e}", distance(&lambda, &lambda_lu));
}
