//! Thresholds that several files share: numbers on which a decision or the accuracy of a result depends.
//!
//! A threshold that one file uses stands in that file. Each says what is decided; its unit, `[1]` with what it is relative
//! to, or a unit of measure; why it has this value; and a test that fails where it is a thousand times larger or smaller.
//! One without a reason is a choice, and one without a test was not tried with other values.
//!
//! Levels come first, since most decisions need one of them. Round-off has a level by the operations that made the
//! number: [`ROUND_OFF`] a few, [`ROUNDED_ZERO`] one that should be zero, [`ROUND_OFF_OF_SUMS`] some tens,
//! [`ROUND_OFF_OF_FACTORS`] a factorization, [`ROUND_OFF_OF_SOLUTIONS`] what is computed with it, [`ROUND_OFF_OF_PHI`]
//! nearly dependent constraints, [`ROOT_OF_ROUND_OFF`] what is squared on its way, [`HALF_OF_THE_DIGITS`] a difference.
//! People have levels, too: [`SAME`], [`SIX_DIGITS`], [`UNSEEN`], [`TOLD`], [`WRONG_MOTION`] and [`LOST_MOTION`]. A new
//! threshold takes one of these, or says why not.

/// A few operations: what they leave of a coordinate, a velocity or a projection. Unit: `[1]` of the largest number
/// that enters. Why: sixteen ulps, four operations with a factor of four to spare. Test: `order_nine`.
pub const ROUND_OFF: f64 = 16.0 * f64::EPSILON;

/// An entry or a singular value that is what rounding left of a zero. Unit: `[1]` of the largest of its row, or of all.
/// Why: some five ulps. Test: `a_rank_near_the_tolerance_is_doubtful`.
pub const ROUNDED_ZERO: f64 = 1e-15;

/// Sums of some tens of terms, such as forces that balance, products with a matrix, a residual, coordinates of an
/// iteration that no longer falls. Unit: `[1]` of the largest term. Why: some fifty ulps. Test: `chains_are_deflated`.
pub const ROUND_OFF_OF_SUMS: f64 = 1e-14;

/// Pivots and residuals of a matrix after its factorization: a pivot below is no pivot. Unit: `[1]` of its size before
/// the elimination, or of the norm of the matrix. Why: some five hundred ulps: rounding adds up over the columns. Test:
/// `nearly_dependent_rows_are_truncated`.
pub const ROUND_OFF_OF_FACTORS: f64 = 1e-13;

/// Solutions with a factorization, and what is summed or located with them: residuals, energies, symmetry, the end of
/// a search. A pivot below is dropped where the fast factorization has stopped. Unit: `[1]` of the largest that enters.
/// Why: ten times ROUND_OFF_OF_FACTORS. Test: `an_undamped_chain_by_its_stiffness`.
pub const ROUND_OFF_OF_SOLUTIONS: f64 = 1e-12;

/// Zeros whose squares decide, double roots and differences of first order: an iteration no longer falls, redundant
/// rows contradict each other, two mechanisms are the same. Unit: `[1]` of the largest of their kind, or of the range
/// that is searched. Why: the square root of rounding. Test: `redundant_rows_and_singular_positions_are_passed`.
pub const ROOT_OF_ROUND_OFF: f64 = 1e-8;

/// Differences that have lost half of their digits: their sign and what is divided by them tell nothing. Unit: `[1]` of
/// the terms. Why: ten times the square root of rounding. Test: `a_rate_at_a_dead_centre_is_refused`.
pub const HALF_OF_THE_DIGITS: f64 = 1e-7;

/// Places, times, rates and numbers of a scene that agree so far are the same, and a part so small is zero. Unit: `[1]`
/// of the length, step, rate or number that they are compared with. Why: between the round-off of what is computed from
/// a scene and what anybody means.
pub const SAME: f64 = 1e-9;

/// Six digits, with which data are typed and results are printed: what differs by less is the same for the reader, and
/// a smaller part is none. Unit: `[1]` of what it is a part of. Why: far above what rounding leaves. Test:
/// `moments_that_no_body_has_are_made_valid`.
pub const SIX_DIGITS: f64 = 1e-6;

/// A part that no figure shows, or a time that no reader tells from the next. Unit: `[1]` of what it is a part of. Why:
/// three digits. Test: `a_mode_that_no_output_sees_is_told`.
pub const UNSEEN: f64 = 1e-3;

