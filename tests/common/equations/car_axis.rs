//! Car axis on a bumpy road: a rigid bar from (xl, yl) to (xr, yr) on two springs, whose feet are the left wheel at the
//! origin and the right one at (xb, yb).
//!
//! ```text
//! eps^2 M/2 p'' = springs(t, p) - weight - G^T lambda,   p = (xl, yl, xr, yr)
//! 0 = xl xb + yl yb                       the left spring stays square to the line of the wheels
//! 0 = (xl - xr)^2 + (yl - yr)^2 - L^2     the bar keeps its length
//! yb = r sin(w t),   xb = sqrt(L^2 - yb^2)
//! ```
//!
//! The constraints move, and the mass is small against the springs (eps = 0.01). Schneider's thesis (Geneva, 1994); IVP
//! test set, problem `caraxis`, whose lambda has the other sign.

use super::State;
use holonom::math::Scalar;
use holonom::system::Equations;

/// Coordinates xl, yl, xr, yr, m.
pub struct CarAxis;

const EPS: f64 = 1e-2;
const MASS: f64 = 10.0;
/// Length of the bar, which is also the distance of the wheels, and that of the unstretched springs, m.
const LENGTH: f64 = 1.0;
const SPRING: f64 = 0.5;
/// Height of the bumps, m, and their frequency, rad/s.
const BUMP: f64 = 0.1;
const OMEGA: f64 = 10.0;

/// eps^2 M/2
const INERTIA: f64 = EPS * EPS * MASS / 2.0;

pub const START: State = State { t: 0.0, q: &[0.0, 0.5, 1.0, 0.5], v: &[-0.5, 0.0, -0.5, 0.0], lambda: &[0.0, 0.0] };

/// Computation in binary128; the published values have 12.2 correct digits of q, 9.2 of v and 7.1 of lambda.
pub const END: State = State {
    t: 3.0,
    q: &[0.049345578427524094, 0.4969894602300081, 1.0417425248854262, 0.3739110272653658],
    v: &[-0.07705836840359208, 0.007446866592068417, 0.017556815753541736, 0.7703410437796011],
    lambda: &[0.004736886590853326, 0.0011046803312595658],
};

/// Where the right wheel is.
fn road<S: Scalar>(t: S) -> [S; 2] {
    let y = (t * OMEGA).sin() * BUMP;
    [(-y.square() + LENGTH * LENGTH).sqrt(), y]
}

/// Force of a spring of unit stiffness along (x, y).
fn spring<S: Scalar>(x: S, y: S) -> [S; 2] {
    let tension = (x.square() + y.square()).sqrt().recip() * SPRING - 1.0;
    [tension * x, tension * y]
}

impl Equations for CarAxis {
    fn size(&self) -> (usize, usize) {
        (4, 2)
    }

    fn mass<S: Scalar>(&self, _t: S, _q: &[S], mass: &mut [S]) {
        mass.fill(S::zero());
        (0..4).for_each(|i| mass[5 * i] = S::constant(INERTIA));
    }

    fn force<S: Scalar>(&self, t: S, q: &[S], _v: &[S], f: &mut [S]) {
        let [xb, yb] = road(t);
        let left = spring(q[0], q[1]);
        let right = spring(q[2] - xb, q[3] - yb);
        f.copy_from_slice(&[left[0], left[1] - INERTIA, right[0], right[1] - INERTIA]);
    }

    fn phi<S: Scalar>(&self, t: S, q: &[S], phi: &mut [S]) {
        let [xb, yb] = road(t);
        phi[0] = q[0] * xb + q[1] * yb;
        phi[1] = (q[0] - q[2]).square() + (q[1] - q[3]).square() - LENGTH * LENGTH;
    }
}
