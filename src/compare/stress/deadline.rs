//! When runs end.

use cpu_time::ThreadTime;
use std::time::{Duration, Instant};

/// How long cells may take.
#[derive(Clone, Copy, Debug)]
pub struct Limits {
    /// CPU time of each of them.
    pub cell: Duration,
    /// All of them: what has not begun then is left out, and what runs ends.
    pub end: Instant,
}

/// The end of a run that has begun.
pub(super) struct Deadline {
    begun: (Instant, ThreadTime),
    share: Duration,
    end: Instant,
}

impl Deadline {
    /// After the CPU time `share`, or at the end of all.
    pub fn new(share: Duration, limits: Limits) -> Self {
        Deadline { begun: (Instant::now(), ThreadTime::now()), share, end: limits.end }
    }

    pub fn is_over(&self) -> bool {
        self.is_used_up() || Instant::now() > self.end
    }

    /// Whether its own time is over. The clock of CPU time is slow to read.
    pub fn is_used_up(&self) -> bool {
        self.begun.0.elapsed() > self.share && self.begun.1.elapsed() > self.share
    }
}
