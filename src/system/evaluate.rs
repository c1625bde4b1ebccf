//! M, f, phi, phi', gamma and G at one state: rigid bodies by their poses and the joints between them by closed
//! formulas, all else by moving frames.

use super::mechanism::{Mechanism, Workspace, of};
use super::view::gathered;
use super::{Need, Terms};
use crate::body::{Frame, MOST_MARKERS, MarkerId, Pose, Wrench};
use crate::math::{Taylor, Time};

impl<const D: usize> Mechanism<D> {
    /// Writes the needed terms of M, f, the constraints and G.
    pub(super) fn write_terms(
        &self,
        time: Time<f64>,
        (q, v): (&[f64], &[f64]),
        need: Need,
        work: &mut Workspace<D>,
        terms: &mut Terms,
    ) {
        self.move_bodies(q, v, work);
        if need.includes(Need::MASS) {
            self.write_mass(q, terms);
        }
        if need.includes(Need::FORCE) {
            self.own_forces(q, v, terms);
            self.forces(time, q, work, terms);
        }
        self.rigid_joints.iter().for_each(|joint| joint.evaluate(&work.poses, need, terms));
        self.general_joints(time, q, need, work, terms);
    }

    /// Poses of the rigid bodies, and the frames of the markers of all others.
    fn move_bodies(&self, q: &[f64], v: &[f64], work: &mut Workspace<D>) {
        for (body, part) in self.model().bodies.iter().enumerate() {
            match self.freedoms[body] {
                Some(_) => work.poses[body] = part.body.pose(of(q, part, true), of(v, part, false)),
                None => self.place_body(part, (q, v, &[]), &mut work.motion),
            }
        }
    }

    /// The frame of a marker along the motion, with its acceleration at v' = 0.
    #[inline]
    fn moving_frame(
        &self,
        marker: MarkerId,
        motion: &[Frame<Taylor<f64>, D>],
        poses: &[Pose<D>],
    ) -> Frame<Taylor<f64>, D> {
        match self.model().markers.bodies[marker] {
            Some(body) if self.freedoms[body].is_some() => {
                let part = &self.model().bodies[body];
                poses[body].frame(part.body.marker(marker - part.first_marker))
            }
            _ => motion[marker],
        }
    }

    fn write_mass(&self, q: &[f64], terms: &mut Terms) {
        terms.mass.copy_from_slice(&self.constant_mass);
        for &body in &self.varying_masses {
            let part = &self.model().bodies[body];
            part.body.mass(of(q, part, true), &mut terms.mass[self.masses[body].clone()]);
        }
    }

    fn own_forces(&self, q: &[f64], v: &[f64], terms: &mut Terms) {
        terms.f.fill(0.0);
        terms.power = 0.0;
        for (part, freedom) in self.model().bodies.iter().zip(&self.freedoms) {
            let (q, v) = (of(q, part, true), of(v, part, false));
            part.body.own_forces(q, v, &self.model().gravity, &mut terms.f[part.first_v..part.first_v + part.nv]);
            if freedom.is_none() {
                terms.power -= part.body.dissipation(v);
            }
        }
    }

    fn forces(&self, time: Time<f64>, q: &[f64], work: &mut Workspace<D>, terms: &mut Terms) {
        let Workspace { motion, poses, pulled, .. } = work;
        for force in &self.model().forces {
            let mut wrenches = [Wrench::zero(); MOST_MARKERS];
            let wrenches = &mut wrenches[..force.markers.len()];
            gathered(
                &force.markers,
                |marker| self.moving_frame(marker, motion, poses),
                |frames| {
                    let action = force.element.act(frames, time.map(Taylor::time), wrenches);
                    terms.power += action.potential.d;
                    for ((wrench, frame), &marker) in wrenches.iter().zip(frames).zip(&force.markers) {
                        terms.power += wrench.power(frame);
                        self.pull_back(marker, q, (frame, wrench), poses, pulled, &mut terms.f);
                    }
                },
            );
        }
    }

    /// f += J^T w for a wrench at the frame of a marker.
    fn pull_back(
        &self,
        marker: MarkerId,
        q: &[f64],
        (frame, wrench): (&Frame<Taylor<f64>, D>, &Wrench<f64, D>),
        poses: &[Pose<D>],
        pulled: &mut Vec<f64>,
        f: &mut [f64],
    ) {
        let Some(body) = self.model().markers.bodies[marker] else { return };
        let part = &self.model().bodies[body];
        match &self.freedoms[body] {
            Some(freedom) => {
                let f = &mut f[part.first_v..part.first_v + part.nv];
                freedom.pull_back(&poses[body], &frame.r.map(|x| x.x), wrench, f);
            }
            None => self.supports[marker].add_to(f, pulled, |f| {
                let (index, frame) = (marker - part.first_marker, frame.map(|x| x.x));
                part.body.pull_back(index, of(q, part, true), &frame, wrench, f);
            }),
        }
    }

    /// The joints without closed formulas.
    fn general_joints(&self, time: Time<f64>, q: &[f64], need: Need, work: &Workspace<D>, terms: &mut Terms) {
        for joint in self.general_joints.iter().map(|&joint| self.placed_joint(joint)) {
            let moving = |marker| self.moving_frame(marker, &work.motion, &work.poses);
            gathered(&joint.joint.markers, moving, |frames| {
                if need.includes(Need::CONSTRAINTS) {
                    joint.levels(time, frames, terms);
                }
                if need.includes(Need::G) {
                    joint.gradient(time, q, frames, terms);
                }
            });
        }
    }
}
