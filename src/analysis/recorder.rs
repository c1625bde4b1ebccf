//! A sink that records a run.

use super::divergence::Divergence;
use super::drift::Drift;
use super::energy::{EnergyBalance, EnergyMeter, WorstRow, WorstStep};
use super::extremes::Extremes;
use super::ledger::Ledger;
use super::range::ValidityRange;
use super::singularity::{Singularity, SingularityWatch};
use super::thinned::thin;
use crate::math::array::Each;
use crate::math::largest;
use crate::scene::units::{Dimension, dimension_of};
use crate::simulate::{Observation, Sink, Stop};
use crate::system::{MechanicalSystem, Scratch};
use crate::tolerances;
use crate::trajectory::{Gap, Trajectory, recorded};

/// Trajectory, drift and energy of a run.
pub struct Record {
    /// Output rows; thinned where all are passed on.
    pub trajectory: Trajectory,
    /// The last row with q, v and lambda, where `trajectory` does not have them.
    pub last: Option<Trajectory>,
    /// Number of rows of the run.
    pub rows: usize,
    /// Number of times at which a watched quantity jumped.
    pub jumps: usize,
    /// Outputs without a finite value at some rows.
    #[doc(hidden)]
    pub gaps: Vec<Gap>,
    /// Least, greatest and mean values of the outputs over the rows.
    pub extremes: Vec<Extremes>,
    /// Constraint drift.
    pub drift: Drift,
    /// `None` where the system defines no potential.
    pub energy: Option<EnergyBalance>,
    /// The step in which the energy balance changes most.
    #[doc(hidden)]
    pub worst_step: WorstStep,
    /// The output row with the largest error of the balance.
    #[doc(hidden)]
    pub worst_row: WorstRow,
    /// Singular states on the way.
    pub singularity: Singularity,
    /// Deformations of parts whose theory is valid for small ones only.
    #[doc(hidden)]
    pub range: ValidityRange,
    /// Largest |phi|, |phi'|, |phi''| at each output row.
    pub drift_rows: Vec<[f64; 3]>,
    /// Energies at each output row; empty where the system defines no potential.
    #[doc(hidden)]
    pub ledger_rows: Vec<Ledger>,
}

/// An output row as it is passed on.
pub struct OutputRow<'r> {
    /// t, q, v, lambda and outputs; t and outputs where only these are kept.
    pub values: &'r [f64],
    /// Largest |phi|, |phi'|, |phi''|.
    pub drift: [f64; 3],
    /// Energies; `None` where the system defines no potential.
    pub ledger: Option<Ledger>,
}

/// A row with all columns of the run.
struct Made {
    values: Vec<f64>,
    drift: [f64; 3],
    ledger: Option<Ledger>,
    /// Largest |lambda|, N or N m, and |v'|, m/s^2 or rad/s^2.
    loads: f64,
}

/// Collects a [`Record`] during a run.
pub struct Recorder<'a> {
    system: &'a dyn MechanicalSystem,
    scratch: Scratch,
    scales: Vec<f64>,
    meter: EnergyMeter,
    divergence: Divergence,
    /// The reason to end the run, if the motion diverges.
    diverged: Option<Stop>,
    watch: SingularityWatch<'a>,
    record: Record,
    progress: Box<dyn FnMut(f64) + 'a>,
    stop: Box<dyn Fn() -> Option<Stop> + 'a>,
    pass: Option<Pass<'a>>,
    outputs_only: bool,
    /// True if rows are passed on, and no curves are made of them.
    passes_only: bool,
    shows_jumps: bool,
    /// The state before the present change of form.
    before: Option<Made>,
}

type Pass<'a> = Box<dyn FnMut(OutputRow) + 'a>;

impl<'a> Recorder<'a> {
    /// A recorder for a run of `system`.
    pub fn new(system: &'a dyn MechanicalSystem) -> Self {
        Recorder {
            system,
            scratch: Scratch::default(),
            scales: system.facts().scales.clone(),
            meter: EnergyMeter::default(),
            divergence: Divergence::default(),
            diverged: None,
            watch: SingularityWatch::new(system),
            record: Record {
                trajectory: Trajectory::new(system),
                last: None,
                rows: 0,
                jumps: 0,
                gaps: Vec::new(),
                extremes: recorded(system).iter().map(Extremes::of).collect(),
                drift: Drift::default(),
                energy: None,
                worst_step: WorstStep::default(),
                worst_row: WorstRow::default(),
                singularity: Singularity::default(),
                range: ValidityRange::new(system),
                drift_rows: Vec::new(),
                ledger_rows: Vec::new(),
            },
            progress: Box::new(|_| {}),
            stop: Box::new(|| None),
            pass: None,
            outputs_only: false,
            passes_only: false,
            shows_jumps: false,
            before: None,
        }
    }

