//! The explicit method that an automatic choice begins with.

use crate::math::expression::Switch;
use crate::system::MechanicalSystem;

/// Automatic choice begins with adams at this rtol and below. Unit: `[1]`. Why: above, dop853 takes as many evaluations
/// or fewer. Test: `tight_tolerances_of_smooth_motions_begin_with_adams`.
const RTOL_OF_ADAMS: f64 = 1e-6;

/// Automatic choice begins with adams where each switching function has so many thresholds at most. Unit:
/// `[thresholds]`. Why: each passage begins anew at order 1. Test:
/// `tight_tolerances_of_smooth_motions_begin_with_adams`.
const THRESHOLDS_OF_ADAMS: usize = 8;

/// At tight tolerances `adams` takes half of the evaluations of `dop853`, unless it begins anew again and again, or a
/// cubic signal, such as a road, has jumps in its third derivative.
pub fn first_explicit(system: &dyn MechanicalSystem, rtol: f64) -> &'static str {
    let has_few = |switch: &Switch| switch.signal.is_none() && switch.thresholds.get(THRESHOLDS_OF_ADAMS).is_none();
    if rtol <= RTOL_OF_ADAMS && system.switches().all.iter().all(has_few) { "adams" } else { "dop853" }
}
