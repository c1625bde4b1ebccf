//! Angles in space that count full turns, the last coordinates of q.

use super::model_facts::oriented_bodies;
use crate::body::{Carried, MarkerId, Pose, norm};
use crate::scene::Model;

/// Writes the rates of the turning angles.
pub(super) fn turning_rates<const D: usize>(model: &Model<D>, q: &[f64], v: &[f64], qdot: &mut [f64]) {
    let first = q.len() - model.turnings.len();
    for (rate, turning) in qdot[first..].iter_mut().zip(&model.turnings) {
        *rate = turning.rate(|marker| carried(model, marker, q, v));
    }
}

/// Sets the turning angles to those of the bodies' orientations, each within pi of its old value.
pub(super) fn continue_turnings<const D: usize>(model: &Model<D>, q: &mut [f64]) {
    let first = q.len() - model.turnings.len();
    // The orientations do not depend on the velocities: q stands in for v.
    for (i, turning) in model.turnings.iter().enumerate() {
        q[first + i] = turning.next_to(q[first + i], |marker| carried(model, marker, q, q));
    }
}

/// Writes the magnitude of the angular velocity of each body with an orientation, rad/s.
pub(super) fn write_spins<const D: usize>(model: &Model<D>, q: &[f64], v: &[f64], out: &mut [f64]) {
    for (out, part) in out.iter_mut().zip(oriented_bodies(model)) {
        *out = norm(&part.body.pose(part.coordinates(q), part.velocities(v)).spin);
    }
}

/// A marker with the pose of the body that carries it.
#[inline(always)]
pub(super) fn carried<'m, const D: usize>(
    model: &'m Model<D>,
    marker: MarkerId,
    q: &[f64],
    v: &[f64],
) -> Carried<'m, D> {
    match model.carrier(marker) {
        None => Carried { body: Pose::ground(), marker: &model.ground[marker] },
        Some(part) => Carried {
            body: part.body.pose(part.coordinates(q), part.velocities(v)),
            marker: &part.body.markers()[marker - part.first_marker],
        },
    }
}
