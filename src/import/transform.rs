//! Places of frames.

use crate::body::MassProperties;
use crate::math::array::{Each, from_fn};
use crate::math::rotation::{Matrix3, axes_from_quaternion, quaternion_from_vector, quaternion_product};

/// The unit quaternion of no rotation.
pub const UNTURNED: [f64; 4] = [1.0, 0.0, 0.0, 0.0];

/// Unit quaternion of a rotation about an axis of the frame.
pub fn about(axis: usize, angle: f64) -> [f64; 4] {
    quaternion_from_vector(&from_fn(|i| if i == axis { angle } else { 0.0 }))
}

/// Position and unit quaternion [w, x, y, z] of a frame in another.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Transform {
    pub r: [f64; 3],
    pub turn: [f64; 4],
}

impl Default for Transform {
    fn default() -> Self {
        Transform { r: [0.0; 3], turn: UNTURNED }
    }
}

impl Transform {
    /// `xyz` and `rpy` of an origin: rotations about the fixed x, y and z axes, in this order.
    pub fn new(r: [f64; 3], angles: [f64; 3]) -> Self {
        let turn =
            [0, 1, 2].iter().fold(UNTURNED, |turn, axis| quaternion_product(&about(*axis, angles[*axis]), &turn));
        Transform { r, turn }
    }

    /// The same motion about a fixed point that is not the origin.
    pub fn about(self, point: &[f64; 3]) -> Self {
        let arm = self.rotated(point);
        Transform { r: from_fn(|i| self.r[i] + point[i] - arm[i]), ..self }
    }

    /// The tensor, given in the axes of this frame, in those of the outer one.
    pub fn tensor(&self, tensor: &Matrix3) -> Matrix3 {
        let columns = tensor.each(|row| self.rotated(&row));
        from_fn(|i| self.rotated(&columns.each(|column| column[i])))
    }

    /// Mass properties, given in this frame, in the outer one.
    pub fn mass(&self, given: &MassProperties) -> MassProperties {
        let arm = self.rotated(&given.centre);
        MassProperties {
            mass: given.mass,
            centre: from_fn(|i| self.r[i] + arm[i]),
            inertia: self.tensor(&given.inertia),
        }
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
        Transform { r: back.rotated(&self.r).each(|x| -x), ..back }
    }
}
