//! Angles in space that are counted through full turns.
//!
//! Quaternions give an angle up to full turns, so the state has it as a further coordinate, as it has four numbers for
//! a rotation: a = sum_i z_i atan2(s_i, c_i), s_i = e_y . b_x and c_i = e_x . b_x, corrected to the value of the
//! quaternions at every accepted state. In between a' is integrated, which gives the number of full turns for steps of
//! any size.

use super::frame::turned;
use super::{Carried, Frame, MarkerId, cross, dot, sub};
use crate::math::array::{Each, from_fn};
use crate::math::{Regime, Scalar};
use crate::tolerances;

/// Below this one the rate is that of an axis which leans so much. Unit: `[1]`. Why: a faster one would make steps
/// short for an angle alone.
const LEANING: f64 = 0.2;

/// z times the angle of marker `of` about the z axis of marker `to`, or about another line.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Turned {
    /// Marker whose angle is counted.
    pub of: MarkerId,
    /// Marker about whose z axis it is counted.
    pub to: MarkerId,
    /// A whole number, so that the sum is known up to full turns too.
    pub factor: f64,
    /// Axes by which it is measured; `None` for x of `of` in the x-y plane of `to`.
    pub axes: Option<TurnAxes>,
}

/// The axes by which an angle about a line is measured: atan2(e_1 . b, e_0 . b).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TurnAxes {
    /// b, in the axes of the marker whose angle it is.
    pub of: [f64; 3],
    /// e_0 and e_1, square to the line, in the axes of the marker against which it is measured.
    pub to: [[f64; 3]; 2],
}

impl TurnAxes {
    /// The markers' own: the angle about z.
    pub const OWN: TurnAxes = TurnAxes { of: [1.0, 0.0, 0.0], to: [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]] };

    /// b, and e_0 and e_1. Not inlined, so that the markers' own axes, which nearly all angles have, stay fast.
    #[inline(never)]
    fn directions<const D: usize>(&self, of: &Carried<D>, to: &Carried<D>) -> ([f64; D], [[f64; D]; 2]) {
        (of.direction(&self.of), self.to.each(|e| to.direction(&e)))
    }

    /// e_0 . b and e_1 . b
    pub fn cos_sin<S: Scalar, const D: usize>(&self, of: &Frame<S, D>, to: &Frame<S, D>) -> (S, S) {
        let b = turned(&of.axes, &self.of);
        let [c, s] = self.to.each(|e| dot(&turned(&to.axes, &e), &b));
        (c, s)
    }
}

/// A sum of angles that an element needs counted through full turns.
#[derive(Clone, Debug, PartialEq)]
pub struct Turning {
    /// Name of its coordinate in q.
    pub name: String,
    /// Terms of the sum.
    pub terms: Vec<Turned>,
    /// The angle at the start is within half a turn of this, rad.
    pub start: f64,
}

impl Turned {
    /// c, s and the rate of the angle, rad/s: (w_b - w_e) . b_x x (c e_y - s e_x)/(c^2 + s^2); zero if b_x is nearly
    /// along e_z.
    #[inline(always)]
    fn at<'m, const D: usize>(&self, marker: impl Fn(MarkerId) -> Carried<'m, D>) -> [f64; 3] {
        let of = marker(self.of);
        let to = marker(self.to);
        let (x, e) = match &self.axes {
            None => (of.axis(0), [to.axis(0), to.axis(1)]),
            Some(axes) => axes.directions(&of, &to),
        };
        let [c, s] = [dot(&e[0], &x), dot(&e[1], &x)];
        let across: [f64; D] = from_fn(|i| c * e[1][i] - s * e[0][i]);
        let spin = sub(&of.spin(), &to.spin());
        [c, s, dot(&spin, &cross(&x, &across)) / (c * c + s * s).max(LEANING * LEANING)]
    }
}

impl Turning {
    /// Rate of the sum, rad/s; a term whose x axis is nearly along the z axis of `to` counts as zero.
    #[inline]
    pub fn rate<'m, const D: usize>(&self, marker: impl Fn(MarkerId) -> Carried<'m, D>) -> f64 {
        self.terms.iter().map(|term| term.factor * term.at(&marker)[2]).sum()
    }

    /// The value of the angle, known up to full turns, that is nearest to `before`; `before` itself if the angle is
    /// undefined.
    pub fn next_to<'m, const D: usize>(&self, before: f64, marker: impl Fn(MarkerId) -> Carried<'m, D>) -> f64 {
        let mut sum = 0.0;
        for term in &self.terms {
            let [c, s, _] = term.at(&marker);
            if c * c + s * s < tolerances::SIX_DIGITS * tolerances::SIX_DIGITS {
                return before;
            }
            sum += term.factor * s.atan2(c);
        }
        Regime::FREE.angle(0, sum, before)
    }
}
