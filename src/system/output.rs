//! Outputs of a scene, written once over any scalar, so that values and derivatives agree.

use super::Scratch;
use super::locked::row_gradient;
use super::mechanism::Mechanism;
use super::tangent::OperatingPoint;
use super::view::{Plain, View, gathered};
use super::workspace::Workspace;
use crate::body::{Energy, Frame, MOST_MARKERS, Probe, Quantity, Wrench, norm, twist_len};
use crate::force::{Action, Force, ForceOver};
use crate::joint::{Joint, JointOver, MOST_ROWS, markers_per_pass};
use crate::math::array::Each;
use crate::math::{Regime, Scalar, Taylor};
use crate::scene::{FORCE_SIZE, Measure, TORQUE_SIZE};

impl<const D: usize> Mechanism<D> {
    /// Returns the state with its v' only where an output reads accelerations.
    pub(super) fn felt<'a>(&self, at: OperatingPoint<'a>) -> OperatingPoint<'a> {
        let is_accelerated = self.model().outputs.iter().any(|output| output.measure.feels_acceleration());
        OperatingPoint { vdot: if is_accelerated { at.vdot } else { &[] }, ..at }
    }

    /// Calls `see` with the workspace evaluated at a state as outputs feel it.
    pub(super) fn observed<R>(
        &self,
        at: OperatingPoint,
        scratch: &mut Scratch,
        see: impl FnOnce(OperatingPoint, Regime, &mut Workspace<D>) -> R,
    ) -> R {
        let at = self.felt(at);
        self.at(at.q, at.v, scratch, |work, regime| {
            if !at.vdot.is_empty() {
                self.place(at.q, at.v, at.vdot, work);
            }
            see(at, regime, work)
        })
    }

    /// All outputs in the order of the scene.
    pub(super) fn write_outputs(&self, view: &Plain<D>, out: &mut [f64]) {
        let mut energies = None;
        let mut section = None;
        for (out, output) in out.iter_mut().zip(&self.model().outputs) {
            let value = match output.measure {
                Measure::Energy(part) => part.of(*energies.get_or_insert_with(|| self.energies(view))),
                // Outputs of one section are mostly consecutive.
                Measure::Section { cut, component } => {
                    let known = section.filter(|(known, _)| *known == cut);
                    let (_, forces) = known.unwrap_or_else(|| (cut, self.section(&self.model().cuts[cut], view)));
                    section = Some((cut, forces));
                    forces[component]
                }
                ref measure => self.read(measure, view),
            };
            *out = value * output.unit.per_si;
        }
    }

    /// Value of an output, in SI units.
    pub(super) fn read<S: Scalar>(&self, measure: &Measure, view: &impl View<S, D>) -> S
    where
        dyn Force<D>: ForceOver<S, D>,
        dyn Joint<D>: JointOver<S, D>,
    {
        let model = self.model();
        match measure {
            Measure::Formula(formula) => {
                formula.evaluate(view.time().map(S::constant), |probe| self.probe(probe, view))
            }
            Measure::Probe(probe) => self.probe(probe, view),
            Measure::Reaction { joint, slot, component, axes } => {
                let wrench = Wrench::from_twist_order(&self.reaction_wrench(view, *joint, *slot));
                component_of(&wrench, *component, &view.frame(*axes))
            }
            Measure::Load { force, slot, component, axes } => {
                let mut wrenches = [Wrench::zero(); MOST_MARKERS];
                self.act(*force, view, &mut wrenches);
                component_of(&wrenches[*slot], *component, &view.frame(*axes))
            }
            Measure::Power { force } => self.power(*force, view),
            Measure::DrivePower { joint } => self.drive_power(*joint, view),
            // phi is coordinate - value: -G^T lambda acts on the second body along the growing coordinate.
            Measure::Push { joint } => -view.lambda(self.rows_of_joint(*joint).start),
            // phi is l - length: -G^T lambda pulls the second body towards the first.
            Measure::Multiplier { joint } => view.lambda(self.rows_of_joint(*joint).start),
            Measure::Elastic(combination) => combination.at(|coordinate| view.q(coordinate)),
            Measure::Station(place) => place.read(&model.gravity, |marker| view.frame(marker)),
            Measure::Section { cut, component } => self.section(&model.cuts[*cut], view)[*component],
            Measure::Force(force) => self.action(*force, view).magnitude,
            Measure::Energy(part) => part.of(self.energies(view)),
        }
    }

    fn probe<S: Scalar>(&self, probe: &Probe, view: &impl View<S, D>) -> S
    where
        dyn Force<D>: ForceOver<S, D>,
        dyn Joint<D>: JointOver<S, D>,
    {
        if let Quantity::Output(number) = probe.quantity {
            return self.read(&self.model().outputs[number].measure, view);
        }
        probe.read(view.time().regime, |marker| view.frame(marker))
    }

    /// Kinetic and potential energy of the whole mechanism.
    pub(super) fn energies<S: Scalar>(&self, view: &impl View<S, D>) -> Energy<S>
    where
        dyn Force<D>: ForceOver<S, D>,
    {
        let model = self.model();
        let mut total = Energy { kinetic: S::zero(), potential: S::zero() };
        for part in &model.bodies {
            let own = view.energy(part, &model.gravity);
            total.kinetic += own.kinetic;
            total.potential += own.potential;
        }
        (0..model.forces.len()).for_each(|force| total.potential += self.action(force, view).potential.x);
        total
    }

    /// Magnitude, potential and other scalars of a force.
    pub(super) fn action<S: Scalar>(&self, force: usize, view: &impl View<S, D>) -> Action<S>
    where
        dyn Force<D>: ForceOver<S, D>,
    {
        self.act(force, view, &mut [Wrench::zero(); MOST_MARKERS])
    }

    /// The scalars of a force, and its wrenches, which must be zero on entry.
    pub(super) fn act<S: Scalar>(
        &self,
        force: usize,
        view: &impl View<S, D>,
        wrenches: &mut [Wrench<S, D>; MOST_MARKERS],
    ) -> Action<S>
    where
        dyn Force<D>: ForceOver<S, D>,
    {
        let input = view.input(force);
        let force = &self.model().forces[force];
        let wrenches = &mut wrenches[..force.markers.len()];
        let element = force.element.as_ref();
        let time = view.time().map(Taylor::time);
        let act = |frames: &[_]| ForceOver::<S, D>::driven(element, &input, frames, time, wrenches);
        gathered(&force.markers, |marker| view.frame(marker), act)
    }

    /// -G^T lambda at one of a joint's markers, in the order of a twist.
    pub(super) fn reaction_wrench<S: Scalar>(&self, view: &impl View<S, D>, joint: usize, slot: usize) -> [S; 6]
    where
        dyn Joint<D>: JointOver<S, D>,
    {
        let rows = self.rows_of_joint(joint);
        let (joint, lock) = (&self.model().joints[joint], &self.rigid.locks[joint]);
        let mut wrench = [S::zero(); 6];
        if let Some(lock) = lock {
            let frames = [0, 1].each(|slot| view.frame(joint.markers[slot]).map(|x| x.x));
            let both = [&frames[0], &frames[1]];
            let own = (slot, &frames[slot].r);
            for (row, multiplier) in rows.enumerate() {
                let gradient = row_gradient(lock, both, own, row);
                let lambda = view.lambda(multiplier);
                let torque = &gradient.torque[if D == 2 { 2 } else { 0 }..];
                let entries = gradient.force.iter().chain(torque);
                wrench.iter_mut().zip(entries).for_each(|(sum, &entry)| *sum -= lambda * entry);
            }
            return wrench;
        }
        let mut slopes = [[S::zero(); 6]; MOST_ROWS];
        let own = &mut slopes[..rows.len()];
        let element = joint.element.as_ref();
        let time = view.time().map(S::constant);
        let pass = slot / markers_per_pass(D);
        let gradient = |frames: &[_]| JointOver::<S, D>::gradient(element, frames, time, pass, own);
        gathered(&joint.markers, |marker| view.frame(marker), gradient);
        let first = slot % markers_per_pass(D) * twist_len(D);
        for (slope, row) in slopes.iter().zip(rows) {
            let lambda = view.lambda(row);
            let own = wrench.iter_mut().zip(&slope[first..]).take(twist_len(D));
            own.for_each(|(sum, &entry)| *sum -= lambda * entry);
        }
        wrench
    }

    /// Power of a force on all its bodies.
    fn power<S: Scalar>(&self, force: usize, view: &impl View<S, D>) -> S
    where
        dyn Force<D>: ForceOver<S, D>,
    {
        let mut wrenches = [Wrench::zero(); MOST_MARKERS];
        self.act(force, view, &mut wrenches);
        let markers = self.model().forces[force].markers.iter();
        markers.zip(&wrenches).fold(S::zero(), |sum, (&marker, wrench)| sum + wrench.power(&view.frame(marker)))
    }

    /// -lambda . G v of a joint, G v being the rate of phi with t held.
    fn drive_power<S: Scalar>(&self, joint: usize, view: &impl View<S, D>) -> S
    where
        dyn Joint<D>: JointOver<S, D>,
    {
        let rows = self.rows_of_joint(joint);
        let joint = &self.model().joints[joint];
        let mut levels = [Taylor::fixed(S::zero()); MOST_ROWS];
        let levels = &mut levels[..rows.len()];
        let element = joint.element.as_ref();
        let time = view.time().map(|t| Taylor::fixed(S::constant(t)));
        let rates = |frames: &[_]| JointOver::<S, D>::levels(element, frames, time, levels);
        gathered(&joint.markers, |marker| view.frame(marker), rates);
        rows.zip(levels).fold(S::zero(), |sum, (row, level)| sum - view.lambda(row) * level.d)
    }
}

/// A component of a wrench in the axes of a frame, or the size of its force or torque.
fn component_of<S: Scalar, const D: usize>(wrench: &Wrench<S, D>, component: usize, axes: &Frame<Taylor<S>, D>) -> S {
    match component {
        FORCE_SIZE => norm(&wrench.force),
        TORQUE_SIZE if D == 2 => wrench.torque[2].abs(),
        TORQUE_SIZE => norm::<S, 3>(&wrench.torque),
        5 if D == 2 => wrench.torque[2],
        component => {
            let part = if component < 3 { &wrench.force[..] } else { &wrench.torque[..] };
            axes.axes[component % 3].iter().zip(part).fold(S::zero(), |sum, (axis, &part)| sum + axis.x * part)
        }
    }
}
