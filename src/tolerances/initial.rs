//! Assembly, static equilibrium, charts and projections: what makes a state consistent.

pub use super::modes::ROUNDING_OF_K;
pub use super::{
    NEWTON_HALVES, NEWTON_STAGNATION, REDUNDANT_ROWS_CLOSED, ROUND_OFF, ROUND_OFF_OF_FACTORS, ROUND_OFF_OF_PHI,
    ROUND_OFF_OF_SUMS, SAME,
};

/// What is left of a column of Z Z^T where all directions of motion are found.
/// Unit: `[1]` of the column without constraints. Why: a choice, above the round-off of the saddle-point system over
/// the square of TRUNCATED_RANK. Test: none: with a thousand times more or less the tests of its room pass.
pub const NO_DIRECTION: f64 = 1e-10;

/// Entries of Z^T M Z may differ so much from those of the identity.
/// Unit: `[1]`. Why: a choice: beyond, the directions are made orthonormal again. Test: none: with a thousand times
/// more or less the tests of its room pass.
pub const ORTHONORMAL: f64 = 1e-6;

/// Newton's iterations of an exact projection; who asks for fewer takes what they leave.
/// Unit: `[iterations]`. Why: a choice. Test: `a_low_penalty_has_the_order_of_its_integrator_and_an_error_of_its_own`.
pub const PROJECTIONS: usize = 10;

/// Steps at most of the descent to an equilibrium in pseudo-time.
/// Unit: `[steps]`. Why: a choice. Test: none: a bound of work, not tried.
pub const DESCENT_STEPS: usize = 500;

/// Length of the first step of the descent.
/// Unit: `[m, rad]`. Why: a choice: rotations must stay small. Test: none: not tried with other values.
pub const DESCENT_FIRST: f64 = 0.1;

/// Newton's method is tried when the force has fallen by this since it was tried last.
/// Unit: `[1]`. Why: a choice. Test: none: not tried with other values.
pub const DESCENT_FALL: f64 = 0.03;

/// A step that does less than this part of what is predicted to first order is taken back: of the fall of |phi| where phi
/// is linear, of the work by K.
/// Unit: `[1]`. Why: a choice, as in line searches and trust regions. Test: none: not tried with other values.
pub const SUFFICIENT_STEP: f64 = 0.1;

/// Work of a step of the descent over what K predicts, below which the next step is shorter.
/// Unit: `[1]`. Why: a choice, as in trust regions. Test: none: not tried with other values.
pub const DESCENT_SHORTER: f64 = 0.4;

/// Work of a step of the descent over what K predicts, above which the next step is longer.
/// Unit: `[1]`. Why: a choice, as in trust regions. Test: none: not tried with other values.
pub const DESCENT_LONGER: f64 = 0.75;

/// Changes of q of the search that lead nowhere: nothing holds the body.
/// Unit: `[m, rad]` over 1 and the largest q. Why: a choice. Test: none: not tried with other values.
pub const AWAY: f64 = 100.0;

/// The shift of K in the descent, over the first, at which steps no longer move anything.
/// Unit: `[1]`. Why: a step is 1e-13 m or rad then. Test: none: not tried with other values.
pub const DESCENT_STIFFEST: f64 = 1e12;

/// Iterations at most beside a solution: of the way back to phi = 0, of Newton's method where the search is all but
/// done.
/// Unit: `[iterations]`. Why: a choice: the convergence is quadratic there. Test: none: a bound of work, not tried.
pub const CLOSING_ITERATIONS: usize = 12;

/// Further iterations of a step of the descent, at the same shift.
/// Unit: `[iterations]`. Why: a choice. Test: none: a count of work, not tried.
pub const RELAXATIONS: usize = 6;

/// First part of the missing force that is put back on.
/// Unit: `[1]`. Why: a choice. Test: none: not tried with other values.
pub const LOAD_FIRST: f64 = 0.1;

/// The least step of a continuation, in the load of an equilibrium or to the coordinates in `initial`, before it is taken
/// to end.
/// Unit: `[1]` of all. Why: near a dead centre steps shrink with the root of what is left. Test:
/// `a_loop_is_turned_to_an_angle_far_from_the_guess`.
pub const LEAST_PART: f64 = 1e-4;

/// Steps at most of a continuation.
/// Unit: `[steps]`. Why: a choice: halving to the resolution of a sweep takes 27, to that of a travel 40. Test: none: a
/// bound of work, not tried.
pub const CONTINUATION_STEPS: usize = 1000;

/// The part of the forces that may be left at an equilibrium, and beyond which a direction that nothing holds is loaded.
/// Unit: `[1]` of those that balance. Why: a choice, far above round-off, which stiff beams amplify. Test: none: not
/// tried with other values.
pub const FORCE_LEFT: f64 = 1e-6;

