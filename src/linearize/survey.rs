//! Linear models at many states: along a motion, or over a parameter.

use super::found::StateResult;
use super::method::{build, solve};
use super::states::{Walk, follow};
use super::thresholds::{self, Threshold};
use super::variants::{At, SLOPE_STEP, Sensitivity, VariantModels, Variants};
use super::{Branch, Linear, LinearizationPoint, LociPoint, Operating, State, Variation, track};
use crate::error::{Error, Result, Warning};
use crate::prepared::Model;
use crate::sweep::Range;
use crate::tolerances;
use rayon::prelude::*;
use std::collections::BTreeSet;

/// Eigenvalues at many states, as branches.
#[derive(Clone, Debug)]
pub struct Loci {
    /// Time or parameter.
    pub along: LociVariable,
    /// Method of the first state that has a model, as in [`LinearModel`](super::LinearModel); empty where none has.
    pub method: String,
    /// Chart of the same state.
    pub chart: String,
    /// All times or values of the parameter, in their order.
    pub places: Vec<f64>,
    /// Those with a linear model.
    #[doc(hidden)]
    pub reached: Vec<Reached>,
    /// Those without one.
    #[doc(hidden)]
    pub gaps: Vec<Gap>,
    /// Branches, physical ones first.
    pub branches: Vec<Branch>,
    /// Values of a parameter at which eigenvalues meet or cross the imaginary axis.
    pub thresholds: Vec<Threshold>,
    /// Derivatives of the eigenvalues with respect to a parameter at the scene's own value, or at the nearest of the range.
    #[doc(hidden)]
    pub sensitivity: Option<Sensitivity>,
    /// Warnings about the states, each once.
    pub doubts: Vec<Warning>,
}

impl Loci {
    /// The branches by the names of their modes, without those that are conjugate to others everywhere.
    pub fn named(&self) -> impl Iterator<Item = (String, &Branch)> {
        let is_upper = |branch: &&Branch| branch.points.iter().any(|(_, value)| value.im >= 0.0);
        let named = |(i, branch)| (format!("mode{}", i + 1), branch);
        self.branches.iter().filter(is_upper).enumerate().map(named)
    }
}

/// Variable that the eigenvalues are functions of.
#[derive(Clone, Debug, PartialEq)]
pub enum LociVariable {
    /// Time, s.
    Time,
    /// A parameter of the scene, with its range.
    Parameter(Range),
}

/// A time or value with a linear model.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
pub struct Reached {
    /// Time, s, or value of the parameter.
    pub at: f64,
    /// True if the state is an equilibrium.
    pub equilibrium: bool,
    /// Speed of a steady rotation, in whose axes the state is an equilibrium, rad/s.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub turning: Option<f64>,
}

/// A time or value without a linear model, and the reason.
#[derive(Clone, Debug, PartialEq)]
pub struct Gap {
    /// Time, s, or value of the parameter.
    pub at: f64,
    /// Reason.
    pub error: Error,
}

type TimedResult = (f64, Result<StateResult>);

/// Returns the eigenvalues at `times` (increasing) of the scene's motion; `progress` is called for each. Where the
/// motion cannot go on, the later times are gaps. Where the matching of modes is not clear, states between the times
/// are added for it.
pub fn loci_along<'a>(prepared: &'a Model, request: &Linear, times: &[f64], progress: impl Fn() + Sync) -> Loci {
    let mut walk = Walk::new(prepared);
    let mut stopped = None;
    let mut go_to = |t: f64| match &stopped {
        Some(error) => Err(Error::clone(error)),
        None => walk.to(t).inspect_err(|error| stopped = Some(error.clone())),
    };
    let states: Vec<(f64, Result<State>)> = times.iter().map(|&t| (t, go_to(t))).inspect(|_| progress()).collect();
    let steps: Vec<f64> = times.get(1).map(|second| SLOPE_STEP * (second - times[0])).into_iter().collect();
    let outcome = |previous: &mut Option<Variation<'a>>, (t, state): (f64, Result<State>)| {
        (t, state.and_then(|state| eigenvalues_after(previous, prepared, state, t, request, &steps)))
    };
    let outcomes: Vec<TimedResult> = states.into_par_iter().map_init(|| None, outcome).collect();
    let between = |before: &StateResult, t: f64| {
        let state = follow(prepared, &before.state, t)?;
        eigenvalues_at(&mut state.variation(prepared)?, prepared, state, t, request, &[])
    };
    collect(LociVariable::Time, outcomes, between)
}

