//! Both ways of a solution.

use super::kernels::Solution;
use super::lanes::Lanes;
use super::layout::Layout;
use super::schur::RightSide;
use std::ops::Range;

/// The factors as right sides go through them.
pub(super) struct BlockFactors<'a> {
    pub layout: &'a Layout,
    pub work: &'a [f64],
    pub inverse: &'a [f64],
    pub g: &'a [f64],
    pub inverse_masses: &'a [f64],
    pub lower: &'a [f64],
}

impl BlockFactors<'_> {
    /// Right sides of the unknowns of the layout, without those of bodies.
    pub fn enter(&self, top: &mut [f64], bottom: &[f64], x: &mut [f64]) {
        let BlockFactors { layout, g, inverse_masses: inverse, lower, .. } = self;
        layout.bodies.dense.iter().for_each(|body| body.enter(lower, top));
        layout.coordinates.iter().for_each(|&(i, p)| x[p as usize] = top[i as usize]);
        layout.g_rows.iter().zip(bottom).for_each(|(&p, value)| x[p as usize] = *value);
        let mut bodies = RightSide { bodies: &layout.bodies, g, inverse, top, x };
        for run in &layout.bodies.runs {
            by_kinds!(run, bodies, forward_levers::<[2, 1, 3, 6], [3, 3, 6, 18]>, forward);
        }
    }

    pub fn forward<T: Lanes>(&self, runs: Range<usize>, x: &mut [T]) {
        let BlockFactors { layout, work, inverse, .. } = self;
        let mut part = Solution { layout, work, inverse, x };
        for run in &layout.runs[runs] {
            by_width!(run.width, part.forward(run));
        }
    }

    pub fn backward<T: Lanes>(&self, runs: Range<usize>, x: &mut [T]) {
        let BlockFactors { layout, work, inverse, .. } = self;
        let mut part = Solution { layout, work, inverse, x };
        for run in layout.runs[runs].iter().rev() {
            by_width!(run.width, part.backward(run));
        }
    }

    /// The coordinates, with those of bodies from M^-1 times their right sides.
    pub fn leave<T: Lanes>(&self, top: &mut [T], x: &mut [T]) {
        let BlockFactors { layout, g, inverse_masses: inverse, lower, .. } = self;
        let mut bodies = RightSide { bodies: &layout.bodies, g, inverse, top, x };
        for run in &layout.bodies.runs {
            by_kinds!(run, bodies, backward_levers::<[2, 1, 3, 6], [3, 3, 6, 18]>, backward);
        }
        layout.bodies.dense.iter().for_each(|body| body.leave(lower, top));
        layout.coordinates.iter().for_each(|&(i, p)| top[i as usize] = x[p as usize]);
    }
}
