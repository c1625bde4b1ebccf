//! The unit quaternions of the stages.

use super::collocation::Collocation;
use crate::formulation::rotate;
use crate::integrator::sums::accumulate;
use crate::math::array::from_fn;
use crate::math::largest;
use crate::math::rotation::rotation_vector_rate;
use crate::system::{MechanicalSystem, Rotation};

/// Rotation vectors a_i from the start of a step to its stages, which are collocated in the place of the quaternions:
///
/// ```text
/// a_i = h sum a_ij a'(a_j, w_j),   p_i = p_0 exp(a_i)
/// ```
///
/// Polynomials of the quaternions would have order s at the stages, where phi = 0 bends stiff bodies by the difference,
/// and where the axis is fixed these are exact. Source: Munthe-Kaas, BIT 38 (1998) 92-111.
pub struct Rotations {
    places: Vec<Rotation>,
    /// By stages, three numbers a rotation, rad and rad/s.
    vectors: Vec<Vec<f64>>,
    rates: Vec<Vec<f64>>,
}

fn three(all: &[f64], first: usize) -> [f64; 3] {
    from_fn(|i| all[first + i])
}

impl Rotations {
    pub fn new(most: usize, system: &dyn MechanicalSystem) -> Self {
        let places = system.facts().rotations.clone();
        let [vectors, rates] = [0; 2].map(|_| vec![vec![0.0; 3 * places.len()]; most]);
        Rotations { places, vectors, rates }
    }

    /// Sets all stages to the start.
    pub fn reset(&mut self) {
        self.vectors.iter_mut().for_each(|vectors| vectors.fill(0.0));
    }

    /// Sets the rates at stage `i` with these velocities.
    pub fn set_rates(&mut self, i: usize, velocity: &[f64]) {
        for (k, place) in self.places.iter().enumerate() {
            let rate = rotation_vector_rate(&three(&self.vectors[i], 3 * k), &three(velocity, place.v));
            self.rates[i][3 * k..3 * k + 3].copy_from_slice(&rate);
        }
    }

    /// Moves the quaternions of stage `i`, with its row of A, from those in `start`.
    pub fn advance(&mut self, i: usize, row: &[f64], h: f64, start: &[f64], q: &mut [f64]) {
        self.vectors[i].fill(0.0);
        accumulate(&mut self.vectors[i], h, row, &self.rates);
        for (k, place) in self.places.iter().enumerate() {
            rotate(place, &three(&self.vectors[i], 3 * k), start, q);
        }
    }

    /// Writes h (start + sum weights_i a'_i) to the places of the rotations in `x`: the rates of the vectors are
    /// integrated, and differ from the velocities where the axis moves.
    pub fn combine(&self, h: f64, weights: &[f64], start: impl Fn(usize) -> f64, x: &mut [f64]) {
        for (k, place) in self.places.iter().enumerate() {
            for i in 0..3 {
                let stages = self.rates.iter().zip(weights).map(|(rates, weight)| weight * rates[3 * k + i]);
                x[place.v + i] = h * (start(place.v + i) + stages.sum::<f64>());
            }
        }
    }

    /// Sets the quaternions at the fraction `theta` of the step, by the polynomials of the vectors.
    pub fn interpolate(&self, method: &Collocation, theta: f64, start: &[f64], q: &mut [f64]) {
        for (k, place) in self.places.iter().enumerate() {
            let mut vector = [0.0; 3];
            for (i, vectors) in self.vectors.iter().enumerate().take(method.stages()) {
                let weight = method.lagrange(i + 1, theta);
                vector.iter_mut().zip(three(vectors, 3 * k)).for_each(|(sum, part)| *sum += weight * part);
            }
            rotate(place, &vector, start, q);
        }
    }

    /// The largest component of a rotation vector, rad.
    pub fn largest(&self) -> f64 {
        self.vectors.iter().map(|vectors| largest(vectors)).fold(0.0, f64::max)
    }
}
