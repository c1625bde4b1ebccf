//! The equations of a scene's model.

use super::output::Output;
use super::{Column, Dimensions, Energy, Group, MechanicalSystem, Names, Need, Scratch, Structure, Terms};
use crate::body::{Frame, MOST_MARKERS, Slope, Wrench, twist_len};
use crate::joint::{MOST_ROWS, markers_per_pass};
use crate::math::kkt::Pattern;
use crate::math::{Scalar, Taylor};
use crate::scene::{Connection, Measure, Model, Part, Watched};
use std::array::from_fn;
use std::ops::Range;

/// A model with the places of its coordinates, rows and matrix entries fixed.
pub struct Mechanism<const D: usize> {
    model: Model<D>,
    dimensions: Dimensions,
    structure: Structure,
    joints: Vec<Rows>,
    /// Places of each body's values of M.
    masses: Vec<Range<usize>>,
    pub(super) length: f64,
}

/// Where a joint stands in phi and G.
struct Rows {
    first: usize,
    count: usize,
    /// Whether phi depends on t itself.
    rheonomic: bool,
    blocks: Vec<Block>,
}

/// Entries of G for one joint and one of its markers: `rows` x the velocities of the marker's body, row by row.
struct Block {
    /// Which of the joint's markers.
    slot: usize,
    body: usize,
    first_entry: usize,
    /// False where an earlier block of the joint has the same body.
    first_of_body: bool,
}

/// Memory of one evaluation.
pub(super) struct Workspace<const D: usize> {
    /// Frames of all markers with their velocities, and accelerations at v' = 0.
    pub motion: Vec<Frame<Taylor<f64>, D>>,
    varied: Varied<D>,
}

/// One body as a function of six of its velocity directions.
#[derive(Default)]
struct Varied<const D: usize> {
    frames: Vec<Frame<Taylor<Slope>, D>>,
    q: Vec<Slope>,
    v: Vec<Slope>,
    directions: Vec<Slope>,
    moved: Vec<Slope>,
}

impl<const D: usize> Mechanism<D> {
    pub fn new(model: Model<D>) -> Self {
        let last = model.bodies.last();
        let (q, v) = last.map_or((0, 0), |part| (part.first_q + part.nq, part.first_v + part.nv));
        let mut mass = Pattern { rows: v, cols: v, entries: Vec::new() };
        let mut masses = Vec::new();
        for part in &model.bodies {
            let first = mass.entries.len();
            let places = part.body.mass_pattern().into_iter();
            mass.entries.extend(places.map(|(i, j)| (part.first_v + i, part.first_v + j)));
            masses.push(first..mass.entries.len());
        }
        let mut g = Pattern { rows: 0, cols: v, entries: Vec::new() };
        let joints = model.joints.iter().map(|joint| {
            let rows = Rows {
                first: g.rows,
                count: joint.element.row_names().len(),
                rheonomic: joint.element.depends_on_time(),
                blocks: blocks(&model, &joint.markers, joint.element.row_names().len(), &mut g),
            };
            g.rows += rows.count;
            rows
        });
        let joints = joints.collect();
        let dimensions = Dimensions { q, v, lambda: g.rows };
        let length = length_scale(&model);
        Mechanism { model, dimensions, structure: Structure { mass, g }, joints, masses, length }
    }

    pub fn model(&self) -> &Model<D> {
        &self.model
    }

    /// Rows of phi that joint `joint` has.
    pub fn rows_of_joint(&self, joint: usize) -> Range<usize> {
        let rows = &self.joints[joint];
        rows.first..rows.first + rows.count
    }

