//! The equations of a scene's model.

use super::coupling::Couplings;
use super::evaluate::RigidParts;
use super::levi_civita::LeviCivita;
use super::limits::{Extent, limits};
use super::model_facts::facts_of;
use super::output_tangent::{OutputTangent, Slopes};
use super::rows::{JointRows, PlacedJoint, prescribed};
use super::spin::{Rotation, Spin};
use super::support::Support;
use super::tangent::{Evaluation, OperatingPoint, Tangent};
use super::view::{Plain, gathered};
use super::workspace::Workspace;
use super::{
    Dimensions, Energy, Feed, MechanicalSystem, Need, Prescribed, Road, Scratch, Structure, SwitchFacts, SystemFacts,
    Terms,
};
use crate::body::{Frame, Switches, cross};
use crate::math::array::from_fn;
use crate::math::kkt::Pattern;
use crate::math::{Rate, Regime, Taylor, Time};
use crate::scene::{Model, Part};
use nalgebra::DMatrix;
use std::borrow::Cow;
use std::ops::Range;

/// A model with the places of its coordinates, rows and matrix entries fixed.
pub struct Mechanism<const D: usize> {
    model: Model<D>,
    dimensions: Dimensions,
    structure: Structure,
    pub(super) joints: Vec<JointRows>,
    pub(super) couplings: Couplings,
    /// Range of each body's values in those of M.
    pub(super) masses: Vec<Range<usize>>,
    /// What the terms are evaluated from without frames.
    pub(super) rigid: RigidParts<D>,
    /// The velocities that move each marker; none for markers on the ground.
    pub(super) supports: Vec<Support>,
    facts: SystemFacts,
    extents: Vec<Extent<D>>,
}

impl<const D: usize> Mechanism<D> {
    /// Assigns rows of phi and entries of M, G, K and C to the parts of a model.
    pub fn new(model: Model<D>) -> Self {
        let last = model.bodies.last();
        let (q, v) = last.map_or((0, 0), |part| (part.first_q + part.nq, part.first_v + part.nv));
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
        let joints: Vec<JointRows> =
            model.joints.iter().map(|joint| JointRows::new(&supports, joint, &mut g)).collect();
        let rigid = RigidParts::new(&model, &joints, &masses);
        let turning_angles = model.turnings.len();
        let dimensions = Dimensions {
            q: q + turning_angles,
            v,
            lambda: g.rows,
            nonholonomic: 0,
            states: model.states,
            turning_angles,
        };
        let mut tangent = Pattern { rows: v, cols: v, entries: Vec::new() };
        let couplings = Couplings::new(&model, &supports, &rigid, &mut tangent);
        let structure = Structure { analysis: rigid.analysis(), ..Structure::new(mass, g, tangent) };
        let (limited, extents) = limits(&model);
        let facts = facts_of(&model, &joints, &masses, limited);
        Mechanism { model, dimensions, structure, joints, couplings, masses, rigid, supports, facts, extents }
    }

    /// The model that the equations belong to.
    pub fn model(&self) -> &Model<D> {
        &self.model
    }

    /// Range of the rows of phi of joint `joint`.
    pub fn rows_of_joint(&self, joint: usize) -> Range<usize> {
        self.joints[joint].range()
    }

    /// Frames of all markers at (q, v), in the world, with their velocities.
    pub fn frames(&self, q: &[f64], v: &[f64], scratch: &mut Scratch) -> Vec<Frame<Taylor<f64>, D>> {
        self.at(q, v, scratch, |work, _| work.motion.clone())
    }

    /// Calls `see` with the workspace, whose frames are evaluated at (q, v).
    pub(super) fn at<R>(
        &self,
        q: &[f64],
        v: &[f64],
        scratch: &mut Scratch,
        see: impl FnOnce(&mut Workspace<D>, Regime) -> R,
    ) -> R {
        self.with_workspace(q, scratch, |work, regime| {
            self.place_once(q, v, work);
            see(work, regime)
        })
    }

    /// Calls `see` with a view of the state.
    fn viewed<R>(&self, at: OperatingPoint, scratch: &mut Scratch, see: impl FnOnce(&Plain<D>) -> R) -> R {
        self.with_workspace(at.q, scratch, |_, regime| see(&Plain { model: &self.model, at, regime }))
    }

    /// Calls `see` with the workspace as it was left.
    fn with_workspace<R>(
        &self,
        q: &[f64],
        scratch: &mut Scratch,
        see: impl FnOnce(&mut Workspace<D>, Regime) -> R,
    ) -> R {
        let make = || Workspace::new(self.model());
        scratch.with(make, |work, regime| see(work, regime.turned(self.turned(q))))
    }

