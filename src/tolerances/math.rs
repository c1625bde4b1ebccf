//! Linear algebra, eigenvalues, Newton's method.

pub use super::{ROUND_OFF_OF_FACTORS, ROUND_OFF_OF_SUMS, ROUNDED_ZERO};

/// Sweeps at most of the balancing of a matrix over its rows and columns.
/// Unit: `[sweeps]`. Why: a few are usual, some tens where units are far apart; a choice beyond. Test:
/// `scaling_of_rows_columns_and_time_does_not_matter`.
pub const BALANCE_SWEEPS: usize = 100;

/// Singular values that are zero and those that are not, finite and infinite eigenvalues: the least gap between two
/// kinds, else which is which is doubtful, and told so.
/// Unit: `[1]` ratio. Why: a choice: one digit. Test: `a_rank_near_the_tolerance_is_doubtful`.
pub const RANK_GAP: f64 = 10.0;

/// Singular values of a balanced pencil that are zero.
/// Unit: `[1]` of the largest. Why: rounding leaves about 1e-15; a choice above. Test: `chains_are_deflated`.
pub const RANK_OF_PENCIL: f64 = 1e-10;

/// Norm of A above which the powers of A that choose the order of approximation are not formed.
/// Unit: `[1]`. Why: higher powers would overflow. Test: none: with a thousand times more or less the tests of its room
/// pass.
pub const EXPONENTIAL_OVERFLOW: f64 = 1e20;

/// Values were missing in a search before where the sum of the largest magnitudes has grown by more than this part.
/// Unit: `[1]`. Why: the square root of rounding; a value that was missing is a part of the sum by itself. Test: none:
/// with a thousand times more or less the tests of its room pass.
pub const KRYLOV_NEW: f64 = 1e-8;

/// QR steps at most for each eigenvalue.
/// Unit: `[steps]`. Why: two or three are usual; LAPACK allows thirty. Test: none: with a thousand times more or less
/// the tests of its room pass.
pub const QR_STEPS: usize = 60;

/// Residual |beta A x - alpha E x| above which x is no eigenvector.
/// Unit: `[1]` of |x| and the norm of the pencil. Why: a choice: ten times ROUND_OFF_OF_FACTORS. Test: none: with a
/// thousand times more or less the tests of its room pass.
pub const EIGENVECTOR_OF_PENCIL: f64 = 1e-12;

/// Residual of an eigenvector in the matrix before it was balanced, above which it is computed again there.
/// Unit: `[1]` of |A| |x|. Why: a choice: a thousand times ROUND_OFF_OF_FACTORS. Test: none: with a thousand times more
/// or less the tests of its room pass.
pub const EIGENVECTOR_REPEATED: f64 = 1e-10;

/// Residual of an eigenpair above which the eigenvalue counts as not converged.
/// Unit: `[1]` of |A| |x|. Why: the square root of rounding, which defective eigenvalues reach. Test: none: with a
/// thousand times more or less the tests of its room pass.
pub const EIGENVALUE_FAILED: f64 = 1e-8;

/// Condition number of the right eigenvectors up to which their inverse gives the left ones.
/// Unit: `[1]`. Why: half of the digits are left; beyond, left vectors are computed by themselves. Test: none: with a
/// thousand times more or less the tests of its room pass.
pub const WELL_CONDITIONED_VECTORS: f64 = 1e8;

/// |y^H x| of unit vectors below which an eigenvalue is defective.
/// Unit: `[1]`. Why: ten times the square root of rounding, by which a double eigenvalue splits. Test: none: with a
/// thousand times more or less the tests of its room pass.
pub const DEFECTIVE: f64 = 1e-7;

/// Up to so many n + m doubts about the rank are settled by the dense rank-revealing factorization, and condition
/// numbers are those of all eigenvalues.
/// Unit: `[equations]`. Why: 10 to 100 ms there; it costs their cube. Test: `nearly_dependent_rows_are_truncated`.
pub const DENSE_EQUATIONS: usize = 600;

