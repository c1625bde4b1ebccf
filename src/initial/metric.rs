//! The mass metric with the constraints of a system, for Newton's method on phi.

use super::report::LevelResiduals;
use crate::error::{Error, Result, short};
use crate::math::kkt::{Pattern, SaddlePoint};
use crate::math::{largest, largest_in};
use crate::scene::INITIAL;
use crate::system::{MechanicalSystem, Need, Scratch, Structure, Terms};
use crate::tolerances;
use std::sync::Arc;

/// phi that no step of Newton's method improves. Unit: `[1]` of the largest coordinate. Why: two ulps, of a sum of two
/// products. Test: `a_start_beside_a_fold_stays`.
const ROUNDED: f64 = 2.0 * f64::EPSILON;

/// The largest phi of a closed loop after assembly, beside round-off of the largest coordinate. Unit: `[1]` of the
/// scene's scale. Why: round-off of chains of transformations, up to thousands of them.
const CLOSED: f64 = 1e-10;

/// The mass metric with the constraints and the held directions as rows.
pub struct Metric<'a> {
    pub system: &'a dyn MechanicalSystem,
    pub terms: Terms,
    pub scratch: Scratch,
    pub kkt: SaddlePoint,
    pub mass: Arc<Pattern>,
    pub rows: Arc<Pattern>,
    pub weights: Vec<f64>,
    pub values: Vec<f64>,
    pub scales: Vec<f64>,
    /// Those of [`SystemFacts::stiffness`](crate::system::SystemFacts::stiffness).
    stiffness: Vec<(usize, f64)>,
    pub held: Vec<usize>,
    /// phi of a state on the way, which counts as closed; none: zero.
    pub ahead: Vec<f64>,
    /// Rows that are dropped.
    pub without: Vec<usize>,
    pub still: Vec<f64>,
    /// Memory of Newton's method: d, and q before a step.
    pub newton: (Vec<f64>, Vec<f64>),
    /// Memory of single steps.
    room: Room,
    /// True if the joints closed from beside the guess.
    pub is_beside: bool,
}

/// Memory of a step: its right-hand sides, q', and the turns of bodies.
#[derive(Default)]
struct Room {
    bottom: Vec<f64>,
    rows: Vec<f64>,
    rate: Vec<f64>,
    turns: Vec<f64>,
}

impl<'a> Metric<'a> {
    pub fn new(system: &'a dyn MechanicalSystem, held: Vec<usize>) -> Self {
        let Structure { mass, g: mut rows, mut analysis, .. } = system.structure();
        if !held.is_empty() {
            let all = Arc::make_mut(&mut rows);
            all.entries.extend(held.iter().enumerate().map(|(i, &direction)| (all.rows + i, direction)));
            all.rows += held.len();
            analysis = Arc::default();
        }
        let facts = system.facts().into_owned();
        Metric {
            terms: Terms::new(system),
            scratch: Scratch::default(),
            kkt: SaddlePoint::sharing(&mass, &rows, &analysis),
            weights: vec![0.0; mass.entries.len()],
            still: vec![0.0; mass.rows],
            newton: Default::default(),
            values: vec![1.0; rows.entries.len()],
            mass,
            rows,
            scales: facts.scales,
            stiffness: facts.stiffness,
            held,
            ahead: Vec::new(),
            without: Vec::new(),
            is_beside: false,
            room: Room { turns: vec![0.0; facts.turning_bodies.len()], ..Room::default() },
            system,
        }
    }

    pub fn evaluate(&mut self, t: f64, q: &[f64], v: &[f64], need: Need) {
        self.system.evaluate(t, q, v, need, &mut self.terms, &mut self.scratch);
        self.terms.phi.iter_mut().zip(&self.ahead).for_each(|(phi, ahead)| *phi -= ahead);
    }

    /// Drops these rows, and no others, from now on.
    pub fn drop_rows(&mut self, rows: &[usize]) {
        self.without = rows.to_vec();
        self.kkt.drop_rows(rows);
    }

