//! Iterations and steps of the integrators.

pub use super::{
    NEWTON_STAGNATION, REDUNDANT_ROWS_CLOSED, ROUND_OFF, ROUND_OFF_OF_PHI, ROUND_OFF_OF_SUMS, ROUNDED_ZERO,
};

/// Changes of v at the middle of a step of rattle that no longer fall are round-off up to here.
/// Unit: `[1]` of the largest v. Why: a choice, near the square root of rounding. Test: none: not tried with other
/// values.
pub const STAGNATION_OF_VELOCITY: f64 = 1e-9;

/// The part of the stagnation tolerance that is round-off: an iteration ends there, and fixed steps converge to it.
/// Unit: `[1]` of the stagnation tolerance. Why: together 1e-15 of v', 1e-16 of v. Test: none: with a thousand times
/// more or less the tests of its room pass.
pub const ROUND_OFF_OF_STAGNATION: f64 = 1e-7;

/// Error of v' that generalized_alpha may leave where steps are controlled.
/// Unit: `[1]` of the stagnation tolerance. Why: phi is round-off then, and no more is asked of v'. Test: none: not
/// tried with other values.
pub const CONTROLLED_ERROR: f64 = 1e-6;

/// The largest q is taken for no smaller than this where round-off is told.
/// Unit: `[m, rad]`. Why: a choice: scenes of nanometres keep their own scale. Test: none: with a thousand times more
/// or less the tests of its room pass.
pub const LEAST_LARGEST_Q: f64 = 1e-10;

/// Changes of v' at the end of a step of generalized_alpha that are small beside its local error. Unit: `[1]` of the
/// change of a in the step. Why: the local error of v is about h/T of h times that change, with T the time scale of the
/// motion, and what is left after a correction that small is a hundredth of it or less. Test:
/// `fixed_steps_do_not_see_units`.
pub const PART_OF_CHANGE: f64 = 1e-6;

/// Corrections at most of a step of generalized_alpha.
/// Unit: `[iterations]`. Why: as many as far predictions and kinks of forces want. Test: none: a bound of work, not
/// tried.
pub const GENERALIZED_ALPHA_ITERATIONS: usize = 25;

/// Corrections at most of a step that cannot be tried smaller.
/// Unit: `[iterations]`. Why: a choice: a step that does not converge ends the run. Test: `order_nine`.
pub const FIXED_STEP_ITERATIONS: usize = 50;

/// Iterations at most of rattle.
/// Unit: `[iterations]`. Why: its matrix has no K: the contraction is h^2 K/M. Test: none: a bound of work, not tried.
pub const RATTLE_ITERATIONS: usize = 100;

/// Rate of convergence up to which the matrix of generalized_alpha serves the next step too.
/// Unit: `[1]`. Why: an iteration more costs far less than K and C. Test: none: time alone depends on it.
pub const GENERALIZED_ALPHA_MATRIX_KEPT: f64 = 1e-2;

/// Corrections up to which a matrix of a step before serves the next step too.
/// Unit: `[iterations]`. Why: a matrix costs about four, and a new one converges in three or two. Test:
/// `generalized_alpha_passes_the_flat_position`.
pub const CORRECTIONS_WITH_OLD_MATRIX: usize = 4;

/// Corrections of generalized_alpha that no longer fall before an iteration ends by stagnation. Unit: `[iterations]`.
/// Why: their rate is the mean of two ratios, and one may be smaller by chance. Test: none: time alone depends on it.
pub const CORRECTIONS_OF_ROUND_OFF: usize = 3;

/// Rank indicator below which generalized_alpha keeps a matrix of a step before also after long iterations. Unit: `[1]`
/// of the indicator at regular states. Why: a choice: a matrix from there converges at the singular state too. Test:
/// `generalized_alpha_passes_the_flat_position`.
pub const NEARLY_SINGULAR: f64 = 0.1;

/// The matrix of generalized_alpha serves steps up to this factor longer or shorter.
/// Unit: `[1]`. Why: a choice: M is most of it, and the rate is watched. Test: none: time alone depends on it.
pub const MATRIX_BAND: f64 = 1.3;

/// Rate of convergence up to which the matrices of radau_iia serve the next step too.
/// Unit: `[1]`. Why: an iteration more costs an evaluation a stage, about as much as a new matrix does. Test:
/// `no_more_work_than_other_codes`.
pub const RADAU_MATRIX_KEPT: f64 = 3e-5;

/// Corrections of a fixed step of radau_iia that may grow.
/// Unit: `[iterations]`. Why: a choice: such a step cannot be tried smaller. Test: `long_chains_take_fixed_steps`.
pub const RADAU_PATIENCE: usize = 10;

/// Changes of the stages of radau_iia that no longer fall are round-off up to so many times that of a few operations.
/// Unit: `[1]`. Why: a choice: round-off of many operations. Test:
/// `long_chains_of_beams_take_fixed_steps`.
pub const RADAU_STAGNATION: f64 = 100.0;