    /// Evaluates all frames at (q, v) and v' = 0, unless they are known.
    fn place_once(&self, q: &[f64], v: &[f64], work: &mut Workspace<D>) {
        if !work.is_at(q, v) {
            self.place(q, v, &[], work);
        }
    }

    /// Evaluates all frames at (q, v), with the accelerations `vdot` or, where it is empty, those at v' = 0.
    pub(super) fn place(&self, q: &[f64], v: &[f64], vdot: &[f64], work: &mut Workspace<D>) {
        work.motion.resize(self.model.marker_count(), Frame::world());
        for part in &self.model.bodies {
            place_body(part, (q, v, vdot), &mut work.motion[part.first_marker..]);
        }
        work.remember(if vdot.is_empty() { [q, v] } else { [&[]; 2] });
    }

    /// A joint with its rows.
    pub(super) fn placed_joint(&self, joint: usize) -> PlacedJoint<'_, D> {
        PlacedJoint {
            mechanism: self,
            joint: &self.model.joints[joint],
            lock: self.rigid.locks[joint].as_ref(),
            rows: &self.joints[joint],
        }
    }

    pub(super) fn placed_joints(&self) -> impl Iterator<Item = PlacedJoint<'_, D>> {
        (0..self.joints.len()).map(|joint| self.placed_joint(joint))
    }
}

/// Evaluates the frames of the markers of a body, the first of `motion`.
pub(super) fn place_body<const D: usize>(
    part: &Part<D>,
    (q, v, vdot): (&[f64], &[f64], &[f64]),
    motion: &mut [Frame<Taylor<f64>, D>],
) {
    let frames = &mut motion[..part.body.markers().len()];
    let vdot = (!vdot.is_empty()).then(|| of(vdot, part, false));
    part.body.motion(of(q, part, true), of(v, part, false), vdot, 0, frames);
}

/// The coordinates (`coordinates`) or else the velocities of one body.
pub(super) fn of<'a, const D: usize>(all: &'a [f64], part: &Part<D>, coordinates: bool) -> &'a [f64] {
    if coordinates { &all[part.first_q..part.first_q + part.nq] } else { &all[part.first_v..part.first_v + part.nv] }
}

pub(super) fn with_frames<R, const D: usize>(
    all: &[Frame<Taylor<f64>, D>],
    markers: &[usize],
    see: impl FnOnce(&[Frame<Taylor<f64>, D>]) -> R,
) -> R {
    gathered(markers, |marker| all[marker], see)
}

impl<const D: usize> MechanicalSystem for Mechanism<D> {
    fn dimensions(&self) -> Dimensions {
        self.dimensions
    }