    /// Evaluates the terms and factors the matrix at a state.
    pub fn at(&mut self, t: f64, q: &[f64], v: &[f64]) -> Result<()> {
        let need = Need::MASS | Need::CONSTRAINTS | Need::G;
        self.evaluate(t, q, v, need);
        if let Some(row) = self.infinite_row() {
            let group = self.system.facts().groups().into_iter().find(|group| group.rows.contains(&row));
            let name = group.map_or(String::new(), |group| group.name);
            return Err(Error::input(format!("at the start, joint `{name}` or its rate is infinite or not a number"))
                .under("joints")
                .hint("begin where its expressions are defined and smooth (no division by zero, `floor` and `mod` up to 2^29), and no distance is zero"));
        }
        let most = largest(&self.terms.mass);
        let unit = if most > 0.0 { most } else { 1.0 };
        self.weights.copy_from_slice(&self.terms.mass);
        self.stiffness.iter().for_each(|&(place, stiffness)| self.weights[place] += stiffness);
        for (weight, (i, j)) in self.weights.iter_mut().zip(&self.mass.entries) {
            *weight = if i == j { (*weight / unit).max(tolerances::SIX_DIGITS) } else { *weight / unit };
        }
        let n = self.terms.g.len();
        self.values[..n].copy_from_slice(&self.terms.g);
        let factored = self.kkt.factor(&self.weights, &self.values);
        factored.map_err(|singular| Error::input(format!("at the start, {singular}")))
    }

    /// The first constraint that is not finite, or whose rate or gradient is not.
    fn infinite_row(&self) -> Option<usize> {
        let Terms { phi, phi_dot, g, .. } = &self.terms;
        // At the branch point of a root a derivative is huge, not infinite.
        let position = |values: &[f64]| values.iter().position(|x| x.is_nan() || x.abs() >= 1e150);
        position(phi).or_else(|| position(phi_dot)).or_else(|| Some(self.rows.entries[position(g)?].0))
    }

    /// Solves [W G^T; G 0] [d; .] = [top; bottom], with d = 0 along the held directions, and writes d to `top`.
    pub fn solve(&mut self, top: &mut [f64], bottom: &[f64]) -> Result<()> {
        let rows = &mut self.room.rows;
        rows.clear();
        rows.extend_from_slice(bottom);
        rows.resize(self.rows.rows, 0.0);
        self.kkt.solve_motion(top, rows).map_err(|singular| Error::input(format!("at the start, {singular}")))
    }

    /// Writes d of [W G^T; G 0] [d; .] = [-W moved; -phi]: Newton's step, and the way back towards the guess within the
    /// tangent space if `moved` is given.
    pub fn step(&mut self, moved: Option<&[f64]>, d: &mut [f64]) -> Result<()> {
        d.fill(0.0);
        if let Some(moved) = moved {
            self.mass.multiply_symmetric(&self.weights, moved, d);
            d.iter_mut().for_each(|d| *d = -*d);
        }
        let mut bottom = std::mem::take(&mut self.room.bottom);
        bottom.clear();
        bottom.extend(self.terms.phi.iter().map(|phi| -phi));
        self.without.iter().for_each(|row| bottom[*row] = 0.0);
        let solved = self.solve(d, &bottom);
        self.room.bottom = bottom;
        solved
    }

    /// W x
    pub fn weigh(&self, x: &[f64]) -> Vec<f64> {
        let mut product = vec![0.0; x.len()];
        self.mass.multiply_symmetric(&self.weights, x, &mut product);
        product
    }

    /// Residuals at a state, in units of the scene's scale.
    pub fn level(&mut self, t: f64, q: &[f64], v: &[f64]) -> LevelResiduals {
        self.evaluate(t, q, v, Need::CONSTRAINTS);
        LevelResiduals { phi: self.worst(&self.terms.phi), phi_dot: self.worst(&self.terms.phi_dot) }
    }

    /// Evaluates the terms and factors the matrix at q, without velocities.
    pub fn at_rest(&mut self, t: f64, q: &[f64]) -> Result<()> {
        let still = std::mem::take(&mut self.still);
        let factored = self.at(t, q, &still);
        self.still = still;
        factored
    }

    /// Evaluates the constraints at q; returns |phi| in units of the scene's scale.
    pub fn residual(&mut self, t: f64, q: &[f64]) -> f64 {
        let still = std::mem::take(&mut self.still);
        self.evaluate(t, q, &still, Need::CONSTRAINTS);
        self.still = still;
        self.size_of_phi()
    }

    /// |phi| of the terms at hand, in units of the scene's scale; NaN where a row is not a number.
    pub fn size_of_phi(&self) -> f64 {
        let kept = (0..self.scales.len()).filter(|row| !self.without.contains(row));
        kept.map(|row| (self.terms.phi[row] / self.scales[row]).powi(2)).sum::<f64>().sqrt()
    }

    /// |phi| of some rows, as [`size_of_phi`](Self::size_of_phi).
    pub fn size_of(&self, rows: &[usize]) -> f64 {
        rows.iter().map(|row| (self.terms.phi[*row] / self.scales[*row]).powi(2)).sum::<f64>().sqrt()
    }

