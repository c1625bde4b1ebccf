//! The exponential map of the coordinates.

use crate::math::array::from_fn;
use crate::math::rotation::{quaternion_from_vector, quaternion_product};
use crate::system::{MechanicalSystem, Rotation};

/// q = q0 exp(change), with its memory. Unit quaternions are multiplied by that of the rotation vector in `change`,
/// which is exact. Other coordinates with q' = N(q) v, as angles that count full turns, move at a constant v by the
/// classical Runge-Kutta method, with an error of O(|change|^5).
pub struct ExponentialMap {
    rotations: Vec<Rotation>,
    stages: [Vec<f64>; 3],
}

impl ExponentialMap {
    /// Memory for a system.
    pub fn new(system: &dyn MechanicalSystem) -> Self {
        let n = system.dimensions().q;
        ExponentialMap { rotations: system.facts().rotations.clone(), stages: std::array::from_fn(|_| vec![0.0; n]) }
    }

    /// Writes q0 exp(change) to `q`; `change` is along the directions of v.
    pub fn apply(&mut self, system: &dyn MechanicalSystem, q0: &[f64], change: &[f64], q: &mut [f64]) {
        if q.len() == system.dimensions().moving() {
            q.iter_mut().zip(q0.iter().zip(change)).for_each(|(q, (q0, dq))| *q = q0 + dq);
            return;
        }
        let [rate, stage, sum] = &mut self.stages;
        stage.copy_from_slice(q0);
        sum.fill(0.0);
        for (ahead, weight) in [(0.5, 1.0 / 6.0), (0.5, 1.0 / 3.0), (1.0, 1.0 / 3.0), (0.0, 1.0 / 6.0)] {
            system.rate(stage, change, rate);
            for i in 0..rate.len() {
                sum[i] += weight * rate[i];
                stage[i] = q0[i] + ahead * rate[i];
            }
        }
        q.iter_mut().zip(q0.iter().zip(sum.iter())).for_each(|(q, (q0, dq))| *q = q0 + dq);
        for place in &self.rotations {
            rotate(place, &from_fn(|i| change[place.v + i]), q0, q);
        }
        system.normalize(q);
    }

    /// The largest angle by which `change` turns a quaternion, rad.
    pub fn largest_angle(&self, change: &[f64]) -> f64 {
        let angle = |place: &Rotation| (0..3).map(|i| change[place.v + i].powi(2)).sum::<f64>().sqrt();
        self.rotations.iter().map(angle).fold(0.0, f64::max)
    }
}

/// Sets the unit quaternion at this place to p = p0 exp(vector).
pub fn rotate(place: &Rotation, vector: &[f64; 3], q0: &[f64], q: &mut [f64]) {
    let rotated = quaternion_product(&from_fn(|i| q0[place.q + i]), &quaternion_from_vector(vector));
    q[place.q..place.q + 4].copy_from_slice(&rotated);
}
