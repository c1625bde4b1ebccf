//! Outputs of a scene, written once over any scalar, so that values and derivatives agree.

use super::actions::{act, action, drive_power, power, reaction_wrench};
use super::layout::Layout;
use super::section::section;
use super::terms::OperatingPoint;
use super::view::{Plain, StateView};
use crate::body::{Energy, Frame, MOST_MARKERS, Probe, Quantity, Wrench, norm};
use crate::force::{Force, ForceOver};
use crate::joint::{Joint, JointOver};
use crate::math::{Scalar, Taylor};
use crate::scene::{FORCE_SIZE, Measure, Model, TORQUE_SIZE};

/// Returns the state with its v' only where an output reads accelerations.
pub(super) fn felt<'a, const D: usize>(model: &Model<D>, at: OperatingPoint<'a>) -> OperatingPoint<'a> {
    let is_accelerated = model.outputs.iter().any(|output| output.measure.feels_acceleration());
    OperatingPoint { vdot: if is_accelerated { at.vdot } else { &[] }, ..at }
}

/// The outputs in the order of the scene; those that are not read stay as they are.
pub(super) fn write_outputs<const D: usize>(layout: &Layout<D>, view: &Plain<D>, unread: &[bool], out: &mut [f64]) {
    let model = &layout.model;
    let mut totals = None;
    let mut last = None;
    for (i, (out, output)) in out.iter_mut().zip(&model.outputs).enumerate() {
        if unread.get(i).is_some_and(|unread| *unread) {
            continue;
        }
        let value = match output.measure {
            Measure::Energy(part) => part.of(*totals.get_or_insert_with(|| energies(model, view))),
            // Outputs of one section are mostly consecutive.
            Measure::Section { cut, component } => {
                let known = last.filter(|(known, _)| *known == cut);
                let (_, forces) = known.unwrap_or_else(|| (cut, section(layout, &model.cuts[cut], view)));
                last = Some((cut, forces));
                forces[component]
            }
            ref measure => read(layout, measure, view),
        };
        *out = value * output.unit.per_si;
    }
}

/// Value of an output, in SI units.
pub(super) fn read<S: Scalar, const D: usize>(layout: &Layout<D>, measure: &Measure, view: &impl StateView<S, D>) -> S
where
    dyn Force<D>: ForceOver<S, D>,
    dyn Joint<D>: JointOver<S, D>,
{
    let model = &layout.model;
    match measure {
        Measure::Formula(formula) => {
            formula.evaluate(view.time().map(S::constant), |probe| read_probe(layout, probe, view))
        }
        Measure::Probe(probe) => read_probe(layout, probe, view),
        Measure::Reaction { joint, slot, component, axes } => {
            let wrench = Wrench::from_twist_order(&reaction_wrench(layout, view, *joint, *slot));
            component_of(&wrench, *component, &view.frame(*axes))
        }
        Measure::Load { force, slot, component, axes } => {
            let mut wrenches = [Wrench::zero(); MOST_MARKERS];
            act(model, *force, view, &mut wrenches);
            component_of(&wrenches[*slot], *component, &view.frame(*axes))
        }
        Measure::Power { force } => power(model, *force, view),
        Measure::DrivePower { joint } => drive_power(layout, *joint, view),
        // phi is coordinate - value: -G^T lambda acts on the second body along the growing coordinate.
        Measure::Push { joint } => -view.lambda(layout.rows_of_joint(*joint).start),
        // phi is l - length: -G^T lambda pulls the second body towards the first.
        Measure::Multiplier { joint } => view.lambda(layout.rows_of_joint(*joint).start),
        Measure::Elastic(combination) => combination.at(|coordinate| view.q(coordinate)),
        Measure::Station(place) => place.read(&model.gravity, |marker| view.frame(marker)),
        Measure::Section { cut, component } => section(layout, &model.cuts[*cut], view)[*component],
        Measure::Force(force) => action(model, *force, view).magnitude,
        Measure::Energy(part) => part.of(energies(model, view)),
    }
}

fn read_probe<S: Scalar, const D: usize>(layout: &Layout<D>, probe: &Probe, view: &impl StateView<S, D>) -> S
where
    dyn Force<D>: ForceOver<S, D>,
    dyn Joint<D>: JointOver<S, D>,
{
    if let Quantity::Output(number) = probe.quantity {
        return read(layout, &layout.model.outputs[number].measure, view);
    }
    probe.read(view.time().regime, |marker| view.frame(marker))
}

/// Kinetic and potential energy of the whole mechanism.
pub(super) fn energies<S: Scalar, const D: usize>(model: &Model<D>, view: &impl StateView<S, D>) -> Energy<S>
where
    dyn Force<D>: ForceOver<S, D>,
{
    let mut total = Energy { kinetic: S::zero(), potential: S::zero() };
    for part in &model.bodies {
        let own = view.energy(part, &model.gravity);
        total.kinetic += own.kinetic;
        total.potential += own.potential;
    }
    (0..model.forces.len()).for_each(|force| total.potential += action(model, force, view).potential.x);
    total
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
