//! Orientations as scenes give them: a rotation, or the directions of a z and an x axis.

use super::{Build, cross, dot, norm};
use crate::error::{Error, Result};
use crate::math::array::{Each, from_fn};
use crate::math::expression::Number;
use crate::math::rotation::{axes_from_quaternion, quaternion_from_vector};
use crate::tolerances;

/// The keys of an orientation in space; none of them is no rotation.
#[derive(Clone, Copy)]
pub struct Orientation<'a> {
    /// Unit quaternion [w, x, y, z] or rotation vector, rad.
    pub rotation: &'a Option<Vec<Number>>,
    /// Direction of the z axis.
    pub z_axis: &'a Option<Vec<Number>>,
    /// Direction of the x axis, made square to z.
    pub x_axis: &'a Option<Vec<Number>>,
}

impl Orientation<'_> {
    /// Name of the first key that is given.
    pub fn given(&self) -> Option<&'static str> {
        let keys = [("rotation", self.rotation), ("z_axis", self.z_axis), ("x_axis", self.x_axis)];
        keys.iter().find(|(_, given)| given.is_some()).map(|(key, _)| *key)
    }

    /// Right-handed unit axes, `[i]` being the i-th.
    pub fn axes<const D: usize>(&self, build: &Build<D>) -> Result<[[f64; 3]; 3]> {
        match self.aimed(build)? {
            Some(axes) => Ok(axes),
            None => Ok(axes_from_quaternion(&quaternion("rotation", self.rotation.as_deref(), build)?)),
        }
    }

    /// The axes, if they are given by their directions.
    pub fn aimed<const D: usize>(&self, build: &Build<D>) -> Result<Option<[[f64; 3]; 3]>> {
        if self.z_axis.is_none() && self.x_axis.is_none() {
            return Ok(None);
        }
        if self.rotation.is_some() {
            return Err(Error::input("both a rotation and axes are given").hint("keep one of them"));
        }
        let axis = |field: &str, numbers: &Option<Vec<Number>>| {
            numbers.as_ref().map(|numbers| build.vector::<3>(field, numbers)).transpose()
        };
        aim(axis("z_axis", self.z_axis)?, axis("x_axis", self.x_axis)?).map(Some)
    }
}

/// Right-handed unit axes [x, y, z] with the given z, and x the given one made orthogonal to z.
pub fn aim(z: Option<[f64; 3]>, x: Option<[f64; 3]>) -> Result<[[f64; 3]; 3]> {
    let unit = |v: [f64; 3], name: &str| -> Result<[f64; 3]> {
        let length = norm(&v);
        if length > tolerances::ROUND_OFF_OF_SOLUTIONS {
            Ok(v.each(|c| c / length))
        } else {
            Err(Error::input("the axis has no direction of its own")
                .under(name)
                .hint("give vectors that are not zero and not parallel"))
        }
    };
    let z = match (z, x) {
        (Some(z), _) => unit(z, "z_axis")?,
        // Only x given: z is the world axis least along it, made square to it.
        (None, x) => {
            let x = unit(x.unwrap_or([1.0, 0.0, 0.0]), "x_axis")?;
            let helper = if x[2].abs() < 0.9 { [0.0, 0.0, 1.0] } else { [0.0, 1.0, 0.0] };
            unit(without(helper, x), "x_axis")?
        }
    };
    let helper = x.unwrap_or(if z[0].abs() < 0.9 { [1.0, 0.0, 0.0] } else { [0.0, 1.0, 0.0] });
    let x = unit(without(helper, z), "x_axis")?;
    Ok([x, cross(&z, &x), z])
}

/// The part of `v` orthogonal to the unit vector `along`.
fn without(v: [f64; 3], along: [f64; 3]) -> [f64; 3] {
    let part = dot(&v, &along);
    from_fn(|i| v[i] - part * along[i])
}

/// Unit quaternion [w, x, y, z] from 4 numbers, or from a rotation vector of 3.
pub(crate) fn quaternion<const D: usize>(
    field: &str,
    numbers: Option<&[Number]>,
    build: &Build<D>,
) -> Result<[f64; 4]> {
    match numbers {
        None => Ok([1.0, 0.0, 0.0, 0.0]),
        Some(numbers) if numbers.len() == 3 => {
            let turn = build.vector::<3>(field, numbers)?;
            build.doubt_turns(field, norm(&turn));
            Ok(quaternion_from_vector(&turn))
        }
        Some(numbers) if numbers.len() == 4 => {
            let q = build.vector::<4>(field, numbers)?;
            let norm = q.iter().map(|x| x * x).sum::<f64>().sqrt();
            if norm < tolerances::SAME {
                return Err(Error::input("the quaternion is zero").under(field).hint("[1, 0, 0, 0] is no rotation"));
            }
            Ok(q.each(|x| x / norm))
        }
        Some(numbers) => Err(Error::input(format!("expected 4 or 3 numbers, found {}", numbers.len()))
            .under(field)
            .hint("give a quaternion [w, x, y, z] or a rotation vector [x, y, z] in radians")),
    }
}
