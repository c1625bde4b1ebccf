//! Every threshold of the crate: numbers on which a decision or the accuracy of a result depends.
//!
//! An entry says what is decided; its unit, `[1]` with what it is relative to, or a unit of measure; why it has this
//! value, derived, measured or, said so, a choice; and a test that changes its result with the threshold a thousand times
//! larger or smaller, or none with the reason. One file a room of the crate; a use reads `tolerances::RANK`.
//!
//! Round-off has four levels, here, by how many operations made the number: [`ROUND_OFF`] a few, [`ROUNDED_ZERO`] one that
//! should be zero, [`ROUND_OFF_OF_SUMS`] some tens, [`ROUND_OFF_OF_FACTORS`] a factorization. What a person calls the same is
//! [`SAME`]. A new threshold takes one of these, unless a comment can say why not.
//!
//! Not here: coefficients of methods, numbers of quadrature points that are exact, limits of sizes of input, budgets of
//! time and memory, and all that is drawn.

pub mod body;
pub mod initial;
pub mod integrator;
pub mod linearize;
pub mod math;
pub mod report;
pub mod simulate;

/// A few operations: what they leave of a coordinate, a velocity or a projection.
/// Unit: [1] of the largest number that enters. Why: sixteen ulps, four operations with a factor of four to spare.
/// Test: none: TODO.
pub const ROUND_OFF: f64 = 16.0 * f64::EPSILON;

/// An entry or a singular value that is what rounding left of a zero.
/// Unit: [1] of the largest of its row, or of all. Why: five ulps. Test: none: TODO.
pub const ROUNDED_ZERO: f64 = 1e-15;

/// Sums of some tens of terms, such as forces that balance, products with a matrix, a residual, coordinates of an
/// iteration that no longer falls.
/// Unit: [1] of the largest term. Why: 45 ulps. Test: none: TODO.
pub const ROUND_OFF_OF_SUMS: f64 = 1e-14;

/// Pivots and residuals of a matrix after its factorization: a pivot below is no pivot.
/// Unit: [1] of its size before the elimination, or of the norm of the matrix. Why: 450 ulps: rounding adds up over
/// columns, and a hundred of them are usual. Test: none: TODO.
pub const ROUND_OFF_OF_FACTORS: f64 = 1e-13;

/// Places, times, rates and numbers of a scene that agree so far are the same, and a part so small is zero.
/// Unit: [1] of the length, step, rate or number that they are compared with. Why: a choice: between the round-off of
/// what is computed from a scene, 1e-12, and what anybody means, 1e-6. Test: none: TODO.
pub const SAME: f64 = 1e-9;

/// Changes of Newton's method beside its solution shrink to this part of the last one at least; else there is none
/// near, or what is left is round-off.
/// Unit: [1]. Why: quadratic convergence does far better from the second change on. Test: none: TODO.
pub const NEWTON_HALVES: f64 = 0.5;
