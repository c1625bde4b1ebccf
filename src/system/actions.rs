//! What single forces and joints do at a state, over any scalar.

use super::gather::gathered;
use super::layout::Layout;
use super::locked::row_gradient;
use super::view::StateView;
use crate::body::{MOST_MARKERS, Wrench, twist_len};
use crate::force::{Action, Force, ForceOver};
use crate::joint::{Joint, JointOver, MOST_ROWS, markers_per_pass};
use crate::math::array::Each;
use crate::math::{Scalar, Taylor};
use crate::scene::Model;

/// Magnitude, potential and other scalars of a force.
pub(super) fn action<S: Scalar, const D: usize>(
    model: &Model<D>,
    force: usize,
    view: &impl StateView<S, D>,
) -> Action<S>
where
    dyn Force<D>: ForceOver<S, D>,
{
    act(model, force, view, &mut [Wrench::zero(); MOST_MARKERS])
}

/// The scalars of a force, and its wrenches, which must be zero on entry.
pub(super) fn act<S: Scalar, const D: usize>(
    model: &Model<D>,
    force: usize,
    view: &impl StateView<S, D>,
    wrenches: &mut [Wrench<S, D>; MOST_MARKERS],
) -> Action<S>
where
    dyn Force<D>: ForceOver<S, D>,
{
    let input = view.input(force);
    let force = &model.forces[force];
    let wrenches = &mut wrenches[..force.markers.len()];
    let element = force.element.as_ref();
    let time = view.time().map(Taylor::time);
    let act = |frames: &[_]| ForceOver::<S, D>::driven(element, &input, frames, time, wrenches);
    gathered(&force.markers, |&marker| view.frame(marker), act)
}

/// -G^T lambda at one of a joint's markers, in the order of a twist.
pub(super) fn reaction_wrench<S: Scalar, const D: usize>(
    layout: &Layout<D>,
    view: &impl StateView<S, D>,
    joint: usize,
    slot: usize,
) -> [S; 6]
where
    dyn Joint<D>: JointOver<S, D>,
{
    let rows = layout.rows_of_joint(joint);
    let lock = &layout.locks[joint];
    let joint = &layout.model.joints[joint];
    let mut wrench = [S::zero(); 6];
    if let Some(lock) = lock {
        let frames = [0, 1].each(|slot| view.frame(joint.markers[slot]).map(|x| x.x));
        let both = [&frames[0], &frames[1]];
        for (row, multiplier) in rows.enumerate() {
            let gradient = row_gradient(lock, both, slot, &frames[slot].r, row);
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
    gathered(&joint.markers, |&marker| view.frame(marker), gradient);
    let first = slot % markers_per_pass(D) * twist_len(D);
    for (slope, row) in slopes.iter().zip(rows) {
        let lambda = view.lambda(row);
        let own = wrench.iter_mut().zip(&slope[first..]).take(twist_len(D));
        own.for_each(|(sum, &entry)| *sum -= lambda * entry);
    }
    wrench
}

/// Power of a force on all its bodies.
pub(super) fn power<S: Scalar, const D: usize>(model: &Model<D>, force: usize, view: &impl StateView<S, D>) -> S
where
    dyn Force<D>: ForceOver<S, D>,
{
    let mut wrenches = [Wrench::zero(); MOST_MARKERS];
    act(model, force, view, &mut wrenches);
    let markers = model.forces[force].markers.iter();
    markers.zip(&wrenches).fold(S::zero(), |sum, (&marker, wrench)| sum + wrench.power(&view.frame(marker)))
}

/// -lambda . G v of a joint, G v being the rate of phi with t held.
pub(super) fn drive_power<S: Scalar, const D: usize>(layout: &Layout<D>, joint: usize, view: &impl StateView<S, D>) -> S
where
    dyn Joint<D>: JointOver<S, D>,
{
    let rows = layout.rows_of_joint(joint);
    let joint = &layout.model.joints[joint];
    let mut levels = [Taylor::fixed(S::zero()); MOST_ROWS];
    let levels = &mut levels[..rows.len()];
    let element = joint.element.as_ref();
    let time = view.time().map(|t| Taylor::fixed(S::constant(t)));
    let rates = |frames: &[_]| JointOver::<S, D>::levels(element, frames, time, levels);
    gathered(&joint.markers, |&marker| view.frame(marker), rates);
    rows.zip(levels).fold(S::zero(), |sum, (row, level)| sum - view.lambda(row) * level.d)
}
