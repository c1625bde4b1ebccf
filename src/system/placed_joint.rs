//! Joints by their kernels: phi, phi', gamma, G, and their derivatives along q.

use super::gather::{MovingFrames, gathered};
use super::layout::Layout;
use super::locked::write_rates;
use super::rows::{JointBlock, JointRows};
use super::seed::SeedDirection;
use super::terms::{OperatingPoint, Terms};
use super::variation::SeededBody;
use crate::body::{Dual6, Frame, Wrench, twist_len};
use crate::joint::{Joint, Lock, MOST_ROWS, markers_per_pass};
use crate::math::array::Each;
use crate::math::{Rate, Regime, Scalar, Taylor, Time};
use crate::scene::Connection;

/// A joint with the model it is part of, and its rows.
pub(super) struct PlacedJoint<'a, const D: usize> {
    pub layout: &'a Layout<D>,
    pub joint: &'a Connection<Box<dyn Joint<D>>>,
    /// What it locks, if that is all it does.
    pub lock: Option<&'a Lock<D>>,
    pub rows: &'a JointRows,
}

impl<'a, const D: usize> PlacedJoint<'a, D> {
    pub fn new(layout: &'a Layout<D>, joint: usize) -> Self {
        let lock = layout.locks[joint].as_ref();
        PlacedJoint { layout, joint: &layout.model.joints[joint], lock, rows: &layout.joints[joint] }
    }

    /// All joints of a model.
    pub fn all(layout: &'a Layout<D>) -> impl Iterator<Item = Self> {
        (0..layout.joints.len()).map(|joint| Self::new(layout, joint))
    }

    /// phi, phi' and gamma, and phi_t: the rate at fixed frames.
    pub fn levels(&self, time: Time<f64>, frames: &MovingFrames<D>, terms: &mut Terms) {
        let mut levels = [Taylor::fixed(0.0); MOST_ROWS];
        let levels = &mut levels[..self.rows.rows.len()];
        self.joint.element.levels(frames, time.map(Taylor::running), levels);
        for (row, level) in self.rows.rows.clone().zip(levels.iter()) {
            (terms.phi[row], terms.phi_dot[row], terms.gamma[row]) = (level.x, level.d, -level.dd);
        }
        let phi_t = &mut terms.phi_t[self.rows.rows.clone()];
        phi_t.fill(0.0);
        if self.rows.rheonomic {
            let held = |frame: &Frame<Taylor<f64>, D>| frame.map(|x| Taylor::fixed(x.x));
            gathered(frames, held, |held| self.joint.element.levels(held, time.map(Taylor::running), levels));
            phi_t.iter_mut().zip(levels).for_each(|(rate, level)| *rate = level.d);
        }
    }

    /// Rows of G: the gradient with respect to each marker's twist, pulled back like a wrench.
    pub fn gradient(&self, time: Time<f64>, q: &[f64], frames: &MovingFrames<D>, terms: &mut Terms) {
        let mut slopes = [[0.0; 6]; MOST_ROWS];
        let slopes = &mut slopes[..self.rows.rows.len()];
        for pass in 0..frames.len().div_ceil(markers_per_pass(D)) {
            let in_pass = |block: &&JointBlock| block.slot / markers_per_pass(D) == pass;
            if self.rows.blocks.iter().any(|block| in_pass(&block)) {
                self.joint.element.gradient(frames, time, pass, slopes);
                let blocks = self.rows.blocks.iter().filter(in_pass);
                blocks.for_each(|block| self.pull_back(block, q, &frames[block.slot], slopes, terms));
            }
        }
    }

    /// Writes the arguments of the joint's switching functions with their rates.
    pub fn switching(&self, time: Time<Rate>, frames: &MovingFrames<D>, out: &mut [Rate]) {
        let rates = |frame: &Frame<Taylor<f64>, D>| frame.map(|x| Rate { re: x.x, eps: [x.d] });
        gathered(frames, rates, |rates| self.joint.element.switching(rates, time, out));
    }

    fn pull_back(
        &self,
        block: &JointBlock,
        q: &[f64],
        frame: &Frame<Taylor<f64>, D>,
        slopes: &[[f64; 6]],
        terms: &mut Terms,
    ) {
        let part = &self.layout.model.bodies[block.body];
        let marker = self.joint.markers[block.slot];
        let width = self.width(block);
        let index = marker - part.first_marker;
        let frame = frame.map(|x| x.x);
        let first = block.slot % markers_per_pass(D) * twist_len(D);
        let entries = &mut terms.g[block.first_entry..][..self.rows.rows.len() * width];
        entries.fill(0.0);
        for (entries, slope) in entries.chunks_exact_mut(width).zip(slopes) {
            let wrench = Wrench::from_twist_order(&slope[first..first + twist_len(D)]);
            part.body.pull_back(index, part.coordinates(q), &frame, &wrench, entries);
        }
    }

    /// Number of velocities that move the marker of a block.
    fn width(&self, block: &JointBlock) -> usize {
        self.layout.supports[self.joint.markers[block.slot]].velocities.len()
    }

    /// d(phi, phi', phi'')/dq at the places of G, with the accelerations of `motion` and `at`: the joint is
    /// differentiated with respect to one marker after the other.
    pub fn curvature(
        &self,
        at: &OperatingPoint,
        regime: Regime,
        motion: &MovingFrames<D>,
        varied: &mut SeededBody<D>,
        mut write: impl FnMut(usize, Taylor<f64>),
    ) {
        for block in &self.rows.blocks {
            let part = &self.layout.model.bodies[block.body];
            let markers = &self.joint.markers;
            let velocities = &self.layout.supports[markers[block.slot]].velocities;
            let width = velocities.len();
            if let (Some(lock), Some(solid)) = (self.lock, self.layout.solid(block.body, motion)) {
                let frames = [0, 1].each(|slot| &motion[markers[slot]]);
                let place = |row: usize, velocity: usize| block.first_entry + row * width + velocity;
                write_rates(lock, frames, block.slot, &solid, |row, velocity, rate| write(place(row, velocity), rate));
                continue;
            }
            for first in (0..width).step_by(6) {
                let directions = &velocities[first..width.min(first + 6)];
                let solid = self.layout.solid(block.body, motion);
                varied.vary(SeedDirection::Coordinates, part, at, solid, directions);
                varied.gather(part, markers, motion, |slot| slot == block.slot);
                let mut levels = [Taylor::fixed(Dual6::constant(0.0)); MOST_ROWS];
                let levels = &mut levels[..self.rows.rows.len()];
                let time = Time { t: Taylor::time(at.t), regime };
                self.joint.element.levels(&varied.gathered, time, levels);
                for (row, level) in levels.iter().enumerate() {
                    let place = block.first_entry + row * width + first;
                    for i in 0..directions.len() {
                        write(place + i, Taylor::new(level.x.eps[i], level.d.eps[i], level.dd.eps[i]));
                    }
                }
            }
        }
    }
}
