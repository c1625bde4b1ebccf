//! Frames of all markers along the motion, kept between evaluations.

use super::terms::OperatingPoint;
use crate::body::Frame;
use crate::math::Taylor;
use crate::scene::{Model, Part};

/// Frames of all markers with their velocities, and their accelerations.
pub(super) struct Frames<const D: usize> {
    /// Those of the ground alone as long as rigid bodies make do with poses.
    pub motion: Vec<Frame<Taylor<f64>, D>>,
    /// (q, v) that the frames belong to; empty where they have the accelerations of a given v'.
    placed: Vec<f64>,
}

impl<const D: usize> Frames<D> {
    /// The frames of the ground, and memory for those of the bodies.
    pub fn new(model: &Model<D>) -> Self {
        Frames { motion: model.ground_frames().map(|frame| frame.map(Taylor::fixed)).collect(), placed: Vec::new() }
    }

    /// Forgets which state the frames belong to, and has memory for all of them: only some are placed next.
    pub fn open(&mut self, model: &Model<D>) {
        self.placed.clear();
        self.motion.resize(model.marker_count(), Frame::world());
    }

    /// True if the frames are those at (q, v) and v' = 0, bit by bit.
    pub fn are_at(&self, q: &[f64], v: &[f64]) -> bool {
        let same = |(x, y): (&f64, &f64)| x.to_bits() == y.to_bits();
        !self.placed.is_empty() && self.placed.iter().zip(q.iter().chain(v)).all(same)
    }

    /// Evaluates all frames at a state with its v' or, where that is empty, at v' = 0, unless these are known.
    pub fn place(&mut self, model: &Model<D>, at: &OperatingPoint) {
        let is_unaccelerated = at.vdot.is_empty();
        if is_unaccelerated && self.are_at(at.q, at.v) {
            return;
        }
        self.open(model);
        for part in &model.bodies {
            place_body(part, at.q, at.v, at.vdot, &mut self.motion[part.first_marker..]);
        }
        if is_unaccelerated {
            self.placed.extend(at.q.iter().chain(at.v));
        }
    }
}

/// Evaluates the frames of the markers of a body, the first of `motion`.
pub(super) fn place_body<const D: usize>(
    part: &Part<D>,
    q: &[f64],
    v: &[f64],
    vdot: &[f64],
    motion: &mut [Frame<Taylor<f64>, D>],
) {
    let frames = &mut motion[..part.body.markers().len()];
    let vdot = (!vdot.is_empty()).then(|| part.velocities(vdot));
    part.body.motion(part.coordinates(q), part.velocities(v), vdot, 0, frames);
}
