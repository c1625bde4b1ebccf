//! Bodies of a few coordinates, all of which move all of their markers: the model's view of every [`BodyKernel`].

use super::flexible::PointShape;
use super::{
    Bent, Body, BodyFacts, BodyKernel, BodyOver, BodyState, Dual6, Energy, Frame, Marker, Pose, Wrench, cross, dot,
    norm, sub,
};
use crate::forward::forward;
use crate::math::array::{Each, from_fn};
use crate::math::{Scalar, Taylor};

/// The largest number of coordinates of a [`BodyKernel`]: they are kept on the stack.
pub const MOST_COORDINATES: usize = 8;

impl<K: BodyKernel<D>, S: Scalar, const D: usize> BodyOver<S, D> for K {
    fn rate(&self, q: &[S], v: &[S], qdot: &mut [S]) {
        BodyKernel::rate(self, q, v, qdot);
    }

    fn motion(&self, q: &[S], v: &[S], vdot: Option<&[S]>, first: usize, out: &mut [Frame<Taylor<S>, D>]) {
        let body = BodyKernel::motion(self, q, v, vdot);
        out.iter_mut().zip(&self.markers()[first..]).for_each(|(frame, marker)| *frame = body.at(marker));
    }

    fn pull_back(&self, _marker: usize, q: &[S], frame: &Frame<S, D>, wrench: &Wrench<S, D>, f: &mut [S]) {
        BodyKernel::pull_back(self, q, frame, wrench, f);
    }

    fn energy(&self, q: &[S], v: &[S], gravity: &[f64; D]) -> Energy<S> {
        BodyKernel::energy(self, q, v, gravity)
    }
}

/// The frame in which the markers are fixed, over q and its first two derivatives.
#[inline]
pub(super) fn motion<K: BodyKernel<D>, S: Scalar, const D: usize>(
    body: &K,
    q: &[S],
    v: &[S],
    vdot: Option<&[S]>,
) -> Frame<Taylor<S>, D> {
    let mut path = [Taylor::fixed(S::zero()); MOST_COORDINATES];
    let path = &mut path[..q.len()];
    coordinate_path(|q, v, rate| BodyKernel::rate(body, q, v, rate), q, v, vdot, path);
    body.frame(path)
}

/// The pose of the frame in which the markers are fixed.
pub(super) fn pose<K: BodyKernel<D>, const D: usize>(body: &K, q: &[f64], v: &[f64]) -> Pose<D> {
    (&BodyKernel::motion(body, q, v, None)).into()
}

/// f += J^T w by the velocities of the body's frame, J e_j, at v = e_j.
pub(super) fn pull_back<K: BodyKernel<D>, S: Scalar, const D: usize>(
    body: &K,
    q: &[S],
    frame: &Frame<S, D>,
    wrench: &Wrench<S, D>,
    f: &mut [S],
) {
    let n = f.len();
    for (j, f) in f.iter_mut().enumerate() {
        let mut unit = [S::zero(); MOST_COORDINATES];
        unit[j] = S::one();
        let own = BodyKernel::motion(body, q, &unit[..n], None);
        let lever = cross(&sub(&frame.r, &own.r.each(|x| x.x)), &wrench.force);
        let moment: [S; 3] = from_fn(|i| wrench.torque[i] + lever[i]);
        *f += dot(&own.velocity(), &wrench.force) + dot(&own.angular_velocity(), &moment);
    }
}

/// q with q' = N(q) v and q'' = (N(q') - N(0)) v + N(q) v', from N's being affine in q.
#[inline]
pub(super) fn coordinate_path<S: Scalar>(
    rate: impl Fn(&[S], &[S], &mut [S]),
    q: &[S],
    v: &[S],
    vdot: Option<&[S]>,
    path: &mut [Taylor<S>],
) {
    if q.len() == v.len() {
        for (i, place) in path.iter_mut().enumerate() {
            *place = Taylor::new(q[i], v[i], vdot.map_or(S::zero(), |a| a[i]));
        }
        return;
    }
    let mut rates = [[S::zero(); MOST_COORDINATES]; 4];
    let [first, second, constant, applied] = &mut rates;
    let n = q.len();
    rate(q, v, &mut first[..n]);
    rate(&first[..n], v, &mut second[..n]);
    rate(&[S::zero(); MOST_COORDINATES][..n], v, &mut constant[..n]);
    if let Some(vdot) = vdot {
        rate(q, vdot, &mut applied[..n]);
    }
    for (i, place) in path.iter_mut().enumerate() {
        *place = Taylor::new(q[i], first[i], second[i] - constant[i] + applied[i]);
    }
}

