//! Moments of inertia of a rigid body as a scene gives them.

use super::{Build, dot};
use crate::error::{Error, Result, short};
use crate::math::array::from_fn;
use crate::math::expression::Number;
use crate::math::rotation::Matrix3;
use crate::tolerances::SIX_DIGITS;
use nalgebra::{Matrix3 as Tensor, SymmetricEigen};
use schemars::JsonSchema;
use serde::Deserialize;

#[derive(Deserialize, JsonSchema)]
#[serde(untagged, expecting = "expected a number, an expression such as \"m*l^2/12\", or a list of these")]
pub enum Inertia {
    Moment(Number),
    Tensor(Vec<Number>),
}

fn present(given: &Option<Inertia>) -> Result<&Inertia> {
    given.as_ref().ok_or_else(|| {
        Error::input("the key `inertia` is missing").hint("only a body that cannot turn, by its \"free\", needs none")
    })
}

/// Moment of inertia in the plane, kg m^2.
pub fn planar<const D: usize>(given: &Option<Inertia>, build: &Build<D>) -> Result<f64> {
    match present(given)? {
        Inertia::Moment(moment) => build.not_negative("inertia", moment),
        Inertia::Tensor(numbers) => Err(Error::input(format!("expected one number, found {}", numbers.len()))
            .under("inertia")
            .hint("a planar body has one moment of inertia, about its centre of mass")),
    }
}

/// Moment about the only axis about which a body turns, given in its axes, kg m^2. As the others do not count, they may
/// be zero.
pub fn about<const D: usize>(given: &Option<Inertia>, axis: &[f64; 3], build: &Build<D>) -> Result<f64> {
    if let Inertia::Moment(moment) = present(given)? {
        return build.not_negative("inertia", moment);
    }
    let tensor = entries(given, build)?;
    let moment = moment(&tensor, axis);
    if moment >= 0.0 {
        Ok(moment)
    } else {
        Err(Error::input(format!("the moment about the axis of rotation is {}", short(moment)))
            .under("inertia")
            .hint("it cannot be negative"))
    }
}

/// Moment about an axis through the centre of mass.
pub fn moment(tensor: &Matrix3, axis: &[f64; 3]) -> f64 {
    dot(axis, &from_fn(|i| dot(&tensor[i], axis)))
}

/// Inertia tensor of a body that turns about all axes.
pub fn tensor<const D: usize>(given: &Option<Inertia>, build: &Build<D>) -> Result<Matrix3> {
    let tensor = entries(given, build)?;
    physical(&tensor)?;
    Ok(tensor)
}

fn entries<const D: usize>(given: &Option<Inertia>, build: &Build<D>) -> Result<Matrix3> {
    let numbers = match present(given)? {
        Inertia::Tensor(numbers) if numbers.len() == 3 => {
            let [x, y, z] = build.vector::<3>("inertia", numbers)?;
            [x, y, z, 0.0, 0.0, 0.0]
        }
        Inertia::Tensor(numbers) if numbers.len() == 6 => build.vector::<6>("inertia", numbers)?,
        _ => {
            let found = if let Some(Inertia::Tensor(numbers)) = given { numbers.len() } else { 1 };
            return Err(Error::input(format!("expected 3 or 6 numbers, found {found}"))
                .under("inertia")
                .hint("a spatial body has [Ixx, Iyy, Izz] or [Ixx, Iyy, Izz, Ixy, Ixz, Iyz]"));
        }
    };
    let [xx, yy, zz, xy, xz, yz] = numbers;
    let tensor = [[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]];
    Ok(tensor)
}

/// Refuses an inertia tensor that no mass distribution has: principal moments must be >= 0 and each at most the sum of
/// the other two.
pub fn physical(tensor: &Matrix3) -> Result<()> {
    let mut moments: Vec<f64> =
        SymmetricEigen::new(Tensor::from_fn(|i, j| tensor[i][j])).eigenvalues.iter().copied().collect();
    moments.sort_by(f64::total_cmp);
    let slack = SIX_DIGITS * moments[2].abs();
    if moments[0] < -slack {
        return Err(Error::input(format!(
            "a principal moment of inertia is {}, but cannot be negative",
            short(moments[0])
        ))
        .under("inertia")
        .hint("check the signs, and the order Ixx, Iyy, Izz, Ixy, Ixz, Iyz"));
    }
    if moments[2] > moments[0] + moments[1] + slack {
        let a = short(moments[0]);
        let b = short(moments[1]);
        let c = short(moments[2]);
        return Err(Error::input(format!("principal moments {a}, {b}, {c} violate the triangle inequality"))
            .under("inertia")
            .hint("no body has one principal moment above the sum of the other two: check units and signs"));
    }
    Ok(())
}
