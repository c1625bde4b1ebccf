//! Angles in space that are counted through full turns.
//!
//! Quaternions give an angle up to full turns, so that the state carries it beside them, as it carries four numbers for a
//! rotation: a = sum_i z_i atan2(s_i, c_i), s_i = e_y . b_x and c_i = e_x . b_x, brought back to what the quaternions say at
//! every accepted state. Between those a' is integrated, which tells the turn however far a step goes.

use super::{Frame, MarkerId, dot};
use crate::math::{Regime, Taylor};

/// z times the angle of marker `of` about the z axis of marker `to`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Turned {
    pub of: MarkerId,
    pub to: MarkerId,
    /// A whole number, so that the sum is known up to full turns too.
    pub factor: f64,
}

/// A sum of angles that some element needs counted through full turns.
#[derive(Clone, Debug, PartialEq)]
pub struct Turning {
    /// Of the coordinate.
    pub name: String,
    pub terms: Vec<Turned>,
    /// It begins within half a turn of this, rad.
    pub start: f64,
}

/// Below this cosine of its elevation the x axis of one marker is along the z axis of the other, and there is no angle.
const UPRIGHT: f64 = 1e-6;
/// Below this one the rate is that of an axis which leans so much: none that an angle alone has makes steps short.
const STEEP: f64 = 0.2;

impl Turned {
    /// c and s.
    fn parts<const D: usize>(&self, frame: impl Fn(MarkerId) -> Frame<Taylor<f64>, D>) -> [Taylor<f64>; 2] {
        let (of, to) = (frame(self.of), frame(self.to));
        [0, 1].map(|axis| dot(&to.axes[axis], &of.axes[0]))
    }
}

impl Turning {
    /// Its rate (c s' - s c')/(c^2 + s^2), rad/s, but for steep axes.
    pub fn rate<const D: usize>(&self, frame: impl Fn(MarkerId) -> Frame<Taylor<f64>, D>) -> f64 {
        let rate = |term: &Turned| {
            let [c, s] = term.parts(&frame);
            (c.x * s.d - s.x * c.d) / (c.x * c.x + s.x * s.x).max(STEEP * STEEP)
        };
        self.terms.iter().map(|term| term.factor * rate(term)).sum()
    }

    /// The angle next to `before`, or that itself where there is none.
    pub fn next_to<const D: usize>(&self, before: f64, frame: impl Fn(MarkerId) -> Frame<Taylor<f64>, D>) -> f64 {
        let mut sum = 0.0;
        for term in &self.terms {
            let [c, s] = term.parts(&frame).map(|x| x.x);
            if c.hypot(s) < UPRIGHT {
                return before;
            }
            sum += term.factor * s.atan2(c);
        }
        Regime::FREE.angle(0, sum, before)
    }
}
