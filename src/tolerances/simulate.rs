//! The time loop: events, singular states, choice of methods, rows.

pub use super::contest::*;
pub use super::{ROUND_OFF_OF_PHI, ROUND_OFF_OF_SUMS, SAME};

/// A gap that reverses is on one line with itself before within this.
/// Unit: `[1]`, sine of the angle. Why: round-off of positions over the gap; one that turns by half a revolution in a
/// step passes it by chance once in a million steps. Test: `a_spring_passes_its_anchor`.
pub const ON_ONE_LINE: f64 = 1e-7;

/// A gap counts as closed within this.
/// Unit: `[1]` of the scene's length. Why: the force that acts so much too long moves nothing beyond round-off. Test:
/// `a_spring_passes_its_anchor`.
pub const GAP_CLOSED: f64 = 1e-11;

/// The line of a gap is held until it is open by this.
/// Unit: `[1]` of the scene's length. Why: a choice: the direction of a shorter gap is rounded. Test:
/// `a_spring_passes_its_anchor`.
pub const GAP_OPEN: f64 = 1e-3;

/// Looks at the dense output for the time at which a gap closes.
/// Unit: `[looks]`. Why: a choice: it converges in ten. Test: none: a count of work, not tried.
pub const LOOKS_AT_GAP: usize = 40;

/// Coordinates count as far from the origin from here on.
/// Unit: `[1]` of the longest lever of the joints. Why: a choice: nearer ones are rounded by 1e-12 of it. Test:
/// `a_tolerance_below_the_rounding_of_positions_is_refused`.
pub const FAR_FROM_ORIGIN: f64 = 1e4;

/// Rounding of a lever that steps can be controlled with.
/// Unit: `[1]` of rtol. Why: with 2 a double pendulum took three times the steps, with 20 two hundred times. Test:
/// `a_tolerance_below_the_rounding_of_positions_is_refused`.
pub const ROUNDING_TOLERATED: f64 = 4.0;

/// Steps over singular states by which others are judged.
/// Unit: `[steps]`. Why: a choice. Test: `no_passage_is_wrong_in_silence`.
pub const LOSSES_KNOWN: usize = 4;

/// A step over a singular state that changes the energy balance by so many times the largest change before is refused.
/// Unit: `[1]`. Why: those of good steps differ by up to 10; one that left the motion by 200 tolerances had 50. Test:
/// `no_passage_is_wrong_in_silence`.
pub const UNUSUAL_LOSS: f64 = 20.0;

/// Smaller changes of the energy balance refuse no step.
/// Unit: `[1]` of that by the tolerated errors of the state. Why: they move the motion by less than the tolerance.
/// Test: `no_passage_is_wrong_in_silence`.
pub const LOSS_SEEN: f64 = 0.1;

/// Steps of one passage of a singular state that are refused for their energy balance.
/// Unit: `[steps]`. Why: with three some passages ended in steps without a size; what is accepted after that is told.
/// Test: `no_passage_is_wrong_in_silence`.
pub const LOSSES_REFUSED: usize = 1;

/// Error of such a step.
/// Unit: `[tolerated errors]`. Why: the next one is shorter by a half or so. Test: `no_passage_is_wrong_in_silence`.
pub const REFUSED_FOR_ENERGY: f64 = 100.0;

/// A state whose rank indicator is below is near a singular one.
/// Unit: `[1]` of the largest so far. Why: a choice. Test: none: with a thousand times more or less the tests of its
/// room pass.
pub const NEAR_SINGULAR: f64 = 0.1;

/// Steps are placed about a singular state where the rank indicator is below.
/// Unit: `[1]` of the largest so far. Why: a choice. Test:
/// `short_steps_stop_before_the_singular_state_until_one_as_long_as_before_goes_over_it`.
pub const PLACED_STEPS: f64 = 0.3;