/// Error of a step of radau_iia that is the rounding of phi, over that of one state.
/// Unit: `[1]`. Why: a choice: some operations a stage. Test: `gains_of_any_size_are_stepped_over`.
pub const RADAU_ROUND_OFF: f64 = 10.0;

/// The least rate by which the error that an iteration leaves is told.
/// Unit: `[1]`. Why: two changes tell little of the rate. Test: `no_more_work_than_other_codes`.
pub const RADAU_LEAST_RATE: f64 = 0.1;

/// Sweeps at most that move the stages of rotations along the group.
/// Unit: `[sweeps]`. Why: a choice. Test: none: with a thousand times more or less the tests of its room pass.
pub const RADAU_SWEEPS: usize = 6;

/// The largest component of a rotation vector in a step of radau_iia.
/// Unit: `[rad]`. Why: rotation vectors have a pole at 2 pi. Test: `rotations_about_a_fixed_axis_are_exact`.
pub const RADAU_TURN: f64 = std::f64::consts::PI;

/// Steps at one order before it may change.
/// Unit: `[steps]`. Why: a choice. Test: `no_more_work_than_other_codes`.
pub const RADAU_STEADY: usize = 4;

/// The gain in work that is worth a change of the order.
/// Unit: `[1]`. Why: a choice. Test: `no_more_work_than_other_codes`.
pub const RADAU_GAIN: f64 = 1.2;

/// Contraction of Newton's method that a larger step may come to.
/// Unit: `[1]`. Why: a choice. Test: `no_more_work_than_other_codes`.
pub const RADAU_SLOW: f64 = 0.4;

/// The longest step of radau_iia over the one before.
/// Unit: `[1]`. Why: a choice, as in RADAU5: stages are extrapolated so far. Test: `no_more_work_than_other_codes`.
pub const RADAU_GROWTH: f64 = 5.0;

/// The shortest and the longest step that radau_iia tries over one that Newton's method did not solve.
/// Unit: `[1]`. Why: a choice: contraction tells the length within, but its first rates are rough. Test:
/// `turning_stiff_directions_do_not_limit_steps`.
pub const RADAU_RETRIED: [f64; 2] = [0.25, 0.8];

/// Error below which the next step is chosen with the whole gain.
/// Unit: `[tolerated errors]`. Why: from there steps double and more, as at a start. With 1e-3 evaluations are as many,
/// with 0.1 there are a tenth more. Test: none: time alone depends on it.
pub const FAR_BELOW: f64 = 1e-2;

/// The shortest step of adams over one that was refused.
/// Unit: `[1]`. Why: a choice: the error tells the length, but not over a kink. Test: none: time alone depends on it.
pub const ADAMS_SHRINK: f64 = 0.2;

/// Error that a step of adams aims at.
/// Unit: `[tolerated errors]`. Why: with 0.5 a third more steps are refused, with 0.1 there are more of them. Test: none:
/// time alone depends on it.
pub const ADAMS_AIM: f64 = 0.25;

/// Steps of adams stay equal unless the next one can be so much longer.
/// Unit: `[1]`. Why: a choice: with 1.05 to 1.2 evaluations are the fewest, with 2, as in the code ODE, 5 % more. Test:
/// none: time alone depends on it.
pub const ADAMS_LONGER: f64 = 1.1;

/// The largest rotation of a body in a controlled step of generalized_alpha.
/// Unit: `[rad]`. Why: Newton's method converges, and no half revolution is missed. Test:
/// `steady_motions_are_as_accurate_as_asked`.
pub const GENERALIZED_ALPHA_TURN: f64 = 1.0;

/// The largest rho_inf of generalized_alpha with index3.
/// Unit: `[1]`. Why: with 0.98 the energy of a pendulum grows a million times in steps of a hundredth of its period.
/// Test: `every_triple_has_the_order_of_its_integrator`.
pub const UNDAMPED_WITH_POSITIONS: f64 = 0.9;

/// Steps are not controlled more tightly than this unless that is asked for.
/// Unit: `[1]`. Why: Newton's methods, which go two digits further, and projections near singular states come near
/// round-off. Test: `steps_are_never_looser_than_asked_nor_tighter_than_round_off`.
pub const CONTROLLED_RTOL: f64 = 1e-11;

/// Steps of adams are not controlled more tightly than this unless that is asked for.
/// Unit: `[1]`. Why: it has no Newton's method, and errors fell in proportion down to 1e-14. Test:
/// `motions_that_amplify_a_little_are_as_accurate_as_asked`.
pub const ADAMS_RTOL: f64 = 1e-13;

/// How often a guess of the first step is divided by ten where y' has no value ahead.
/// Unit: `[divisions]`. Why: a choice. Test: none: with a thousand times more or less the tests of its room pass.
pub const FIRST_STEP_SHORTER: usize = 20;

