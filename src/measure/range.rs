//! How far the motion went out of the range of what is modelled.

use crate::error::{Warning, short};
use crate::simulate::Observation;
use crate::system::{Limited, MechanicalSystem, Theory};

/// The largest deformation of each part that holds up to some only.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Range {
    pub parts: Vec<Extreme>,
    now: Vec<f64>,
}

/// The largest deformation of a part.
#[derive(Clone, Debug, PartialEq)]
pub struct Extreme {
    pub limited: Limited,
    /// In the unit of the limit: displacement by length, or rad.
    pub deformation: f64,
    /// s
    pub t: f64,
}

impl Range {
    pub fn new(system: &dyn MechanicalSystem) -> Self {
        let start = |limited: &Limited| Extreme { limited: limited.clone(), deformation: 0.0, t: 0.0 };
        let parts: Vec<Extreme> = system.limited().iter().map(start).collect();
        Range { now: vec![0.0; parts.len()], parts }
    }

    /// Adds an accepted state.
    pub fn add(&mut self, system: &dyn MechanicalSystem, state: &Observation) {
        self.see(system, state.t, state.q);
    }

    fn see(&mut self, system: &dyn MechanicalSystem, t: f64, q: &[f64]) {
        system.deformations(q, &mut self.now);
        for (part, now) in self.parts.iter_mut().zip(&self.now).filter(|(part, now)| **now > part.deformation) {
            (part.deformation, part.t) = (*now, t);
        }
    }

    /// What one state is beyond.
    pub fn warnings_at(system: &dyn MechanicalSystem, t: f64, q: &[f64]) -> Vec<Warning> {
        let mut range = Range::new(system);
        range.see(system, t, q);
        range.warnings()
    }

    /// One for each part that went too far.
    pub fn warnings(&self) -> Vec<Warning> {
        let beyond = self.parts.iter().filter(|part| part.deformation > part.limited.theory.most());
        beyond.map(Extreme::warning).collect()
    }
}

impl Extreme {
    fn warning(&self) -> Warning {
        let Limited { part, theory } = &self.limited;
        let [t, deformation, most] = [self.t, self.deformation, theory.most()].map(|x| short(two_digits(x)));
        let (text, hint) = match theory {
            Theory::SmallDisplacements => (
                format!(
                    "`{part}` is deformed by {deformation} of its length at t = {t} s: in a floating frame displacements \
                     are small, up to some {most}"
                ),
                "model it with \"frame\": \"absolute\", or as several bodies",
            ),
            Theory::Helix { .. } => (
                format!(
                    "the ends of an element of the beam `{part}` turn against each other by {deformation} rad at t = {t} \
                     s: from {most} rad on an element may lose a turn"
                ),
                "take more elements",
            ),
        };
        Warning::new(text, hint)
    }
}

/// Rounded for a message.
fn two_digits(x: f64) -> f64 {
    format!("{x:.1e}").parse().unwrap_or(x)
}
