//! The explicit method that an automatic choice begins with.

use crate::math::expression::Switch;
use crate::system::MechanicalSystem;
use crate::tolerances::simulate as tolerances;

/// At tight tolerances `adams` takes half of the evaluations of `dop853`, unless it begins anew again and again, or a
/// cubic signal, such as a road, has jumps in its third derivative.
pub fn first_explicit(system: &dyn MechanicalSystem, rtol: f64) -> &'static str {
    let has_few =
        |switch: &Switch| switch.signal.is_none() && switch.thresholds.get(tolerances::THRESHOLDS_OF_ADAMS).is_none();
    if rtol <= tolerances::RTOL_OF_ADAMS && system.switches().iter().all(has_few) { "adams" } else { "dop853" }
}
