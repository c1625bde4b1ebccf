//! M, f, phi, phi', gamma and G at one state: rigid bodies by their poses and the joints between them by closed
//! formulas, all else by moving frames.

use super::frames::{Frames, place_body};
use super::gather::{MovingFrames, gathered};
use super::layout::Layout;
use super::placed_joint::PlacedJoint;
use super::portions::{BodyPortion, BodyTerms, JointPortion, JointsTerms};
use super::rigid_joint::RigidJoint;
use super::terms::{Need, Terms};
use super::view::input_on;
use crate::body::{Frame, MOST_MARKERS, MarkerId, Pose, Wrench};
use crate::math::array::Each;
use crate::math::kkt::{Analysis, Lever};
use crate::math::threads::each;
use crate::math::{Taylor, Time};
use crate::scene::{Connection, Measure, Model, ModelForce, ModelOutput, Part};
use std::ops::Range;
use std::sync::Arc;

/// Bodies and joints in the order of their evaluation, and what is constant.
pub(super) struct EvaluationPlan<const D: usize> {
    are_all_rigid: bool,
    /// True if q' = v for all bodies, but for turning angles.
    rates_are_velocities: bool,
    /// All bodies.
    bodies: Vec<BodyPortion>,
    /// Joints with closed formulas.
    joints: Vec<JointPortion<D>>,
    /// Indices of all other joints.
    general_joints: Vec<usize>,
    /// Values of M where they are constant, else zero.
    mass: Vec<f64>,
    /// Own forces of the bodies where they are constant, else zero.
    weight: Vec<f64>,
}

impl<const D: usize> EvaluationPlan<D> {
    pub fn new(layout: &Layout<D>) -> Self {
        let Layout { model, masses, freedoms, .. } = layout;
        let mut joints = Vec::new();
        let mut general_joints = Vec::new();
        for (i, (joint, rows)) in model.joints.iter().zip(&layout.joints).enumerate() {
            match RigidJoint::new(model, freedoms, joint, rows) {
                Some(joint) => joints.push(joint),
                None => general_joints.push(i),
            }
        }
        let are_all_rigid = freedoms.iter().all(Option::is_some);
        let is_rate = |part: &Part<D>| part.facts.turning.is_none() && part.nq == part.nv;
        let mut plan = EvaluationPlan {
            are_all_rigid,
            rates_are_velocities: are_all_rigid && model.bodies.iter().all(is_rate),
            general_joints,
            bodies: BodyPortion::all(model, masses),
            joints: JointPortion::all(joints),
            mass: vec![0.0; masses.last().map_or(0, |last| last.end)],
            weight: vec![0.0; model.bodies.last().map_or(0, |last| last.first_v + last.nv)],
        };
        for (part, places) in model.bodies.iter().zip(masses) {
            let q = vec![0.0; part.nq];
            let v = vec![0.0; part.nv];
            if part.facts.has_constant_mass {
                part.body.mass(&q, &mut plan.mass[places.clone()]);
            }
            if part.facts.has_constant_forces {
                part.body.own_forces(&q, &v, &model.gravity, &mut plan.weight[part.first_v..][..part.nv]);
            }
        }
        plan
    }

    /// q' of all bodies.
    pub fn write_rates(&self, model: &Model<D>, q: &[f64], v: &[f64], qdot: &mut [f64]) {
        if self.rates_are_velocities {
            return qdot[..v.len()].copy_from_slice(v);
        }
        for part in &model.bodies {
            let rates = &mut qdot[part.first_q..part.first_q + part.nq];
            part.body.rate(part.coordinates(q), part.velocities(v), rates);
        }
    }

    /// What is known of the blocks of G.
    pub fn analysis(&self) -> Arc<Analysis> {
        let levers = self.joints.iter().flat_map(|portion| {
            let levers = portion.joints.iter().flat_map(RigidJoint::levers);
            levers.map(|lever| Lever { first_entry: portion.first_entry + lever.first_entry, ..lever })
        });
        Arc::new(Analysis::with(levers.collect()))
    }
}

/// Memory of evaluations.
pub(super) struct EvaluationMemory<const D: usize> {
    pub frames: Frames<D>,
    /// Poses of the rigid bodies by the index of the body; the last is that of the ground. Empty until needed.
    poses: Vec<Pose<D>>,
    pulled: Vec<f64>,
}

