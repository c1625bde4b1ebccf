//! The equations of a scene's model.

use super::coupling::{Carrier, Couplings};
use super::dependence::carriers;
use super::evaluate::{EvaluationMemory, EvaluationPlan, Evaluator};
use super::input::{write_input_forces, write_input_values};
use super::layout::Layout;
use super::levi_civita::LeviCivita;
use super::limits::{Extent, limits};
use super::model_facts::facts_of;
use super::output::{energies, felt, write_outputs};
use super::output_tangent::{OutputSlopes, OutputTangent};
use super::placed_joint::PlacedJoint;
use super::rows::prescribed;
use super::spin::{Rotation, Spin};
use super::spinning::driven_spin;
use super::switching::{find_roads, has_roads, list_feeds, write_arguments, write_gaps};
use super::tangent::Tangents;
use super::turnings::{continue_turnings, turning_rates, write_spins};
use super::variation::SeededBody;
use super::view::Plain;
use super::{
    Dimensions, Energy, Feed, MechanicalSystem, Need, OperatingPoint, Prescribed, Road, Scratch, Structure,
    SwitchFacts, SystemFacts, Tangent, Terms,
};
use crate::body::{Frame, Switches, cross};
use crate::math::array::from_fn;
use crate::math::kkt::Pattern;
use crate::math::{Rate, Regime, Taylor, Time};
use crate::scene::Model;
use nalgebra::DMatrix;
use std::borrow::Cow;
use std::ops::Range;
use std::sync::OnceLock;

/// A model with the places of its coordinates, rows and matrix entries fixed.
pub struct Mechanism<const D: usize> {
    layout: Layout<D>,
    dimensions: Dimensions,
    structure: Structure,
    facts: SystemFacts,
    plan: EvaluationPlan<D>,
    couplings: Couplings,
    extents: Vec<Extent<D>>,
    /// The bodies that each output reads, once derivatives of outputs are asked for.
    carriers: OnceLock<Vec<Vec<Carrier>>>,
}

/// Memory that a mechanism keeps between evaluations.
struct MechanismMemory<const D: usize> {
    evaluation: EvaluationMemory<D>,
    varied: SeededBody<D>,
    /// Values of the inputs; empty where all are zero.
    inputs: Vec<f64>,
}

impl<const D: usize> Mechanism<D> {
    /// Assigns rows of phi and entries of M, G, K and C to the parts of a model.
    pub fn new(model: Model<D>) -> Self {
        let (layout, mass, g) = Layout::new(model);
        let model = &layout.model;
        let turning_angles = model.turnings.len();
        let q = model.bodies.last().map_or(0, |part| part.first_q + part.nq) + turning_angles;
        let dimensions =
            Dimensions { q, v: g.cols, lambda: g.rows, nonholonomic: 0, states: model.states, turning_angles };
        let plan = EvaluationPlan::new(&layout);
        let mut tangent = Pattern { rows: g.cols, cols: g.cols, entries: Vec::new() };
        let couplings = Couplings::new(&layout, &mut tangent);
        let structure = Structure { analysis: plan.analysis(), ..Structure::new(mass, g, tangent) };
        let (limited, extents) = limits(model);
        let facts = facts_of(&layout, limited);
        Mechanism { layout, dimensions, structure, facts, plan, couplings, extents, carriers: OnceLock::new() }
    }

    /// The model that the equations belong to.
    pub fn model(&self) -> &Model<D> {
        &self.layout.model
    }

    /// Range of the rows of phi of joint `joint`.
    pub fn rows_of_joint(&self, joint: usize) -> Range<usize> {
        self.layout.rows_of_joint(joint)
    }

