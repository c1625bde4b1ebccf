//! A system with a pulse added to one of its inputs.

use super::Pulse;
use crate::forward::forward;
use crate::math::array::Each;
use crate::system::{
    Dimensions, Excitation, Group, MechanicalSystem, Names, Need, Rotation, Scratch, Structure, Terms,
};
use nalgebra::DMatrix;

/// The equations with u(t) = amplitude times the pulse.
pub struct Pushed<'a> {
    system: &'a dyn MechanicalSystem,
    pulse: Pulse,
    amplitude: f64,
    excitation: Excitation,
    /// n_v and n_u.
    sizes: (usize, usize),
}

impl<'a> Pushed<'a> {
    /// None where the system has no such input.
    pub fn new(system: &'a dyn MechanicalSystem, pulse: Pulse, amplitude: f64) -> Option<Self> {
        let all = system.excitations();
        let excitation = *all.get(pulse.input)?;
        Some(Pushed { system, pulse, amplitude, excitation, sizes: (system.dimensions().v, all.len()) })
    }

    /// Adds df/du u + df/du' u' to f.
    fn push(&self, (t, q, v): (f64, &[f64], &[f64]), [u, rate]: [f64; 2], f: &mut [f64], scratch: &mut Scratch) {
        let mut forces = DMatrix::zeros(self.sizes.0, self.sizes.1);
        self.system.input_forces(t, q, v, &mut forces, scratch);
        f.iter_mut().zip(&forces.column(self.pulse.input)).for_each(|(f, slope)| *f += u * slope);
        if self.excitation == Excitation::Displacement {
            self.system.input_rate_forces(t, q, v, &mut forces, scratch);
            f.iter_mut().zip(&forces.column(self.pulse.input)).for_each(|(f, slope)| *f += rate * slope);
        }
    }
}

impl MechanicalSystem for Pushed<'_> {
    forward! { .system =>
        fn dimensions(&self) -> Dimensions;
        fn structure(&self) -> Structure;
        fn names(&self) -> Names;
        fn turning_angles(&self) -> usize;
        fn rate(&self, q: &[f64], v: &[f64], qdot: &mut [f64]);
        fn own_rate(&self, q: &[f64], v: &[f64], qdot: &mut [f64]);
        fn rotations(&self) -> Vec<Rotation>;
        fn normalize(&self, q: &mut [f64]);
        fn length(&self) -> f64;
        fn scales(&self) -> Vec<f64>;
        fn groups(&self) -> Vec<Group>;
        fn lengths(&self) -> Vec<(String, f64)>;
    }

    fn evaluate(&self, t: f64, q: &[f64], v: &[f64], need: Need, terms: &mut Terms, scratch: &mut Scratch) {
        self.system.evaluate(t, q, v, need, terms, scratch);
        let [u, rate, second] = self.pulse.jet(t).each(|x| self.amplitude * x);
        match self.excitation {
            _ if u == 0.0 => {}
            Excitation::Constraint(row) if need.includes(Need::CONSTRAINTS) => {
                terms.phi[row] -= u;
                terms.phi_dot[row] -= rate;
                terms.phi_t[row] -= rate;
                terms.gamma[row] += second;
            }
            Excitation::Force | Excitation::Displacement if need.includes(Need::FORCE) => {
                self.push((t, q, v), [u, rate], &mut terms.f, scratch);
            }
            _ => {}
        }
    }
}
