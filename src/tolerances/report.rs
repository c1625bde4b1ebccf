//! What is told, and warned of: drift, energy, singular states, comparisons.

pub use super::SAME;
use std::f64::consts::FRAC_PI_6;

/// A length, an angle, a speed or a swing of the kinetic energy that is smaller is zero by symmetry, or as good as
/// that: no errors are relative to it.
/// Unit: `[1]` of the largest of its kind. Why: the promise of the README. Test: none: not tried with other values.
pub const ZERO_BY_SYMMETRY: f64 = 1e-3;

/// Energies in which rounding leaves this part of themselves show nothing below it.
/// Unit: `[1]`. Why: a choice. Test: none: not tried with other values.
pub const ENERGY_ROUND_OFF: f64 = 1e-12;

/// A motion that turns over this part of what is tolerated is none.
/// Unit: `[1]`. Why: a choice. Test: none: not tried with other values.
pub const ENERGY_UNSEEN: f64 = 1e-3;

/// A balance that is open by this part is that of another motion: a warning.
/// Unit: `[1]` of the energy converted. Why: the promise of the README. Test: none: not tried with other values.
pub const ENERGY_OPEN: f64 = 0.01;

/// An output row whose energy is off by so many errors of the steps is not of their motion: a warning.
/// Unit: `[1]`. Why: a choice: dense output is less accurate than steps by ten or so. Test:
/// `a_row_that_no_step_confirms_is_told`.
pub const ROW_BEYOND_STEPS: f64 = 1e3;

/// The balance of a good run is open by less than so many times what the tolerance lets it.
/// Unit: `[1]`. Why: the promise of the README. Test: none: not tried with other values.
pub const ENERGY_BEYOND: f64 = 10.0;

/// The change of the energy balance in one step may be an error where it is so many times that in any other.
/// Unit: `[1]`. Why: those of good runs differ by up to 10. Test: `no_passage_is_wrong_in_silence`.
pub const CHANGE_ALONE: f64 = 20.0;

/// Such a change is seen from here on.
/// Unit: `[1]` of that by the tolerated errors of the step. Why: below, the motion is within its tolerance. Test:
/// `no_passage_is_wrong_in_silence`.
pub const CHANGE_SEEN: f64 = 0.3;

/// Steps among which one may be alone.
/// Unit: `[steps]`. Why: a choice. Test: none: not tried with other values.
pub const STEPS_COMPARED: usize = 10;

/// Up to so many times what the forces give over a length of the scene, a state shows what the scene holds.
/// Unit: `[1]`. Why: a choice: bodies move some lengths. Test: `a_motion_that_a_force_feeds_without_end_ends`.
pub const ENERGY_OF_EFFORT: f64 = 10.0;

/// A motion may diverge whose energy is beyond what the scene holds by this.
/// Unit: `[1]`. Why: no scene travels a million of its lengths under its largest force. Test:
/// `a_motion_that_a_force_feeds_without_end_ends`.
pub const ENERGY_DIVERGED: f64 = 1e6;

/// Growth of the energy between two looks at the forces.
/// Unit: `[1]`. Why: a choice. Test: `a_motion_that_a_force_feeds_without_end_ends`.
pub const ENERGY_LOOKED: f64 = 4.0;

/// A force grows with a motion that diverges by this between two looks.
/// Unit: `[1]`. Why: one that is proportional to the motion grows by 2. Test:
/// `a_motion_that_a_force_feeds_without_end_ends`.
pub const FEED_GROWN: f64 = 1.5;

/// Distance to the nearby state that tells a singular one from redundant rows.
/// Unit: `[m, rad]`. Why: a choice. Test: none: not tried with other values.
pub const STATE_BESIDE: f64 = 1e-3;

/// Error of the cubic between two rows of a finished run above which drawings between them are doubtful.
/// Unit: `[1]` of the scene's length, or rad. Why: it is seen in a figure. Test: `a_finished_run_is_drawn`.
pub const BETWEEN_ROWS: f64 = 0.01;

/// Newton's steps to bring it to the constraints.
/// Unit: `[steps]`. Why: a choice. Test: none: a count of work, not tried.
pub const STATE_BESIDE_SWEEPS: usize = 8;

/// States on the way to a singular one are kept each time the rank indicator has halved since the last.
/// Unit: `[1]`. Why: a choice. Test: none: not tried with other values.
pub const WAY_HALVED: f64 = 0.5;

/// The way is followed below this part of the largest rank indicator.
/// Unit: `[1]`. Why: a choice. Test: none: not tried with other values.
pub const WAY_BEGINS: f64 = 0.3;

/// Velocities are compared at so many times the least rank indicator.
/// Unit: `[1]`. Why: a choice. Test: none: not tried with other values.
pub const WAY_COMPARED: f64 = 6.0;

/// The state after the one that is compared is at least so much farther on.
/// Unit: `[1]` of the time between those compared. Why: a choice. Test: none: not tried with other values.
pub const WAY_APART: f64 = 0.25;

