//! The mechanisms of the references, written as equations in their coordinates.

use holonom::math::Scalar;
use holonom::system::{Equations, MechanicalSystem};

/// A damper c1 at mass 1 beside the spring: two masses of 1 and 3 kg and a massless rod between.
pub struct TwoMass {
    pub c1: f64,
}

impl Equations for TwoMass {
    fn size(&self) -> (usize, usize) {
        (2, 1)
    }
    fn mass<S: Scalar>(&self, _: S, _: &[S], mass: &mut [S]) {
        mass.copy_from_slice(&[S::one(), S::zero(), S::zero(), S::constant(3.0)]);
    }
    fn force<S: Scalar>(&self, _: S, q: &[S], v: &[S], f: &mut [S]) {
        f.copy_from_slice(&[-(q[0] * 100.0) - v[0] * self.c1, S::zero()]);
    }
    fn phi<S: Scalar>(&self, _: S, q: &[S], phi: &mut [S]) {
        phi[0] = q[1] - q[0] - 1.0;
    }
}

/// Rods AC, CD, DB of mass m3 = 1 kg and length l = 1 m, spring k1 and damper c1 along A-D, in (xC, yC, xD, yD).
pub struct FourBar {
    pub l0: f64,
    pub c1: f64,
}

const HEAVY: f64 = 9.81;

impl Equations for FourBar {
    fn size(&self) -> (usize, usize) {
        (4, 3)
    }
    fn mass<S: Scalar>(&self, _: S, _: &[S], mass: &mut [S]) {
        mass.fill(S::zero());
        for (i, j, m) in [(0, 0, 2.0), (1, 1, 2.0), (2, 2, 2.0), (3, 3, 2.0), (0, 2, 0.5), (1, 3, 0.5)] {
            mass[4 * i + j] = S::constant(m / 3.0);
            mass[4 * j + i] = S::constant(m / 3.0);
        }
    }
    fn force<S: Scalar>(&self, _: S, q: &[S], v: &[S], f: &mut [S]) {
        let length = (q[2].square() + q[3].square()).sqrt();
        let rate = (q[2] * v[2] + q[3] * v[3]) / length;
        let pull = ((length - self.l0) * 100.0 + rate * self.c1) / length;
        f.copy_from_slice(&[S::zero(), S::constant(-HEAVY), -(pull * q[2]), -(pull * q[3]) - HEAVY]);
    }
    fn phi<S: Scalar>(&self, _: S, q: &[S], phi: &mut [S]) {
        phi[0] = (q[0].square() + q[1].square() - 1.0) * 0.5;
        phi[1] = ((q[2] - q[0]).square() + (q[3] - q[1]).square() - 1.0) * 0.5;
        phi[2] = ((q[2] - 1.0).square() + q[3].square() - 1.0) * 0.5;
    }
}

/// Two unit point masses on unit rods with drag 0.1 each, in (x1, y1, x2, y2).
pub struct DoublePendulum;

impl Equations for DoublePendulum {
    fn size(&self) -> (usize, usize) {
        (4, 2)
    }
    fn mass<S: Scalar>(&self, _: S, _: &[S], mass: &mut [S]) {
        mass.fill(S::zero());
        (0..4).for_each(|i| mass[5 * i] = S::one());
    }
    fn force<S: Scalar>(&self, _: S, _: &[S], v: &[S], f: &mut [S]) {
        (0..4).for_each(|i| f[i] = v[i] * -0.1 - if i % 2 == 1 { HEAVY } else { 0.0 });
    }
    fn phi<S: Scalar>(&self, _: S, q: &[S], phi: &mut [S]) {
        phi[0] = (q[0].square() + q[1].square() - 1.0) * 0.5;
        phi[1] = ((q[2] - q[0]).square() + (q[3] - q[1]).square() - 1.0) * 0.5;
    }
}

/// By the label of its reference.
pub fn system(label: &str) -> Box<dyn MechanicalSystem> {
    match label {
        "two_mass_eq" => Box::new(TwoMass { c1: 0.0 }),
        "four_bar_N1" | "four_bar_S1" => Box::new(FourBar { l0: 2f64.sqrt(), c1: 0.0 }),
        "double_pendulum_N1" => Box::new(DoublePendulum),
        _ => Box::new(crate::common::equations::andrews::Andrews),
    }
}
