//! Memory that a mechanism keeps between evaluations.

use super::coupling::Carrier;
use super::variation::SeededBody;
use crate::body::{Frame, Pose};
use crate::math::Taylor;
use crate::scene::Model;

pub(super) struct Workspace<const D: usize> {
    /// Frames of all markers with their velocities, and their accelerations at v' = 0; those of the ground alone as
    /// long as rigid bodies make do with poses.
    pub motion: Vec<Frame<Taylor<f64>, D>>,
    /// Poses of the rigid bodies by the index of the body, in an evaluation; the last is that of the ground. Empty until
    /// needed.
    pub poses: Vec<Pose<D>>,
    pub varied: SeededBody<D>,
    pub pulled: Vec<f64>,
    /// The bodies that each output reads; empty until needed.
    pub read: Vec<Vec<Carrier>>,
    /// Values of the inputs; empty where all are zero.
    pub inputs: Vec<f64>,
    /// (q, v) that the frames belong to; empty where they have the accelerations of a given v'.
    placed: Vec<f64>,
}

impl<const D: usize> Workspace<D> {
    /// The frames of the ground, and memory for those of the bodies.
    pub fn new(model: &Model<D>) -> Self {
        Workspace {
            motion: model.ground_frames().map(|frame| frame.map(Taylor::fixed)).collect(),
            poses: Vec::new(),
            varied: SeededBody::default(),
            pulled: Vec::new(),
            read: Vec::new(),
            inputs: Vec::new(),
            placed: Vec::new(),
        }
    }

    /// Remembers the state that the frames belong to; none if empty.
    pub fn remember(&mut self, [q, v]: [&[f64]; 2]) {
        self.placed.clear();
        self.placed.extend(q.iter().chain(v));
    }

    /// True if the frames are those at (q, v) and v' = 0, bit by bit.
    pub fn is_at(&self, q: &[f64], v: &[f64]) -> bool {
        let same = |(x, y): (&f64, &f64)| x.to_bits() == y.to_bits();
        !self.placed.is_empty() && self.placed.iter().zip(q.iter().chain(v)).all(same)
    }
}