/// A change of the velocity that no smooth motion makes.
/// Unit: `[1]` of its size. Why: a choice. Test: none: not tried with other values.
pub const JUMPED: f64 = 0.1;

/// A jump of the velocity is beside so many times what the lower rule makes of the same accelerations otherwise.
/// Unit: `[1]`. Why: a choice: over long steps both rules err. Test: none: not tried with other values.
pub const JUMP_DOUBTED: f64 = 3.0;

/// A change of the velocity by this part of its size is a jump whatever the rules err by.
/// Unit: `[1]`. Why: a choice. Test: none: not tried with other values.
pub const JUMP_DOUBTED_MOST: f64 = 0.5;

/// Drift that can turn a motion at a singular state: of the positions relative to the square of the rank indicator, of
/// the velocities relative to it.
/// Unit: `[1]`. Why: a choice. Test: none: not tried with other values.
pub const DRIFT_TURNS: f64 = 0.01;

/// Dips of the rank indicator that are looked at.
/// Unit: `[1]` of the largest. Why: a choice. Test: none: time alone depends on it.
pub const DIP_OF_RANK: f64 = 0.8;

/// A state is told as near to a singular one whose rank indicator is below.
/// Unit: `[1]` of the largest. Why: a choice. Test: none: not tried with other values.
pub const TOLD_NEAR_SINGULAR: f64 = 1e-2;

/// A state is told as singular whose rank indicator is below.
/// Unit: `[1]` of the largest. Why: a choice. Test: none: not tried with other values.
pub const TOLD_SINGULAR: f64 = 1e-3;

/// Drift may turn the motion where the rank indicator is below.
/// Unit: `[1]` of the largest. Why: a choice. Test: none: not tried with other values.
pub const DRIFT_MAY_TURN: f64 = 0.2;

/// Unknowns up to which the joints that depend on each other are named.
/// Unit: `[unknowns]`. Why: a choice: time goes with the cube. Test: none: time alone depends on it.
pub const NAMED_DEPENDENT_JOINTS: usize = 1000;

/// Unknowns up to which the condition number of the nearest state is computed.
/// Unit: `[unknowns]`. Why: a choice: time goes with the cube. Test: none: time alone depends on it.
pub const CONDITION_OF_RUN: usize = 300;

/// Golden sections for a passage of a singular state end here.
/// Unit: `[1]` of a path. Why: a choice. Test: none: not tried with other values.
pub const GOLDEN_SHORTEST: f64 = 1e-6;

/// Golden sections for a passage also end where the rank indicator is this part of TOLD_NEAR_SINGULAR.
/// Unit: `[1]`. Why: a choice. Test: none: not tried with other values.
pub const GOLDEN_NEAR: f64 = 5e-4;

/// The points of the two lines that meet in a passage, by the rank indicator as a part of what counts as near.
/// Unit: `[1]`. Why: the lines are straight there, and round-off is small. Test: none: not tried with other values.
pub const LINES_ASIDE: f64 = 2e-2;

/// Newton's steps that bring a path back to the drift of the motion.
/// Unit: `[steps]`. Why: a choice. Test: none: a count of work, not tried.
pub const PATH_SWEEPS: usize = 2;

/// A motion whose outputs or energy are off by this is not the one that was asked for.
/// Unit: `[1]` of their scales. Why: the promise of the README. Test: none: not tried with other values.
pub const WRONG_MOTION: f64 = 0.1;

/// Errors that are those of the reference.
/// Unit: `[1]` of the scales. Why: a choice, above REFERENCE_RTOL. Test: none: not tried with other values.
pub const REFERENCE_NOISE: f64 = 1e-9;

/// Tolerance of the references of stress.
/// Unit: `[1]`, rtol. Why: the tightest of the tolerances that methods are tried at. Test: none: not tried with other
/// values.
pub const REFERENCE_RTOL: f64 = 1e-13;

/// Joints that are open by this make a motion meaningless.
/// Unit: `[1]` of the scene's size. Why: a choice. Test: none: not tried with other values.
pub const MEANINGLESS: f64 = 0.1;

/// A run that stopped had diverged before if its energy error is this.
/// Unit: `[1]` of the energy converted. Why: a choice. Test: none: not tried with other values.
pub const BLOWN_UP: f64 = 0.5;

/// Costs within this factor of the least are a tie.
/// Unit: `[1]`. Why: counted work tells times no better; a choice. Test: none: not tried with other values.
pub const TIED_COSTS: f64 = 1.15;

/// Drift that is round-off: two runs below tie.
/// Unit: `[1]` of the scene's size. Why: a choice. Test: none: not tried with other values.
pub const DRIFT_ROUND_OFF: f64 = 1e-12;

/// The tightest relative tolerance that a model is measured by.
/// Unit: `[1]`. Why: the accurate run that it is measured against is a tenth of that at least, where round-off begins.
/// Test: none: no shipped scene comes there.
pub const TIGHTEST: f64 = 1e-12;

