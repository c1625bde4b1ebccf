//! The Python module `holonom._core`: commands called from Python, and runs whose rows are arrays.
//!
//! The classes that users see are written in Python, in `src/python/holonom`.

mod command;
mod errors;
mod force;
mod rows;
mod run;
mod signals;

use crate::cli::caller::set_elements;
use crate::scene::Elements;
use pyo3::prelude::*;

#[pymodule(gil_used = false)]
fn _core(module: &Bound<'_, PyModule>) -> PyResult<()> {
    set_elements(Elements::default().with_force::<force::PythonForce>().map_err(errors::raised)?);
    // A pool that exists is not replaced by one of a thread that ends with its command.
    let _ = rayon::ThreadPoolBuilder::new().build_global();
    module.add("__version__", env!("CARGO_PKG_VERSION"))?;
    errors::add(module)?;
    module.add_function(wrap_pyfunction!(command::command, module)?)?;
    module.add_function(wrap_pyfunction!(command::main, module)?)?;
    module.add_function(wrap_pyfunction!(run::simulate, module)?)?;
    module.add_function(wrap_pyfunction!(run::describe, module)?)
}
