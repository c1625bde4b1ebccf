//! The line of a beam element between its ends.

use super::Beam;
use super::station::{SectionForces, cubic};
use super::strain::Strains;
use crate::math::Scalar;
use crate::math::array::{Each, from_fn};
use crate::math::screw::{Vector, dot3, exponential};

/// The line of an element: the helix between its ends, corrected for curvature and shear that change along it by a
/// rotation and a displacement that are zero at the ends, cubics with the slopes that the strains there require. All in
/// the axes of the first end.
pub(super) struct ElementLine<S> {
    /// Length of the relaxed element, m.
    pub length: f64,
    /// Position of the second end, m.
    pub gap: Vector<S>,
    /// dr/dx at the second end.
    pub tangent: Vector<S>,
    /// Logarithm of the motion from end to end.
    shift: Vector<S>,
    turn: Vector<S>,
    /// Slopes, at both ends, of the rotation (`bend`) and displacement (`lean`) from the helix, in its axes.
    bend: [Vector<S>; 2],
    lean: [Vector<S>; 2],
}

type Axes<S> = [Vector<S>; 3];

impl<S: Scalar> ElementLine<S> {
    /// The line for the internal forces of the sections at both ends.
    pub fn new(beam: &Beam, strains: &Strains<S>, ends: &[SectionForces<S>; 2]) -> Self {
        let shift = strains.shift.each(|x| x.re);
        let turn = strains.turn.each(|x| x.re);
        let gap = strains.gap.each(|x| x.re);
        let per_length = 1.0 / beam.length;
        let axes = [unit_axes(), exponential(&shift, &turn, 1.0).0];
        let strain = |end: usize, i: usize| {
            let carried = if i < 3 { &ends[end].n } else { &ends[end].m };
            dot3(&axes[end][i % 3], carried) * beam.compliance[end][i] + beam.rest[i]
        };
        let both = |first: usize, helix: &Vector<S>| -> [Vector<S>; 2] {
            from_fn(|end| from_fn(|i| strain(end, first + i) - helix[i] * per_length))
        };
        let lean = both(0, &shift);
        let bend = both(3, &turn);
        let tangent = compose(&axes[1], &from_fn(|i| strain(1, i)));
        ElementLine { length: beam.length, gap, tangent, shift, turn, bend, lean }
    }

    /// Axes and position of the section at 0 <= `part` <= 1 of the element.
    pub fn at(&self, part: f64) -> (Axes<S>, Vector<S>) {
        let [_, first, last] = cubic(part).each(|slope| slope * self.length);
        let beside = |slopes: &[Vector<S>; 2]| -> Vector<S> { from_fn(|i| slopes[0][i] * first + slopes[1][i] * last) };
        let (helix, start) = exponential(&self.shift, &self.turn, part);
        let turned = exponential(&[S::zero(); 3], &beside(&self.bend), 1.0).0;
        let lean = compose(&helix, &beside(&self.lean));
        (turned.each(|axis| compose(&helix, &axis)), from_fn(|i| start[i] + lean[i]))
    }
}

/// sum_j v_j axes_j
fn compose<S: Scalar>(axes: &Axes<S>, v: &Vector<S>) -> Vector<S> {
    from_fn(|i| axes[0][i] * v[0] + axes[1][i] * v[1] + axes[2][i] * v[2])
}

fn unit_axes<S: Scalar>() -> Axes<S> {
    crate::body::unit_axes()
}