    pub(super) fn workspace<'a>(&self, scratch: &'a mut Scratch) -> &'a mut Workspace<D> {
        scratch.get(|| Workspace {
            motion: self.model.ground_frames().map(|frame| frame.map(Taylor::fixed)).collect(),
            varied: Varied::default(),
        })
    }

    /// Moves all frames to (q, v).
    pub(super) fn place(&self, q: &[f64], v: &[f64], work: &mut Workspace<D>) {
        work.motion.resize(self.model.marker_count(), Frame::world());
        for part in &self.model.bodies {
            let frames = &mut work.motion[part.first_marker..][..part.body.marker_count()];
            part.body.motion(of(q, part, true), of(v, part, false), None, frames);
        }
    }

    fn mass_and_own_forces(&self, q: &[f64], v: &[f64], need: Need, terms: &mut Terms) {
        for (part, places) in self.model.bodies.iter().zip(&self.masses) {
            let (q, v) = (of(q, part, true), of(v, part, false));
            if need.includes(Need::MASS) {
                part.body.mass(q, &mut terms.mass[places.clone()]);
            }
            if need.includes(Need::FORCE) {
                let f = &mut terms.f[part.first_v..part.first_v + part.nv];
                f.fill(0.0);
                part.body.own_forces(q, v, &self.model.gravity, f);
            }
        }
    }

    fn forces(&self, t: f64, q: &[f64], work: &Workspace<D>, terms: &mut Terms) {
        terms.power = 0.0;
        for force in &self.model.forces {
            let mut wrenches = [Wrench::zero(); MOST_MARKERS];
            let wrenches = &mut wrenches[..force.markers.len()];
            let action = with_frames(&work.motion, &force.markers, |frames| {
                force.element.act(frames, Taylor::time(t), wrenches)
            });
            terms.power += action.potential.d;
            for (wrench, &marker) in wrenches.iter().zip(&force.markers) {
                let frame = &work.motion[marker];
                terms.power += power(frame, wrench);
                if let Some(part) = self.model.carrier(marker) {
                    let f = &mut terms.f[part.first_v..part.first_v + part.nv];
                    part.body.pull_back(of(q, part, true), &frame.map(|x| x.x), wrench, f);
                }
            }
        }
    }

    fn constraints(&self, t: f64, q: &[f64], need: Need, work: &Workspace<D>, terms: &mut Terms) {
        for (joint, rows) in self.model.joints.iter().zip(&self.joints) {
            with_frames(&work.motion, &joint.markers, |frames| {
                if need.includes(Need::CONSTRAINTS) {
                    levels(t, rows, joint.element.as_ref(), frames, terms);
                }
                if need.includes(Need::G) {
                    self.gradient(t, q, rows, joint.element.as_ref(), frames, terms);
                }
            });
        }
    }

    /// Rows of G: the gradient with respect to each marker's twist, pulled back like a wrench.
    fn gradient(
        &self,
        t: f64,
        q: &[f64],
        rows: &Rows,
        joint: &dyn crate::joint::Joint<D>,
        frames: &[Frame<Taylor<f64>, D>],
        terms: &mut Terms,
    ) {
        let per_pass = markers_per_pass(D);
        let mut slopes = [[0.0; 6]; MOST_ROWS];
        let slopes = &mut slopes[..rows.count];
        for pass in 0..frames.len().div_ceil(per_pass) {
            let in_pass = |block: &&Block| block.slot / per_pass == pass;
            if !rows.blocks.iter().any(|block| in_pass(&block)) {
                continue;
            }
            joint.gradient(frames, t, pass, slopes);
            for block in rows.blocks.iter().filter(in_pass) {
                let part = &self.model.bodies[block.body];
                let frame = frames[block.slot].map(|x| x.x);
                let first = block.slot % per_pass * twist_len(D);
                let entries = &mut terms.g[block.first_entry..][..rows.count * part.nv];
                entries.fill(0.0);
                for (entries, slope) in entries.chunks_exact_mut(part.nv).zip(slopes.iter()) {
                    let wrench = Wrench::from_twist_order(&slope[first..first + twist_len(D)]);
                    part.body.pull_back(of(q, part, true), &frame, &wrench, entries);
                }
            }
        }
    }

    /// L = d(phi')/dq: each joint is evaluated with its bodies varied, one after the other.
    fn curvature(&self, t: f64, q: &[f64], v: &[f64], work: &mut Workspace<D>, terms: &mut Terms) {
        for (joint, rows) in self.model.joints.iter().zip(&self.joints) {
            let mut frames: [Frame<Taylor<Slope>, D>; MOST_MARKERS] =
                from_fn(|i| fixed(&work.motion[joint.markers[i.min(joint.markers.len() - 1)]]));
            for block in &rows.blocks {
                let part = &self.model.bodies[block.body];
                let entries = &mut terms.l[block.first_entry..][..rows.count * part.nv];
                entries.fill(0.0);
                if !block.first_of_body {
                    continue;
                }
                for first in (0..part.nv).step_by(6) {
                    work.varied.vary(part, of(q, part, true), of(v, part, false), first);
                    for (frame, &marker) in frames.iter_mut().zip(&joint.markers) {
                        *frame = match self.model.markers.bodies[marker] == Some(block.body) {
                            true => work.varied.frames[marker - part.first_marker],
                            false => fixed(&work.motion[marker]),
                        };
                    }
                    let mut levels = [Taylor::fixed(Slope::constant(0.0)); MOST_ROWS];
                    let levels = &mut levels[..rows.count];
                    joint.element.levels(&frames[..joint.markers.len()], Taylor::time(t), levels);
                    for (row, level) in levels.iter().enumerate() {
                        let columns = first..part.nv.min(first + 6);
                        columns.for_each(|j| entries[row * part.nv + j] = level.d.eps[j - first]);
                    }
                }
            }
        }
    }
}

