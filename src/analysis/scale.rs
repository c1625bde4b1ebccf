//! Reference sizes of errors.

use crate::scene::units::{Dimension, dimension_of};
use crate::simulate::Observation;
use crate::system::{Column, MechanicalSystem, Scratch};
use crate::tolerances;

/// Sizes of a motion, over its rows. Coordinates in metres and in radians are not distinguished.
#[derive(Clone, Debug, Default)]
pub struct Sizes {
    start: Vec<f64>,
    /// Largest change of a coordinate, m or rad.
    travel: f64,
    /// Largest velocity, m/s or rad/s.
    speed: f64,
    /// Least and largest kinetic energy, J.
    kinetic: Option<(f64, f64)>,
    /// Largest multiplier times the unit of its row, J.
    reaction: f64,
    /// A length typical of the mechanism, m.
    length: f64,
}

impl Sizes {
    /// Adds a row; `scales` are those of the rows of phi.
    pub fn add(&mut self, system: &dyn MechanicalSystem, state: &Observation, scales: &[f64], scratch: &mut Scratch) {
        let largest = |values: &mut dyn Iterator<Item = f64>| values.fold(0.0f64, |most, value| most.max(value.abs()));
        let q = system.dimensions().without_turns(state.q);
        if self.start.is_empty() {
            (self.start, self.length) = (q.to_vec(), system.facts().length);
        }
        self.travel = self.travel.max(largest(&mut q.iter().zip(&self.start).map(|(q, start)| q - start)));
        self.speed = self.speed.max(largest(&mut state.v.iter().copied()));
        self.reaction = self.reaction.max(largest(&mut state.lambda.iter().zip(scales).map(|(l, scale)| l * scale)));
        if let Some(energy) = system.energy(state.t, state.q, state.v, scratch) {
            let (least, most) = self.kinetic.unwrap_or((energy.kinetic, energy.kinetic));
            self.kinetic = Some((least.min(energy.kinetic), most.max(energy.kinetic)));
        }
    }

    /// Returns the size of quantities of a dimension in SI units, from the sizes of the motion, independent of one
    /// quantity's value.
    fn of(&self, dimension: Dimension) -> f64 {
        // Angles in a small mechanism do not make lengths larger.
        let length = self.length.min(1.0);
        let (least, most) = self.kinetic.unwrap_or_default();
        let energy = (most - least).max(tolerances::UNSEEN * most);
        match dimension {
            Dimension::Angle => self.travel,
            Dimension::Length => self.travel * length,
            Dimension::AngularVelocity => self.speed,
            Dimension::AngularAcceleration => self.speed * self.speed,
            Dimension::Velocity => self.speed * length,
            Dimension::Acceleration => self.speed * self.speed * length,
            Dimension::Power => energy * self.speed,
            Dimension::Energy => energy,
            Dimension::Torque => self.reaction.max(energy),
            Dimension::Force if self.length > 0.0 => self.reaction.max(energy) / self.length,
            Dimension::Force | Dimension::Strain => 0.0,
        }
    }
}

/// Returns the reference size of the errors of each quantity, in its unit.
///
/// - Energies: the range of the kinetic energy, or of the quantity itself. Their zero is arbitrary.
/// - Forces and torques: the largest of their kind, of the reactions and of the inertia forces that these balance.
/// - Lengths, angles, their rates and powers: the quantity's own largest value, unless that is below a thousandth of those of the
///   motion.
/// - Others: the quantity's own largest value.
pub fn scales(columns: &[Column], rows: &[Vec<f64>], sizes: &Sizes) -> Vec<f64> {
    let value = |i: usize| rows.iter().map(move |row| row[i]);
    let largest = |i: usize| value(i).fold(0.0f64, |most, value| most.max(value.abs()));
    let swing = |i: usize| value(i).fold(f64::MIN, f64::max) - value(i).fold(f64::MAX, f64::min);
    // Number of the unit in one SI unit.
    let per_si = |unit: &str, dimension: Dimension| dimension.unit(unit).map_or(1.0, |unit| unit.per_si);
    let of_kind = |unit: &str, dimension: Dimension| {
        let same = (0..columns.len()).filter(|i| dimension_of(&columns[*i].unit) == Some(dimension));
        let in_si = same.map(|i| largest(i) / per_si(&columns[i].unit, dimension));
        per_si(unit, dimension) * in_si.fold(sizes.of(dimension), f64::max)
    };
    let of_unit = |unit: &str| (0..columns.len()).filter(|i| columns[*i].unit == unit).map(largest).fold(0.0, f64::max);
    let scale = |i: usize| {
        let unit = &columns[i].unit;
        let scale = match dimension_of(unit) {
            Some(Dimension::Energy) => {
                match swing(i).max(sizes.of(Dimension::Energy) * per_si(unit, Dimension::Energy)) {
                    0.0 => largest(i),
                    swing => swing.max(tolerances::SAME * largest(i)),
                }
            }
            Some(kind @ (Dimension::Force | Dimension::Torque)) => of_kind(unit, kind),
            Some(kind) if kind != Dimension::Strain => largest(i).max(tolerances::UNSEEN * of_kind(unit, kind)),
            _ => largest(i).max(tolerances::SAME * of_unit(unit)),
        };
        if scale > 0.0 { scale } else { 1.0 }
    };
    (0..columns.len()).map(scale).collect()
}
