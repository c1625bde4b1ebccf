//! Linear models, their eigenvalues, and the checks of them.

pub use super::modes::EIGENVALUES_AGREE;
pub use super::{ROUND_OFF_OF_FACTORS, ROUND_OFF_OF_SUMS, SAME};

/// States of a run are integrated at least so well.
/// Unit: `[1]`, rtol. Why: a choice. Test: none: not tried with other values.
pub const RUN_TOLERANCE: f64 = 1e-10;

/// Times up to which the growth of small changes is looked at.
/// Unit: `[times]`. Why: a choice. Test: none: not tried with other values.
pub const AMPLIFIED_TIMES: u32 = 20;

/// Degrees of freedom up to which it is.
/// Unit: `[degrees of freedom]`. Why: that many motions side by side. Test: none: a count of work, not tried.
pub const AMPLIFIED_FREEDOM: usize = 40;

/// Powers of ten within which the rate of the metric is sought.
/// Unit: `[log10 of 1/s]`. Why: a choice. Test: none: not tried with other values.
pub const RATES_SOUGHT: [f64; 2] = [-4.0, 8.0];

/// How often the range of these rates is made smaller by a third.
/// Unit: `[times]`. Why: (2/3)^20 of twelve decades: a hundredth of a power of e. Test: none: a count of work, not
/// tried.
pub const RATES_THIRDS: usize = 20;

/// A motion that misses its start by more is not periodic.
/// Unit: `[1]` of (1 + |q|, |v|). Why: a choice: a period written with six digits passes. Test: none: with a thousand
/// times more or less the tests of its room pass.
pub const PERIODIC: f64 = 1e-5;

/// Singular values of M - m that are none: so many vectors a multiplier has.
/// Unit: `[1]` of the largest. Why: the square root of FLOW_RTOL. Test: none: with a thousand times more or less the
/// tests of its room pass.
pub const NO_MULTIPLIER: f64 = 1e-6;

/// Tolerance of the variational equations.
/// Unit: `[1]`, rtol. Why: a choice: looser than round-off, tighter than what is compared with it. Test:
/// `an_upright_pendulum_is_unstable`.
pub const FLOW_RTOL: f64 = 1e-12;

/// Absolute tolerance of the columns of the variational equations, which are of size 1.
/// Unit: `[1]`. Why: a tenth of FLOW_RTOL. Test: none: with a thousand times more or less the tests of its room pass.
pub const FLOW_ATOL: f64 = 1e-13;

/// Steps at most of such a run.
/// Unit: `[steps]`. Why: a choice. Test: `a_double_pendulum_is_chaotic`.
pub const FLOW_STEPS: usize = 2_000_000;

/// Least damping ratio of a peak that can be drawn, and the largest of one that points might miss.
/// Unit: `[1]`. Why: a choice: a millionth of the axis; the spacing of points. Test: none: not tried with other values.
pub const PEAKS: (f64, f64) = (1e-6, 0.2);

/// Coordinates are not independent that leave a direction of motion this small a part of what they could.
/// Unit: `[1]`. Why: a choice: half of the digits of the model would be lost. Test: none: with a thousand times more or
/// less the tests of its room pass.
pub const INDEPENDENT: f64 = 1e-7;

/// A driver that a change of q moves by a unit less this is held by other constraints.
/// Unit: `[1]`. Why: a choice, above the square root of rounding. Test: `a_driver_that_is_held_is_refused`.
pub const PRESCRIBED: f64 = 1e-6;

/// A step in which two modes could be exchanged for less is not clear.
/// Unit: `[1]`, cost of the match. Why: a choice: see the cost. Test: none: not tried with other values.
pub const CLEAR_MATCH: f64 = 1.0;

/// A mode that changes by more in a step may be another.
/// Unit: `[1]`, cost of the match. Why: a choice: half of the above. Test: none: not tried with other values.
pub const CHANGED_MODE: f64 = 0.5;

/// Modes whose values agree before and after are one for the eye: it does not matter which is which.
/// Unit: `[1]`. Why: a choice. Test: none: not tried with other values.
pub const EQUAL_MODES: f64 = 1e-3;

