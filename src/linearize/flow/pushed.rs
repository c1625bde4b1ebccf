//! A system with a pulse added to one of its inputs.

use super::Pulse;
use crate::forward::forward;
use crate::math::array::Each;
use crate::system::{Dimensions, Excitation, MechanicalSystem, Need, Scratch, Structure, SystemFacts, Terms};
use nalgebra::DMatrix;
use std::borrow::Cow;

/// The equations with u(t) = amplitude times the pulse.
pub struct Pushed<'a> {
    system: &'a dyn MechanicalSystem,
    pulse: Pulse,
    amplitude: f64,
    excitation: Excitation,
    /// Those of the system without its outputs, inputs and what its state is monitored for.
    facts: SystemFacts,
    /// n_v and n_u.
    sizes: (usize, usize),
}

impl<'a> Pushed<'a> {
    /// None where the system has no such input.
    pub fn new(system: &'a dyn MechanicalSystem, pulse: Pulse, amplitude: f64) -> Option<Self> {
        let n = system.dimensions();
        let all = system.facts();
        let excitation = *all.excitations().get(pulse.input)?;
        let sizes = (n.v, all.inputs.len());
        let SystemFacts { names, rotations, length, lengths, scales, groups, .. } = all.into_owned();
        let facts = SystemFacts { names, rotations, length, lengths, scales, groups, ..SystemFacts::new(n) };
        Some(Pushed { system, pulse, amplitude, excitation, facts, sizes })
    }

    /// Adds df/du u + df/du' u' to f.
    fn push(&self, t: f64, q: &[f64], v: &[f64], input: [f64; 2], f: &mut [f64], scratch: &mut Scratch) {
        let [u, rate] = input;
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
        fn rate(&self, q: &[f64], v: &[f64], qdot: &mut [f64]);
        fn normalize(&self, q: &mut [f64]);
    }

    fn facts(&self) -> Cow<'_, SystemFacts> {
        Cow::Borrowed(&self.facts)
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
                self.push(t, q, v, [u, rate], &mut terms.f, scratch);
            }
            _ => {}
        }
    }
}
