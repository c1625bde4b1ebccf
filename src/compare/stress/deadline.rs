//! Deadlines of runs.

use cpu_time::ThreadTime;
use std::time::{Duration, Instant};

/// Limits of the computation time.
#[derive(Clone, Copy, Debug)]
pub struct Limits {
    /// CPU time of each cell.
    pub cell: Duration,
    /// End of all cells: those not begun by then are skipped, and runs end.
    pub end: Instant,
}

/// Deadline of a run that has begun.
pub(super) struct Deadline {
    begun: (Instant, ThreadTime),
    share: Duration,
    end: Instant,
}

impl Deadline {
    /// The deadline after the CPU time `share`, or at the end of all.
    pub fn new(share: Duration, limits: Limits) -> Self {
        Deadline { begun: (Instant::now(), ThreadTime::now()), share, end: limits.end }
    }

    pub fn is_over(&self) -> bool {
        self.is_used_up() || Instant::now() > self.end
    }

    /// True if the run has used its own share. The clock of CPU time is slow to read.
    pub fn is_used_up(&self) -> bool {
        self.begun.0.elapsed() > self.share && self.begun.1.elapsed() > self.share
    }
}
