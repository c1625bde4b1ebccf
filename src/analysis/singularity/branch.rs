//! Test if a motion passes a singular state smoothly.
//!
//! Branches of the motion cross at a singular state at angles of order one. With a constraint drift d they do not cross
//! but form curves like hyperbolas at a distance of sqrt(d), which lead from one branch to another within the time that
//! the motion takes for that distance. So if the motion left its branch, the velocities before and after, at a small
//! multiple of the least distance, differ by order one from the integral of smooth accelerations.

use super::SingularityBranch;
use super::path::PathPoint;
use super::survey::Survey;
use crate::math::array::Each;
use crate::tolerances;

/// Velocities are compared at so many times the least rank indicator. Unit: `[1]`.
const WAY_COMPARED: f64 = 6.0;

/// Drift that can turn a motion at a singular state: of the positions relative to the square of the rank indicator, of
/// the velocities relative to it. Unit: `[1]`.
const DRIFT_TURNS: f64 = 0.01;

/// Returns the rank indicator below which drift of the positions and velocities, relative to their scales, can change
/// the branch of a motion.
pub fn reach(position: f64, velocity: f64) -> f64 {
    (position / DRIFT_TURNS).sqrt().max(velocity / DRIFT_TURNS)
}

/// States before and after a singular state.
#[derive(Default)]
pub struct Turning {
    way: Vec<PathPoint>,
    open: Option<Open>,
}

/// A singular state passed, for which states after it are still to come.
struct Open {
    passing: usize,
    /// One or two states before it, and up to two after it.
    before: Vec<PathPoint>,
    after: Vec<PathPoint>,
    rank_indicator: f64,
    may_turn: bool,
}

impl Turning {
    /// Begins with a singular or nearly singular state passed at `t`. A sharp change of velocity can be due to
    /// geometry: the motion may leave its branch (`may_turn`) only at a singular state, or within reach of the drift.
    pub fn begin(&mut self, passing: usize, t: f64, last: &PathPoint, rank_indicator: f64, may_turn: bool) {
        let aside = self
            .way
            .iter()
            .rposition(|sample| sample.t < t && sample.rank_indicator >= WAY_COMPARED * rank_indicator)
            .unwrap_or(0);
        let before = match self.way.get(..=aside) {
            Some(way) => way[aside.saturating_sub(1)..].to_vec(),
            None => vec![last.clone()],
        };
        self.open = Some(Open { passing, before, after: Vec::new(), rank_indicator, may_turn });
        self.way.clear();
    }

    /// Adds an accepted state, given with the two before it, and judges the singular state before it once it is far
    /// enough behind.
    pub fn add(
        &mut self,
        states: &[PathPoint; 3],
        largest: f64,
        survey: &mut Survey,
    ) -> Option<(usize, SingularityBranch)> {
        let [before @ .., now] = states;
        let falls = now.rank_indicator < before[1].rank_indicator;
        if now.rank_indicator > tolerances::PLACED_STEPS * largest {
            self.way.clear();
        } else if falls {
            if self.way.is_empty() {
                self.way.extend(before.iter().filter(|sample| !sample.q.is_empty()).cloned());
            }
            if self.way.last().is_none_or(|last| now.rank_indicator < 0.5 * last.rank_indicator) {
                self.way.push(now.clone());
            }
        }
        if self.open.as_mut().is_some_and(|open| open.is_seen(now)) { self.judge(survey) } else { None }
    }

    /// Judges the last singular state by the states after it, if there are any.
    pub fn judge(&mut self, survey: &mut Survey) -> Option<(usize, SingularityBranch)> {
        let open = self.open.take_if(|open| !open.after.is_empty())?;
        Some((open.passing, open.judge(survey)))
    }
}

impl Open {
    /// Adds a state after the singular one; returns true if there are enough.
    fn is_seen(&mut self, now: &PathPoint) -> bool {
        let Some(from) = self.before.last() else { return false };
        let is_next = match self.after.first() {
            None => {
                now.t > from.t
                    && now.rank_indicator >= (WAY_COMPARED * self.rank_indicator).min(0.5 * from.rank_indicator)
            }
            Some(first) => now.t - first.t >= 0.25 * (first.t - from.t),
        };
        if is_next {
            self.after.push(now.clone());
        }
        self.after.len() == 2
    }

    /// Compares v_1 - v_0 with the integral of v', in the metric of M, by the polynomial through v' at up to four
    /// states.
    fn judge(&self, survey: &mut Survey) -> SingularityBranch {
        let (Some(from), Some(to)) = (self.before.last(), self.after.first()) else { return SingularityBranch::Open };
        let nodes: Vec<&PathPoint> = self.before.iter().chain(&self.after).collect();
        let change = integral(&nodes, from.t, to.t);
        let lower = integral(&[from, to], from.t, to.t);
        let jump: Vec<f64> = (0..to.v.len()).map(|i| to.v[i] - from.v[i] - change[i]).collect();
        let doubt: Vec<f64> = change.iter().zip(&lower).map(|(change, lower)| change - lower).collect();
        let [after, before, doubt, jump] = survey.sizes(to.t, &to.q, [&to.v, &from.v, &doubt, &jump]);
        let size = after.max(before);
        // No smooth motion changes its velocity by a tenth, and a half is a jump whatever the rules err by: over long
        // steps both do.
        let smooth = 0.1 * size + (3.0 * doubt).min(0.5 * size);
        match jump {
            _ if size <= 0.0 => SingularityBranch::Open,
            jump if (jump > smooth || jump.is_nan()) && self.may_turn => SingularityBranch::Left,
            _ => SingularityBranch::Kept,
        }
    }
}

/// Returns the integral from a to b of the polynomial through v' at up to four `nodes`, by Gauss's rule of two points,
/// which is exact for it.
fn integral(nodes: &[&PathPoint], a: f64, b: f64) -> Vec<f64> {
    let middle = 0.5 * (a + b);
    let half = 0.5 * (b - a);
    let points = [-1.0, 1.0].each(|sign| middle + sign * half / 3f64.sqrt());
    let lagrange = |k: usize, t: f64| -> f64 {
        let others = nodes.iter().enumerate().filter(|(i, _)| *i != k);
        others.map(|(_, other)| (t - other.t) / (nodes[k].t - other.t)).product()
    };
    let mut sum = vec![0.0; nodes.first().map_or(0, |node| node.vdot.len())];
    for (k, node) in nodes.iter().enumerate() {
        let weight = half * points.iter().map(|t| lagrange(k, *t)).sum::<f64>();
        sum.iter_mut().zip(&node.vdot).for_each(|(sum, vdot)| *sum += weight * vdot);
    }
    sum
}