/// Returns the eigenvalues at the next state, with the variation of the previous one where there is one. Leaves its own
/// variation there.
fn eigenvalues_after<'a>(
    previous: &mut Option<Variation<'a>>,
    prepared: &'a Model,
    state: State,
    t: f64,
    request: &Linear,
    steps: &[f64],
) -> Result<StateResult> {
    let mut variation = if let Some(mut variation) = previous.take() {
        variation.operate_at(state.t, &state.q, &state.v)?;
        variation
    } else {
        state.variation(prepared)?
    };
    let eigenvalues = eigenvalues_at(&mut variation, prepared, state, t, request, steps);
    *previous = Some(variation);
    eigenvalues
}

/// Returns the eigenvalues at a state of the motion, with their derivatives by differences of the model over these
/// steps.
fn eigenvalues_at(
    variation: &mut Variation,
    prepared: &Model,
    state: State,
    t: f64,
    request: &Linear,
    steps: &[f64],
) -> Result<StateResult> {
    let solved = solve(variation, request)?;
    let point = variation.point.clone();
    let slopes = solved.slopes(steps, |step| {
        move_along(variation, &point, step)?;
        build(variation, request)
    });
    if !steps.is_empty() {
        variation.operate_at(point.t, &point.q, &point.v)?;
    }
    let model = solved.finish(variation, request);
    Ok(StateResult::new(&Operating::moving(prepared, state), variation, t, model).with_slopes(slopes))
}

/// Operates a step along the tangent of the motion.
fn move_along(variation: &mut Variation, point: &LinearizationPoint, step: f64) -> Result<()> {
    let system = variation.system();
    let moved = |x: &[f64], rate: &[f64]| -> Vec<f64> { x.iter().zip(rate).map(|(x, rate)| x + step * rate).collect() };
    let mut rate = vec![0.0; point.q.len()];
    system.rate(&point.q, &point.v, &mut rate);
    let mut q = moved(&point.q, &rate);
    system.normalize(&mut q);
    variation.operate_at(point.t + step, &q, &moved(&point.v, &point.vdot))
}

/// Returns the eigenvalues of a scene for each value of a parameter; `progress` is called for each. Values without a
/// state or a model are gaps.
///
/// # Errors
/// A parameter that the scene does not have.
pub fn loci_over(variants: &Variants, at: At, request: &Linear, progress: impl Fn() + Sync) -> Result<Loci> {
    let own = variants.family.own_value(&variants.range.parameter)?;
    let models = VariantModels { variants, at, request };
    let values = variants.range.values();
    let outcomes: Vec<TimedResult> = if at == At::Equilibrium {
        let distance = |i: &usize| (values[*i] - own).abs();
        let middle = (0..values.len()).min_by(|a, b| distance(a).total_cmp(&distance(b))).unwrap_or(0);
        let (before, after) = values.split_at(middle);
        let down = || at_rest_along(&models, before.iter().rev(), values.get(middle), &progress);
        let up = || at_rest_along(&models, after.iter(), None, &progress);
        let (down, up) = rayon::join(down, up);
        down.into_iter().rev().chain(up).collect()
    } else {
        let outcome = |&value: &f64| (value, models.found(value, None, &models.steps(value)));
        values.par_iter().map(outcome).inspect(|_| progress()).collect()
    };
    let between = |before: &StateResult, value: f64| models.found(value, Some(&before.state.q), &[]);
    let nearest = outcomes.iter().filter_map(|(_, outcome)| outcome.as_ref().ok());
    let nearest = nearest.min_by(|a, b| (a.sample.at - own).abs().total_cmp(&(b.sample.at - own).abs()));
    let sensitivity = nearest.and_then(|nearest| models.sensitivity(own, Some(&nearest.state.q)));
    let located = |pair: &[TimedResult]| match (&pair[0].1, &pair[1].1) {
        // At a time each model takes a simulation.
        (Ok(before), Ok(after)) if !matches!(at, At::Time(_)) => thresholds::between(before, after, &between),
        _ => Vec::new(),
    };
    let thresholds: Vec<Vec<Threshold>> = outcomes.par_windows(2).map(located).collect();
    let loci = collect(LociVariable::Parameter(variants.range.clone()), outcomes, between);
    Ok(Loci { thresholds: thresholds.concat(), sensitivity, ..loci })
}

