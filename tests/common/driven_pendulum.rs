//! Two points on rods below a pivot that moves in a prescribed way, in Cartesian coordinates: a smooth motion with
//! constraints that are nonlinear, coupled and time-dependent.

use holonom::math::Scalar;
use holonom::system::Equations;

/// Coordinates x1, y1, x2, y2, m.
pub struct DrivenPendulum;

/// Masses, kg, and lengths of the rods, m.
const MASSES: [f64; 2] = [1.0, 0.1];
const LENGTHS: [f64; 2] = [1.0, 0.8];
const GRAVITY: f64 = 9.81;
/// Drag of the points, N s/m.
const DRAG: f64 = 0.1;

/// Where the pivot is.
fn pivot<S: Scalar>(t: S) -> [S; 2] {
    [t.sin() * 0.6, (t * 2.0).cos() * 0.1]
}

/// q and v at t = 0, where the pivot is at (0, 0.1) and moves with (0.6, 0) m/s.
pub fn start() -> ([f64; 4], [f64; 4]) {
    let angles: [f64; 2] = [0.6, 0.3];
    let rates = [0.3, -0.2];
    let mut r = [0.0, 0.1];
    let mut v = [0.6, 0.0];
    let mut q = [0.0; 4];
    let mut qdot = [0.0; 4];
    for i in 0..2 {
        let (sin, cos) = angles[i].sin_cos();
        r = [r[0] + LENGTHS[i] * sin, r[1] - LENGTHS[i] * cos];
        v = [v[0] + rates[i] * LENGTHS[i] * cos, v[1] + rates[i] * LENGTHS[i] * sin];
        q[2 * i..2 * i + 2].copy_from_slice(&r);
        qdot[2 * i..2 * i + 2].copy_from_slice(&v);
    }
    (q, qdot)
}

impl Equations for DrivenPendulum {
    fn size(&self) -> (usize, usize) {
        (4, 2)
    }

    fn mass<S: Scalar>(&self, _t: S, _q: &[S], mass: &mut [S]) {
        mass.fill(S::zero());
        (0..4).for_each(|i| mass[5 * i] = S::constant(MASSES[i / 2]));
    }

    fn force<S: Scalar>(&self, _t: S, _q: &[S], v: &[S], f: &mut [S]) {
        for i in 0..2 {
            f[2 * i] = v[2 * i] * -DRAG;
            f[2 * i + 1] = v[2 * i + 1] * -DRAG - MASSES[i] * GRAVITY;
        }
    }

    fn phi<S: Scalar>(&self, t: S, q: &[S], phi: &mut [S]) {
        let pivot = pivot(t);
        let half_square = |x: S, y: S| (x.square() + y.square()) * 0.5;
        phi[0] = half_square(q[0] - pivot[0], q[1] - pivot[1]) - 0.5 * LENGTHS[0] * LENGTHS[0];
        phi[1] = half_square(q[2] - q[0], q[3] - q[1]) - 0.5 * LENGTHS[1] * LENGTHS[1];
    }
}