/// How far an element of a beam may turn at an equilibrium, over what is warned of.
/// Unit: `[1]`. Why: 0.95 of what it can turn at all. Test: none: not tried with other values.
pub const TOO_FAR_TURNED: f64 = 0.95 / 0.75;

/// Iterations at most of Newton's method on the forces, plain or damped.
/// Unit: `[iterations]`. Why: bent beams need steps that grow before they shrink. Test: none: a bound of work, not
/// tried.
pub const BALANCING_ITERATIONS: usize = 60;

/// Changes of Newton's method that shrink to this part lead to the one solution around the start.
/// Unit: `[1]`. Why: P. Deuflhard, Newton Methods for Nonlinear Problems, 2011, section 5.1. Test: none: with a
/// thousand times more or less the tests of its room pass.
pub const UNIQUE_CONTRACTION: f64 = 0.25;

/// The shortest damped step, as part of the full one.
/// Unit: `[1]`. Why: a choice: other ways come next. Test: none: not tried with other values.
pub const SHORTEST_DAMPED: f64 = 1e-3;

/// Terms of a balance of forces below this part of the largest of all are as good as none.
/// Unit: `[1]`. Why: the square root of rounding. Test: none: not tried with other values.
pub const BALANCED_LEAST: f64 = 1e-8;

/// Velocities up to which all eigenvalues of a state are computed.
/// Unit: `[velocities]`. Why: a choice: time goes with the cube. Test: none: with a thousand times more or less the
/// tests of its room pass.
pub const DENSE_EIGENVALUES: usize = 300;

/// Part of K that may be skew before its eigenvalues do not tell stability.
/// Unit: `[1]` of the largest entry. Why: a choice, far above round-off. Test: none: not tried with other values.
pub const SKEW: f64 = 1e-6;

/// A coordinate that is named takes part in a direction by this part of the largest.
/// Unit: `[1]`. Why: a choice of how much a message says. Test: none: not tried with other values.
pub const TAKES_PART: f64 = 0.3;

/// Newton's iterations at most from a guess to the state that continues the one it was taken from.
/// Unit: `[iterations]`. Why: a choice. Test: none: a bound of work, not tried.
pub const FOLLOWING_ITERATIONS: usize = 20;

/// Weight of directions without mass in the metric of the assembly.
/// Unit: `[1]` of the largest mass. Why: a choice: they move freely, and the matrix is still far from singular. Test:
/// none: not tried with other values.
pub const LEAST_WEIGHT: f64 = 1e-6;

/// Damped Newton's steps at most from a guess to closed joints.
/// Unit: `[steps]`. Why: loops of random angles take 56 at most. Test: none: a bound of work, not tried.
pub const CLOSING_STEPS: usize = 80;

/// The largest rotation of a body in a step of the assembly.
/// Unit: `[rad]`. Why: a choice: beyond, a step is none along the circles on which bars move. Test: none: with 0.3 to 3
/// the same loops close.
pub const LARGEST_TURN: f64 = 0.7;

/// Halvings of a step of the assembly before it is given up.
/// Unit: `[halvings]`. Why: a choice. Test: none: a bound of work, not tried.
pub const STEP_HALVINGS: usize = 12;

/// Beginnings of the assembly beside its guess where it does not close from there.
/// Unit: `[beginnings]`. Why: of 199 loops with random angles one needs four. Test: `loops_close_from_random_angles`.
pub const RESTARTS: usize = 12;

/// Beginnings of the assembly beside its guess where there are many velocities.
/// Unit: `[beginnings]`. Why: each takes seconds. Test: none: a bound of work, not tried.
pub const FEW_RESTARTS: usize = 3;

/// Velocities from which on the assembly begins less often.
/// Unit: `[velocities]`. Why: a choice. Test: none: a bound of work, not tried.
pub const LARGE_ASSEMBLY: usize = 300;

/// Distance from the guess of the first beginning beside it; the next are farther.
/// Unit: `[rad]`, or the scene's length. Why: a choice. Test: `a_guess_on_one_line_is_left`.
pub const BESIDE: f64 = 0.1;

/// Steps at most along the constraints to the state nearest to the guess.
/// Unit: `[steps]`. Why: a choice: what is closed can begin. Test: none: a bound of work, not tried.
pub const APPROACH_STEPS: usize = 200;

/// Steps towards the nearest state that are this small end there.
/// Unit: `[m, rad]` over 1 and the way from the guess. Why: round-off. Test: none: not tried with other values.
pub const SETTLED: f64 = 1e-12;

