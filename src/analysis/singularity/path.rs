//! Interpolation of the motion between accepted states.

use crate::math::array::Each;
use crate::simulate::Observation;

/// An accepted state.
#[derive(Clone, Debug, Default)]
pub struct PathPoint {
    pub t: f64,
    pub rank_indicator: f64,
    pub q: Vec<f64>,
    pub v: Vec<f64>,
    pub vdot: Vec<f64>,
    pub phi: Vec<f64>,
    pub phi_dot: Vec<f64>,
}

impl PathPoint {
    /// Copies a state; only its first `moving` velocities, since states xi have no singular positions.
    pub fn copy(&mut self, state: &Observation, rank_indicator: f64, moving: usize) {
        (self.t, self.rank_indicator) = (state.t, rank_indicator);
        let PathPoint { q, v, vdot, phi, phi_dot, .. } = self;
        let all = [(q, state.q), (v, state.v), (vdot, state.vdot), (phi, state.phi), (phi_dot, state.phi_dot)];
        for (own, other) in all {
            own.clear();
            own.extend_from_slice(other);
        }
        [v, vdot].into_iter().for_each(|rates| rates[moving..].fill(0.0));
    }
}

/// The polynomial of fifth degree through the positions and rates of three states, by divided differences over their
/// doubled times.
pub struct Path {
    pub times: [f64; 3],
    /// Six coefficients for each coordinate.
    coefficients: Vec<[f64; 6]>,
    /// phi of the middle state.
    pub phi: Vec<f64>,
}

impl Path {
    /// Interpolates; `rates` are q' at the samples.
    pub fn new(samples: &[PathPoint; 3], rates: &[Vec<f64>; 3]) -> Self {
        let times = [0, 1, 2].each(|i: usize| samples[i].t);
        let doubled = [0, 1, 2, 3, 4, 5].each(|i: usize| times[i / 2]);
        let coordinate = |k: usize| {
            let mut table = [0, 1, 2, 3, 4, 5].each(|i: usize| samples[i / 2].q[k]);
            for order in 1..6 {
                for i in (order..6).rev() {
                    let width = doubled[i] - doubled[i - order];
                    table[i] = if width == 0.0 { rates[i / 2][k] } else { (table[i] - table[i - 1]) / width };
                }
            }
            table
        };
        let coefficients = (0..samples[0].q.len()).map(coordinate).collect();
        Path { times, coefficients, phi: samples[1].phi.clone() }
    }

    pub fn at(&self, t: f64) -> Vec<f64> {
        let [a, b, c] = self.times.each(|time| t - time);
        let horner = |k: &[f64; 6]| k[0] + a * (k[1] + a * (k[2] + b * (k[3] + b * (k[4] + c * k[5]))));
        self.coefficients.iter().map(horner).collect()
    }
}
