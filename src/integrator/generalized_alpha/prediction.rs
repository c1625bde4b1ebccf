//! The prediction of v' and lambda at the end of a step.

use super::super::memory::fill;
use crate::math::array::from_fn;
use crate::system::Dimensions;
use serde::{Deserialize, Serialize};

/// Number of points of the polynomials.
const POINTS: usize = 3;

/// The quantities that one step passes on to the next.
#[derive(Clone, Serialize, Deserialize)]
pub(super) struct StepState {
    /// Step size for which `a` is valid.
    pub h: f64,
    pub a: Vec<f64>,
    pub vdot: Vec<f64>,
    pub lambda: Vec<f64>,
}

impl StepState {
    pub fn new(n: Dimensions) -> Self {
        StepState { h: 1.0, a: vec![0.0; n.v], vdot: vec![0.0; n.v], lambda: vec![0.0; n.lambda] }
    }

    /// Takes over saved quantities.
    pub fn recall(&mut self, saved: &StepState) {
        self.h = saved.h;
        fill(&mut self.a, &saved.a);
        fill(&mut self.vdot, &saved.vdot);
        fill(&mut self.lambda, &saved.lambda);
    }
}

/// Extrapolates v' and lambda from the ends of the last steps, by the polynomial of degree 0, 1 or 2 that would have
/// predicted the last v' best: smooth motions want the highest degree, jumps and fast modes that steps do not follow
/// the lowest.
#[derive(Clone, Serialize, Deserialize)]
pub(super) struct Prediction {
    /// States before the start of the present step, the last one first.
    past: [Past; POINTS - 1],
    known: usize,
    degree: usize,
    /// Number of v' that the degree is chosen by: without those of states, which have units of their own.
    moving: usize,
}

#[derive(Clone, Serialize, Deserialize)]
struct Past {
    /// Time from there to the start of the present step, s.
    age: f64,
    vdot: Vec<f64>,
    lambda: Vec<f64>,
}

impl Prediction {
    pub fn new(n: Dimensions) -> Self {
        let past = || Past { age: 0.0, vdot: vec![0.0; n.v], lambda: vec![0.0; n.lambda] };
        Prediction { past: [past(), past()], known: 0, degree: 0, moving: n.moving() }
    }

    /// Degree of the present polynomial.
    pub fn degree(&self) -> usize {
        self.degree
    }

    /// Time from the state before the start of the present step to it, s, and v' `i` there.
    pub fn last(&self, i: usize) -> Option<(f64, f64)> {
        (self.known > 0).then(|| (self.past[0].age, self.past[0].vdot[i]))
    }

    /// Forgets all states before the start of the present step.
    pub fn restart(&mut self) {
        (self.known, self.degree) = (0, 0);
    }

    /// Weights of the start and the states before it in the value after a step `h`: Lagrange's polynomials.
    fn weights(&self, degree: usize, h: f64) -> [f64; POINTS] {
        let points = [0.0, -self.past[0].age, -self.past[1].age];
        from_fn(|i| {
            let others = points[..=degree].iter().enumerate().filter(|(j, _)| *j != i);
            if i > degree { 0.0 } else { others.map(|(_, x)| (h - x) / (points[i] - x)).product() }
        })
    }

    /// Writes v' and lambda after a step `h` to `end`.
    pub fn predict(&self, start: &StepState, h: f64, end: &mut StepState) {
        let weights = self.weights(self.degree, h);
        let [first, second] = &self.past;
        extrapolate(weights, [&start.vdot, &first.vdot, &second.vdot], |i, x| end.vdot[i] = x);
        extrapolate(weights, [&start.lambda, &first.lambda, &second.lambda], |i, x| end.lambda[i] = x);
    }

    /// Chooses the degree by the step from `start` to `end`, which is accepted, and keeps `start`.
    pub fn accepted(&mut self, start: &StepState, end: &StepState) {
        let error = |degree: usize| {
            let mut error = 0.0_f64;
            let points = [&start.vdot, &self.past[0].vdot, &self.past[1].vdot];
            extrapolate(self.weights(degree, end.h), points.map(|x| &x[..self.moving]), |i, x| {
                error = error.max((x - end.vdot[i]).abs());
            });
            error
        };
        let errors = (0..=self.known).map(|degree| (degree, error(degree)));
        self.degree = errors.min_by(|a, b| a.1.total_cmp(&b.1)).map_or(0, |(degree, _)| degree);
        self.known = (self.known + 1).min(POINTS - 1);
        self.past.swap(0, 1);
        let [first, second] = &mut self.past;
        first.vdot.copy_from_slice(&start.vdot);
        first.lambda.copy_from_slice(&start.lambda);
        (first.age, second.age) = (end.h, second.age + end.h);
    }

    /// Takes over a saved prediction.
    pub fn recall(&mut self, saved: &Prediction) {
        self.known = saved.known.min(POINTS - 1);
        self.degree = saved.degree.min(self.known);
        for (Past { age, vdot, lambda }, saved) in self.past.iter_mut().zip(&saved.past) {
            *age = saved.age;
            fill(vdot, &saved.vdot);
            fill(lambda, &saved.lambda);
        }
    }
}

/// Sums of three vectors with these weights.
fn extrapolate(weights: [f64; POINTS], points: [&[f64]; POINTS], mut see: impl FnMut(usize, f64)) {
    let [a, b, c] = weights;
    for (i, ((x, y), z)) in points[0].iter().zip(points[1]).zip(points[2]).enumerate() {
        see(i, a * x + b * y + c * z);
    }
}
