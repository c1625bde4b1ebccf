//! The clock that budgets, time limits and measured costs are read from.
//!
//! Tests count: runs read the clock before every step and after every row, so that time is counted work, and a budget
//! leaves out the same on every machine.

use cpu_time::ThreadTime;
use std::cell::Cell;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

/// Time from one reading to the next where readings are counted.
pub const TICK: Duration = Duration::from_micros(100);

static IS_COUNTED: AtomicBool = AtomicBool::new(false);

thread_local! {
    static READINGS: Cell<u32> = const { Cell::new(0) };
}

/// From now on the time of a thread, in the whole process, is the number of its readings, a [`TICK`] each.
pub fn count_readings() {
    IS_COUNTED.store(true, Ordering::Relaxed);
}

/// Measures time from its start on, to be read on the same thread.
#[derive(Clone, Copy, Debug)]
pub struct Stopwatch(Begun);

#[derive(Clone, Copy, Debug)]
enum Begun {
    /// Moment, and CPU time of the thread.
    At(Instant, Duration),
    /// Readings of the thread.
    Counted(u32),
}

impl Stopwatch {
    /// Starts.
    pub fn start() -> Self {
        Stopwatch(if IS_COUNTED.load(Ordering::Relaxed) {
            Begun::Counted(READINGS.get())
        } else {
            Begun::At(Instant::now(), thread_time())
        })
    }

    /// Returns the wall-clock time since the start.
    pub fn wall(&self) -> Duration {
        match self.0 {
            Begun::At(instant, _) => instant.elapsed(),
            Begun::Counted(begun) => {
                READINGS.set(READINGS.get().saturating_add(1));
                counted(begun)
            }
        }
    }

    /// Returns the CPU time of this thread since the start, which is slower to read.
    pub fn cpu(&self) -> Duration {
        match self.0 {
            Begun::At(_, begun) => thread_time().saturating_sub(begun),
            Begun::Counted(begun) => counted(begun),
        }
    }
}

fn thread_time() -> Duration {
    ThreadTime::now().as_duration()
}

/// Returns the time since a reading. Of another thread that may be ahead.
fn counted(begun: u32) -> Duration {
    TICK * READINGS.get().saturating_sub(begun)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Both clocks go on while a thread works, however long that has to wait for the processor.
    #[test]
    fn the_clocks_of_the_machine_go_on() {
        let watch = Stopwatch::start();
        while watch.wall() < Duration::from_millis(1) || watch.cpu() < Duration::from_millis(1) {}
        let seen = watch.wall();
        assert!(watch.wall() >= seen);
    }
}
