//! Assembly, static equilibrium, charts and projections: what makes a state consistent.

pub use super::{NEWTON_HALVES, ROUND_OFF_OF_SUMS, SAME};

/// What is left of a column of Z Z^T where all directions of motion are found.
/// Unit: [1] of the column without constraints. Why: round-off of the saddle-point system, 1e-16, over the square of
/// TRUNCATED_RANK is less. Test: none: TODO.
pub const NO_DIRECTION: f64 = 1e-10;

/// Entries of Z^T M Z may differ so much from those of the identity.
/// Unit: [1]. Why: beyond, the directions are found again with another start. Test: none: TODO.
pub const ORTHONORMAL: f64 = 1e-6;

/// Changes in the chart of minimal coordinates that no longer fall are round-off up to here.
/// Unit: [1] of the largest component. Why: G near a singular state amplifies an ulp so far. Test: none: TODO.
pub const CHART_STAGNATION: f64 = 1e-9;

/// Newton's iterations of an exact projection; who asks for fewer takes what they leave.
/// Unit: [iterations]. Why: a choice. Test: none: TODO.
pub const PROJECTIONS: usize = 10;

/// Steps at most of the descent to an equilibrium in pseudo-time.
/// Unit: [steps]. Why: a choice. Test: none: TODO.
pub const DESCENT_STEPS: usize = 500;

/// Length of the first of them.
/// Unit: [m, rad]. Why: rotations must stay small; later ones grow by what they reach. Test: none: TODO.
pub const DESCENT_FIRST: f64 = 0.1;

/// Newton's method is tried when the force has fallen by this since it was tried last.
/// Unit: [1]. Why: a choice: it costs as much as some steps of the descent. Test: none: TODO.
pub const DESCENT_FALL: f64 = 0.03;

/// Work of a step over what K predicts, below which it is taken back.
/// Unit: [1]. Why: as trust regions do. Test: none: TODO.
pub const DESCENT_TAKEN_BACK: f64 = 0.1;

/// The same, below which the next step is shorter.
/// Unit: [1]. Why: as before. Test: none: TODO.
pub const DESCENT_SHORTER: f64 = 0.4;

/// The same, above which the next one is longer.
/// Unit: [1]. Why: as before. Test: none: TODO.
pub const DESCENT_LONGER: f64 = 0.75;

/// Changes of q of the search that lead nowhere: nothing holds the body.
/// Unit: [m, rad] over 1 and the largest q. Why: a hundred turns, or a hundred times the scene. Test: none: TODO.
pub const AWAY: f64 = 100.0;

/// The shift of K, over the first, at which steps no longer move anything.
/// Unit: [1]. Why: a step is 1e-13 m or rad then. Test: none: TODO.
pub const DESCENT_STIFFEST: f64 = 1e12;

/// Iterations at most beside a solution: of the way back to phi = 0, of Newton's method where the search is all but
/// done.
/// Unit: [iterations]. Why: a choice: the convergence is quadratic there. Test: none: TODO.
pub const CLOSING_ITERATIONS: usize = 12;

/// Largest phi of a step of the descent that no longer falls.
/// Unit: [1] of the scene's scale. Why: round-off of phi over nearly dependent rows. Test: none: TODO.
pub const CLOSING_STAGNATION: f64 = 1e-11;

/// Further iterations of a step of the descent, at the same shift.
/// Unit: [iterations]. Why: a choice: they settle what swings stiffly. Test: none: TODO.
pub const RELAXATIONS: usize = 6;

/// A direction that nothing holds is loaded where the force along it is this part of all.
/// Unit: [1]. Why: a million times round-off. Test: none: TODO.
pub const LOADED: f64 = 1e-6;

/// First part of the load that is taken away.
/// Unit: [1]. Why: a choice. Test: none: TODO.
pub const LOAD_FIRST: f64 = 0.1;

/// The smallest part, below which there is no equilibrium on this branch.
/// Unit: [1]. Why: a choice: a limit load to four digits. Test: none: TODO.
pub const LOAD_SMALLEST: f64 = 1e-4;

/// How often the load may change.
/// Unit: [steps]. Why: a choice. Test: none: TODO.
pub const LOAD_CHANGES: usize = 400;

/// What is left of the forces of an equilibrium that was found.
/// Unit: [1] of those that balance. Why: a choice: far above round-off, also where stiff beams amplify that of q. Test:
/// none: TODO.
pub const FORCE_LEFT: f64 = 1e-6;

