//! Motions through positions where the constraints lose rank and branches of motion cross.

mod adaptive;
mod n_four_bar;
mod parallelogram;
mod reference;
mod slider_crank;
mod travel;

use crate::scenes::Run;
use holonom::method_spec::MethodSpec;
use holonom::simulate::Method;

/// A method with fixed steps by its names as on the command line.
fn fixed(formulation: &str, integrator: &str, projection: &str, step: f64) -> Method {
    let spec = |text: &str| MethodSpec::parse(text).unwrap();
    Method {
        formulation: spec(formulation),
        integrator: spec(integrator),
        projection: spec(projection),
        step: Some(step),
        ..Method::default()
    }
}

/// A method that adapts its steps to a tolerance, relative and absolute.
fn adaptive(formulation: &str, integrator: &str, projection: &str, tolerance: f64) -> Method {
    Method { rtol: tolerance, atol: tolerance, step: None, ..fixed(formulation, integrator, projection, 1.0) }
}

/// Largest error of a column over the rows after the start.
fn errors(run: &Run, name: &str, expected: impl Fn(usize) -> f64) -> f64 {
    let rows = run.column(name).into_iter().enumerate().skip(1);
    rows.map(|(row, found)| (found - expected(row)).abs()).fold(0.0, f64::max)
}

fn last(run: &Run, name: &str) -> f64 {
    *run.column(name).last().unwrap()
}
