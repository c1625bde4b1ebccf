//! The rows of phi and G that belong to one joint.

use super::locked::write_rates;
use super::mechanism::{Mechanism, of};
use super::support::Support;
use super::variation::{SeedDirection, SeededBody};
use super::view::mapped;
use super::{Group, OperatingPoint, Prescribed, Terms};
use crate::body::{Dual6, Frame, Wrench, twist_len};
use crate::joint::{Joint, Lock, MOST_ROWS, markers_per_pass};
use crate::math::array::Each;
use crate::math::kkt::Pattern;
use crate::math::{Rate, Regime, Scalar, Taylor, Time};
use crate::scene::{Connection, Model};
use std::ops::Range;

/// Rows of a joint in phi, and the places of its entries in G.
pub(super) struct JointRows {
    pub first: usize,
    pub count: usize,
    /// True if phi depends explicitly on t.
    rheonomic: bool,
    blocks: Vec<Block>,
}

/// Entries of G for one joint and one of its markers: rows x the velocities that move the marker, row by row.
struct Block {
    /// Index of the marker in the joint.
    slot: usize,
    body: usize,
    first_entry: usize,
}

/// A joint with its mechanism and its rows.
pub(super) struct PlacedJoint<'a, const D: usize> {
    pub mechanism: &'a Mechanism<D>,
    pub joint: &'a Connection<Box<dyn Joint<D>>>,
    /// What it locks, if that is all it does.
    pub lock: Option<&'a Lock<D>>,
    pub rows: &'a JointRows,
}

type Motion<S, const D: usize> = [Frame<Taylor<S>, D>];

impl JointRows {
    /// Adds the joint's entries to the pattern of G, and its rows.
    pub fn new<const D: usize>(supports: &[Support], joint: &Connection<Box<dyn Joint<D>>>, g: &mut Pattern) -> Self {
        let count = joint.element.row_names().len();
        let mut blocks: Vec<Block> = Vec::with_capacity(joint.markers.len());
        for (slot, &marker) in joint.markers.iter().enumerate() {
            let Support { body: Some(body), velocities, .. } = &supports[marker] else { continue };
            if !velocities.is_empty() {
                blocks.push(Block { slot, body: *body, first_entry: g.entries.len() });
                let places = (0..count).flat_map(|i| velocities.iter().map(move |&j| (i, j)));
                g.entries.extend(places.map(|(i, j)| (g.rows + i, j)));
            }
        }
        let first = g.rows;
        g.rows += count;
        JointRows { first, count, rheonomic: joint.element.depends_on_time(), blocks }
    }

    /// Place of its entries in G: the blocks of its markers one after the other.
    pub fn first_entry(&self) -> usize {
        self.blocks.first().map_or(0, |block| block.first_entry)
    }

    pub fn range(&self) -> Range<usize> {
        self.first..self.first + self.count
    }
}

/// The rows of phi by joint.
pub(super) fn groups<const D: usize>(model: &Model<D>, joints: &[JointRows]) -> Vec<Group> {
    let joints = model.joints.iter().zip(joints);
    let group = |(joint, rows): (&Connection<_>, &JointRows)| Group {
        name: joint.name.clone(),
        kind: joint.kind.to_string(),
        rows: rows.range(),
    };
    joints.map(group).collect()
}

/// The rows that depend on t, with what they prescribe.
pub(super) fn prescribed<const D: usize>(model: &Model<D>, joints: &[JointRows], t: f64) -> Vec<Prescribed> {
    let driven = model.joints.iter().zip(joints).filter(|(joint, _)| joint.element.depends_on_time());
    let rows = driven.flat_map(|(joint, rows)| rows.range().map(|row| (row, joint.element.prescribed(t))));
    rows.map(|(row, value)| Prescribed { row, value }).collect()
}