/// Entries of the pencil of all coordinates that are only rounding.
/// Unit: `[1]` of the largest, in the metric of the mass. Why: ten times less than what rounds the largest itself, so
/// that frequencies that are a million times lower keep five digits. Test: none: not tried with other values.
pub const FROZEN_ZERO: f64 = 1e-17;

/// How much G changes to the nearby state that a singular one is compared with.
/// Unit: `[1]` of its largest entry. Why: far beyond TRUNCATED_RANK, below which rows count as dependent, and near
/// enough to be the same assembly. Test: `singular_states`.
pub const NEARBY_STATE: f64 = 0.02;

/// The rank indicator at which a state is looked at before it is linearized.
/// Unit: `[1]`. Why: the square of its inverse times rounding, of the state as well, is a part of the accelerations:
/// 1e-4 beside a fold, whatever the chart. Test: `singular_states`.
pub const SINGULAR_MODEL: f64 = 1e-5;

/// Growth of the rank indicator from a singular state to a nearby one, at least.
/// Unit: `[1]`. Why: a choice: beside others it is about the same. Test: `singular_states`.
pub const SINGULAR_GROWTH: f64 = 1e2;

/// Residual of a mode that is returned, with the operator of the search.
/// Unit: `[1]` of |theta x|. Why: rounding in K is some 1e-16 of the square of the fastest rate over the square of that
/// of the mode, and nothing makes up for it. Test: none: not tried with other values.
pub const MODE_RESIDUAL: f64 = 1e-4;

/// Kinds of modes are clear where the part of a spurious one off the constraints is so many times that of any physical
/// one.
/// Unit: `[1]`. Why: a choice: the least that is a gap. Test: none: not tried with other values.
pub const SPURIOUS_GAP: f64 = 2.0;

/// An angle that no usual arrangement of parts around an axis repeats after.
/// Unit: `[rad]`. Why: it is no rational part of a turn. Test: none: not tried with other values.
pub const ODD_ANGLE: f64 = 1.0;

/// Rounding of products that say whether a mechanism is the same all around.
/// Unit: `[1]` of their terms. Why: the square root of rounding. Test: none: not tried with other values.
pub const STEADY: f64 = 1e-8;

/// Directions that are tried.
/// Unit: `[directions]`. Why: a choice. Test: none: a count of work, not tried.
pub const STEADY_DIRECTIONS: usize = 3;

/// Halvings of a step in which it is not clear which mode is which.
/// Unit: `[times]`. Why: a choice. Test: none: a count of work, not tried.
pub const HALVINGS: usize = 6;

/// Halvings of such a step with many modes.
/// Unit: `[times]`. Why: a choice: each costs a model. Test: none: a count of work, not tried.
pub const FEW_HALVINGS: usize = 3;

/// Modes from which on FEW_HALVINGS are made.
/// Unit: `[modes]`. Why: a choice. Test: none: a count of work, not tried.
pub const MANY_MODES: usize = 40;

/// A is measured at so many states along a motion.
/// Unit: `[states]`. Why: a choice: they tell a wrong term, which is wrong nearly everywhere. Test: none: a count of work.
pub const MEASURED_STATES: usize = 5;

/// The longest step of the transition matrices by which A is measured, over the time of its fastest change.
/// Unit: `[1]`. Why: the sixth power of it, over those of two that the extrapolation divides by, is round-off. Test: none:
/// an error that is estimated.
pub const MEASURED_STEP: f64 = 0.2;

/// Number of these steps, each half of the last.
/// Unit: `[steps]`. Why: of more, the shortest ones are round-off. Test: none: a count of work.
pub const MEASURED_STEPS: u32 = 7;

/// Points along a motion at most, where interpolation needs them close.
/// Unit: `[points]`. Why: a choice: files of more are hard to use. Test: none: a limit.
pub const WITHIN_MOST: usize = 20_000;

/// Errors up to here are in the range where the lowest power of h rules.
/// Unit: `[1]`. Why: a choice. Test: none: not tried with other values.
pub const LOWEST_POWER: f64 = 3e-3;

/// Steps of the frozen model over a pulse.
/// Unit: `[steps]`. Why: the error of its fourth-order method is below 1e-9. Test: none: a count of work, not tried.
pub const PULSE_STEPS: usize = 400;

