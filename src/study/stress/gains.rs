//! Measures of how well one pair of Baumgarte's gains fits many steps.

use super::cell::{Cell, CellQuantity, Status};
use super::run::Stressed;
use crate::tolerances;
use serde::Serialize;

/// One integrator on the map of gains, judged by the drift of velocities or positions.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct GainVerdict {
    /// Name of the integrator.
    pub method: String,
    /// Level of the drift.
    pub quantity: CellQuantity,
    /// Result for each step.
    pub steps: Vec<StepVerdict>,
    /// The gain whose drift is nearest to the best of each step, of those that complete at all steps that were run up
    /// to the first at which none does.
    pub steady: Option<Steady>,
    /// The step at which the gain of least drift increases the error most against no stabilization.
    pub farther: Option<Farther>,
    /// Number of simulations with this integrator that were skipped.
    pub left_out: usize,
    /// Number of those that reached their deadline.
    pub too_slow: usize,
}

/// The simulations with one step.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct StepVerdict {
    /// Step h, s.
    pub step: f64,
    /// Without stabilization.
    pub none: GainRun,
    /// The completed gain of least drift.
    pub best: Option<Best>,
    /// Number of gains whose runs ended by themselves, with or without success.
    pub gains_ended: usize,
    /// Number of the other gains.
    pub gains_left_out: usize,
    /// With the pair (2/h, 1/h^2).
    pub own_gains: GainRun,
    /// With one sweep of post-stabilization.
    pub manifold: GainRun,
    /// With two sweeps of post-stabilization.
    pub manifold_twice: GainRun,
}

/// One simulation.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct GainRun {
    /// How it ended.
    pub status: Status,
    /// Drift in the unit of the quantity; none where it did not complete.
    pub drift: Option<f64>,
    /// Relative error of the outputs: see [`Cell`].
    pub error: Option<f64>,
    /// Relative error of the energy balance.
    pub energy: Option<f64>,
    /// True if the errors are within the tolerance: see [`Cell`].
    pub holds: Option<bool>,
}

/// The gain of least drift at one step.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Best {
    /// Gain alpha = beta, 1/s.
    pub gain: f64,
    /// Drift in the unit of the quantity.
    pub value: f64,
    /// Relative error of the outputs.
    pub error: Option<f64>,
}

/// One gain for all steps, and its drift relative to that of the best gain of a step, at the worst step.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Steady {
    /// Gain alpha = beta, 1/s.
    pub gain: f64,
    /// Drift over that of the best gain, largest over the steps.
    pub ratio: f64,
}

/// A gain of least drift whose output error is larger than without stabilization.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Farther {
    /// Step h, s.
    pub step: f64,
    /// Gain alpha = beta, 1/s.
    pub gain: f64,
    /// Name of the output.
    pub output: String,
    /// Error of the output over that without stabilization.
    pub ratio: f64,
}

impl Stressed {
    /// Returns the verdicts by integrator, each by velocities and by positions; empty for other maps.
    #[doc(hidden)]
    pub fn gains(&self) -> Vec<GainVerdict> {
        let methods = if self.map.name == "gain" { self.map.methods.len() } else { 0 };
        let levels = [CellQuantity::Velocity, CellQuantity::Position];
        (0..methods).flat_map(|method| levels.map(|quantity| self.gain_verdict(method, quantity))).collect()
    }

    fn gain_verdict(&self, method: usize, quantity: CellQuantity) -> GainVerdict {
        let values = self.map.x.values().unwrap_or_default();
        let levels = Levels { stressed: self, method, quantity };
        let steps: Vec<StepVerdict> =
            values.iter().enumerate().map(|(column, step)| levels.at_step(column, *step)).collect();
        let count = |status| self.cells.iter().filter(|cell| cell.panel == method && cell.status == status).count();
        GainVerdict {
            method: self.map.methods[method].label.clone(),
            quantity,
            steady: levels.steady(&steps),
            farther: levels.farther(&steps),
            steps,
            left_out: count(Status::LeftOut),
            too_slow: count(Status::TooSlow),
        }
    }
}