/// Equilibria from value to value, the first from that of the scene at the value `behind`.
fn at_rest_along<'v>(
    models: &VariantModels,
    values: impl Iterator<Item = &'v f64>,
    behind: Option<&f64>,
    progress: &(impl Fn() + Sync),
) -> Vec<TimedResult> {
    let mut guess = behind.and_then(|&value| models.equilibrium(value).ok());
    let mut outcomes = Vec::new();
    for &value in values {
        let outcome = models.found(value, guess.as_deref(), &models.steps(value));
        if let Ok(found) = &outcome {
            guess = Some(found.state.q.clone());
        }
        outcomes.push((value, outcome));
        progress();
    }
    outcomes
}

/// Returns states between two, as many as it takes to match the modes.
fn refined(
    before: &StateResult,
    after: &StateResult,
    halvings: usize,
    between: &impl Fn(&StateResult, f64) -> Result<StateResult>,
) -> Vec<LociPoint> {
    if halvings == 0 || before.sample.leads_clearly_to(&after.sample) {
        return Vec::new();
    }
    // Where there is no model between, the modes are matched as they are.
    let Ok(middle) = between(before, 0.5 * (before.sample.at + after.sample.at)) else { return Vec::new() };
    let mut samples = refined(before, &middle, halvings - 1, between);
    let rest = refined(&middle, after, halvings - 1, between);
    samples.push(middle.sample);
    samples.extend(rest);
    samples
}

/// Returns branches and gaps of the outcomes; `between` gives the state that follows one, at another time or value.
fn collect(
    along: LociVariable,
    outcomes: Vec<TimedResult>,
    between: impl Fn(&StateResult, f64) -> Result<StateResult> + Sync,
) -> Loci {
    let places: Vec<f64> = outcomes.iter().map(|(at, _)| *at).collect();
    let behind = |pair: &[TimedResult]| match (&pair[0].1, &pair[1].1) {
        (Ok(before), Ok(after)) => {
            let halvings =
                // Each costs a model.
                if before.sample.modes.len() > tolerances::MANY_MODES { 3 } else { tolerances::HALVINGS };
            refined(before, after, halvings, &between)
        }
        _ => Vec::new(),
    };
    let more: Vec<Vec<LociPoint>> = outcomes.par_windows(2).map(behind).collect();
    let first = outcomes.iter().find_map(|(_, outcome)| outcome.as_ref().ok());
    let (method, chart) = first.map(|found| (found.method.clone(), found.chart.clone())).unwrap_or_default();
    let mut reached = Vec::new();
    let mut gaps = Vec::new();
    let mut samples = Vec::new();
    let mut doubts = Vec::new();
    for ((at, outcome), more) in outcomes.into_iter().zip(more.into_iter().chain([Vec::new()])) {
        match outcome {
            Ok(found) => {
                reached.push(Reached { at, equilibrium: found.is_equilibrium, turning: found.turning });
                doubts.extend(found.doubt.filter(|_| doubts.is_empty()));
                samples.push(found.sample);
            }
            Err(error) => {
                gaps.push(Gap { at, error });
                samples.push(LociPoint::gap(at));
            }
        }
        samples.extend(more);
    }
    let branches = asked(track(&samples), &places);
    Loci { along, method, chart, places, reached, gaps, branches, thresholds: Vec::new(), sensitivity: None, doubts }
}

/// Restricts branches to the requested times or values.
fn asked(branches: Vec<Branch>, places: &[f64]) -> Vec<Branch> {
    let places: BTreeSet<u64> = places.iter().map(|place| place.to_bits()).collect();
    let at_places = |branch: Branch| branch.retain(|at| places.contains(&at.to_bits()));
    branches.into_iter().map(at_places).filter(|branch| !branch.points.is_empty()).collect()
}