/// Points that an observed order needs.
/// Unit: `[points]`. Why: a choice. Test: none: a count of work, not tried.
pub const SLOPE_POINTS: usize = 4;

/// Errors this factor above rounding are not disturbed by it.
/// Unit: `[1]`. Why: a choice. Test: none: not tried with other values.
pub const ABOVE_ROUNDING: f64 = 30.0;

/// Relative errors above are not in the range where eps^2 rules.
/// Unit: `[1]`. Why: a choice. Test: none: not tried with other values.
pub const SECOND_ORDER_RANGE: f64 = 0.1;

/// An order may be this much below 2.
/// Unit: `[1]`. Why: a choice. Test: none: not tried with other values.
pub const ORDER_SLACK: f64 = 0.1;

/// A measured entry that is off by more of its uncertainty is wrong.
/// Unit: `[uncertainties]`. Why: the usual three. Test: `spoilt_terms_are_condemned_with_their_size`.
pub const BEYOND_UNCERTAINTY: f64 = 3.0;

/// The largest perturbation of differences.
/// Unit: `[1]` of the typical length, of 1 m at most, or rad. Why: a choice: extrapolation needs the first powers only.
/// Test: `spoilt_terms_are_condemned_with_their_size`.
pub const LARGEST_SHIFT: f64 = 0.1;

/// A perturbation over the one before, and their number.
/// Unit: `[1]`. Why: a choice: errors of second order fall by sixteen. Test: `spoilt_terms_are_condemned_with_their_size`.
pub const SHIFT_RATIO: f64 = 0.25;

/// Number of perturbations of differences.
/// Unit: `[perturbations]`. Why: they reach 2e-5. Test: none: a count of work, not tried.
pub const SHIFTS: i32 = 7;

/// Perturbations whose differences are round-off but for the slope.
/// Unit: `[1]`, m or rad. Why: the square root of rounding. Test: `spoilt_terms_are_condemned_with_their_size`.
pub const TINY_SHIFTS: [f64; 2] = [1e-8, 3.7e-9];

/// Charts from which a limit is extrapolated, at least.
/// Unit: `[charts]`. Why: the first entry of the table with three neighbours. Test: none: a count of work, not tried.
pub const FEWEST_CHARTS: usize = 4;

/// States in a period of the fastest mode between which a first passage is interpolated.
/// Unit: `[states]`. Why: an error that oscillates is then right to a percent. Test:
/// `horizons_are_first_passages`.
pub const STATES_A_PERIOD: f64 = 24.0;

/// Such states at most.
/// Unit: `[states]`. Why: a choice: each costs a step of the motion. Test: none: a count of work, not tried.
pub const MOST_STATES: f64 = 600.0;

/// Halvings of the time of the first of them.
/// Unit: `[times]`. Why: a passage at a thousandth of the first state is still found. Test:
/// `horizons_are_first_passages`.
pub const HALVED_STATES: i32 = 12;

/// Perturbed motions are followed up to this part of the way to a change of form.
/// Unit: `[1]`. Why: a choice: small perturbations are then still before it. Test: `an_event_ends_the_horizon`.
pub const BEFORE_EVENT: f64 = 0.9;

/// A frozen response that is farther off is told beside the verdict.
/// Unit: `[1]`. Why: the larger of the horizons. Test: `a_frozen_response_that_is_far_off_is_told`.
pub const FROZEN_OFF: f64 = 0.1;

/// How many periods of the fastest mode a run counts at most.
/// Unit: `[periods]`. Why: longer runs would cost more than they tell. Test: none: not tried with other values.
pub const FASTEST_PERIODS: f64 = 8.0;

/// Perturbed motions are followed up to this part of the way to a singular state.
/// Unit: `[1]`. Why: a choice: nearer, terms of second order grow with the inverse of the distance. Test:
/// `a_singular_state_ends_the_comparison`.
pub const BEFORE_SINGULAR: f64 = 0.5;

