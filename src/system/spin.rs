//! A constant rotation of everything that moves about a fixed axis, and its effect on the coordinates of bodies.
//!
//! Seen from axes that rotate with W, a body at rest has the velocity and the acceleration of the axes. With v measured
//! in the axes, the components of its velocity in space are v + W xi(q), and those of its acceleration v' + b(q, v):
//!
//! ```text
//! places          W xi = W x (r - p)       b = 2 W x v + W x (W x (r - p))
//! body axes       W xi = w = R^T W         b = -v x w
//! ```

use crate::body::cross;
use crate::math::array::{Each, from_fn};
use crate::math::rotation::{axes_from_quaternion, quaternion_from_vector, quaternion_product};

/// A rotation about a fixed axis at a constant speed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spin {
    /// Angular velocity W, rad/s, along the axis; (0, 0, w) in the plane.
    pub velocity: [f64; 3],
    /// A point of the axis, m.
    pub point: [f64; 3],
}

/// A unit quaternion [w, x, y, z] among the coordinates and the angular velocity in the body's axes that moves it, by
/// their first places.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rotation {
    /// First place in q.
    pub q: usize,
    /// First place in v.
    pub v: usize,
}

/// Coordinates of a body that change when the world is rotated, by their first places in q and v.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Placement {
    /// A position x, y(, z) in the world, m.
    Place {
        /// First place in q.
        q: usize,
        /// First place in v.
        v: usize,
        /// 2 in the plane, 3 in space.
        count: usize,
    },
    /// An angle in the plane, rad.
    Angle {
        /// Place in q.
        q: usize,
        /// Place in v.
        v: usize,
    },
    /// A unit quaternion with the angular velocity in the body's own axes, rad/s.
    Axes {
        /// First of four places in q.
        q: usize,
        /// First of three places in v.
        v: usize,
    },
}

/// A 3 x 3 matrix among the velocities from `first` on; only the first `size` rows and columns count.
#[derive(Clone, Copy, Debug)]
pub(super) struct SpinBlock {
    pub first: usize,
    pub size: usize,
    pub rows: [[f64; 3]; 3],
}

impl Spin {
    /// |W|, rad/s.
    pub fn speed(&self) -> f64 {
        self.velocity.iter().map(|w| w * w).sum::<f64>().sqrt()
    }

    /// First velocity of a placement, and their number.
    pub(super) fn velocities(placement: Placement) -> (usize, usize) {
        match placement {
            Placement::Place { v, count, .. } => (v, count),
            Placement::Angle { v, .. } => (v, 1),
            Placement::Axes { v, .. } => (v, 3),
        }
    }

    /// W xi(q)
    pub(super) fn carried(&self, placement: Placement, q: &[f64]) -> [f64; 3] {
        match placement {
            Placement::Place { q: first, count, .. } => {
                cross(&self.velocity, &from_fn(|k| if k < count { q[first + k] - self.point[k] } else { 0.0 }))
            }
            Placement::Angle { .. } => [self.velocity[2], 0.0, 0.0],
            Placement::Axes { q: first, .. } => {
                axes_from_quaternion(&q[first..first + 4]).each(|axis| crate::body::dot(&axis, &self.velocity))
            }
        }
    }

    /// b(q, v)
    pub(super) fn acceleration(&self, placement: Placement, q: &[f64], v: &[f64]) -> [f64; 3] {
        let (first, count) = Self::velocities(placement);
        let own = from_fn(|k| if k < count { v[first + k] } else { 0.0 });
        let carried = self.carried(placement, q);
        match placement {
            Placement::Place { .. } => {
                let coriolis = cross(&self.velocity, &own);
                let centripetal = cross(&self.velocity, &carried);
                from_fn(|k| 2.0 * coriolis[k] + centripetal[k])
            }
            Placement::Angle { .. } => [0.0; 3],
            Placement::Axes { .. } => cross(&carried, &own),
        }
    }

    /// d(W xi)/dq, d(b)/dq and d(b)/dv along the directions of v.
    pub(super) fn slopes(&self, placement: Placement, q: &[f64], v: &[f64]) -> [SpinBlock; 3] {
        let (first, size) = Self::velocities(placement);
        let block = |rows| SpinBlock { first, size, rows };
        let none = block([[0.0; 3]; 3]);
        match placement {
            Placement::Place { .. } => {
                let spin = skew(&self.velocity);
                [block(spin), block(product(&spin, &spin)), block(spin.each(|row| row.each(|x| 2.0 * x)))]
            }
            Placement::Angle { .. } => [none; 3],
            Placement::Axes { .. } => {
                // A rotation of the body by d changes w by w x d in its axes.
                let spin = skew(&self.carried(placement, q));
                let own = skew(&from_fn(|k| v[first + k]));
                let bent = product(&own, &spin).each(|row| row.each(|x| -x));
                [block(spin), block(bent), block(spin)]
            }
        }
    }

    /// Rotates q by `angle` about the axis.
    pub(super) fn turn(&self, placement: Placement, angle: f64, q: &mut [f64]) {
        let whole: [f64; 3] = self.velocity.each(|w| w / self.speed() * angle);
        let turn = quaternion_from_vector(&whole);
        match placement {
            Placement::Place { q: first, count, .. } => {
                let arm: [f64; 3] = from_fn(|k| if k < count { q[first + k] - self.point[k] } else { 0.0 });
                let turned = rotated(&turn, &arm);
                (0..count).for_each(|k| q[first + k] = self.point[k] + turned[k]);
            }
            Placement::Angle { q: place, .. } => q[place] += whole[2],
            Placement::Axes { q: first, .. } => {
                let turned = quaternion_product(&turn, &from_fn(|k| q[first + k]));
                q[first..first + 4].copy_from_slice(&turned);
            }
        }
    }

    /// Rotates a change along the velocity directions by `angle`; components in body axes do not change.
    pub(super) fn turn_directions(&self, placement: Placement, angle: f64, x: &mut [f64]) {
        if let Placement::Place { v, count, .. } = placement {
            let turn = quaternion_from_vector(&self.velocity.each(|w| w / self.speed() * angle));
            let turned = rotated(&turn, &from_fn(|k| if k < count { x[v + k] } else { 0.0 }));
            x[v..v + count].copy_from_slice(&turned[..count]);
        }
    }
}

fn rotated(turn: &[f64; 4], x: &[f64; 3]) -> [f64; 3] {
    let axes = axes_from_quaternion(turn);
    from_fn(|k| (0..3).map(|j| axes[j][k] * x[j]).sum())
}

/// The matrix of the cross product: skew(a) x = a x x.
pub(super) fn skew(a: &[f64; 3]) -> [[f64; 3]; 3] {
    let [x, y, z] = a;
    [[0.0, -z, *y], [*z, 0.0, -x], [-y, *x, 0.0]]
}

fn product(a: &[[f64; 3]; 3], b: &[[f64; 3]; 3]) -> [[f64; 3]; 3] {
    from_fn(|i| from_fn(|j| (0..3).map(|k| a[i][k] * b[k][j]).sum()))
}
