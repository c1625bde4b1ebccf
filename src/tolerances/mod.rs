//! Every threshold of the numerics: numbers on which a decision or the accuracy of a result depends.
//!
//! An entry says what is decided; its unit, `[1]` with what it is relative to, or a unit of measure; why it has this value,
//! derived or measured or, where it is that, a choice; and a test that fails where it is a thousand times larger or smaller,
//! or none, with the reason. A file a room of the crate; a use reads `tolerances::RANK`.
//!
//! Round-off has a level by the operations that made the number: [`ROUND_OFF`] a few, [`ROUNDED_ZERO`] one that should be
//! zero, [`ROUND_OFF_OF_SUMS`] some tens, [`ROUND_OFF_OF_FACTORS`] a factorization, [`ROUND_OFF_OF_PHI`] nearly dependent
//! constraints. What a person calls the same is [`SAME`]. A new threshold takes one of these, or says why not.
//!
//! Not here: coefficients of methods, numbers of quadrature points, limits of the size of input, budgets of time and
//! memory, and all that is drawn.

pub mod body;
mod contest;
pub mod initial;
pub mod integrator;
pub mod linearize;
pub mod math;
pub mod modes;
pub mod report;
pub mod simulate;
pub mod system;

/// A few operations: what they leave of a coordinate, a velocity or a projection.
/// Unit: `[1]` of the largest number that enters. Why: sixteen ulps, four operations with a factor of four to spare.
/// Test: `order_nine`.
pub const ROUND_OFF: f64 = 16.0 * f64::EPSILON;

/// An entry or a singular value that is what rounding left of a zero.
/// Unit: `[1]` of the largest of its row, or of all. Why: some five ulps. Test:
/// `a_rank_near_the_tolerance_is_doubtful`.
pub const ROUNDED_ZERO: f64 = 1e-15;

/// Sums of some tens of terms, such as forces that balance, products with a matrix, a residual, coordinates of an
/// iteration that no longer falls.
/// Unit: `[1]` of the largest term. Why: some fifty ulps. Test: `chains_are_deflated`.
pub const ROUND_OFF_OF_SUMS: f64 = 1e-14;

/// Pivots and residuals of a matrix after its factorization: a pivot below is no pivot.
/// Unit: `[1]` of its size before the elimination, or of the norm of the matrix. Why: some five hundred ulps: rounding
/// adds up over the columns. Test: `nearly_dependent_rows_are_truncated`.
pub const ROUND_OFF_OF_FACTORS: f64 = 1e-13;

/// Places, times, rates and numbers of a scene that agree so far are the same, and a part so small is zero.
/// Unit: `[1]` of the length, step, rate or number that they are compared with. Why: a choice, between the round-off of
/// what is computed from a scene and what anybody means. Test: none: with a thousand times more or less the tests of
/// its room pass.
pub const SAME: f64 = 1e-9;

/// Changes of Newton's method beside its solution shrink to this part of the last one at least; else there is none
/// near, or what is left is round-off.
/// Unit: `[1]`. Why: a choice: quadratic convergence does better from the second change on. Test: none: not tried with
/// other values.
pub const NEWTON_HALVES: f64 = 0.5;

/// Changes of an iteration that no longer fall are round-off up to here: of q of an equilibrium, of v' of a step.
/// Unit: `[1]` of the largest, of q of 1 m or rad at least. Why: the square root of rounding: of two corrections that
/// small the second is nothing. Test: `redundant_rows_and_singular_positions_are_passed`.
pub const NEWTON_STAGNATION: f64 = 1e-8;

/// Largest phi of redundant rows of a state that is found: by that they may contradict each other.
/// Unit: `[1]` of its scale. Why: a choice: the square root of rounding. Test: none: with a thousand times more or less
/// the tests of its room pass.
pub const REDUNDANT_ROWS_CLOSED: f64 = 1e-8;

/// What round-off leaves of phi where rows depend, or nearly depend, on others.
/// Unit: `[1]` of its scale. Why: a choice, above the round-off of chains of transformations. Test:
/// `from_rest_at_a_change_point_it_goes_where_it_is_pushed_or_says_why_not`.
pub const ROUND_OFF_OF_PHI: f64 = 1e-11;
