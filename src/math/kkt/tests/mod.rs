//! Solutions against dense oracles.

mod dropped;
mod parts;
mod pure;
mod redundant;
mod regular;
mod reports;
mod samples;
mod small;

use super::SaddlePoint;
use samples::{Random, Sample, distance};

pub fn solved(sample: &Sample, r1: &[f64], r2: &[f64]) -> (Vec<f64>, Vec<f64>, SaddlePoint) {
    let mut solver = SaddlePoint::new(&sample.mass, &sample.g);
    solver.factor(&sample.mass_values, &sample.g_values).unwrap();
    let mut a = r1.to_vec();
    let mut lambda = r2.to_vec();
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
    assert!(!solver.is_rank_deficient());
    agree(&a, &lambda, sample.by_lu(&r1, &r2), tolerance);
}

/// The solver that has found what the pseudo-inverse gives.
pub fn agreeing_with_svd(sample: &Sample, random: &mut Random, tolerance: f64) -> SaddlePoint {
    let r1 = random.vector(sample.sizes().0);
    let r2 = reachable(sample, random);
    let (a, lambda, solver) = solved(sample, &r1, &r2);
    agree(&a, &lambda, sample.by_svd(&r1, &r2), tolerance);
    solver
}

/// Refuses a and lambda unless they are these.
pub fn agree(a: &[f64], lambda: &[f64], expected: (Vec<f64>, Vec<f64>), tolerance: f64) {
    assert!(distance(a, &expected.0) < tolerance, "a {:e}", distance(a, &expected.0));
    assert!(distance(lambda, &expected.1) < tolerance, "lambda {:e}", distance(lambda, &expected.1));
}