    /// Keeps time and outputs alone of all rows but the last.
    pub fn with_outputs_only(mut self) -> Self {
        self.outputs_only = true;
        self.keep(0)
    }

    /// Adds two rows at each time at which an output, a velocity or a multiplier jumps: that before the jump and that
    /// after it; at no more than 1000 times.
    pub fn with_jumps(mut self) -> Self {
        self.shows_jumps = true;
        self
    }

    /// Passes each row on as it comes, and keeps those that curves need of the outputs, of the first `coordinates`, of
    /// drift and energies: memory is bounded, however long the run.
    #[doc(hidden)]
    pub fn with_rows(mut self, coordinates: usize, pass: impl FnMut(OutputRow) + 'a) -> Self {
        self.pass = Some(Box::new(pass));
        self.keep(coordinates)
    }

    /// Passes each row on as it comes, without its energies, and keeps the first and the last alone. Columns of outputs
    /// that `reads` is false of may be zero. Ranges of validity are not watched.
    pub(crate) fn with_passed_rows(mut self, reads: impl Fn(usize) -> bool, pass: impl FnMut(OutputRow) + 'a) -> Self {
        self.pass = Some(Box::new(pass));
        self.passes_only = true;
        // A jump is seen in any output.
        if self.system.switches().all.is_empty() {
            let trajectory = &self.record.trajectory;
            let count = trajectory.headings().len();
            self.scratch.unread = (count - trajectory.outputs.len()..count).map(|column| !reads(column)).collect();
        }
        self
    }

    fn keep(mut self, coordinates: usize) -> Self {
        let part = self.record.last.as_ref().unwrap_or(&self.record.trajectory).part(coordinates);
        let all = std::mem::replace(&mut self.record.trajectory, part);
        self.record.last.get_or_insert(all);
        self
    }

    /// Sets a callback with the time of every accepted step.
    pub fn with_progress(mut self, progress: impl FnMut(f64) + 'a) -> Self {
        self.progress = Box::new(progress);
        self
    }

    /// Sets a callback that is asked before every step whether the run should end.
    pub fn with_stop(mut self, stop: impl Fn() -> Option<Stop> + 'a) -> Self {
        self.stop = Box::new(stop);
        self
    }

    /// The record so far, without the singular states.
    pub fn record(&mut self) -> &Record {
        self.record.energy = self.meter.balance();
        self.record.worst_step = self.meter.worst();
        &self.record
    }

    /// Returns the record.
    pub fn finish(mut self) -> Record {
        self.record();
        self.record.singularity = self.watch.finish();
        self.record
    }
}

/// Both sides of a jump are rows at so many times.
pub const MOST_JUMPS: usize = 1000;