    /// The turning angles in q.
    #[inline]
    pub fn turned<'q>(&self, q: &'q [f64]) -> &'q [f64] {
        &q[q.len() - self.dimensions.turning_angles..]
    }

    /// Frames of all markers at (q, v), in the world, with their velocities.
    pub fn frames(&self, q: &[f64], v: &[f64], scratch: &mut Scratch) -> Vec<Frame<Taylor<f64>, D>> {
        self.placed(unaccelerated(0.0, q, v), scratch, |memory, _| memory.evaluation.frames.motion.clone())
    }

    /// Calls `see` with the memory as it was left.
    fn with_memory<R>(
        &self,
        q: &[f64],
        scratch: &mut Scratch,
        see: impl FnOnce(&mut MechanismMemory<D>, Regime) -> R,
    ) -> R {
        #[cfg(feature = "python")]
        crate::abandoned::leave();
        let make = || MechanismMemory {
            evaluation: EvaluationMemory::new(self.model()),
            varied: SeededBody::default(),
            inputs: Vec::new(),
        };
        let inputs = std::mem::take(&mut scratch.inputs);
        let seen = scratch.with(make, |memory, regime| {
            memory.inputs.clone_from(&inputs);
            see(memory, regime.turned(self.turned(q)))
        });
        scratch.inputs = inputs;
        seen
    }

    /// Calls `see` with the memory, whose frames are evaluated at a state with its v' or, where that is empty, v' = 0.
    fn placed<R>(
        &self,
        at: OperatingPoint,
        scratch: &mut Scratch,
        see: impl FnOnce(&mut MechanismMemory<D>, Regime) -> R,
    ) -> R {
        self.with_memory(at.q, scratch, |memory, regime| {
            memory.evaluation.frames.place(self.model(), &at);
            see(memory, regime)
        })
    }

    /// Calls `see` with a view of the state.
    fn viewed<R>(&self, at: OperatingPoint, scratch: &mut Scratch, see: impl FnOnce(&Plain<D>) -> R) -> R {
        self.with_memory(at.q, scratch, |memory, regime| {
            see(&Plain { model: self.model(), at, regime, inputs: &memory.inputs })
        })
    }

    /// Writes d(phi, phi', phi'')/dq of all joints, by the places of G.
    fn curvature(
        &self,
        at: &OperatingPoint,
        regime: Regime,
        memory: &mut MechanismMemory<D>,
        mut write: impl FnMut(usize, Taylor<f64>),
    ) {
        let MechanismMemory { evaluation, varied, .. } = memory;
        for joint in PlacedJoint::all(&self.layout) {
            joint.curvature(at, regime, &evaluation.frames.motion, varied, &mut write);
        }
    }
}

/// A state with v' = 0, without multipliers.
fn unaccelerated<'a>(t: f64, q: &'a [f64], v: &'a [f64]) -> OperatingPoint<'a> {
    OperatingPoint { t, q, v, vdot: &[], lambda: &[] }
}

impl<const D: usize> MechanicalSystem for Mechanism<D> {
    fn dimensions(&self) -> Dimensions {
        self.dimensions
    }

