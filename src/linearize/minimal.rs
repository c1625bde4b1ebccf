//! Minimal coordinates (MCS): the model in a chart of the directions that the constraints allow.

use super::changes::beside;
use super::entry::{LinearMatrices, LinearizationMethod};
use super::input_states::InputStates;
use super::perturbation::{ColumnBlocks, Perturbation};
use super::response::observe;
use super::{Chart, Coordinates, Matrix, Response, Variation};
use crate::error::Result;

/// The model in the states (z, y) of a chart.
pub struct Minimal {
    /// The chart.
    pub coordinates: Coordinates,
    /// The model.
    pub built: LinearMatrices,
}

/// Minimal coordinates: see [`minimal`].
pub(super) const MCS: LinearizationMethod = LinearizationMethod {
    name: "mcs",
    options: &[],
    build: |variation, request| {
        let chart = request.chart(variation);
        Ok(minimal(variation, &chart)?.built)
    },
};

/// The model in a chart: each state is a change (dq, dv) that the constraints allow, and a back-substitution gives its
/// dv' and dlambda. Exact in constant charts and in the intrinsic one. Gonzalez, Masarati, Cuadrado, Naya, J. Comput.
/// Nonlinear Dyn. 12 (2017), with the terms of a moving basis. Order: exact; cost: K, C, Gdd and 2 (n - m) + n_u
/// back-substitutions.
///
/// # Errors
/// Those of the chart; a state without determined accelerations.
pub fn minimal(variation: &mut Variation, chart: &Chart) -> Result<Minimal> {
    let coordinates = chart.at(variation)?;
    restrict(variation, coordinates, Response::exact)
}

/// Restricts the `response` of any formulation to the changes that the constraints allow: A = diag(B, B) A_u X0 and the
/// terms of a moving basis.
pub(super) fn restrict(
    variation: &mut Variation,
    coordinates: Coordinates,
    response: impl FnOnce(&mut Variation, &Perturbation) -> Result<Response>,
) -> Result<Minimal> {
    let Coordinates { r, b, turn, drift, lift, .. } = &coordinates;
    let k = coordinates.freedom();
    let n = r.ncols();
    let changes = coordinates.changes();
    let perturbation = Perturbation::new(variation, &changes, |i, j| lift.along(i, j));
    let response = response(variation, &perturbation)?;
    let ColumnBlocks { state, input_states, inputs } = perturbation.split(&(b * &response.vdot));
    let mut a = Matrix::zeros(k + n, k + n);
    a.view_mut((0, 0), (k, k)).copy_from(turn);
    a.view_mut((0, k), (k, k)).fill_with_identity();
    a.view_mut((k, 0), (n, k + n)).copy_from(&(state - beside(&drift[0], &drift[1])));
    let orders = variation.orders();
    let [upper, bent] = lift.terms(&orders);
    let mut driven = (input_states - bent).insert_rows(0, k, 0.0);
    driven.rows_mut(0, k).copy_from(&upper.rows(0, k));
    let outputs = observe(&variation.outputs()?, &perturbation, &response);
    let input_states = InputStates { orders, a: driven, c: outputs.input_states };
    let b = inputs.insert_rows(0, k, 0.0);
    let c = outputs.state;
    let d = outputs.inputs;
    let Coordinates { name: chart, states, .. } = coordinates.clone();
    let chart_of_model = Some(coordinates.clone());
    let built = LinearMatrices {
        chart,
        states,
        a,
        b,
        c,
        d,
        e: None,
        input_states,
        changes,
        coordinates: chart_of_model,
        infinite: 0,
    };
    Ok(Minimal { coordinates, built })
}
