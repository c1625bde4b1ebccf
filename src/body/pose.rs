//! Pose and twist of a body's own frame, and what the velocities of a rigid body are.

use super::frame::turned;
use super::{Frame, Marker, Wrench, cross, dot, in_space, sub, twist_len, unit_axes};
use crate::math::Taylor;
use crate::math::array::{Each, from_fn};
use crate::math::rotation::axes_from_quaternion;

/// Position, orientation and twist of a body's own frame, in which its markers are fixed; deformation does not change
/// them.
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
        from_fn(|k| (1..D).fold(self.axes[0][k] * own[0], |sum, j| sum + self.axes[j][k] * own[j]))
    }

    /// A vector in the world, in the body's axes.
    #[inline]
    pub fn own(&self, vector: &[f64; D]) -> [f64; D] {
        from_fn(|i| dot(&self.axes[i], vector))
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

    /// A point fixed in the body along its motion at v' = 0.
    #[inline]
    pub fn place(&self, offset: &[f64; D]) -> [Taylor<f64>; D] {
        let arm = self.carried(offset);
        from_fn(|k| Taylor::new(self.r[k] + arm[k].x, self.velocity[k] + arm[k].d, arm[k].dd))
    }

    /// The derivatives of a moving vector x relative to the body, in the axes of the world: x, x' - w x x and
    /// x'' - 2 w x x' + w x (w x x).
    #[inline]
    pub fn seen(&self, path: &[Taylor<f64>; D]) -> [Taylor<f64>; D] {
        let swept = self.swept(&path.each(|x| x.x));
        let coriolis = self.swept(&path.each(|x| x.d));
        let centripetal = self.swept(&swept);
        from_fn(|k| Taylor::new(path[k].x, path[k].d - swept[k], path[k].dd - 2.0 * coriolis[k] + centripetal[k]))
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

    /// The frame of a marker fixed to the body, with its velocity and its acceleration at v' = 0.
    #[inline(always)]
    pub fn frame(&self, marker: &Marker<D>) -> Frame<Taylor<f64>, D> {
        Frame {
            r: self.place(&marker.offset),
            axes: from_fn(|i| self.carried(&marker.axes[i])),
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

/// The velocities of a rigid body: components of the velocity of its origin in the world, then angular velocities about
/// axes fixed in it. At v' = 0 the acceleration of the origin and the angular acceleration are zero. A body with all
/// velocities has those of [`all`](Self::all).
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Freedom {
    /// World axes of the translations.
    pub translations: Vec<usize>,
    /// Axes of the rotations in the body's axes; in the plane the third.
    pub rotations: Vec<[f64; 3]>,
}

impl Freedom {
    /// All translations, and rotations about the body's own axes.
    pub fn all(dimension: usize) -> Self {
        let rotations = unit_axes::<f64, 3>()[first_rotation(dimension)..].to_vec();
        Freedom { translations: (0..dimension).collect(), rotations }
    }

    /// Number of velocities.
    #[inline]
    pub fn count(&self) -> usize {
        self.translations.len() + self.rotations.len()
    }

    /// Writes J^T (force, moment) for a force in the world and a moment about the origin in the body's axes.
    #[inline(always)]
    pub fn write<const D: usize>(&self, force: &[f64; D], moment: &[f64; 3], out: &mut [f64]) {
        if out.len() == twist_len(D) {
            out[..D].copy_from_slice(force);
            out[D..twist_len(D)].copy_from_slice(&moment[first_rotation(D)..]);
        } else if !out.is_empty() {
            self.write_some(force, moment, out);
        }
    }

    fn write_some<const D: usize>(&self, force: &[f64; D], moment: &[f64; 3], out: &mut [f64]) {
        let forces = self.translations.iter().map(|&i| force[i]);
        let moments = self.rotations.iter().map(|axis| dot(axis, moment));
        out.iter_mut().zip(forces.chain(moments)).for_each(|(out, component)| *out = component);
    }

    /// f += J^T w for a wrench at the place `r`.
    #[inline]
    pub fn pull_back<const D: usize>(&self, pose: &Pose<D>, r: &[f64; D], wrench: &Wrench<f64, D>, f: &mut [f64]) {
        let arm = cross(&sub(r, &pose.r), &wrench.force);
        let moment: [f64; 3] = from_fn(|i| wrench.torque[i] + arm[i]);
        let moment = if D == 2 { moment } else { in_space(&pose.own(&from_fn(|i| moment[i]))) };
        let mut forces = [0.0; 6];
        self.write(&wrench.force, &moment, &mut forces[..f.len()]);
        f.iter_mut().zip(forces).for_each(|(f, component)| *f += component);
    }
}

/// The first axis about which a body can turn: all three in space, the last in the plane.
const fn first_rotation(dimension: usize) -> usize {
    if dimension == 2 { 2 } else { 0 }
}

/// A marker as if fixed to its body's own frame, or to the ground.
pub struct Carried<'a, const D: usize> {
    /// Pose of the body's own frame, or of the ground.
    pub body: Pose<D>,
    /// Marker in the body's axes.
    pub marker: &'a Marker<D>,
}

impl<const D: usize> Carried<'_, D> {
    /// Its i-th axis in the world.
    #[inline]
    pub fn axis(&self, i: usize) -> [f64; D] {
        self.body.rotated(&self.marker.axes[i])
    }

    /// A direction in its axes, in the world.
    pub fn direction(&self, components: &[f64; 3]) -> [f64; D] {
        self.body.rotated(&turned(&self.marker.axes, components))
    }

    /// Its angular velocity in the world, rad/s.
    #[inline]
    pub fn spin(&self) -> [f64; 3] {
        self.body.spin
    }

    /// Angle of the marker in the plane, rad.
    pub fn turn(&self) -> f64 {
        self.body.turn + self.marker.turn
    }
}