/// How much tighter the run is that tells a model's own error.
/// Unit: `[1]`. Why: a choice: two digits. Test: none: not tried with other values.
pub const MODEL_TIGHTER: f64 = 1e-2;

/// The reference's error over what is asked for.
/// Unit: `[1]`. Why: a choice: one digit. Test: none: not tried with other values.
pub const REFERENCE_MARGIN: f64 = 0.1;

/// Part of the budget below which a run is quick.
/// Unit: `[1]`. Why: a choice. Test: none: not tried with other values.
pub const QUICK_RUN: f64 = 5e-4;

/// Accelerations of a start that rests.
/// Unit: `[1]` of the largest that single forces make. Why: those of a scene whose data are given to seven digits.
/// Test: none: not tried with other values.
pub const RESTING_START: f64 = 1e-6;

/// Joints that are open by this at the end: a warning.
/// Unit: `[1]` of the scene's size. Why: a choice. Test: none: not tried with other values.
pub const JOINTS_OPEN: f64 = 1e-2;

/// Assembly that moves a position by so many lengths of the mechanism may have found another configuration than the one
/// that was meant.
/// Unit: `[1]`. Why: a choice. Test: none: not tried with other values.
pub const ASSEMBLY_MOVED: f64 = 1.0;

/// Assembly that turns a body by more may have found another configuration than the one that was meant.
/// Unit: `[rad]`. Why: a choice: a guess by hand is nearer, and branches are farther apart. Test:
/// `a_doubtful_start_is_said`.
pub const ASSEMBLY_TURNED: f64 = FRAC_PI_6;

/// A tyre whose wheel starts above the road by more pulls it down.
/// Unit: `[1]` of the radius. Why: a choice: below a static compression of some 5 %. Test:
/// `a_tyre_that_pulls_or_sinks_is_said`.
pub const TYRE_PULLS: f64 = 1e-2;

/// A signal that keeps the value of an end for a larger part of a run deserves a warning.
/// Unit: `[1]` of the run. Why: most of it. Test: `a_signal_that_ends_early_is_said`.
pub const HELD_SIGNAL: f64 = 0.5;

/// A guess whose axes have a smaller cosine has them against each other.
/// Unit: `[1]`. Why: a choice: within 26 degrees of opposite. Test: none: not tried with other values.
pub const AXES_AGAINST: f64 = -0.9;

/// A multiplier may be outside the unit circle by so much.
/// Unit: `[1]`. Why: the root of what integration leaves of a double one. Test: none: not tried with other values.
pub const MULTIPLIER_OUTSIDE: f64 = 1e-5;

/// Parts of bodies in a mode that are left out of a file.
/// Unit: `[1]` of its kinetic energy. Why: a choice. Test: none: not tried with other values.
pub const PART_OF_MODE: f64 = 1e-3;

/// Ends of a branch are found to this.
/// Unit: `[1]` of the range. Why: a choice: the README promises a millionth. Test: none: not tried with other values.
pub const PARAMETER_END: f64 = 1e-8;

/// Distance at which the other branch is looked for beside an end.
/// Unit: `[1]` of the range. Why: at a distance d the state is as far away as the root of d. Test: none: not tried with
/// other values.
pub const BRANCH_BESIDE: f64 = 1e-2;

/// A change of the scene that is estimated, from the start alone, to have less of an effect looks harmless.
/// Unit: `[1]`, as the estimates. Why: a choice. Test: `a_light_link_looks_superfluous_and_a_heavy_one_does_not`.
pub const SUPERFLUOUS: f64 = 1e-3;

/// Outputs that change by less with a mode do not see it.
/// Unit: `[1]` of their change with another mode of the same kinetic energy. Why: a choice. Test:
/// `a_mode_that_no_output_sees_is_told`.
pub const UNSEEN_MODE: f64 = 1e-3;

/// The square of a phase of a shape that is smaller is rounding.
/// Unit: `[1]` of the largest component. Why: the square of what rounding leaves of double eigenvalues. Test: none: not
/// tried with other values.
pub const NO_PHASE: f64 = 1e-6;

/// Steps that end at round-off, from which on they deserve a warning.
/// Unit: `[1]` of all steps. Why: a choice. Test: `errors_at_round_off_are_told`.
pub const STEPS_AT_ROUND_OFF: f64 = 0.1;

/// Steps of the phase that are so near to 180 degrees are those of an undamped response.
/// Unit: `[deg]`. Why: a choice: ten digits of a response of a damped one are farther away. Test: none: not tried with
/// other values.
pub const UNDAMPED_PHASE: f64 = 1e-3;

/// A branch that was left so soon before a run ended was left because of what ended it.
/// Unit: `[1]` of the time. Why: a choice. Test: `a_driver_beyond_its_travel_is_named`.
pub const LEFT_AT_END: f64 = 1e-5;

/// Error of an eigenvalue that is told beside the table.
/// Unit: `[1]` of it. Why: a choice: four of the six digits that are printed hold. Test:
/// `eigenvalues_have_their_errors`.
pub const DOUBTFUL_DIGITS: f64 = 1e-4;