/// Rounding of the terms of x^H K x with the shape x of a mode.
/// Unit: `[1]` of their sum. Why: four ulps: two for an entry of K, which is a sum of few elements, and two for the
/// products. Test: `a_rigid_body_mode_is_zero_and_a_slow_one_is_not`.
pub const ROUND_OFF_OF_K: f64 = 4.0 * f64::EPSILON;

/// Condition of the reduction from which on the error of a model by rounding of its state is measured.
/// Unit: `[1]`. Why: below, the fourth power of it times rounding is less than REDUCTION_WARNED. Test:
/// `a_model_near_a_fold_has_an_error`.
pub const REDUCTION_MEASURED: f64 = 300.0;

/// Part of the fourth power of the condition times rounding that is the error of a model.
/// Unit: `[1]`. Why: beside folds of two cranks it is 0.05. Test: none: an estimate.
pub const REDUCTION_ESTIMATE: f64 = 0.1;

/// Error of a model by its reduction that is warned of.
/// Unit: `[1]` of the size of A. Why: six digits are printed. Test: `a_model_near_a_fold_has_an_error`.
pub const REDUCTION_WARNED: f64 = 1e-6;

/// Error of a model by its reduction that is refused.
/// Unit: `[1]` of the size of A. Why: a choice: no digit that is of use is left. Test:
/// `redundancy_hides_no_singular_state`.
pub const REDUCTION_REFUSED: f64 = 1e-2;

/// A direction with less inertia than this has none.
/// Unit: `[1]` of the largest mass, per square of the length of the mechanism for a rotation. Why: the square root of
/// rounding. Test: `directions_without_inertia_are_coordinates`.
pub const MASSLESS_DIRECTION: f64 = 1e-8;

/// Condition of the reduction from which on a mechanism without freedom may have some.
/// Unit: `[1]`. Why: the square root of rounding: rows that depend on others leave so much beside a fold. Test:
/// `redundancy_hides_no_singular_state`.
pub const RANK_UNKNOWN: f64 = 1e7;

/// Error of transition matrices over a period.
/// Unit: `[1]` of their largest entry. Why: some ten times FLOW_RTOL, which is that of a step. Test: none: an estimate.
pub const FLOW_ERROR: f64 = 1e-11;

/// Parts of a displacement after which the equations are compared.
/// Unit: `[1]`. Why: an odd part and the whole: no symmetry of single positions passes for one of all. Test:
/// `a_turn_is_no_gap`.
pub const ON_THE_WAY: [f64; 2] = [0.371, 1.0];

/// Difference of the terms of equations that are the same.
/// Unit: `[1]` of the largest of their kind, at least 1. Why: the square root of rounding: of angles of some turns. Test:
/// `a_turn_is_no_gap`.
pub const SAME_EQUATIONS: f64 = 1e-8;

/// Thresholds sought between two values of a parameter, at most.
/// Unit: `[thresholds]`. Why: a choice: each costs some 30 models. Test: none: a count of work, not tried.
pub const THRESHOLDS: usize = 8;

/// Part of a step of the parameter up to which a threshold is bracketed before its root is sought.
/// Unit: `[1]`. Why: a choice: the function whose root it is is straight there. Test: `thresholds_are_located`.
pub const BRACKET: f64 = 1e-5;

/// Iterations of the search of a threshold.
/// Unit: `[iterations]`. Why: a straight function takes three. Test: none: a count of work, not tried.
pub const THRESHOLD_ITERATIONS: usize = 30;

/// Errors of an eigenvalue within which it is on the imaginary axis.
/// Unit: `[1]`. Why: a choice: errors are known to first order. Test: `thresholds_are_located`.
pub const AXIS_ERRORS: f64 = 10.0;

/// Step of the differences that give the sensitivity of eigenvalues.
/// Unit: `[1]` of the parameter. Why: its fourth power and rounding over it are both about 1e-12. Test:
/// `eigenvalues_have_their_sensitivity`.
pub const SENSITIVITY_STEP: f64 = 1e-3;

/// Size of the changes (dq, dv) over which the argument of a switching function is differentiated.
/// Unit: `[m, rad, m/s, rad/s]`. Why: its fourth power, the error of the differences, is about their round-off. Test: none:
/// an error of differences far below what is compared.
pub const SALTATION_STEP: f64 = 1e-3;
