//! When methods are compared with each other during a run, and which continues.

/// Automatic choice begins with adams at this rtol and below.
/// Unit: `[1]`. Why: above, dop853 takes as many evaluations or fewer. Test:
/// `tight_tolerances_of_smooth_motions_begin_with_adams`.
pub const RTOL_OF_ADAMS: f64 = 1e-6;

/// Automatic choice begins with adams where each switching function has so many thresholds at most.
/// Unit: `[thresholds]`. Why: a choice: each passage begins anew at order 1.
/// Test: `tight_tolerances_of_smooth_motions_begin_with_adams`.
pub const THRESHOLDS_OF_ADAMS: usize = 8;

/// Work before automatic choice looks at the steps first.
/// Unit: `[evaluations]`. Why: a choice: short runs try nothing. Test: none: not tried with other values.
pub const IMPLICIT_TRIED: f64 = 200.0;

/// How much farther a method must come for the same work to take over.
/// Unit: `[1]`. Why: a choice: an explicit method takes a few long steps before stability limits them, and bdf begins
/// with short ones. Test: none: not tried with other values.
pub const WORTH: f64 = 2.0;

/// Up to here a motion is begun again by a method that takes over.
/// Unit: `[1]` of the span. Why: a choice: it costs that method no more of its work. Test:
/// `what_takes_over_early_begins_at_the_start`.
pub const BEGINNING: f64 = 0.1;

/// What comes so much farther takes over before others have tried.
/// Unit: `[1]`. Why: a choice: first steps that still grow do not tell which of two methods is the better one. Test:
/// none: not tried with other values.
pub const FAR_AHEAD: f64 = 30.0;

/// What comes no farther than this is no alternative.
/// Unit: `[1]`. Why: a choice. Test: none: not tried with other values.
pub const NO_ALTERNATIVE: f64 = 0.5;

/// Runs that stop again so near are not helped by the other method.
/// Unit: `[1]` of the span. Why: a choice. Nor would augmented_lagrangian help at singular states: it comes over those
/// of n_four_bar, but 1e-4 to 1e-2 beside the motion. Test: none: not tried with other values.
pub const STOPS_AGAIN: f64 = 1e-6;

/// Work at most that an advice looks at at a time.
/// Unit: `[evaluations]`. Why: a choice. Test: none: not tried with other values.
pub const ADVICE_WORK: f64 = 2e4;

/// Work of an evaluation in implicit methods, with its share of factorizations and back-substitutions.
/// Unit: `[evaluations by explicit ones]`. Why: 2 to 4 on the shipped scenes, whatever their size. Test: none: not
/// tried with other values.
pub const IMPLICIT_WORK: f64 = 3.0;

/// Steps of an explicit method that are longer may be limited by stability.
/// Unit: `[1]` of the longest stable step. Why: with the steps that it refuses again and again they are a quarter of it
/// on average. Test: none: not tried with other values.
pub const STABILITY_HOLDS: f64 = 0.1;

/// Steps of an implicit method up to so long leave an explicit one worth trying.
/// Unit: `[1]` of the longest stable step. Why: a choice. Test: none: not tried with other values.
pub const EXPLICIT_AGAIN: f64 = 20.0;

/// The longest stable step of methods without a limit of their own.
/// Unit: `[1]`, |lambda| h. Why: that of dop853. Test: none: not tried with other values.
pub const STABLE_STEP: f64 = 6.1;

/// Least work of a trial.
/// Unit: `[evaluations]`. Why: the first steps of radau_iia, each up to five times the one before, and of bdf, each
/// twice. Test: none: not tried with other values.
pub const TRIAL_WORK: f64 = 300.0;

/// Work of a trial, and what it is worth of what is left.
/// Unit: `[1]` of the work it is compared with. Why: a choice. Test: none: not tried with other values.
pub const TRIAL_SHARE: f64 = 0.25;

/// Steps grow where the next one is so many times their mean.
/// Unit: `[1]`. Why: a choice. Test: none: not tried with other values.
pub const STEPS_GROW: f64 = 2.0;

/// How often a run that is watched goes on for that.
/// Unit: `[times]`. Why: a choice. Test: none: a count of work, not tried.
pub const WATCHED_AGAIN: usize = 5;

/// This part of the work that is left says enough of it.
/// Unit: `[1]`. Why: a choice. Test: none: not tried with other values.
pub const TRIAL_SHOWS: f64 = 0.1;