/// phi, phi' and gamma of a joint, and phi_t: the rate with all frames held.
fn levels<const D: usize>(
    t: f64,
    rows: &Rows,
    joint: &dyn crate::joint::Joint<D>,
    frames: &[Frame<Taylor<f64>, D>],
    terms: &mut Terms,
) {
    let mut levels = [Taylor::fixed(0.0); MOST_ROWS];
    let levels = &mut levels[..rows.count];
    joint.levels(frames, Taylor::time(t), levels);
    for (row, level) in (rows.first..).zip(levels.iter()) {
        (terms.phi[row], terms.phi_dot[row], terms.gamma[row]) = (level.x, level.d, -level.dd);
    }
    let phi_t = &mut terms.phi_t[rows.first..rows.first + rows.count];
    phi_t.fill(0.0);
    if rows.rheonomic {
        let held: [_; MOST_MARKERS] = from_fn(|i| frames[i.min(frames.len() - 1)].map(|x| Taylor::fixed(x.x)));
        joint.levels(&held[..frames.len()], Taylor::time(t), levels);
        phi_t.iter_mut().zip(levels).for_each(|(rate, level)| *rate = level.d);
    }
}

impl<const D: usize> Varied<D> {
    /// Frames of a body's markers as functions of six of its velocity directions: q + N(q) e_j, v held.
    fn vary(&mut self, part: &Part<D>, q: &[f64], v: &[f64], first: usize) {
        let lift = |from: &[f64], to: &mut Vec<Slope>| {
            to.clear();
            to.extend(from.iter().map(|&x| Slope::fixed(x)));
        };
        lift(q, &mut self.q);
        lift(v, &mut self.v);
        self.directions.clear();
        self.directions.resize(part.nv, Slope::fixed(0.0));
        let seeded = self.directions[first..].iter_mut().take(6).enumerate();
        seeded.for_each(|(j, direction)| *direction = Slope::seeded(0.0, j));
        self.moved.clear();
        self.moved.resize(part.nq, Slope::fixed(0.0));
        part.body.rate(&self.q, &self.directions, &mut self.moved);
        self.moved.iter_mut().zip(&self.q).for_each(|(moved, &q)| *moved += q);
        self.frames.resize(part.body.marker_count(), Frame::world());
        part.body.motion(&self.moved, &self.v, None, &mut self.frames);
    }
}

fn fixed<const D: usize>(frame: &Frame<Taylor<f64>, D>) -> Frame<Taylor<Slope>, D> {
    frame.map(|x| Taylor::new(Slope::fixed(x.x), Slope::fixed(x.d), Slope::fixed(x.dd)))
}

/// The part of q or v that belongs to a body.
pub(super) fn of<'a, const D: usize>(all: &'a [f64], part: &Part<D>, coordinates: bool) -> &'a [f64] {
    match coordinates {
        true => &all[part.first_q..part.first_q + part.nq],
        false => &all[part.first_v..part.first_v + part.nv],
    }
}

/// Puts the frames of an element's markers side by side for `see`; most elements have one or two.
pub(super) fn with_frames<R, const D: usize>(
    all: &[Frame<Taylor<f64>, D>],
    markers: &[usize],
    see: impl FnOnce(&[Frame<Taylor<f64>, D>]) -> R,
) -> R {
    match *markers {
        [a] => see(&[all[a]]),
        [a, b] => see(&[all[a], all[b]]),
        _ => {
            let many: [_; MOST_MARKERS] = from_fn(|i| all[markers[i.min(markers.len() - 1)]]);
            see(&many[..markers.len()])
        }
    }
}

/// Power of a wrench at a moving frame, W.
fn power<const D: usize>(frame: &Frame<Taylor<f64>, D>, wrench: &Wrench<f64, D>) -> f64 {
    let force: f64 = frame.r.iter().zip(wrench.force).map(|(r, f)| r.d * f).sum();
    match wrench.torque == [0.0; 3] {
        true => force,
        false => force + frame.angular_velocity().iter().zip(wrench.torque).map(|(w, m)| w * m).sum::<f64>(),
    }
}

fn blocks<const D: usize>(model: &Model<D>, markers: &[usize], rows: usize, g: &mut Pattern) -> Vec<Block> {
    let mut blocks: Vec<Block> = Vec::new();
    for (slot, &marker) in markers.iter().enumerate() {
        let Some(body) = model.markers.bodies[marker] else { continue };
        let part = &model.bodies[body];
        let first_of_body = blocks.iter().all(|block| block.body != body);
        blocks.push(Block { slot, body, first_entry: g.entries.len(), first_of_body });
        let places = (0..rows).flat_map(|i| (0..part.nv).map(move |j| (i, j)));
        g.entries.extend(places.map(|(i, j)| (g.rows + i, part.first_v + j)));
    }
    blocks
}

