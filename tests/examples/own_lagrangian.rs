//! Own equations from energies: M, f with its Coriolis terms and all derivatives follow from T and V.

use holonom::linear::{State, linearize};
use holonom::prelude::*;

const GRAVITY: f64 = 9.81;

/// Two masses on massless rods, by the angles of the rods to the vertical; kg, m, s.
pub struct DoublePendulum {
    pub masses: [f64; 2],
    pub lengths: [f64; 2],
}

impl Lagrangian for DoublePendulum {
    fn size(&self) -> (usize, usize) {
        (2, 0)
    }
    fn kinetic<S: Scalar>(&self, _t: S, q: &[S], v: &[S]) -> S {
        let [first, second] = [v[0] * self.lengths[0], v[1] * self.lengths[1]];
        let square = first.square() + second.square() + first * second * (q[0] - q[1]).cos() * 2.0;
        first.square() * (0.5 * self.masses[0]) + square * (0.5 * self.masses[1])
    }
    fn potential<S: Scalar>(&self, _t: S, q: &[S]) -> S {
        let first = q[0].cos() * -self.lengths[0];
        let second = first - q[1].cos() * self.lengths[1];
        (first * self.masses[0] + second * self.masses[1]) * GRAVITY
    }
}

#[test]
fn a_lagrangian_is_simulated_and_linearized() -> Result<()> {
    let system = DoublePendulum { masses: [1.0, 1.0], lengths: [1.0, 1.0] };
    let method = Method { rtol: 1e-10, atol: 1e-10, ..Method::default() };
    let record = simulate(&system, &method, &([1.5, -0.5], [0.0, 1.0]), 0.0..2.0)?.record;
    assert!(record.energy_error() < 1e-9);

    // Hanging at rest, omega^2 = (2 -+ sqrt 2) g/l.
    let model = linearize(&system, &State::new(0.0, [0.0; 2], [0.0; 2]), &Linear::default())?;
    let mut frequencies: Vec<f64> = model.modes.iter().map(|mode| mode.value.im.abs()).collect();
    frequencies.sort_by(f64::total_cmp);
    for (found, sign) in [(frequencies[0], -1.0), (frequencies[3], 1.0)] {
        let expected = ((2.0 + sign * 2.0_f64.sqrt()) * GRAVITY).sqrt();
        assert!((found - expected).abs() < 1e-13 * expected, "{found} {expected}");
    }
    Ok(())
}
