//! Drift of the constraints.

use crate::math::{largest, largest_in};
use crate::simulate::Observation;
use crate::tolerances;
use serde::Serialize;

/// Constraint drift at the three levels: phi, phi' = G v + phi_t and phi'' = G v' - gamma.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Drift {
    /// Drift of phi, m or rad.
    pub position: DriftLevel,
    /// Drift of phi', m/s or rad/s.
    pub velocity: DriftLevel,
    /// Drift of phi'', m/s^2 or rad/s^2.
    pub acceleration: DriftLevel,
}

/// Largest component of a residual. Relative values are divided by the scale of the row (a length for rows in metres, 1
/// rad for angles) over powers of the time unit.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct DriftLevel {
    /// Largest over the accepted steps and the rows.
    pub max: f64,
    /// Largest component at the end.
    #[serde(rename = "final")]
    pub last: f64,
    /// Largest over the run, relative.
    pub relative_max: f64,
    /// Largest component at the end, relative.
    pub relative_final: f64,
}

impl Drift {
    /// Adds a state; `scales` are those of the rows of phi.
    pub fn add(&mut self, state: &Observation, scales: &[f64]) {
        self.position.add(state.phi, scales);
        self.velocity.add(state.phi_dot, scales);
        self.acceleration.add(state.phi_ddot, scales);
    }

    /// True if the joints came apart so far that the motion means nothing.
    pub fn has_open_joints(&self) -> bool {
        let open = self.position.relative_max;
        open.is_nan() || open > tolerances::WRONG_MOTION
    }
}

impl DriftLevel {
    fn add(&mut self, rows: &[f64], scales: &[f64]) {
        self.last = largest(rows);
        self.relative_final = largest_in(scales, rows);
        self.max = self.max.max(self.last);
        self.relative_max = self.relative_max.max(self.relative_final);
    }
}
