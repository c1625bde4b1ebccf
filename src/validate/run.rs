//! The whole check at one state.

use super::carried::Carried;
use super::frozen::frozen;
use super::ladder::ladder;
use super::{Decay, Frozen, InputCheck, Ladder, Settings, input};
use crate::error::{Error, Result};
use crate::linearize::{Chart, Matrix, Minimal, State, Variation, minimal, refuse_large};
use crate::math::eigen::eigen;
use crate::system::MechanicalSystem;
use crate::tolerances::linearize as tolerances;
use serde::Serialize;

/// The linear model at a state against simulations.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Validation {
    pub t: f64,
    pub chart: String,
    /// How long the perturbed motions were followed, s.
    pub followed: f64,
    /// What velocities are divided by to compare with positions, 1/s.
    pub rate: f64,
    /// One for each direction.
    pub ladders: Vec<Ladder>,
    /// exp(A h) against the state-transition matrix.
    pub frozen: Frozen,
    pub inputs: Vec<InputCheck>,
    pub verdict: Verdict,
}

/// Whether the model may be trusted.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Verdict {
    /// The variational equations: order 2 (or exact) for each direction and input.
    pub ltv: bool,
    /// A in its chart: order 2 or more in h (or exact).
    pub lti: bool,
    pub text: String,
}

/// Compares the model at a state with perturbed simulations.
///
/// # Errors
/// A chart that does not exist there; a motion that cannot go on.
pub fn validate(system: &dyn MechanicalSystem, start: &State, settings: &Settings) -> Result<Validation> {
    refuse_large(system.dimensions().v)?;
    let mut variation = Variation::new(system, start.t, &start.q, &start.v)?;
    let chart = settings.chart.clone().unwrap_or_else(|| Chart::preferred(&mut variation));
    let mut model = minimal(&mut variation, &chart)?;
    let name = model.coordinates.name.clone();
    // The plain projection means the states of a chart that it does not follow.
    let chart = if chart == Chart::Frozen { Chart::MassOrthogonal } else { chart };
    let carried = Carried::new(&mut variation, &chart, start)?;
    model.coordinates = carried.start.clone();
    let speed = Speed::of(&model)?;
    let norm = Norm { rate: speed.usual };
    let followed = settings.horizon.unwrap_or(speed.period());
    let mut ladders = Vec::new();
    for direction in &settings.directions {
        let x0 = direction.state(&model.coordinates, norm.rate)?;
        if model.a.nrows() > 0 {
            ladders.push(ladder(system, start, (&model, &carried, &norm), &x0, (direction.name(), followed))?);
        }
    }
    let longest = followed.min(1.0 / speed.fastest.max(f64::MIN_POSITIVE));
    let frozen = frozen(system, start, &carried, (&model.a, &speed), longest)?;
    let mut inputs = Vec::new();
    for (index, column) in system.inputs().into_iter().enumerate().filter(|_| settings.inputs) {
        inputs.extend(input::check(system, start, (&model, &carried, &norm), (index, column.name), 0.1 * followed)?);
    }
    let verdict = judge(&ladders, &frozen, &inputs);
    Ok(Validation { t: start.t, chart: name, followed, rate: norm.rate, ladders, frozen, inputs, verdict })
}

/// Rates of a model, 1/s.
pub(super) struct Speed {
    pub usual: f64,
    pub fastest: f64,
}

impl Speed {
    fn of(model: &Minimal) -> Result<Self> {
        let values = eigen(&model.a).map_err(|unsolved| Error::input(unsolved.to_string()))?.values;
        let rates: Vec<f64> = values.iter().map(|value| value.norm()).filter(|rate| *rate > 1e-6).collect();
        let fastest = rates.iter().copied().fold(1.0, f64::max);
        let mean = rates.iter().map(|rate| rate.ln()).sum::<f64>() / rates.len().max(1) as f64;
        Ok(Speed {
            usual: if rates.is_empty() { 1.0 } else { mean.exp() },
            fastest: if rates.is_empty() { 1.0 } else { fastest },
        })
    }

    /// Of a usual mode, with not too many of the fastest in it.
    fn period(&self) -> f64 {
        std::f64::consts::TAU * (1.0 / self.usual).min(tolerances::FASTEST_PERIODS / self.fastest)
    }
}

/// Sizes of changes, velocities over `rate`.
pub(super) struct Norm {
    pub rate: f64,
}

impl Norm {
    pub fn size(&self, (dq, dv): (&[f64], &[f64])) -> f64 {
        let square = |x: &[f64]| x.iter().map(|x| x * x).sum::<f64>();
        (square(dq) + square(dv) / self.rate.powi(2)).sqrt()
    }

    /// |change - eps column|
    pub fn off(&self, (dq, dv): (&[f64], &[f64]), (cq, cv): (&[f64], &[f64]), eps: f64) -> f64 {
        let rest = |x: &[f64], c: &[f64]| x.iter().zip(c).map(|(x, c)| x - eps * c).collect::<Vec<f64>>();
        self.size((&rest(dq, cq), &rest(dv, cv)))
    }

    /// Of states (z, y).
    pub fn states(&self, x: &Matrix) -> f64 {
        let k = x.nrows() / 2;
        self.size((x.rows(0, k).clone_owned().as_slice(), x.rows(k, k).clone_owned().as_slice()))
    }
}

/// The error of the smallest perturbation is rounding.
pub(super) fn floor(errors: &[f64]) -> f64 {
    errors.last().copied().filter(|error| error.is_finite()).unwrap_or(0.0).max(1e-15)
}

fn judge(ladders: &[Ladder], frozen: &Frozen, inputs: &[InputCheck]) -> Verdict {
    let orders = ladders.iter().map(|ladder| &ladder.order_ltv).chain(inputs.iter().map(|input| &input.order_ltv));
    let passes =
        |decay: &Decay| decay.is_exact || decay.order.is_some_and(|order| order > 2.0 - tolerances::ORDER_SLACK);
    let steep = |decay: &Decay| decay.is_exact || decay.order.is_some_and(|order| order > tolerances::STEEP_ENOUGH);
    let (ltv, lti) = (orders.clone().all(passes), steep(&frozen.decay));
    let lowest = orders.filter_map(|decay| decay.order).fold(f64::INFINITY, f64::min);
    let order = if lowest.is_finite() { format!("order {lowest:.2}") } else { "exact to rounding".to_string() };
    let text = match (ltv, lti) {
        (true, true) => format!("right: perturbed simulations follow the linear model ({order} in eps)"),
        (true, false) => {
            format!("the variational equations are right ({order} in eps), but A misses terms of its chart")
        }
        (false, _) => format!("wrong, or too near to rounding to tell: {order} in eps, where 2 is expected"),
    };
    Verdict { ltv, lti, text }
}
