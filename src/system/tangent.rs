//! K and C: derivatives of the residual of the equations of motion with respect to q and v.

use super::coupling::{Carrier, CouplingBlock, Couplings, ElementCoupling, LockedBlocks};
use super::gather::MovingFrames;
use super::layout::Layout;
use super::locked::LockedStiffness;
use super::seed::{SeedDirection, fix};
use super::solid::Solid;
use super::terms::{OperatingPoint, Tangent};
use super::variation::SeededBody;
use super::view::input_on;
use crate::body::{BodyState, Dual6, Frame, Wrench, twist_len};
use crate::joint::{MOST_ROWS, markers_per_pass};
use crate::math::array::Each;
use crate::math::{Regime, Scalar, Taylor, Time};

/// One evaluation of K and C.
pub(super) struct Tangents<'a, const D: usize> {
    pub layout: &'a Layout<D>,
    pub couplings: &'a Couplings,
    pub at: OperatingPoint<'a>,
    pub regime: Regime<'a>,
    /// SeededFrames of all markers at the state with v' = 0.
    pub motion: &'a MovingFrames<D>,
    pub varied: &'a mut SeededBody<D>,
    /// Values of the inputs; empty where all are zero.
    pub inputs: &'a [f64],
    pub tangent: &'a mut Tangent,
}

type SeededFrames<const D: usize> = [Frame<Taylor<Dual6>, D>];

