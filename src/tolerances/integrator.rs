//! Iterations and steps of the integrators.

pub use super::{ROUND_OFF, ROUND_OFF_OF_SUMS, ROUNDED_ZERO};

/// Changes of v' that no longer fall are round-off up to here.
/// Unit: [1] of the largest v', and of v/h. Why: the square root of rounding: of two corrections that small the second
/// is nothing. Test: none: TODO.
pub const STAGNATION_OF_ACCELERATION: f64 = 1e-8;

/// The same of v at the middle of a step of rattle.
/// Unit: [1] of the largest v. Why: a tenth of that of v', since it is iterated without a matrix and kept for millions
/// of steps. Test: none: TODO.
pub const STAGNATION_OF_VELOCITY: f64 = 1e-9;

/// The part of these changes that is round-off: an iteration ends there, and fixed steps converge to it.
/// Unit: [1] of the stagnation tolerance. Why: together 1e-15 or 1e-16, some ulps. Test: none: TODO.
pub const ROUND_OFF_OF_STAGNATION: f64 = 1e-7;

/// Error of v' that may be left where steps are controlled.
/// Unit: [1] of the stagnation tolerance. Why: phi is round-off then, and no more is asked of v'. Test: none: TODO.
pub const CONTROLLED_ERROR: f64 = 1e-6;

/// The largest q is taken for no smaller than this where round-off is told.
/// Unit: [m, rad]. Why: a choice: scenes of nanometres keep a meaning, and a start at the origin a scale. Test: none:
/// TODO.
pub const LEAST_LARGEST_Q: f64 = 1e-10;

/// Corrections at most of a step of generalized_alpha.
/// Unit: [iterations]. Why: as many as far predictions and kinks of forces want. Test: none: TODO.
pub const GENERALIZED_ALPHA_ITERATIONS: usize = 25;

/// Corrections at most of a step that cannot be tried smaller.
/// Unit: [iterations]. Why: a choice: a step that does not converge ends the run. Test: none: TODO.
pub const FIXED_STEP_ITERATIONS: usize = 50;

/// Iterations at most of rattle.
/// Unit: [iterations]. Why: its matrix has no K: the contraction is h^2 K/M, so that more are needed. Test: none: TODO.
pub const RATTLE_ITERATIONS: usize = 100;

/// Largest phi of a step of ali3p that has converged.
/// Unit: [1] of its scale. Why: a choice: what redundant rows contradict each other by is allowed, and no more. Test:
/// none: TODO.
pub const PENALTY_CLOSED: f64 = 1e-8;

/// Rate of convergence up to which the matrix serves the next step too.
/// Unit: [1]. Why: an iteration more costs far less than K and C. Test: none: TODO.
pub const GENERALIZED_ALPHA_MATRIX_KEPT: f64 = 1e-2;

/// It serves steps up to this factor longer or shorter.
/// Unit: [1]. Why: M is most of it in short ones, and the rate is watched. Test: none: TODO.
pub const MATRIX_BAND: f64 = 1.3;

/// The same of radau_iia.
/// Unit: [1]. Why: an iteration more costs an evaluation a stage, about as much as a new matrix does. Test: none: TODO.
pub const RADAU_MATRIX_KEPT: f64 = 3e-5;

/// Corrections of a fixed step of radau_iia that may grow.
/// Unit: [iterations]. Why: a choice: stiff beams start far off, and the step cannot be tried smaller. Test: none:
/// TODO.
pub const RADAU_PATIENCE: usize = 10;

/// Changes that no longer fall are round-off up to this, over the round-off of a few operations.
/// Unit: [1]. Why: a choice: stages, K, C and the back-substitution are some hundreds of operations, whose errors add
/// up as their root. Test: none: TODO.
pub const RADAU_STAGNATION: f64 = 100.0;

/// The least rate by which the error that an iteration leaves is told.
/// Unit: [1]. Why: two changes tell little of the rate. Test: none: TODO.
pub const RADAU_LEAST_RATE: f64 = 0.1;

/// Sweeps at most that move the stages of rotations along the group.
/// Unit: [sweeps]. Why: a choice. Test: none: TODO.
pub const RADAU_SWEEPS: usize = 6;

/// Steps at one order before it may change.
/// Unit: [steps]. Why: a choice: the decay of the coefficients is that of the motion then. Test: none: TODO.
pub const RADAU_STEADY: usize = 4;

/// The gain in work that is worth a change of the order.
/// Unit: [1]. Why: a choice: the forecast is not better. Test: none: TODO.
pub const RADAU_GAIN: f64 = 1.2;

/// Contraction of Newton's method that a larger step may come to.
/// Unit: [1]. Why: a choice: a digit takes two and a half iterations. Test: none: TODO.
pub const RADAU_SLOW: f64 = 0.4;

/// Largest phi of rows that say the same as others, above which they contradict each other.
/// Unit: [1] of its scale. Why: round-off of phi, and a hundred for chains. Test: none: TODO.
pub const REDUNDANT_ROWS_OPEN: f64 = 1e-11;

/// The largest rho_inf of generalized_alpha with index3.
/// Unit: [1]. Why: with 0.98 the energy of a pendulum grows a million times in steps of a hundredth of its period.
/// Test: none: TODO.
pub const UNDAMPED_WITH_POSITIONS: f64 = 0.9;

/// Steps are not controlled more tightly than this unless that is asked for.
/// Unit: [1]. Why: Newton's methods, which go two digits further, and projections near singular states come near
/// round-off. Test: none: TODO.
pub const CONTROLLED_RTOL: f64 = 1e-11;

/// How often a guess of the first step is divided by ten where y' has no value ahead.
/// Unit: [divisions]. Why: a choice: beyond, it is shorter than a step that makes sense. Test: none: TODO.
pub const FIRST_STEP_SHORTER: usize = 20;

/// The longest guess of the first step.
/// Unit: [1] of the span. Why: as in SUNDIALS IDA. At rest y' is round-off and sets no time of its own, and a load that
/// rises there is seen early, if at all. Test: none: TODO.
pub const FIRST_STEP_OF_SPAN: f64 = 1e-3;

/// Tolerated error of unknowns of diffsol that are not tested: those without a rate, angles that count turns, and the
/// work.
/// Unit: [unit of the unknown]. Why: infinity would make its norms no numbers. Test: none: TODO.
pub const NOT_TESTED: f64 = 1e20;

/// What a step may grow a radian, in ln |x|, at the limit of stability.
/// Unit: [1]. Why: all but a few methods grow a little on the imaginary axis, however short the steps. Test: none:
/// TODO.
pub const STABILITY_GROWTH: f64 = 1e-3;

/// Contraction of an iteration without a matrix at its limit.
/// Unit: [1]. Why: a hundred rounds bring it to round-off. Test: none: TODO.
pub const ITERABLE: f64 = 0.8;

/// Limits of stability are sought up to this |z|.
/// Unit: [1]. Why: no explicit method of the registry comes farther. Test: none: TODO.
pub const FARTHEST_LIMIT: f64 = 50.0;

/// In such steps, and refined.
/// Unit: [1]. Why: shorter than what a method may lose and win back on its way. Test: none: TODO.
pub const STRIDE_TO_LIMIT: f64 = 0.01;
