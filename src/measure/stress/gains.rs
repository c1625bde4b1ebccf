//! Why Baumgarte's gains are no easy choice, in numbers.

use super::cell::{Cell, Status};
use super::run::Stressed;
use serde::Serialize;

/// One integrator on the map of gains.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct GainVerdict {
    pub method: String,
    pub steps: Vec<StepVerdict>,
    /// The one gain that is nearest to the best of each step, of those that complete at all steps at which some gain does.
    pub steady: Option<Steady>,
}

/// The map's quantity at one step; None where the run did not complete.
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
    /// The verdicts by integrator; empty for other maps.
    pub fn gains(&self) -> Vec<GainVerdict> {
        match self.map.name == "gain" {
            true => (0..self.map.methods.len()).map(|method| self.gain_verdict(method)).collect(),
            false => Vec::new(),
        }
    }

    fn gain_verdict(&self, method: usize) -> GainVerdict {
        let values = self.map.x.values().unwrap_or_default();
        let steps: Vec<StepVerdict> = values.iter().enumerate().map(|(column, step)| self.step_verdict(method, column, *step)).collect();
        let steady = self.steady(method, &steps);
        GainVerdict { method: self.map.methods[method].label.clone(), steps, steady }
    }

    fn step_verdict(&self, method: usize, column: usize, step: f64) -> StepVerdict {
        let value = |cell: &Cell| self.map.quantity.of(cell).filter(|_| cell.status == Status::Completed);
        let named = |label: &str| {
            let row = self.map.y.entries.iter().position(|entry| entry.label == label)?;
            value(self.cell(method, row, column)?)
        };
        let gains = self.map.y.entries.iter().enumerate().filter_map(|(row, entry)| {
            Some(Best { gain: entry.value?, value: value(self.cell(method, row, column)?)? })
        });
        StepVerdict {
            step,
            none: named("none"),
            best: gains.min_by(|a, b| a.value.total_cmp(&b.value)),
            own_gains: named("(2/h, 1/h²)"),
            manifold: named("manifold"),
            manifold_twice: named("manifold × 2"),
        }
    }

    fn steady(&self, method: usize, steps: &[StepVerdict]) -> Option<Steady> {
        let rows = self.map.y.entries.iter().enumerate().filter_map(|(row, entry)| Some((row, entry.value?)));
        let ratio = |row: usize| {
            let columns = steps.iter().enumerate().filter_map(|(column, step)| Some((column, step.best?)));
            columns.into_iter().try_fold(0.0, |worst: f64, (column, best)| {
                let value = self.map.quantity.of(self.cell(method, row, column)?)?;
                Some(worst.max(value / best.value))
            })
        };
        let all = rows.filter_map(|(row, gain)| Some(Steady { gain, ratio: ratio(row)? }));
        all.filter(|steady| steady.ratio > 0.0).min_by(|a, b| a.ratio.total_cmp(&b.ratio))
    }
}
