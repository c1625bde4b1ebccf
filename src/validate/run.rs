//! The validation at one state.

use super::frozen::frozen;
use super::input::{self, Pulsed};
use super::measured::{Along, Measured, measure};
use super::passage::passage;
use super::perturb::{Norm, Speed};
pub use super::regular::Event;
use super::regular::{End, end};
use super::sequence::sequence;
use super::{Decay, Deviation, Entry, Frozen, InputCheck, PerturbationSequence, Settings};
use crate::error::{Result, percent, short_list, significant};
use crate::linearize::{Built, Carried, Chart, State, Variation, minimal, refuse_large};
use crate::system::{Column, MechanicalSystem};
use crate::tolerances;
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
    /// The first change of form of the equations, short of which they were followed.
    #[doc(hidden)]
    pub event: Option<Event>,
    /// Rate by which velocities are divided to compare them with positions, 1/s.
    pub rate: f64,
    /// Result for each direction.
    pub sequences: Vec<PerturbationSequence>,
    /// Comparison of exp(A h) with the state-transition matrix.
    #[doc(hidden)]
    pub frozen: Frozen,
    /// A, B, C and D against measured ones.
    #[doc(hidden)]
    pub measured: Measured,
    /// Result for each input; empty if inputs are not checked.
    #[doc(hidden)]
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
    /// True if no measured entry of A, B, C and D is off by more than three uncertainties.
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
    validate_changed(system, start, settings, is_over, |_| {})
}

