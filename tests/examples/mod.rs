//! Examples to copy: each file stands alone, and ends with a test that runs it. Those with a `main` are examples of
//! Cargo, too.

mod compared_methods;
mod linear_model;
mod many_runs;
pub mod own_body;
pub mod own_equations;
pub mod own_force;
pub mod own_formulation;
pub mod own_integrator;
pub mod own_joint;
pub mod own_lagrangian;
pub mod own_projection;
mod own_simplification;
mod own_tableau;
mod scene_in_code;
mod state_feedback;

use holonom::prelude::*;

/// What a method makes of a swing of the pendulum in `own_equations.rs`: the error of its energy, as part of that converted.
fn swing(method: &Method) -> holonom::Result<f64> {
    let system = own_equations::Pendulum { mass: 2.0, length: 0.5 };
    Ok(simulate(&system, method, &([0.5, 0.0], [0.0, 0.0]), 0.0..2.0)?.record.energy_error())
}
