//! Ctrl-C: Python only notes the signal, and its main thread has to ask for it.

use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::thread;
use std::time::{Duration, Instant};

/// Time between two questions for signals. Why: nobody notices it.
const PAUSE: Duration = Duration::from_millis(10);
/// Time for work that is asked to end, before it is asked again, and after that. Why: a step of a large model, and the
/// files of a command, take less.
const PATIENCE: Duration = Duration::from_secs(2);
/// Memory of the thread, bytes: that of the main thread of a program.
const STACK: usize = 8 << 20;

/// Does `work` in a thread of its own while this one waits for signals, at which it calls `ask` to end the work, and
/// once more if that takes long. Returns the result, and the exception that a signal raised meanwhile.
///
/// # Errors
/// That exception, or another, of work that ended without a result.
pub fn on_thread<R: Send + 'static>(
    py: Python<'_>,
    ask: impl Fn() + Send,
    work: impl FnOnce() -> R + Send + 'static,
) -> PyResult<(R, Option<PyErr>)> {
    let (sender, receiver) = channel();
    // The thread is known to Python as long as it works, so that forces in Python need not make it known at each call.
    // Nobody receives the result of work that was left behind.
    let work = move || Python::attach(|py| py.detach(|| _ = sender.send(work())));
    thread::Builder::new().stack_size(STACK).spawn(work)?;
    py.detach(move || {
        let mut signal = None;
        let mut asked: Vec<Instant> = Vec::new();
        loop {
            match receiver.recv_timeout(PAUSE) {
                Ok(result) => return Ok((result, signal)),
                Err(RecvTimeoutError::Disconnected) => return Err(signal.unwrap_or_else(without_result)),
                Err(RecvTimeoutError::Timeout) => {}
            }
            let heard = Python::attach(|py| py.check_signals()).err();
            let is_late = asked.last().is_some_and(|last| last.elapsed() > PATIENCE);
            if is_late && asked.len() > 1 {
                return Err(signal.unwrap_or_else(without_result));
            }
            if is_late || heard.is_some() {
                ask();
                asked.push(Instant::now());
            }
            signal = signal.or(heard);
        }
    })
}

/// The exception of work that ended without a result.
fn without_result() -> PyErr {
    PyRuntimeError::new_err("the work was interrupted or ended without a result; see standard error")
}
