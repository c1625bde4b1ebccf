//! Rigid body in space: centre of mass, unit quaternion [w, x, y, z] and angular velocity in the body's axes.

use super::{BodyFacts, BodyKernel, BodyState, Energy, Frame, Freedom, Marker, Pose, Wrench, cross, dot, sub};
use crate::math::Scalar;
use crate::math::array::from_fn;
use crate::math::rotation::{Matrix3, axes_from_quaternion, quaternion_rate};

/// M = diag(m, m, m, J) with J constant in the body's axes; f = (m g, -w x J w).
pub struct RigidSpatial<const D: usize> {
    pub mass: f64,
    pub inertia: Matrix3,
    pub markers: Vec<Marker<D>>,
}

impl<const D: usize> RigidSpatial<D> {
    fn has_products(&self) -> bool {
        self.inertia[1][0] != 0.0 || self.inertia[2][0] != 0.0 || self.inertia[2][1] != 0.0
    }

    fn angular_momentum<S: Scalar>(&self, w: &[S]) -> [S; 3] {
        from_fn(|i| w[0] * self.inertia[i][0] + w[1] * self.inertia[i][1] + w[2] * self.inertia[i][2])
    }
}

impl<const D: usize> BodyKernel<D> for RigidSpatial<D> {
    fn facts(&self) -> BodyFacts {
        let diagonal = (0..6).map(|i| (i, i));
        let products: &[_] = if self.has_products() { &[(4, 3), (5, 3), (5, 4)] } else { &[] };
        BodyFacts {
            mass_pattern: diagonal.chain(products.iter().copied()).collect(),
            // C of the rotations.
            tangent_pattern: (3..6).flat_map(|i| (3..6).map(move |j| (i, j))).collect(),
            turning: Some(3),
            freedom: Some(Freedom::all(D)),
            ..BodyFacts::new(["x", "y", "z", "qw", "qx", "qy", "qz"], ["x'", "y'", "z'", "wx", "wy", "wz"])
        }
    }
    fn markers(&self) -> &[Marker<D>] {
        &self.markers
    }
    fn pose(&self, q: &[f64], v: &[f64]) -> Pose<D> {
        Pose::in_space(q, v)
    }

    /// x' = v, and for the quaternion p' = p (0, w) / 2.
    fn rate<S: Scalar>(&self, q: &[S], v: &[S], qdot: &mut [S]) {
        qdot[..3].copy_from_slice(&v[..3]);
        quaternion_rate(&q[3..7], &v[3..6], &mut qdot[3..7]);
    }

    #[inline]
    fn frame<S: Scalar>(&self, q: &[S]) -> Frame<S, D> {
        let axes = axes_from_quaternion(&q[3..7]);
        Frame { r: from_fn(|i| q[i]), axes: from_fn(|i| from_fn(|k| axes[i][k])), turn: S::zero() }
    }

    #[inline]
    fn pull_back<S: Scalar>(&self, q: &[S], frame: &Frame<S, D>, wrench: &Wrench<S, D>, f: &mut [S]) {
        let centre: [S; D] = from_fn(|i| q[i]);
        let arm = cross(&sub(&frame.r, &centre), &wrench.force);
        let moment: [S; 3] = from_fn(|i| wrench.torque[i] + arm[i]);
        f.iter_mut().zip(wrench.force).for_each(|(f, force)| *f += force);
        for (f, axis) in f[3..].iter_mut().zip(&axes_from_quaternion(&q[3..7])) {
            *f += dot(axis, &moment);
        }
    }

    fn mass(&self, values: &mut [f64]) {
        let j = &self.inertia;
        let all = [self.mass, self.mass, self.mass, j[0][0], j[1][1], j[2][2], j[1][0], j[2][0], j[2][1]];
        values.iter_mut().zip(all).for_each(|(value, entry)| *value = entry);
    }
    fn own_forces<S: Scalar>(&self, _q: &[S], v: &[S], gravity: &[f64; D], f: &mut [S]) {
        f.iter_mut().zip(gravity).for_each(|(f, g)| *f += S::constant(self.mass * g));
        let w = [v[3], v[4], v[5]];
        let gyroscopic = cross(&w, &self.angular_momentum(&w));
        f[3..].iter_mut().zip(gyroscopic).for_each(|(f, g)| *f -= g);
    }
    /// C = d(w x J w)/dw
    fn tangent(&self, at: BodyState<D>, _k: &mut [f64], c: &mut [f64]) {
        let w = [at.v[3], at.v[4], at.v[5]];
        let momentum = self.angular_momentum(&w);
        for j in 0..3 {
            let unit: [f64; 3] = from_fn(|i| f64::from(u8::from(i == j)));
            let turned = cross(&unit, &momentum);
            let changed = cross(&w, &self.angular_momentum(&unit));
            (0..3).for_each(|i| c[3 * i + j] += turned[i] + changed[i]);
        }
    }
    fn energy<S: Scalar>(&self, q: &[S], v: &[S], gravity: &[f64; D]) -> Energy<S> {
        let w = [v[3], v[4], v[5]];
        let translation = dot(&[v[0], v[1], v[2]], &[v[0], v[1], v[2]]);
        let height = q.iter().zip(gravity).fold(S::zero(), |sum, (&q, g)| sum - q * *g);
        Energy {
            kinetic: (translation * self.mass + dot(&w, &self.angular_momentum(&w))) * 0.5,
            potential: height * self.mass,
        }
    }
    fn normalize(&self, q: &mut [f64]) {
        let norm = q[3..7].iter().map(|x| x * x).sum::<f64>().sqrt();
        q[3..7].iter_mut().for_each(|x| *x /= norm);
    }
}
