//! Pendulum of unit mass and length in Cartesian coordinates:
//!
//! ```text
//! x'' = -x lambda,   y'' = -g - y lambda,   0 = (x^2 + y^2 - 1)/2
//! ```
//!
//! IFToMM benchmark library, problem A01, with x mirrored.

use super::State;
use holonom::math::Scalar;
use holonom::system::Equations;

/// Coordinates x, y, m.
pub struct Pendulum;

pub const GRAVITY: f64 = 9.81;

/// Horizontal and at rest.
pub const START: State = State { t: 0.0, q: &[1.0, 0.0], v: &[0.0, 0.0], lambda: &[0.0] };

/// By Jacobi's elliptic functions.
pub const END: State = State {
    t: 10.0,
    q: &[0.2750874625761169, -0.961419205099125],
    v: &[-4.175598100951729, -1.1947490545604753],
    lambda: &[28.29456720606725],
};

impl Equations for Pendulum {
    fn size(&self) -> (usize, usize) {
        (2, 1)
    }

    fn mass<S: Scalar>(&self, _t: S, _q: &[S], mass: &mut [S]) {
        mass.copy_from_slice(&[S::one(), S::zero(), S::zero(), S::one()]);
    }

    fn force<S: Scalar>(&self, _t: S, _q: &[S], _v: &[S], f: &mut [S]) {
        f.copy_from_slice(&[S::zero(), S::constant(-GRAVITY)]);
    }

    fn phi<S: Scalar>(&self, _t: S, q: &[S], phi: &mut [S]) {
        phi[0] = (q[0].square() + q[1].square() - 1.0) * 0.5;
    }

    fn potential(&self, _t: f64, q: &[f64]) -> Option<f64> {
        Some(GRAVITY * q[1])
    }
}
