//! Unconstrained coordinates (UCS): formulations without constraints, v' = a(q, v), linearized in all 2 n states.
//!
//! In addition to the 2 (n - m) physical eigenvalues each has 2 m spurious ones, of motions off the constraints.

mod baumgarte;
mod force_projection;
mod penalty;

pub(super) use baumgarte::BAUMGARTE;
pub(super) use force_projection::FORCE_PROJECTION;
pub(super) use penalty::{AUGMENTED_LAGRANGIAN, PENALTY};

use super::changes::directions;
use super::entry::{Linear, LinearMatrices};
use super::input_states::InputStates;
use super::minimal::restrict;
use super::model::REDUNDANT;
use super::perturbation::{ColumnBlocks, Perturbation};
use super::response::observe;
use super::{Changes, Matrix, Response, Variation};
use crate::error::Result;
use crate::method_spec::OptionDoc;

/// The option that all of them take.
const PROJECTED: OptionDoc = OptionDoc {
    name: "projected",
    about: "yes: only the changes that the constraints allow, in the chart, without spurious eigenvalues (default no)",
};

/// x' = A_u x with x = (dq, dv): dq' = dv - [v, dq], dv' by the formulation; or the same on the chart's tangent space,
/// where A = diag(B, B) A_u X0 is exact at any state for an exact formulation.
fn build(
    variation: &mut Variation,
    request: &Linear,
    response: impl FnOnce(&mut Variation, &Perturbation) -> Result<Response>,
) -> Result<LinearMatrices> {
    if request.method.one_of("projected", &["no", "yes"])? == "yes" {
        let coordinates = request.chart(variation).at(variation)?;
        return Ok(restrict(variation, coordinates, response)?.built);
    }
    let n = variation.velocities();
    let moving = variation.system().dimensions().moving();
    let changes = Changes::all(n, moving);
    let perturbation = Perturbation::new(variation, &changes, |_, _| None);
    let response = response(variation, &perturbation)?;
    let ColumnBlocks { state, input_states, inputs } = perturbation.split(&response.vdot);
    let mut a = Matrix::zeros(moving + n, moving + n);
    let rates = &changes.v - variation.bracket_with(&changes.q);
    a.rows_mut(0, moving).copy_from(&rates.rows(0, moving));
    a.rows_mut(moving, n).copy_from(&state);
    let b = inputs.insert_rows(0, moving, 0.0);
    let outputs = observe(&variation.outputs()?, &perturbation, &response);
    let driven = input_states.insert_rows(0, moving, 0.0);
    let input_states = InputStates { orders: variation.orders(), a: driven, c: outputs.input_states };
    let c = outputs.state;
    let d = outputs.inputs;
    let states = directions(variation.system(), &variation.point.q).states();
    let chart = REDUNDANT.to_string();
    Ok(LinearMatrices { chart, states, a, b, c, d, e: None, input_states, changes, coordinates: None, infinite: 0 })
}
