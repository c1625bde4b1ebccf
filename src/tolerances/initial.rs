//! Assembly, static equilibrium, charts and projections: what makes a state consistent.

pub use super::{NEWTON_HALVES, NEWTON_STAGNATION, REDUNDANT_ROWS_CLOSED, ROUND_OFF_OF_PHI, ROUND_OFF_OF_SUMS, SAME};

/// What is left of a column of Z Z^T where all directions of motion are found.
/// Unit: `[1]` of the column without constraints. Why: a choice, above the round-off of the saddle-point system over
/// the square of TRUNCATED_RANK. Test: none: with a thousand times more or less the tests of its room pass.
pub const NO_DIRECTION: f64 = 1e-10;

/// Entries of Z^T M Z may differ so much from those of the identity.
/// Unit: `[1]`. Why: a choice: beyond, the directions are made orthonormal again. Test: none: with a thousand times
/// more or less the tests of its room pass.
pub const ORTHONORMAL: f64 = 1e-6;

/// Changes in the chart of minimal coordinates that no longer fall are round-off up to here.
/// Unit: `[1]` of the largest component. Why: a choice: nearly dependent rows amplify an ulp. Test: none: not tried
/// with other values.
pub const CHART_STAGNATION: f64 = 1e-9;

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

/// Work of a step of the descent over what K predicts, below which it is taken back.
/// Unit: `[1]`. Why: a choice, as in trust regions. Test: none: not tried with other values.
pub const DESCENT_TAKEN_BACK: f64 = 0.1;

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

/// A direction that nothing holds is loaded where the force along it is this part of all.
/// Unit: `[1]`. Why: a choice, far above round-off. Test: none: not tried with other values.
pub const LOADED: f64 = 1e-6;

/// First part of the missing force that is put back on.
/// Unit: `[1]`. Why: a choice. Test: none: not tried with other values.
pub const LOAD_FIRST: f64 = 0.1;

/// The smallest part of the load by which it is put back on; where that fails there is no equilibrium on this branch.
/// Unit: `[1]`. Why: a choice. Test: none: not tried with other values.
pub const LOAD_SMALLEST: f64 = 1e-4;

/// How often the load may change on the way back to all of it.
/// Unit: `[steps]`. Why: a choice. Test: none: a count of work, not tried.
pub const LOAD_CHANGES: usize = 400;

/// What is left of the forces of an equilibrium that was found.
/// Unit: `[1]` of those that balance. Why: a choice, far above round-off, which stiff beams amplify. Test: none: not
/// tried with other values.
pub const FORCE_LEFT: f64 = 1e-6;

/// Round-off of coordinates where a search for an equilibrium began, times the stiffness: a force that cannot be taken
/// away.
/// Unit: `[1]` of the largest q. Why: 450 ulps, as ROUND_OFF_OF_FACTORS. Test: none: not tried with other values.
pub const COORDINATES_ROUNDED: f64 = 1e-13;

/// How far an element of a beam may turn at an equilibrium, over what is warned of.
/// Unit: `[1]`. Why: 0.95 of what it can turn at all. Test: none: not tried with other values.
pub const TOO_FAR_TURNED: f64 = 0.95 / 0.75;

/// Undamped iterations at most of Newton's method on the forces.
/// Unit: `[iterations]`. Why: bent beams need steps that grow before they shrink. Test: none: a bound of work, not
/// tried.
pub const FULL_ITERATIONS: usize = 40;

/// Damped iterations at most.
/// Unit: `[iterations]`. Why: a choice: the descent comes next. Test: none: a bound of work, not tried.
pub const DAMPED_ITERATIONS: usize = 60;

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

/// Growth or decay of a small motion that tells stability where K is not symmetric. Unit: `[1]` of the fastest rate.
/// Why: twice the zero of a rigid motion is parted by the root of round-off. Test: none: not tried with other values.
pub const SURE_GROWTH: f64 = 1e-7;

/// A coordinate that is named takes part in a direction by this part of the largest.
/// Unit: `[1]`. Why: a choice of how much a message says. Test: none: not tried with other values.
pub const TAKES_PART: f64 = 0.3;

/// Newton's iterations at most from a guess to the state that continues the one it was taken from.
/// Unit: `[iterations]`. Why: a choice. Test: none: a bound of work, not tried.
pub const FOLLOWING_ITERATIONS: usize = 20;

/// Changes of q at which Newton's method from such a guess ends.
/// Unit: `[m, rad]` over 1 and the largest q. Why: round-off, also near a singular state. Test: none: not tried with
/// other values.
pub const FOLLOWED: f64 = 1e-11;

/// Weight of directions without mass in the metric of the assembly.
/// Unit: `[1]` of the largest mass. Why: a choice: they move freely, and the matrix is still far from singular. Test:
/// none: not tried with other values.
pub const LEAST_WEIGHT: f64 = 1e-6;

/// Iterations at most of the assembly.
/// Unit: `[iterations]`. Why: a choice: guesses may be far off. Test: none: a bound of work, not tried.
pub const ASSEMBLY_ITERATIONS: usize = 200;

/// The least part of the way to the coordinates in `initial` that is tried before the path is taken to end.
/// Unit: `[1]`. Why: near a dead centre steps shrink with the root of what is left. Test:
/// `a_loop_is_turned_to_an_angle_far_from_the_guess`.
pub const LEAST_PART: f64 = 1e-4;

/// The largest phi of a closed loop after assembly.
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