/// Round-off of coordinates where a search for an equilibrium began, times the stiffness: a force that cannot be taken
/// away.
/// Unit: [1] of the largest q. Why: 450 ulps, as ROUND_OFF_OF_FACTORS. Test: none: TODO.
pub const COORDINATES_ROUNDED: f64 = 1e-13;

/// How far an element of a beam may turn at an equilibrium, over what is warned of.
/// Unit: [1]. Why: 0.95 of what it can turn at all. Test: none: TODO.
pub const TOO_FAR_TURNED: f64 = 0.95 / 0.75;

/// Largest phi of dropped rows at an equilibrium.
/// Unit: [1] of its scale. Why: they follow from the others to the square root of rounding, where these are nearly
/// dependent. Test: none: TODO.
pub const REDUNDANT_ROWS_CLOSED: f64 = 1e-8;

/// Undamped iterations at most of Newton's method on the forces.
/// Unit: [iterations]. Why: bent beams need steps that grow before they shrink. Test: none: TODO.
pub const FULL_ITERATIONS: usize = 40;

/// Damped iterations at most.
/// Unit: [iterations]. Why: a choice: the descent comes next. Test: none: TODO.
pub const DAMPED_ITERATIONS: usize = 60;

/// Changes of Newton's method that shrink to this part lead to the one solution around the start.
/// Unit: [1]. Why: P. Deuflhard, Newton Methods for Nonlinear Problems, 2011, section 5.1. Test: none: TODO.
pub const UNIQUE_CONTRACTION: f64 = 0.25;

/// Where two changes of q in a row are shorter the second is round-off, for of the first its square is left, or no
/// longer falls.
/// Unit: [m, rad] over 1 and the largest q. Why: the square root of rounding. Test: none: TODO.
pub const EQUILIBRIUM_STAGNATION: f64 = 1e-8;

/// The shortest damped step, as part of the full one.
/// Unit: [1]. Why: ten halvings; then the descent begins. Test: none: TODO.
pub const SHORTEST_DAMPED: f64 = 1e-3;

/// Terms of a balance of forces below this part of the largest of all are as good as none.
/// Unit: [1]. Why: the square root of rounding. Test: none: TODO.
pub const BALANCED_LEAST: f64 = 1e-8;

/// Velocities up to which all eigenvalues of a state are computed.
/// Unit: [velocities]. Why: a choice: time goes with the cube. Test: none: TODO.
pub const DENSE_EIGENVALUES: usize = 300;

/// Part of K that may be skew before its eigenvalues do not tell stability.
/// Unit: [1] of the largest entry. Why: forces without a potential show far more, round-off far less. Test: none: TODO.
pub const SKEW: f64 = 1e-6;

/// A coordinate that is named takes part in a direction by this part of the largest.
/// Unit: [1]. Why: a choice of how much a message says. Test: none: TODO.
pub const TAKES_PART: f64 = 0.3;

/// Newton's iterations at most from a guess to the state that continues the one it was taken from.
/// Unit: [iterations]. Why: a choice. Test: none: TODO.
pub const FOLLOWING_ITERATIONS: usize = 20;

/// Changes of q at which it ends.
/// Unit: [m, rad] over 1 and the largest q. Why: round-off over the rank indicator near a singular state. Test: none:
/// TODO.
pub const FOLLOWED: f64 = 1e-11;

/// Weight of directions without mass in the metric of the assembly.
/// Unit: [1] of the largest mass. Why: they move freely, and the matrix is still far from singular. Test: none: TODO.
pub const LEAST_WEIGHT: f64 = 1e-6;

/// Iterations at most of the assembly.
/// Unit: [iterations]. Why: a choice: guesses may be far off. Test: none: TODO.
pub const ASSEMBLY_ITERATIONS: usize = 200;

/// The largest phi of a closed loop after assembly.
/// Unit: [1] of the scene's scale. Why: round-off of chains of transformations, up to thousands of them. Test: none:
/// TODO.
pub const CLOSED: f64 = 1e-10;

/// A start that keeps less than this part of the given velocities contradicts the joints.
/// Unit: [1]. Why: a million times below what was given it is no start that anybody meant. Test: none: TODO.
pub const VELOCITIES_KEPT: f64 = 1e-6;