/// Equations, n + m, up to which the dense factorization settles whether the motion is determined.
/// Unit: `[equations]`. Why: a choice: a wrong answer ends the run, so that more time is well spent than on a doubtful
/// rank. Test: none: time alone depends on it.
pub const DENSE_EQUATIONS_OF_MOTION: usize = 1500;

/// Steps of the power iterations for the condition number of a large system.
/// Unit: `[steps]`. Why: a choice. Test: `condition_numbers`.
pub const CONDITION_STEPS: usize = 40;

/// What the dense factorization puts in the place of a collapsed pivot: beyond, the multiplier is dropped.
/// Unit: `[1]`. Why: its row and column of L vanish, and its square is still a number. Test: none: with a thousand
/// times more or less the tests of its room pass.
pub const PLACE_OF_A_VANISHED_ROW: f64 = 1e200;

/// Rows of G whose pivot falls below this part of the largest depend on others.
/// Unit: `[1]` of the size of the row. Why: a choice, far above the round-off of rows; nearly dependent ones are judged
/// by TRUNCATED_RANK. Test: none: with a thousand times more or less the tests of its room pass.
pub const RANK: f64 = 1e-10;

/// The rank indicator below which a truncated solution drops a row: near a singular state.
/// Unit: `[1]` of its reference value. Why: with an indicator s round-off moves positions along the nearly dependent
/// row by eps/s, so velocities by eps/s^2 and accelerations by eps/s^3: all of it at 6e-6, the more with drift. Test:
/// `from_rest_at_a_change_point_it_goes_where_it_is_pushed_or_says_why_not`.
pub const TRUNCATED_RANK: f64 = 1e-4;

/// Coefficients of the rows on which a row depends that are not named.
/// Unit: `[1]` for rows of unit length. Why: the square root of rounding. Test: none: with a thousand times more or
/// less the tests of its room pass.
pub const NAMED_DEPENDENCE: f64 = 1e-8;

/// The product k^2 m for k null vectors of dependent rows, or vectors of the range of G where these are fewer, up to which
/// multipliers are those of least norm; beyond, rows that are dropped carry no force.
/// Unit: `[1]`. Why: four times as many operations take 0.1 s: 260 of 1500 rows, 70 of 20,000. Test:
/// `very_many_redundant_rows_carry_no_force`.
pub const LEAST_NORM: usize = 100_000_000;

/// Pivots of a mass matrix that are none: the motion along them is not determined.
/// Unit: `[1]` of the largest, or of the diagonal. Why: a choice: a hundred times ROUND_OFF_OF_FACTORS. Test: none:
/// with a thousand times more or less the tests of its room pass.
pub const MASSLESS: f64 = 1e-11;

/// A pivot of the fast factorization that has collapsed: it stops, and the careful ways begin.
/// Unit: `[1]` of its size before. Why: ten times COLLAPSED, for what is doubtful shall be looked at. Test: none: not
/// tried with other values.
pub const COLLAPSED_FAST: f64 = 1e-11;

/// Pivots of the fast factorization whose solutions need a refinement.
/// Unit: `[1]` of its size before. Why: half of the digits are lost there. Test: none: not tried with other values.
pub const WEAK_FAST: f64 = 1e-7;

/// Multipliers with a pivot below are dropped where the fast factorization has stopped.
/// Unit: `[1]` of its size before. Why: ten times ROUND_OFF_OF_FACTORS: round-off over the square of the rank indicator
/// of the others. Test: none: with a thousand times more or less the tests of its room pass.
pub const COLLAPSED: f64 = 1e-12;

/// Multipliers with pivots up to here may be dependent where others are nearly so.
/// Unit: `[1]` of its size before. Why: the square of TRUNCATED_RANK. Test: none: with a thousand times more or less
/// the tests of its room pass.
pub const DOUBTED: f64 = 1e-8;

/// A collapsed pivot of a coordinate is replaced by this part of the largest mass.
/// Unit: `[1]`. Why: the square root of rounding: refinement makes up for it. Test:
/// `a_large_system_with_massless_bodies_and_redundant_rows`.
pub const REPLACED_MASS: f64 = 1e-7;

