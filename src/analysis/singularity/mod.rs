//! Singular states along a motion: where G loses rank, so that the motion could go on along several branches.

mod branch;
mod path;
mod survey;

use crate::error::{Failure, short_list};
use crate::simulate::{Observation, Outcome};
use crate::system::MechanicalSystem;
use crate::tolerances;
use branch::Turning;
use path::{Path, PathPoint};
use serde::Serialize;
use survey::Survey;

/// Distance of a motion from singular states, by the rank indicator: the smallest sine of the angle between a row of G
/// and those before it, in the metric of M^-1, without rows that depend on others everywhere.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Singularity {
    /// The state of the motion that was nearest to a singular one; `None` without constraints.
    #[doc(hidden)]
    pub nearest: Option<Nearest>,
    /// Number of singular or nearly singular states passed.
    pub count: usize,
    /// The first thousand of them, in order.
    #[doc(hidden)]
    pub passed: Vec<Passing>,
}

/// The state nearest to a singular one.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Nearest {
    /// Time, s.
    pub t: f64,
    /// Rank indicator: 1 far from a singular state, 0 at one.
    pub rank_indicator: f64,
    /// Condition number of the equilibrated saddle-point matrix there; `None` where it is infinite, or the system
    /// large.
    pub condition: Option<f64>,
}

/// A singular or nearly singular state that was passed.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Passing {
    /// Time, s.
    pub t: f64,
    /// The rank indicator there; at a singular state it is round-off and error of interpolation.
    pub rank_indicator: f64,
    /// True if it counts as singular, false if as nearly singular.
    pub is_singular: bool,
    /// Rank of G there; `None` for large systems.
    pub rank: Option<usize>,
    /// Rank of G at regular states nearby.
    pub regular_rank: usize,
    /// Joints with rows that depend, or nearly depend, on each other there; empty for large systems.
    pub joints: Vec<String>,
    /// Behaviour of the motion.
    pub branch: SingularityBranch,
}

/// Behaviour of a motion at a singular state.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum SingularityBranch {
    /// It went on smoothly.
    Kept,
    /// Its velocity jumped: errors turned it to another branch.
    Left,
    /// It came to rest there, or the run ended too early to decide.
    Open,
}

impl Singularity {
    /// Returns the first state at which the motion left its branch.
    #[doc(hidden)]
    pub fn left(&self) -> Option<&Passing> {
        self.passed.iter().find(|passing| passing.branch == SingularityBranch::Left)
    }

    /// Returns the failure of a run whose motion left its branch, so that the result is not the motion of the scene.
    pub fn failure(&self) -> Option<Failure> {
        let Passing { t, joints, .. } = self.left()?;
        let named = if joints.is_empty() { String::new() } else { format!(" of {}", short_list(joints)) };
        let reason = format!(
            "at this singular state, where constraints{named} depend on each other, the velocity jumped: errors turned the \
             motion from its branch, and what comes after is not the motion of the scene"
        );
        Some(Failure { t: *t, reason, hint: "choose a projection such as `manifold`, or a smaller step".to_string() })
    }

    /// Returns the failure of a run with this outcome: that of a motion that left its branch, unless the run ended at
    /// that state, for a reason of its own.
    #[doc(hidden)]
    pub fn failure_of(&self, outcome: &Outcome) -> Option<Failure> {
        let ended = outcome.failure.clone();
        let is_before = |left: &Failure| match &ended {
            // Left so soon before the end, it was left because of what ended the run.
            Some(Failure { t, .. }) => left.t < t - 1e-5 * t.abs(),
            None => true,
        };
        let left = self.failure().filter(is_before);
        left.or(ended)
    }
}

const MOST_PASSED: usize = 1000;

/// Detects singular states along a motion.
pub struct SingularityWatch<'a> {
    survey: Survey<'a>,
    /// Number of velocities that move q.
    moving: usize,
    /// The last three accepted states, the latest last.
    last: [PathPoint; 3],
    seen: usize,
    largest: f64,
    turning: Turning,
    found: Singularity,
}

impl<'a> SingularityWatch<'a> {
    /// A watch that has seen no state.
    pub fn new(system: &'a dyn MechanicalSystem) -> Self {
        SingularityWatch {
            survey: Survey::new(system),
            moving: system.dimensions().moving(),
            last: Default::default(),
            seen: 0,
            largest: 0.0,
            turning: Turning::default(),
            found: Singularity::default(),
        }
    }

