//! Places of frames: `pos` with one of `quat`, `axisangle`, `xyaxes`, `zaxis` and `euler`.

use super::settings::MjcfSettings;
use crate::body::{aim, cross, norm};
use crate::error::Result;
use crate::import::transform::{Transform, UNTURNED, about};
use crate::import::xml::{Element, faulty, place as place_of_node};
use crate::math::array::Each;
use crate::math::rotation::{quaternion_from_axes, quaternion_from_vector, quaternion_product};

impl MjcfSettings {
    /// The frame of an element.
    pub fn place(&self, element: &Element) -> Result<Transform> {
        let r = element.numbers("pos")?.unwrap_or_default();
        let turn = self.turn(element).map_err(|error| error.placed(place_of_node(element.node)))?;
        Ok(Transform { r, turn })
    }

    fn turn(&self, element: &Element) -> Result<[f64; 4]> {
        if let Some([x, y, z, angle]) = element.numbers("axisangle")? {
            let axis = aim(Some([x, y, z]), None)?[2];
            return Ok(quaternion_from_vector(&axis.each(|x| x * angle * self.unit)));
        }
        if let Some([a, b, c, d, e, f]) = element.numbers("xyaxes")? {
            let x = [a, b, c];
            return Ok(quaternion_from_axes(&aim(Some(cross(&x, &[d, e, f])), Some(x))?));
        }
        if let Some(z) = element.numbers("zaxis")? {
            return Ok(from_z_to(aim(Some(z), None)?[2]));
        }
        if let Some(angles) = element.numbers("euler")? {
            return Ok(self.euler(angles));
        }
        let Some(quaternion) = element.numbers::<4>("quat")? else { return Ok(UNTURNED) };
        let size = quaternion.iter().map(|x| x * x).sum::<f64>().sqrt();
        if size > 0.0 { Ok(quaternion.each(|x| x / size)) } else { Err(faulty(element.node, "the quaternion is zero")) }
    }

    /// The n-th angle about the n-th axis: about those of the frame as it has turned, or about those that stand.
    fn euler(&self, angles: [f64; 3]) -> [f64; 4] {
        self.euler.iter().zip(angles).fold(UNTURNED, |turn, ((axis, is_fixed), angle)| {
            let next = about(*axis, angle * self.unit);
            if *is_fixed { quaternion_product(&next, &turn) } else { quaternion_product(&turn, &next) }
        })
    }
}

/// The shortest rotation that turns z to a unit vector.
pub fn from_z_to(unit: [f64; 3]) -> [f64; 4] {
    let across = cross(&[0.0, 0.0, 1.0], &unit);
    let sine = norm(&across);
    if sine == 0.0 {
        return if unit[2] > 0.0 { UNTURNED } else { about(0, std::f64::consts::PI) };
    }
    quaternion_from_vector(&across.each(|x| x * sine.atan2(unit[2]) / sine))
}