/// A state whose rank indicator is below is singular to round-off: no step is placed from it.
/// Unit: `[1]` of the largest so far. Why: a choice. Test:
/// `from_rest_at_a_change_point_it_goes_where_it_is_pushed_or_says_why_not`.
pub const AT_SINGULAR: f64 = 1e-6;

/// Steps near a singular state that are so short will not come over it.
/// Unit: `[1]` of those far from it. Why: a choice. Test: none: with a thousand times more or less the tests of its
/// room pass.
pub const STUCK_AT_SINGULAR: f64 = 1e-8;

/// How late a fixed step over a singular state may start, rather than after a step so short.
/// Unit: `[1]` of the step. Why: a choice. Test: `rk4_with_projection_keeps_its_order_through_the_folds`.
pub const LATE_FIXED_STEP: f64 = 0.05;

/// The local error of a step over a singular state.
/// Unit: `[1]` of the error of the run. Why: a choice: there are few of them. Test:
/// `rk4_with_projection_follows_the_reference`.
pub const SINGULAR_SHARE: f64 = 0.1;

/// Round-off of a projection where the rows of G are well apart: near a singular state it is that over the square of
/// the rank indicator.
/// Unit: `[1]` of the largest state. Why: two operations; with ROUND_OFF, twice as much, motions leave their branch.
/// Test: `every_passage_is_counted_and_none_is_called_left`.
pub const PROJECTION_ROUND_OFF: f64 = 8.0 * f64::EPSILON;

/// Sweeps of a projection near a singular state.
/// Unit: `[sweeps]`. Why: one leaves errors of the positions, over the rank indicator, in the velocities. Test:
/// `from_rest_at_a_change_point_it_goes_where_it_is_pushed_or_says_why_not`.
pub const SINGULAR_SWEEPS: usize = 2;

/// Sweeps of the projection of a row between steps near a singular state.
/// Unit: `[sweeps]`. Why: a row may lie far nearer to it than the ends of steps, and each sweep squares the error of the
/// positions over the rank indicator; four take 1e-3 to round-off at an indicator of 5e-3. Test:
/// `rows_beside_the_folds_are_as_right_as_others`.
pub const SINGULAR_ROW_SWEEPS: usize = 4;

/// A correction of a projection above which it refuses the step.
/// Unit: `[tolerated errors]`. Why: a choice. Test: none: with a thousand times more or less the tests of its room
/// pass.
pub const FAR_CORRECTION: f64 = 10.0;

/// Change of the energy balance that refuses a step near a singular state.
/// Unit: `[1]` of that by the tolerated errors of the state. Why: steps of `dop853` at 1e-5 and 1e-10 change it by 1.2 at
/// most in 35 shipped scenes; wrong ones over flat states by up to a hundred. Test:
/// `flat_states_are_passed_at_any_tolerance`.
pub const SINGULAR_ENERGY: f64 = 2.0;

/// Round-off of a projection above which a state is too near to a singular one.
/// Unit: `[tolerated errors]`. Why: a choice. Test:
/// `from_rest_at_a_change_point_it_goes_where_it_is_pushed_or_says_why_not`.
pub const SINGULAR_ROUND_OFF: f64 = 1e3;

/// A dropped row may be open by so many times what the others are.
/// Unit: `[1]`. Why: a choice: drift may open them all. Test: none: with a thousand times more or less the tests of its
/// room pass.
pub const DROPPED_ROW_OPEN_OF_OTHERS: f64 = 1e3;

/// Turns at thresholds are looked at in windows of so many.
/// Unit: `[turns]`. Why: a choice. Test: none: a count of work, not tried.
pub const TURNS_IN_WINDOW: usize = 250;

/// A run with so many turns at thresholds before it, at the rate of the last window, does not come to its end.
/// Unit: `[turns]`. Why: a choice. Test: none: not tried with other values.
pub const TURNS: f64 = 5e7;

/// Windows of turns in a row that decide. Where each is shorter and slower than the one before, the motion comes to rest at
/// the threshold. Where all turns are nearer to each other than the tolerance, the motion is lost.
/// Unit: `[windows]`. Why: a choice. Test: none: a count of work, not tried.
pub const WINDOWS_IN_ROW: usize = 4;

