//! The exponential map of the coordinates.

use crate::system::MechanicalSystem;

/// q = q0 exp(change): a constant rate by the classical Runge-Kutta method, with an error of O(|change|^5).
pub fn turn(system: &dyn MechanicalSystem, stages: &mut [Vec<f64>; 3], q0: &[f64], change: &[f64], q: &mut [f64]) {
    if q.len() == system.dimensions().moving() {
        q.iter_mut().zip(q0.iter().zip(change)).for_each(|(q, (q0, dq))| *q = q0 + dq);
        return;
    }
    let [rate, stage, sum] = stages;
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
    system.normalize(q);
}
