//! The validation at one state.

use super::frozen::frozen;
use super::input::{self, Pulsed};
use super::perturb::{Norm, Speed};
use super::regular::first_singular;
use super::sequence::sequence;
use super::{Decay, Frozen, InputCheck, PerturbationSequence, Settings};
use crate::error::{Result, short_list};
use crate::linearize::{Carried, Chart, State, Variation, minimal, refuse_large};
use crate::system::{Column, MechanicalSystem};
use crate::tolerances::linearize as tolerances;
use serde::Serialize;

/// Comparison of the linear model at a state with simulations.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Validation {
    /// Time of the state, s.
    pub t: f64,
    /// Name of the chart.
    pub chart: String,
    /// Time over which the perturbed motions were followed, s.
    pub followed: f64,
    /// Time of the first singular state of the motion, half way to which they were followed, s.
    pub singular: Option<f64>,
    /// Rate by which velocities are divided to compare them with positions, 1/s.
    pub rate: f64,
    /// Result for each direction.
    pub sequences: Vec<PerturbationSequence>,
    /// Comparison of exp(A h) with the state-transition matrix.
    pub frozen: Frozen,
    /// Result for each input; empty if inputs are not checked.
    pub inputs: Vec<InputCheck>,
    /// Names of inputs that move nothing that the model has states of, and are not checked.
    pub unchecked: Vec<String>,
    /// What was not done for want of time, a sentence each.
    pub cut: Vec<String>,
    /// Conclusion from the orders.
    pub verdict: Verdict,
}

/// Conclusion of a validation.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Verdict {
    /// True if the variational equations have order 2 (or are exact) for each direction and input.
    pub ltv: bool,
    /// True if A in its chart has order 2 or more in h (or is exact).
    pub lti: bool,
    /// The conclusion as a sentence.
    pub text: String,
}

/// Compares the model at a state with perturbed simulations.
///
/// # Errors
/// A chart that does not exist at the state; a motion that cannot go on.
pub fn validate(system: &dyn MechanicalSystem, start: &State, settings: &Settings) -> Result<Validation> {
    validate_until(system, start, settings, &|| false)
}

/// The same until `is_over`: what is known by then is the result, and [`Validation::cut`] says what is missing.
///
/// # Errors
/// As of [`validate`], and where nothing is known by then.
pub fn validate_until(
    system: &dyn MechanicalSystem,
    start: &State,
    settings: &Settings,
    is_over: &dyn Fn() -> bool,
) -> Result<Validation> {
    refuse_large(system.dimensions().v)?;
    let mut variation = Variation::new(system, start.t, &start.q, &start.v)?;
    let chart = settings.chart.clone().unwrap_or_else(|| Chart::preferred(&mut variation));
    let mut model = minimal(&mut variation, &chart)?;
    let name = model.coordinates.name.clone();
    // The plain projection has no chart that follows the motion; its states are those of the mass-orthogonal one.
    let chart = if chart == Chart::Frozen { Chart::MassOrthogonal } else { chart };
    let carried = Carried::new(&mut variation, &chart, is_over)?;
    model.coordinates = carried.start.clone();
    let speed = Speed::of(&model)?;
    let norm = Norm { rate: speed.usual };
    let wished = settings.horizon.unwrap_or(speed.period());
    let singular = first_singular(system, start, wished)?;
    let followed = singular.map_or(wished, |t| tolerances::BEFORE_SINGULAR * (t - start.t));
    let mut sequences = Vec::new();
    let mut cut = Vec::new();
    for direction in &settings.directions {
        if is_over() && !sequences.is_empty() {
            cut.push(format!("no motion was followed along {}", direction.name()));
            continue;
        }
        let x0 = direction.state(&model.coordinates, norm.rate)?;
        if model.built.a.nrows() > 0 {
            sequences.push(sequence(system, start, (&model, &carried, &norm), &x0, (direction.name(), followed))?);
        }
    }
    cut.extend(sequences.iter().filter_map(|sequence| shortened(sequence, followed)));
    let longest = followed.min(1.0 / speed.fastest.max(f64::MIN_POSITIVE));
    let frozen = frozen(start, &carried, (&model.built.a, &speed), longest)?;
    let mut inputs = Vec::new();
    let mut unchecked = Vec::new();
    for (index, Column { name, .. }) in system.inputs().into_iter().enumerate().filter(|_| settings.inputs) {
        let pulse = (index, name.clone());
        match input::check(system, start, (&model, &carried, &norm), pulse, 0.1 * followed)? {
            Pulsed::Checked(found) => inputs.push(found),
            Pulsed::Nothing => unchecked.push(name),
            Pulsed::TooSlow => cut.push(format!("the input `{name}` was not checked")),
        }
    }
    let verdict = judge(&sequences, &frozen, &inputs);
    Ok(Validation {
        t: start.t,
        chart: name,
        followed: sequences.iter().map(|sequence| reached(sequence, followed)).reduce(f64::max).unwrap_or(followed),
        singular,
        rate: norm.rate,
        sequences,
        frozen,
        inputs,
        unchecked,
        cut,
        verdict,
    })
}

/// The time over which a motion was followed: all that was asked for, unless the budget ended it.
fn reached(sequence: &PerturbationSequence, asked: f64) -> f64 {
    sequence.times.last().copied().filter(|t| *t < 0.999 * asked).unwrap_or(asked)
}

/// A sentence on a motion that was not followed for all of the time.
fn shortened(sequence: &PerturbationSequence, asked: f64) -> Option<String> {
    let came = Some(reached(sequence, asked)).filter(|came| *came < asked)?;
    Some(format!("along {} the motion was followed for {came:.2e} s of {asked:.2e} s", sequence.direction))
}

fn judge(sequences: &[PerturbationSequence], frozen: &Frozen, inputs: &[InputCheck]) -> Verdict {
    let rows = sequences.iter().map(|sequence| (&sequence.direction, &sequence.order_ltv));
    let rows = rows.chain(inputs.iter().map(|input| (&input.input, &input.order_ltv)));
    let orders = rows.clone().map(|(_, decay)| decay);
    let passes =
        |decay: &Decay| decay.is_exact || decay.order.is_some_and(|order| order > 2.0 - tolerances::ORDER_SLACK);
    let steep = |decay: &Decay| decay.is_exact || decay.order.is_some_and(|order| order > tolerances::STEEP_ENOUGH);
    let ltv = orders.clone().all(passes);
    let lti = steep(&frozen.decay);
    let lowest = orders.clone().filter_map(|decay| decay.order).fold(f64::INFINITY, f64::min);
    let order = if lowest.is_finite() { format!("order {lowest:.2}") } else { "exact to rounding".to_string() };
    let is_untold = |decay: &Decay| !decay.is_exact && decay.order.is_none();
    let untold: Vec<String> = rows.filter(|(_, decay)| is_untold(decay)).map(|(name, _)| name.clone()).collect();
    let are_others_right = orders.filter(|decay| !is_untold(decay)).all(passes);
    let text = match (ltv, lti) {
        (false, _) if are_others_right => format!(
            "not told: along {} too few sizes lie between rounding and what leaves the linear model; a shorter --horizon \
             may tell",
            short_list(&untold)
        ),
        (true, true) => format!("right: perturbed simulations follow the linear model ({order} in eps)"),
        (true, false) => {
            format!("the variational equations are right ({order} in eps), but A misses terms of its chart")
        }
        (false, _) => format!("wrong, or too near to rounding to tell: {order} in eps, where 2 is expected"),
    };
    Verdict { ltv, lti, text }
}