    fn facts(&self) -> Cow<'_, SystemFacts> {
        Cow::Borrowed(&self.facts)
    }

    fn switches(&self) -> SwitchFacts<'_> {
        let Switches { all, owners, time_functions, .. } = &self.model.switches;
        SwitchFacts { all, owners, time_functions }
    }

    fn structure(&self) -> Structure {
        self.structure.clone()
    }

    fn rate(&self, q: &[f64], v: &[f64], qdot: &mut [f64]) {
        self.write_rates(q, v, qdot);
        self.turning_rates(q, v, qdot);
    }

    fn evaluate(&self, t: f64, q: &[f64], v: &[f64], need: Need, terms: &mut Terms, scratch: &mut Scratch) {
        self.with_workspace(q, scratch, |work, regime| {
            self.write_terms(Time { t, regime }, (q, v), need, work, terms);
            if need.includes(Need::L) {
                self.place_once(q, v, work);
                let (Workspace { motion, varied, .. }, at) = (work, OperatingPoint { t, q, v, vdot: &[], lambda: &[] });
                let mut write = |place: usize, slope: Taylor<f64>| terms.l[place] = slope.d;
                self.placed_joints().for_each(|joint| joint.curvature((&at, regime), motion, varied, &mut write));
            }
        });
    }

    fn tangent(&self, at: OperatingPoint, tangent: &mut Tangent, scratch: &mut Scratch) -> bool {
        self.at(at.q, at.v, scratch, |work, regime| Evaluation { mechanism: self, at, regime, work, tangent }.run());
        true
    }

    fn acceleration_gradient(&self, at: OperatingPoint, values: &mut [f64], scratch: &mut Scratch) -> bool {
        self.at(at.q, at.v, scratch, |work, regime| {
            self.place(at.q, at.v, at.vdot, work);
            let Workspace { motion, varied, .. } = work;
            let mut write = |place: usize, slope: Taylor<f64>| values[place] = slope.dd;
            self.placed_joints().for_each(|joint| joint.curvature((&at, regime), motion, varied, &mut write));
        });
        true
    }

    fn bracket(&self, v: &[f64], x: &[f64], out: &mut [f64]) {
        out.fill(0.0);
        for &Rotation { v: first, .. } in &self.facts.rotations {
            let three = |all: &[f64]| -> [f64; 3] { from_fn(|i| all[first + i]) };
            out[first..][..3].copy_from_slice(&cross(&three(v), &three(x)));
        }
    }

    fn levi_civita(&self, at: OperatingPoint, connection: &mut LeviCivita, _scratch: &mut Scratch) -> bool {
        let is_constant = self.model.bodies.iter().all(|part| part.facts.has_constant_mass);
        if is_constant {
            connection.clear();
            for part in &self.model.bodies {
                connection.add_constant_mass(part, &at);
            }
        }
        is_constant
    }

    fn prescribed_spin(&self, t: f64) -> Option<Spin> {
        self.driven_spin(t)
    }

    fn normalize(&self, q: &mut [f64]) {
        for part in &self.model.bodies {
            part.body.normalize(&mut q[part.first_q..part.first_q + part.nq]);
        }
        self.continue_turnings(q);
    }

    fn energy(&self, t: f64, q: &[f64], v: &[f64], scratch: &mut Scratch) -> Option<Energy> {
        let at = OperatingPoint { t, q, v, vdot: &[], lambda: &[] };
        Some(self.viewed(at, scratch, |view| self.energies(view)))
    }

    fn prescribed(&self, t: f64) -> Vec<Prescribed> {
        prescribed(&self.model, &self.joints, t)
    }

    fn outputs(&self, at: OperatingPoint, out: &mut [f64], scratch: &mut Scratch) {
        self.viewed(self.felt(at), scratch, |view| self.write_outputs(view, out));
    }

    fn output_tangent(&self, at: OperatingPoint, tangent: &mut OutputTangent, scratch: &mut Scratch) -> bool {
        self.observed(at, scratch, |at, regime, work| Slopes { mechanism: self, at, regime, work, tangent }.run());
        true
    }

    fn input_forces(&self, t: f64, q: &[f64], v: &[f64], f: &mut DMatrix<f64>, scratch: &mut Scratch) {
        self.at(q, v, scratch, |work, regime| self.write_input_forces(0, (Time { t, regime }, q), work, f));
    }

    fn input_rate_forces(&self, t: f64, q: &[f64], v: &[f64], f: &mut DMatrix<f64>, scratch: &mut Scratch) {
        self.at(q, v, scratch, |work, regime| self.write_input_forces(1, (Time { t, regime }, q), work, f));
    }

    fn input_values(&self, at: OperatingPoint, out: &mut [f64], scratch: &mut Scratch) {
        self.viewed(OperatingPoint { vdot: &[], ..at }, scratch, |view| self.write_input_values(view, out));
    }

    fn feeds(&self, t: f64, q: &[f64], v: &[f64], scratch: &mut Scratch) -> Vec<Feed> {
        let at = OperatingPoint { t, q, v, vdot: &[], lambda: &[] };
        self.viewed(at, scratch, |view| self.list_feeds(view))
    }

    fn write_gaps(&self, q: &[f64], out: &mut [[f64; 3]]) {
        self.gap_lines().zip(out).for_each(|((_, markers), out)| self.write_gap(markers, q, out));
    }

    fn roads(&self, t: f64, q: &[f64], v: &[f64], scratch: &mut Scratch) -> Vec<Road> {
        if !self.has_roads() {
            return Vec::new();
        }
        self.at(q, v, scratch, |work, regime| self.find_roads(Time { t, regime }, work))
    }

    fn switching(&self, at: OperatingPoint, out: &mut [Rate], scratch: &mut Scratch) {
        self.at(at.q, at.v, scratch, |work, regime| self.write_arguments(at, regime, work, out));
    }

    fn deformations(&self, q: &[f64], out: &mut [f64]) {
        out.iter_mut().zip(&self.extents).for_each(|(out, extent)| *out = self.deformation(extent, q));
    }

    fn spins(&self, q: &[f64], v: &[f64], out: &mut [f64]) {
        self.write_spins(q, v, out);
    }
}
