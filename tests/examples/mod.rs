//! Examples to copy: each file stands alone, and ends with a test that runs it.

mod compared_methods;
mod linear_model;
mod many_runs;
pub mod own_body;
mod own_equations;
pub mod own_force;
pub mod own_formulation;
pub mod own_integrator;
pub mod own_joint;
pub mod own_lagrangian;
mod own_projection;
mod own_simplification;
mod own_tableau;
mod scene_in_code;
mod state_feedback;

use holonom::analysis::Recorder;
use holonom::simulate::{Method, Span, simulate};

/// What a method makes of a swing of the pendulum in `own_equations.rs`: the error of its energy, as part of that converted.
fn swing(method: &Method) -> holonom::Result<f64> {
    let system = own_equations::Pendulum { mass: 2.0, length: 0.5 };
    let mut recorder = Recorder::new(&system);
    let span = Span { start: 0.0, end: 2.0, output_step: 0.1 };
    let outcome = simulate(&system, method, span, (&[0.5, 0.0], &[0.0, 0.0]), &mut recorder)?;
    assert_eq!(outcome.failure, None);
    Ok(recorder.finish().energy.and_then(|energy| energy.relative_max_error).expect("the pendulum has an energy"))
}
