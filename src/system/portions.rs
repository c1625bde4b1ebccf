//! Bodies and joints of large mechanisms in portions that are evaluated at once. Portions follow from the model alone,
//! and have places of their own for all that they write.

use super::rigid_joint::{JointTerms, RigidJoint};
use super::terms::Terms;
use crate::body::{Frame, Pose};
use crate::math::Taylor;
use crate::math::threads::Divisible;
use crate::scene::Model;
use std::ops::Range;

/// Bodies, or joints, that are evaluated by one thread at a time. Unit: `[1]`. Why: measured: a portion takes some 30
/// us, twice what another thread takes to wake up; a mechanism with fewer is evaluated by one.
const ELEMENTS_OF_A_PORTION: usize = 1024;

/// Bodies in sequence, with their markers, velocities and values of M.
pub(super) struct BodyPortion {
    pub bodies: Range<usize>,
    pub markers: Range<usize>,
    pub v: Range<usize>,
    pub masses: Range<usize>,
    /// The bodies whose mass matrix varies, and those whose own forces do.
    pub varying_masses: Vec<usize>,
    pub varying_forces: Vec<usize>,
}

impl BodyPortion {
    /// Divides the bodies of a model with the places of the values of M. The first portion begins at the first marker,
    /// and the last one ends at the last.
    pub fn all<const D: usize>(model: &Model<D>, masses: &[Range<usize>]) -> Vec<Self> {
        let count = model.bodies.len();
        let mut portions: Vec<BodyPortion> = Vec::new();
        for first in (0..count).step_by(ELEMENTS_OF_A_PORTION) {
            let bodies = first..count.min(first + ELEMENTS_OF_A_PORTION);
            let own = &model.bodies[first];
            let last = &model.bodies[bodies.end - 1];
            let before = portions.last().map_or(0, |portion| portion.markers.end);
            let markers = model.bodies.get(bodies.end).map_or(model.marker_count(), |next| next.first_marker);
            portions.push(BodyPortion {
                v: own.first_v..last.first_v + last.nv,
                masses: masses[first].start..masses[bodies.end - 1].end,
                markers: before..markers,
                varying_masses: bodies.clone().filter(|&i| !model.bodies[i].facts.has_constant_mass).collect(),
                varying_forces: bodies.clone().filter(|&i| !model.bodies[i].facts.has_constant_forces).collect(),
                bodies,
            });
        }
        portions
    }
}

/// What is written for the bodies of some portions.
pub(super) struct BodyTerms<'a, const D: usize> {
    pub portions: &'a [BodyPortion],
    pub poses: &'a mut [Pose<D>],
    /// Empty where the frames are known, or not needed.
    pub motion: &'a mut [Frame<Taylor<f64>, D>],
    pub mass: &'a mut [f64],
    pub f: &'a mut [f64],
}

impl<const D: usize> Divisible for BodyTerms<'_, D> {
    fn is_whole(&self) -> bool {
        self.portions.len() < 2
    }

    fn divided(self) -> [Self; 2] {
        let (portions, others) = self.portions.split_at(self.portions.len() / 2);
        let first = &portions[0];
        let next = &others[0];
        let poses = self.poses.split_at_mut(next.bodies.start - first.bodies.start);
        let markers = self.motion.len().min(next.markers.start - first.markers.start);
        let motion = self.motion.split_at_mut(markers);
        let mass = self.mass.split_at_mut(next.masses.start - first.masses.start);
        let f = self.f.split_at_mut(next.v.start - first.v.start);
        let own = BodyTerms { portions, poses: poses.0, motion: motion.0, mass: mass.0, f: f.0 };
        [own, BodyTerms { portions: others, poses: poses.1, motion: motion.1, mass: mass.1, f: f.1 }]
    }
}

/// Joints in sequence, with places counted from their first row and their first entry of G; the first portion begins
/// with the first row and entry of all.
pub(super) struct JointPortion<const D: usize> {
    pub joints: Vec<RigidJoint<D>>,
    pub first_row: usize,
    pub first_entry: usize,
}

impl<const D: usize> JointPortion<D> {
    /// Divides joints in the order of their rows.
    pub fn all(joints: Vec<RigidJoint<D>>) -> Vec<Self> {
        let mut portions: Vec<Self> = Vec::new();
        for mut joint in joints {
            if portions.last().is_none_or(|last| last.joints.len() >= ELEMENTS_OF_A_PORTION) {
                let (first_row, first_entry) = if portions.is_empty() { (0, 0) } else { joint.places() };
                portions.push(JointPortion { joints: Vec::new(), first_row, first_entry });
            }
            if let Some(last) = portions.last_mut() {
                joint.count_from(last.first_row, last.first_entry);
                last.joints.push(joint);
            }
        }
        portions.iter_mut().for_each(|portion| portion.joints.shrink_to_fit());
        portions
    }
}

/// What is written for the joints of some portions.
pub(super) struct JointsTerms<'a, const D: usize> {
    pub portions: &'a [JointPortion<D>],
    pub terms: JointTerms<'a>,
}

impl<'a, const D: usize> JointsTerms<'a, D> {
    /// All of them.
    pub fn all(portions: &'a [JointPortion<D>], terms: &'a mut Terms) -> Self {
        let Terms { phi, phi_dot, phi_t, gamma, g, .. } = terms;
        JointsTerms { portions, terms: JointTerms { phi, phi_dot, phi_t, gamma, g } }
    }
}

impl<const D: usize> Divisible for JointsTerms<'_, D> {
    fn is_whole(&self) -> bool {
        self.portions.len() < 2
    }

    fn divided(self) -> [Self; 2] {
        let (portions, others) = self.portions.split_at(self.portions.len() / 2);
        let first = &portions[0];
        let next = &others[0];
        let rows = next.first_row - first.first_row;
        let entries = next.first_entry - first.first_entry;
        let JointTerms { phi, phi_dot, phi_t, gamma, g } = self.terms;
        let phi = phi.split_at_mut(rows);
        let phi_dot = phi_dot.split_at_mut(rows);
        let phi_t = phi_t.split_at_mut(rows);
        let gamma = gamma.split_at_mut(rows);
        let g = g.split_at_mut(entries);
        let own = JointTerms { phi: phi.0, phi_dot: phi_dot.0, phi_t: phi_t.0, gamma: gamma.0, g: g.0 };
        let rest = JointTerms { phi: phi.1, phi_dot: phi_dot.1, phi_t: phi_t.1, gamma: gamma.1, g: g.1 };
        [JointsTerms { portions, terms: own }, JointsTerms { portions: others, terms: rest }]
    }
}