/// Refinements at most where pivots of coordinates are true ones, and where some were replaced.
/// Unit: `[sweeps]`. Why: a choice: replaced masses make the contraction slow. Test: none: not tried with other values.
pub const REFINEMENTS: [usize; 2] = [3, 40];

/// Rows of an iteration matrix with fewer entries are not long, which would be eliminated last.
/// Unit: `[entries]`. Why: a choice of speed: eliminated early, long rows fill the factors. Test: none: time alone
/// depends on it.
pub const LONG_ROW: usize = 50;

/// Rows of an iteration matrix with so many times the entries of the mean, or fewer, are not long either.
/// Unit: `[1]`. Why: a choice of speed. Test: none: time alone depends on it.
pub const LONG_ROW_OF_MEAN: usize = 12;

/// Entries of long rows are pivots only where all others are below this part.
/// Unit: `[1]`. Why: they grow before their turn comes, by an estimate to some tens for beams of 10,000 elements. Test:
/// none: with a thousand times more or less the tests of its room pass.
pub const LAST_CHOICE: f64 = 1e-4;

/// Matrices of implicit methods with one entry in so many, or more, have dense factors.
/// Unit: `[1]`. Why: measured on chains (factor and three solves, dense : sparse, microseconds): 20 rows (half full) 5
/// : 6, 40 (a third) 16 : 12, 100 (an eighth) 88 : 32, 1000 20769 : 320, 100,000 - : 37,740; complex ones 7 : 9, 26 :
/// 17, 149 : 43, 63920 : 400, - : 50,270. Test: none: time alone depends on it.
pub const DENSE_PART: usize = 3;

/// Matrices of implicit methods with up to so many rows have dense factors, whatever their entries.
/// Unit: `[1]`. Why: up to 20 rows dense and sparse factors take the same time, and partial pivoting tells more near
/// singular states than pivots on the diagonal. Test: `implicit_steps_from_a_change_point_end`, on 17 rows.
pub const DENSE_ROWS: usize = 20;

/// A diagonal pivot of the matrix of an implicit method up to which partial pivoting takes its place.
/// Unit: `[1]` of the largest number that it is the difference of. Why: ten digits of a correction are left, and rows
/// that could be dependent, whose pivots are round-off, stay the matter of partial pivoting. Test:
/// `a_small_pivot_leads_to_partial_pivoting`.
pub const UNPIVOTED: f64 = 1e-6;

/// A pivot of the scaled matrix of an implicit method below which it is singular.
/// Unit: `[1]`. Why: a choice: below ROUND_OFF_OF_FACTORS, since stiffness h^2 over masses makes pivots small where no
/// rank is lost. Test: `solves_what_it_multiplied`.
pub const SINGULAR_ITERATION_MATRIX: f64 = 1e-14;

/// Rate of convergence of an iteration that needed one correction.
/// Unit: `[1]`. Why: a choice: no second change tells it. Test: none: with a thousand times more or less the tests of
/// its room pass.
pub const RATE_AT_ONCE: f64 = 1e-3;

/// Rates above which an iteration has diverged: after two changes, and later.
/// Unit: `[1]`. Why: of the first two one may have corrected what the start left of its constraints. Test:
/// `an_iteration_that_cannot_arrive_is_given_up_early`.
pub const DIVERGED: [f64; 2] = [2.0, 0.99];

/// Below the stagnation tolerance changes that shrink by less than this no longer fall.
/// Unit: `[1]`. Why: a choice: true convergence is faster, round-off has a rate of one. Test:
/// `changes_that_do_not_contract_are_given_up_unless_they_are_round_off`.
pub const STAGNANT: f64 = 0.9;

/// Two sizes at which iterations of a longer and a shorter step no longer fall are of the same round-off up to this
/// factor.
/// Unit: `[1]`. Why: a choice: a step is halved at least, which would change the convergence by more. Test: none: with
/// a thousand times more or less the tests of its room pass.
pub const ROUND_OFF_ALIKE: f64 = 10.0;