/// Turns before a run, at the rate of the last window, with which it does not come to its end where the last windows
/// were each shorter and slower than the one before.
/// Unit: `[turns]`. Why: a choice: the motion comes to rest at the threshold, and the turns get ever more. Test: none:
/// not tried with other values.
pub const TURNS_IN_DECAY: f64 = 1e5;

/// Steps that together come no farther than CRAWL end the run.
/// Unit: `[steps]`. Why: a choice. Test: none: with a thousand times more or less the tests of its room pass.
pub const CRAWLING_STEPS: usize = 50_000;

/// Part of the span that CRAWLING_STEPS must exceed.
/// Unit: `[1]` of the span. Why: a choice: at this rate a run takes 5e12 steps. Test: none: with a thousand times more
/// or less the tests of its room pass.
pub const CRAWL: f64 = 1e-8;

/// Joints that are open by this end a run: its motion is not that of the scene.
/// Unit: `[1]` of the scene's size. Why: a choice: half of the size. Test: `joints_that_come_apart_are_a_failure`.
pub const JOINTS_APART: f64 = 0.5;

/// A passage of a threshold nearer to the start of a step than this is at the start.
/// Unit: `[1]` of the step. Why: a choice, some thousand ulps. Test: none: with a thousand times more or less the tests
/// of its room pass.
pub const PASSAGE_AT_START: f64 = 1e-12;

/// Passages are found to this.
/// Unit: `[1]` of the span. Why: what is left of a coordinate there may be round-off. Test: none: with a thousand times
/// more or less the tests of its room pass.
pub const PASSAGE: f64 = 1e-13;

/// Switching functions of switching functions of ... that are settled at the start.
/// Unit: `[levels]`. Why: a choice. Test: none: a count of work, not tried.
pub const NESTED_SWITCHES: usize = 10;

/// An argument is at a threshold within this.
/// Unit: `[1]` of its change over the step. Why: a choice. Test: none: with a thousand times more or less the tests of
/// its room pass.
pub const AT_THRESHOLD: f64 = 1e-10;

/// The dense output is looked at where the cubic between both ends of a step comes nearer to a threshold.
/// Unit: `[1]` of its range. Why: a choice. Test: none: with a thousand times more or less the tests of its room pass.
pub const NEAR_THRESHOLD: f64 = 0.2;

/// Places at which the dense output is looked at where a step comes near a threshold.
/// Unit: `[places]`. Why: a choice. Test: none: with a thousand times more or less the tests of its room pass.
pub const LOOKS_AT_STEP: usize = 8;

/// Halvings of the interval in which the cubic of a step passes a threshold.
/// Unit: `[halvings]`. Why: thresholds a millionth of a step apart are taken in order. Test:
/// `a_law_of_many_kinks_is_found_kink_by_kink`.
pub const HALVINGS_OF_CUBIC: usize = 20;

/// An argument of time that is so near to a threshold may be there.
/// Unit: `[1]` of its largest distance from one. Why: cancellation in a smoothstep leaves 15 ulps. Test:
/// `a_function_that_comes_to_rest_on_a_threshold_passes_it_once`.
pub const TIME_FUNCTION_ROUND_OFF: f64 = 1e-13;

/// Intervals that a search for a change of form may look at; what is left is judged by its ends.
/// Unit: `[intervals]`. Why: a choice. Test: none: with a thousand times more or less the tests of its room pass.
pub const LOOKS_FOR_CHANGE: usize = 20_000;

/// What lasts so long is not missed, nor anything longer.
/// Unit: `[1]` of the span. Why: the promise of the README. Test: `a_bump_is_met_whenever_it_comes`.
pub const NEVER_MISSED: f64 = 1e-4;

/// A window is looked at whole for so many steps of the size at hand.
/// Unit: `[steps]`. Why: a choice of speed. Test: `a_bump_is_met_whenever_it_comes`.
pub const WATCHED_STEPS: f64 = 8.0;

