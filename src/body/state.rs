//! A state xi of a controller, filter or actuator.

use super::{BodyFacts, BodyKernel, Energy, Frame, Marker};
use crate::math::{Scalar, Taylor};

/// A velocity xi without a coordinate, whose rate is the force on it, since its mass is one. Elements see it as all
/// else, at a marker: the one that stays at the world's origin and has the velocity xi along x.
pub(crate) struct StateBody<const D: usize> {
    markers: [Marker<D>; 1],
}

impl<const D: usize> StateBody<D> {
    pub fn new() -> Self {
        StateBody { markers: [Marker::point([0.0; D])] }
    }
}

impl<const D: usize> BodyKernel<D> for StateBody<D> {
    fn facts(&self) -> BodyFacts {
        BodyFacts { oriented: false, has_constant_forces: true, ..BodyFacts::new([], [""]) }
    }
    fn markers(&self) -> &[Marker<D>] {
        &self.markers
    }
    fn rate<S: Scalar>(&self, _q: &[S], _v: &[S], _qdot: &mut [S]) {}
    fn frame<S: Scalar>(&self, _q: &[S]) -> Frame<S, D> {
        Frame::world()
    }
    fn motion<S: Scalar>(&self, _q: &[S], v: &[S], vdot: Option<&[S]>) -> Frame<Taylor<S>, D> {
        let mut frame = Frame::world();
        frame.r[0] = Taylor::new(S::zero(), v[0], vdot.map_or(S::zero(), |vdot| vdot[0]));
        frame
    }
    fn mass(&self, values: &mut [f64]) {
        values.fill(1.0);
    }
    fn own_forces<S: Scalar>(&self, _q: &[S], _v: &[S], _gravity: &[f64; D], _f: &mut [S]) {}
    fn energy<S: Scalar>(&self, _q: &[S], _v: &[S], _gravity: &[f64; D]) -> Energy<S> {
        Energy { kinetic: S::zero(), potential: S::zero() }
    }
}
