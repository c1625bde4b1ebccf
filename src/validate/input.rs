//! The response to a small pulse of an input.

use super::Decay;
use super::perturb::EPSILONS;
use super::subject::Subject;
use crate::error::Result;
use crate::linearize::flow::{Bundle, Pulse};
use crate::linearize::{Changes, Coordinates, Matrix, Minimal, State, beside};
use serde::Serialize;

/// Steps of the frozen model over a pulse: the error of its fourth-order method is below 1e-9.
const PULSE_STEPS: usize = 400;

/// Check of one input.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct InputCheck {
    /// Name of the input.
    pub input: String,
    /// Width of the pulse, s.
    pub width: f64,
    /// Sizes of the pulse, in the unit of the input.
    pub amplitudes: Vec<f64>,
    /// Errors of the variational equations with the input, at the end of the pulse.
    pub errors_ltv: Vec<f64>,
    /// Order of these errors in the size of the pulse.
    pub order_ltv: Decay,
    /// Relative error of x' = A x + B u at the end of the pulse; of a driver, which the pulse brings back, half-way.
    pub error_lti: f64,
}

/// Result of a pulse.
pub(super) enum Pulsed {
    /// It was compared with the model.
    Checked(InputCheck),
    /// It moves nothing that the model has states of.
    Nothing,
    /// The time was over before its end.
    TooSlow,
}

/// Compares a smooth pulse of each size with the model and its B.
pub(super) fn check(subject: &Subject, input: usize, name: String, width: f64) -> Result<Pulsed> {
    let Subject { system, start, model, carried, norm, .. } = subject;
    let pulse = Pulse { input, start: start.t, width };
    let lti = response(model, &pulse, width);
    // A unit pulse may move the mechanism by very much or little: sizes are chosen by its effect.
    let Changes { q: dq, v: dv } = model.coordinates.changes_of(&lti);
    // A driver may move much and leave little behind.
    let driven = model.coordinates.lift.p.column(input).amax();
    let size = dq.amax().max(dv.amax() / norm.rate).max(driven);
    if size == 0.0 || model.built.a.nrows() == 0 {
        return Ok(Pulsed::Nothing);
    }
    let n = start.v.len();
    let none = Matrix::zeros(n, 1);
    let amplitudes: Vec<f64> = EPSILONS.iter().map(|eps| eps / size).collect();
    let bundle = Bundle {
        columns: Changes { q: none.clone(), v: none },
        driven: vec![1.0 / size],
        members: vec![State::clone(start); EPSILONS.len()],
        pushes: amplitudes.clone(),
        pulse: Some(pulse),
        ..Bundle::of(start)
    };
    let half = start.t + 0.5 * width;
    let snapshots = carried.flow(&bundle, &[half, start.t + width])?;
    let charts = carried.charts(&snapshots)?;
    let ([middle, end], [chart, last]) = (&snapshots[..], &charts[..]) else { return Ok(Pulsed::TooSlow) };
    let errors_ltv = norm.errors(*system, end, &end.columns, &EPSILONS);
    let order_ltv = norm.order(*system, end, &EPSILONS, &errors_ltv);
    let (lti, reached) = if model.built.input_states.orders[input] == 2 {
        let displacement = pulse.jet(half)[0] / size;
        (response(model, &pulse, 0.5 * width), lifted(chart, &middle.columns, input, displacement))
    } else {
        (lti, last.states_of(&end.columns))
    };
    let freedom = chart.freedom();
    let error_lti = norm.states(freedom, &(&lti / size - &reached)) / norm.states(freedom, &reached);
    Ok(Pulsed::Checked(InputCheck { input: name, width, amplitudes, errors_ltv, order_ltv, error_lti }))
}

/// Returns the states (z, y) of changes while a displacement `u` of the driver `input` is in them.
fn lifted(chart: &Coordinates, changes: &Changes, input: usize, u: f64) -> Matrix {
    let shift = chart.lift.s.columns(input, 1) * u;
    chart.states_of(&Changes { q: changes.q.clone(), v: &changes.v - shift })
}

/// Returns the state of x' = A x + B u at the time `until` of a unit pulse from x = 0 (classical Runge-Kutta method).
/// Where a derivative of the pulse is the input of the model, its lower ones are the states of the input.
fn response(model: &Minimal, pulse: &Pulse, until: f64) -> Matrix {
    let states = &model.built.input_states;
    let order = states.orders[pulse.input];
    let first = states.orders[..pulse.input].iter().sum();
    let b = beside(&states.a.columns(first, order).clone_owned(), &model.built.b.columns(pulse.input, 1).clone_owned());
    let mut x = Matrix::zeros(model.built.a.nrows(), 1);
    let h = until / PULSE_STEPS as f64;
    let slope = |x: &Matrix, s: f64| -> Matrix {
        let inputs = Matrix::from_column_slice(order + 1, 1, &pulse.jet(pulse.start + s)[..=order]);
        &model.built.a * x + &b * inputs
    };
    for i in 0..PULSE_STEPS {
        let s = i as f64 * h;
        let k1 = slope(&x, s);
        let k2 = slope(&(&x + &k1 * (0.5 * h)), s + 0.5 * h);
        let k3 = slope(&(&x + &k2 * (0.5 * h)), s + 0.5 * h);
        let k4 = slope(&(&x + &k3 * h), s + h);
        x += (k1 + (k2 + k3) * 2.0 + k4) * (h / 6.0);
    }
    x
}