impl<const D: usize> EvaluationMemory<D> {
    pub fn new(model: &Model<D>) -> Self {
        EvaluationMemory { frames: Frames::new(model), poses: Vec::new(), pulled: Vec::new() }
    }
}

/// Writes the needed terms of a model at a state.
pub(super) struct Evaluator<'a, const D: usize> {
    pub layout: &'a Layout<D>,
    pub plan: &'a EvaluationPlan<D>,
    pub time: Time<'a, f64>,
    pub q: &'a [f64],
    pub v: &'a [f64],
    /// Values of the inputs; empty where all are zero.
    pub inputs: &'a [f64],
    pub need: Need,
}

impl<const D: usize> Evaluator<'_, D> {
    /// Writes M, f, the constraints and G, as far as needed.
    pub fn write_terms(&self, memory: &mut EvaluationMemory<D>, terms: &mut Terms) {
        let need = self.need;
        self.write_bodies(memory, terms);
        if need.includes(Need::FORCE) {
            self.forces(memory, terms);
        }
        if need.includes(Need::CONSTRAINTS) || need.includes(Need::G) {
            each(JointsTerms::all(&self.plan.joints, terms), &|JointsTerms { portions, mut terms }: JointsTerms<D>| {
                if need.includes(Need::CONSTRAINTS) {
                    terms.phi_t.fill(0.0);
                }
                for portion in portions {
                    portion.joints.iter().for_each(|joint| joint.evaluate(&memory.poses, need, &mut terms));
                }
            });
            self.general_joints(memory, terms);
        }
    }

    /// M, the own forces of the bodies, the poses of the rigid ones and the frames of the markers of all others.
    fn write_bodies(&self, memory: &mut EvaluationMemory<D>, terms: &mut Terms) {
        let model = &self.layout.model;
        let EvaluationMemory { frames, poses, .. } = memory;
        let is_placed = self.plan.are_all_rigid || frames.are_at(self.q, self.v);
        if !is_placed {
            frames.open(model);
        }
        poses.resize(model.bodies.len() + 1, Pose::ground());
        let motion = if is_placed { &mut [] } else { &mut frames.motion[..] };
        let Terms { mass, f, .. } = &mut *terms;
        each(BodyTerms { portions: &self.plan.bodies, poses, motion, mass, f }, &|mut terms: BodyTerms<D>| {
            for portion in terms.portions {
                self.write_portion(portion, &mut terms);
            }
        });
        if self.need.includes(Need::FORCE) {
            terms.power = 0.0;
            for portion in &self.plan.bodies {
                let bodies = portion.varying_forces.iter().map(|&body| &model.bodies[body]);
                bodies.for_each(|part| terms.power -= part.body.dissipation(part.velocities(self.v)));
            }
        }
    }

    #[inline]
    fn write_portion(&self, portion: &BodyPortion, terms: &mut BodyTerms<D>) {
        if self.need.includes(Need::MASS) {
            self.write_mass(portion, terms.mass);
        }
        if self.need.includes(Need::FORCE) {
            self.own_forces(portion, terms.f);
        }
        let bodies = portion.bodies.clone();
        let parts = self.layout.model.bodies[bodies.clone()].iter().zip(&self.layout.freedoms[bodies]);
        for ((part, freedom), pose) in parts.zip(&mut *terms.poses) {
            match freedom {
                Some(_) => *pose = part.body.pose(part.coordinates(self.q), part.velocities(self.v)),
                None if terms.motion.is_empty() => {}
                None => {
                    let first = part.first_marker - portion.markers.start;
                    place_body(part, self.q, self.v, &[], &mut terms.motion[first..]);
                }
            }
        }
    }

    fn write_mass(&self, portion: &BodyPortion, mass: &mut [f64]) {
        mass.copy_from_slice(&self.plan.mass[portion.masses.clone()]);
        for &body in &portion.varying_masses {
            let part = &self.layout.model.bodies[body];
            let Range { start, end } = self.layout.masses[body];
            let values = start - portion.masses.start..end - portion.masses.start;
            part.body.mass(part.coordinates(self.q), &mut mass[values]);
        }
    }

    fn own_forces(&self, portion: &BodyPortion, f: &mut [f64]) {
        let model = &self.layout.model;
        f.copy_from_slice(&self.plan.weight[portion.v.clone()]);
        for &body in &portion.varying_forces {
            let part = &model.bodies[body];
            let f = &mut f[part.first_v - portion.v.start..][..part.nv];
            part.body.own_forces(part.coordinates(self.q), part.velocities(self.v), &model.gravity, f);
        }
    }

    /// The frame of a marker along the motion, with its acceleration at v' = 0.
    #[inline(always)]
    fn moving_frame(&self, marker: MarkerId, motion: &MovingFrames<D>, poses: &[Pose<D>]) -> Frame<Taylor<f64>, D> {
        match self.layout.model.markers.bodies[marker] {
            Some(body) if self.layout.freedoms[body].is_some() => {
                let part = &self.layout.model.bodies[body];
                poses[body].frame(&part.body.markers()[marker - part.first_marker])
            }
            _ => motion[marker],
        }
    }

    fn forces(&self, memory: &mut EvaluationMemory<D>, terms: &mut Terms) {
        for (i, force) in self.layout.model.forces.iter().enumerate() {
            let power = match force.markers.len() {
                1 => self.force::<1>(i, force, memory, terms),
                2 => self.force::<2>(i, force, memory, terms),
                _ => self.force::<MOST_MARKERS>(i, force, memory, terms),
            };
            for (rate, ModelOutput { measure, unit, .. }) in terms.powers.iter_mut().zip(&self.layout.model.works) {
                if matches!(measure, Measure::Power { force } if *force == i) {
                    *rate = power * unit.per_si;
                }
            }
        }
    }

    /// Adds a force with at most N markers to f, and returns its power.
    fn force<const N: usize>(
        &self,
        index: usize,
        Connection { element, markers, .. }: &ModelForce<D>,
        EvaluationMemory { frames: placed, poses, pulled }: &mut EvaluationMemory<D>,
        terms: &mut Terms,
    ) -> f64 {
        let n = markers.len();
        let motion = &placed.motion;
        let mut frames = [Frame::world(); N];
        frames.iter_mut().zip(markers).for_each(|(frame, &marker)| *frame = self.moving_frame(marker, motion, poses));
        let mut wrenches = [Wrench::zero(); N];
        let instant = self.time.map(Taylor::time);
        let action = if self.inputs.is_empty() {
            element.act(&frames[..n], instant, &mut wrenches[..n])
        } else {
            let input = input_on(&self.layout.model, index, self.inputs).map(Taylor::fixed);
            element.driven(&input, &frames[..n], instant, &mut wrenches[..n])
        };
        let mut power = 0.0;
        for ((wrench, frame), &marker) in wrenches.iter().zip(&frames).zip(markers) {
            power += wrench.power(frame);
            self.pull_back(marker, frame, wrench, poses, pulled, &mut terms.f);
        }
        terms.power += action.potential.d + power;
        power
    }

    /// f += J^T w for a wrench at the frame of a marker.
    fn pull_back(
        &self,
        marker: MarkerId,
        frame: &Frame<Taylor<f64>, D>,
        wrench: &Wrench<f64, D>,
        poses: &[Pose<D>],
        pulled: &mut Vec<f64>,
        f: &mut [f64],
    ) {
        let Some(body) = self.layout.model.markers.bodies[marker] else { return };
        let part = &self.layout.model.bodies[body];
        match &self.layout.freedoms[body] {
            Some(freedom) => {
                let f = &mut f[part.first_v..part.first_v + part.nv];
                freedom.pull_back(&poses[body], &frame.r.each(|x| x.x), wrench, f);
            }
            None => self.layout.supports[marker].add_to(f, pulled, |f| {
                let index = marker - part.first_marker;
                let frame = frame.map(|x| x.x);
                part.body.pull_back(index, part.coordinates(self.q), &frame, wrench, f);
            }),
        }
    }

    /// The joints without closed formulas.
    fn general_joints(&self, memory: &EvaluationMemory<D>, terms: &mut Terms) {
        let moving = |&marker: &MarkerId| self.moving_frame(marker, &memory.frames.motion, &memory.poses);
        for joint in self.plan.general_joints.iter().map(|&joint| PlacedJoint::new(self.layout, joint)) {
            gathered(&joint.joint.markers, moving, |frames| {
                if self.need.includes(Need::CONSTRAINTS) {
                    joint.levels(self.time, frames, terms);
                }
                if self.need.includes(Need::G) {
                    joint.gradient(self.time, self.q, frames, terms);
                }
            });
        }
    }
}
