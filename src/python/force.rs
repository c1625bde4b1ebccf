//! Forces whose law is a function in Python.

use crate::Result;
use crate::body::{Build, Wrench, sub};
use crate::error::Error;
use crate::force::{Action, BuiltForce, ForceKernel, ForceSpec, Instant, Motion};
use crate::math::Scalar;
use crate::math::array::from_fn;
use crate::simulate::Stop;
use pyo3::prelude::*;
use pyo3::types::PyTuple;
use schemars::JsonSchema;
use serde::Deserialize;
use std::any::TypeId;
use std::sync::{Mutex, PoisonError};

/// The first exception that a law has raised since the last question.
static FAILURE: Mutex<Option<PyErr>> = Mutex::new(None);

/// Takes the exception that a law has raised.
pub fn failure() -> Option<PyErr> {
    FAILURE.lock().unwrap_or_else(PoisonError::into_inner).take()
}

/// Returns a reason to end the run if a law has raised an exception.
pub fn stop() -> Option<Stop> {
    let has_failed = FAILURE.lock().unwrap_or_else(PoisonError::into_inner).is_some();
    has_failed.then(|| Stop { reason: "a force in Python raised an exception".to_string(), hint: String::new() })
}

/// A force on the second marker, and its opposite on the first, as a function (t, r, v) in Python: the time, and the
/// position and velocity of the second marker from the first, in world axes. It is called from Rust, which is slow.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct PythonForce {
    between: [String; 2],
    /// The function; in text the number under which the package `holonom` keeps it.
    function: u64,
}

impl ForceSpec for PythonForce {
    const TYPE: &'static str = "python";

    fn build<const D: usize>(&self, build: &Build<D>) -> Result<BuiltForce<D>> {
        let function = Python::attach(|py| {
            let kept = py.import("holonom._functions")?.getattr("kept")?;
            kept.get_item(self.function).map(Bound::unbind)
        });
        let function = function.map_err(|_| {
            Error::input("the function is not one of this process")
                .under("function")
                .hint("make the scene again, from a dict with the function in it")
        })?;
        Ok(BuiltForce { force: Box::new(PythonLaw { function }), markers: build.between(&self.between)? })
    }
}

struct PythonLaw {
    function: Py<PyAny>,
}

impl PythonLaw {
    /// Calls the function. An exception is noted, and ends the run by a force that is no number.
    fn call<const D: usize>(&self, t: f64, r: &[f64; D], v: &[f64; D]) -> [f64; D] {
        let called = Python::attach(|py| {
            let found = self.function.call1(py, (t, PyTuple::new(py, r)?, PyTuple::new(py, v)?))?;
            let mut force = [0.0; D];
            let found = found.bind(py);
            let count = found.len()?;
            if count != D {
                let message = format!("the force has {count} components; in {D} dimensions it has {D}");
                return Err(pyo3::exceptions::PyValueError::new_err(message));
            }
            for (i, component) in force.iter_mut().enumerate() {
                *component = found.get_item(i)?.extract()?;
            }
            Ok(force)
        });
        called.unwrap_or_else(|error| {
            FAILURE.lock().unwrap_or_else(PoisonError::into_inner).get_or_insert(error);
            [f64::NAN; D]
        })
    }

    /// Returns the force with its derivatives: f + sum (df/dx) (x - x0), by central differences.
    fn force<S: Scalar, const D: usize>(&self, t: S, r: [S; D], v: [S; D]) -> [S; D] {
        let (t0, r0, v0) = (t.value(), r.map(|x| x.value()), v.map(|x| x.value()));
        let mut force = self.call(t0, &r0, &v0).map(S::constant);
        if TypeId::of::<S>() == TypeId::of::<f64>() {
            return force;
        }
        // Relative step at which errors of rounding and of the formula balance.
        let relative = f64::EPSILON.cbrt();
        let mut add = |x: S, moved: &dyn Fn(f64) -> [f64; D]| {
            let step = relative * x.value().abs().max(1.0);
            let above = moved(step);
            let below = moved(-step);
            let change = x - x.value();
            for (i, component) in force.iter_mut().enumerate() {
                *component += change * ((above[i] - below[i]) / (2.0 * step));
            }
        };
        add(t, &|step| self.call(t0 + step, &r0, &v0));
        for k in 0..D {
            add(r[k], &|step| self.call(t0, &beside(&r0, k, step), &v0));
            add(v[k], &|step| self.call(t0, &r0, &beside(&v0, k, step)));
        }
        force
    }
}

/// Returns `x` with component `k` moved by `step`.
fn beside<const D: usize>(x: &[f64; D], k: usize, step: f64) -> [f64; D] {
    from_fn(|i| if i == k { x[i] + step } else { x[i] })
}

impl<const D: usize> ForceKernel<D> for PythonLaw {
    fn act<S: Scalar>(&self, frames: &Motion<S, D>, time: Instant<S>, out: &mut [Wrench<S, D>]) -> Action<S> {
        let gap = sub(&frames[1].r, &frames[0].r);
        let force = self.force(time.t.x, gap.map(|r| r.x), gap.map(|r| r.d));
        out[1].force = force;
        out[0].force = force.map(|x| -x);
        Action::without_potential(crate::body::norm(&force))
    }
}
