//! Commands called from Python.

use super::errors::{raised, refused};
use super::force;
use super::signals::on_thread;
use crate::cli;
use crate::cli::caller::set_words;
use crate::cli::interrupt;
use crate::cli::terminal::Captured;
use crate::error::as_settings;
use crate::files::with_given;
use clap::error::ErrorKind;
use pyo3::prelude::*;
use std::ffi::OsString;
use std::path::PathBuf;
use std::process::ExitCode;

/// The result as JSON and as text, the warnings and errors, true if the command failed, and the exception of a signal.
type Answer = (Option<String>, String, Vec<String>, bool, Option<PyErr>);

/// Calls a command with the texts `given` in the place of files; its own files go to `folder`.
///
/// Returns the result as JSON and as text, the warnings and errors, true if the command failed, and the exception of a
/// signal after which the command ended by itself.
#[pyfunction]
pub fn command(py: Python<'_>, words: Vec<String>, given: Vec<(PathBuf, String)>, folder: PathBuf) -> PyResult<Answer> {
    interrupt::forget();
    let (called, signal) = on_thread(py, interrupt::ask, move || with_given(given, || cli::call(&words, &folder)))?;
    if let Some(error) = force::failure() {
        return Err(error);
    }
    match called {
        Err(error) if error.kind() == ErrorKind::DisplayHelp => {
            Ok((None, error.to_string(), Vec::new(), false, signal))
        }
        Err(error) => Err(refused(&error)),
        Ok((Err(error), _)) => Err(signal.unwrap_or_else(|| raised(error))),
        Ok((Ok(code), Captured { json, text, told })) => {
            let told = told.iter().map(|told| as_settings(told)).collect();
            Ok((json, text, told, code != ExitCode::SUCCESS, signal))
        }
    }
}

/// Runs the command line of these words, the program first, and returns its exit code.
#[pyfunction]
pub fn main(py: Python<'_>, words: Vec<String>) -> u8 {
    let code = py.detach(|| {
        set_words(&words);
        cli::run(words.iter().map(OsString::from))
    });
    (0..=u8::MAX).find(|number| ExitCode::from(*number) == code).unwrap_or(1)
}