    fn facts(&self) -> Cow<'_, SystemFacts> {
        Cow::Borrowed(&self.facts)
    }

    fn switches(&self) -> SwitchFacts<'_> {
        let Switches { all, owners, time_functions, .. } = &self.model().switches;
        SwitchFacts { all, owners, time_functions }
    }

    fn structure(&self) -> Structure {
        self.structure.clone()
    }

    fn rate(&self, q: &[f64], v: &[f64], qdot: &mut [f64]) {
        self.plan.write_rates(self.model(), q, v, qdot);
        turning_rates(self.model(), q, v, qdot);
    }

    fn evaluate(&self, t: f64, q: &[f64], v: &[f64], need: Need, terms: &mut Terms, scratch: &mut Scratch) {
        self.with_memory(q, scratch, |memory, regime| {
            let Mechanism { layout, plan, .. } = self;
            let MechanismMemory { evaluation, inputs, .. } = &mut *memory;
            let evaluator = Evaluator { layout, plan, time: Time { t, regime }, q, v, inputs, need };
            evaluator.write_terms(evaluation, terms);
            if need.includes(Need::L) {
                let at = unaccelerated(t, q, v);
                memory.evaluation.frames.place(self.model(), &at);
                self.curvature(&at, regime, memory, |place, slope| terms.l[place] = slope.d);
            }
        });
    }

    fn tangent(&self, at: OperatingPoint, tangent: &mut Tangent, scratch: &mut Scratch) -> bool {
        self.placed(OperatingPoint { vdot: &[], ..at }, scratch, |memory, regime| {
            let MechanismMemory { evaluation, varied, inputs } = memory;
            let Mechanism { layout, couplings, .. } = self;
            let motion = &evaluation.frames.motion;
            Tangents { layout, couplings, at, regime, motion, varied, inputs, tangent }.run();
        });
        true
    }

    fn acceleration_gradient(&self, at: OperatingPoint, values: &mut [f64], scratch: &mut Scratch) -> bool {
        self.placed(at, scratch, |memory, regime| {
            self.curvature(&at, regime, memory, |place, slope| values[place] = slope.dd);
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
        let is_constant = self.model().bodies.iter().all(|part| part.facts.has_constant_mass);
        if is_constant {
            connection.clear();
            for part in &self.model().bodies {
                connection.add_constant_mass(part, &at);
            }
        }
        is_constant
    }

    fn prescribed_spin(&self, t: f64) -> Option<Spin> {
        driven_spin(self.model(), t)
    }

    fn normalize(&self, q: &mut [f64]) {
        for part in &self.model().bodies {
            part.body.normalize(&mut q[part.first_q..part.first_q + part.nq]);
        }
        continue_turnings(self.model(), q);
    }

    fn energy(&self, t: f64, q: &[f64], v: &[f64], scratch: &mut Scratch) -> Option<Energy> {
        Some(self.viewed(unaccelerated(t, q, v), scratch, |view| energies(view.model, view)))
    }

    fn outputs(&self, at: OperatingPoint, out: &mut [f64], scratch: &mut Scratch) {
        let unread = std::mem::take(&mut scratch.unread);
        self.viewed(felt(self.model(), at), scratch, |view| write_outputs(&self.layout, view, &unread, out));
        scratch.unread = unread;
    }

    fn output_tangent(&self, at: OperatingPoint, tangent: &mut OutputTangent, scratch: &mut Scratch) -> bool {
        let at = felt(self.model(), at);
        let read = |output: &crate::scene::ModelOutput| carriers(&self.layout, &output.measure);
        let carriers = self.carriers.get_or_init(|| self.model().outputs.iter().map(read).collect());
        self.placed(at, scratch, |MechanismMemory { evaluation, varied, .. }, regime| {
            let Mechanism { layout, couplings, .. } = self;
            OutputSlopes {
                layout,
                couplings,
                carriers,
                at,
                regime,
                motion: &evaluation.frames.motion,
                varied,
                tangent,
            }
            .run();
        });
        true
    }

    fn input_forces(&self, t: f64, q: &[f64], v: &[f64], f: &mut DMatrix<f64>, scratch: &mut Scratch) {
        self.placed(unaccelerated(t, q, v), scratch, |memory, regime| {
            write_input_forces(&self.layout, 0, Time { t, regime }, q, &memory.evaluation.frames.motion, f);
        });
    }

    fn input_rate_forces(&self, t: f64, q: &[f64], v: &[f64], f: &mut DMatrix<f64>, scratch: &mut Scratch) {
        self.placed(unaccelerated(t, q, v), scratch, |memory, regime| {
            write_input_forces(&self.layout, 1, Time { t, regime }, q, &memory.evaluation.frames.motion, f);
        });
    }

    fn input_values(&self, at: OperatingPoint, out: &mut [f64], scratch: &mut Scratch) {
        self.viewed(OperatingPoint { vdot: &[], ..at }, scratch, |view| write_input_values(view, out));
    }

    fn switching(&self, at: OperatingPoint, out: &mut [Rate], scratch: &mut Scratch) {
        self.placed(at, scratch, |memory, regime| {
            let MechanismMemory { evaluation, inputs, .. } = memory;
            let time = Time { t: Rate::seeded(at.t, 0), regime };
            write_arguments(&self.layout, time, &evaluation.frames.motion, inputs, out);
        });
    }

    fn feeds(&self, t: f64, q: &[f64], v: &[f64], scratch: &mut Scratch) -> Vec<Feed> {
        self.viewed(unaccelerated(t, q, v), scratch, list_feeds)
    }

    fn roads(&self, t: f64, q: &[f64], v: &[f64], scratch: &mut Scratch) -> Vec<Road> {
        if !has_roads(self.model()) {
            return Vec::new();
        }
        self.placed(unaccelerated(t, q, v), scratch, |memory, regime| {
            find_roads(self.model(), Time { t, regime }, &memory.evaluation.frames.motion)
        })
    }

    fn write_gaps(&self, q: &[f64], out: &mut [[f64; 3]]) {
        write_gaps(self.model(), q, out);
    }

    fn deformations(&self, q: &[f64], out: &mut [f64]) {
        let extents = self.extents.iter();
        extents.zip(out).for_each(|(extent, out)| *out = extent.deformation(self.model(), q));
    }

    fn spins(&self, q: &[f64], v: &[f64], out: &mut [f64]) {
        write_spins(self.model(), q, v, out);
    }

    fn prescribed(&self, t: f64) -> Vec<Prescribed> {
        prescribed(self.model(), &self.layout.joints, t)
    }
}
