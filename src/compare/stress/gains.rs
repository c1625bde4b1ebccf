//! Why Baumgarte's gains are no easy choice, in numbers.

use super::cell::{Cell, Quantity, Status};
use super::run::Stressed;
use crate::tolerances::report as tolerances;
use serde::Serialize;

/// One integrator on the map of gains, judged by the drift of velocities or positions.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct GainVerdict {
    pub method: String,
    pub quantity: Quantity,
    pub steps: Vec<StepVerdict>,
    /// The one gain that is nearest to the best of each step, of those that complete at all steps that were run up to the
    /// first at which none does.
    pub steady: Option<Steady>,
    /// Where the gain that drifts least is farthest off beside no gain.
    pub farther: Option<Farther>,
    /// Of all simulations with this integrator, those of which nothing is known.
    pub left_out: usize,
    pub too_slow: usize,
}

/// The simulations at one step.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct StepVerdict {
    pub step: f64,
    pub none: Level,
    /// The gain that drifts least of those that complete, and what it leaves.
    pub best: Option<Best>,
    /// How many gains came to an end, good or bad, and how many did not.
    pub gains_ended: usize,
    pub gains_left_out: usize,
    /// With the pair (2/h, 1/h^2).
    pub own_gains: Level,
    /// After one and two sweeps of post-stabilization.
    pub manifold: Level,
    pub manifold_twice: Level,
}

/// One simulation.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Level {
    pub status: Status,
    /// None where it did not complete.
    pub drift: Option<f64>,
    /// See [`Cell`].
    pub error: Option<f64>,
    pub energy: Option<f64>,
    pub holds: Option<bool>,
}

#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Best {
    pub gain: f64,
    pub value: f64,
    pub error: Option<f64>,
}

/// A gain and how many times the best of a step it leaves, at the worst of the steps.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Steady {
    pub gain: f64,
    pub ratio: f64,
}

/// How many times the error of an output without gains a gain leaves, though it drifts less than others.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Farther {
    pub step: f64,
    pub gain: f64,
    pub output: String,
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

/// The drift of one integrator at one level.
struct Levels<'a> {
    stressed: &'a Stressed,
    method: usize,
    quantity: Quantity,
}

impl<'a> Levels<'a> {
    fn cell(&self, row: usize, column: usize) -> Option<&'a Cell> {
        self.stressed.cell(self.method, row, column)
    }

    fn at(&self, row: usize, column: usize) -> Option<f64> {
        self.quantity.of(self.cell(row, column)?)
    }

    /// The rows of gains.
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
            Level {
                status: cell.map_or(Status::LeftOut, |cell| cell.status),
                drift: cell.and_then(|cell| self.quantity.of(cell)),
                error: cell.and_then(|cell| cell.error),
                energy: cell.and_then(|cell| Quantity::Energy.of(cell)),
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
            let seen = pairs
                .filter(|(_, (own, none))| **own > tolerances::REFERENCE_NOISE && **none > tolerances::REFERENCE_NOISE);
            let ratios = seen.map(|(output, (own, none))| (output, own / none));
            let (output, ratio) = ratios.max_by(|a, b| a.1.total_cmp(&b.1))?;
            Some(Farther { step: step.step, gain: best.gain, output: output.clone(), ratio })
        };
        let all = steps.iter().enumerate().filter_map(at).filter(|farther| farther.ratio > 1.0);
        all.max_by(|a, b| a.ratio.total_cmp(&b.ratio))
    }
}
