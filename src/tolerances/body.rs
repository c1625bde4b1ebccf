//! Beams and angles.

pub use super::{ROUND_OFF_OF_FACTORS, SAME};

/// A gap whose line is held takes it from its rate below this.
/// Unit: `[1]` of the free length. Why: the direction of a shorter one is rounded. Test: `a_spring_passes_its_anchor`.
pub const NEARLY_CLOSED: f64 = 1e-6;

/// Integrals of shape functions are exact when halving the panels changes none by more.
/// Unit: `[1]` of the largest. Why: a choice: round-off of sums over the panels is less. Test: none: not tried with
/// other values.
pub const RITZ_CONVERGED: f64 = 1e-12;

/// As good as infinite: expressions have such slopes where the exact ones are.
/// Unit: `[its own unit]`. Why: its square is still a number. Test: none: not tried with other values.
pub const RITZ_INFINITE: f64 = 1e150;

/// Panels at most.
/// Unit: `[panels]`. Why: only functions that are not smooth, or not exact to rounding, need so many. Test: none: a
/// bound of work, not tried.
pub const RITZ_PANELS: usize = 64;

/// Cosine of the elevation below which the x axis of one marker is along the z axis of the other, and there is no
/// angle.
/// Unit: `[1]`. Why: a choice: its inverse is the rate of the angle. Test: none: not tried with other values.
pub const UPRIGHT: f64 = 1e-6;

/// Below this one the rate is that of an axis which leans so much.
/// Unit: `[1]`. Why: a choice: a faster one would make steps short for an angle alone. Test: none: not tried with other
/// values.
pub const LEANING: f64 = 0.2;

/// Rotary inertia of a planar node without that of its section, for M must have an inverse.
/// Unit: `[1]` of its mass and the square of the element's length. Why: it lowers the square of a frequency by this
/// part of (k h)^2, k being the wave number and h the length, and lumping the mass by (k h)^4/720: this is the smaller
/// part unless k h < 0.27, where both are below 1e-5. A smaller one makes the nodes' own rotation faster: here it is
/// forty times as fast as the shortest wave. Test: none: not tried with other values.
pub const SECTION_INERTIA: f64 = 1e-4;

/// Part of the energy of bending that elements miss, of order 2 in their length, that a finer mesh aims at.
/// Unit: `[1]`. Why: a choice. Test: none: not tried with other values.
pub const MESH_AIM: f64 = 0.02;

/// A quarter turn may be passed by so much of it.
/// Unit: `[1]`. Why: a choice. Test: none: not tried with other values.
pub const QUARTER_TURN: f64 = 0.01;

/// A line whose elements turn by less together is as good as straight.
/// Unit: `[rad]`. Why: a choice. Test: none: not tried with other values.
pub const STRAIGHT: f64 = 0.5;

/// Positions in files are rounded to this.
/// Unit: `[1]` of the largest. Why: a choice. Test: none: not tried with other values.
pub const ROUNDED_PLACES: f64 = 1e-5;

/// A vector as short as this gives an axis no direction.
/// Unit: `[1]`. Why: a choice: of unit vectors it leaves four digits of a direction. Test: none: not tried with other
/// values.
pub const NO_AXIS: f64 = 1e-12;

/// Young's modulus of a solid that is smaller is probably in another unit.
/// Unit: `[Pa]`. Why: the softest rubber has 1e5 to 1e6. Test: `a_modulus_in_another_unit_is_said`.
pub const SOFTEST_SOLID: f64 = 1e5;

/// A principal moment of inertia may be above the sum of the others by so much.
/// Unit: `[1]` of the largest. Why: data are rounded to a few digits, so that a thin rod may miss the bound by that. Test:
/// `moments_that_no_body_has_are_made_valid`.
pub const ROUNDED_INERTIA: f64 = 1e-6;

/// Radius of gyration of what has no extent.
/// Unit: `[m]`. Why: the radius of an atom; what files have below it is round-off. Test:
/// `moments_of_round_off_are_zero`.
pub const ATOM: f64 = 1e-10;