impl<K: BodyKernel<D>, const D: usize> Body<D> for K {
    fn facts(&self) -> BodyFacts {
        let facts = BodyKernel::facts(self);
        let tangent_pattern = if facts.has_constant_forces { Vec::new() } else { facts.tangent_pattern };
        let reach = self.markers().iter().map(|marker| norm(&marker.offset)).fold(0.0, f64::max);
        BodyFacts {
            tangent_pattern,
            reach,
            has_constant_mass: true,
            elastic_count: 0,
            most_coordinates: MOST_COORDINATES,
            supports: Vec::new(),
            stiffness: Vec::new(),
            ..facts
        }
    }
    forward! { BodyKernel =>
        fn markers(&self) -> &[Marker<D>];
        fn own_forces(&self, q: &[f64], v: &[f64], gravity: &[f64; D], f: &mut [f64]);
        fn normalize(&self, q: &mut [f64]);
        fn pose(&self, q: &[f64], v: &[f64]) -> Pose<D>;
    }
    fn mass(&self, _q: &[f64], values: &mut [f64]) {
        BodyKernel::mass(self, values);
    }
    fn tangent(&self, at: BodyState<D>, k: &mut [f64], c: &mut [f64]) {
        // There are no places where the own forces are constant.
        if !k.is_empty() {
            BodyKernel::tangent(self, at, k, c);
        }
    }
    fn dissipation(&self, _v: &[f64]) -> f64 {
        0.0
    }
    fn shapes(&self) -> &[PointShape<D>] {
        &[]
    }
    fn bent(&self) -> Option<Bent<'_, D>> {
        None
    }
}

fn lift(values: &[f64]) -> [Dual6; MOST_COORDINATES] {
    from_fn(|i| Dual6::fixed(values.get(i).copied().unwrap_or(0.0)))
}

/// k and c less the derivatives of the own forces, over dual numbers, six directions at a time: M is constant.
pub(super) fn tangent<K: BodyKernel<D>, const D: usize>(body: &K, at: BodyState<D>, k: &mut [f64], c: &mut [f64]) {
    let q = lift(at.q);
    let v = lift(at.v);
    let n = at.v.len();
    let subtract = |q: &[Dual6], v: &[Dual6], first: usize, matrix: &mut [f64]| {
        let mut forces = [Dual6::fixed(0.0); MOST_COORDINATES];
        body.own_forces(q, v, at.gravity, &mut forces[..n]);
        for (row, force) in matrix.chunks_exact_mut(n).zip(&forces) {
            row[first..].iter_mut().zip(&force.eps).for_each(|(entry, slope)| *entry -= slope);
        }
    };
    for first in (0..n).step_by(6) {
        let mut directions = [Dual6::fixed(0.0); MOST_COORDINATES];
        let seeded = directions[first..n].iter_mut().take(6).enumerate();
        seeded.for_each(|(j, direction)| *direction = Dual6::seeded(0.0, j));
        let mut moved = [Dual6::fixed(0.0); MOST_COORDINATES];
        BodyKernel::rate(body, &q[..at.q.len()], &directions[..n], &mut moved[..at.q.len()]);
        moved.iter_mut().zip(&q).for_each(|(moved, &q)| *moved += q);
        subtract(&moved[..at.q.len()], &v[..n], first, k);
        directions.iter_mut().zip(&v).for_each(|(direction, &v)| *direction += v);
        subtract(&q[..at.q.len()], &directions[..n], first, c);
    }
}
