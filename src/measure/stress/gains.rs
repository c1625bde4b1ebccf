//! Why Baumgarte's gains are no easy choice, in numbers.

use super::cell::Quantity;
use super::run::Stressed;
use serde::Serialize;

/// One integrator on the map of gains, judged by the drift of velocities or positions.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct GainVerdict {
    pub method: String,
    pub quantity: Quantity,
    pub steps: Vec<StepVerdict>,
    /// The one gain that is nearest to the best of each step, of those that complete at all steps up to the first at which
    /// none does.
    pub steady: Option<Steady>,
}

/// The drift at one step; None where the run did not complete.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct StepVerdict {
    pub step: f64,
    pub none: Option<f64>,
    /// The best of the gains, and what it leaves.
    pub best: Option<Best>,
    /// With the pair (2/h, 1/h^2).
    pub own_gains: Option<f64>,
    /// After one and two sweeps of post-stabilization.
    pub manifold: Option<f64>,
    pub manifold_twice: Option<f64>,
}

#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Best {
    pub gain: f64,
    pub value: f64,
}

/// A gain and how many times the best of a step it leaves, at the worst of the steps.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Steady {
    pub gain: f64,
    pub ratio: f64,
}

impl Stressed {
    /// The verdicts by integrator, each by velocities and by positions; empty for other maps.
    pub fn gains(&self) -> Vec<GainVerdict> {
        let methods = if self.map.name == "gain" { self.map.methods.len() } else { 0 };
        let levels = [Quantity::Velocity, Quantity::Position];
        (0..methods).flat_map(|method| levels.map(|quantity| self.gain_verdict(method, quantity))).collect()
    }

    fn gain_verdict(&self, method: usize, quantity: Quantity) -> GainVerdict {
        let values = self.map.x.values().unwrap_or_default();
        let levels = Levels { stressed: self, method, quantity };
        let steps: Vec<StepVerdict> =
            values.iter().enumerate().map(|(column, step)| levels.at_step(column, *step)).collect();
        let steady = levels.steady(&steps);
        GainVerdict { method: self.map.methods[method].label.clone(), quantity, steps, steady }
    }
}

/// The drift of one integrator at one level.
struct Levels<'a> {
    stressed: &'a Stressed,
    method: usize,
    quantity: Quantity,
}

impl Levels<'_> {
    fn at(&self, row: usize, column: usize) -> Option<f64> {
        self.quantity.of(self.stressed.cell(self.method, row, column)?)
    }

    /// The rows of gains.
    fn gains(&self) -> impl Iterator<Item = (usize, f64)> {
        let rows = self.stressed.map.y.entries.iter().enumerate();
        rows.filter_map(|(row, entry)| Some((row, entry.value?)))
    }

    fn at_step(&self, column: usize, step: f64) -> StepVerdict {
        let rows = &self.stressed.map.y.entries;
        let named = |label: &str| self.at(rows.iter().position(|entry| entry.label == label)?, column);
        let gains = self.gains().filter_map(|(row, gain)| Some(Best { gain, value: self.at(row, column)? }));
        StepVerdict {
            step,
            none: named("none"),
            best: gains.min_by(|a, b| a.value.total_cmp(&b.value)),
            own_gains: named("(2/h, 1/h²)"),
            manifold: named("manifold"),
            manifold_twice: named("manifold × 2"),
        }
    }

    fn steady(&self, steps: &[StepVerdict]) -> Option<Steady> {
        let best: Vec<Best> = steps.iter().map_while(|step| step.best).collect();
        let ratio = |row: usize| {
            best.iter()
                .enumerate()
                .try_fold(0.0, |worst: f64, (column, best)| Some(worst.max(self.at(row, column)? / best.value)))
        };
        let all = self.gains().filter_map(|(row, gain)| Some(Steady { gain, ratio: ratio(row)? }));
        all.filter(|steady| steady.ratio > 0.0).min_by(|a, b| a.ratio.total_cmp(&b.ratio))
    }
}
