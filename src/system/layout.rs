//! A model with the places of its coordinates, rows and matrix entries.

use super::gather::MovingFrames;
use super::rows::JointRows;
use super::solid::Solid;
use super::support::Support;
use crate::body::Freedom;
use crate::joint::{ClosedForm, Lock};
use crate::math::kkt::Pattern;
use crate::scene::{Model, Part};
use std::ops::Range;
use std::sync::Arc;

/// A model, the places of its parts, and what is known of them before the motion.
pub(super) struct Layout<const D: usize> {
    pub model: Model<D>,
    pub joints: Vec<JointRows>,
    /// Range of each body's values in those of M.
    pub masses: Vec<Range<usize>>,
    /// The velocities that move each marker; none for markers on the ground.
    pub supports: Vec<Support>,
    /// What the velocities of each body are, if it is rigid.
    pub freedoms: Vec<Option<Arc<Freedom>>>,
    /// The translations and rotations that each joint locks, if that is all it does.
    pub locks: Vec<Option<Lock<D>>>,
}

impl<const D: usize> Layout<D> {
    /// Gives places to the parts of a model; returns the patterns of M and G, too.
    pub fn new(model: Model<D>) -> (Self, Pattern, Pattern) {
        let v = model.bodies.last().map_or(0, |part| part.first_v + part.nv);
        let mut mass = Pattern { rows: v, cols: v, entries: Vec::new() };
        let mut masses = Vec::new();
        for part in &model.bodies {
            let first = mass.entries.len();
            let places = part.facts.mass_pattern.iter();
            mass.entries.extend(places.map(|&(i, j)| (part.first_v + i, part.first_v + j)));
            masses.push(first..mass.entries.len());
        }
        let mut g = Pattern { rows: 0, cols: v, entries: Vec::new() };
        let supports: Vec<Support> = (0..model.marker_count()).map(|marker| Support::of(&model, marker)).collect();
        let joints = model.joints.iter().map(|joint| JointRows::new(&supports, joint, &mut g)).collect();
        let freedoms = freedoms(&model);
        let locks = model.joints.iter().map(|joint| as_lock(joint.element.closed_form())).collect();
        (Layout { model, joints, masses, supports, freedoms, locks }, mass, g)
    }

    /// Range of the rows of phi of a joint.
    pub fn rows_of_joint(&self, joint: usize) -> Range<usize> {
        self.joints[joint].rows.clone()
    }

    /// A body at the frames `motion` of all markers; none if it is not rigid.
    pub fn solid(&self, body: usize, motion: &MovingFrames<D>) -> Option<Solid<D>> {
        self.freedoms[body].as_ref().map(|freedom| Solid::new(&self.model.bodies[body], freedom, motion))
    }

    /// What a joint locks, if that is all it does and its bodies are rigid.
    pub fn lock(&self, joint: usize) -> Option<&Lock<D>> {
        let model = &self.model;
        let mut bodies = model.joints[joint].markers.iter().filter_map(|&marker| model.markers.bodies[marker]);
        self.locks[joint].as_ref().filter(|_| bodies.all(|body| self.freedoms[body].is_some()))
    }
}

/// What the velocities of each body are, if it is rigid; neighbours that are alike share one.
fn freedoms<const D: usize>(model: &Model<D>) -> Vec<Option<Arc<Freedom>>> {
    let mut last: Option<Arc<Freedom>> = None;
    let shared = |part: &Part<D>| {
        let freedom = part.facts.freedom.as_ref()?;
        if last.as_deref() != Some(freedom) {
            last = Some(Arc::new(freedom.clone()));
        }
        last.clone()
    };
    model.bodies.iter().map(shared).collect()
}

fn as_lock<const D: usize>(form: Option<ClosedForm<D>>) -> Option<Lock<D>> {
    match form {
        Some(ClosedForm::Lock(lock)) => Some(lock),
        _ => None,
    }
}
