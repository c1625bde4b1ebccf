//! Equations of motion in axes that rotate with the mechanism.

use super::spin::{Placement, Spin, SpinBlock};
use super::{
    Dimensions, Energy, LeviCivita, MechanicalSystem, Need, OperatingPoint, OutputTangent, Scratch, Structure,
    SwitchFacts, SystemFacts, Tangent, Terms,
};
use crate::forward::forward;
use crate::math::Rate;
use crate::math::array::from_fn;
use crate::math::kkt::Pattern;
use nalgebra::DMatrix;
use std::borrow::Cow;
use std::collections::BTreeMap;
use std::sync::Arc;

/// The equations of a system in axes that rotate at a constant speed, at an instant at which these coincide with the
/// world's: an equilibrium in them is a steady rotation. With v and v' measured in the axes,
///
/// ```text
/// M v' + G^T lambda = f(t, q, v + W xi) - M b(q, v),   phi(q, t) = 0,   q' = N(q) v,   t fixed
/// ```
///
/// These are the equations of the motion at all times if they are invariant under the rotation: if joints to the
/// ground, forces and gravity are symmetric about the axis. Components in the world are at each instant those in the
/// axes.
#[derive(Clone)]
pub struct Rotating<'a> {
    inner: &'a dyn MechanicalSystem,
    t: f64,
    /// The rotation of the axes.
    pub spin: Spin,
    placements: Vec<Placement>,
    facts: SystemFacts,
    structure: Structure,
    /// Pattern of K and C of the inner system, and places in our own by row and column.
    inner_tangent: Arc<Pattern>,
    places: EntryPlaces,
    /// EntryPlaces in the pattern of G, by row and column.
    g_places: EntryPlaces,
}

/// EntryPlaces of entries by row and column.
type EntryPlaces = BTreeMap<(usize, usize), usize>;

/// Derivatives of the motion of the axes with respect to q and v.
struct AxesSlopes {
    /// d(W xi)/dq, d(b)/dq and d(b)/dv, sorted by the first velocity of their block.
    blocks: Vec<[SpinBlock; 3]>,
}

impl<'a> Rotating<'a> {
    /// The system at fixed t in axes that rotate by `spin`. `None` where a body has coordinates along fixed directions
    /// of the world, so that it cannot rotate.
    pub fn new(inner: &'a dyn MechanicalSystem, t: f64, spin: Spin) -> Option<Self> {
        let mut facts = inner.facts().into_owned();
        let placements = facts.placements.take()?;
        facts.axes = Some(spin);
        facts.works.clear();
        let mut structure = inner.structure();
        let inner_tangent = structure.tangent.clone();
        let mut places = placed(&inner_tangent);
        let mut entries = inner_tangent.entries.clone();
        let both = structure.mass.entries.iter().flat_map(|&(i, j)| [(i, j), (j, i)]);
        for (i, j) in both.chain(inner_tangent.entries.iter().copied()) {
            let Some((first, size)) = block_of(&placements, j) else { continue };
            for column in first..first + size {
                places.entry((i, column)).or_insert_with(|| {
                    entries.push((i, column));
                    entries.len() - 1
                });
            }
        }
        structure.tangent = Arc::new(Pattern { entries, ..*structure.tangent });
        let g_places = placed(&structure.g);
        Some(Rotating { inner, t, spin, placements, facts, structure, inner_tangent, places, g_places })
    }

    /// The same system after a rotation by `angle` about the axis, at the time at which that is reached.
    pub fn turned(&self, angle: f64) -> Self {
        Rotating { t: self.t + angle / self.spin.speed(), ..self.clone() }
    }

    /// Rotates q by `angle` about the axis.
    pub fn turn(&self, angle: f64, q: &mut [f64]) {
        self.placements.iter().for_each(|placement| self.spin.turn(*placement, angle, q));
        self.inner.normalize(q);
    }

