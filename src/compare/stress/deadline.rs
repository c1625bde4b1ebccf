//! Deadlines of runs.

use crate::clock::Stopwatch;
use std::time::Duration;

/// Limits of the computation time.
#[derive(Clone, Copy, Debug)]
pub struct Limits {
    /// CPU time of each cell.
    pub cell: Duration,
    /// Time for all cells: those not begun by then are skipped, and runs end.
    pub all: Duration,
}

/// The time of one of the threads that share the cells.
#[derive(Clone, Copy)]
pub(super) struct Shift {
    /// CPU time of each cell.
    pub cell: Duration,
    all: Duration,
    watch: Stopwatch,
}

impl Shift {
    pub fn begin(Limits { cell, all }: Limits) -> Self {
        Shift { cell, all, watch: Stopwatch::start() }
    }

    /// Returns the time that is left for all cells.
    pub fn left(&self) -> Duration {
        self.all.saturating_sub(self.watch.wall())
    }
}

/// Deadline of a run that has begun.
pub(super) struct Deadline {
    share: Duration,
    left: Duration,
    watch: Stopwatch,
}

/// The time that is over.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Over {
    /// The run's own share.
    Share,
    /// That for all cells.
    All,
}

impl Deadline {
    /// The deadline after the CPU time `share`, or at the end of the shift.
    pub fn new(share: Duration, shift: Shift) -> Self {
        Deadline { share, left: shift.left(), watch: Stopwatch::start() }
    }

    /// Returns the time that is over, if any. The clock of CPU time is slow to read.
    pub fn over(&self) -> Option<Over> {
        let waited = self.watch.wall();
        if waited > self.share && self.watch.cpu() > self.share {
            return Some(Over::Share);
        }
        (waited > self.left).then_some(Over::All)
    }
}