/// What is off, open or near a singular state by this is told, as a warning. Unit: `[1]` of its scale. Why: the promise
/// of the README.
pub const TOLD: f64 = 1e-2;

/// Changes of Newton's method beside its solution shrink to this part of the last one at least; else there is none
/// near, or what is left is round-off. Unit: `[1]`. Why: quadratic convergence does better from the second change on.
pub const NEWTON_HALVES: f64 = 0.5;

/// What round-off leaves of phi where rows depend, or nearly depend, on others. Unit: `[1]` of its scale. Why: above
/// the round-off of chains of transformations. Test:
/// `from_rest_at_a_change_point_it_goes_where_it_is_pushed_or_says_why_not`.
pub const ROUND_OFF_OF_PHI: f64 = 1e-11;

/// What comes no farther than this is no alternative. Unit: `[1]`.
pub const NO_ALTERNATIVE: f64 = 0.5;

/// Newton's iterations of an exact projection; who asks for fewer takes what they leave. Unit: `[iterations]`. Test:
/// `a_low_penalty_has_the_order_of_its_integrator_and_an_error_of_its_own`.
pub const PROJECTIONS: usize = 10;

/// A step that does less than this part of what is predicted to first order is taken back: of the fall of |phi| where
/// phi is linear, of the work by K. Unit: `[1]`. Why: as in line searches and trust regions.
pub const SUFFICIENT_STEP: f64 = 0.1;

/// Changes of q of the search that lead nowhere: nothing holds the body. Unit: `[m, rad]` over 1 and the largest q.
pub const AWAY: f64 = 100.0;

/// Iterations at most beside a solution: of the way back to phi = 0, of Newton's method where the search is all but
/// done. Unit: `[iterations]`. Why: the convergence is quadratic there.
pub const CLOSING_ITERATIONS: usize = 12;

/// The least step of a continuation, in the load of an equilibrium or to the coordinates in `initial`, before it is
/// taken to end. Unit: `[1]` of all. Why: near a dead centre steps shrink with the root of what is left. Test:
/// `a_loop_is_turned_to_an_angle_far_from_the_guess`.
pub const LEAST_PART: f64 = 1e-4;

/// Changes of Newton's method that shrink to this part lead to the one solution around the start. Unit: `[1]`. Why: P.
/// Deuflhard, Newton Methods for Nonlinear Problems, 2011, section 5.1.
pub const UNIQUE_CONTRACTION: f64 = 0.25;

/// Velocities up to which all eigenvalues of a state are computed. Unit: `[velocities]`. Why: time goes with the cube.
pub const DENSE_EIGENVALUES: usize = 300;

/// Modes from which on work for each of them is saved: motions side by side, models between two values. Unit: `[modes]`.
pub const MANY_MODES: usize = 40;

/// The largest rotation of a body in a step of the assembly. Unit: `[rad]`. Why: beyond, a step is none along the
/// circles on which bars move. Test: none: with 0.3 to 3 the same loops close.
pub const LARGEST_TURN: f64 = 0.7;

/// Halvings of a step of the assembly before it is given up. Unit: `[halvings]`.
pub const STEP_HALVINGS: usize = 12;

/// Distance from the guess of the first beginning beside it; the next are farther. Unit: `[rad]`, or the scene's
/// length. Test: `a_guess_on_one_line_is_left`.
pub const BESIDE: f64 = 0.1;

/// Steps at most along the constraints to the state nearest to the guess. Unit: `[steps]`. Why: what is closed can
/// begin.
pub const APPROACH_STEPS: usize = 200;

/// Digits of the value that a driver asks for, and of the end of its travel. Unit: `[digits]`. Why: the end is known to
/// some ten. Test: `a_driver_beyond_its_travel_is_named`.
pub const DIGITS_OF_TRAVEL: usize = 9;

/// The size of an atom: no length is meant that is smaller, and what files or motions have below is round-off. Unit:
/// `[m, rad]`. Test: `moments_of_round_off_are_zero`.
pub const ATOM: f64 = 1e-10;

/// The part of the stagnation tolerance that is round-off: an iteration ends there, and fixed steps converge to it.
/// Unit: `[1]` of the stagnation tolerance. Why: together 1e-15 of v', 1e-16 of v.
pub const ROUND_OFF_OF_STAGNATION: f64 = 1e-7;

/// Corrections at most of a step that cannot be tried smaller. Unit: `[iterations]`. Why: a step that does not converge
/// ends the run. Test: `order_nine`.
pub const FIXED_STEP_ITERATIONS: usize = 50;

