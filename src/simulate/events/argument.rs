//! The argument of a switching function over a step.

use super::range::{OpenInterval, first_out};
use crate::math::Rate;

/// Places at which the dense output is looked at where a step comes near a threshold.
const LOOKS_AT_STEP: usize = 8;

/// An argument over a step of size `h`, given by its values and rates at both ends.
pub struct Argument {
    pub range: OpenInterval,
    pub a: Rate,
    pub b: Rate,
    pub h: f64,
}

impl Argument {
    /// Distance of two looks.
    const APART: f64 = 1.0 / LOOKS_AT_STEP as f64;

    /// The cubic Hermite interpolant.
    fn cubic(&self, theta: f64) -> f64 {
        let x = self.a.re;
        let y = self.b.re;
        let u = self.h * self.a.eps[0];
        let v = self.h * self.b.eps[0];
        let rest = 1.0 - theta;
        x + theta * (y - x) + theta * rest * (rest * (u - (y - x)) - theta * (v - (y - x)))
    }

    fn looks() -> impl Iterator<Item = f64> {
        (1..LOOKS_AT_STEP).map(|k| k as f64 * Self::APART)
    }

    /// The fraction of the step from which on the cubic is near a threshold, or where it passes one; `None` if it stays
    /// away and ends inside.
    pub fn near_from(&self) -> Option<f64> {
        let looks = || [0.0].into_iter().chain(Self::looks()).chain([1.0]);
        let values = looks().map(|theta| self.cubic(theta));
        let (low, high) = values.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), x| (low.min(x), high.max(x)));
        let margin = 0.2 * (high - low);
        let beyond = |theta: f64| self.range.beyond(self.cubic(theta));
        let near = looks().find(|theta| beyond(*theta) >= -margin)?;
        let outside = looks().find(|theta| beyond(*theta) >= 0.0);
        Some(outside.map_or(near - Self::APART, |outside| self.passed_before(outside)))
    }

    /// The fraction before `outside` at which the cubic passes its threshold, to some digits from below.
    fn passed_before(&self, outside: f64) -> f64 {
        let mut low = outside - Self::APART;
        let mut high = outside;
        // Thresholds a millionth of a step apart are taken in order.
        for _ in 0..20 {
            let middle = 0.5 * (low + high);
            if self.range.beyond(self.cubic(middle)) < 0.0 { low = middle } else { high = middle }
        }
        low
    }

    /// The first fraction of the step, before `limit`, at which the argument leaves its range; `limit` where it does
    /// not.
    pub fn first_passage<E>(&self, limit: f64, beyond: &mut impl FnMut(f64) -> Result<f64, E>) -> Result<f64, E> {
        let mut inside = 0.0;
        for theta in Self::looks().chain([1.0]).map(|part| part * limit) {
            let is_end = theta == 1.0;
            if (if is_end { self.range.beyond(self.b.re) } else { beyond(theta)? }) >= 0.0 {
                let mut failed = None;
                let passage = first_out(
                    |theta| match theta {
                        0.0 => self.range.beyond(self.a.re),
                        1.0 => self.range.beyond(self.b.re),
                        _ => beyond(theta).unwrap_or_else(|error| {
                            failed = Some(error);
                            0.0
                        }),
                    },
                    inside,
                    theta,
                );
                return failed.map_or(Ok(passage), Err);
            }
            inside = theta;
        }
        Ok(limit)
    }
}
