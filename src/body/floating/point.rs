//! Points of a flexible body: their frames, and the generalized forces of a wrench there.

use super::algebra::spin;
use super::small_turn::SmallTurn;
use super::turns;
use crate::body::flexible::PointShape;
use crate::body::{Frame, Marker, Wrench, cross, dot, sub};
use crate::math::Scalar;
use crate::math::array::from_fn;

/// The frame of a marker: at rest + sum_i t_i q_i + (R - 1 - a~) arm, with axes rotated by R of a = sum_i r_i q_i. t_i
/// has a x arm, the rotation of a point off the line to first order; (R - 1 - a~) arm completes it.
#[inline]
pub fn place<S: Scalar, const D: usize>(
    own: &Frame<S, D>,
    shape: &PointShape<D>,
    marker: &Marker<D>,
    coordinate: impl Fn(usize) -> S,
) -> Frame<S, D> {
    let u = shape.displacement(&coordinate);
    let mut r = own.r;
    for (axis, (&u, &rest)) in own.axes.iter().zip(u.iter().zip(&shape.rest)) {
        r.iter_mut().zip(axis).for_each(|(r, &a)| *r += a * (u + rest));
    }
    let a = angles(shape, coordinate);
    let mut turned = turn(Frame { r, ..*own }, &a);
    if shape.arm != [0.0; D] {
        let arm = shape.arm.map(S::constant);
        let [swung, first, rest] = [along(&turned, &arm), along(own, &spin(&a, &arm)), along(own, &arm)];
        (0..D).for_each(|k| turned.r[k] += swung[k] - first[k] - rest[k]);
    }
    turned.at(&Marker { offset: [0.0; D], ..*marker })
}

/// World components of a vector given in the axes of a frame.
#[inline]
fn along<S: Scalar, const D: usize>(frame: &Frame<S, D>, vector: &[S; D]) -> [S; D] {
    from_fn(|k| (0..D).fold(S::zero(), |sum, i| sum + frame.axes[i][k] * vector[i]))
}

/// The small rotation a = sum_i r_i q_i at a point.
#[inline]
fn angles<S: Scalar, const D: usize>(shape: &PointShape<D>, coordinate: impl Fn(usize) -> S) -> [S; 3] {
    let mut sum = [S::zero(); 3];
    for (&dof, rotation) in shape.dofs.iter().zip(&shape.rotation) {
        let q = coordinate(dof);
        turns(D).filter(|&k| rotation[k] != 0.0).for_each(|k| sum[k] += q * rotation[k]);
    }
    sum
}

/// The frame rotated by R of a: by the angle a_z in the plane, by [`SmallTurn`] in space.
#[inline]
pub(super) fn turn<S: Scalar, const D: usize>(frame: Frame<S, D>, a: &[S; 3]) -> Frame<S, D> {
    if D == 2 {
        let (s, c) = a[2].sin_cos();
        let [x, y] = [frame.axes[0], frame.axes[1]];
        let axes = from_fn(|i| from_fn(|k| if i == 0 { x[k] * c + y[k] * s } else { y[k] * c - x[k] * s }));
        return Frame { axes, turn: frame.turn + a[2], ..frame };
    }
    let small = SmallTurn::of(*a);
    let columns: [[S; 3]; 3] = from_fn(|j| small.turned(&from_fn(|k| if k == j { S::one() } else { S::zero() })));
    let axes = from_fn(|j| from_fn(|k| (0..D).fold(S::zero(), |sum, i| sum + frame.axes[i][k] * columns[j][i])));
    Frame { axes, ..frame }
}

/// f += J^T w on the frame's velocities for a wrench at the frame `at`.
#[inline]
pub(super) fn pull_back_rigid<S: Scalar, const D: usize>(
    own: &Frame<S, D>,
    at: &Frame<S, D>,
    wrench: &Wrench<S, D>,
    f: &mut [S],
) {
    f.iter_mut().zip(wrench.force).for_each(|(f, force)| *f += force);
    let arm = cross(&sub(&at.r, &own.r), &wrench.force);
    let moment: [S; 3] = from_fn(|k| wrench.torque[k] + arm[k]);
    if D == 2 {
        f[2] += moment[2];
        return;
    }
    f[3..].iter_mut().zip(&own.axes).for_each(|(f, axis)| *f += dot(axis, &from_fn(|k| moment[k])));
}

/// f += J^T w on the elastic velocities that move the point.
#[inline]
pub(super) fn pull_back_elastic<S: Scalar, const D: usize>(
    own: &Frame<S, D>,
    shape: &PointShape<D>,
    q: &[S],
    wrench: &Wrench<S, D>,
    f: &mut [S],
) {
    let force: [S; D] = from_fn(|k| dot(&own.axes[k], &wrench.force));
    let a = angles(shape, |i| q[i]);
    let mut torque = wrench.torque;
    if shape.arm != [0.0; D] {
        let lever = cross(&along(&turn(*own, &a), &shape.arm.map(S::constant)), &wrench.force);
        (0..3).for_each(|k| torque[k] += lever[k]);
    }
    if D == 3 {
        torque = local_torque(own, &a, &torque);
    }
    if shape.arm != [0.0; D] {
        let first = cross(&shape.arm.map(S::constant), &force);
        (0..3).for_each(|k| torque[k] -= first[k]);
    }
    for (i, f) in f.iter_mut().enumerate().filter(|_| !shape.shortening.is_empty()) {
        *f += force[0] * shape.shortening_of(i, |dof| q[dof]);
    }
    for (f, (translation, rotation)) in f.iter_mut().zip(shape.translation.iter().zip(&shape.rotation)) {
        (0..D).filter(|&k| translation[k] != 0.0).for_each(|k| *f += force[k] * translation[k]);
        (0..3).filter(|&k| rotation[k] != 0.0).for_each(|k| *f += torque[k] * rotation[k]);
    }
}

/// Generalized force of a torque on a': T^T R^T A^T torque.
fn local_torque<S: Scalar, const D: usize>(own: &Frame<S, D>, a: &[S; 3], torque: &[S; 3]) -> [S; 3] {
    let moment: [S; 3] = from_fn(|k| (0..D).fold(S::zero(), |sum, i| sum + own.axes[k % D][i] * torque[i]));
    let small = SmallTurn::of(*a);
    small.felt(&small.back(&moment))
}
