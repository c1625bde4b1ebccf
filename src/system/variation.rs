//! Bodies as functions of their velocity directions.

use crate::body::{Frame, Slope};
use crate::math::Taylor;
use crate::scene::Part;

/// One body as a function of six of its velocity directions.
#[derive(Default)]
pub(super) struct Varied<const D: usize> {
    pub frames: Vec<Frame<Taylor<Slope>, D>>,
    q: Vec<Slope>,
    v: Vec<Slope>,
    directions: Vec<Slope>,
    moved: Vec<Slope>,
}

impl<const D: usize> Varied<D> {
    /// Frames of a body's markers as functions of six of its velocity directions: q + N(q) e_j, v held.
    pub fn vary(&mut self, part: &Part<D>, q: &[f64], v: &[f64], first: usize) {
        let lift = |from: &[f64], to: &mut Vec<Slope>| {
            to.clear();
            to.extend(from.iter().map(|&x| Slope::fixed(x)));
        };
        lift(q, &mut self.q);
        lift(v, &mut self.v);
        self.directions.clear();
        self.directions.resize(part.nv, Slope::fixed(0.0));
        let seeded = self.directions[first..].iter_mut().take(6).enumerate();
        seeded.for_each(|(j, direction)| *direction = Slope::seeded(0.0, j));
        self.moved.clear();
        self.moved.resize(part.nq, Slope::fixed(0.0));
        part.body.rate(&self.q, &self.directions, &mut self.moved);
        self.moved.iter_mut().zip(&self.q).for_each(|(moved, &q)| *moved += q);
        self.frames.resize(part.body.marker_count(), Frame::world());
        part.body.motion(&self.moved, &self.v, None, &mut self.frames);
    }
}

/// A frame that does not vary.
pub(super) fn fixed<const D: usize>(frame: &Frame<Taylor<f64>, D>) -> Frame<Taylor<Slope>, D> {
    frame.map(|x| Taylor::new(Slope::fixed(x.x), Slope::fixed(x.d), Slope::fixed(x.dd)))
}
