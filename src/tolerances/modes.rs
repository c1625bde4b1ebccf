//! Modes of frozen equations.

/// A mode that is slower is one of rounding, or as good as none.
/// Unit: `[1/s]`. Why: a choice. Test: none: with a thousand times more or less the tests of its room pass.
pub const SLOWEST_MODE: f64 = 1e-6;

/// Iterations for the fastest mode alone.
/// Unit: `[iterations]`. Why: a few percent where others are as fast. Test: `shipped_scenes_are_not_warned_of`.
pub const POWER_ITERATIONS: usize = 60;

/// Differences of eigenvalues that are round-off: modes are one, a pair is conjugate, a real part is none.
/// Unit: `[1]` of the eigenvalue, or of the largest. Why: a choice, above the square root of rounding, by which double
/// ones split. Test: none: not tried with other values.
pub const EIGENVALUES_AGREE: f64 = 1e-6;

/// |y| |x| / |y^H x| of eigenvalues from which on their vectors are taken for dependent.
/// Unit: `[1]`. Why: a choice. Test: none: not tried with other values.
pub const DEFECTIVE_MODE: f64 = 1e5;

/// Imaginary parts that are rounding.
/// Unit: `[1]` of the distance to the shift. Why: a choice: real double eigenvalues split by the root of the residual.
/// Test: none: not tried with other values.
pub const REAL_MODE: f64 = 1e-5;

/// Eigenvectors that a real basis has of a conjugate are no new ones below this.
/// Unit: `[1]`, square of their length. Why: a choice. Test: none: not tried with other values.
pub const NEW_MODE: f64 = 1e-6;

/// The shift for the slowest modes, off the eigenvalues 0 of rigid bodies.
/// Unit: `[1]` of the last of them. Why: a choice. Test: none: not tried with other values.
pub const SHIFT_OF_SLOWEST: f64 = 0.02;

/// Distance of another shift from one that is an eigenvalue.
/// Unit: `[1]` of itself. Why: a choice. Test: none: not tried with other values.
pub const SHIFT_BESIDE: f64 = 1e-3;

/// The slowest rate that rounding in K leaves: slower growth or decay does not tell stability.
/// Unit: `[1]` of the fastest. Why: some ten times the square root of rounding. Test: none: not tried with other
/// values.
pub const ROUNDING_OF_K: f64 = 1e-7;