/// Changes of the stages of radau_iia that no longer fall are round-off up to so many times that of a few operations.
/// Unit: `[1]`. Why: round-off of many operations. Test: `long_chains_of_beams_take_fixed_steps`.
pub const RADAU_STAGNATION: f64 = 100.0;

/// Sweeps at most that move the stages of rotations along the group. Unit: `[sweeps]`.
pub const RADAU_SWEEPS: usize = 6;

/// The largest component of a rotation vector in a step of radau_iia. Unit: `[rad]`. Why: rotation vectors have a pole
/// at 2 pi. Test: `rotations_about_a_fixed_axis_are_exact`.
pub const RADAU_TURN: f64 = std::f64::consts::PI;

/// The longest step of radau_iia over the one before. Unit: `[1]`. Why: as in RADAU5: stages are extrapolated so far.
/// Test: `no_more_work_than_other_codes`.
pub const RADAU_GROWTH: f64 = 5.0;

/// A motion that misses its start by more is not periodic. Unit: `[1]` of (1 + |q|, |v|). Why: a period written with
/// six digits passes.
pub const PERIODIC: f64 = 1e-5;

/// Tolerance of the variational equations. Unit: `[1]`, rtol. Why: looser than round-off, tighter than what is compared
/// with it. Test: `an_upright_pendulum_is_unstable`.
pub const FLOW_RTOL: f64 = 1e-12;

/// The tightest tolerance by which steps are controlled unless a tighter one is asked for: errors fall in proportion
/// down to a tenth of it. Unit: `[1]`, rtol, and atol of what is of size 1. Test:
/// `motions_that_amplify_a_little_are_as_accurate_as_asked`.
pub const TIGHTEST: f64 = 1e-13;

/// A mode that changes by more in a step may be another. Unit: `[1]`, cost of the match. Why: half of the above.
pub const CHANGED_MODE: f64 = 0.5;

/// Halvings of a step in which it is not clear which mode is which. Unit: `[times]`.
pub const HALVINGS: usize = 6;

/// An order may be this much below 2. Unit: `[1]`.
pub const ORDER_SLACK: f64 = 0.1;

/// Charts from which a limit is extrapolated, at least. Unit: `[charts]`. Why: the first entry of the table with three
/// neighbours.
pub const FEWEST_CHARTS: usize = 4;

/// Singular values that are zero and those that are not, finite and infinite eigenvalues: the least gap between two
/// kinds, else which is which is doubtful, and told so. Unit: `[1]` ratio. Why: one digit. Test:
/// `a_rank_near_the_tolerance_is_doubtful`.
pub const RANK_GAP: f64 = 10.0;

/// Up to so many n + m doubts about the rank are settled by the dense rank-revealing factorization, and condition
/// numbers are those of all eigenvalues. Unit: `[equations]`. Why: 10 to 100 ms there; it costs their cube. Test:
/// `nearly_dependent_rows_are_truncated`.
pub const DENSE_EQUATIONS: usize = 600;

/// Rows of G whose pivot falls below this part of the largest depend on others. Unit: `[1]` of the size of the row.
/// Why: far above the round-off of rows; nearly dependent ones are judged by TRUNCATED_RANK.
pub const RANK: f64 = 1e-10;

/// The rank indicator below which a truncated solution drops a row: near a singular state. Unit: `[1]` of its reference
/// value. Why: with an indicator s round-off moves positions along the nearly dependent row by eps/s, so velocities by
/// eps/s^2 and accelerations by eps/s^3: all of it at 6e-6, the more with drift. Test:
/// `from_rest_at_a_change_point_it_goes_where_it_is_pushed_or_says_why_not`.
pub const TRUNCATED_RANK: f64 = 1e-4;

/// A pivot of the fast factorization, or of a mass matrix, that has collapsed: the careful ways begin. Unit: `[1]` of its
/// size before, or of the largest. Why: ten times ROUND_OFF_OF_SOLUTIONS, for what is doubtful shall be looked at.
pub const COLLAPSED_FAST: f64 = 1e-11;

/// Rates above which an iteration has diverged: after two changes, and later. Unit: `[1]`. Why: of the first two one
/// may have corrected what the start left of its constraints. Test:
/// `an_iteration_that_cannot_arrive_is_given_up_early`.
pub const DIVERGED: [f64; 2] = [2.0, 0.99];

