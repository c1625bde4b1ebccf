//! Directions without inertia, measured by the displacement of points instead of the kinetic energy.

use super::changes::directions;
use super::{Matrix, Variation};
use crate::tolerances;

/// The masses of the directions of v, and the length by which each moves points: 1 for a position, the length of the
/// mechanism for a rotation.
struct DirectionInertia {
    masses: Vec<f64>,
    lengths: Vec<f64>,
    /// The largest mass, kg: of a rotation over the square of the length.
    largest: f64,
}

impl DirectionInertia {
    fn of(variation: &Variation) -> Self {
        let system = variation.system();
        let mut masses = vec![0.0; variation.velocities()];
        variation.dynamics.structure.mass.add_diagonal(&variation.dynamics.terms.mass, &mut masses);
        let is_rotation = |name: &String| [".angle", ".rx", ".ry", ".rz"].iter().any(|end| name.ends_with(end));
        let names = directions(system, &variation.point.q).q;
        let length = system.facts().length;
        let lengths: Vec<f64> = names.iter().map(|name| if is_rotation(name) { length } else { 1.0 }).collect();
        let largest = masses.iter().zip(&lengths).map(|(mass, length)| mass / (length * length)).fold(0.0, f64::max);
        DirectionInertia { masses, lengths, largest }
    }

    /// The directions that move q without inertia, with their lengths.
    fn massless(&self) -> impl Iterator<Item = (usize, f64)> {
        let least = |length: f64| tolerances::ROOT_OF_ROUND_OFF * self.largest * length * length;
        let all = self.lengths.iter().copied().enumerate();
        all.filter(move |(i, length)| self.masses[*i] <= least(*length))
    }
}

/// Returns the mass that each direction without inertia counts as where motions are compared, that of the heaviest
/// direction; zero for the others.
pub(super) fn added_mass(variation: &Variation) -> Vec<f64> {
    let inertia = DirectionInertia::of(variation);
    let mut added = vec![0.0; inertia.masses.len()];
    inertia.massless().for_each(|(i, length)| added[i] = inertia.largest * length * length);
    added
}

/// Returns the weight of each row of Z, Z^T M Z = I: the square root of its mass, and without inertia the displacement of
/// points over the largest of all rows. Weighed rows are not longer than 1.
pub(super) fn weights(variation: &Variation, z: &Matrix) -> Vec<f64> {
    let inertia = DirectionInertia::of(variation);
    let moved = inertia.lengths.iter().enumerate().map(|(i, length)| length * z.row(i).norm());
    let largest = moved.fold(f64::MIN_POSITIVE, f64::max);
    let mut weights: Vec<f64> = inertia.masses.iter().map(|mass| mass.max(0.0).sqrt()).collect();
    inertia.massless().for_each(|(i, length)| weights[i] = length / largest);
    weights
}
