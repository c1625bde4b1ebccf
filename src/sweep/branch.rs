//! A branch of assembled states, followed step by step.

use super::{BranchLimit, Family, Nearest, Point, Range};
use crate::error::{Error, Result};
use crate::initial::{self, Assembly, Followed, continuation};
use crate::math::array::Each;
use crate::prepared::AnyMechanism;
use crate::scene::Scene;
use crate::system::{OperatingPoint, Scratch};
use crate::tolerances;

/// An assembled state.
#[derive(Clone)]
pub struct BranchState {
    /// The guess of its scene.
    guess: Vec<f64>,
    dependent: Vec<usize>,
    pub point: Point,
}

/// A scene at a value of its parameter.
struct Ready {
    mechanism: AnyMechanism,
    held: [Option<AnyMechanism>; 2],
    t: f64,
    guess: Vec<f64>,
    v: Vec<f64>,
    hold: Vec<String>,
}

impl Ready {
    fn at(family: &Family, parameter: &str, value: f64) -> Result<Ready> {
        let scene = family.scene_at(parameter, value)?;
        let t = scene.start_time()?;
        let Scene { model, held, q: guess, v, hold, .. } = scene;
        Ok(Ready { mechanism: AnyMechanism::new(model), held: AnyMechanism::held(held), t, guess, v, hold })
    }

    /// The state assembled from a guess with the velocities of the scene.
    fn assemble(&self, q: &[f64]) -> Result<Assembly> {
        let held = self.held.each_ref().each(|held| held.as_ref().map(AnyMechanism::system));
        initial::assemble_held(self.mechanism.system(), held, self.t, (q, &self.v), &self.hold)
    }

    /// Newton's method from a nearby guess.
    fn follow(&self, guess: &[f64], dependent: &[usize]) -> Result<Option<Followed>> {
        let system = self.held[0].as_ref().unwrap_or(&self.mechanism).system();
        initial::follow(system, self.t, guess, &self.hold, dependent)
    }

    /// The state with velocities, accelerations, multipliers and outputs.
    fn complete(self, value: f64, followed: Followed) -> Result<BranchState> {
        let assembly = self.assemble(&followed.q)?;
        let system = self.mechanism.system();
        let mut outputs = vec![0.0; system.facts().outputs.len()];
        let Followed { dependent, rank_indicator, .. } = followed;
        let Assembly { q, v, vdot, lambda, .. } = assembly;
        let at = OperatingPoint { t: self.t, q: &q, v: &v, vdot: &vdot, lambda: &lambda };
        system.outputs(at, &mut outputs, &mut Scratch::default());
        let point = Point { value, q, v, lambda, outputs, rank_indicator };
        Ok(BranchState { guess: self.guess, dependent, point })
    }
}

impl BranchState {
    /// The state assembled from the scene's own guess.
    pub fn assembled(family: &Family, parameter: &str, value: f64) -> Result<BranchState> {
        let ready = Ready::at(family, parameter, value)?;
        let q = ready.assemble(&ready.guess)?.q;
        // Following a state on the constraints gives the same state, except where it is singular.
        let followed = ready.follow(&q, &[])?.unwrap_or(Followed { q, rank_indicator: 0.0, dependent: Vec::new() });
        ready.complete(value, followed)
    }

    pub fn nearest(&self) -> Nearest {
        Nearest { value: self.point.value, rank_indicator: self.point.rank_indicator }
    }
}

/// A branch followed from a state in one direction.
pub struct FollowedBranch<'a> {
    family: &'a Family,
    parameter: &'a str,
    resolution: f64,
    last: BranchState,
    before: Option<BranchState>,
    nearest: Nearest,
    /// Number of constraints that depend on the others at the start, and so everywhere.
    redundant: usize,
}

impl<'a> FollowedBranch<'a> {
    pub fn new(family: &'a Family, range: &'a Range, start: BranchState) -> Self {
        let parameter = range.parameter.as_str();
        let resolution = tolerances::ROOT_OF_ROUND_OFF * range.length();
        let nearest = start.nearest();
        let redundant = start.dependent.len();
        FollowedBranch { family, parameter, resolution, last: start, before: None, nearest, redundant }
    }

    pub fn last(&self) -> &Point {
        &self.last.point
    }

    pub fn into_last(self) -> BranchState {
        self.last
    }

