//! K and C: derivatives of the residual of the equations of motion with respect to q and v.

use super::coupling::{Block, Carrier, Coupling};
use super::mechanism::{Mechanism, Workspace, of};
use super::variation::{SeedDirection, fixed};
use crate::body::{BodyState, Dual6, Frame, MOST_MARKERS, Wrench, twist_len};
use crate::joint::{MOST_ROWS, markers_per_pass};
use crate::math::kkt::Pattern;
use crate::math::{Regime, Scalar, Taylor, Time};
use std::array::from_fn;

/// A state with its accelerations and multipliers.
#[derive(Clone, Copy, Debug)]
pub struct OperatingPoint<'a> {
    /// Time, s.
    pub t: f64,
    /// Coordinates, n_q.
    pub q: &'a [f64],
    /// Velocities, n_v.
    pub v: &'a [f64],
    /// Accelerations, n_v.
    pub vdot: &'a [f64],
    /// Multipliers, n_c.
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
    /// All zero, for the places of `pattern`.
    pub fn new(pattern: &Pattern) -> Self {
        Tangent { k: vec![0.0; pattern.entries.len()], c: vec![0.0; pattern.entries.len()] }
    }
}

/// One evaluation of K and C.
pub(super) struct Evaluation<'a, const D: usize> {
    pub mechanism: &'a Mechanism<D>,
    pub at: OperatingPoint<'a>,
    pub regime: Regime<'a>,
    pub work: &'a mut Workspace<D>,
    pub tangent: &'a mut Tangent,
}

type Wrenches<const D: usize> = [Wrench<Dual6, D>; MOST_MARKERS];
type Frames<const D: usize> = [Frame<Taylor<Dual6>, D>];

