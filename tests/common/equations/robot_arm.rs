//! Constrained robot arm: two uniform links whose end effector has a prescribed height.
//!
//! ```text
//! M(theta2) v' = f(theta, v) - G^T lambda
//! 0 = l sin theta1 + l sin(theta1 + theta2) - sin^2(t/2)
//! ```
//!
//! The motion amplifies a perturbation about 1e4 times over the 10 s. Ascher, Chin, Petzold, Reich, Mech. Struct. Mach.
//! 23 (1995) 135-157.

use super::State;
use holonom::math::Scalar;
use holonom::system::Equations;

/// Coordinates: the angle of the first link against the horizontal, and that of the second against the first.
pub struct RobotArm;

/// Length of a link, m.
const LENGTH: f64 = 1.0;
/// Mass of a link, kg.
const MASS: f64 = 36.0;
const GRAVITY: f64 = 9.81;

/// At rest.
pub const START: State = State {
    t: 0.0,
    q: &[70.0_f64.to_radians(), -140.0_f64.to_radians()],
    v: &[0.0, 0.0],
    lambda: &[-299.40705461759256],
};

/// Extrapolation with 34 digits, of two formulations that agree in 23.
pub const END: State = State {
    t: 10.0,
    q: &[1.1065356342522548, 2.0096713719642834],
    v: &[5.597507174666239, -2.8182508678092315],
    lambda: &[17.319605343733983],
};

impl Equations for RobotArm {
    fn size(&self) -> (usize, usize) {
        (2, 1)
    }

    /// T = v^T M v / 2 of two rods (1/3 m l^2 about their ends), the second carried by the first.
    fn mass<S: Scalar>(&self, _t: S, theta: &[S], mass: &mut [S]) {
        let unit = MASS * LENGTH * LENGTH;
        let cos = theta[1].cos();
        mass[0] = (cos + 5.0 / 3.0) * unit;
        mass[1] = (cos * 0.5 + 1.0 / 3.0) * unit;
        mass[2] = mass[1];
        mass[3] = S::constant(unit / 3.0);
    }

    /// Weight, and the velocity-dependent part of d/dt(dT/dv) - dT/dq with its sign turned.
    fn force<S: Scalar>(&self, _t: S, theta: &[S], omega: &[S], f: &mut [S]) {
        let inertia = theta[1].sin() * (0.5 * MASS * LENGTH * LENGTH);
        let weight = 0.5 * MASS * GRAVITY * LENGTH;
        let first = theta[0].cos() * weight;
        let second = (theta[0] + theta[1]).cos() * weight;
        f[0] = inertia * omega[1] * (omega[0] * 2.0 + omega[1]) - first * 3.0 - second;
        f[1] = -inertia * omega[0].square() - second;
    }

    /// Height of the end effector less sin^2(t/2).
    fn phi<S: Scalar>(&self, t: S, theta: &[S], phi: &mut [S]) {
        phi[0] = (theta[0].sin() + (theta[0] + theta[1]).sin()) * LENGTH - (t * 0.5).sin().square();
    }

    fn potential(&self, _t: f64, theta: &[f64]) -> Option<f64> {
        let height = 1.5 * theta[0].sin() + 0.5 * (theta[0] + theta[1]).sin();
        Some(MASS * GRAVITY * LENGTH * height)
    }
}
