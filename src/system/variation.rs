//! Frames of bodies differentiated along velocity directions.

use super::mechanism::of;
use super::tangent::OperatingPoint;
use crate::body::{Dual6, Frame};
use crate::math::Taylor;
use crate::scene::Part;

/// The quantity that is differentiated with respect to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum SeedDirection {
    /// q + N(q) e_j at fixed v.
    Coordinates,
    /// v + e_j at fixed q.
    Velocities,
    /// v' + e_j at fixed q and v.
    Accelerations,
}

/// One body over dual numbers of six of its velocity directions, with memory for the forces that follow.
#[derive(Default)]
pub(super) struct SeededBody<const D: usize> {
    pub frames: Vec<Frame<Taylor<Dual6>, D>>,
    /// The body's q, seeded.
    pub moved: Vec<Dual6>,
    /// The body's v, seeded.
    pub moved_v: Vec<Dual6>,
    /// Generalized forces of a body.
    pub f: Vec<Dual6>,
    /// Generalized forces at one of its markers.
    pub pulled: Vec<Dual6>,
    /// q of a body that is not seeded.
    pub rest: Vec<Dual6>,
    /// The body's v', seeded, where it is given.
    pub moved_vdot: Vec<Dual6>,
    directions: Vec<Dual6>,
}

impl<const D: usize> SeededBody<D> {
    /// Frames of a body's markers as functions of up to six of the system's velocity directions, which belong to the
    /// body. Their accelerations are those at v' = 0 where `at.vdot` is empty.
    pub fn vary(&mut self, along: SeedDirection, part: &Part<D>, at: &OperatingPoint, directions: &[usize]) {
        let (q, v) = (of(at.q, part, true), of(at.v, part, false));
        self.directions.clear();
        self.directions.resize(part.nv, Dual6::fixed(0.0));
        for (j, &direction) in directions.iter().enumerate() {
            self.directions[direction - part.first_v] = Dual6::seeded(0.0, j);
        }
        lift(v, &mut self.moved_v);
        lift(q, &mut self.rest);
        lift(q, &mut self.moved);
        lift(if at.vdot.is_empty() { at.vdot } else { of(at.vdot, part, false) }, &mut self.moved_vdot);
        match along {
            SeedDirection::Coordinates => {
                part.body.rate(&self.rest, &self.directions, &mut self.moved);
                self.moved.iter_mut().zip(&self.rest).for_each(|(moved, &q)| *moved += q);
            }
            SeedDirection::Velocities => add(&mut self.moved_v, &self.directions),
            SeedDirection::Accelerations => add(&mut self.moved_vdot, &self.directions),
        }
        self.frames.resize(part.body.marker_count(), Frame::world());
        let vdot = (!at.vdot.is_empty()).then_some(self.moved_vdot.as_slice());
        part.body.motion(&self.moved, &self.moved_v, vdot, &mut self.frames);
    }
}

fn lift(from: &[f64], to: &mut Vec<Dual6>) {
    to.clear();
    to.extend(from.iter().map(|&x| Dual6::fixed(x)));
}

fn add(to: &mut [Dual6], directions: &[Dual6]) {
    to.iter_mut().zip(directions).for_each(|(to, &direction)| *to += direction);
}

/// A frame whose derivatives are zero.
pub(super) fn fixed<const D: usize>(frame: &Frame<Taylor<f64>, D>) -> Frame<Taylor<Dual6>, D> {
    frame.map(|x| Taylor::new(Dual6::fixed(x.x), Dual6::fixed(x.d), Dual6::fixed(x.dd)))
}
