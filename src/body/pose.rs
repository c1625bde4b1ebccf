//! Pose and twist of a body's own frame, and the velocities of a rigid body as components of that twist.

use super::{Frame, Marker, Wrench, cross, sub, twist_len};
use crate::math::rotation::axes_from_quaternion;
use crate::math::Taylor;
use std::array::from_fn;

/// Position, orientation and twist of a body's own frame, marker 0; deformation does not change them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pose<const D: usize> {
    /// Origin in the world, m.
    pub r: [f64; D],
    /// `axes[i]` is its i-th unit axis in the world.
    pub axes: [[f64; D]; D],
    /// Angle in the plane, rad; zero in space.
    pub turn: f64,
    /// Velocity of the origin in the world, m/s.
    pub velocity: [f64; D],
    /// Angular velocity in the world, rad/s.
    pub spin: [f64; 3],
}

impl<const D: usize> Pose<D> {
    /// The ground.
    pub fn ground() -> Self {
        (&Frame::world()).into()
    }

    /// Pose in the plane from x, y, angle and their rates.
    #[inline]
    pub fn in_plane(q: [f64; 3], v: [f64; 3]) -> Self {
        let (s, c) = q[2].sin_cos();
        let axes = [[c, s], [-s, c]];
        Pose {
            r: from_fn(|i| q[i]),
            axes: from_fn(|i| from_fn(|k| axes[i][k])),
            turn: q[2],
            velocity: from_fn(|i| v[i]),
            spin: [0.0, 0.0, v[2]],
        }
    }

    /// Pose in space from position, unit quaternion, velocity and the angular velocity in the body's own axes.
    #[inline]
    pub fn in_space(q: &[f64], v: &[f64]) -> Self {
        let own = axes_from_quaternion(&q[3..7]);
        Pose {
            r: from_fn(|i| q[i]),
            axes: from_fn(|i| from_fn(|k| own[i][k])),
            turn: 0.0,
            velocity: from_fn(|i| v[i]),
            spin: from_fn(|k| own[0][k] * v[3] + own[1][k] * v[4] + own[2][k] * v[5]),
        }
    }

    /// A vector given in the body's axes, in the world.
    #[inline]
    pub fn rotated(&self, own: &[f64; D]) -> [f64; D] {
        from_fn(|k| {
            let rest = (1..D).map(|j| self.axes[j][k] * own[j]);
            rest.fold(self.axes[0][k] * own[0], |sum, part| sum + part)
        })
    }

    /// A vector a fixed in the body along its motion at v' = 0: a, w x a, w x (w x a). The angular acceleration is zero:
    /// w is constant in the body's axes or in the world's, and w x w = 0.
    #[inline]
    pub fn carried(&self, own: &[f64; D]) -> [Taylor<f64>; D] {
        let a = self.rotated(own);
        let rate = self.swept(&a);
        let second = self.swept(&rate);
        from_fn(|k| Taylor::new(a[k], rate[k], second[k]))
    }

    /// w x a
    #[inline]
    fn swept(&self, a: &[f64; D]) -> [f64; D] {
        let [x, y, z] = self.spin;
        let mut rate = [0.0; D];
        (rate[0], rate[1]) = (-z * a[1], z * a[0]);
        if D == 3 {
            rate[0] += y * a[2];
            rate[1] -= x * a[2];
            rate[2] = x * a[1] - y * a[0];
        }
        rate
    }

    /// The origin along its motion at v' = 0.
    #[inline]
    pub fn origin(&self) -> [Taylor<f64>; D] {
        from_fn(|k| Taylor::new(self.r[k], self.velocity[k], 0.0))
    }

    /// The frame of a marker fixed to the body, with its velocity and its acceleration at v' = 0.
    #[inline]
    pub fn frame(&self, marker: &Marker<D>) -> Frame<Taylor<f64>, D> {
        let (origin, arm) = (self.origin(), self.carried(&marker.offset));
        Frame {
            r: from_fn(|k| origin[k] + arm[k]),
            axes: marker.axes.map(|axis| self.carried(&axis)),
            turn: Taylor::new(self.turn + marker.turn, if D == 2 { self.spin[2] } else { 0.0 }, 0.0),
        }
    }
}

impl<const D: usize> From<&Frame<Taylor<f64>, D>> for Pose<D> {
    fn from(frame: &Frame<Taylor<f64>, D>) -> Self {
        let Frame { r, axes, turn } = frame.map(|x| x.x);
        Pose { r, axes, turn, velocity: frame.velocity(), spin: frame.angular_velocity() }
    }
}

/// The velocities of a rigid body as components of its twist: the velocity of the origin in the world, then the angular
/// velocity (in the plane its only component). The acceleration of the origin and the angular acceleration are zero at
/// v' = 0.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Freedom {
    /// Component of the twist that each velocity is: 0 to 2 in the plane, 0 to 5 in space.
    pub components: Vec<usize>,
    /// True if the angular velocity is measured in the body's axes and not in the world's.
    pub in_own_axes: bool,
}

impl Freedom {
    /// All components, in their order, with the angular velocity in the body's axes.
    pub fn all(dimension: usize) -> Self {
        Freedom { components: (0..twist_len(dimension)).collect(), in_own_axes: true }
    }

    /// Generalized forces of a force and a moment about the origin, one for each component of the twist.
    #[inline]
    pub fn twist_forces<const D: usize>(&self, pose: &Pose<D>, force: &[f64; D], moment: &[f64; 3]) -> [f64; 6] {
        let mut all = [0.0; 6];
        all[..D].copy_from_slice(force);
        if D == 2 {
            all[2] = moment[2];
            return all;
        }
        for i in 0..3 {
            all[3 + i] = if self.in_own_axes { (0..D).map(|k| pose.axes[i][k] * moment[k]).sum() } else { moment[i] };
        }
        all
    }

    /// f += J^T w for a wrench at the place `r`.
    #[inline]
    pub fn pull_back<const D: usize>(&self, pose: &Pose<D>, r: &[f64; D], wrench: &Wrench<f64, D>, f: &mut [f64]) {
        let arm = cross(&sub(r, &pose.r), &wrench.force);
        let all = self.twist_forces(pose, &wrench.force, &from_fn(|i| wrench.torque[i] + arm[i]));
        f.iter_mut().zip(&self.components).for_each(|(f, &component)| *f += all[component]);
    }
}

/// A marker as if fixed to its body's own frame, or to the ground.
pub struct Carried<'a, const D: usize> {
    /// Pose of the body's own frame; `None` is the ground.
    pub body: Option<Pose<D>>,
    /// Marker in the body's axes.
    pub marker: &'a Marker<D>,
}

impl<const D: usize> Carried<'_, D> {
    /// Its i-th axis in the world.
    #[inline]
    pub fn axis(&self, i: usize) -> [f64; D] {
        let own = self.marker.axes[i];
        self.body.as_ref().map_or(own, |pose| pose.rotated(&own))
    }

    /// Its angular velocity in the world, rad/s.
    #[inline]
    pub fn spin(&self) -> [f64; 3] {
        self.body.map_or([0.0; 3], |body| body.spin)
    }

    /// Angle of the marker in the plane, rad.
    pub fn turn(&self) -> f64 {
        self.body.map_or(0.0, |body| body.turn) + self.marker.turn
    }
}
