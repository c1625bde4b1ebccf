//! Ctrl-C: Python only notes the signal, and its main thread has to ask for it.

use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::thread;
use std::time::Duration;

/// Time between two questions for signals. Why: nobody notices it.
const PAUSE: Duration = Duration::from_millis(10);
/// Time for work that is asked to end. Why: a run ends within a step, and other work may not hear it at all.
const PATIENCE: Duration = Duration::from_secs(2);
/// Memory of the thread, bytes: that of the main thread of a program.
const STACK: usize = 8 << 20;

/// The result of some work, and the exception that a signal raised meanwhile; one of both is there.
pub struct Ended<R> {
    pub result: Option<R>,
    pub signal: Option<PyErr>,
}

impl<R> Ended<R> {
    /// Returns the result, or raises the exception.
    pub fn or_raise(self) -> PyResult<R> {
        match (self.result, self.signal) {
            (Some(result), None) => Ok(result),
            (_, signal) => Err(ended_early(signal)),
        }
    }
}

/// Returns the exception of a signal, or that of work that ended without a result.
pub fn ended_early(signal: Option<PyErr>) -> PyErr {
    signal.unwrap_or_else(|| PyRuntimeError::new_err("the work ended without a result; see standard error"))
}

/// Does `work` in a thread of its own while this one waits for signals, at which it calls `ask` to end the work.
pub fn on_thread<R: Send + 'static>(
    py: Python<'_>,
    ask: impl Fn() + Send,
    work: impl FnOnce() -> R + Send + 'static,
) -> PyResult<Ended<R>> {
    let (sender, receiver) = channel();
    // The thread is known to Python as long as it works, so that forces in Python need not make it known at each call.
    // Nobody receives the result of work that was left behind.
    let work = move || Python::attach(|py| py.detach(|| _ = sender.send(work())));
    thread::Builder::new().stack_size(STACK).spawn(work)?;
    Ok(py.detach(move || {
        loop {
            match receiver.recv_timeout(PAUSE) {
                Ok(result) => return Ended { result: Some(result), signal: None },
                Err(RecvTimeoutError::Disconnected) => return Ended { result: None, signal: None },
                Err(RecvTimeoutError::Timeout) => {}
            }
            if let Err(signal) = Python::attach(|py| py.check_signals()) {
                ask();
                return Ended { result: receiver.recv_timeout(PATIENCE).ok(), signal: Some(signal) };
            }
        }
    }))
}
