//! K and C: derivatives of the residual of the equations of motion with respect to q and v.

use super::coupling::{Block, Carrier, Coupling, LockedBlocks};
use super::locked::Stiffness;
use super::mechanism::{Mechanism, of};
use super::solid::Solid;
use super::variation::{SeedDirection, SeededBody, fix};
use super::view::input_on;
use super::workspace::Workspace;
use crate::body::{BodyState, Dual6, Frame, Wrench, twist_len};
use crate::joint::{MOST_ROWS, markers_per_pass};
use crate::math::array::Each;
use crate::math::kkt::Pattern;
use crate::math::{Regime, Scalar, Taylor, Time};

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

type Frames<const D: usize> = [Frame<Taylor<Dual6>, D>];

impl<const D: usize> Evaluation<'_, D> {
    /// Differentiates every element with respect to each of its bodies, along q and along v.
    pub fn run(&mut self) {
        self.tangent.k.fill(0.0);
        self.tangent.c.fill(0.0);
        let mechanism = self.mechanism;
        let time = Time { t: Dual6::fixed(self.at.t), regime: self.regime };
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
        for LockedBlocks { joint, first } in &couplings.locked {
            self.locked(*joint, first);
        }
        for (joint, coupling) in &couplings.joints {
            let lambda = &self.at.lambda[mechanism.rows_of_joint(*joint)];
            let joint = &mechanism.model().joints[*joint];
            let reaction = |frames: &Frames<D>, out: &mut [Wrench<Dual6, D>]| {
                for pass in 0..frames.len().div_ceil(markers_per_pass(D)) {
                    let mut slopes = [[Dual6::constant(0.0); 6]; MOST_ROWS];
                    joint.element.gradient(frames, time, pass, &mut slopes[..lambda.len()]);
                    let slots = pass * markers_per_pass(D)..frames.len().min((pass + 1) * markers_per_pass(D));
                    slots.for_each(|slot| out[slot] = reaction_wrench(lambda, &slopes, slot));
                }
            };
            self.element(coupling, &joint.markers, SeedDirection::Coordinates, 1.0, reaction);
        }
        for (i, (force, coupling)) in mechanism.model().forces.iter().zip(&couplings.forces).enumerate() {
            let input = input_on(mechanism.model(), i, &self.work.inputs).map(|u| Taylor::fixed(Dual6::constant(u)));
            let act = |frames: &Frames<D>, out: &mut [Wrench<Dual6, D>]| {
                force.element.driven(&input, frames, time.map(Taylor::running), out);
            };
            self.element(coupling, &force.markers, SeedDirection::Coordinates, -1.0, act);
            if force.element.depends_on_velocities() {
                self.element(coupling, &force.markers, SeedDirection::Velocities, -1.0, act);
            }
        }
    }

    /// K of a joint between rigid bodies, in closed form.
    fn locked(&mut self, joint: usize, first: &[[Option<usize>; 2]; 2]) {
        let mechanism = self.mechanism;
        let motion = &self.work.motion;
        let (model, Some(lock)) = (mechanism.model(), &mechanism.rigid.locks[joint]) else { return };
        let &[a, b] = &model.joints[joint].markers[..] else { return };
        let solids = [a, b].map(|marker| mechanism.solid(model.markers.bodies[marker]?, motion));
        let lambda = &self.at.lambda[mechanism.rows_of_joint(joint)];
        let are_rotations = lock.changes_with_rotations();
        let mut stiffness = Stiffness { solids, first, are_rotations, k: &mut self.tangent.k };
        stiffness.add(lock, [&motion[a], &motion[b]], lambda);
    }

    /// The wrenches of one element, differentiated with respect to one of its bodies after the other.
    fn element(
        &mut self,
        coupling: &Coupling,
        markers: &[usize],
        along: SeedDirection,
        sign: f64,
        wrenches: impl Fn(&Frames<D>, &mut [Wrench<Dual6, D>]),
    ) {
        let model = self.mechanism.model();
        if let Some(pair) = self.pair(coupling) {
            return self.both(&pair, coupling, markers, (along, sign), wrenches);
        }
        for (column, carrier) in coupling.carriers.iter().enumerate() {
            let part = &model.bodies[carrier.body];
            for (pass, directions) in carrier.velocities.chunks(6).enumerate() {
                let at = OperatingPoint { vdot: &[], ..self.at };
                let Workspace { varied, motion, .. } = &mut *self.work;
                varied.vary(along, part, (&at, self.mechanism.solid(carrier.body, motion)), directions);
                varied.gather(part, markers, motion, |slot| model.markers.bodies[markers[slot]] == Some(carrier.body));
                varied.acting.clear();
                varied.acting.resize(markers.len(), Wrench::zero());
                wrenches(&varied.gathered, &mut varied.acting);
                for (row, block) in coupling.carriers.iter().zip(coupling.column(column)) {
                    let is_moved = row.body == carrier.body && along == SeedDirection::Coordinates;
                    self.pull_back(row, (row.body == carrier.body, is_moved), markers);
                    self.add((along, sign), block, 6 * pass, 0);
                }
            }
        }
    }

    /// The bodies of an element, if they are two rigid ones with six directions in all.
    fn pair(&self, coupling: &Coupling) -> Option<[Solid<D>; 2]> {
        let [a, b] = &coupling.carriers[..] else { return None };
        if a.velocities.len() + b.velocities.len() > 6 {
            return None;
        }
        let of = |carrier: &Carrier| self.mechanism.solid(carrier.body, &self.work.motion);
        let a = of(a)?;
        let b = of(b)?;
        let b = b.behind(&a);
        Some([a, b])
    }

    /// [`Self::element`] with respect to both of its bodies at once.
    fn both(
        &mut self,
        pair: &[Solid<D>; 2],
        coupling: &Coupling,
        markers: &[usize],
        (along, sign): (SeedDirection, f64),
        wrenches: impl Fn(&Frames<D>, &mut [Wrench<Dual6, D>]),
    ) {
        let Workspace { varied, motion, .. } = &mut *self.work;
        let SeededBody { gathered, acting, .. } = varied;
        gathered.resize(markers.len(), Frame::world());
        for (&marker, out) in markers.iter().zip(gathered.iter_mut()) {
            let body = self.mechanism.model().markers.bodies[marker];
            match coupling.carriers.iter().zip(pair).find(|(carrier, _)| Some(carrier.body) == body) {
                Some((_, solid)) => solid.seed(along, &motion[marker], out),
                None => fix(&motion[marker], out),
            }
        }
        acting.clear();
        acting.resize(markers.len(), Wrench::zero());
        wrenches(gathered, acting);
        let is_moved = along == SeedDirection::Coordinates;
        for (place, (row, solid)) in coupling.carriers.iter().zip(pair).enumerate() {
            let SeededBody { gathered, acting, f, .. } = &mut self.work.varied;
            f.clear();
            f.resize(row.velocities.len(), Dual6::fixed(0.0));
            for held in &row.markers {
                solid.pull_back(is_moved, &gathered[held.slot].r.each(|x| x.x), &acting[held.slot], f);
            }
            for (column, solid) in pair.iter().enumerate() {
                self.add((along, sign), &coupling.column(column)[place], 0, solid.first());
            }
        }
    }

    /// Pulls the wrenches back to generalized forces on the velocities of a carrier, into `varied.f`.
    fn pull_back(&mut self, row: &Carrier, (is_varied, is_moved): (bool, bool), markers: &[usize]) {
        let part = &self.mechanism.model().bodies[row.body];
        let Workspace { varied, motion, .. } = &mut *self.work;
        let SeededBody { gathered, acting, moved, rest, f, pulled, .. } = varied;
        f.clear();
        f.resize(row.velocities.len(), Dual6::fixed(0.0));
        if let Some(solid) = self.mechanism.solid(row.body, motion) {
            for held in &row.markers {
                solid.pull_back(is_moved, &gathered[held.slot].r.each(|x| x.x), &acting[held.slot], f);
            }
            return;
        }
        if !is_varied {
            rest.clear();
            rest.extend(of(self.at.q, part, true).iter().map(|&q| Dual6::fixed(q)));
        }
        let q = if is_varied { moved } else { rest };
        for held in &row.markers {
            let index = markers[held.slot] - part.first_marker;
            let frame = gathered[held.slot].map(|x| x.x);
            if held.places.len() == row.velocities.len() {
                part.body.pull_back(index, q, &frame, &acting[held.slot], f);
                continue;
            }
            pulled.clear();
            pulled.resize(held.places.len(), Dual6::fixed(0.0));
            part.body.pull_back(index, q, &frame, &acting[held.slot], pulled);
            held.places.iter().zip(pulled.iter()).for_each(|(&place, &own)| f[place] += own);
        }
    }

    /// Adds the derivatives of `varied.f` from number `from` on to columns `first..` of a block.
    fn add(&mut self, (along, sign): (SeedDirection, f64), block: &Block, first: usize, from: usize) {
        let values = if along == SeedDirection::Coordinates { &mut self.tangent.k } else { &mut self.tangent.c };
        let rows = values[block.first_entry..].chunks_exact_mut(block.width);
        for (row, f) in rows.zip(&self.work.varied.f) {
            row[first..].iter_mut().zip(&f.eps[from..]).for_each(|(value, slope)| *value += sign * slope);
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
