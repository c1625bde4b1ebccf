//! A sink that records a run.

use super::drift::Drift;
use super::energy::{EnergyBalance, EnergyMeter, Ledger};
use super::extremes::Extremes;
use super::range::Range;
use super::singularity::{Singularity, Watch};
use super::thinned::thin;
use crate::math::largest;
use crate::simulate::{Observation, Sink, Stop};
use crate::system::{MechanicalSystem, Scratch};
use crate::trajectory::{Gap, Trajectory, recorded};

/// Trajectory, drift and energy of a run.
pub struct Record {
    /// Output rows; thinned where all are passed on.
    pub trajectory: Trajectory,
    /// The last row with q, v and lambda, where `trajectory` does not have them.
    pub last: Option<Trajectory>,
    /// Number of rows of the run.
    pub rows: usize,
    /// Outputs without a finite value at some rows.
    pub gaps: Vec<Gap>,
    /// Least, greatest and mean values of the outputs over the rows.
    pub extremes: Vec<Extremes>,
    /// Constraint drift.
    pub drift: Drift,
    /// `None` where the system defines no potential.
    pub energy: Option<EnergyBalance>,
    /// Singular states on the way.
    pub singularity: Singularity,
    /// Deformations of parts whose theory is valid for small ones only.
    pub range: Range,
    /// Largest |phi|, |phi'|, |phi''| at each output row.
    pub drift_rows: Vec<[f64; 3]>,
    /// Energies at each output row; empty where the system defines no potential.
    pub ledger_rows: Vec<Ledger>,
}

/// An output row as it is passed on.
pub struct Row<'r> {
    /// t, q, v, lambda and outputs; t and outputs where only these are kept.
    pub values: &'r [f64],
    /// Largest |phi|, |phi'|, |phi''|.
    pub drift: [f64; 3],
    /// Energies; `None` where the system defines no potential.
    pub ledger: Option<Ledger>,
}

/// Collects a [`Record`] during a run.
pub struct Recorder<'a> {
    system: &'a dyn MechanicalSystem,
    scratch: Scratch,
    scales: Vec<f64>,
    meter: EnergyMeter,
    watch: Watch<'a>,
    record: Record,
    progress: Box<dyn FnMut(f64) + 'a>,
    stop: Box<dyn Fn() -> Option<Stop> + 'a>,
    pass: Option<Pass<'a>>,
    outputs_only: bool,
}

type Pass<'a> = Box<dyn FnMut(Row) + 'a>;

impl<'a> Recorder<'a> {
    /// A recorder for a run of `system`.
    pub fn new(system: &'a dyn MechanicalSystem) -> Self {
        Recorder {
            system,
            scratch: Scratch::default(),
            scales: system.scales(),
            meter: EnergyMeter::default(),
            watch: Watch::new(system),
            record: Record {
                trajectory: Trajectory::new(system),
                last: None,
                rows: 0,
                gaps: Vec::new(),
                extremes: recorded(system).iter().map(Extremes::of).collect(),
                drift: Drift::default(),
                energy: None,
                singularity: Singularity::default(),
                range: Range::new(system),
                drift_rows: Vec::new(),
                ledger_rows: Vec::new(),
            },
            progress: Box::new(|_| {}),
            stop: Box::new(|| None),
            pass: None,
            outputs_only: false,
        }
    }

    /// Keeps time and outputs alone of all rows but the last.
    pub fn with_outputs_only(mut self) -> Self {
        self.outputs_only = true;
        self.keep(0)
    }

    /// Passes each row on as it comes, and keeps those that curves need of the outputs, of the first `coordinates`, of
    /// drift and energies: memory is bounded, however long the run.
    pub fn with_rows(mut self, coordinates: usize, pass: impl FnMut(Row) + 'a) -> Self {
        self.pass = Some(Box::new(pass));
        self.keep(coordinates)
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

    /// Returns the record.
    pub fn finish(mut self) -> Record {
        self.record.energy = self.meter.balance();
        self.record.singularity = self.watch.finish();
        self.record
    }
}

impl Sink for Recorder<'_> {
    fn accepted(&mut self, state: &Observation) {
        self.record.drift.add(state, &self.scales);
        self.meter.add(self.system, state, &mut self.scratch);
        self.watch.add(state);
        self.record.range.add(self.system, state);
        (self.progress)(state.t);
    }

    fn row(&mut self, state: &Observation) {
        self.record.drift.add(state, &self.scales);
        let levels = [state.phi, state.phi_dot, state.phi_ddot].map(largest);
        let ledger = self.meter.ledger(self.system, state, &mut self.scratch);
        let record = &mut self.record;
        record.rows += 1;
        record.drift_rows.push(levels);
        record.ledger_rows.extend(ledger);
        match &mut record.last {
            None => record.trajectory.push(self.system, state, &mut self.scratch),
            Some(last) => {
                last.rows.clear();
                last.push(self.system, state, &mut self.scratch);
                record.trajectory.push_part(last);
            }
        }
        record.note_gaps(state.t);
        record.note_extremes(state.t);
        if let Some(pass) = &mut self.pass {
            let all = record.last.as_ref().filter(|_| !self.outputs_only).unwrap_or(&record.trajectory);
            if let Some(values) = all.rows.last() {
                pass(Row { values, drift: levels, ledger });
            }
            thin(&mut record.trajectory.rows, &mut record.drift_rows, &mut record.ledger_rows);
        }
    }

    fn stops(&self) -> Option<Stop> {
        (self.stop)()
    }
}

impl Record {
    /// The last row with all columns that the run has.
    pub fn full(&self) -> &Trajectory {
        self.last.as_ref().unwrap_or(&self.trajectory)
    }

    fn note_extremes(&mut self, t: f64) {
        let Record { trajectory, extremes, .. } = self;
        let Some(row) = trajectory.rows.last() else { return };
        extremes.iter_mut().zip(trajectory.row_outputs(row)).for_each(|(extremes, value)| extremes.add(t, *value));
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
