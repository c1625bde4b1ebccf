//! Frames of bodies differentiated along velocity directions.

use super::gather::MovingFrames;
use super::seed::{SeedDirection, fix};
use super::solid::Solid;
use super::terms::OperatingPoint;
use crate::body::{Dual6, Frame, Wrench};
use crate::math::Taylor;
use crate::scene::Part;
use std::slice::from_mut;

/// One body over dual numbers of six of its velocity directions, with memory for the forces that follow.
#[derive(Default)]
pub(super) struct SeededBody<const D: usize> {
    /// The body, if it is rigid.
    solid: Option<Solid<D>>,
    /// Frames of the markers of one element.
    pub gathered: Vec<Frame<Taylor<Dual6>, D>>,
    /// Wrenches at these markers.
    pub acting: Vec<Wrench<Dual6, D>>,
    along: Option<SeedDirection>,
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
    /// Seeds a body along up to six of the system's velocity directions, which belong to it; along all if it is `solid`.
    /// Accelerations are those at v' = 0 where `at.vdot` is empty.
    pub fn vary(
        &mut self,
        along: SeedDirection,
        part: &Part<D>,
        at: &OperatingPoint,
        solid: Option<Solid<D>>,
        directions: &[usize],
    ) {
        (self.along, self.solid) = (Some(along), solid);
        if self.solid.is_none() {
            self.vary_state(along, part, at, directions);
        }
    }

    /// Writes the body's q, v and v' alone, whatever moves with them.
    pub fn vary_state(&mut self, along: SeedDirection, part: &Part<D>, at: &OperatingPoint, directions: &[usize]) {
        let q = part.coordinates(at.q);
        let v = part.velocities(at.v);
        self.directions.clear();
        self.directions.resize(part.nv, Dual6::fixed(0.0));
        for (j, &direction) in directions.iter().enumerate() {
            self.directions[direction - part.first_v] = Dual6::seeded(0.0, j);
        }
        lift(v, &mut self.moved_v);
        lift(q, &mut self.rest);
        lift(q, &mut self.moved);
        lift(if at.vdot.is_empty() { at.vdot } else { part.velocities(at.vdot) }, &mut self.moved_vdot);
        match along {
            SeedDirection::Coordinates => {
                part.body.rate(&self.rest, &self.directions, &mut self.moved);
                self.moved.iter_mut().zip(&self.rest).for_each(|(moved, &q)| *moved += q);
            }
            SeedDirection::Velocities => add(&mut self.moved_v, &self.directions),
            SeedDirection::Accelerations => add(&mut self.moved_vdot, &self.directions),
        }
    }

    /// Writes the frame of a marker of the seeded body.
    pub fn write(&self, part: &Part<D>, marker: usize, motion: &MovingFrames<D>, out: &mut Frame<Taylor<Dual6>, D>) {
        match (&self.solid, self.along) {
            (Some(solid), Some(along)) => solid.seed(along, &motion[marker], out),
            _ => {
                let vdot = (!self.moved_vdot.is_empty()).then_some(&self.moved_vdot[..]);
                let out = from_mut(out);
                part.body.motion(&self.moved, &self.moved_v, vdot, marker - part.first_marker, out);
            }
        }
    }

    /// Gathers the frames of an element's markers; those for which `is_seeded` belong to the seeded body.
    pub fn gather(
        &mut self,
        part: &Part<D>,
        markers: &[usize],
        motion: &MovingFrames<D>,
        is_seeded: impl Fn(usize) -> bool,
    ) {
        let mut gathered = std::mem::take(&mut self.gathered);
        gathered.resize(markers.len(), Frame::world());
        for (slot, (&marker, out)) in markers.iter().zip(&mut gathered).enumerate() {
            if is_seeded(slot) { self.write(part, marker, motion, out) } else { fix(&motion[marker], out) }
        }
        self.gathered = gathered;
    }
}

fn lift(from: &[f64], to: &mut Vec<Dual6>) {
    to.clear();
    to.extend(from.iter().map(|&x| Dual6::fixed(x)));
}

fn add(to: &mut [Dual6], directions: &[Dual6]) {
    to.iter_mut().zip(directions).for_each(|(to, &direction)| *to += direction);
}