impl Recorder<'_> {
    fn made(&mut self, state: &Observation) -> Made {
        Made {
            values: self.record.full().row(self.system, state, &mut self.scratch),
            drift: [largest(state.phi), largest(state.phi_dot), largest(state.phi_ddot)],
            ledger: if self.passes_only { None } else { self.meter.ledger(self.system, state, &mut self.scratch) },
            loads: largest(state.lambda).max(largest(state.vdot)),
        }
    }

    fn keep_row(&mut self, Made { values, drift, ledger, .. }: Made) {
        let record = &mut self.record;
        let t = values[0];
        record.note_extremes(&values);
        record.rows += 1;
        if let (true, Some(pass)) = (self.passes_only, &mut self.pass) {
            pass(OutputRow { values: &values, drift, ledger });
            record.trajectory.rows.truncate(1);
            record.trajectory.rows.push(values);
            return;
        }
        record.drift_rows.push(drift);
        record.ledger_rows.extend(ledger);
        ledger.iter().for_each(|ledger| record.worst_row.add(t, ledger));
        match &mut record.last {
            None => record.trajectory.rows.push(values),
            Some(last) => {
                last.rows = vec![values];
                record.trajectory.push_part(last);
            }
        }
        record.note_gaps(t);
        if let Some(pass) = &mut self.pass {
            let all = record.last.as_ref().filter(|_| !self.outputs_only).unwrap_or(&record.trajectory);
            if let Some(values) = all.rows.last() {
                pass(OutputRow { values, drift, ledger });
            }
            thin(&mut record.trajectory.rows, &mut record.drift_rows, &mut record.ledger_rows);
        }
    }

    /// Adds the rows of a jump. Where an output row has just been made, that is the one before.
    fn keep_jump(&mut self, mut before: Made, mut after: Made) {
        let t = before.values[0];
        let start = self.record.trajectory.rows.first().map_or(0.0, |row| row[0]);
        let last = self.record.full().rows.last().map_or(f64::NEG_INFINITY, |row| row[0]);
        let has_row = t - last <= tolerances::SAME * (t - start);
        if has_row {
            (before.values[0], after.values[0]) = (last, last);
        }
        if self.record.jumps > MOST_JUMPS {
            self.record.note_extremes(&before.values);
            self.record.note_extremes(&after.values);
            return;
        }
        if !has_row {
            self.keep_row(before);
        }
        self.keep_row(after);
    }

    /// True if a velocity, a multiplier or an output differs by more than round-off.
    fn jumps(&self, before: &Made, after: &Made) -> bool {
        let trajectory = self.record.full();
        let sides = [before, after].each(|made| trajectory.row_state(&made.values));
        let differ = |a: &[f64], b: &[f64]| {
            let least = tolerances::SAME * largest(a).max(largest(b));
            a.iter().zip(b).any(|(a, b)| (a - b).abs() > least)
        };
        let [(_, v0, lambda0), (_, v1, lambda1)] = sides;
        if !self.outputs_only && (differ(v0, v1) || differ(lambda0, lambda1)) {
            return true;
        }
        let a = trajectory.row_outputs(&before.values);
        let b = trajectory.row_outputs(&after.values);
        let loads = before.loads.max(after.loads);
        (0..a.len()).any(|i| (a[i] - b[i]).abs() > tolerances::SAME * self.size_of(a, b, i, loads))
    }

    /// The largest value of the outputs in the unit of output `i`; of forces and accelerations those of the mechanism
    /// count, too, since one that is zero by symmetry is round-off of the others.
    fn size_of(&self, a: &[f64], b: &[f64], i: usize, loads: f64) -> f64 {
        let unit = &self.record.extremes[i].unit;
        let size = if is_load(unit) { loads } else { 0.0 };
        self.record.extremes.iter().zip(a.iter().zip(b)).filter(|(seen, _)| seen.unit == *unit).fold(
            size,
            |size, (seen, (a, b))| {
                let min = seen.min.unwrap_or(0.0).abs();
                let max = seen.max.unwrap_or(0.0).abs();
                size.max(min).max(max).max(a.abs()).max(b.abs())
            },
        )
    }
}

fn is_load(unit: &str) -> bool {
    let loads = [Dimension::Force, Dimension::Torque, Dimension::Acceleration, Dimension::AngularAcceleration];
    dimension_of(unit).is_some_and(|dimension| loads.contains(&dimension))
}

impl Sink for Recorder<'_> {
    fn accepted(&mut self, state: &Observation) {
        self.record.drift.add(state, &self.scales);
        if let Some(ledger) = self.meter.add(self.system, state, &mut self.scratch) {
            let diverged = self.divergence.add(self.system, state, &ledger, &mut self.scratch);
            self.diverged = self.diverged.take().or(diverged);
        }
        self.watch.add(state);
        if !self.passes_only {
            self.record.range.add(self.system, state);
        }
        (self.progress)(state.t);
    }

    fn row(&mut self, state: &Observation) {
        self.record.drift.add(state, &self.scales);
        if !self.passes_only {
            self.record.range.add_row(self.system, state, &mut self.scratch);
        }
        let made = self.made(state);
        self.keep_row(made);
    }

    fn watches_events(&self) -> bool {
        self.shows_jumps
    }

    fn before_event(&mut self, state: &Observation) {
        self.before = Some(self.made(state));
    }

    fn after_event(&mut self, state: &Observation) {
        let Some(before) = self.before.take() else { return };
        let after = self.made(state);
        if self.jumps(&before, &after) {
            self.record.jumps += 1;
            self.keep_jump(before, after);
        }
    }

    fn stops(&self) -> Option<Stop> {
        self.diverged.clone().or_else(|| (self.stop)())
    }
}

impl Record {
    /// The last row with all columns that the run has.
    pub fn full(&self) -> &Trajectory {
        self.last.as_ref().unwrap_or(&self.trajectory)
    }

    fn note_extremes(&mut self, row: &[f64]) {
        let outputs = self.trajectory.row_outputs(row);
        self.extremes.iter_mut().zip(outputs).for_each(|(extremes, value)| extremes.add(row[0], *value));
    }

    /// Counts the outputs that have no value at the last row.
    fn note_gaps(&mut self, t: f64) {
        let Record { trajectory, gaps, .. } = self;
        let Some(row) = trajectory.rows.last() else { return };
        let outputs = trajectory.outputs.iter().zip(trajectory.row_outputs(row));
        for (output, _) in outputs.filter(|(_, value)| !value.is_finite()) {
            match gaps.iter_mut().find(|gap| gap.name == output.name) {
                Some(gap) => gap.count += 1,
                None => gaps.push(Gap { name: output.name.clone(), first: t, count: 1 }),
            }
        }
    }
}