/// The same with a model that was changed, to test that such changes are found.
///
/// # Errors
/// As of [`validate_until`].
pub fn validate_changed(
    system: &dyn MechanicalSystem,
    start: &State,
    settings: &Settings,
    is_over: &dyn Fn() -> bool,
    change: impl FnOnce(&mut Built),
) -> Result<Validation> {
    refuse_large(system.dimensions().v)?;
    let mut variation = Variation::new(system, start.t, &start.q, &start.v)?;
    let chart = settings.chart.clone().unwrap_or_else(|| Chart::preferred(&mut variation));
    let mut model = minimal(&mut variation, &chart)?;
    let name = model.coordinates.name.clone();
    // The plain projection has no chart that follows the motion; its states are those of the mass-orthogonal one.
    let is_projected = chart == Chart::Frozen;
    let chart = if is_projected { Chart::MassOrthogonal } else { chart };
    let carried = Carried::new(&mut variation, &chart, is_over)?;
    model.coordinates = carried.start.clone();
    let speed = Speed::of(&model)?;
    change(&mut model.built);
    let norm = Norm { rate: speed.usual };
    let wished = settings.horizon.unwrap_or(speed.period());
    let End { singular, event } = end(system, start, wished)?;
    let before = |t: f64, part: f64| part * (t - start.t);
    // Nearer, terms of second order grow with the inverse of the distance.
    let regular = singular.map_or(wished, |t| before(t, 0.5));
    let event = event.filter(|event| event.t - start.t < regular);
    // Small perturbations are then still before it.
    let smooth = event.as_ref().map_or(regular, |event| before(event.t, 0.9));
    let followed = regular.min(smooth);
    let through = event.as_ref().map(|_| start.t + regular);
    let mut sequences = Vec::new();
    let mut cut = Vec::new();
    for direction in &settings.directions {
        if is_over() && !sequences.is_empty() {
            cut.push(format!("no motion was followed along {}", direction.name()));
            continue;
        }
        let x0 = direction.state(&model.coordinates, norm.rate)?;
        if model.built.a.nrows() > 0 {
            let own = (direction.name(), followed);
            let found = sequence(system, start, (&model, &carried, &norm), (&x0, &speed), own)?;
            let passage = through.and_then(|t| passage(system, start, (&model, &norm), (&x0, t), is_over));
            sequences.push(PerturbationSequence { passage, ..found });
        }
    }
    cut.extend(sequences.iter().filter_map(|sequence| shortened(sequence, followed)));
    let longest = followed.min(1.0 / speed.fastest.max(f64::MIN_POSITIVE));
    let (frozen, mut charts) = frozen(start, &carried, (&model.built.a, &speed), longest)?;
    charts.reverse();
    let steps: Vec<f64> = frozen.steps.iter().rev().copied().collect();
    let along = Along { steps: &steps, charts: &charts };
    let scale = (norm.rate, settings.inputs);
    let found = measure((system, start), (&mut variation, &model), &along, scale, is_over)?;
    cut.extend(found.is_none().then(|| "A, B, C and D were not compared".to_string()));
    let measured = found.unwrap_or_default();
    let mut inputs = Vec::new();
    let mut unchecked = Vec::new();
    for (index, Column { name, .. }) in
        system.facts().inputs.clone().into_iter().enumerate().filter(|_| settings.inputs)
    {
        let pulse = (index, name.clone());
        match input::check(system, start, (&model, &carried, &norm), pulse, 0.1 * followed)? {
            Pulsed::Checked(found) => inputs.push(found),
            Pulsed::Nothing => unchecked.push(name),
            Pulsed::TooSlow => cut.push(format!("the input `{name}` was not checked")),
        }
    }
    let found = Evidence { sequences: &sequences, inputs: &inputs, measured: &measured, event: &event, is_projected };
    let verdict = judge(&found);
    Ok(Validation {
        t: start.t,
        chart: name,
        followed: sequences.iter().map(|sequence| reached(sequence, followed)).reduce(f64::max).unwrap_or(followed),
        singular,
        event,
        rate: norm.rate,
        sequences,
        frozen,
        measured,
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

/// What the verdict is made of.
struct Evidence<'e> {
    sequences: &'e [PerturbationSequence],
    inputs: &'e [InputCheck],
    measured: &'e Measured,
    event: &'e Option<Event>,
    /// True for the plain projection, which belongs to no chart.
    is_projected: bool,
}

fn judge(evidence: &Evidence) -> Verdict {
    let rows = evidence.sequences.iter().map(|sequence| (&sequence.direction, &sequence.order_ltv));
    let rows = rows.chain(evidence.inputs.iter().map(|input| (&input.input, &input.order_ltv)));
    let orders = rows.clone().map(|(_, decay)| decay);
    let ltv = orders.clone().all(is_second);
    let lti = evidence.measured.all().all(|(_, deviation)| deviation.is_right);
    let lowest = orders.clone().filter_map(|decay| decay.order).fold(f64::INFINITY, f64::min);
    let order = if lowest.is_finite() { format!("order {lowest:.2}") } else { "exact to rounding".to_string() };
    let untold: Vec<String> = rows.filter(|(_, decay)| is_untold(decay)).map(|(name, _)| name.clone()).collect();
    let are_others_right = orders.filter(|decay| !is_untold(decay)).all(is_second);
    let entries: Vec<String> = evidence.measured.all().map(|(name, deviation)| told(name, deviation)).collect();
    let entries = if entries.is_empty() { String::new() } else { format!("{}; ", entries.join(", ")) };
    let text = match (ltv, lti) {
        (false, _) if are_others_right => format!(
            "not told: along {} too few sizes lie between rounding and what leaves the linear model; a shorter --horizon \
             may tell",
            short_list(&untold)
        ),
        (true, true) => format!("right: {entries}perturbed simulations follow the linear model ({order} in eps)"),
        (true, false) if evidence.is_projected => {
            format!(
                "frozen, not comparable with the motion: {entries}the variational equations are right ({order} in eps)"
            )
        }
        (true, false) => format!("wrong: {entries}the variational equations are right ({order} in eps)"),
        (false, _) => format!("wrong, or too near to rounding to tell: {entries}{order} in eps, where 2 is expected"),
    };
    let text = if ltv { text + &beyond_event(evidence) + &frozen_errors(evidence) } else { text };
    Verdict { ltv, lti, text }
}

fn is_untold(decay: &Decay) -> bool {
    !decay.is_exact && decay.order.is_none()
}

/// True if errors fall as the square of the size, or are rounding.
fn is_second(decay: &Decay) -> bool {
    decay.is_exact || decay.order.is_some_and(|order| order > 2.0 - tolerances::ORDER_SLACK)
}

/// Says where the equations change their form within the horizon, and whether small changes were followed through. The
/// linear model ends there, so that this is no part of the verdict on it.
fn beyond_event(evidence: &Evidence) -> String {
    let Some(Event { t, owner }) = evidence.event else { return String::new() };
    let place = format!("t = {} s, where {owner} changes its form", significant(*t, 6));
    let passages: Vec<&Decay> =
        evidence.sequences.iter().filter_map(|sequence| Some(&sequence.passage.as_ref()?.order)).collect();
    if passages.is_empty() || passages.iter().any(|decay| is_untold(decay)) {
        return format!("; the horizon ends at {place}");
    }
    let lowest = passages.iter().filter_map(|decay| decay.order).reduce(f64::min);
    let order = lowest.map_or("exact to rounding".to_string(), |order| format!("order {order:.2} in eps"));
    if passages.iter().all(|decay| is_second(decay)) {
        format!("; through {place}, they follow the variational equations with their jump ({order})")
    } else {
        format!("; through {place}, they do not follow the variational equations with their jump ({order})")
    }
}

/// Says how far a matrix is right, or which entry is wrong.
fn told(name: char, deviation: &Deviation) -> String {
    let Deviation { difference, uncertainty, relative, relative_uncertainty, entry, is_right } = deviation;
    if *is_right {
        return format!("{name} right to {relative:.0e} (can be told to {relative_uncertainty:.0e})");
    }
    let Entry { row, column, model, .. } = entry;
    format!(
        "{name} wrong by {} in row `{row}`, column `{column}`, which is {} (can be told to {uncertainty:.0e})",
        significant(*difference, 3),
        significant(*model, 3)
    )
}

/// Says how far the frozen model leaves the motion where it does.
fn frozen_errors(evidence: &Evidence) -> String {
    let far = |error: &f64| *error > tolerances::WRONG_MOTION;
    let motions = evidence.sequences.iter().filter_map(|sequence| {
        let error = sequence.drift_lti.iter().copied().fold(0.0, f64::max);
        Some(format!("{} along {}", percent(error), sequence.direction)).filter(|_| far(&error))
    });
    let pulses = evidence.inputs.iter().filter(|input| far(&input.error_lti));
    let pulses = pulses.map(|input| format!("{} after the pulse of {}", percent(input.error_lti), input.input));
    let all: Vec<String> = motions.chain(pulses).collect();
    if all.is_empty() { String::new() } else { format!("; frozen, it is off by up to {}", short_list(&all)) }
}
