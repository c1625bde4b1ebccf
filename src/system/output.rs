//! Outputs of a scene, written once over any scalar, so that values and derivatives agree.

use super::Scratch;
use super::locked::row_gradient;
use super::mechanism::Mechanism;
use super::tangent::OperatingPoint;
use super::view::{Plain, View, gathered};
use super::workspace::Workspace;
use crate::body::{Energy, Frame, MOST_MARKERS, MarkerId, Quantity, Wrench, dot, norm, sub, twist_len};
use crate::force::{Action, Force, ForceOver};
use crate::joint::{Joint, JointOver, MOST_ROWS, markers_per_pass};
use crate::math::{Regime, Scalar, Taylor};
use crate::scene::{FORCE_SIZE, Measure, TORQUE_SIZE};

impl<const D: usize> Mechanism<D> {
    /// Calls `see` with the workspace evaluated at a state; with its v' only where an output reads accelerations.
    pub(super) fn observed<R>(
        &self,
        at: OperatingPoint,
        scratch: &mut Scratch,
        see: impl FnOnce(OperatingPoint, Regime, &mut Workspace<D>) -> R,
    ) -> R {
        let is_accelerated = self.model().outputs.iter().any(|output| output.measure.feels_acceleration());
        let vdot = if is_accelerated { at.vdot } else { &[] };
        self.at(at.q, at.v, scratch, |work, regime| {
            if is_accelerated {
                self.place(at.q, at.v, vdot, work);
            }
            see(OperatingPoint { vdot, ..at }, regime, work)
        })
    }

    /// All outputs in the order of the scene.
    pub(super) fn write_outputs(&self, view: &Plain<D>, out: &mut [f64]) {
        let (mut energies, mut section) = (None, None);
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
                formula.evaluate(view.time().map(S::constant), |probe| probe.read(&view.frame(probe.marker)))
            }
            Measure::Relative { of, to, quantity } => relative(&view.frame(*of), &view.frame(*to), *quantity),
            Measure::Turn { of, to, turning } => {
                let angle = turn(&view.frame(*of), &view.frame(*to));
                if D == 2 { angle } else { view.time().regime.angle(*turning, angle, 0.0) }
            }
            Measure::Distance { from, to, rate } => {
                let gap = sub(&view.frame(*to).r, &view.frame(*from).r);
                if *rate { separation_rate(&gap) } else { norm(&gap.map(|x| x.x)) }
            }
            Measure::Reaction { joint, component, axes } => self.reaction(view, *joint, (*component, *axes)),
            // phi is coordinate - value: -G^T lambda acts on the second body along the growing coordinate.
            Measure::Push { joint } => -view.lambda(self.rows_of_joint(*joint).start),
            // phi is l - length: -G^T lambda pulls the second body towards the first.
            Measure::Tension { joint } => view.lambda(self.rows_of_joint(*joint).start),
            Measure::Elastic(combination) => combination.at(|coordinate| view.q(coordinate)),
            Measure::Station(place) => place.read(&model.gravity, |marker| view.frame(marker)),
            Measure::Section { cut, component } => self.section(&model.cuts[*cut], view)[*component],
            Measure::Force(force) => self.action(*force, view).magnitude,
            Measure::Energy(part) => part.of(self.energies(view)),
        }
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
        let (input, force) = (view.input(force), &self.model().forces[force]);
        let wrenches = &mut wrenches[..force.markers.len()];
        let (element, time) = (force.element.as_ref(), view.time().map(Taylor::time));
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
            let frames = [0, 1].map(|slot| view.frame(joint.markers[slot]).map(|x| x.x));
            let (both, own) = ([&frames[0], &frames[1]], (slot, &frames[slot].r));
            for (row, multiplier) in rows.enumerate() {
                let (gradient, lambda) = (row_gradient(lock, both, own, row), view.lambda(multiplier));
                let torque = &gradient.torque[if D == 2 { 2 } else { 0 }..];
                let entries = gradient.force.iter().chain(torque);
                wrench.iter_mut().zip(entries).for_each(|(sum, &entry)| *sum -= lambda * entry);
            }
            return wrench;
        }
        let mut slopes = [[S::zero(); 6]; MOST_ROWS];
        let own = &mut slopes[..rows.len()];
        let (element, time, pass) = (joint.element.as_ref(), view.time().map(S::constant), slot / markers_per_pass(D));
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

    /// A component of -G^T lambda on the joint's second marker, as a wrench in the axes of a marker.
    fn reaction<S: Scalar>(&self, view: &impl View<S, D>, joint: usize, (component, axes): (usize, MarkerId)) -> S
    where
        dyn Joint<D>: JointOver<S, D>,
    {
        let slot = 1.min(self.model().joints[joint].markers.len() - 1);
        let wrench = self.reaction_wrench(view, joint, slot);
        match component {
            FORCE_SIZE => norm::<S, D>(&std::array::from_fn(|i| wrench[i])),
            TORQUE_SIZE if D == 2 => wrench[2].abs(),
            TORQUE_SIZE => norm::<S, 3>(&std::array::from_fn(|i| wrench[3 + i])),
            5 if D == 2 => wrench[2],
            component => {
                let axis = view.frame(axes).axes[component % 3];
                let part = &wrench[component / 3 * 3..];
                axis.iter().zip(part).fold(S::zero(), |sum, (axis, &part)| sum + axis.x * part)
            }
        }
    }
}

fn separation_rate<S: Scalar, const D: usize>(gap: &[Taylor<S>; D]) -> S {
    let length = norm(&gap.map(|x| x.x));
    // At zero distance the rate is the speed of separation.
    if length.value() == 0.0 {
        return norm(&gap.map(|x| x.d));
    }
    dot(&gap.map(|x| x.x), &gap.map(|x| x.d)) / length
}

/// Relative position, velocity, angle or angular velocity of two markers, in the axes of `to`.
fn relative<S: Scalar, const D: usize>(of: &Frame<Taylor<S>, D>, to: &Frame<Taylor<S>, D>, quantity: Quantity) -> S {
    let gap = sub(&of.r, &to.r);
    match quantity {
        Quantity::Position(axis) => dot(&to.axes[axis], &gap).x,
        Quantity::Velocity(axis) => dot(&to.axes[axis], &gap).d,
        Quantity::Angle => turn(of, to),
        Quantity::Spin(axis) => {
            let spin = sub(&of.angular_velocity(), &to.angular_velocity());
            if D == 2 {
                return spin[2];
            }
            to.axes[axis].iter().zip(spin).fold(S::zero(), |sum, (axis, spin)| sum + axis.x * spin)
        }
    }
}

/// Angle of `of` relative to `to`; in space about the third axis of `to`, in (-pi, pi].
fn turn<S: Scalar, const D: usize>(of: &Frame<Taylor<S>, D>, to: &Frame<Taylor<S>, D>) -> S {
    if D == 2 {
        return of.turn.x - to.turn.x;
    }
    let (s, c) = (dot(&to.axes[1], &of.axes[0]).x, dot(&to.axes[0], &of.axes[0]).x);
    // The first axis of one is along the third of the other: the angle and its derivative are undefined.
    if s.value() == 0.0 && c.value() == 0.0 {
        return S::zero();
    }
    S::atan2(s, c)
}