/// Part of the tolerance up to which a change that no longer falls, as that of a longer step, is accepted as round-off.
/// Unit: `[1]`. Why: a choice: a digit is left for the error of the step. Test: none: with a thousand times more or
/// less the tests of its room pass.
pub const ROUND_OFF_TOLERABLE: f64 = 0.1;

/// A matrix whose corrections shrink by less does not serve its own system.
/// Unit: `[1]`. Why: a choice. Test: `constraints_hold_and_the_penalty_does_not_matter`.
pub const MATRIX_RENEWED: f64 = 0.3;

/// The square of an angle up to which the series of the exponential map serve.
/// Unit: `[rad^2]`. Why: the series leave 1e-17 there, the closed forms beyond do not cancel much. Test:
/// `both_forms_of_the_cotangent_agree`.
pub const SERIES_OF_ROTATIONS: f64 = 0.3;

/// Terms of the series of the exponential map and of the cotangent.
/// Unit: `[terms]`. Why: those left out are below 1e-17 of the first. Test: `both_forms_of_the_cotangent_agree`.
pub const SERIES_TERMS: usize = 9;

/// Unknowns of a saddle-point matrix, coordinates and multipliers, for each part that it is divided in: with less than
/// two parts it is not.
/// Unit: `[unknowns]`. Why: measured: from some 20,000 unknowns on, 2000 four-bar linkages, two threads are faster than
/// one; below, to wake the other one up takes what it saves. Test: `four_bar_linkages_are_the_same_on_all_threads`.
pub const UNKNOWNS_OF_A_PART: usize = 10_000;

/// Parts of a saddle-point matrix at most.
/// Unit: `[parts]`. Why: a choice: inner parts of a chain have two neighbours, and twice the blocks of L; eight make a
/// step of four-bar linkages on one thread 4 % dearer. Test: none: results differ by round-off alone.
pub const MOST_PARTS: usize = 8;

/// Groups of unknowns at most that the parts of a saddle-point matrix have in common.
/// Unit: `[groups]`. Why: a choice: eight parts of three chains beside each other; elimination of so many, all coupled
/// to each other, is some per cent of that of two parts. Test: `what_is_coupled_everywhere_is_not_divided`.
pub const LARGEST_SEPARATOR: usize = 32;

/// Unknowns at most that the parts of a matrix of an implicit step have in common.
/// Unit: `[unknowns]`. Why: a choice: as many as are in the groups of [`LARGEST_SEPARATOR`], of eight at most. Test: none:
/// results differ by round-off alone.
pub const LARGEST_CORE: usize = 256;

/// A group of unknowns that is coupled to more, and to more than four square roots of all, belongs to the separator.
/// Unit: `[groups]`. Why: as for coordinates that come behind their multipliers: eliminated before them it would make
/// one dense block of all. Test: `a_hub_and_separate_mechanisms_are_divided`.
pub const COUPLED_TO_MANY: usize = 32;

/// A signal whose last two points differ by less is level at that end: it is meant to be held beyond.
/// Unit: `[1]` of the range of its values. Why: a smooth ramp of 50 points ends so; a measured road does not. Test:
/// `a_signal_that_ends_early_is_said`.
pub const LEVEL_END: f64 = 1e-3;

/// Backward error of the eigenvalues of a dense matrix, and rounding of its entries.
/// Unit: `[1]` of the norm of the balanced matrix. Why: four ulps; the QR algorithm leaves one or two. Test:
/// `a_rigid_body_mode_is_zero_and_a_slow_one_is_not`.
pub const QR_BACKWARD_ERROR: f64 = 4.0 * f64::EPSILON;

/// Asymmetry of a stiffness that is rounding.
/// Unit: `[1]` of its largest entry. Why: ten times ROUND_OFF_OF_FACTORS: columns come from back-substitutions. Test:
/// `an_undamped_chain_by_its_stiffness`.
pub const SYMMETRIC: f64 = 1e-12;

/// Rows of A from which on the second-order form is used.
/// Unit: `[rows]`. Why: a choice: smaller ones take less than a millisecond, and keep the digits of slow modes among fast
/// ones. Test: `an_undamped_chain_by_its_stiffness`.
pub const SECOND_ORDER_ROWS: usize = 100;
