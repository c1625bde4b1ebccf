//! Time limits of runs.

use crate::clock::Stopwatch;
use std::time::Duration;

/// Time limits of one run.
#[derive(Clone, Copy, Debug)]
pub struct Limit {
    /// CPU time, which does not depend on other load of the machine.
    pub cpu: Duration,
    /// Wall-clock time.
    pub wall: Duration,
}

/// Wall-clock time that a run may take on a busy machine: so many times its CPU time, and this more.
const BUSY: u32 = 20;
const WAIT: Duration = Duration::from_secs(60);

impl From<Duration> for Limit {
    fn from(cpu: Duration) -> Limit {
        Limit { cpu, wall: cpu.saturating_mul(BUSY).saturating_add(WAIT) }
    }
}

/// The time of a run that is over.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Over {
    /// Its CPU time.
    Cpu,
    /// Its wall-clock time.
    Wall,
}

impl Limit {
    /// Returns the time that is over, if any. The clock of CPU time is slow to read, and never ahead of the other.
    pub(super) fn over(&self, watch: &Stopwatch) -> Option<Over> {
        let waited = watch.wall();
        if waited > self.cpu && watch.cpu() > self.cpu {
            return Some(Over::Cpu);
        }
        (waited > self.wall).then_some(Over::Wall)
    }
}

/// Time for many runs, read on the thread that begins it.
#[derive(Clone, Copy, Debug)]
pub struct Budget {
    /// All of it.
    pub all: Duration,
    watch: Stopwatch,
}

impl Budget {
    /// Begins.
    pub fn begin(all: Duration) -> Self {
        Budget { all, watch: Stopwatch::start() }
    }

    /// Returns the time since it began.
    pub fn spent(&self) -> Duration {
        self.watch.wall()
    }

    /// Returns the time that is left of this part of it.
    pub fn left_of(&self, part: f64) -> Duration {
        self.all.mul_f64(part).saturating_sub(self.spent())
    }

    /// Returns the time that is left.
    pub fn left(&self) -> Duration {
        self.all.saturating_sub(self.spent())
    }
}
