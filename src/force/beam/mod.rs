//! Beam: a massless elastic beam between two frames, geometrically exact.
//!
//! The strains are those of a helix: the frames at its ends differ by a screw motion H, whose logarithm divided by the
//! length gives extension, shear, twist and curvature, constant along the element and zero in every rigid motion
//! (Sonneville, Cardona and Bruls, Geometrically exact beam finite element formulated on the special Euclidean group
//! SE(3), Comput. Methods Appl. Mech. Engrg. 268 (2014) 451-474).

mod spec;
mod station;
mod strain;

pub use spec::BeamForce;
pub use station::Station;
pub use strain::Beam;

use super::{Action, ForceKernel, Instant, Motion};
use crate::body::{Frame, Wrench, cross, sub};
use crate::math::screw::{Vector, dot3, pull_back};
use crate::math::{Dual, Scalar, Taylor};
use std::array::from_fn;
use strain::Strains;

/// A value with its rate.
pub(crate) type Moving<S> = Dual<S, 1>;

impl<const D: usize> ForceKernel<D> for Beam {
    fn act<S: Scalar>(&self, frames: &Motion<S, D>, _: Instant<S>, out: &mut [Wrench<S, D>]) -> Action<S> {
        let [a, b] = [&frames[0], &frames[1]].map(|frame| frame.map(|x| Moving { re: x.x, eps: [x.d] }));
        let strains = Strains::between(&a, &b);
        let strain = self.strain(&strains);
        let elastic: [S; 6] = from_fn(|i| (strain[i].re - self.rest[i]) * self.stiffness[i]);
        let damped = from_fn(|i| elastic[i] + strain[i].eps[0] * (self.damping * self.stiffness[i]));
        let [n, m] = self.conjugate(&strains, &damped);
        let value = |vector: &Vector<Moving<S>>| vector.map(|x| x.re);
        let [force, torque] = pull_back(&value(&strains.turn), &value(&strains.gap), &n, &m);
        // What the elastic force does is against the growth of the strain.
        let [force, torque] = [force, torque].map(|v| in_world(&a, &v.map(|x| -x)));
        let gap = sub(&b.r, &a.r).map(|x| x.re);
        out[1] = Wrench { force: from_fn(|i| force[i]), torque };
        let lever = cross(&gap, &out[1].force);
        out[0] = Wrench { force: from_fn(|i| -force[i]), torque: from_fn(|i| -(torque[i] + lever[i])) };
        let half_work = (0..6).fold(S::zero(), |sum, i| sum + elastic[i] * (strain[i].re - self.rest[i]));
        let power = (0..6).fold(S::zero(), |sum, i| sum + elastic[i] * strain[i].eps[0]);
        let potential = Taylor::new(half_work * (0.5 * self.length), power * self.length, S::zero());
        Action { potential, magnitude: damped[0] }
    }
}

/// Components along the axes of a frame, put in the world's.
fn in_world<S: Scalar, const D: usize>(frame: &Frame<Moving<S>, D>, v: &Vector<S>) -> Vector<S> {
    match D {
        2 => from_fn(|i| if i < 2 { frame.axes[0][i].re * v[0] + frame.axes[1][i].re * v[1] } else { v[2] }),
        _ => from_fn(|i| dot3(&from_fn(|j| frame.axes[j][i].re), v)),
    }
}