impl<const D: usize> Tangents<'_, D> {
    /// Differentiates every element with respect to each of its bodies, along q and along v.
    pub fn run(&mut self) {
        self.tangent.k.fill(0.0);
        self.tangent.c.fill(0.0);
        let layout = self.layout;
        let time = Time { t: Dual6::fixed(self.at.t), regime: self.regime };
        let couplings = self.couplings;
        for (part, places) in layout.model.bodies.iter().zip(&couplings.bodies) {
            let own = BodyState {
                q: part.coordinates(self.at.q),
                v: part.velocities(self.at.v),
                vdot: part.velocities(self.at.vdot),
                gravity: &layout.model.gravity,
            };
            part.body.tangent(own, &mut self.tangent.k[places.clone()], &mut self.tangent.c[places.clone()]);
        }
        for LockedBlocks { joint, first } in &couplings.locked {
            self.locked(*joint, first);
        }
        for (joint, coupling) in &couplings.joints {
            let lambda = &self.at.lambda[layout.rows_of_joint(*joint)];
            let joint = &layout.model.joints[*joint];
            let reaction = |frames: &SeededFrames<D>, out: &mut [Wrench<Dual6, D>]| {
                for pass in 0..frames.len().div_ceil(markers_per_pass(D)) {
                    let mut slopes = [[Dual6::constant(0.0); 6]; MOST_ROWS];
                    joint.element.gradient(frames, time, pass, &mut slopes[..lambda.len()]);
                    let slots = pass * markers_per_pass(D)..frames.len().min((pass + 1) * markers_per_pass(D));
                    slots.for_each(|slot| out[slot] = reaction_wrench(lambda, &slopes, slot));
                }
            };
            self.element(coupling, &joint.markers, SeedDirection::Coordinates, 1.0, reaction);
        }
        for (i, (force, coupling)) in layout.model.forces.iter().zip(&couplings.forces).enumerate() {
            let input = input_on(&layout.model, i, self.inputs).map(|u| Taylor::fixed(Dual6::constant(u)));
            let act = |frames: &SeededFrames<D>, out: &mut [Wrench<Dual6, D>]| {
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
        let Layout { model, locks, .. } = self.layout;
        let motion = self.motion;
        let Some(lock) = &locks[joint] else { return };
        let &[a, b] = &model.joints[joint].markers[..] else { return };
        let solid = |marker: usize| self.layout.solid(model.markers.bodies[marker]?, motion);
        let solids = [solid(a), solid(b)];
        let lambda = &self.at.lambda[self.layout.rows_of_joint(joint)];
        let are_rotations = lock.changes_with_rotations();
        let mut stiffness = LockedStiffness { solids, first, are_rotations, k: &mut self.tangent.k };
        stiffness.add(lock, [&motion[a], &motion[b]], lambda);
    }

    /// The wrenches of one element, differentiated with respect to one of its bodies after the other.
    fn element(
        &mut self,
        coupling: &ElementCoupling,
        markers: &[usize],
        along: SeedDirection,
        sign: f64,
        wrenches: impl Fn(&SeededFrames<D>, &mut [Wrench<Dual6, D>]),
    ) {
        let model = &self.layout.model;
        if let Some(pair) = self.pair(coupling) {
            return self.both(&pair, coupling, markers, along, sign, wrenches);
        }
        for (column, carrier) in coupling.carriers.iter().enumerate() {
            let part = &model.bodies[carrier.body];
            for (pass, directions) in carrier.velocities.chunks(6).enumerate() {
                let at = OperatingPoint { vdot: &[], ..self.at };
                let motion = self.motion;
                let varied = &mut *self.varied;
                varied.vary(along, part, &at, self.layout.solid(carrier.body, motion), directions);
                varied.gather(part, markers, motion, |slot| model.markers.bodies[markers[slot]] == Some(carrier.body));
                varied.acting.clear();
                varied.acting.resize(markers.len(), Wrench::zero());
                wrenches(&varied.gathered, &mut varied.acting);
                for (row, block) in coupling.carriers.iter().zip(coupling.column(column)) {
                    let is_moved = row.body == carrier.body && along == SeedDirection::Coordinates;
                    self.pull_back(row, row.body == carrier.body, is_moved, markers);
                    self.add(along, sign, block, 6 * pass, 0);
                }
            }
        }
    }

    /// The bodies of an element, if they are two rigid ones with six directions in all.
    fn pair(&self, coupling: &ElementCoupling) -> Option<[Solid<D>; 2]> {
        let [a, b] = &coupling.carriers[..] else { return None };
        if a.velocities.len() + b.velocities.len() > 6 {
            return None;
        }
        let of = |carrier: &Carrier| self.layout.solid(carrier.body, self.motion);
        let a = of(a)?;
        let b = of(b)?;
        let b = b.behind(&a);
        Some([a, b])
    }

    /// [`Self::element`] with respect to both of its bodies at once.
    fn both(
        &mut self,
        pair: &[Solid<D>; 2],
        coupling: &ElementCoupling,
        markers: &[usize],
        along: SeedDirection,
        sign: f64,
        wrenches: impl Fn(&SeededFrames<D>, &mut [Wrench<Dual6, D>]),
    ) {
        let motion = self.motion;
        let SeededBody { gathered, acting, .. } = &mut *self.varied;
        gathered.resize(markers.len(), Frame::world());
        for (&marker, out) in markers.iter().zip(gathered.iter_mut()) {
            let body = self.layout.model.markers.bodies[marker];
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
            let SeededBody { gathered, acting, f, .. } = &mut *self.varied;
            f.clear();
            f.resize(row.velocities.len(), Dual6::fixed(0.0));
            for held in &row.markers {
                solid.pull_back(is_moved, &gathered[held.slot].r.each(|x| x.x), &acting[held.slot], f);
            }
            for (column, solid) in pair.iter().enumerate() {
                self.add(along, sign, &coupling.column(column)[place], 0, solid.first());
            }
        }
    }

    /// Pulls the wrenches back to generalized forces on the velocities of a carrier, into `varied.f`.
    fn pull_back(&mut self, row: &Carrier, is_varied: bool, is_moved: bool, markers: &[usize]) {
        let part = &self.layout.model.bodies[row.body];
        let SeededBody { gathered, acting, moved, rest, f, pulled, .. } = &mut *self.varied;
        f.clear();
        f.resize(row.velocities.len(), Dual6::fixed(0.0));
        if let Some(solid) = self.layout.solid(row.body, self.motion) {
            for held in &row.markers {
                solid.pull_back(is_moved, &gathered[held.slot].r.each(|x| x.x), &acting[held.slot], f);
            }
            return;
        }
        if !is_varied {
            rest.clear();
            rest.extend(part.coordinates(self.at.q).iter().map(|&q| Dual6::fixed(q)));
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
    fn add(&mut self, along: SeedDirection, sign: f64, block: &CouplingBlock, first: usize, from: usize) {
        let values = if along == SeedDirection::Coordinates { &mut self.tangent.k } else { &mut self.tangent.c };
        let rows = values[block.first_entry..].chunks_exact_mut(block.width);
        for (row, f) in rows.zip(&self.varied.f) {
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