impl<const D: usize> PlacedJoint<'_, D> {
    /// phi, phi' and gamma, and phi_t: the rate at fixed frames.
    pub fn levels(&self, time: Time<f64>, frames: &Motion<f64, D>, terms: &mut Terms) {
        let mut levels = [Taylor::fixed(0.0); MOST_ROWS];
        let levels = &mut levels[..self.rows.count];
        self.joint.element.levels(frames, time.map(Taylor::running), levels);
        for (row, level) in self.rows.range().zip(levels.iter()) {
            (terms.phi[row], terms.phi_dot[row], terms.gamma[row]) = (level.x, level.d, -level.dd);
        }
        let phi_t = &mut terms.phi_t[self.rows.range()];
        phi_t.fill(0.0);
        if self.rows.rheonomic {
            let held = |frame: &Frame<Taylor<f64>, D>| frame.map(|x| Taylor::fixed(x.x));
            mapped(frames, held, |held| self.joint.element.levels(held, time.map(Taylor::running), levels));
            phi_t.iter_mut().zip(levels).for_each(|(rate, level)| *rate = level.d);
        }
    }

    /// Rows of G: the gradient with respect to each marker's twist, pulled back like a wrench.
    pub fn gradient(&self, time: Time<f64>, q: &[f64], frames: &Motion<f64, D>, terms: &mut Terms) {
        let mut slopes = [[0.0; 6]; MOST_ROWS];
        let slopes = &mut slopes[..self.rows.count];
        for pass in 0..frames.len().div_ceil(markers_per_pass(D)) {
            let in_pass = |block: &&Block| block.slot / markers_per_pass(D) == pass;
            if self.rows.blocks.iter().any(|block| in_pass(&block)) {
                self.joint.element.gradient(frames, time, pass, slopes);
                let blocks = self.rows.blocks.iter().filter(in_pass);
                blocks.for_each(|block| self.pull_back(block, q, &frames[block.slot], slopes, terms));
            }
        }
    }

    /// Writes the arguments of the joint's switching functions with their rates.
    pub fn switching(&self, time: Time<Rate>, frames: &Motion<f64, D>, out: &mut [Rate]) {
        let rates = |frame: &Frame<Taylor<f64>, D>| frame.map(|x| Rate { re: x.x, eps: [x.d] });
        mapped(frames, rates, |rates| self.joint.element.switching(rates, time, out));
    }

    fn pull_back(
        &self,
        block: &Block,
        q: &[f64],
        frame: &Frame<Taylor<f64>, D>,
        slopes: &[[f64; 6]],
        terms: &mut Terms,
    ) {
        let part = &self.mechanism.model().bodies[block.body];
        let marker = self.joint.markers[block.slot];
        let width = self.width(block);
        let index = marker - part.first_marker;
        let frame = frame.map(|x| x.x);
        let first = block.slot % markers_per_pass(D) * twist_len(D);
        let entries = &mut terms.g[block.first_entry..][..self.rows.count * width];
        entries.fill(0.0);
        for (entries, slope) in entries.chunks_exact_mut(width).zip(slopes) {
            let wrench = Wrench::from_twist_order(&slope[first..first + twist_len(D)]);
            part.body.pull_back(index, of(q, part, true), &frame, &wrench, entries);
        }
    }

    /// Number of velocities that move the marker of a block.
    fn width(&self, block: &Block) -> usize {
        self.mechanism.supports[self.joint.markers[block.slot]].velocities.len()
    }

    /// d(phi, phi', phi'')/dq at the places of G, with the accelerations of `motion` and `at`: the joint is
    /// differentiated with respect to one marker after the other.
    pub fn curvature(
        &self,
        (at, regime): (&OperatingPoint, Regime),
        motion: &Motion<f64, D>,
        varied: &mut SeededBody<D>,
        mut write: impl FnMut(usize, Taylor<f64>),
    ) {
        for block in &self.rows.blocks {
            let part = &self.mechanism.model().bodies[block.body];
            let markers = &self.joint.markers;
            let velocities = &self.mechanism.supports[markers[block.slot]].velocities;
            let width = velocities.len();
            if let (Some(lock), Some(solid)) = (self.lock, self.mechanism.solid(block.body, motion)) {
                let frames = [0, 1].each(|slot| &motion[markers[slot]]);
                let place = |row: usize, velocity: usize| block.first_entry + row * width + velocity;
                write_rates(lock, frames, (block.slot, &solid), |row, velocity, rate| {
                    write(place(row, velocity), rate)
                });
                continue;
            }
            for first in (0..width).step_by(6) {
                let directions = &velocities[first..width.min(first + 6)];
                let solid = self.mechanism.solid(block.body, motion);
                varied.vary(SeedDirection::Coordinates, part, (at, solid), directions);
                varied.gather(part, markers, motion, |slot| slot == block.slot);
                let mut levels = [Taylor::fixed(Dual6::constant(0.0)); MOST_ROWS];
                let levels = &mut levels[..self.rows.count];
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
