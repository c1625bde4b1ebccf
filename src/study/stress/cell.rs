//! Result of one simulation of a map.

use crate::analysis::Drift;
use crate::simulate::Method;
use crate::tolerances;
use serde::Serialize;

/// How a simulation ended.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Status {
    /// The run reached its end time.
    Completed,
    /// The joints came apart by more than a tenth of the scene's size, or numbers became infinite.
    Diverged,
    /// The run stopped with an error.
    Failed,
    /// The scene or the method is refused: nothing was simulated.
    Refused,
    /// The deadline of a cell passed.
    TooSlow,
    /// The time for all cells was over: the result is not known.
    #[default]
    LeftOut,
}

impl Status {
    /// Returns the name in a table.
    pub fn word(self) -> &'static str {
        match self {
            Status::Completed => "completed",
            Status::Diverged => "diverged",
            Status::Failed => "failed",
            Status::Refused => "refused",
            Status::TooSlow => "too slow",
            Status::LeftOut => "left out",
        }
    }

    /// True if the simulation ended by itself, with or without success.
    pub fn is_ended(self) -> bool {
        !matches!(self, Status::TooSlow | Status::LeftOut)
    }
}

/// One simulation and its measures.
#[derive(Clone, Debug, Default, Serialize)]
pub struct Cell {
    /// Index of the compared method.
    pub panel: usize,
    /// Index of the value of the first parameter (x).
    pub column: usize,
    /// Index of the value of the second parameter (y).
    pub row: usize,
    /// Method of the simulation.
    pub method: Method,
    /// How it ended.
    pub status: Status,
    /// Reason why it did not complete.
    pub reason: Option<String>,
    /// Time reached, s.
    pub t: f64,
    /// Constraint drift; none where nothing was simulated.
    pub drift: Option<Drift>,
    /// max |kinetic + potential - initial - work|, J.
    pub energy_error: Option<f64>,
    /// The same relative to the energy converted: see [`EnergyBalance`](crate::analysis::EnergyBalance).
    pub relative_energy_error: Option<f64>,
    /// Largest difference of an output from an accurate run of the same motion, relative to the scale of the output; of
    /// coordinates where the scene names no outputs. None where no accurate run completed, or the cell did not.
    pub error: Option<f64>,
    /// The output with the largest difference.
    pub worst: Option<String>,
    /// The differences of all outputs, relative to their scales.
    #[serde(skip)]
    pub errors: Vec<f64>,
    /// True if it completed with outputs and energy within `tolerances::WRONG_MOTION`. None where that is not known.
    pub holds: Option<bool>,
    /// Accepted steps.
    pub steps: u64,
    /// Evaluations of the right-hand side, of steps and rows.
    pub rhs_evaluations: u64,
    /// Wall-clock time, s.
    pub seconds: f64,
}

impl Cell {
    /// Returns the same cell with its errors, and with `holds`.
    pub(super) fn judged(mut self, names: &[String], errors: Vec<f64>) -> Self {
        let largest = errors.iter().enumerate().max_by(|a, b| magnitude(*a.1).total_cmp(&magnitude(*b.1)));
        self.error = largest.map(|(_, error)| *error);
        self.worst = largest.and_then(|(i, _)| names.get(i).cloned());
        let within = |part: f64| part <= tolerances::WRONG_MOTION;
        let keeps_energy = self.relative_energy_error.is_none_or(within);
        self.holds = match (self.status, self.error) {
            (Status::Completed, Some(error)) => Some(keeps_energy && within(error)),
            (Status::Completed, None) => (!keeps_energy).then_some(false),
            (status, _) => status.is_ended().then_some(false),
        };
        self.errors = errors;
        self
    }
}

/// NaN counts as the largest.
fn magnitude(error: f64) -> f64 {
    if error.is_nan() { f64::INFINITY } else { error }
}

/// Quantity that a map shows of its cells.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum CellQuantity {
    /// Largest |phi|, m or rad.
    Position,
    /// Largest |G v + phi_t|, m/s or rad/s.
    Velocity,
    /// |phi| at the end, m or rad.
    FinalPosition,
    /// Relative error of the energy balance.
    Energy,
    /// Relative error of the outputs.
    Error,
    /// Wall-clock time, s.
    Seconds,
}

impl CellQuantity {
    /// All quantities.
    pub const ALL: [CellQuantity; 6] = [
        CellQuantity::Position,
        CellQuantity::Velocity,
        CellQuantity::FinalPosition,
        CellQuantity::Energy,
        CellQuantity::Error,
        CellQuantity::Seconds,
    ];

    /// Returns the name on the command line.
    pub fn name(self) -> &'static str {
        self.texts()[0]
    }

    /// Returns the name with its unit.
    pub fn label(self) -> &'static str {
        self.texts()[1]
    }

    fn texts(self) -> [&'static str; 2] {
        match self {
            CellQuantity::Position => ["position", "position drift (m, rad)"],
            CellQuantity::Velocity => ["velocity", "velocity drift (m/s, rad/s)"],
            CellQuantity::FinalPosition => ["final_position", "final position drift (m, rad)"],
            CellQuantity::Energy => ["energy", "relative energy error"],
            CellQuantity::Error => ["error", "error of outputs / their scale"],
            CellQuantity::Seconds => ["seconds", "computing time (s)"],
        }
    }

    /// Returns the value in a completed cell; none in others.
    pub fn of(self, cell: &Cell) -> Option<f64> {
        if cell.status != Status::Completed {
            return None;
        }
        let drift = cell.drift.as_ref();
        let value = match self {
            CellQuantity::Position => drift?.position.max,
            CellQuantity::Velocity => drift?.velocity.max,
            CellQuantity::FinalPosition => drift?.position.last,
            CellQuantity::Energy => cell.relative_energy_error?,
            CellQuantity::Error => cell.error?,
            CellQuantity::Seconds => cell.seconds,
        };
        value.is_finite().then_some(value)
    }
}