/// A length typical of the scene, m: the largest distance of a marker from its body's origin; where all lie there, of
/// the ground's markers; else 1.
fn length_scale<const D: usize>(model: &Model<D>) -> f64 {
    let bodies = model.bodies.iter().map(|part| part.body.reach()).fold(0.0, f64::max);
    let ground = model.ground.iter().map(|marker| size(&marker.offset)).fold(0.0, f64::max);
    [bodies, ground].into_iter().find(|length| *length > 0.0).unwrap_or(1.0)
}

pub(super) fn size<const D: usize>(vector: &[f64; D]) -> f64 {
    vector.iter().map(|x| x * x).sum::<f64>().sqrt()
}

impl<const D: usize> MechanicalSystem for Mechanism<D> {
    fn dimensions(&self) -> Dimensions {
        self.dimensions
    }

    fn structure(&self) -> Structure {
        self.structure.clone()
    }

    fn names(&self) -> Names {
        let all = |names: fn(&Part<D>) -> Vec<&'static str>| {
            let bodies = self.model.bodies.iter();
            bodies.flat_map(|part| names(part).into_iter().map(|name| format!("{}.{name}", part.name))).collect()
        };
        let joints = self.model.joints.iter();
        Names {
            q: all(|part| part.body.coordinate_names()),
            v: all(|part| part.body.velocity_names()),
            lambda: joints
                .flat_map(|joint| {
                    joint.element.row_names().into_iter().map(|row| format!("joint.{}.{row}", joint.name))
                })
                .collect(),
        }
    }

    fn rate(&self, q: &[f64], v: &[f64], qdot: &mut [f64]) {
        for part in &self.model.bodies {
            let rates = &mut qdot[part.first_q..part.first_q + part.nq];
            part.body.rate(of(q, part, true), of(v, part, false), rates);
        }
    }

    fn evaluate(&self, t: f64, q: &[f64], v: &[f64], need: Need, terms: &mut Terms, scratch: &mut Scratch) {
        let work = self.workspace(scratch);
        self.place(q, v, work);
        self.mass_and_own_forces(q, v, need, terms);
        if need.includes(Need::FORCE) {
            self.forces(t, q, work, terms);
        }
        self.constraints(t, q, need, work, terms);
        if need.includes(Need::L) {
            self.curvature(t, q, v, work, terms);
        }
    }

    fn normalize(&self, q: &mut [f64]) {
        for part in &self.model.bodies {
            part.body.normalize(&mut q[part.first_q..part.first_q + part.nq]);
        }
    }

    fn energy(&self, t: f64, q: &[f64], v: &[f64], scratch: &mut Scratch) -> Option<Energy> {
        let work = self.workspace(scratch);
        self.place(q, v, work);
        let mut total = Energy::default();
        for part in &self.model.bodies {
            let energy = part.body.energy(of(q, part, true), of(v, part, false), &self.model.gravity);
            total.kinetic += energy.kinetic;
            total.potential += energy.potential;
        }
        for force in &self.model.forces {
            let mut wrenches = [Wrench::zero(); MOST_MARKERS];
            let wrenches = &mut wrenches[..force.markers.len()];
            let act = |frames: &[_]| force.element.act(frames, Taylor::time(t), wrenches).potential.x;
            total.potential += with_frames(&work.motion, &force.markers, act);
        }
        Some(total)
    }

    fn columns(&self) -> Vec<Column> {
        let column = |output: &Watched| Column {
            name: output.name.clone(),
            unit: output.unit.clone(),
            periodic: D == 3 && matches!(output.measure, Measure::Turn { .. }),
        };
        self.model.outputs.iter().map(column).collect()
    }

    fn groups(&self) -> Vec<Group> {
        let joints = self.model.joints.iter().zip(&self.joints);
        let group = |(joint, rows): (&Connection<_>, &Rows)| Group {
            name: joint.name.clone(),
            kind: joint.kind.to_string(),
            rows: rows.first..rows.first + rows.count,
        };
        joints.map(group).collect()
    }

    fn outputs(&self, t: f64, q: &[f64], v: &[f64], lambda: &[f64], out: &mut [f64], scratch: &mut Scratch) {
        Output { mechanism: self, t, q, v, lambda }.write(out, scratch);
    }

    fn scales(&self) -> Vec<f64> {
        let rows = self.model.joints.iter().flat_map(|joint| joint.element.row_names());
        rows.map(|row| if matches!(row, "x" | "y" | "z" | "length") { self.length } else { 1.0 }).collect()
    }
}
