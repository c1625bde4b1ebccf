//! Own equations to copy from: M, f and phi, written once over any scalar, each mechanism in a file of its own with its
//! consistent start and, where there is one, the end of a reference solution.

#![allow(dead_code, reason = "each test binary uses its own part")]

pub mod andrews;
pub mod car_axis;
pub mod crank;
pub mod heavy_top;
pub mod pendulum;
pub mod robot_arm;

/// A state of a reference solution. M v' + G^T lambda = f gives the sign of lambda.
pub struct State {
    pub t: f64,
    pub q: &'static [f64],
    pub v: &'static [f64],
    pub lambda: &'static [f64],
}

impl State {
    pub fn motion(&self) -> (&[f64], &[f64]) {
        (self.q, self.v)
    }
}
