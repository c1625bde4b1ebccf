//! The validation at one state.

use super::frozen::frozen;
use super::input::{self, Pulsed};
use super::measured::{Along, Measured, measure};
use super::passage::passage;
pub use super::regular::Event;
use super::regular::{SmoothEnd, end};
use super::sequence::sequence;
use super::subject::Subject;
use super::{Decay, Deviation, Direction, Frozen, InputCheck, MatrixEntry, PerturbationSequence, Settings};
use crate::error::{Result, percent, short_list, significant};
use crate::linearize::{Coordinates, LinearMatrices, State, Variation, refuse_large};
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
    change: impl FnOnce(&mut LinearMatrices),
) -> Result<Validation> {
    refuse_large(system.dimensions().v)?;
    let mut variation = Variation::new(system, start.t, &start.q, &start.v)?;
    let subject = Subject::new(&mut variation, start, settings, is_over, change)?;
    let reach = Reach::new(&subject, settings)?;
    let mut cut = Vec::new();
    let sequences = sequences(&subject, &settings.directions, &reach, &mut cut)?;
    let longest = reach.followed.min(1.0 / subject.speed.fastest.max(f64::MIN_POSITIVE));
    let (frozen, charts) = frozen(&subject, longest)?;
    let measured = measured(&subject, &mut variation, &frozen.steps, charts, settings.inputs)?;
    let is_compared = measured.is_some();
    cut.extend((!is_compared).then(|| NOT_COMPARED.to_string()));
    let measured = measured.unwrap_or_default();
    let mut unchecked = Vec::new();
    let inputs =
        if settings.inputs { inputs(&subject, 0.1 * reach.followed, &mut unchecked, &mut cut)? } else { Vec::new() };
    let Reach { followed, singular, event, .. } = reach;
    let is_projected = subject.is_projected;
    let evidence = Evidence {
        sequences: &sequences,
        inputs: &inputs,
        measured: &measured,
        event: &event,
        is_projected,
        is_compared,
    };
    let verdict = judge(&evidence);
    Ok(Validation {
        t: start.t,
        chart: subject.chart,
        followed: sequences.iter().map(|sequence| reached(sequence, followed)).reduce(f64::max).unwrap_or(followed),
        singular,
        event,
        rate: subject.norm.rate,
        sequences,
        frozen,
        measured,
        inputs,
        unchecked,
        cut,
        verdict,
    })
}

/// How far motions are followed.
struct Reach {
    /// Time over which they are followed, s.
    followed: f64,
    /// Time of the first singular state, s.
    singular: Option<f64>,
    /// The first change of form before it.
    event: Option<Event>,
    /// Time at which motions that passed the event are compared, s.
    through: Option<f64>,
}

impl Reach {
    fn new(subject: &Subject, settings: &Settings) -> Result<Self> {
        let start = subject.start;
        let wished = settings.horizon.unwrap_or(subject.speed.period());
        let SmoothEnd { singular, event } = end(subject.system, start, wished)?;
        // Nearer, terms of second order grow with the inverse of the distance.
        let regular = singular.map_or(wished, |t| 0.5 * (t - start.t));
        let event = event.filter(|event| event.t - start.t < regular);
        // Small perturbations are then still before it.
        let smooth = event.as_ref().map_or(regular, |event| 0.9 * (event.t - start.t));
        let through = event.as_ref().map(|_| start.t + regular);
        Ok(Reach { followed: regular.min(smooth), singular, event, through })
    }
}

/// Returns the perturbed motions along each direction. Adds to `cut` what was not followed for want of time.
fn sequences(
    subject: &Subject,
    directions: &[Direction],
    reach: &Reach,
    cut: &mut Vec<String>,
) -> Result<Vec<PerturbationSequence>> {
    let mut sequences = Vec::new();
    for direction in directions {
        if (subject.is_over)() && !sequences.is_empty() {
            cut.push(format!("no motion was followed along {}", direction.name()));
            continue;
        }
        let x0 = direction.state(&subject.model.coordinates, subject.norm.rate)?;
        if subject.model.built.a.nrows() > 0 {
            let sequence = sequence(subject, &x0, direction.name(), reach.followed)?;
            let passage = reach.through.and_then(|t| passage(subject, &x0, t));
            sequences.push(PerturbationSequence { passage, ..sequence });
        }
    }
    cut.extend(sequences.iter().filter_map(|sequence| shortened(sequence, reach.followed)));
    Ok(sequences)
}

/// Measures A, B, C and D with the `charts` at increasing steps; none if the time is over before.
fn measured(
    subject: &Subject,
    variation: &mut Variation,
    steps: &[f64],
    mut charts: Vec<Coordinates>,
    has_inputs: bool,
) -> Result<Option<Measured>> {
    charts.reverse();
    let steps: Vec<f64> = steps.iter().rev().copied().collect();
    measure(subject, variation, &Along { steps: &steps, charts: &charts }, has_inputs)
}

/// Returns the check of each input by a pulse of this width. Adds to `unchecked` the names of inputs that move nothing,
/// and to `cut` those for which the time was over.
fn inputs(
    subject: &Subject,
    width: f64,
    unchecked: &mut Vec<String>,
    cut: &mut Vec<String>,
) -> Result<Vec<InputCheck>> {
    let mut inputs = Vec::new();
    for (index, Column { name, .. }) in subject.system.facts().inputs.iter().enumerate() {
        match input::check(subject, index, name.clone(), width)? {
            Pulsed::Checked(check) => inputs.push(check),
            Pulsed::Nothing => unchecked.push(name.clone()),
            Pulsed::TooSlow => cut.push(format!("the input `{name}` was not checked")),
        }
    }
    Ok(inputs)
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
    /// False if the time was over before A, B, C and D were measured.
    is_compared: bool,
}

const NOT_COMPARED: &str = "A, B, C and D were not compared";

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
    let mut entries: Vec<String> = evidence.measured.all().map(|(name, deviation)| told(name, deviation)).collect();
    entries.extend((!evidence.is_compared).then(|| NOT_COMPARED.to_string()));
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
    let MatrixEntry { row, column, model, .. } = entry;
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
