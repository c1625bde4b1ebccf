//! The equations of a scene's model.

use super::coupling::Couplings;
use super::evaluate::RigidParts;
use super::levi_civita::LeviCivita;
use super::limits::{Extent, limits};
use super::output::column;
use super::output_tangent::{OutputTangent, Slopes};
use super::rows::{JointRows, PlacedJoint, groups, prescribed};
use super::scale::{length_scale, named_lengths, row_scales};
use super::spin::{Placement, Rotation, Spin};
use super::support::Support;
use super::tangent::{Evaluation, OperatingPoint, Tangent};
use super::view::{Plain, gathered};
use super::workspace::Workspace;
use super::{
    Column, Dimensions, Energy, Excitation, Feed, Group, Limited, MechanicalSystem, Names, Need, Prescribed, Road,
    Scratch, Structure, Terms,
};
use crate::body::{Frame, cross};
use crate::math::array::from_fn;
use crate::math::expression::{Switch, TimeFunction};
use crate::math::kkt::Pattern;
use crate::math::{Rate, Regime, Taylor, Time};
use crate::scene::{Input, Model, Part};
use nalgebra::DMatrix;
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
    pub(super) length: f64,
    limited: Vec<Limited>,
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
            let places = part.body.mass_pattern().into_iter();
            mass.entries.extend(places.map(|(i, j)| (part.first_v + i, part.first_v + j)));
            masses.push(first..mass.entries.len());
        }
        let mut g = Pattern { rows: 0, cols: v, entries: Vec::new() };
        let supports: Vec<Support> = (0..model.marker_count()).map(|marker| Support::of(&model, marker)).collect();
        let joints: Vec<JointRows> =
            model.joints.iter().map(|joint| JointRows::new(&supports, joint, &mut g)).collect();
        let rigid = RigidParts::new(&model, &joints, &masses);
        let dimensions =
            Dimensions { q: q + model.turnings.len(), v, lambda: g.rows, nonholonomic: 0, states: model.states };
        let length = length_scale(&model);
        let mut tangent = Pattern { rows: v, cols: v, entries: Vec::new() };
        let couplings = Couplings::new(&model, &supports, &rigid, &mut tangent);
        let structure = Structure { analysis: rigid.analysis(), ..Structure::new(mass, g, tangent) };
        let (limited, extents) = limits(&model);
        Mechanism { model, dimensions, structure, joints, couplings, masses, rigid, supports, length, limited, extents }
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
        self.with_workspace(at.q, scratch, |work, regime| {
            see(&Plain { model: &self.model, at, regime, inputs: &work.inputs })
        })
    }

    /// Calls `see` with the workspace as it was left.
    fn with_workspace<R>(
        &self,
        q: &[f64],
        scratch: &mut Scratch,
        see: impl FnOnce(&mut Workspace<D>, Regime) -> R,
    ) -> R {
        let make = || Workspace::new(self.model());
        let inputs = std::mem::take(&mut scratch.inputs);
        let seen = scratch.with(make, |work, regime| {
            work.inputs.clone_from(&inputs);
            see(work, regime.turned(self.turned(q)))
        });
        scratch.inputs = inputs;
        seen
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
    let frames = &mut motion[..part.body.marker_count()];
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

    fn structure(&self) -> Structure {
        self.structure.clone()
    }

    fn names(&self) -> Names {
        self.list_names()
    }

    fn turning_angles(&self) -> usize {
        self.model.turnings.len()
    }

    fn rate(&self, q: &[f64], v: &[f64], qdot: &mut [f64]) {
        self.own_rate(q, v, qdot);
        self.turning_rates(q, v, qdot);
    }

    fn own_rate(&self, q: &[f64], v: &[f64], qdot: &mut [f64]) {
        self.write_rates(q, v, qdot);
    }

    fn rotations(&self) -> Vec<Rotation> {
        self.quaternions().collect()
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
        for Rotation { v: first, .. } in self.quaternions() {
            let three = |all: &[f64]| -> [f64; 3] { from_fn(|i| all[first + i]) };
            out[first..][..3].copy_from_slice(&cross(&three(v), &three(x)));
        }
    }

    fn levi_civita(&self, at: OperatingPoint, connection: &mut LeviCivita, _scratch: &mut Scratch) -> bool {
        let is_constant = self.model.bodies.iter().all(|part| part.body.has_constant_mass());
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

    fn placements(&self) -> Option<Vec<Placement>> {
        self.placed_coordinates()
    }

    fn add_stiffness(&self, mass: &mut [f64]) {
        for (part, places) in self.model.bodies.iter().zip(&self.masses) {
            part.body.add_stiffness(&mut mass[places.clone()]);
        }
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

    fn columns(&self) -> Vec<Column> {
        self.model.outputs.iter().map(column).collect()
    }

    fn works(&self) -> Vec<Column> {
        self.model.works.iter().map(column).collect()
    }

    fn groups(&self) -> Vec<Group> {
        groups(&self.model, &self.joints)
    }

    fn lengths(&self) -> Vec<(String, f64)> {
        named_lengths(&self.model)
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

    fn inputs(&self) -> Vec<Column> {
        let column = |input: &Input| Column { name: input.name.clone(), unit: input.unit.to_string() };
        self.model.inputs.iter().map(column).collect()
    }

    fn input_forces(&self, t: f64, q: &[f64], v: &[f64], f: &mut DMatrix<f64>, scratch: &mut Scratch) {
        self.at(q, v, scratch, |work, regime| self.write_input_forces(0, (Time { t, regime }, q), work, f));
    }

    fn input_rate_forces(&self, t: f64, q: &[f64], v: &[f64], f: &mut DMatrix<f64>, scratch: &mut Scratch) {
        self.at(q, v, scratch, |work, regime| self.write_input_forces(1, (Time { t, regime }, q), work, f));
    }

    fn excitations(&self) -> Vec<Excitation> {
        self.model.inputs.iter().map(|input| self.excitation(input.target)).collect()
    }

    fn input_values(&self, at: OperatingPoint, out: &mut [f64], scratch: &mut Scratch) {
        self.viewed(OperatingPoint { vdot: &[], ..at }, scratch, |view| self.write_input_values(view, out));
    }

    fn switches(&self) -> &[Switch] {
        &self.model.switches.all
    }

    fn owner_of_switch(&self, switch: usize) -> &str {
        self.model.switches.owners.get(switch).map_or("", String::as_str)
    }

    fn infinite_force(&self, t: f64, q: &[f64], v: &[f64], scratch: &mut Scratch) -> Option<String> {
        let at = OperatingPoint { t, q, v, vdot: &[], lambda: &[] };
        self.viewed(at, scratch, |view| self.find_infinite_force(view))
    }

    fn feeds(&self, t: f64, q: &[f64], v: &[f64], scratch: &mut Scratch) -> Vec<Feed> {
        let at = OperatingPoint { t, q, v, vdot: &[], lambda: &[] };
        self.viewed(at, scratch, |view| self.list_feeds(view))
    }

    fn gaps(&self) -> Vec<usize> {
        self.gap_lines().map(|(number, _)| number).collect()
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

    fn time_functions(&self) -> &[TimeFunction] {
        &self.model.switches.time_functions
    }

    fn switching(&self, at: OperatingPoint, out: &mut [Rate], scratch: &mut Scratch) {
        self.at(at.q, at.v, scratch, |work, regime| self.write_arguments(at, regime, work, out));
    }

    fn limited(&self) -> &[Limited] {
        &self.limited
    }

    fn deformations(&self, q: &[f64], out: &mut [f64]) {
        out.iter_mut().zip(&self.extents).for_each(|(out, extent)| *out = self.deformation(extent, q));
    }

    fn turning_bodies(&self) -> Vec<String> {
        self.oriented_bodies().map(|part| part.name.clone()).collect()
    }

    fn spins(&self, q: &[f64], v: &[f64], out: &mut [f64]) {
        self.write_spins(q, v, out);
    }

    fn length(&self) -> f64 {
        self.length
    }

    fn scales(&self) -> Vec<f64> {
        row_scales(&self.model, self.length)
    }
}