    /// Rotates a change along the velocity directions by `angle` about the axis.
    pub fn turn_directions(&self, angle: f64, x: &mut [f64]) {
        self.placements.iter().for_each(|placement| self.spin.turn_directions(*placement, angle, x));
    }

    /// v + W xi(q)
    fn velocity(&self, q: &[f64], v: &[f64]) -> Vec<f64> {
        self.added(v, |placement| self.spin.carried(placement, q))
    }

    /// v' + b(q, v)
    fn acceleration(&self, q: &[f64], v: &[f64], vdot: &[f64]) -> Vec<f64> {
        self.added(vdot, |placement| self.spin.acceleration(placement, q, v))
    }

    /// What `ask` gives for the inner system at its t, v and v'.
    fn at<T>(&self, at: OperatingPoint, ask: impl FnOnce(OperatingPoint) -> T) -> T {
        let v = self.velocity(at.q, at.v);
        let vdot = self.acceleration(at.q, at.v, at.vdot);
        ask(OperatingPoint { t: self.t, v: &v, vdot: &vdot, ..at })
    }

    fn added(&self, to: &[f64], what: impl Fn(Placement) -> [f64; 3]) -> Vec<f64> {
        let mut sum = to.to_vec();
        for &placement in &self.placements {
            let ((first, count), more) = (Spin::velocities(placement), what(placement));
            sum[first..first + count].iter_mut().zip(more).for_each(|(sum, x)| *sum += x);
        }
        sum
    }

    fn slopes(&self, q: &[f64], v: &[f64]) -> AxesSlopes {
        AxesSlopes { blocks: self.placements.iter().map(|&placement| self.spin.slopes(placement, q, v)).collect() }
    }

    /// Terms of the inner system at a state; v is measured in the world.
    fn terms(&self, q: &[f64], v: &[f64], need: Need, scratch: &mut Scratch) -> Terms {
        let mut terms = Terms::new(self.inner);
        self.inner.evaluate(self.t, q, v, need, &mut terms, scratch);
        terms
    }

    /// target += A X with the values of A at `pattern`, X number `which` of the slopes, target in the pattern of K and
    /// C.
    fn add_product(&self, pattern: &Pattern, values: &[f64], slopes: &AxesSlopes, which: usize, target: &mut [f64]) {
        for (&(i, j), value) in pattern.entries.iter().zip(values) {
            slopes.each(which, j, |column, x| target[self.places[&(i, column)]] += value * x);
        }
    }

    /// target += M X, with M given by its lower triangle.
    fn add_mass_product(&self, mass: &[f64], slopes: &AxesSlopes, which: usize, target: &mut [f64]) {
        for (&(i, j), value) in self.structure.mass.entries.iter().zip(mass) {
            slopes.each(which, j, |column, x| target[self.places[&(i, column)]] += value * x);
            if i != j {
                slopes.each(which, i, |column, x| target[self.places[&(j, column)]] += value * x);
            }
        }
    }

    /// target += factor A X at the places of G, for A with the pattern of G.
    fn add_gradient(&self, values: &[f64], slopes: &AxesSlopes, which: usize, factor: f64, target: &mut [f64]) {
        for (&(i, j), value) in self.structure.g.entries.iter().zip(values) {
            slopes.each(which, j, |column, x| {
                if let Some(&place) = self.g_places.get(&(i, column)) {
                    target[place] += factor * value * x;
                }
            });
        }
    }
}

impl AxesSlopes {
    /// Calls `see` with column and value of each entry of row `row`.
    fn each(&self, which: usize, row: usize, mut see: impl FnMut(usize, f64)) {
        let own = |blocks: &&[SpinBlock; 3]| (blocks[0].first..blocks[0].first + blocks[0].size).contains(&row);
        let place = self.blocks.partition_point(|blocks| blocks[0].first <= row);
        if let Some(blocks) = self.blocks[..place].last().filter(own) {
            let block = &blocks[which];
            (0..block.size).for_each(|k| see(block.first + k, block.rows[row - block.first][k]));
        }
    }
}

