//! K and C: how the residual of the equations of motion changes with q and v.

use super::mechanism::{Mechanism, Workspace, of};
use super::variation::{Along, fixed};
use crate::body::{Frame, MOST_MARKERS, Slope, Wrench, twist_len};
use crate::joint::{MOST_ROWS, markers_per_pass};
use crate::math::kkt::Pattern;
use crate::math::{Scalar, Taylor};
use crate::scene::Model;
use std::array::from_fn;

/// A state with its accelerations and multipliers.
#[derive(Clone, Copy, Debug)]
pub struct Loaded<'a> {
    pub t: f64,
    pub q: &'a [f64],
    pub v: &'a [f64],
    pub vdot: &'a [f64],
    pub lambda: &'a [f64],
}

/// Derivatives of r = M v' + G^T lambda - f, values at the places of `Structure::tangent`.
#[derive(Clone, Debug, PartialEq)]
pub struct Tangent {
    /// K = dr/dq along the directions of v, at fixed v' and lambda.
    pub k: Vec<f64>,
    /// C = dr/dv = -df/dv.
    pub c: Vec<f64>,
}

impl Tangent {
    pub fn new(pattern: &Pattern) -> Self {
        Tangent { k: vec![0.0; pattern.entries.len()], c: vec![0.0; pattern.entries.len()] }
    }
}

/// Where the blocks of K and C stand: one a pair of bodies that an element joins, and one a body.
pub(super) struct Couplings {
    bodies: Vec<Own>,
    joints: Vec<Vec<Block>>,
    forces: Vec<Vec<Block>>,
}

struct Own {
    first_entry: usize,
    mass_pattern: Vec<(usize, usize)>,
}

/// d(generalized forces of body `row`)/d(coordinates of body `column`), row by row.
struct Block {
    row: usize,
    column: usize,
    first_entry: usize,
}

impl Couplings {
    pub fn new<const D: usize>(model: &Model<D>, pattern: &mut Pattern) -> Self {
        let own = |(body, part): (usize, &crate::scene::Part<D>)| Own {
            first_entry: block(model, body, body, pattern),
            mass_pattern: part.body.mass_pattern(),
        };
        let bodies = model.bodies.iter().enumerate().map(own).collect();
        let mut blocks = |markers: &[usize]| {
            let mut carriers: Vec<usize> = markers.iter().filter_map(|&marker| model.markers.bodies[marker]).collect();
            carriers.sort_unstable();
            carriers.dedup();
            let pairs = carriers.iter().flat_map(|&column| carriers.iter().map(move |&row| (row, column)));
            pairs
                .map(|(row, column)| Block { row, column, first_entry: block(model, row, column, pattern) })
                .collect::<Vec<_>>()
        };
        let joints = model.joints.iter().map(|joint| blocks(&joint.markers)).collect();
        let forces = model.forces.iter().map(|force| blocks(&force.markers)).collect();
        Couplings { bodies, joints, forces }
    }
}

fn block<const D: usize>(model: &Model<D>, row: usize, column: usize, pattern: &mut Pattern) -> usize {
    let first_entry = pattern.entries.len();
    let (row, column) = (&model.bodies[row], &model.bodies[column]);
    let places = (0..row.nv).flat_map(|i| (0..column.nv).map(move |j| (i, j)));
    pattern.entries.extend(places.map(|(i, j)| (row.first_v + i, column.first_v + j)));
    first_entry
}

/// One evaluation of K and C.
pub(super) struct Evaluation<'a, const D: usize> {
    pub mechanism: &'a Mechanism<D>,
    pub at: Loaded<'a>,
    pub work: &'a mut Workspace<D>,
    pub tangent: &'a mut Tangent,
}

type Wrenches<const D: usize> = [Wrench<Slope, D>; MOST_MARKERS];
type Frames<const D: usize> = [Frame<Taylor<Slope>, D>];

