//! Beam: a massless elastic beam between two frames, geometrically exact.
//!
//! The strains are those of a helix: the frames at its ends differ by a screw motion H, whose logarithm divided by the
//! length gives extension, shear, twist and curvature, constant along the element and zero in every rigid motion
//! (Sonneville, Cardona and Bruls, Geometrically exact beam finite element formulated on the special Euclidean group
//! SE(3), Comput. Methods Appl. Mech. Engrg. 268 (2014) 451-474).

mod half;
mod line;
mod spec;
mod station;
mod strain;

pub use half::{Half, Load};
pub use spec::BeamForce;
pub use station::Station;
pub use strain::Beam;

use super::{Action, ForceKernel, Instant, Motion};
use crate::body::{Frame, Wrench, dot};
use crate::math::array::{Each, from_fn};
use crate::math::screw::{Vector, cross3, dot3, planar_pull_back, pull_back};
use crate::math::{Dual, Scalar, Taylor};
use station::SectionForces;
use strain::{Strains, components};

/// A value with its rate.
pub(crate) type Moving<S> = Dual<S, 1>;

impl<const D: usize> ForceKernel<D> for Beam {
    fn act<S: Scalar>(&self, frames: &Motion<S, D>, _: Instant<S>, out: &mut [Wrench<S, D>]) -> Action<S> {
        let [a, b] = [&frames[0], &frames[1]].each(|frame| frame.map(|x| Moving { re: x.x, eps: [x.d] }));
        let strains = Strains::between(&a, &b);
        let strain = self.strain::<_, D>(&strains);
        let mut damped = [S::zero(); 6];
        let mut twice_stored = S::zero();
        let mut power = S::zero();
        for &i in components::<D>() {
            let stretched = strain[i].re - self.rest[i];
            let rate = strain[i].eps[0];
            let elastic = stretched * self.stiffness[i];
            damped[i] = elastic + rate * (self.damping * self.stiffness[i]);
            twice_stored += elastic * stretched;
            power += elastic * rate;
        }
        let [first, last] = self.carried::<_, D>(&strains, &damped);
        // The elastic forces oppose the strain.
        let force = in_world(&a, &last.n.each(|x| -x));
        let torque = in_world(&a, &last.m.each(|x| -x));
        out[1] = Wrench { force: from_fn(|i| force[i]), torque };
        out[0] = Wrench { force: from_fn(|i| -force[i]), torque: in_world(&a, &first.m) };
        let potential = Taylor::new(twice_stored * (0.5 * self.length), power * self.length, S::zero());
        Action { potential, magnitude: damped[0] }
    }

    fn depends_on_velocities(&self) -> bool {
        self.damping > 0.0
    }

    fn beam(&self) -> Option<&Beam> {
        Some(self)
    }
}

impl Beam {
    /// Internal forces of the sections at both ends for these stresses, with no load on the element between them.
    fn carried<S: Scalar, const D: usize>(&self, strains: &Strains<S>, stress: &[S; 6]) -> [SectionForces<S>; 2] {
        let [n, m] = self.conjugate::<_, D>(strains, stress);
        let turn = strains.turn.each(|x| x.re);
        let gap = strains.gap.each(|x| x.re);
        if D == 2 {
            let ([nx, ny], torque) = planar_pull_back(turn[2], [gap[0], gap[1]], [n[0], n[1]], m[2]);
            let n = [nx, ny, n[2]];
            let lever = gap[0] * ny - gap[1] * nx;
            return [torque + lever, torque].each(|torque| SectionForces { n, m: [m[0], m[1], torque] });
        }
        let [n, m] = pull_back(&turn, &gap, &n, &m);
        let lever = cross3(&gap, &n);
        [SectionForces { n, m: from_fn(|i| m[i] + lever[i]) }, SectionForces { n, m }]
    }
}

/// World components of a vector given along the axes of a frame.
fn in_world<S: Scalar, const D: usize>(frame: &Frame<Moving<S>, D>, v: &Vector<S>) -> Vector<S> {
    match D {
        2 => from_fn(|i| if i < 2 { frame.axes[0][i].re * v[0] + frame.axes[1][i].re * v[1] } else { v[2] }),
        _ => from_fn(|i| dot3(&from_fn(|j| frame.axes[j][i].re), v)),
    }
}

/// Components of a world vector along the axes of a frame.
fn in_axes<S: Scalar, const D: usize>(frame: &Frame<Moving<S>, D>, v: &Vector<S>) -> Vector<S> {
    let own = from_fn(|k| v[k]);
    from_fn(|i| if i < D { dot(&frame.axes[i].each(|x| x.re), &own) } else { v[i] })
}
