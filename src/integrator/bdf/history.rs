//! The states of the last steps and the polynomials through them.

use crate::integrator::memory::fill;
use crate::integrator::sums::accumulate;
use crate::integrator::{StepStart, Tolerance};
use crate::math::array::from_fn;
use crate::math::{lagrange, lagrange_rate};
use serde::{Deserialize, Serialize};

/// Highest order of the method.
pub const HIGHEST: usize = 5;

/// States kept: those that predict a step of the highest order.
const POINTS: usize = HIGHEST + 1;

/// The last states, the newest first.
pub struct History {
    known: usize,
    times: [f64; POINTS],
    y: Vec<Vec<f64>>,
    lambda: Vec<Vec<f64>>,
}

/// The known states.
#[derive(Serialize, Deserialize)]
pub struct HistoryMemory {
    times: Vec<f64>,
    y: Vec<Vec<f64>>,
    lambda: Vec<Vec<f64>>,
}

impl History {
    /// Memory for states of length `len` with `rows` multipliers.
    pub fn new(len: usize, rows: usize) -> Self {
        let y = vec![vec![0.0; len]; POINTS];
        let lambda = vec![vec![0.0; rows]; POINTS];
        History { known: 0, times: [0.0; POINTS], y, lambda }
    }

    /// Adds the start of a step. Before the first one, a step earlier, a state on its tangent is taken for known.
    pub fn add(&mut self, from: StepStart, lambda: &[f64]) {
        self.y.rotate_right(1);
        self.lambda.rotate_right(1);
        self.times.rotate_right(1);
        self.times[0] = from.t;
        self.y[0].copy_from_slice(from.y);
        self.lambda[0].copy_from_slice(lambda);
        self.known = (self.known + 1).min(POINTS);
        if self.known == 1 {
            self.times[1] = from.t - from.h;
            self.y[1].copy_from_slice(from.y);
            self.y[1].iter_mut().zip(from.slope).for_each(|(y, slope)| *y -= from.h * slope);
            self.lambda[1].copy_from_slice(lambda);
            self.known = 2;
        }
    }

    /// Replaces the newest state.
    pub fn replace(&mut self, from: StepStart) {
        self.y[0].copy_from_slice(from.y);
    }

    /// Forgets all states.
    pub fn restart(&mut self) {
        self.known = 0;
    }

    /// Number of states.
    pub fn known(&self) -> usize {
        self.known
    }

    /// Time from the state `i` to `t`, s.
    pub fn age(&self, i: usize, t: f64) -> f64 {
        t - self.times[i]
    }

    fn weights(&self, degree: usize, weight: impl Fn(&[f64], usize) -> f64) -> [f64; POINTS] {
        from_fn(|i| if i <= degree { weight(&self.times[..=degree], i) } else { 0.0 })
    }

    /// Writes the polynomial of this degree at `t`, and its derivative.
    pub fn predict(&self, degree: usize, t: f64, y: &mut [f64], rate: &mut [f64]) {
        for (out, weight) in [(y, lagrange as fn(&[f64], usize, f64) -> f64), (rate, lagrange_rate)] {
            out.fill(0.0);
            accumulate(out, 1.0, &self.weights(degree, |times, i| weight(times, i, t)), &self.y);
        }
    }

    /// Writes lambda of the polynomial of this degree at `t`.
    pub fn predict_lambda(&self, degree: usize, t: f64, lambda: &mut [f64]) {
        accumulate(lambda, 1.0, &self.weights(degree, |times, i| lagrange(times, i, t)), &self.lambda);
    }

    /// Norm of h^(k+1) y^(k+1) for k = `degree`, from the distance of the new state `to` at `t` = from + h to the
    /// polynomial of this degree: (k+1)! h^(k+1)/prod(t - t_i) times that. `change` is scratch.
    pub fn derivative(
        &self,
        degree: usize,
        t: f64,
        h: f64,
        tolerance: &Tolerance,
        to: &[f64],
        change: &mut [f64],
    ) -> f64 {
        change.copy_from_slice(to);
        accumulate(change, -1.0, &self.weights(degree, |times, i| lagrange(times, i, t)), &self.y);
        let factor: f64 = (0..=degree).map(|i| (i + 1) as f64 * h / self.age(i, t)).product();
        factor * tolerance.norm_between(&self.y[0], to, change)
    }

    /// Writes the polynomial through the new state `to`, at `end`, and the last `order` states.
    pub fn interpolate(&self, order: usize, end: f64, to: &[f64], t: f64, out: &mut [f64]) {
        let mut times = [end; POINTS];
        times[1..=order].copy_from_slice(&self.times[..order]);
        let weight = |i: usize| lagrange(&times[..=order], i, t);
        let weights: [f64; POINTS] = from_fn(|i| if i < order { weight(i + 1) } else { 0.0 });
        out.iter_mut().zip(to).for_each(|(out, to)| *out = weight(0) * to);
        accumulate(out, 1.0, &weights, &self.y);
    }

    /// The states for [`Self::recall`].
    pub fn memory(&self) -> HistoryMemory {
        let known = ..self.known;
        HistoryMemory {
            times: self.times[known].to_vec(),
            y: self.y[known].to_vec(),
            lambda: self.lambda[known].to_vec(),
        }
    }

    /// Restores a [`memory`](Self::memory).
    pub fn recall(&mut self, HistoryMemory { times, y, lambda }: HistoryMemory) {
        self.known = times.len().min(POINTS);
        fill(&mut self.times, &times);
        self.y.iter_mut().zip(&y).for_each(|(own, y)| fill(own, y));
        self.lambda.iter_mut().zip(&lambda).for_each(|(own, lambda)| fill(own, lambda));
    }
}