    pub fn nearest(&self) -> Nearest {
        self.nearest
    }

    /// Continues to a value in steps that are halved until the branch is kept; returns its end if that comes before.
    pub fn go(&mut self, target: f64) -> Option<BranchLimit> {
        let start = self.last.point.value;
        let mut problem = None;
        let (reached, step) =
            continuation(start, target, target - start, self.resolution, |value| match self.reach(value) {
                Ok(Some(state)) => {
                    self.accept(state);
                    Some(2.0)
                }
                failed => {
                    problem = failed.err();
                    None
                }
            });
        if reached == target {
            return None;
        }
        let is_near = (target - reached).abs() < 4.0 * self.resolution;
        match is_near.then(|| self.at_the_end(target)).flatten() {
            Some(state) => {
                self.accept(state);
                None
            }
            None => Some(self.limit(target, problem, step.abs())),
        }
    }

    fn accept(&mut self, mut state: BranchState) {
        // The rank indicator ignores the dependent rows; where more rows depend on others than at the start, it is
        // zero.
        if state.dependent.len() > self.redundant {
            state.point.rank_indicator = 0.0;
        }
        if state.point.rank_indicator < self.nearest.rank_indicator {
            self.nearest = state.nearest();
        }
        self.before = Some(std::mem::replace(&mut self.last, state));
    }

    /// The state at a value, from the first of several guesses from which Newton's method contracts.
    fn reach(&self, value: f64) -> Result<Option<BranchState>> {
        let ready = Ready::at(self.family, self.parameter, value)?;
        let none: &[usize] = &[];
        let dependent = &self.last.dependent[..];
        let choices = if dependent.is_empty() { &[none][..] } else { &[none, dependent][..] };
        for guess in self.guesses(value, &ready) {
            for dependent in choices {
                if let Some(followed) = ready.follow(&guess, dependent)? {
                    return ready.complete(value, followed).map(Some);
                }
            }
        }
        Ok(None)
    }

    /// Guesses: the last state moved as the scene's guess moves, which follows the held coordinates; then, where none
    /// is held, the last state itself, for a guess may jump; then the line through the last two, which passes singular
    /// states.
    fn guesses(&self, value: f64, ready: &Ready) -> Vec<Vec<f64>> {
        let last = &self.last.point;
        let moved = last.q.iter().zip(&ready.guess).zip(&self.last.guess).map(|((q, to), from)| q + to - from);
        let mut guesses: Vec<Vec<f64>> = vec![moved.collect()];
        if ready.hold.is_empty() {
            guesses.push(last.q.clone());
            guesses.extend(self.before.as_ref().map(|before| {
                let factor = (value - last.value) / (last.value - before.point.value);
                last.q.iter().zip(&before.point.q).map(|(last, before)| last + factor * (last - before)).collect()
            }));
        }
        guesses
    }

    /// The state at the end of the branch, where that is the target: Newton's method does not contract there, but
    /// assembly finds it.
    fn at_the_end(&self, target: f64) -> Option<BranchState> {
        let ready = Ready::at(self.family, self.parameter, target).ok()?;
        let last = &self.last.point.q;
        let q = ready.assemble(last).ok()?.q;
        let size = last.iter().fold(1.0f64, |size, q| size.max(q.abs()));
        // At a distance d the state is as far away as the root of d.
        let is_beside = q.iter().zip(last).all(|(q, last)| (q - last).abs() < tolerances::TOLD * size);
        let followed = Followed { q, rank_indicator: 0.0, dependent: Vec::new() };
        if is_beside { ready.complete(target, followed).ok() } else { None }
    }

    fn limit(&self, target: f64, problem: Option<Error>, within: f64) -> BranchLimit {
        // The error of an assembly beyond the end.
        let obstacle = || Ready::at(self.family, self.parameter, target)?.assemble(&self.last.point.q);
        let reason = problem.or_else(|| obstacle().err()).map(message);
        let elsewhere = "the joints close only in another configuration, to which no motion leads from here";
        BranchLimit {
            point: self.last.point.clone(),
            within,
            unreached: target,
            reason: reason.unwrap_or_else(|| elsewhere.to_string()),
        }
    }
}

/// The message of an error without its place in the file and its hint.
fn message(error: Error) -> String {
    match error {
        Error::Input(input) => input.message,
        other => other.to_string(),
    }
}