/// The longest guess of the first step.
/// Unit: `[1]` of the span. Why: as in SUNDIALS IDA. At rest y' is round-off and sets no time of its own, and a load
/// that rises there is seen early, if at all. Test: `a_load_that_grows_from_zero_moves_what_is_at_rest`.
pub const FIRST_STEP_OF_SPAN: f64 = 1e-3;

/// Error that Newton's method may leave of a step of bdf.
/// Unit: `[1]` of the tolerated error of a step. Why: what it leaves of the constraints is drift. Test:
/// `ggl_holds_both_constraints_and_runs_repeat_bit_by_bit`.
pub const STAGE_ERROR: f64 = 0.01;

/// Corrections at most of a step of bdf.
/// Unit: `[iterations]`. Why: more cost as much as a shorter step. Test: none: time alone depends on it.
pub const STAGE_ITERATIONS: usize = 7;

/// Rate of convergence up to which the matrix of bdf serves the next step too.
/// Unit: `[1]`. Why: a choice: an iteration more costs an evaluation, a matrix about four. Test: none: time alone
/// depends on it.
pub const STAGE_MATRIX_KEPT: f64 = 0.1;

/// The factors of bdf serve steps up to this factor longer or shorter.
/// Unit: `[1]`. Why: stiff directions contract by 1 - 1/1.1^2 with them. Test: none: time alone depends on it.
pub const STAGE_BAND: f64 = 1.1;

/// Error of a step below which bdf doubles the next one at the beginning of a motion.
/// Unit: `[1]` of the tolerated error of a step. Why: twice the step with the same order has four times the error.
/// Test: none: time alone depends on it.
pub const BDF_START: f64 = 0.1;

/// Refused attempts of a step after which bdf returns to order 1.
/// Unit: `[attempts]`. Why: as in IDA: the past does not predict what comes. Test: none: time alone depends on it.
pub const BDF_FAILURES: usize = 3;

/// Error of a step of bdf that is round-off, over that of one state.
/// Unit: `[1]`. Why: weights of extrapolation over six states of unequal distances come to some hundred, and a
/// sixth of that, sixteen ulps each, is in the error. Test: `the_tightest_tolerance`.
pub const BDF_ROUND_OFF: f64 = 30.0;

/// Error of a step of bdf up to which its order does not fall.
/// Unit: `[1]` of the tolerated error of a step. Why: such a step may grow, and round-off, which does not decrease with
/// the order, may be most of the error. Test: `the_tightest_tolerance`.
pub const BDF_SMALL: f64 = 0.05;

/// Steps of bdf that would grow by less than this stay as they are.
/// Unit: `[1]`. Why: as in VODE: formulas and the matrix are those of equal steps. Test: none: time alone depends on
/// it.
pub const BDF_GROWTH: f64 = 1.5;

/// What a step may grow a radian, in ln |x|, at the limit of stability.
/// Unit: `[1]`. Why: all but a few methods grow a little on the imaginary axis, however short the steps. Test:
/// `limits_are_those_of_the_books`.
pub const STABILITY_GROWTH: f64 = 1e-3;

/// Contraction of an iteration without a matrix at its limit.
/// Unit: `[1]`. Why: a hundred rounds bring it to round-off. Test: `stated_limits_are_the_measured_ones`.
pub const ITERABLE: f64 = 0.8;

/// Limits of stability are sought up to this |z|.
/// Unit: `[1]`. Why: a choice. Test: `limits_are_those_of_the_books`.
pub const FARTHEST_LIMIT: f64 = 50.0;

/// Steps of |z| in which the limits of stability are sought, and then refined.
/// Unit: `[1]`. Why: a choice. Test: none: with a thousand times more or less the tests of its room pass.
pub const STRIDE_TO_LIMIT: f64 = 0.01;

/// Corrections of a half-explicit stage that no longer fall are round-off up to here. Unit: `[1]` of the largest
/// acceleration. Why: ten times ROUND_OFF_OF_FACTORS; above, as of accelerations at rest under load, the stage is
/// factored. Test: `the_velocity_constraint_is_held_to_round_off`.
pub const STAGE_STAGNATION: f64 = 1e-12;

/// Steps of diffsol up to which a failed evaluation is told as the reason for their size.
/// Unit: `[1]` of the time. Why: a choice: steps that shrink without end come there, others do not. Test:
/// `what_cannot_be_evaluated_is_named`.
pub const CREEPING_STEP: f64 = 1e-9;

/// Distance of a moved state from the polynomial of its steps from which the bdf of diffsol begins again.
/// Unit: `[1]` of the tolerated error of a step. Why: half of the correction that refuses a step; each beginning, at order
/// 1, costs accuracy. Test: `coordinates_are_told_from_states`.
pub const BDF_APART: f64 = 5.0;
