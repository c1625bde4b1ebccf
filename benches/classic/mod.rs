//! The plain baseline: DOP853 as the books have it on hand-written equations, with one projection a step.

mod andrews;
mod lu;
pub mod table;
#[path = "../../src/integrator/dop853_tableau.rs"]
#[allow(dead_code, reason = "the last rows are for interpolation")]
mod tableau;

use lu::Lu;
use tableau::{A, B, E3, E5};

type State = [f64; 14];

/// The angles reached, and the number of evaluations with a factorization, projections included.
pub struct End {
    pub q: [f64; 7],
    pub evaluations: u64,
}

/// Andrews' mechanism from rest to t = `end` with rtol = atol = `tolerance`.
///
/// Source: Hairer, Norsett, Wanner, Solving Ordinary Differential Equations I, II.10, code DOP853 with its defaults.
pub fn andrews(tolerance: f64, end: f64) -> End {
    let (mut lu, mut k) = (Lu::new(), [[0.0; 14]; 12]);
    let mut y: State = std::array::from_fn(|i| if i < 7 { andrews::START[i] } else { 0.0 });
    k[0] = andrews::derivative(&y, &mut lu);
    let (mut t, mut h, mut was_rejected) = (0.0, first_step(&y, &k[0], tolerance, end, &mut lu), false);
    let mut evaluations = 2;
    while t < end {
        if t + 1.01 * h > end {
            h = end - t;
        }
        let mut to = attempt(&y, h, &mut k, &mut lu);
        evaluations += 11;
        let error = error(&y, &to, h, &k, tolerance);
        let optimal = 0.9 * error.powf(-0.125);
        if error > 1.0 {
            h *= optimal.max(0.333);
            was_rejected = true;
            continue;
        }
        andrews::project(&mut to, &mut lu);
        k[0] = andrews::derivative(&to, &mut lu);
        evaluations += 2;
        (t, y) = (t + h, to);
        h *= optimal.clamp(0.333, if was_rejected { 1.0 } else { 6.0 });
        was_rejected = false;
    }
    End { q: std::array::from_fn(|i| y[i]), evaluations }
}

fn attempt(y: &State, h: f64, k: &mut [State; 12], lu: &mut Lu) -> State {
    for i in 1..12 {
        let stage = combined(y, h, A[i], k);
        k[i] = andrews::derivative(&stage, lu);
    }
    combined(y, h, &B, k)
}

fn combined(y: &State, h: f64, weights: &[f64], k: &[State; 12]) -> State {
    let mut sum = [0.0; 14];
    for (&weight, k) in weights.iter().zip(k).filter(|(weight, _)| **weight != 0.0) {
        for i in 0..14 {
            sum[i] += weight * k[i];
        }
    }
    std::array::from_fn(|i| y[i] + h * sum[i])
}

fn error(from: &State, to: &State, h: f64, k: &[State; 12], tolerance: f64) -> f64 {
    let square = |weights: &[f64; 12]| {
        let error = combined(&[0.0; 14], 1.0, weights, k);
        (0..14).map(|i| (error[i] / (tolerance * (1.0 + from[i].abs().max(to[i].abs())))).powi(2)).sum::<f64>()
    };
    let (fifth, third) = (square(&E5), square(&E3));
    h * fifth / (14.0 * (fifth + 0.01 * third)).sqrt()
}

/// The code's HINIT.
fn first_step(y: &State, slope: &State, tolerance: f64, end: f64, lu: &mut Lu) -> f64 {
    let norm = |x: &State| (0..14).map(|i| (x[i] / (tolerance * (1.0 + y[i].abs()))).powi(2)).sum::<f64>();
    let (d0, d1) = (norm(y), norm(slope));
    let guess = if d0 <= 1e-10 || d1 <= 1e-10 { 1e-6 } else { (0.01 * (d0 / d1).sqrt()).min(end) };
    let ahead = andrews::derivative(&std::array::from_fn(|i| y[i] + guess * slope[i]), lu);
    let d2 = norm(&std::array::from_fn(|i| ahead[i] - slope[i])).sqrt() / guess;
    (0.01 / d2.max(d1.sqrt())).powf(0.125).min(100.0 * guess).min(end)
}
