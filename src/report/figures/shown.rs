//! Rows of a run that are drawn: those before its end is spoilt.

use crate::analysis::{Drift, EnergyBalance, Record};
use crate::error::{Failure, INTERRUPTED, significant};
use crate::math::largest;
use crate::trajectory::Trajectory;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Ending {
    /// At its end time, or where the user interrupted it.
    Completed,
    /// With an error.
    Failed,
    /// With joints that came apart, or an energy that came from nowhere.
    Diverged,
}

impl Ending {
    /// The ending of a run, by what it left.
    pub fn of(failure: Option<&Failure>, drift: &Drift, energy: Option<&EnergyBalance>) -> Self {
        match failure {
            _ if drift.has_open_joints() || energy.is_some_and(EnergyBalance::is_lost) => Ending::Diverged,
            Some(failure) if failure.reason != INTERRUPTED => Ending::Failed,
            _ => Ending::Completed,
        }
    }

    /// Returns what a run did, and what it did from the first row on that is not drawn.
    fn words(self) -> (&'static str, &'static str) {
        match self {
            Ending::Completed => ("completed", ""),
            Ending::Failed => ("failed", "where values grow until the run fails"),
            Ending::Diverged => ("diverged", "where the run diverged"),
        }
    }
}

/// The number of rows that are drawn, the first ones, and a note where these are not all.
#[derive(Clone, Debug, PartialEq)]
pub struct Shown {
    pub rows: usize,
    cut: Option<Cut>,
}

/// Where and why a run is not drawn to its end.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Cut {
    /// Time of the first row that is not drawn, s; none if all are drawn, since the first alone is sound.
    t: Option<f64>,
    ending: Ending,
}

/// Rows at the end of a run are spoilt where values are so many times as large as all in the first half of the others.
/// Unit: [1]. Why: a panel has fewer pixels, so that the first half would be a straight line. Test:
/// `rows_that_a_divergence_spoils_are_not_shown`.
const SPOILT: f64 = 1e3;
/// Values of a run that failed without diverging blow up if they grow so many times in the last tenth of its rows: else
/// they are those of a motion that began late.
/// Unit: [1]. Why: a choice, above what a swing adds in its last period. Test: `a_late_motion_is_shown`.
const GROWS: f64 = 3.0;

impl Shown {
    pub fn all(trajectory: &Trajectory) -> Self {
        Shown { rows: trajectory.rows.len(), cut: None }
    }

    /// The rows of a run; `length` is that of the mechanism, m.
    pub fn of_run(ending: Ending, record: &Record, length: f64) -> Self {
        let energy = record.ledger_rows.iter().map(|row| size([row.kinetic, row.potential, row.work])).collect();
        let drift = record.drift_rows.iter().map(|levels| levels[0]).collect();
        Shown::of(ending, &record.trajectory, vec![(energy, 0.0), (drift, length)])
    }

    /// The rows of a trajectory of which no energies and no drift are known.
    pub fn of_trajectory(ending: Ending, trajectory: &Trajectory) -> Self {
        Shown::of(ending, trajectory, Vec::new())
    }

    /// Returns the rows before those that are spoilt in the coordinates, in the outputs of any unit, or in others, each
    /// with a size that is large at the least.
    fn of(ending: Ending, trajectory: &Trajectory, others: Vec<(Vec<f64>, f64)>) -> Self {
        let count = trajectory.rows.len();
        if ending == Ending::Completed {
            return Shown::all(trajectory);
        }
        // Values blow up in the last tenth of the rows.
        let is_growing = |sizes: &[f64]| {
            let (before, end) = sizes.split_at(sizes.len() - sizes.len().div_ceil(10));
            largest(end) > GROWS * largest(before)
        };
        let all = sizes(trajectory).into_iter().map(|sizes| (sizes, 0.0)).chain(others);
        let blown_up =
            all.filter(|(sizes, _)| sizes.len() == count && (ending == Ending::Diverged || is_growing(sizes)));
        let rows = blown_up.map(|(sizes, floor)| sound(&sizes, floor)).min().unwrap_or(count);
        match trajectory.rows.get(rows) {
            None => Shown::all(trajectory),
            // A single row is no curve.
            Some(_) if rows < 2 => Shown { rows: count, cut: Some(Cut { t: None, ending }) },
            Some(row) => Shown { rows, cut: Some(Cut { t: Some(row[0]), ending }) },
        }
    }

    /// Returns the title with a note on what is not drawn.
    pub fn title(&self, title: &str) -> String {
        self.note().map_or_else(|| title.to_string(), |note| format!("{title} ({note})"))
    }

    /// Returns a note on what is not drawn, if anything.
    pub fn note(&self) -> Option<String> {
        let Cut { t, ending } = self.cut?;
        let (word, from) = ending.words();
        Some(match t {
            None => format!("the run {word} at once"),
            Some(t) => format!("not drawn: t ≥ {} s, {from}", significant(t, 4)),
        })
    }

    /// Returns the name of a curve with the same note, short enough for a legend.
    pub fn legend(&self, name: &str) -> String {
        let Some(Cut { t, ending }) = self.cut else { return name.to_string() };
        let (word, _) = ending.words();
        match t {
            None => format!("{name} ({word} at once)"),
            Some(t) => format!("{name} ({word} from {} s on)", significant(t, 4)),
        }
    }
}

/// Returns the largest size in each row, of the coordinates and of the outputs of each unit.
fn sizes(trajectory: &Trajectory) -> Vec<Vec<f64>> {
    let mut units: Vec<&str> = trajectory.named_outputs().map(|(_, unit)| unit).collect();
    units.sort_unstable();
    units.dedup();
    let of_unit = |unit: &str, row: &[f64]| {
        let outputs = trajectory.named_outputs().zip(trajectory.row_outputs(row));
        size(outputs.filter(|((_, own), _)| *own == unit).map(|(_, value)| *value))
    };
    let outputs = units.iter().map(|unit| trajectory.rows.iter().map(|row| of_unit(unit, row)).collect());
    let coordinates = trajectory.rows.iter().map(|row| size(trajectory.row_state(row).0.iter().copied())).collect();
    outputs.chain([coordinates]).collect()
}

/// Returns the largest absolute value; NaN without one.
fn size(values: impl IntoIterator<Item = f64>) -> f64 {
    values.into_iter().map(f64::abs).fold(f64::NAN, f64::max)
}

/// Returns the number of rows before those at the end that are [`SPOILT`]. What spoils the first half of the rows is
/// found in the next round, when most of them are gone.
fn sound(sizes: &[f64], floor: f64) -> usize {
    let mut count = sizes.len();
    loop {
        let first_half = sizes[..count.div_ceil(2)].iter().copied().filter(|size| size.is_finite());
        let most = SPOILT * first_half.fold(floor, f64::max);
        let sound = sizes[..count].iter().rposition(|size| *size <= most).map_or(0, |last| last + 1);
        if most == 0.0 || sound == 0 || !sizes[sound..count].iter().any(|size| *size > most) {
            return count;
        }
        count = sound;
    }
}
