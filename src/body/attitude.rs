//! Orientation and angular velocity of a body: enough for angles, without the positions of its markers.

use super::{Frame, Marker};
use crate::math::Taylor;
use crate::math::rotation::axes_from_quaternion;
use std::array::from_fn;

/// Orientation and angular velocity of a body's own frame, marker 0; deformation does not change a counted angle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Attitude<const D: usize> {
    /// `axes[i]` is its i-th unit axis in the world.
    pub axes: [[f64; D]; D],
    /// Angle in the plane, rad; zero in space.
    pub turn: f64,
    /// Angular velocity in the world, rad/s.
    pub spin: [f64; 3],
}

impl<const D: usize> Attitude<D> {
    /// Attitude in space from a unit quaternion and the angular velocity in the body's own axes, rad/s.
    #[inline]
    pub fn of_quaternion(p: &[f64], w: &[f64]) -> Self {
        let own = axes_from_quaternion(p);
        let axes = from_fn(|i| from_fn(|k| own[i][k]));
        Attitude { axes, turn: 0.0, spin: from_fn(|k| own[0][k] * w[0] + own[1][k] * w[1] + own[2][k] * w[2]) }
    }
}

impl<const D: usize> From<&Frame<Taylor<f64>, D>> for Attitude<D> {
    fn from(frame: &Frame<Taylor<f64>, D>) -> Self {
        let axes = frame.axes.map(|axis| axis.map(|x| x.x));
        Attitude { axes, turn: frame.turn.x, spin: frame.angular_velocity() }
    }
}

/// A marker as if fixed to its body's own frame, or to the ground.
pub struct Carried<'a, const D: usize> {
    /// Attitude of the body's own frame; `None` is the ground.
    pub body: Option<Attitude<D>>,
    /// Marker in the body's axes.
    pub marker: &'a Marker<D>,
}

impl<const D: usize> Carried<'_, D> {
    /// Its i-th axis in the world.
    #[inline]
    pub fn axis(&self, i: usize) -> [f64; D] {
        let own = self.marker.axes[i];
        let Some(Attitude { axes, .. }) = &self.body else { return own };
        let mut axis = axes[0].map(|x| x * own[0]);
        for j in 1..D {
            (0..D).for_each(|k| axis[k] += axes[j][k] * own[j]);
        }
        axis
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