/// What a function of time may do beside its cubic where an estimate of the error sees to the rest.
/// Unit: `[1]` of how it and its rates change it over a quarter. Why: a choice. Test:
/// `a_bump_is_met_whenever_it_comes`.
pub const RESOLVED_ROUGHLY: f64 = 0.1;

/// What a function of time may do beside its cubic where no estimate of the error sees to the rest.
/// Unit: `[1]`, as before. Why: a pulse of a tenth of the step is met to 1e-7 by rk4. Test: none: with a thousand times
/// more or less the tests of its room pass.
pub const RESOLVED_FINELY: f64 = 1e-4;

/// What is nothing of a function of time.
/// Unit: `[its own unit]`. Why: a choice: round-off of a function of order one. Test: none: with a thousand times more
/// or less the tests of its room pass.
pub const NO_FUNCTION: f64 = 1e-14;

/// Enclosures of one window.
/// Unit: `[enclosures]`. Why: with more those of the function are too wide. Test: none: with a thousand times more or
/// less the tests of its room pass.
pub const LOOKS_IN_WINDOW: usize = 100;

/// A step up to so long ends on the next point of a cubic signal.
/// Unit: `[intervals]`. Why: of steps of dop853 over coarse data half were refused; with 3, radau_iia would take a step
/// an interval of fine data. Test: `steps_end_at_points_of_a_coarse_spline`.
pub const NEAR_POINTS: f64 = 1.5;

/// A point of a cubic signal nearer than this counts as reached.
/// Unit: `[1]` of the interval. Why: what the jump of a third derivative does so late is its cube; where stages lie before
/// the point, 0.05 left a thousand times the tolerated error. Test: `steps_end_at_points_that_are_near`.
pub const AT_POINT: f64 = 1e-3;

/// How often a step is cut to passages on its dense output at most.
/// Unit: `[cuts]`. Why: a choice. Test: none: with a thousand times more or less the tests of its room pass.
pub const CUTS: usize = 10;

/// Scenes of this length and more have one absolute tolerance.
/// Unit: `[m]`. Why: README: a scene smaller than a centimetre gets 1e-8 of its length. Test: none: with a thousand
/// times more or less the tests of its room pass.
pub const SHORT_SCENE: f64 = 1e-2;

/// No absolute tolerance that nobody asked for is below.
/// Unit: `[m, rad]`. Why: round-off leaves it of angles. Test: none: with a thousand times more or less the tests of
/// its room pass.
pub const LEAST_ATOL: f64 = 1e-16;

/// Errors of motions that amplify none are to be within so many tolerances.
/// Unit: `[tolerances]`. Why: the promise of the README. Test: none: with a thousand times more or less the tests of
/// its room pass.
pub const ERROR_OF_MOTION: f64 = 10.0;

/// Tolerance of a companion's steps over that of the run's steps, at least.
/// Unit: `[1]`. Why: half of the tenfold tolerance that a companion has. Test:
/// `steps_at_their_tightest_have_a_companion_with_longer_ones`.
pub const COARSER_STEPS: f64 = 5.0;

/// v' of the dense output is a difference over this.
/// Unit: `[1]` of the step. Why: a choice. Test: `rows_do_not_change_the_steps`.
pub const DIFFERENCE_OF_ROWS: f64 = 1e-3;

/// The v' of a row contradicts the dense output where the difference over the step is more than so many tolerated
/// errors of v, and CONTRADICTED_PART.
/// Unit: `[tolerated errors]`. Why: a choice. Test: none: with a thousand times more or less the tests of its room
/// pass.
pub const CONTRADICTED_ERRORS: f64 = 100.0;

/// The v' of a row contradicts the dense output where the difference is also more than this part of all accelerations
/// at hand.
/// Unit: `[1]`. Why: a choice. Test: `rows_do_not_change_the_steps`.
pub const CONTRADICTED_PART: f64 = 0.2;