/// Steps towards the nearest state below this are judged by their size, not by the distance.
/// Unit: `[m, rad]` over 1 and the way from the guess. Why: a choice: there the distance falls by its square, which the
/// corrections of the joints hide. Test: `they_move_as_the_built_in_ones`.
pub const STEP_DECIDES: f64 = 1e-3;

/// Small steps towards the nearest state that do not fall below this part of the smallest are round-off.
/// Unit: `[1]`. Why: a choice. Test: none: not tried with other values.
pub const STAGNANT_STEP: f64 = 0.9;

/// So many of them in a row end the way to the nearest state: far from the guess steps fall slowly.
/// Unit: `[steps]`. Why: a choice. Test: `they_move_as_the_built_in_ones`.
pub const STALLED_STEPS: usize = 8;

/// Joints that may be what is in the way have gaps of this part of the largest.
/// Unit: `[1]`. Why: a choice. Test: none: not tried with other values.
pub const PART_OF_GAP: f64 = 1e-3;

/// Joints that are left out one after the other to see whether the others close.
/// Unit: `[joints]`. Why: a choice. Test: none: a bound of work, not tried.
pub const JOINTS_TRIED: usize = 8;

/// Bodies move so far along a direction of motion if they are free at all.
/// Unit: `[1]` of an arbitrary change of their coordinates. Why: a choice, above round-off. Test:
/// `a_joint_too_many_is_named`.
pub const LOCKED: f64 = 1e-8;

/// A gap that falls by less than this in a step is the least.
/// Unit: `[1]` of the gap. Why: a choice: four digits are told. Test: `a_bar_that_is_too_short_is_named_with_the_gap`.
pub const GAP_SETTLED: f64 = 1e-7;

/// Lengths in a scene that does not close of which some may be in millimetres.
/// Unit: `[1]`, the largest over the smallest. Why: half of a thousand. Test: `millimetres_among_metres_are_named`.
pub const UNLIKE_LENGTHS: f64 = 500.0;

/// Digits of the value that a driver asks for, and of the end of its travel.
/// Unit: `[digits]`. Why: the end is known to some ten. Test: `a_driver_beyond_its_travel_is_named`.
pub const DIGITS_OF_TRAVEL: usize = 9;

/// The largest phi of a closed loop after assembly, beside round-off of the largest coordinate.
/// Unit: `[1]` of the scene's scale. Why: round-off of chains of transformations, up to thousands of them. Test: none:
/// with a thousand times more or less the tests of its room pass.
pub const CLOSED: f64 = 1e-10;

/// A start that keeps less than this part of the given velocities contradicts the joints.
/// Unit: `[1]`. Why: a choice: no start that anybody meant. Test: none: not tried with other values.
pub const VELOCITIES_KEPT: f64 = 1e-6;

/// A path that ends after this part of the way comes to its end in the limit only.
/// Unit: `[1]` of the way. Why: a choice: at a dead centre its steps halve. Test:
/// `a_value_on_another_branch_is_refused`.
pub const NEARLY_THERE: f64 = 0.999;

/// Rates of joint coordinates that take velocities so much larger cannot be given: the state is at a dead centre.
/// Unit: `[1]`. Why: half of the digits of the velocities would be lost. Test:
/// `a_rate_at_a_dead_centre_is_refused`.
pub const DEAD_CENTRE: f64 = 1e-7;

/// The end of a travel is found to this part of the run.
/// Unit: `[1]`. Why: round-off of a driver's value, with a margin. Test: `a_driver_beyond_its_travel_is_named`.
pub const TRAVEL_RESOLVED: f64 = 1e-12;

/// A state that is closed for a driver is the continuation of another within this distance.
/// Unit: `[m, rad]` over 1 and the largest coordinate. Why: a choice: other configurations are farther. Test: none: not
/// tried with other values.
pub const TRAVEL_NEAR: f64 = 0.1;

/// The driver to blame is one without which the joints close this part of the run after the end of the travel.
/// Unit: `[1]`. Why: a choice. Test: `a_driver_beyond_its_travel_is_named`.
pub const TRAVEL_BEYOND: f64 = 1e-3;

/// Samples of what a driver asks for after the end of its travel.
/// Unit: `[samples]`. Why: a choice of how much a message says. Test: none: not tried with other values.
pub const TRAVEL_SAMPLES: u32 = 400;

/// Looks for the end of a travel ahead of a run that fails or crawls, each twice as far as the one before.
/// Unit: `[looks]`. Why: the first is at a millionth of the time. Test: `a_driver_beyond_its_travel_is_named`.
pub const TRAVEL_LOOKS: i32 = 20;

/// Thirds that are cut off around the extreme of what a driver asks for.
/// Unit: `[1]`. Why: (2/3)^60 is below round-off. Test: `a_driver_beyond_its_travel_is_named`.
pub const EXTREME_HALVINGS: usize = 60;
