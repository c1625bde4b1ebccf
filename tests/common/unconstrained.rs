//! Motions without constraints whose solutions are known.

use holonom::math::Scalar;
use holonom::system::Equations;

/// q'' = v^2/q - q sin t with q = exp(sin t): nonlinear in q, v and t, as a test of all order conditions wants it.
pub struct Exponential;

impl Exponential {
    pub fn exact(t: f64) -> [f64; 2] {
        let q = t.sin().exp();
        [q, q * t.cos()]
    }
}

impl Equations for Exponential {
    fn size(&self) -> (usize, usize) {
        (1, 0)
    }
    fn mass<S: Scalar>(&self, _t: S, _q: &[S], mass: &mut [S]) {
        mass[0] = S::one();
    }
    fn force<S: Scalar>(&self, t: S, q: &[S], v: &[S], f: &mut [S]) {
        f[0] = v[0].square() / q[0] - q[0] * t.sin();
    }
    fn phi<S: Scalar>(&self, _t: S, _q: &[S], _phi: &mut [S]) {}
}

/// v' = (k + 1) t^k: a method of order p is exact up to k = p - 1 (its quadrature conditions).
pub struct Power(pub i32);

impl Equations for Power {
    fn size(&self) -> (usize, usize) {
        (1, 0)
    }
    fn mass<S: Scalar>(&self, _t: S, _q: &[S], mass: &mut [S]) {
        mass[0] = S::one();
    }
    fn force<S: Scalar>(&self, t: S, _q: &[S], _v: &[S], f: &mut [S]) {
        f[0] = (0..self.0).fold(S::one(), |power, _| power * t) * f64::from(self.0 + 1);
    }
    fn phi<S: Scalar>(&self, _t: S, _q: &[S], _phi: &mut [S]) {}
}

/// Restricted three-body problem with the periodic orbit of Arenstorf; Hairer, Norsett, Wanner I, (0.1) and (0.2).
pub struct Arenstorf;

impl Arenstorf {
    pub const PERIOD: f64 = 17.065216560157964;
    pub const START: ([f64; 2], [f64; 2]) = ([0.994, 0.0], [0.0, -2.0015851063790824]);
    const MOON: f64 = 0.012277471;
}

impl Equations for Arenstorf {
    fn size(&self) -> (usize, usize) {
        (2, 0)
    }
    fn mass<S: Scalar>(&self, _t: S, _q: &[S], mass: &mut [S]) {
        mass.copy_from_slice(&[S::one(), S::zero(), S::zero(), S::one()]);
    }
    fn force<S: Scalar>(&self, _t: S, q: &[S], v: &[S], f: &mut [S]) {
        let moon = Self::MOON;
        let earth = 1.0 - Self::MOON;
        let cube = |x: S| (x.square() + q[1].square()).sqrt().powi(3);
        let to_earth = cube(q[0] + moon);
        let to_moon = cube(q[0] - earth);
        f[0] = q[0] + v[1] * 2.0 - (q[0] + moon) * earth / to_earth - (q[0] - earth) * moon / to_moon;
        f[1] = q[1] - v[0] * 2.0 - q[1] * earth / to_earth - q[1] * moon / to_moon;
    }
    fn phi<S: Scalar>(&self, _t: S, _q: &[S], _phi: &mut [S]) {}
}