impl<const D: usize> Evaluation<'_, D> {
    /// Differentiates every element with respect to each of its bodies, along q and along v.
    pub fn run(&mut self) {
        self.tangent.k.fill(0.0);
        self.tangent.c.fill(0.0);
        let (mechanism, time) = (self.mechanism, Time { t: Dual6::fixed(self.at.t), regime: self.regime });
        let couplings = &mechanism.couplings;
        for (part, places) in mechanism.model().bodies.iter().zip(&couplings.bodies) {
            let own = BodyState {
                q: of(self.at.q, part, true),
                v: of(self.at.v, part, false),
                vdot: of(self.at.vdot, part, false),
                gravity: &mechanism.model().gravity,
            };
            part.body.tangent(own, &mut self.tangent.k[places.clone()], &mut self.tangent.c[places.clone()]);
        }
        for ((joint, coupling), rows) in mechanism.model().joints.iter().zip(&couplings.joints).zip(&mechanism.joints) {
            let lambda = &self.at.lambda[rows.range()];
            let reaction = |frames: &Frames<D>, out: &mut Wrenches<D>| {
                for pass in 0..frames.len().div_ceil(markers_per_pass(D)) {
                    let mut slopes = [[Dual6::constant(0.0); 6]; MOST_ROWS];
                    joint.element.gradient(frames, time, pass, &mut slopes[..lambda.len()]);
                    let slots = pass * markers_per_pass(D)..frames.len().min((pass + 1) * markers_per_pass(D));
                    slots.for_each(|slot| out[slot] = reaction_wrench(lambda, &slopes, slot));
                }
            };
            self.element(coupling, &joint.markers, SeedDirection::Coordinates, 1.0, reaction);
        }
        for (force, coupling) in mechanism.model().forces.iter().zip(&couplings.forces) {
            let act = |frames: &Frames<D>, out: &mut Wrenches<D>| {
                force.element.act(frames, time.map(Taylor::running), &mut out[..frames.len()]);
            };
            self.element(coupling, &force.markers, SeedDirection::Coordinates, -1.0, act);
            self.element(coupling, &force.markers, SeedDirection::Velocities, -1.0, act);
        }
    }

    /// The wrenches of one element, differentiated with respect to one of its bodies after the other.
    fn element(
        &mut self,
        coupling: &Coupling,
        markers: &[usize],
        along: SeedDirection,
        sign: f64,
        wrenches: impl Fn(&Frames<D>, &mut Wrenches<D>),
    ) {
        let model = self.mechanism.model();
        for (column, carrier) in coupling.carriers.iter().enumerate() {
            let part = &model.bodies[carrier.body];
            for (pass, directions) in carrier.velocities.chunks(6).enumerate() {
                let at = OperatingPoint { vdot: &[], ..self.at };
                self.work.varied.vary(along, part, &at, directions);
                let frames: [_; MOST_MARKERS] = from_fn(|i| {
                    let marker = markers[i.min(markers.len() - 1)];
                    match model.markers.bodies[marker] == Some(carrier.body) {
                        true => self.work.varied.frames[marker - part.first_marker],
                        false => fixed(&self.work.motion[marker]),
                    }
                });
                let frames = &frames[..markers.len()];
                let mut acting = [Wrench::zero(); MOST_MARKERS];
                wrenches(frames, &mut acting);
                for (row, block) in coupling.carriers.iter().zip(coupling.column(column)) {
                    self.pull_back(row, row.body == carrier.body, markers, frames, &acting);
                    self.add(along, block, 6 * pass, sign);
                }
            }
        }
    }

    /// Pulls the wrenches back to generalized forces on the velocities of a carrier, into `varied.f`.
    fn pull_back(
        &mut self,
        row: &Carrier,
        is_varied: bool,
        markers: &[usize],
        frames: &Frames<D>,
        wrenches: &Wrenches<D>,
    ) {
        let part = &self.mechanism.model().bodies[row.body];
        let varied = &mut self.work.varied;
        varied.f.clear();
        varied.f.resize(row.velocities.len(), Dual6::fixed(0.0));
        if !is_varied {
            varied.rest.clear();
            varied.rest.extend(of(self.at.q, part, true).iter().map(|&q| Dual6::fixed(q)));
        }
        let q = if is_varied { &varied.moved } else { &varied.rest };
        for held in &row.markers {
            let (index, frame) = (markers[held.slot] - part.first_marker, frames[held.slot].map(|x| x.x));
            if held.places.len() == row.velocities.len() {
                part.body.pull_back(index, q, &frame, &wrenches[held.slot], &mut varied.f);
                continue;
            }
            varied.pulled.clear();
            varied.pulled.resize(held.places.len(), Dual6::fixed(0.0));
            part.body.pull_back(index, q, &frame, &wrenches[held.slot], &mut varied.pulled);
            held.places.iter().zip(&varied.pulled).for_each(|(&place, &f)| varied.f[place] += f);
        }
    }

    /// Adds the derivatives of `varied.f` to columns `first..` of a block.
    fn add(&mut self, along: SeedDirection, block: &Block, first: usize, sign: f64) {
        let values = if along == SeedDirection::Coordinates { &mut self.tangent.k } else { &mut self.tangent.c };
        let rows = values[block.first_entry..].chunks_exact_mut(block.width);
        for (row, f) in rows.zip(&self.work.varied.f) {
            row[first..].iter_mut().zip(&f.eps).for_each(|(value, slope)| *value += sign * slope);
        }
    }
}

/// G^T lambda at one marker of a joint, as a wrench.
fn reaction_wrench<const D: usize>(lambda: &[f64], slopes: &[[Dual6; 6]; MOST_ROWS], slot: usize) -> Wrench<Dual6, D> {
    let first = slot % markers_per_pass(D) * twist_len(D);
    let mut sum = [Dual6::constant(0.0); 6];
    for (&lambda, slope) in lambda.iter().zip(slopes) {
        sum.iter_mut().zip(&slope[first..]).for_each(|(sum, &entry)| *sum += entry * lambda);
    }
    Wrench::from_twist_order(&sum[..twist_len(D)])
}