/// The parts of a fixed step that misses what acts by the clock.
/// Unit: `[1]` of steps on which that is almost cubic. Why: a pulse of a tenth of the step is met to 1e-7 by rk4. Test:
/// none: with a thousand times more or less the tests of its room pass.
pub const FINER_PARTS: f64 = 0.125;

/// The part of what is resolved that one cubic shows.
/// Unit: `[1]`. Why: the quarters between which a function is looked at. Test: none: with a thousand times more or less
/// the tests of its room pass.
pub const SHOWN_BY_CUBIC: f64 = 0.25;

/// A time of the grid of fixed steps nearer than this is passed over.
/// Unit: `[1]` of the step. Why: a choice. Test: `a_run_is_stopped_between_steps`.
pub const PASSED_GRID_TIME: f64 = 1e-3;

/// What round-off may leave of accelerations of constraints, and of their lengths, at a singular start.
/// Unit: `[1]` of the usual ones. Why: a choice. Test: none: with a thousand times more or less the tests of its room
/// pass.
pub const CONTRADICTING_START: f64 = 1e-6;

/// Velocities at a singular start that are none.
/// Unit: `[1]` of what the accelerations would make over the run. Why: a choice. Test: none: with a thousand times more
/// or less the tests of its room pass.
pub const START_AT_REST: f64 = 1e-12;

/// What a rough estimate of the fastest mode may be off by.
/// Unit: `[1]`. Why: a choice. Test: `fixed_steps_that_are_too_long_are_told`.
pub const DOUBTED_MODE: f64 = 0.5;

/// Part of the limit of stability that is advised.
/// Unit: `[1]`. Why: a choice, as of step control. Test: `fixed_steps_that_are_too_long_are_told`.
pub const ADVISED_STEP: f64 = 0.9;

/// Times the limit from which on another method deserves a word.
/// Unit: `[1]`. Why: a choice. Test: `shipped_scenes_are_not_warned_of`.
pub const ANOTHER_METHOD: f64 = 3.0;

/// Steps that an adaptive method may take for stability before anything is asked.
/// Unit: `[steps]`. Why: a choice. Test: `shipped_scenes_are_not_warned_of`.
pub const STEPS_FOR_STABILITY: f64 = 150.0;

/// Velocities from which on a dense formulation deserves a word.
/// Unit: `[velocities]`. Why: a step of a chain takes 100 times as long as by index 1 there, with 300 600 times. Test:
/// `dense_formulations_of_large_systems_are_warned_of`.
pub const LARGE_FOR_DENSE: usize = 100;

/// Constraints that are open by more may be so because a driver is beyond its travel.
/// Unit: `[1]` of their scales. Why: a choice: a look takes some factorizations. Test:
/// `a_driver_beyond_its_travel_is_named`.
pub const TRAVEL_OPEN: f64 = 1e-6;

/// Steps after which the travel of drivers is looked at where no rank indicator is known.
/// Unit: `[steps]`. Why: a choice: a look takes as long as a few steps. Test: `a_driver_beyond_its_travel_is_named`.
pub const TRAVEL_STEPS: usize = 20;

/// A run that fails so soon before the end of a travel fails because of it.
/// Unit: `[1]` of the span. Why: a choice. Test: `a_driver_beyond_its_travel_is_named`.
pub const TRAVEL_AHEAD: f64 = 1e-3;

/// Steps tried that come no farther than TRAVEL_AHEAD: they may crawl towards the end of a travel.
/// Unit: `[steps]`. Why: a choice: a look takes as long as a few steps. Test: `a_driver_beyond_its_travel_is_named`.
pub const TRAVEL_TRIES: usize = 500;

/// The time ahead in which a run that crawls, or fails near a singular state, may come to the end of a travel.
/// Unit: `[1]` of the span. Why: index3 by generalized_alpha fails 0.0035 of it before. Test:
/// `a_driver_beyond_its_travel_is_named`.
pub const TRAVEL_AHEAD_OF_CRAWL: f64 = 1e-2;
