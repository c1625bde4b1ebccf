//! Places of frames.

use crate::math::rotation::{axes_from_quaternion, quaternion_from_vector, quaternion_product};
use std::array::from_fn;

/// Position and unit quaternion [w, x, y, z] of a frame in another.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Transform {
    pub r: [f64; 3],
    pub turn: [f64; 4],
}

impl Default for Transform {
    fn default() -> Self {
        Transform { r: [0.0; 3], turn: [1.0, 0.0, 0.0, 0.0] }
    }
}

impl Transform {
    /// `xyz` and `rpy` of an origin: rotations about the fixed x, y and z axes, in this order.
    pub fn new(r: [f64; 3], [roll, pitch, yaw]: [f64; 3]) -> Self {
        let about = |axis: usize, angle: f64| quaternion_from_vector(&from_fn(|i| if i == axis { angle } else { 0.0 }));
        let turn = quaternion_product(&about(2, yaw), &quaternion_product(&about(1, pitch), &about(0, roll)));
        Transform { r, turn }
    }

    /// `axes[i]`: the i-th axis of the frame.
    pub fn axes(&self) -> [[f64; 3]; 3] {
        axes_from_quaternion(&self.turn)
    }

    pub fn rotated(&self, v: &[f64; 3]) -> [f64; 3] {
        let axes = self.axes();
        from_fn(|k| (0..3).map(|i| axes[i][k] * v[i]).sum())
    }

    /// A frame that is given in this one.
    pub fn then(&self, inner: &Transform) -> Transform {
        let arm = self.rotated(&inner.r);
        Transform { r: from_fn(|i| self.r[i] + arm[i]), turn: quaternion_product(&self.turn, &inner.turn) }
    }

    pub fn inverse(&self) -> Transform {
        let [w, x, y, z] = self.turn;
        let back = Transform { r: [0.0; 3], turn: [w, -x, -y, -z] };
        Transform { r: back.rotated(&self.r).map(|x| -x), ..back }
    }
}