impl<const D: usize> Evaluation<'_, D> {
    /// Every element is evaluated with each of its bodies varied, along q and along v.
    pub fn run(&mut self) {
        self.tangent.k.fill(0.0);
        self.tangent.c.fill(0.0);
        let (mechanism, t) = (self.mechanism, Slope::fixed(self.at.t));
        let couplings = &mechanism.couplings;
        for (body, own) in couplings.bodies.iter().enumerate() {
            self.own(body, own);
        }
        for ((joint, blocks), rows) in mechanism.model().joints.iter().zip(&couplings.joints).zip(&mechanism.joints) {
            let lambda = &self.at.lambda[rows.range()];
            let reaction = |frames: &Frames<D>, out: &mut Wrenches<D>| {
                for pass in 0..frames.len().div_ceil(markers_per_pass(D)) {
                    let mut slopes = [[Slope::constant(0.0); 6]; MOST_ROWS];
                    joint.element.gradient(frames, t, pass, &mut slopes[..lambda.len()]);
                    let slots = pass * markers_per_pass(D)..frames.len().min((pass + 1) * markers_per_pass(D));
                    slots.for_each(|slot| out[slot] = reaction_wrench(lambda, &slopes, slot));
                }
            };
            self.element(blocks, &joint.markers, Along::Coordinates, 1.0, reaction);
        }
        for (force, blocks) in mechanism.model().forces.iter().zip(&couplings.forces) {
            let act = |frames: &Frames<D>, out: &mut Wrenches<D>| {
                let time = Taylor::new(t, Slope::constant(1.0), Slope::constant(0.0));
                force.element.act(frames, time, &mut out[..frames.len()]);
            };
            self.element(blocks, &force.markers, Along::Coordinates, -1.0, act);
            self.element(blocks, &force.markers, Along::Velocities, -1.0, act);
        }
    }

    /// -d(own forces) and d(M v') of one body.
    fn own(&mut self, body: usize, own: &Own) {
        let part = &self.mechanism.model().bodies[body];
        let (q, v, vdot) = (of(self.at.q, part, true), of(self.at.v, part, false), of(self.at.vdot, part, false));
        for along in [Along::Coordinates, Along::Velocities] {
            for first in (0..part.nv).step_by(6) {
                self.work.varied.vary(along, part, q, v, first);
                let varied = &mut self.work.varied;
                varied.f.clear();
                varied.f.resize(part.nv, Slope::fixed(0.0));
                part.body.own_forces(&varied.moved, &varied.moved_v, &self.mechanism.model().gravity, &mut varied.f);
                varied.f.iter_mut().for_each(|f| *f = -*f);
                if along == Along::Coordinates {
                    varied.mass.clear();
                    varied.mass.resize(own.mass_pattern.len(), Slope::fixed(0.0));
                    part.body.mass(&varied.moved, &mut varied.mass);
                    for (&(i, j), &entry) in own.mass_pattern.iter().zip(&varied.mass) {
                        varied.f[i] += entry * vdot[j];
                        if i != j {
                            varied.f[j] += entry * vdot[i];
                        }
                    }
                }
                self.add(along, own.first_entry, part.nv, first, 1.0);
            }
        }
    }

    /// The wrenches of one element with each of its bodies varied in turn.
    fn element(
        &mut self,
        blocks: &[Block],
        markers: &[usize],
        along: Along,
        sign: f64,
        wrenches: impl Fn(&Frames<D>, &mut Wrenches<D>),
    ) {
        let model = self.mechanism.model();
        for group in blocks.chunk_by(|a, b| a.column == b.column) {
            let column = group[0].column;
            let part = &model.bodies[column];
            for first in (0..part.nv).step_by(6) {
                let (q, v) = (of(self.at.q, part, true), of(self.at.v, part, false));
                self.work.varied.vary(along, part, q, v, first);
                let frames: [_; MOST_MARKERS] = from_fn(|i| {
                    let marker = markers[i.min(markers.len() - 1)];
                    match model.markers.bodies[marker] == Some(column) {
                        true => self.work.varied.frames[marker - part.first_marker],
                        false => fixed(&self.work.motion[marker]),
                    }
                });
                let frames = &frames[..markers.len()];
                let mut acting = [Wrench::zero(); MOST_MARKERS];
                wrenches(frames, &mut acting);
                for block in group {
                    self.pull_back(block, markers, frames, &acting);
                    self.add(along, block.first_entry, part.nv, first, sign);
                }
            }
        }
    }

    /// Generalized forces on the body of a row block, into `varied.f`.
    fn pull_back(&mut self, block: &Block, markers: &[usize], frames: &Frames<D>, wrenches: &Wrenches<D>) {
        let model = self.mechanism.model();
        let part = &model.bodies[block.row];
        let varied = &mut self.work.varied;
        varied.f.clear();
        varied.f.resize(part.nv, Slope::fixed(0.0));
        if block.row != block.column {
            varied.rest.clear();
            varied.rest.extend(of(self.at.q, part, true).iter().map(|&q| Slope::fixed(q)));
        }
        let q = if block.row == block.column { &varied.moved } else { &varied.rest };
        for ((frame, wrench), &marker) in frames.iter().zip(wrenches).zip(markers) {
            if model.markers.bodies[marker] == Some(block.row) {
                part.body.pull_back(q, &frame.map(|x| x.x), wrench, &mut varied.f);
            }
        }
    }

    /// Adds the slopes of `varied.f` to columns `first..` of a block with `width` columns.
    fn add(&mut self, along: Along, first_entry: usize, width: usize, first: usize, sign: f64) {
        let values = if along == Along::Coordinates { &mut self.tangent.k } else { &mut self.tangent.c };
        for (i, f) in self.work.varied.f.iter().enumerate() {
            let row = &mut values[first_entry + i * width..][first..width.min(first + 6)];
            row.iter_mut().zip(&f.eps).for_each(|(value, slope)| *value += sign * slope);
        }
    }
}

/// G^T lambda at one marker of a joint, as a wrench.
fn reaction_wrench<const D: usize>(lambda: &[f64], slopes: &[[Slope; 6]; MOST_ROWS], slot: usize) -> Wrench<Slope, D> {
    let first = slot % markers_per_pass(D) * twist_len(D);
    let mut sum = [Slope::constant(0.0); 6];
    for (&lambda, slope) in lambda.iter().zip(slopes) {
        sum.iter_mut().zip(&slope[first..]).for_each(|(sum, &entry)| *sum += entry * lambda);
    }
    Wrench::from_twist_order(&sum[..twist_len(D)])
}
