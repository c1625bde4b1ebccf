//! Work for which nobody waits any more.
//!
//! A command that does not ask for interruption ends with its process. A program that called it goes on, so its work
//! unwinds at the next evaluation of the equations.

use std::cell::Cell;
use std::panic::resume_unwind;
use std::sync::atomic::{AtomicBool, Ordering};

static IS_ABANDONED: AtomicBool = AtomicBool::new(false);

thread_local! {
    static IS_KEPT: Cell<bool> = const { Cell::new(false) };
}

/// Abandons the work of all threads but those that keep theirs, or lets the work go on that begins now.
pub fn abandon(is_abandoned: bool) {
    IS_ABANDONED.store(is_abandoned, Ordering::Relaxed);
}

/// Keeps the work of this thread, which ends in another way.
pub fn keep() {
    IS_KEPT.set(true);
}

/// Unwinds if the work is abandoned.
#[inline]
pub fn leave() {
    if IS_ABANDONED.load(Ordering::Relaxed) {
        unwind();
    }
}

/// Unwinds without the message of a panic.
#[cold]
fn unwind() {
    if !IS_KEPT.get() {
        resume_unwind(Box::new("abandoned"));
    }
}