/// Unknowns of a saddle-point matrix, coordinates and multipliers, for each part that it is divided in: with less than
/// two parts it is not. Unit: `[unknowns]`. Why: measured: from some 20,000 unknowns on, 2000 four-bar linkages, two
/// threads are faster than one; below, to wake the other one up takes what it saves. Test:
/// `four_bar_linkages_are_the_same_on_all_threads`.
pub const UNKNOWNS_OF_A_PART: usize = 10_000;

/// Parts of a saddle-point matrix at most. Unit: `[parts]`. Why: inner parts of a chain have two neighbours, and twice
/// the blocks of L; eight make a step of four-bar linkages on one thread 4 % dearer.
pub const MOST_PARTS: usize = 8;

/// Groups of unknowns at most that the parts of a saddle-point matrix have in common; a group that is coupled to more is
/// one of them. Unit: `[groups]`. Why: eight parts of three chains beside each other; elimination of so many, all coupled
/// to each other, is some per cent of that of two parts. Test: `what_is_coupled_everywhere_is_not_divided`.
pub const LARGEST_SEPARATOR: usize = 32;

/// Backward error of the eigenvalues of a dense matrix, and rounding of its entries. Unit: `[1]` of the norm of the
/// balanced matrix. Why: four ulps; the QR algorithm leaves one or two. Test:
/// `a_rigid_body_mode_is_zero_and_a_slow_one_is_not`.
pub const QR_BACKWARD_ERROR: f64 = 4.0 * f64::EPSILON;

/// Differences of eigenvalues that are round-off: modes are one, a pair is conjugate, a real part is none. Unit: `[1]`
/// of the eigenvalue, or of the largest. Why: above the square root of rounding, by which double ones split.
pub const EIGENVALUES_AGREE: f64 = 1e-6;

/// |y| |x| / |y^H x| of eigenvalues from which on their vectors are taken for dependent. Unit: `[1]`.
pub const DEFECTIVE_MODE: f64 = 1e5;

/// A motion whose outputs or energy are off by this is not the one that was asked for. Unit: `[1]` of their scales.
/// Why: the promise of the README.
pub const WRONG_MOTION: f64 = 0.1;

/// A motion that is off by this has left its mechanism: what it does later means nothing. Unit: `[1]` of the scene's
/// size, or of the energy converted. Why: half of it. Test: `joints_that_come_apart_are_a_failure`.
pub const LOST_MOTION: f64 = 0.5;

/// A multiplier may be outside the unit circle by so much. Unit: `[1]`. Why: the root of what integration leaves of a
/// double one.
pub const MULTIPLIER_OUTSIDE: f64 = 1e-5;

/// Steps are placed about a singular state where the rank indicator is below. Unit: `[1]` of the largest so far. Test:
/// `short_steps_stop_before_the_singular_state_until_one_as_long_as_before_goes_over_it`.
pub const PLACED_STEPS: f64 = 0.3;

/// A state whose rank indicator is below is near a singular one. Unit: `[1]` of the largest so far, or of the reference
/// value. Test: `generalized_alpha_passes_the_flat_position`.
pub const NEAR_SINGULAR: f64 = 0.1;

/// A change of the energy balance in a step is an error where it is so many times the others. Unit: `[1]`. Why: those of
/// good steps differ by up to 10; one that left the motion by 200 tolerances had 50. Test:
/// `no_passage_is_wrong_in_silence`.
pub const UNUSUAL_LOSS: f64 = 20.0;

/// Below a stagnation tolerance changes that shrink by less than this no longer fall. Unit: `[1]`. Why: true convergence
/// is faster, round-off has a rate of one. Test: `changes_that_do_not_contract_are_given_up_unless_they_are_round_off`.
pub const STAGNANT: f64 = 0.9;

/// A run with so many turns at thresholds before it, at the rate of the last window, does not come to its end. Unit:
/// `[turns]`.
pub const TURNS: f64 = 5e7;

/// What a function of time may do beside its cubic where an estimate of the error sees to the rest. Unit: `[1]` of how
/// it and its rates change it over a quarter. Test: `a_bump_is_met_whenever_it_comes`.
pub const RESOLVED_ROUGHLY: f64 = 0.1;

/// How often a step is cut to passages on its dense output at most. Unit: `[cuts]`.
pub const CUTS: usize = 10;

/// Numbers of a sum of vectors that are added by one thread at a time. Unit: `[1]`. Why: some 20 us, what another
/// thread takes to wake up.
pub const NUMBERS_OF_A_PORTION: usize = 16_384;
