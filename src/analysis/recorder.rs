//! A sink that records a run.

use super::drift::{Drift, largest};
use super::energy::{EnergyBalance, EnergyMeter, Ledger};
use super::range::Range;
use super::singularity::{Singularity, Watch};
use crate::simulate::{Observation, Sink, Stop};
use crate::system::{MechanicalSystem, Scratch};
use crate::trajectory::Trajectory;

/// Trajectory, drift and energy of a run.
pub struct Record {
    /// Output rows.
    pub trajectory: Trajectory,
    /// The last row with q, v and lambda, where `trajectory` has outputs only.
    pub last: Option<Trajectory>,
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
}

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
                drift: Drift::default(),
                energy: None,
                singularity: Singularity::default(),
                range: Range::new(system),
                drift_rows: Vec::new(),
                ledger_rows: Vec::new(),
            },
            progress: Box::new(|_| {}),
            stop: Box::new(|| None),
        }
    }

    /// Keeps time and outputs alone of all rows but the last.
    pub fn with_outputs_only(mut self) -> Self {
        self.record.trajectory = Trajectory::of_outputs(self.system);
        self.record.last = Some(Trajectory::new(self.system));
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
        let levels = [state.phi, state.phi_dot, state.phi_ddot].map(|rows| largest(rows.iter().copied()));
        self.record.drift_rows.push(levels);
        self.record.ledger_rows.extend(self.meter.ledger(self.system, state, &mut self.scratch));
        self.record.trajectory.push(self.system, state, &mut self.scratch);
        if let Some(last) = &mut self.record.last {
            last.rows.clear();
            last.push(self.system, state, &mut self.scratch);
        }
    }

    fn stops(&self) -> Option<Stop> {
        (self.stop)()
    }
}
