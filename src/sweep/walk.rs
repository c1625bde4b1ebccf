//! A sweep along a branch over the values of a range.

use super::branch::{Branch, State};
use super::{Family, Limit, Nearest, Point, Range, Sweep};
use crate::error::{Error, Result};

impl Family {
    /// Assembles the scene at the values of a range; `progress` is called with the number of values done.
    ///
    /// # Errors
    /// A parameter that the scene does not have; a scene that cannot be assembled where the sweep begins, or not be
    /// moved from its own value into the range. A branch that ends in the range is no error: see [`Sweep::limits`].
    pub fn sweep(&self, range: &Range, progress: impl FnMut(usize)) -> Result<Sweep> {
        let own = snapped(self.own_value(&range.parameter)?, range);
        let walk = Walk { family: self, range, values: range.values(), progress, done: 0 };
        walk.run(own)
    }
}

/// The value of the range that equals `own` up to round-off, else `own`.
fn snapped(own: f64, range: &Range) -> f64 {
    let near = |value: &f64| (value - own).abs() <= 1e-12 * range.length();
    range.values().into_iter().find(near).unwrap_or(own)
}

/// A sweep in progress.
struct Walk<'a, P: FnMut(usize)> {
    family: &'a Family,
    range: &'a Range,
    values: Vec<f64>,
    progress: P,
    done: usize,
}

/// The results on one side of the start.
#[derive(Default)]
struct Side {
    points: Vec<Point>,
    limit: Option<Limit>,
}

impl<P: FnMut(usize)> Walk<'_, P> {
    fn run(mut self, own: f64) -> Result<Sweep> {
        let (start, is_own) = self.start(own)?;
        let (names, outputs) = start.columns();
        let mut nearest = start.nearest();
        let begin = start.point.value;
        // The range may run downwards: `before` has the values that come before the start in it.
        let forward = self.range.to > self.range.from;
        let is_before = |value: f64| if forward { value < begin } else { value > begin };
        let all = self.values.clone();
        let before: Vec<f64> = all.iter().copied().filter(|value| is_before(*value)).rev().collect();
        let after: Vec<f64> = all.iter().copied().filter(|value| !is_before(*value) && *value != begin).collect();
        let mut first = self.side(&start, &before, &mut nearest);
        let second = self.side(&start, &after, &mut nearest);
        first.points.reverse();
        let middle = all.contains(&begin).then(|| start.point.clone());
        Ok(Sweep {
            scene: self.family.scene()?.name,
            range: self.range.clone(),
            names,
            outputs,
            own_value: own,
            own: (is_own && self.range.contains(own)).then(|| start.point.clone()),
            points: first.points.into_iter().chain(middle).chain(second.points).collect(),
            limits: [first.limit, second.limit].into_iter().flatten().collect(),
            nearest_singular: nearest,
        })
    }

    /// The scene at its own value, or moved from there to the near end of the range; where it cannot be assembled
    /// there, at the nearest value of the range. Returns true if the value is the scene's own.
    fn start(&self, own: f64) -> Result<(State, bool)> {
        let parameter = &self.range.parameter;
        let distance = |value: &f64| (value - own).abs();
        let near = self.values.iter().copied().min_by(|a, b| distance(a).total_cmp(&distance(b))).unwrap_or(own);
        let at = |value: f64| State::assembled(self.family, parameter, value);
        let Ok(state) = at(own) else {
            let place = |error| self.family.place(error).element(format!("{parameter} = {near}"));
            return Ok((at(near).map_err(place)?, false));
        };
        if self.range.contains(own) {
            return Ok((state, true));
        }
        let mut branch = Branch::new(self.family, self.range, state);
        match branch.go(near) {
            None => Ok((branch.into_last(), false)),
            Some(limit) => Err(Error::input(format!(
                "from its own value {parameter} = {own} the mechanism can be moved to {} only, which is outside of the \
                 range: {}",
                limit.point.value, limit.reason
            ))
            .hint("begin the range nearer to the scene's own value, or replace that by --set")),
        }
    }

    /// The states on one side of the start, from the nearest value on.
    fn side(&mut self, start: &State, values: &[f64], nearest: &mut Nearest) -> Side {
        let mut branch = Branch::new(self.family, self.range, start.clone());
        let mut side = Side::default();
        for value in values {
            side.limit = branch.go(*value);
            if side.limit.is_some() {
                break;
            }
            side.points.push(branch.last().clone());
            self.done += 1;
            (self.progress)(self.done);
        }
        let met = branch.nearest();
        if met.rank_indicator < nearest.rank_indicator {
            *nearest = met;
        }
        side
    }
}
