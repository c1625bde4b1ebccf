//! A sweep along a branch over the values of a range.

use super::branch::{BranchState, FollowedBranch};
use super::{BranchLimit, Family, Point, Range, Sweep};
use crate::error::{Error, Result};
use crate::prepared::AnyMechanism;

impl Family {
    /// Assembles the scene at the values of a range; `progress` is called with the number of values done.
    ///
    /// # Errors
    /// A parameter that the scene does not have; a scene that cannot be assembled where the sweep begins, or not be
    /// moved from its own value into the range. A branch that ends in the range is no error: see `Sweep::limits`.
    #[doc(hidden)]
    pub fn sweep(&self, range: &Range, mut progress: impl FnMut(usize)) -> Result<Sweep> {
        let values = range.values();
        let own = self.own_value(&range.parameter)?;
        // Up to round-off the scene's own value is one of the range.
        let near = |value: &f64| (value - own).abs() <= 1e-12 * range.length();
        let own = values.iter().copied().find(near).unwrap_or(own);
        let (start, is_own) = self.start(range, &values, own)?;
        let begin = start.point.value;
        // The range may run downwards: `before` has the values that come before the start in it.
        let forward = range.to > range.from;
        let is_before = |value: &f64| if forward { *value < begin } else { *value > begin };
        let mut before: Vec<f64> = values.iter().copied().filter(is_before).collect();
        before.reverse();
        let after: Vec<f64> = values.iter().copied().filter(|value| !is_before(value) && *value != begin).collect();
        let mut nearest = start.nearest();
        let mut done = 0;
        // The states on one side of the start, from the nearest value on.
        let mut side = |values: &[f64]| -> (Vec<Point>, Option<BranchLimit>) {
            let mut branch = FollowedBranch::new(self, range, start.clone());
            let mut points = Vec::new();
            let limit = values.iter().find_map(|value| {
                let limit = branch.go(*value);
                if limit.is_none() {
                    points.push(branch.last().clone());
                    done += 1;
                    progress(done);
                }
                limit
            });
            if branch.nearest().rank_indicator < nearest.rank_indicator {
                nearest = branch.nearest();
            }
            (points, limit)
        };
        let (mut first, lower) = side(&before);
        let (second, upper) = side(&after);
        first.reverse();
        let scene = self.scene()?;
        let mechanism = AnyMechanism::new(scene.model);
        let middle = values.contains(&begin).then(|| start.point.clone());
        Ok(Sweep {
            scene: scene.name,
            range: range.clone(),
            names: mechanism.system().facts().names.clone(),
            outputs: mechanism.system().facts().outputs.clone(),
            own_value: own,
            own: (is_own && range.contains(own)).then(|| start.point.clone()),
            points: first.into_iter().chain(middle).chain(second).collect(),
            limits: [lower, upper].into_iter().flatten().collect(),
            nearest_singular: nearest,
        })
    }

    /// The scene at its own value, or moved from there to the near end of the range; where it cannot be assembled
    /// there, at the nearest value of the range. Returns true if the value is the scene's own.
    fn start(&self, range: &Range, values: &[f64], own: f64) -> Result<(BranchState, bool)> {
        let parameter = &range.parameter;
        let distance = |value: &f64| (value - own).abs();
        let near = values.iter().copied().min_by(|a, b| distance(a).total_cmp(&distance(b))).unwrap_or(own);
        let at = |value: f64| BranchState::assembled(self, parameter, value);
        let Ok(state) = at(own) else {
            let place = |error| self.place(error).element(format!("{parameter} = {near}"));
            return Ok((at(near).map_err(place)?, false));
        };
        if range.contains(own) {
            return Ok((state, true));
        }
        let mut branch = FollowedBranch::new(self, range, state);
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
}
