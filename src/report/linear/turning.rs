//! The speed at which a mechanism turns along a sweep.

use crate::linearize::{Loci, LociVariable};
use crate::math::bounds;
use crate::scene::units::Dimension;
use crate::tolerances::SAME;

/// Returns the speed of the rotation at the values of a parameter, rad/s: of the steady rotations where there are some;
/// else the parameter itself if its unit is one of angular velocity. Empty where the loci know of no rotation.
pub fn speeds(loci: &Loci, unit: &str) -> Vec<(f64, f64)> {
    let LociVariable::Parameter(_) = loci.along else { return Vec::new() };
    let size = if found(loci).next().is_some() { size(loci) } else { rad_per_s(unit) };
    match size {
        Some(size) => loci.places.iter().map(|place| (*place, size * place.abs())).collect(),
        None => found(loci).collect(),
    }
}

/// Returns the unit of a parameter that is itself the speed of the steady rotations; none where it is not.
pub(super) fn unit_of_speed(loci: &Loci) -> Option<&'static str> {
    let size = size(loci)?;
    let is_it = |name: &&str| rad_per_s(name).is_some_and(|unit| (unit / size - 1.0).abs() < SAME);
    Dimension::AngularVelocity.units().find(is_it)
}

/// The steady rotations: value of the parameter and speed in rad/s.
fn found(loci: &Loci) -> impl Iterator<Item = (f64, f64)> {
    loci.reached.iter().filter_map(|state| Some((state.at, state.turning?)))
}

/// Returns the speed of rotation for one unit of the parameter, rad/s; none where they are not proportional.
fn size(loci: &Loci) -> Option<f64> {
    let ratios: Vec<f64> = found(loci).map(|(value, speed)| speed / value.abs()).collect();
    let (least, most) = bounds(ratios.iter().copied());
    (ratios.len() > 1 && most.is_finite() && most - least <= SAME * most).then_some(most)
}

/// Returns the size of a unit of angular velocity, rad/s.
fn rad_per_s(unit: &str) -> Option<f64> {
    Dimension::AngularVelocity.unit(unit).ok().map(|unit| 1.0 / unit.per_si)
}
