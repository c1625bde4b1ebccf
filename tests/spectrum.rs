//! Modes at one state of a motion.

use holonom::math::Scalar;
use holonom::simulate::{SpectralMode, Spectrum};
use holonom::system::{Equations, OperatingPoint};
use holonom::tolerances::DENSE_EIGENVALUES;

/// Two masses, 1 and 3 kg, that a joint holds together, on a spring and a damper, beside free masses: `count` in all.
struct Masses {
    count: usize,
    stiffness: f64,
    damping: f64,
}

impl Equations for Masses {
    fn size(&self) -> (usize, usize) {
        (self.count, 1)
    }
    fn mass<S: Scalar>(&self, _: S, _: &[S], mass: &mut [S]) {
        mass.fill(S::zero());
        mass.iter_mut().step_by(self.count + 1).for_each(|entry| *entry = S::one());
        mass[self.count + 1] = S::constant(3.0);
    }
    fn force<S: Scalar>(&self, _: S, q: &[S], v: &[S], f: &mut [S]) {
        f.fill(S::zero());
        f[0] = -(q[0] * self.stiffness) - v[0] * self.damping;
    }
    fn phi<S: Scalar>(&self, _: S, q: &[S], phi: &mut [S]) {
        phi[0] = q[1] - q[0];
    }
}

/// The modes of two masses, and the fastest ones of so many that they are found by iteration.
fn modes(stiffness: f64, damping: f64) -> [Vec<SpectralMode>; 2] {
    [2, DENSE_EIGENVALUES + 1].map(|count| {
        let zeros = vec![0.0; count];
        let state = OperatingPoint { t: 0.0, q: &zeros, v: &zeros, vdot: &zeros, lambda: &[0.0] };
        let spectrum = Spectrum::at(&Masses { count, stiffness, damping }, state).unwrap();
        assert_eq!(spectrum.is_estimate, count > 2);
        spectrum.modes
    })
}

/// 4 x'' + c x' + k x = 0, all modes at once and the fastest by iteration.
#[test]
fn modes_are_those_of_the_free_coordinates() {
    for (stiffness, damping, fast) in [
        (100.0, 0.0, [0.0, 5.0]),
        (100.0, 2.0, [0.25, (25.0f64 - 1.0 / 16.0).sqrt()]),
        (100.0, 50.0, [10.0, 0.0]),
        (-100.0, 0.0, [5.0, 0.0]),
    ] {
        for modes in modes(stiffness, damping) {
            let last = modes.last().copied().unwrap_or(SpectralMode { decay: f64::NAN, swing: f64::NAN });
            let off = (last.decay.abs() - fast[0]).abs() + (last.swing - fast[1]).abs();
            assert!(off < 1e-9, "{stiffness} {damping}: {modes:?}");
        }
    }
}
