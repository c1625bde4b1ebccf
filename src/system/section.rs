//! Section forces of a beam in a floating frame: the sum of all that acts on the body beyond the section.
//!
//! The method of sections: with the joints, forces, weight and inertia of that part the section is in equilibrium,
//! whatever coordinates describe the displacements and however few: they determine only where the mass is. A section
//! next to a joint carries the reaction of that joint to round-off. Arms and axes are those of the displaced beam, so
//! that the forces depend on the choice of the floating frame only by the terms that its theory neglects.

use super::actions::{act, reaction_wrench};
use super::layout::Layout;
use super::view::StateView;
use crate::body::{Frame, MOST_MARKERS, Wrench, cross, floating, sub};
use crate::force::{Force, ForceOver};
use crate::joint::{Joint, JointOver};
use crate::math::array::{Each, from_fn};
use crate::math::{Scalar, Taylor};
use crate::scene::{Cut, Model, Part};

/// A sum of wrenches about one point.
struct WrenchSum<S, const D: usize> {
    about: [S; D],
    wrench: Wrench<S, D>,
}

impl<S: Scalar, const D: usize> WrenchSum<S, D> {
    fn add(&mut self, at: &[S; D], wrench: &Wrench<S, D>) {
        let lever = cross(&sub(at, &self.about), &wrench.force);
        (0..D).for_each(|k| self.wrench.force[k] += wrench.force[k]);
        (0..3).for_each(|k| self.wrench.torque[k] += wrench.torque[k] + lever[k]);
    }
}

/// Axial force, shear forces, torque and bending moments about the section, in the axes of the displaced section.
pub(super) fn section<S: Scalar, const D: usize>(
    layout: &Layout<D>,
    cut: &Cut<D>,
    view: &impl StateView<S, D>,
) -> [S; 6]
where
    dyn Force<D>: ForceOver<S, D>,
    dyn Joint<D>: JointOver<S, D>,
{
    let model = &layout.model;
    let part = &model.bodies[cut.body];
    let own = view.frame(part.first_marker);
    let [q, v] = elastic(part);
    let at = floating::place(&own.map(|x| x.x), &cut.section, &cut.axes, |i| view.q(q + i));
    let mut sum = WrenchSum { about: at.r, wrench: Wrench::zero() };
    let coordinate = |i: usize| Taylor::new(view.q(q + i), view.v(v + i), view.vdot(v + i));
    let origin = own.r.each(|x| x.x);
    for piece in &cut.beyond.pieces {
        sum.add(&origin, &floating::load(piece, &own, coordinate, &model.gravity));
    }
    for disc in &cut.beyond.discs {
        sum.add(&origin, &floating::resistance(disc, &own, coordinate));
    }
    let place = |marker: usize| view.frame(marker).r.each(|x| x.x);
    for &(joint, slot) in &cut.joints {
        let wrench = Wrench::from_twist_order(&reaction_wrench(layout, view, joint, slot));
        sum.add(&place(model.joints[joint].markers[slot]), &wrench);
    }
    for &(force, slot) in &cut.forces {
        let mut wrenches = [Wrench::zero(); MOST_MARKERS];
        act(model, force, view, &mut wrenches);
        sum.add(&place(model.forces[force].markers[slot]), &wrenches[slot]);
    }
    in_axes(&at, &sum.wrench)
}

/// The markers of the joints and forces beyond a section.
pub(super) fn markers_beyond<const D: usize>(model: &Model<D>, cut: &Cut<D>) -> Vec<usize> {
    let joints = cut.joints.iter().flat_map(|&(joint, _)| &model.joints[joint].markers);
    joints.chain(cut.forces.iter().flat_map(|&(force, _)| &model.forces[force].markers)).copied().collect()
}

/// Places of the first elastic coordinate of a body and of its velocity.
fn elastic<const D: usize>(part: &Part<D>) -> [usize; 2] {
    let count = part.facts.elastic_count;
    [part.first_q + part.nq - count, part.first_v + part.nv - count]
}

/// Components of a wrench in the axes of a frame, in the order of [`Station`](crate::force::Station).
fn in_axes<S: Scalar, const D: usize>(at: &Frame<S, D>, wrench: &Wrench<S, D>) -> [S; 6] {
    let along = |axis: usize, v: &[S]| at.axes[axis].iter().zip(v).fold(S::zero(), |sum, (&e, &v)| sum + e * v);
    from_fn(|i| match (i, D) {
        (0 | 1, _) | (2, 3) => along(i, &wrench.force),
        (5, 2) => wrench.torque[2],
        (_, 2) => S::zero(),
        _ => along(i - 3, &wrench.torque),
    })
}