fn placed(pattern: &Pattern) -> EntryPlaces {
    pattern.entries.iter().enumerate().map(|(k, &entry)| (entry, k)).collect()
}

/// First velocity and size of the block that velocity `j` belongs to.
fn block_of(placements: &[Placement], j: usize) -> Option<(usize, usize)> {
    let place = placements.partition_point(|placement| Spin::velocities(*placement).0 <= j);
    let block = Spin::velocities(*placements[..place].last()?);
    (j < block.0 + block.1).then_some(block)
}

impl MechanicalSystem for Rotating<'_> {
    forward! { .inner =>
        fn dimensions(&self) -> Dimensions;
        fn bracket(&self, v: &[f64], x: &[f64], out: &mut [f64]);
        fn levi_civita(&self, at: OperatingPoint, connection: &mut LeviCivita, scratch: &mut Scratch) -> bool;
        fn rate(&self, q: &[f64], v: &[f64], qdot: &mut [f64]);
        fn spins(&self, q: &[f64], v: &[f64], out: &mut [f64]);
        fn normalize(&self, q: &mut [f64]);
        fn write_gaps(&self, q: &[f64], out: &mut [[f64; 3]]);
        fn deformations(&self, q: &[f64], out: &mut [f64]);
    }

    fn structure(&self) -> Structure {
        self.structure.clone()
    }

    fn facts(&self) -> Cow<'_, SystemFacts> {
        Cow::Borrowed(&self.facts)
    }

    fn switches(&self) -> SwitchFacts<'_> {
        SwitchFacts { time_functions: &[], ..self.inner.switches() }
    }

    fn evaluate(&self, _t: f64, q: &[f64], v: &[f64], need: Need, terms: &mut Terms, scratch: &mut Scratch) {
        let all = if need.includes(Need::FORCE) { need | Need::MASS } else { need };
        let all = if all.includes(Need::CONSTRAINTS) || all.includes(Need::L) { all | Need::G } else { all };
        self.inner.evaluate(self.t, q, &self.velocity(q, v), all, terms, scratch);
        let carried = self.acceleration(q, v, &vec![0.0; v.len()]);
        if need.includes(Need::FORCE) {
            let mut inertia = vec![0.0; v.len()];
            self.structure.mass.multiply_symmetric(&terms.mass, &carried, &mut inertia);
            terms.f.iter_mut().zip(inertia).for_each(|(f, inertia)| *f -= inertia);
        }
        if need.includes(Need::CONSTRAINTS) {
            let mut moved = vec![0.0; terms.gamma.len()];
            self.structure.g.multiply(&terms.g, &carried, &mut moved);
            terms.gamma.iter_mut().zip(moved).for_each(|(gamma, moved)| *gamma -= moved);
            terms.phi_t.fill(0.0);
        }
        if need.includes(Need::L) {
            let Terms { g, l, .. } = terms;
            self.add_gradient(g, &self.slopes(q, v), 0, 1.0, l);
        }
    }

    fn tangent(&self, at: OperatingPoint, tangent: &mut Tangent, scratch: &mut Scratch) -> bool {
        let v = self.velocity(at.q, at.v);
        let vdot = self.acceleration(at.q, at.v, at.vdot);
        let mut inner = Tangent::new(&self.inner_tangent);
        if !self.inner.tangent(OperatingPoint { t: self.t, v: &v, vdot: &vdot, ..at }, &mut inner, scratch) {
            return false;
        }
        let count = inner.k.len();
        for (values, own) in [(&mut tangent.k, &inner.k), (&mut tangent.c, &inner.c)] {
            values.fill(0.0);
            values[..count].copy_from_slice(own);
        }
        let slopes = self.slopes(at.q, at.v);
        let terms = self.terms(at.q, &v, Need::MASS, scratch);
        self.add_product(&self.inner_tangent, &inner.c, &slopes, 0, &mut tangent.k);
        self.add_mass_product(&terms.mass, &slopes, 1, &mut tangent.k);
        self.add_mass_product(&terms.mass, &slopes, 2, &mut tangent.c);
        true
    }

    fn acceleration_gradient(&self, at: OperatingPoint, values: &mut [f64], scratch: &mut Scratch) -> bool {
        let v = self.velocity(at.q, at.v);
        let vdot = self.acceleration(at.q, at.v, at.vdot);
        if !self.inner.acceleration_gradient(OperatingPoint { t: self.t, v: &v, vdot: &vdot, ..at }, values, scratch) {
            return false;
        }
        // d(phi'')/dv = 2 L + G [v, .]
        let slopes = self.slopes(at.q, at.v);
        let terms = self.terms(at.q, &v, Need::G | Need::L, scratch);
        self.add_gradient(&terms.l, &slopes, 0, 2.0, values);
        let mut bracket = vec![0.0; terms.g.len()];
        self.add_bracket(&terms.g, &v, &mut bracket);
        self.add_gradient(&bracket, &slopes, 0, 1.0, values);
        self.add_gradient(&terms.g, &slopes, 1, 1.0, values);
        true
    }

    fn energy(&self, _t: f64, q: &[f64], v: &[f64], scratch: &mut Scratch) -> Option<Energy> {
        self.inner.energy(self.t, q, &self.velocity(q, v), scratch)
    }

    fn outputs(&self, at: OperatingPoint, out: &mut [f64], scratch: &mut Scratch) {
        self.at(at, |at| self.inner.outputs(at, out, scratch));
    }

    fn output_tangent(&self, at: OperatingPoint, tangent: &mut OutputTangent, scratch: &mut Scratch) -> bool {
        if !self.at(at, |at| self.inner.output_tangent(at, tangent, scratch)) {
            return false;
        }
        let slopes = self.slopes(at.q, at.v);
        for row in 0..tangent.v.nrows() {
            for j in 0..tangent.v.ncols() {
                let [value, push] = [tangent.v[(row, j)], tangent.vdot[(row, j)]];
                slopes.each(0, j, |column, x| tangent.q[(row, column)] += value * x);
                slopes.each(1, j, |column, x| tangent.q[(row, column)] += push * x);
                slopes.each(2, j, |column, x| tangent.v[(row, column)] += push * x);
            }
        }
        true
    }

    fn input_forces(&self, _t: f64, q: &[f64], v: &[f64], f: &mut DMatrix<f64>, scratch: &mut Scratch) {
        self.inner.input_forces(self.t, q, &self.velocity(q, v), f, scratch);
    }

    fn input_rate_forces(&self, _t: f64, q: &[f64], v: &[f64], f: &mut DMatrix<f64>, scratch: &mut Scratch) {
        self.inner.input_rate_forces(self.t, q, &self.velocity(q, v), f, scratch);
    }

    fn input_values(&self, at: OperatingPoint, out: &mut [f64], scratch: &mut Scratch) {
        let v = self.velocity(at.q, at.v);
        self.inner.input_values(OperatingPoint { t: self.t, v: &v, ..at }, out, scratch);
    }

    fn switching(&self, at: OperatingPoint, out: &mut [Rate], scratch: &mut Scratch) {
        self.at(at, |at| self.inner.switching(at, out, scratch));
    }
}

impl Rotating<'_> {
    /// values += G [v, .] at the places of G.
    fn add_bracket(&self, g: &[f64], v: &[f64], values: &mut [f64]) {
        let blocks = self.placements.iter().map(|&placement| {
            let (first, size) = Spin::velocities(placement);
            let own: [f64; 3] = from_fn(|k| if size == 3 { v[first + k] } else { 0.0 });
            let is_turn = matches!(placement, Placement::Axes { .. });
            let rows = if is_turn { super::spin::skew(&own) } else { [[0.0; 3]; 3] };
            [SpinBlock { first, size, rows }; 3]
        });
        self.add_gradient(g, &AxesSlopes { blocks: blocks.collect() }, 0, 1.0, values);
    }
}