    /// The sum of rows of G times these weights.
    pub fn rows_times(&self, rows: &[usize], weights: &[f64]) -> Vec<f64> {
        let mut sum = vec![0.0; self.still.len()];
        for ((row, column), value) in self.rows.entries.iter().zip(&self.values) {
            if let Some(place) = rows.iter().position(|wanted| wanted == row) {
                sum[*column] += weights[place] * value;
            }
        }
        sum
    }

    /// max |d_j| over the directions j that some rows depend on.
    pub fn largest_along(&self, rows: &[usize], d: &[f64]) -> f64 {
        let entries = self.rows.entries.iter().filter(|(row, _)| rows.contains(row));
        entries.filter_map(|(_, column)| d.get(*column)).fold(0.0, |most, d| most.max(d.abs()))
    }

    /// |G_r d|^2 of rows r, in units of the scene's scale.
    pub fn squared_rates(&self, rows: &[usize], d: &[f64]) -> f64 {
        let mut rates = vec![0.0; rows.len()];
        for ((row, column), value) in self.rows.entries.iter().zip(&self.values) {
            if let Some(place) = rows.iter().position(|wanted| wanted == row) {
                rates[place] += value * d[*column] / self.scales[*row];
            }
        }
        rates.iter().map(|rate| rate * rate).sum()
    }

    /// True if the terms at hand, those at q, are closed: up to a part of the scene's lengths and the round-off of its
    /// largest coordinate.
    pub fn is_closed(&self, q: &[f64]) -> bool {
        let rounding = tolerances::ROUND_OFF * largest(self.system.dimensions().without_turns(q));
        let mut kept = (0..self.scales.len()).filter(|row| !self.without.contains(row));
        kept.all(|row| self.terms.phi[row].abs() <= CLOSED * self.scales[row] + rounding)
    }

    /// True if phi of the terms at hand is what its evaluation rounds. A step would move q by that over the rank indicator:
    /// beside a fold farther than the state is from it, where its coordinates are exact as they are.
    pub fn is_rounding(&self, q: &[f64]) -> bool {
        let rounding = ROUNDED * largest(self.system.dimensions().without_turns(q));
        let mut kept = (0..self.scales.len()).filter(|row| !self.without.contains(row));
        kept.all(|row| self.terms.phi[row].abs() <= rounding)
    }

    /// q = start + factor N d
    pub fn go(&mut self, start: &[f64], d: &[f64], factor: f64, q: &mut [f64]) {
        let rate = &mut self.room.rate;
        rate.resize(q.len(), 0.0);
        self.system.rate(start, d, rate);
        q.iter_mut().zip(start).zip(&*rate).for_each(|((q, start), rate)| *q = start + factor * rate);
        self.system.normalize(q);
    }

    /// The largest rotation of a body along a step, rad.
    pub fn largest_turn(&mut self, q: &[f64], d: &[f64]) -> f64 {
        self.system.spins(q, d, &mut self.room.turns);
        largest(&self.room.turns)
    }

    /// d^T W d
    pub fn distance(&self, d: &[f64]) -> f64 {
        d.iter().zip(self.weigh(d)).map(|(d, weighed)| d * weighed).sum()
    }

    /// W_ii
    pub fn inertia(&self, direction: usize) -> f64 {
        let entries = self.mass.entries.iter().zip(&self.weights);
        entries.filter(|(place, _)| **place == (direction, direction)).map(|(_, weight)| *weight).sum()
    }

    pub fn worst(&self, rows: &[f64]) -> f64 {
        largest_in(&self.scales, rows)
    }

    /// True if some rows give joint coordinates their values at the start.
    pub fn has_initial(&self) -> bool {
        self.system.facts().groups().iter().any(|group| group.kind == INITIAL)
    }

    /// The joints with the largest residuals, for a message.
    pub fn culprits(&self, rows: &[f64]) -> String {
        let worst = self.worst(rows);
        let mut gaps: Vec<(String, f64)> = Vec::new();
        for group in self.system.facts().groups() {
            let gap = group.rows.clone().fold(0.0f64, |gap, row| gap.max((rows[row] / self.scales[row]).abs()));
            if gap > 0.01 * worst {
                gaps.push((group.name, group.rows.map(|row| rows[row].abs()).fold(0.0, f64::max)));
            }
        }
        gaps.sort_by(|a, b| b.1.total_cmp(&a.1));
        let more = gaps.len().saturating_sub(5);
        let shown: Vec<String> = gaps.iter().take(5).map(|(name, gap)| format!("`{name}` {}", short(*gap))).collect();
        let tail = if more > 0 { format!(" and {more} more") } else { String::new() };
        format!("{}{tail}", shown.join(", "))
    }
}
