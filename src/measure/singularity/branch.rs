//! Whether a motion goes on smoothly through a singular state.
//!
//! Branches of the motion cross at a singular state at angles of order one. Constraints with a drift d have no crossing
//! there, but curves like hyperbolas at a distance of sqrt(d), which turn from one branch into another within the time
//! that the motion takes for that distance. So velocities before and after, at a small multiple of the least distance,
//! differ by order one from what smooth accelerations make of them where the motion left its branch.

use super::Branch;
use super::path::Sample;
use super::survey::Survey;

/// States on the way to a singular one are kept each time the sine has halved since the last.
const HALVED: f64 = 0.5;
/// The way is followed below this part of the largest sine.
const ZONE: f64 = 0.3;
/// Velocities are compared at so many times the least sine.
const ASIDE: f64 = 6.0;
/// A change of the velocity, relative to its size, that no smooth motion makes; beside this part of the change of v' over
/// the time between, since the rule errs over long steps, but not by more than as much again.
const JUMP: f64 = 0.1;
const BEND: f64 = 0.5;
/// Drift of the positions, relative to the square of the sine, and of the velocities, relative to the sine, that can turn
/// a motion.
const TURNED: f64 = 0.01;

/// The sine below which drift of the positions and velocities, relative to their scales, can turn a motion.
pub fn reach([position, velocity]: [f64; 2]) -> f64 {
    (position / TURNED).sqrt().max(velocity / TURNED)
}

/// The way to a singular state, and from it.
#[derive(Default)]
pub struct Turning {
    before: Sample,
    way: Vec<Sample>,
    open: Option<Open>,
}

/// A singular state whose other side is not yet seen.
struct Open {
    passing: usize,
    from: Sample,
    sine: f64,
    may_turn: bool,
}

impl Turning {
    /// A singular or nearly singular state was passed at `t`. It is no wonder that a motion turns sharply where geometry
    /// makes it: only at a singular state, or where drift reaches, it `may_turn` from its branch.
    pub fn begin(&mut self, passing: usize, t: f64, sine: f64, may_turn: bool) {
        let aside = self.way.iter().rev().find(|sample| sample.t < t && sample.sine >= ASIDE * sine);
        let from = aside.or(self.way.first()).unwrap_or(&self.before).clone();
        self.open = Some(Open { passing, from, sine, may_turn });
        self.way.clear();
    }

    /// Takes an accepted state, and judges the singular state before it once it is far enough behind.
    pub fn add(&mut self, now: &Sample, largest: f64, survey: &mut Survey) -> Option<(usize, Branch)> {
        let falls = now.sine < self.before.sine;
        if now.sine > ZONE * largest {
            self.way.clear();
        } else if falls {
            if self.way.is_empty() {
                self.way.push(self.before.clone());
            }
            if self.way.last().is_none_or(|last| now.sine < HALVED * last.sine) {
                self.way.push(now.clone());
            }
        }
        self.before.clone_from(now);
        let is_aside = |open: &Open| now.t > open.from.t && now.sine >= (ASIDE * open.sine).min(0.5 * open.from.sine);
        let open = self.open.take_if(|open| is_aside(open))?;
        Some((open.passing, open.judge(now, survey)))
    }
}

impl Open {
    /// v - v_0 against the integral of v' by the trapezoidal rule, in the metric of M.
    fn judge(&self, now: &Sample, survey: &mut Survey) -> Branch {
        let from = &self.from;
        let half = 0.5 * (now.t - from.t);
        let rest = |i: usize| now.v[i] - from.v[i] - half * (now.vdot[i] + from.vdot[i]);
        let bend = |i: usize| 2.0 * half * (now.vdot[i] - from.vdot[i]);
        let all = 0..now.v.len();
        let (jump, bend): (Vec<f64>, Vec<f64>) = (all.clone().map(rest).collect(), all.map(bend).collect());
        survey.weigh(now.t, &now.q);
        let size = survey.size(&now.v).max(survey.size(&from.v));
        let smooth = JUMP * size + (BEND * survey.size(&bend)).min(JUMP * size);
        match survey.size(&jump) {
            _ if size <= 0.0 => Branch::Open,
            jump if (jump > smooth || jump.is_nan()) && self.may_turn => Branch::Left,
            _ => Branch::Kept,
        }
    }
}