    /// Adds an accepted state.
    pub fn add(&mut self, state: &Observation) {
        if state.phi.is_empty() {
            return;
        }
        self.survey.drop_rows(state.dropped);
        let rank_indicator = state.rank_indicator.unwrap_or_else(|| self.survey.rank_indicator(state.t, state.q));
        self.last.rotate_left(1);
        self.last[2].copy(state, rank_indicator, self.moving);
        self.seen += 1;
        self.largest = self.largest.max(rank_indicator);
        self.note(state.t, rank_indicator, state.q);
        if self.seen >= 3 && self.dips() {
            self.look_at_dip();
        }
        let judged = self.turning.add(&self.last, self.largest, &mut self.survey);
        self.settle(judged);
    }

    /// Records the behaviour of the motion at a singular state.
    fn settle(&mut self, judged: Option<(usize, SingularityBranch)>) {
        if let Some((passing, branch)) = judged
            && let Some(passed) = self.found.passed.get_mut(passing)
        {
            passed.branch = branch;
            self.drop_if_far(passing);
        }
    }

    /// Returns the result.
    pub fn finish(mut self) -> Singularity {
        // A run that ends just after a singular state does not reach the rise after it.
        if self.seen >= 3 && self.last[2].rank_indicator <= self.last[1].rank_indicator {
            self.look_at_dip();
        }
        let judged = self.turning.judge(&mut self.survey);
        self.settle(judged);
        self.drop_if_far(self.found.passed.len().wrapping_sub(1));
        if let Some(nearest) = &mut self.found.nearest {
            nearest.condition = self.survey.condition_at_nearest();
        }
        self.found
    }

    /// Removes a state that was examined only because drift might have changed the branch there.
    fn drop_if_far(&mut self, passing: usize) {
        let passed = &mut self.found.passed;
        if passed
            .get(passing)
            .is_some_and(|p| p.branch != SingularityBranch::Left && p.rank_indicator > tolerances::TOLD * self.largest)
        {
            passed.remove(passing);
            self.found.count -= 1;
        }
    }

    fn note(&mut self, t: f64, rank_indicator: f64, q: &[f64]) {
        if self.found.nearest.is_none_or(|nearest| rank_indicator < nearest.rank_indicator) {
            self.found.nearest = Some(Nearest { t, rank_indicator, condition: None });
            self.survey.keep_nearest(t, q);
        }
    }

    /// True if the rank indicator has a minimum near the middle state.
    fn dips(&self) -> bool {
        let [a, b, c] = &self.last;
        b.rank_indicator <= a.rank_indicator
            && b.rank_indicator < c.rank_indicator
            && b.rank_indicator < 0.8 * self.largest
    }

    fn look_at_dip(&mut self) {
        self.survey.refer_to(self.largest);
        let rates = self.last.each_ref().map(|sample| self.survey.rate(&sample.q, &sample.v));
        let path = Path::new(&self.last, &rates);
        let indicators = [self.last[0].rank_indicator, self.last[2].rank_indicator];
        let drift = self.survey.drift(&self.last[1]);
        let near = tolerances::TOLD * self.largest;
        let turned = branch::reach(drift[0], drift[1]).min(0.2 * self.largest);
        let Some((t, rank_indicator)) = self.survey.least_rank_indicator(&path, indicators, near.max(turned)) else {
            return;
        };
        let q = self.survey.position(&path, t);
        self.note(t, rank_indicator, &q);
        if rank_indicator > near.max(turned) {
            return;
        }
        let judged = self.turning.judge(&mut self.survey);
        self.settle(judged);
        let is_singular = rank_indicator < tolerances::UNSEEN * self.largest;
        let (lost, joints) = self.survey.dependence(t, &q, 10.0 * rank_indicator);
        self.turning.begin(
            self.found.passed.len(),
            t,
            &self.last[1],
            rank_indicator,
            is_singular || rank_indicator < turned,
        );
        let regular_rank = self.survey.regular_rank();
        let rank = if is_singular { lost } else { Some(regular_rank) };
        let passing =
            Passing { t, rank_indicator, is_singular, rank, regular_rank, joints, branch: SingularityBranch::Open };
        self.found.count += 1;
        if self.found.passed.len() < MOST_PASSED {
            self.found.passed.push(passing);
        }
    }
}
