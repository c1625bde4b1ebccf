//! M, f, phi, phi', gamma and G at one state: rigid bodies by their poses and the joints between them by closed
//! formulas, all else by moving frames.

use super::mechanism::{Mechanism, of, place_body};
use super::portions::{BodyPortion, BodyTerms, JointPortion, JointsTerms};
use super::rigid_joint::RigidJoint;
use super::rows::JointRows;
use super::view::{gathered, input_on};
use super::workspace::Workspace;
use super::{Need, Terms};
use crate::body::{Frame, Freedom, MOST_MARKERS, MarkerId, Pose, Wrench};
use crate::force::Force;
use crate::joint::{ClosedForm, Lock};
use crate::math::array::Each;
use crate::math::kkt::{Analysis, Lever};
use crate::math::threads::each;
use crate::math::{Taylor, Time};
use crate::scene::{Connection, Measure, Model, Part, Watched};
use std::ops::Range;
use std::sync::Arc;

/// What the velocities of each body are, if it is rigid; neighbours that are alike share one.
fn freedoms<const D: usize>(model: &Model<D>) -> Vec<Option<Arc<Freedom>>> {
    let mut last: Option<Arc<Freedom>> = None;
    let shared = |part: &Part<D>| {
        let freedom = part.body.freedom()?;
        if last.as_deref() != Some(&freedom) {
            last = Some(Arc::new(freedom));
        }
        last.clone()
    };
    model.bodies.iter().map(shared).collect()
}

/// The rigid bodies of a model, the joints between them, and what is constant.
pub(super) struct RigidParts<const D: usize> {
    /// What the velocities of each body are, if it is rigid.
    pub freedoms: Vec<Option<Arc<Freedom>>>,
    pub are_all_rigid: bool,
    /// True if q' = v for all of them, but for turning angles.
    pub rates_are_velocities: bool,
    /// The translations and rotations that each joint locks, if that is all it does.
    pub locks: Vec<Option<Lock<D>>>,
    /// All bodies.
    bodies: Vec<BodyPortion>,
    /// Joints with closed formulas.
    pub joints: Vec<JointPortion<D>>,
    /// Indices of all other joints.
    pub general_joints: Vec<usize>,
    /// Values of M where they are constant, else zero.
    mass: Vec<f64>,
    /// Own forces of the bodies where they are constant, else zero.
    weight: Vec<f64>,
}

impl<const D: usize> RigidParts<D> {
    /// Finds them in a model with the places of its joints and of the values of M.
    pub fn new(model: &Model<D>, rows: &[JointRows], masses: &[Range<usize>]) -> Self {
        let freedoms = freedoms(model);
        let mut joints = Vec::new();
        let mut general_joints = Vec::new();
        for (i, (joint, rows)) in model.joints.iter().zip(rows).enumerate() {
            match RigidJoint::new(model, &freedoms, joint, rows) {
                Some(joint) => joints.push(joint),
                None => general_joints.push(i),
            }
        }
        let are_all_rigid = freedoms.iter().all(Option::is_some);
        let is_rate = |part: &Part<D>| part.body.turning().is_none() && part.nq == part.nv;
        let mut parts = RigidParts {
            are_all_rigid,
            rates_are_velocities: are_all_rigid && model.bodies.iter().all(is_rate),
            freedoms,
            locks: model.joints.iter().map(|joint| as_lock(joint.element.closed_form())).collect(),
            general_joints,
            bodies: BodyPortion::all(model, masses),
            joints: JointPortion::all(joints),
            mass: vec![0.0; masses.last().map_or(0, |last| last.end)],
            weight: vec![0.0; model.bodies.last().map_or(0, |last| last.first_v + last.nv)],
        };
        for (part, places) in model.bodies.iter().zip(masses) {
            let q = vec![0.0; part.nq];
            let v = vec![0.0; part.nv];
            if part.body.has_constant_mass() {
                part.body.mass(&q, &mut parts.mass[places.clone()]);
            }
            if part.body.has_constant_forces() {
                part.body.own_forces(&q, &v, &model.gravity, &mut parts.weight[part.first_v..][..part.nv]);
            }
        }
        parts
    }