/// Access to the drift of one integrator at one level.
struct Levels<'a> {
    stressed: &'a Stressed,
    method: usize,
    quantity: CellQuantity,
}

impl<'a> Levels<'a> {
    fn cell(&self, row: usize, column: usize) -> Option<&'a Cell> {
        self.stressed.cell(self.method, row, column)
    }

    fn at(&self, row: usize, column: usize) -> Option<f64> {
        self.quantity.of(self.cell(row, column)?)
    }

    /// Returns the rows of gains as (row, gain).
    fn gains(&self) -> impl Iterator<Item = (usize, f64)> {
        let rows = self.stressed.map.y.entries.iter().enumerate();
        rows.filter_map(|(row, entry)| Some((row, entry.value?)))
    }

    fn named(&self, label: &str, column: usize) -> Option<&'a Cell> {
        let mut rows = self.stressed.map.y.entries.iter();
        self.cell(rows.position(|entry| entry.label == label)?, column)
    }

    fn best(&self, column: usize) -> Option<(Best, &'a Cell)> {
        let of = |(row, gain)| {
            let cell = self.cell(row, column)?;
            Some((Best { gain, value: self.quantity.of(cell)?, error: cell.error }, cell))
        };
        self.gains().filter_map(of).min_by(|a, b| a.0.value.total_cmp(&b.0.value))
    }

    fn at_step(&self, column: usize, step: f64) -> StepVerdict {
        let level = |label: &str| {
            let cell = self.named(label, column);
            GainRun {
                status: cell.map_or(Status::LeftOut, |cell| cell.status),
                drift: cell.and_then(|cell| self.quantity.of(cell)),
                error: cell.and_then(|cell| cell.error),
                energy: cell.and_then(|cell| CellQuantity::Energy.of(cell)),
                holds: cell.and_then(|cell| cell.holds),
            }
        };
        let cells = self.gains().filter_map(|(row, _)| self.cell(row, column));
        let (ended, left_out): (Vec<&Cell>, Vec<&Cell>) = cells.partition(|cell| cell.status.is_ended());
        StepVerdict {
            step,
            none: level("none"),
            best: self.best(column).map(|(best, _)| best),
            gains_ended: ended.len(),
            gains_left_out: left_out.len(),
            own_gains: level("(2/h, 1/h²)"),
            manifold: level("manifold"),
            manifold_twice: level("manifold × 2"),
        }
    }

    fn steady(&self, steps: &[StepVerdict]) -> Option<Steady> {
        let run = steps.iter().enumerate().filter(|(_, step)| step.gains_ended > 0);
        let best: Vec<(usize, Best)> = run.map_while(|(column, step)| Some((column, step.best?))).collect();
        let ratio = |row: usize| {
            let mut all = best.iter();
            all.try_fold(0.0, |worst: f64, (column, best)| Some(worst.max(self.at(row, *column)? / best.value)))
        };
        let all = self.gains().filter_map(|(row, gain)| Some(Steady { gain, ratio: ratio(row)? }));
        all.filter(|steady| steady.ratio > 0.0).min_by(|a, b| a.ratio.total_cmp(&b.ratio))
    }

    fn farther(&self, steps: &[StepVerdict]) -> Option<Farther> {
        let at = |(column, step): (usize, &StepVerdict)| {
            let ((best, cell), none) = (self.best(column)?, self.named("none", column)?);
            let pairs = self.stressed.watched.iter().zip(cell.errors.iter().zip(&none.errors));
            let seen = pairs.filter(|(_, (own, none))| **own > tolerances::SAME && **none > tolerances::SAME);
            let ratios = seen.map(|(output, (own, none))| (output, own / none));
            let (output, ratio) = ratios.max_by(|a, b| a.1.total_cmp(&b.1))?;
            Some(Farther { step: step.step, gain: best.gain, output: output.clone(), ratio })
        };
        let all = steps.iter().enumerate().filter_map(at).filter(|farther| farther.ratio > 1.0);
        all.max_by(|a, b| a.ratio.total_cmp(&b.ratio))
    }
}
