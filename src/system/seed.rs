//! Directions of differentiation, and frames without derivatives.

use crate::body::{Dual6, Frame};
use crate::math::{Dual, Taylor};

/// The quantity that is differentiated with respect to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum SeedDirection {
    /// q + N(q) e_j at fixed v.
    Coordinates,
    /// v + e_j at fixed q.
    Velocities,
    /// v' + e_j at fixed q and v.
    Accelerations,
}

impl SeedDirection {
    /// The derivative of a coordinate that a change along this direction is the first to appear in.
    #[inline]
    pub fn level<S>(self, number: &mut Taylor<S>) -> &mut S {
        match self {
            SeedDirection::Coordinates => &mut number.x,
            SeedDirection::Velocities => &mut number.d,
            SeedDirection::Accelerations => &mut number.dd,
        }
    }
}

/// Writes a frame whose derivatives are zero.
pub(super) fn fix<const D: usize>(frame: &Frame<Taylor<f64>, D>, out: &mut Frame<Taylor<Dual6>, D>) {
    let fix = |from: &Taylor<f64>, to: &mut Taylor<Dual6>| {
        for (from, to) in [(from.x, &mut to.x), (from.d, &mut to.d), (from.dd, &mut to.dd)] {
            *to = Dual { re: from, eps: [0.0; 6] };
        }
    };
    frame.r.iter().zip(&mut out.r).for_each(|(from, to)| fix(from, to));
    frame.axes.iter().flatten().zip(out.axes.iter_mut().flatten()).for_each(|(from, to)| fix(from, to));
    fix(&frame.turn, &mut out.turn);
}

/// A frame whose derivatives are zero.
pub(super) fn fixed<const D: usize>(frame: &Frame<Taylor<f64>, D>) -> Frame<Taylor<Dual6>, D> {
    let mut out = Frame::world();
    fix(frame, &mut out);
    out
}
