//! Bodies of a few coordinates, all of which move all of their markers: the model's view of every [`BodyKernel`].

use super::flexible::PointShape;
use super::{
    Bent, Body, BodyKernel, BodyOver, BodyState, Dual6, Energy, Frame, Freedom, Marker, Pose, Wrench, cross, dot, sub,
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
    (q, v, vdot): (&[S], &[S], Option<&[S]>),
) -> Frame<Taylor<S>, D> {
    let mut path = [Taylor::fixed(S::zero()); MOST_COORDINATES];
    let path = &mut path[..q.len()];
    coordinate_path(|q, v, rate| BodyKernel::rate(body, q, v, rate), (q, v, vdot), path);
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
    (q, v, vdot): (&[S], &[S], Option<&[S]>),
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
    fn coordinate_names(&self) -> Vec<String> {
        BodyKernel::coordinate_names(self).into_iter().map(String::from).collect()
    }
    fn velocity_names(&self) -> Vec<String> {
        BodyKernel::velocity_names(self).into_iter().map(String::from).collect()
    }
    fn marker_count(&self) -> usize {
        self.markers().len()
    }
    fn marker(&self, index: usize) -> &Marker<D> {
        &self.markers()[index]
    }
    fn support(&self, _marker: usize) -> Vec<usize> {
        (0..BodyKernel::velocity_names(self).len()).collect()
    }
    forward! { BodyKernel =>
        fn mass_pattern(&self) -> Vec<(usize, usize)>;
        fn own_forces(&self, q: &[f64], v: &[f64], gravity: &[f64; D], f: &mut [f64]);
        fn normalize(&self, q: &mut [f64]);
        fn oriented(&self) -> bool;
        fn turning(&self) -> Option<usize>;
        fn pose(&self, q: &[f64], v: &[f64]) -> Pose<D>;
        fn freedom(&self) -> Option<Freedom>;
        fn has_constant_forces(&self) -> bool;
    }
    fn mass(&self, _q: &[f64], values: &mut [f64]) {
        BodyKernel::mass(self, values);
    }
    fn add_stiffness(&self, _values: &mut [f64]) {}
    fn tangent_pattern(&self) -> Vec<(usize, usize)> {
        if BodyKernel::has_constant_forces(self) { Vec::new() } else { BodyKernel::tangent_pattern(self) }
    }
    fn tangent(&self, at: BodyState<D>, k: &mut [f64], c: &mut [f64]) {
        if !BodyKernel::has_constant_forces(self) {
            BodyKernel::tangent(self, at, k, c);
        }
    }
    fn dissipation(&self, _v: &[f64]) -> f64 {
        0.0
    }
    fn has_constant_mass(&self) -> bool {
        true
    }
    fn reach(&self) -> f64 {
        self.markers().iter().map(|marker| dot(&marker.offset, &marker.offset).sqrt()).fold(0.0, f64::max)
    }
    fn elastic_count(&self) -> usize {
        0
    }
    fn most_coordinates(&self) -> usize {
        MOST_COORDINATES
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
