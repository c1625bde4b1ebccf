//! Buckling loads that the linear elasticity of a beam in a floating frame neglects: section loads over critical loads.
//!
//! ```text
//! Euler:    N = pi^2 EI/L^2
//! sideways: M = pi/L sqrt(EI GJ/((1 - EI/EJ)(1 - GJ/EJ)))
//! ```
//!
//! with the weak bending stiffness EI and the strong one EJ, in which the moment bends (Trahair, Flexural-Torsional
//! Buckling of Structures, 1993, chapters 3 and 7). The force is that of the part between the outermost joints, hinged
//! there, or of twice what is beyond them. The moment is that of the whole beam, hinged at both ends, the same all
//! along: a cantilever buckles at half of it, or at 1.3 times where a force at the tip makes it. A beam that is as
//! stiff one way as the other never buckles sideways.

use super::theory::Theory;
use crate::body::Bent;
use crate::body::flexible::{Line, Section};
use crate::math::array::from_fn;
use crate::scene::{Model, Part};
use std::f64::consts::PI;
use std::iter::zip;

/// Number of equal parts of a beam's line at whose ends the deformation is evaluated, besides at its markers.
pub(super) const POINTS: usize = 8;

/// Ratio of a section load to its critical value, linear in the coordinates: pairs of a coordinate and its factor.
pub(super) struct Load(Vec<(usize, f64)>);

impl Load {
    /// `factor` times strain number `strain` of the section at `s`; `first_q` is the first elastic coordinate.
    fn new<const D: usize>(line: &dyn Line<D>, first_q: usize, s: f64, strain: usize, factor: f64) -> Self {
        let section = line.section(s);
        let terms =
            zip(&section.dofs, &section.strains).map(|(dof, strains)| (first_q + dof, factor * strains[strain]));
        Load(terms.filter(|(_, factor)| *factor != 0.0).collect())
    }

    pub fn at(&self, q: &[f64]) -> f64 {
        self.0.iter().map(|&(place, factor)| factor * q[place]).sum()
    }
}

/// Buckling limits of a beam in a floating frame, each with the load ratios along the beam.
pub(super) fn loads<const D: usize>(model: &Model<D>, part: &Part<D>) -> Vec<(Theory, Vec<Load>)> {
    let Some(Bent { line, stretches, first }) = part.body.bent() else { return Vec::new() };
    let length = line.length();
    let free = free_length(model, part, line.length());
    let end = from_fn(|k| if k == 0 { length } else { 0.0 });
    let stiffens = !stretches.is_empty() || !line.point(end).shortening.is_empty();
    let along = |of: &dyn Fn(&Section) -> (usize, f64)| -> Vec<Load> {
        let places = (0..=POINTS).map(|k| length * k as f64 / POINTS as f64);
        let loads = places.map(|s| {
            let (strain, factor) = of(&line.material(s));
            Load::new(line, part.first_q + first, s, strain, factor)
        });
        loads.filter(|load| !load.0.is_empty()).collect()
    };
    let forces = if stiffens { Vec::new() } else { along(&|section| axial_force::<D>(section, free)) };
    let moments = if D == 3 { along(&|section| moment(section, length)) } else { Vec::new() };
    let all = [(Theory::SmallAxialForces, forces), (Theory::SmallMoments, moments)];
    all.into_iter().filter(|(_, loads)| !loads.is_empty()).collect()
}

/// The length of a beam hinged at both ends that buckles under the same axial force: between the outermost joints, or
/// twice an end beyond them.
fn free_length<const D: usize>(model: &Model<D>, part: &Part<D>, length: f64) -> f64 {
    let own = part.markers();
    let held = model.joints.iter().flat_map(|joint| &joint.markers).filter(|marker| own.contains(marker));
    let places = held.map(|marker| part.body.markers()[marker - own.start].offset[0]);
    match places.fold(None, |ends, s| Some(ends.map_or([s, s], |[a, b]: [f64; 2]| [a.min(s), b.max(s)]))) {
        None => length,
        Some([first, last]) => (last - first).max(2.0 * first).max(2.0 * (length - last)),
    }
}

/// Number and factor of the strain whose stress is the axial force.
fn axial_force<const D: usize>(section: &Section, length: f64) -> (usize, f64) {
    let [about_y, about_z] = section.ei;
    let weak = if D == 2 { about_z } else { about_y.min(about_z) };
    (0, section.ea * length * length / (PI * PI * weak))
}

/// Number and factor of the strain whose stress is the bending moment about the stronger axis.
fn moment(section: &Section, length: f64) -> (usize, f64) {
    let ([about_y, about_z], gj) = (section.ei, section.gj);
    let (strain, weak, strong) = if about_y > about_z { (4, about_z, about_y) } else { (5, about_y, about_z) };
    let bent = (1.0 - weak / strong) * (1.0 - gj / strong).max(0.0);
    (strain, strong * length / PI * (bent / (weak * gj)).sqrt())
}
