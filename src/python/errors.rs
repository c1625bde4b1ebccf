//! Errors as exceptions of Python, in the words of the command line with keywords for its options.

use super::force;
use crate::error::{Error, as_settings};
use clap::error::ErrorKind;
use pyo3::create_exception;
use pyo3::exceptions::{PyException, PyTypeError};
use pyo3::prelude::*;

create_exception!(holonom, HolonomError, PyException, "Base of all errors of holonom.");
create_exception!(
    holonom,
    SceneError,
    HolonomError,
    "Bad input: the element, what was found, and what would be right."
);
create_exception!(
    holonom,
    RunError,
    HolonomError,
    "The run failed. What it computed until then is in `partial`, or None."
);

/// Adds the exceptions to the module.
pub fn add(module: &Bound<'_, PyModule>) -> PyResult<()> {
    let py = module.py();
    py.get_type::<RunError>().setattr("partial", py.None())?;
    module.add("HolonomError", py.get_type::<HolonomError>())?;
    module.add("SceneError", py.get_type::<SceneError>())?;
    module.add("RunError", py.get_type::<RunError>())
}

/// The path of a scene that is a dict. Messages leave it out.
const SCENE: &str = "<scene>";

/// The exception of an error, or the one of a force in Python that caused it.
pub fn raised(error: Error) -> PyErr {
    let error = error.changed(|input| _ = input.file.take_if(|path| path.as_os_str() == SCENE));
    force::failure().unwrap_or_else(|| match error.exit_code() {
        2 => SceneError::new_err(error.to_string()),
        _ => RunError::new_err(error.to_string()),
    })
}

/// The exception of words that a command does not know: `TypeError` for the name of an option, as for any keyword.
pub fn refused(error: &clap::Error) -> PyErr {
    let text = error.to_string();
    let message = text.strip_prefix("error: ").unwrap_or(&text);
    let message = as_settings(message.split("\n\nUsage").next().unwrap_or(message).trim_end());
    match error.kind() {
        ErrorKind::UnknownArgument => PyTypeError::new_err(message),
        _ => SceneError::new_err(message),
    }
}