    /// What is known of the blocks of G.
    pub fn analysis(&self) -> Arc<Analysis> {
        let levers = self.joints.iter().flat_map(|portion| {
            let levers = portion.joints.iter().flat_map(RigidJoint::levers);
            levers.map(|lever| Lever { first_entry: portion.first_entry + lever.first_entry, ..lever })
        });
        Arc::new(Analysis::with(levers.collect()))
    }

    /// What a joint locks, if that is all it does and its bodies are rigid.
    pub fn lock(&self, model: &Model<D>, joint: usize) -> Option<&Lock<D>> {
        let mut bodies = model.joints[joint].markers.iter().filter_map(|&marker| model.markers.bodies[marker]);
        self.locks[joint].as_ref().filter(|_| bodies.all(|body| self.freedoms[body].is_some()))
    }
}

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
        self.write_bodies((q, v), need, work, terms);
        if need.includes(Need::FORCE) {
            self.forces(time, q, work, terms);
        }
        if need.includes(Need::CONSTRAINTS) || need.includes(Need::G) {
            each(JointsTerms::all(&self.rigid.joints, terms), &|JointsTerms { portions, mut terms }: JointsTerms<
                D,
            >| {
                if need.includes(Need::CONSTRAINTS) {
                    terms.phi_t.fill(0.0);
                }
                for portion in portions {
                    portion.joints.iter().for_each(|joint| joint.evaluate(&work.poses, need, &mut terms));
                }
            });
            self.general_joints(time, q, need, work, terms);
        }
    }

    /// q' of all bodies.
    pub(super) fn write_rates(&self, q: &[f64], v: &[f64], qdot: &mut [f64]) {
        if self.rigid.rates_are_velocities {
            return qdot[..v.len()].copy_from_slice(v);
        }
        for part in &self.model().bodies {
            let rates = &mut qdot[part.first_q..part.first_q + part.nq];
            part.body.rate(of(q, part, true), of(v, part, false), rates);
        }
    }

    /// M, the own forces of the bodies, the poses of the rigid ones and the frames of the markers of all others.
    fn write_bodies(&self, (q, v): (&[f64], &[f64]), need: Need, work: &mut Workspace<D>, terms: &mut Terms) {
        let is_placed = self.rigid.are_all_rigid || work.is_at(q, v);
        if !is_placed {
            // Only some of the frames are placed.
            work.remember([&[]; 2]);
            work.motion.resize(self.model().marker_count(), Frame::world());
        }
        let Workspace { poses, motion, .. } = work;
        poses.resize(self.model().bodies.len() + 1, Pose::ground());
        let motion = if is_placed { &mut [] } else { &mut motion[..] };
        let Terms { mass, f, .. } = &mut *terms;
        each(BodyTerms { portions: &self.rigid.bodies, poses, motion, mass, f }, &|mut terms: BodyTerms<D>| {
            for portion in terms.portions {
                self.write_portion(portion, (q, v), need, &mut terms);
            }
        });
        if need.includes(Need::FORCE) {
            terms.power = 0.0;
            for portion in &self.rigid.bodies {
                let bodies = portion.varying_forces.iter().map(|&body| &self.model().bodies[body]);
                bodies.for_each(|part| terms.power -= part.body.dissipation(of(v, part, false)));
            }
        }
    }

    #[inline]
    fn write_portion(&self, portion: &BodyPortion, (q, v): (&[f64], &[f64]), need: Need, terms: &mut BodyTerms<D>) {
        if need.includes(Need::MASS) {
            self.write_mass(portion, q, terms.mass);
        }
        if need.includes(Need::FORCE) {
            self.own_forces(portion, (q, v), terms.f);
        }
        let bodies = portion.bodies.clone();
        let parts = self.model().bodies[bodies.clone()].iter().zip(&self.rigid.freedoms[bodies]);
        for ((part, freedom), pose) in parts.zip(&mut *terms.poses) {
            match freedom {
                Some(_) => *pose = part.body.pose(of(q, part, true), of(v, part, false)),
                None if terms.motion.is_empty() => {}
                None => {
                    let first = part.first_marker - portion.markers.start;
                    place_body(part, (q, v, &[]), &mut terms.motion[first..]);
                }
            }
        }
    }

    /// The frame of a marker along the motion, with its acceleration at v' = 0.
    #[inline(always)]
    fn moving_frame(
        &self,
        marker: MarkerId,
        motion: &[Frame<Taylor<f64>, D>],
        poses: &[Pose<D>],
    ) -> Frame<Taylor<f64>, D> {
        match self.model().markers.bodies[marker] {
            Some(body) if self.rigid.freedoms[body].is_some() => {
                let part = &self.model().bodies[body];
                poses[body].frame(part.body.marker(marker - part.first_marker))
            }
            _ => motion[marker],
        }
    }

    fn write_mass(&self, portion: &BodyPortion, q: &[f64], mass: &mut [f64]) {
        mass.copy_from_slice(&self.rigid.mass[portion.masses.clone()]);
        for &body in &portion.varying_masses {
            let (part, Range { start, end }) = (&self.model().bodies[body], self.masses[body].clone());
            part.body.mass(of(q, part, true), &mut mass[start - portion.masses.start..end - portion.masses.start]);
        }
    }

    fn own_forces(&self, portion: &BodyPortion, (q, v): (&[f64], &[f64]), f: &mut [f64]) {
        f.copy_from_slice(&self.rigid.weight[portion.v.clone()]);
        for &body in &portion.varying_forces {
            let part = &self.model().bodies[body];
            let f = &mut f[part.first_v - portion.v.start..][..part.nv];
            part.body.own_forces(of(q, part, true), of(v, part, false), &self.model().gravity, f);
        }
    }

    fn forces(&self, time: Time<f64>, q: &[f64], work: &mut Workspace<D>, terms: &mut Terms) {
        for (i, force) in self.model().forces.iter().enumerate() {
            let power = match force.markers.len() {
                1 => self.force::<1>((i, force), time, q, work, terms),
                2 => self.force::<2>((i, force), time, q, work, terms),
                _ => self.force::<MOST_MARKERS>((i, force), time, q, work, terms),
            };
            for (rate, Watched { measure, unit, .. }) in terms.powers.iter_mut().zip(&self.model().works) {
                if matches!(measure, Measure::Power { force } if *force == i) {
                    *rate = power * unit.per_si;
                }
            }
        }
    }

    /// Adds a force with at most N markers to f, and returns its power.
    fn force<const N: usize>(
        &self,
        (index, Connection { element, markers, .. }): (usize, &Connection<Box<dyn Force<D>>>),
        time: Time<f64>,
        q: &[f64],
        work: &mut Workspace<D>,
        terms: &mut Terms,
    ) -> f64 {
        let n = markers.len();
        let Workspace { motion, poses, pulled, inputs, .. } = work;
        let mut frames = [Frame::world(); N];
        frames.iter_mut().zip(markers).for_each(|(frame, &marker)| *frame = self.moving_frame(marker, motion, poses));
        let mut wrenches = [Wrench::zero(); N];
        let instant = time.map(Taylor::time);
        let action = if inputs.is_empty() {
            element.act(&frames[..n], instant, &mut wrenches[..n])
        } else {
            let input = input_on(self.model(), index, inputs).map(Taylor::fixed);
            element.driven(&input, &frames[..n], instant, &mut wrenches[..n])
        };
        let mut power = 0.0;
        for ((wrench, frame), &marker) in wrenches.iter().zip(&frames).zip(markers) {
            power += wrench.power(frame);
            self.pull_back(marker, q, (frame, wrench), poses, pulled, &mut terms.f);
        }
        terms.power += action.potential.d + power;
        power
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
        match &self.rigid.freedoms[body] {
            Some(freedom) => {
                let f = &mut f[part.first_v..part.first_v + part.nv];
                freedom.pull_back(&poses[body], &frame.r.each(|x| x.x), wrench, f);
            }
            None => self.supports[marker].add_to(f, pulled, |f| {
                let index = marker - part.first_marker;
                let frame = frame.map(|x| x.x);
                part.body.pull_back(index, of(q, part, true), &frame, wrench, f);
            }),
        }
    }

    /// The joints without closed formulas.
    fn general_joints(&self, time: Time<f64>, q: &[f64], need: Need, work: &Workspace<D>, terms: &mut Terms) {
        for joint in self.rigid.general_joints.iter().map(|&joint| self.placed_joint(joint)) {
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

fn as_lock<const D: usize>(form: Option<ClosedForm<D>>) -> Option<Lock<D>> {
    match form {
        Some(ClosedForm::Lock(lock)) => Some(lock),
        _ => None,
    }
}
