//! Range of validity of the models and of measured data, and rotation between evaluations.

use super::held::HeldSignals;
use crate::error::{Warning, short, two_digits};
use crate::simulate::Observation;
use crate::system::{Limited, MechanicalSystem, Road, Scratch, Theory};
use std::f64::consts::PI;

/// The largest deformation of each part whose theory is valid for small ones only, the largest rotation between
/// evaluations, the deepest wheel, and signals beyond their points.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ValidityRange {
    /// The largest deformation of each such part.
    pub parts: Vec<LargestDeformation>,
    /// The largest rotation of a body between evaluations of the equations.
    pub leap: Option<Leap>,
    /// The tyre with the largest compression beyond its radius at a row, and the time, s.
    pub sunk: Option<(Road, f64)>,
    /// Signals beyond their points.
    held: HeldSignals,
    now: Vec<f64>,
    bodies: Vec<String>,
    spins: Vec<f64>,
}

/// A rotation between two evaluations of the equations.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Leap {
    /// Angle, rad.
    pub angle: f64,
    /// Index of the body.
    pub body: usize,
    /// Time, s.
    pub t: f64,
    /// Time between the evaluations, s.
    pub apart: f64,
    /// True in a fixed step.
    pub is_fixed: bool,
}

/// The largest deformation of a part.
#[derive(Clone, Debug, PartialEq)]
pub struct LargestDeformation {
    /// The part with its theory.
    pub limited: Limited,
    /// Deformation in the unit of the limit: displacement by length, load by critical load, or rad.
    pub deformation: f64,
    /// Time, s.
    pub t: f64,
}

impl ValidityRange {
    /// A range without states.
    pub fn new(system: &dyn MechanicalSystem) -> Self {
        let start = |limited: &Limited| LargestDeformation { limited: limited.clone(), deformation: 0.0, t: 0.0 };
        let parts: Vec<LargestDeformation> = system.facts().limited.iter().map(start).collect();
        let bodies = system.facts().turning_bodies.clone();
        let now = vec![0.0; parts.len()];
        let spins = vec![0.0; bodies.len()];
        let held = HeldSignals::new(system);
        ValidityRange { now, spins, parts, bodies, leap: None, sunk: None, held }
    }

    /// Adds an accepted state.
    pub fn add(&mut self, system: &dyn MechanicalSystem, state: &Observation) {
        self.see(system, state.t, state.q);
        let Some(apart) = state.apart else { return };
        system.spins(state.q, state.v, &mut self.spins);
        for (body, spin) in self.spins.iter().enumerate() {
            let angle = apart * spin;
            if self.leap.is_none_or(|leap| angle > leap.angle) {
                self.leap = Some(Leap { angle, body, t: state.t, apart, is_fixed: state.tolerated.is_none() });
            }
        }
    }

    /// Adds an output row.
    pub fn add_row(&mut self, system: &dyn MechanicalSystem, state: &Observation, scratch: &mut Scratch) {
        self.held.add(system, state, scratch);
        self.see_roads(system, state.t, state.q, state.v, scratch);
    }

    fn see_roads(&mut self, system: &dyn MechanicalSystem, t: f64, q: &[f64], v: &[f64], scratch: &mut Scratch) {
        for road in system.roads(t, q, v, scratch) {
            let deepest = self.sunk.as_ref().map_or(1.0, |(road, _)| road.compression());
            if road.compression() > deepest {
                self.sunk = Some((road, t));
            }
        }
    }

    fn see(&mut self, system: &dyn MechanicalSystem, t: f64, q: &[f64]) {
        system.deformations(q, &mut self.now);
        for (part, now) in self.parts.iter_mut().zip(&self.now).filter(|(part, now)| **now > part.deformation) {
            (part.deformation, part.t) = (*now, t);
        }
    }

    /// Returns the warnings for one state.
    pub fn warnings_at(system: &dyn MechanicalSystem, t: f64, q: &[f64]) -> Vec<Warning> {
        let mut range = ValidityRange::new(system);
        range.see(system, t, q);
        let still = vec![0.0; system.dimensions().v];
        range.see_roads(system, t, q, &still, &mut Scratch::default());
        range.warnings()
    }

