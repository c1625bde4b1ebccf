//! The line of a beam element between its ends.

use super::Beam;
use super::station::{Carried, cubic};
use super::strain::Strains;
use crate::math::Scalar;
use crate::math::screw::{Vector, dot3, exponential};
use std::array::from_fn;

/// The helix between the ends of an element, with what curvature and shear that change along it do beside the helix: a
/// turn and a shift that are zero at the ends, cubics with the slopes that the strains there ask for. All in the axes of the
/// first end.
pub(super) struct Line<S> {
    /// m
    pub length: f64,
    /// Where the second end is.
    pub gap: Vector<S>,
    /// dr/dx at the second end.
    pub tangent: Vector<S>,
    /// Logarithm of the motion from end to end.
    shift: Vector<S>,
    turn: Vector<S>,
    /// Slopes of the turn and of the shift beside the helix at both ends, in its axes.
    bend: [Vector<S>; 2],
    lean: [Vector<S>; 2],
}

type Axes<S> = [Vector<S>; 3];

impl<S: Scalar> Line<S> {
    /// With what the sections at the ends carry by their strains.
    pub fn new(beam: &Beam, strains: &Strains<S>, ends: &[Carried<S>; 2]) -> Self {
        let [shift, turn, gap] = [&strains.shift, &strains.turn, &strains.gap].map(|v| v.map(|x| x.re));
        let per_length = 1.0 / beam.length;
        let axes = [unit_axes(), exponential(&shift, &turn, 1.0).0];
        let strain = |end: usize, i: usize| {
            let carried = if i < 3 { &ends[end].n } else { &ends[end].m };
            dot3(&axes[end][i % 3], carried) * beam.compliance[end][i] + beam.rest[i]
        };
        let both = |first: usize, helix: &Vector<S>| -> [Vector<S>; 2] {
            from_fn(|end| from_fn(|i| strain(end, first + i) - helix[i] * per_length))
        };
        let (lean, bend) = (both(0, &shift), both(3, &turn));
        let tangent = compose(&axes[1], &from_fn(|i| strain(1, i)));
        Line { length: beam.length, gap, tangent, shift, turn, bend, lean }
    }

    /// Axes and place of the section at a part of the element.
    pub fn at(&self, part: f64) -> (Axes<S>, Vector<S>) {
        let [_, first, last] = cubic(part).map(|slope| slope * self.length);
        let beside = |slopes: &[Vector<S>; 2]| -> Vector<S> { from_fn(|i| slopes[0][i] * first + slopes[1][i] * last) };
        let (helix, start) = exponential(&self.shift, &self.turn, part);
        let turned = exponential(&[S::zero(); 3], &beside(&self.bend), 1.0).0;
        let lean = compose(&helix, &beside(&self.lean));
        (turned.map(|axis| compose(&helix, &axis)), from_fn(|i| start[i] + lean[i]))
    }
}

/// sum_j v_j axes_j
fn compose<S: Scalar>(axes: &Axes<S>, v: &Vector<S>) -> Vector<S> {
    from_fn(|i| axes[0][i] * v[0] + axes[1][i] * v[1] + axes[2][i] * v[2])
}

fn unit_axes<S: Scalar>() -> Axes<S> {
    crate::body::unit_axes()
}
