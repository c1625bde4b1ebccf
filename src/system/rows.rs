//! The rows of phi and G that one joint has.

use super::Terms;
use super::mechanism::of;
use super::variation::{Along, Varied, fixed};
use crate::body::{Frame, MOST_MARKERS, Slope, Wrench, twist_len};
use crate::joint::{Joint, MOST_ROWS, markers_per_pass};
use crate::math::kkt::Pattern;
use crate::math::{Scalar, Taylor};
use crate::scene::{Connection, Model};
use std::array::from_fn;
use std::ops::Range;

/// Where a joint stands in phi and G.
pub(super) struct Rows {
    pub first: usize,
    pub count: usize,
    /// Whether phi depends on t itself.
    rheonomic: bool,
    blocks: Vec<Block>,
}

/// Entries of G for one joint and one of its markers: rows x the velocities of the marker's body, row by row.
struct Block {
    /// Which of the joint's markers.
    slot: usize,
    body: usize,
    first_entry: usize,
    /// False where an earlier block of the joint has the same body.
    first_of_body: bool,
}

/// A joint in its place.
pub(super) struct PlacedJoint<'a, const D: usize> {
    pub model: &'a Model<D>,
    pub joint: &'a Connection<Box<dyn Joint<D>>>,
    pub rows: &'a Rows,
}

type Motion<S, const D: usize> = [Frame<Taylor<S>, D>];

impl Rows {
    /// Adds the joint's entries to the pattern of G, and its rows.
    pub fn new<const D: usize>(model: &Model<D>, joint: &Connection<Box<dyn Joint<D>>>, g: &mut Pattern) -> Self {
        let count = joint.element.row_names().len();
        let mut blocks: Vec<Block> = Vec::new();
        for (slot, &marker) in joint.markers.iter().enumerate() {
            let Some(body) = model.markers.bodies[marker] else { continue };
            let part = &model.bodies[body];
            if part.nv > 0 {
                let first_of_body = blocks.iter().all(|block| block.body != body);
                blocks.push(Block { slot, body, first_entry: g.entries.len(), first_of_body });
                let places = (0..count).flat_map(|i| (0..part.nv).map(move |j| (i, j)));
                g.entries.extend(places.map(|(i, j)| (g.rows + i, part.first_v + j)));
            }
        }
        let first = g.rows;
        g.rows += count;
        Rows { first, count, rheonomic: joint.element.depends_on_time(), blocks }
    }

    pub fn range(&self) -> Range<usize> {
        self.first..self.first + self.count
    }
}

impl<const D: usize> PlacedJoint<'_, D> {
    /// phi, phi' and gamma, and phi_t: the rate with all frames held.
    pub fn levels(&self, t: f64, frames: &Motion<f64, D>, terms: &mut Terms) {
        let mut levels = [Taylor::fixed(0.0); MOST_ROWS];
        let levels = &mut levels[..self.rows.count];
        self.joint.element.levels(frames, Taylor::time(t), levels);
        for (row, level) in self.rows.range().zip(levels.iter()) {
            (terms.phi[row], terms.phi_dot[row], terms.gamma[row]) = (level.x, level.d, -level.dd);
        }
        let phi_t = &mut terms.phi_t[self.rows.range()];
        phi_t.fill(0.0);
        if self.rows.rheonomic {
            let held: [_; MOST_MARKERS] = from_fn(|i| frames[i.min(frames.len() - 1)].map(|x| Taylor::fixed(x.x)));
            self.joint.element.levels(&held[..frames.len()], Taylor::time(t), levels);
            phi_t.iter_mut().zip(levels).for_each(|(rate, level)| *rate = level.d);
        }
    }

    /// Rows of G: the gradient with respect to each marker's twist, pulled back like a wrench.
    pub fn gradient(&self, t: f64, q: &[f64], frames: &Motion<f64, D>, terms: &mut Terms) {
        let mut slopes = [[0.0; 6]; MOST_ROWS];
        let slopes = &mut slopes[..self.rows.count];
        for pass in 0..frames.len().div_ceil(markers_per_pass(D)) {
            let in_pass = |block: &&Block| block.slot / markers_per_pass(D) == pass;
            if self.rows.blocks.iter().any(|block| in_pass(&block)) {
                self.joint.element.gradient(frames, t, pass, slopes);
                let blocks = self.rows.blocks.iter().filter(in_pass);
                blocks.for_each(|block| self.pull_back(block, q, &frames[block.slot], slopes, terms));
            }
        }
    }

    fn pull_back(
        &self,
        block: &Block,
        q: &[f64],
        frame: &Frame<Taylor<f64>, D>,
        slopes: &[[f64; 6]],
        terms: &mut Terms,
    ) {
        let part = &self.model.bodies[block.body];
        let frame = frame.map(|x| x.x);
        let first = block.slot % markers_per_pass(D) * twist_len(D);
        let entries = &mut terms.g[block.first_entry..][..self.rows.count * part.nv];
        entries.fill(0.0);
        for (entries, slope) in entries.chunks_exact_mut(part.nv).zip(slopes) {
            let wrench = Wrench::from_twist_order(&slope[first..first + twist_len(D)]);
            part.body.pull_back(of(q, part, true), &frame, &wrench, entries);
        }
    }

    /// Rows of L = d(phi')/dq: the joint is evaluated with its bodies varied, one after the other.
    pub fn curvature(
        &self,
        t: f64,
        (q, v): (&[f64], &[f64]),
        motion: &Motion<f64, D>,
        varied: &mut Varied<D>,
        terms: &mut Terms,
    ) {
        for block in &self.rows.blocks {
            let part = &self.model.bodies[block.body];
            let entries = &mut terms.l[block.first_entry..][..self.rows.count * part.nv];
            entries.fill(0.0);
            if !block.first_of_body {
                continue;
            }
            for first in (0..part.nv).step_by(6) {
                varied.vary(Along::Coordinates, part, of(q, part, true), of(v, part, false), first);
                let frames: [Frame<Taylor<Slope>, D>; MOST_MARKERS] = from_fn(|i| {
                    let marker = self.joint.markers[i.min(self.joint.markers.len() - 1)];
                    match self.model.markers.bodies[marker] == Some(block.body) {
                        true => varied.frames[marker - part.first_marker],
                        false => fixed(&motion[marker]),
                    }
                });
                let mut levels = [Taylor::fixed(Slope::constant(0.0)); MOST_ROWS];
                let levels = &mut levels[..self.rows.count];
                self.joint.element.levels(&frames[..self.joint.markers.len()], Taylor::time(t), levels);
                for (row, level) in levels.iter().enumerate() {
                    let columns = first..part.nv.min(first + 6);
                    columns.for_each(|j| entries[row * part.nv + j] = level.d.eps[j - first]);
                }
            }
        }
    }
}