    /// Returns a warning for each part beyond its limit, and one for steps too long to resolve the rotation of bodies.
    pub fn warnings(&self) -> Vec<Warning> {
        let beyond = self.parts.iter().filter(|part| part.deformation > part.limited.theory.most());
        let parts = beyond.map(LargestDeformation::warning);
        parts.chain(self.leaping()).chain(self.sinking()).chain(self.held.warnings()).collect()
    }

    /// The force of a tyre has no meaning where its wheel's centre is below the road.
    fn sinking(&self) -> Option<Warning> {
        let (road, t) = self.sunk.as_ref()?;
        let compression = two_digits(road.radius - road.clearance);
        let radius = short(road.radius);
        let t = two_digits(*t);
        let text = format!(
            "the tyre `{}` is compressed by {compression} m at t = {t} s, more than its radius of {radius} m",
            road.tyre
        );
        Some(Warning::new(text, "its stiffness is in N/m: for 200 N/mm write 200e3"))
    }

    /// From half a revolution on, a rotation the other way round would fit as well.
    fn leaping(&self) -> Option<Warning> {
        let Leap { angle, body, t, apart, is_fixed } = self.leap.filter(|leap| leap.angle >= PI)?;
        let shorter = two_digits(0.5 * apart * PI / angle);
        let angle = two_digits(angle);
        let t = two_digits(t);
        let text = format!(
            "`{}` turns by {angle} rad, half a revolution or more, between two evaluations of the equations at t = {t} s: \
             steps so long do not see the motion",
            self.bodies[body]
        );
        let hint = if is_fixed {
            "choose a smaller --step, or an adaptive method".to_string()
        } else {
            format!("compare with --step {shorter}; nothing is missed where nothing depends on the angle")
        };
        Some(Warning::new(text, hint))
    }
}

impl LargestDeformation {
    fn warning(&self) -> Warning {
        let Limited { part, theory } = &self.limited;
        let t = two_digits(self.t);
        let deformation = two_digits(self.deformation);
        let most = two_digits(theory.most());
        let (text, hint) = match theory {
            Theory::SmallDisplacements => (
                format!(
                    "`{part}` is deformed by {deformation} of its length at t = {t} s: in a floating frame displacements \
                     are small, up to some {most}"
                ),
                "model it with \"frame\": \"absolute\", or as several bodies".to_string(),
            ),
            Theory::SmallMoments => (
                format!(
                    "the bending moments of `{part}` come to {deformation} of those at which it buckles sideways at t = {t} s: \
                     a floating frame does not see how they soften lateral bending and twist, by the square of that"
                ),
                "model it with \"frame\": \"absolute\"".to_string(),
            ),
            Theory::SmallAxialForces => (
                format!(
                    "the axial force of `{part}` comes to {deformation} of its Euler load at t = {t} s, and does not stiffen \
                     or soften its bending"
                ),
                "give \"geometric_stiffening\": true".to_string(),
            ),
            Theory::SmallRotations => (
                format!(
                    "the bushing `{part}` turns by {deformation} rad at t = {t} s: its rotations are small, up to some {most}, \
                     and its torque is that of their sine"
                ),
                "hold larger rotations by a joint with a torsion_spring".to_string(),
            ),
            Theory::Helix { .. } => (
                format!(
                    "the ends of an element of the beam `{part}` turn against each other by {deformation} rad at t = {t} \
                     s: from {most} rad on an element may lose a turn"
                ),
                "take more elements".to_string(),
            ),
            Theory::Mesh { elements } => (
                format!(
                    "the curvature of the beam `{part}` changes so much from one of its {elements} elements to the next that \
                     they miss some {} % of the energy of bending at t = {t} s",
                    two_digits(100.0 * self.deformation)
                ),
                format!("take {} elements or more", theory.elements_for(self.deformation)),
            ),
        };
        Warning::new(text, hint)
    }
}
