//! The whole check at one state.

use super::frozen::frozen;
use super::ladder::{EPSILONS, difference, moved};
use super::{Decay, Frozen, InputCheck, Settings, decay, horizon, input};
use crate::error::{Error, Result};
use crate::linearize::flow::{Bundle, Snapshot, flow};
use crate::linearize::{Changes, Chart, Matrix, Minimal, State, Variation, minimal};
use crate::math::eigen::{eigen, expm};
use crate::system::MechanicalSystem;
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

/// Perturbations along one direction.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Ladder {
    pub direction: String,
    /// Sizes of (dq, dv/rate), m or rad.
    pub epsilons: Vec<f64>,
    /// Size of the difference of both motions at the end less its prediction; none (NaN is not written) where the
    /// perturbed state does not exist.
    pub errors_ltv: Vec<f64>,
    pub order_ltv: Decay,
    pub errors_lti: Vec<f64>,
    /// Times after the state, s.
    pub times: Vec<f64>,
    /// Relative error of exp(A t) against the variational equations.
    pub drift_lti: Vec<f64>,
    /// Times at which the frozen model is off by 1 % and 10 %, s; none: beyond what was followed.
    pub horizons: [Option<f64>; 2],
    /// What moves most, at `curve_epsilon`.
    pub curves: Vec<Curve>,
    pub curve_epsilon: f64,
}

/// A velocity direction's change over time, simulated and predicted.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Curve {
    /// Index of the direction of v.
    pub direction: usize,
    pub simulated: Vec<f64>,
    pub ltv: Vec<f64>,
    pub lti: Vec<f64>,
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

/// Relative errors above this are not in the range where eps^2 rules.
pub(super) const TOO_LARGE: f64 = 0.1;
/// An order may be this much below 2.
const SLACK: f64 = 0.1;
/// Rows over time.
const ROWS: usize = 60;
/// A period of the fastest mode counts, times this: longer runs would cost more than they tell.
const MOST_SWINGS: f64 = 8.0;
const CURVES: usize = 3;

/// Compares the model at a state with perturbed simulations.
///
/// # Errors
/// A chart that does not exist there or is not constant; a motion that cannot go on.
pub fn validate(system: &dyn MechanicalSystem, start: &State, settings: &Settings) -> Result<Validation> {
    let chart = settings.chart.clone().unwrap_or(Chart::MassOrthogonal);
    if chart == Chart::Intrinsic {
        return Err(Error::input("the intrinsic chart moves along, and simulations are compared in a constant one")
            .under("--chart")
            .hint("take mass_orthogonal, or name independent coordinates"));
    }
    let mut variation = Variation::new(system, start.t, &start.q, &start.v)?;
    let mut model = minimal(&mut variation, &chart)?;
    let name = model.coordinates.name.clone();
    // The plain projection means the states of a chart that it does not follow.
    let chart = if chart == Chart::Frozen { Chart::MassOrthogonal } else { chart };
    model.coordinates = chart.at(&mut variation)?;
    let speed = Speed::of(&model)?;
    let norm = Norm { rate: speed.usual };
    let followed = settings.horizon.unwrap_or(speed.period());
    let mut ladders = Vec::new();
    for direction in &settings.directions {
        let x0 = direction.state(&model.coordinates, norm.rate)?;
        if model.a.nrows() > 0 {
            ladders.push(ladder(system, start, (&model, &norm), &x0, (direction.name(), followed))?);
        }
    }
    let longest = followed.min(1.0 / speed.fastest.max(f64::MIN_POSITIVE));
    let frozen = frozen(system, start, &chart, (&model.a, &model.coordinates, &speed), longest)?;
    let mut inputs = Vec::new();
    for (index, column) in system.inputs().into_iter().enumerate().filter(|_| settings.inputs) {
        inputs.extend(input::check(system, start, (&model, &norm), (index, column.name), 0.1 * followed)?);
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
        std::f64::consts::TAU * (1.0 / self.usual).min(MOST_SWINGS / self.fastest)
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

fn ladder(
    system: &dyn MechanicalSystem,
    start: &State,
    (model, norm): (&Minimal, &Norm),
    x0: &Matrix,
    (direction, followed): (String, f64),
) -> Result<Ladder> {
    let coordinates = &model.coordinates;
    let column = coordinates.changes();
    let columns = Changes { q: column.q * x0, v: column.v * x0 };
    let (epsilons, members): (Vec<f64>, Vec<State>) =
        EPSILONS.iter().filter_map(|&eps| moved(system, start, coordinates, x0, eps).map(|state| (eps, state))).unzip();
    let bundle = Bundle { columns, members, ..Bundle::of(start) };
    let times: Vec<f64> = (1..=ROWS).map(|i| followed * i as f64 / ROWS as f64).collect();
    let mut snapshots: Vec<Snapshot> = Vec::new();
    flow(system, &bundle, &times.iter().map(|t| start.t + t).collect::<Vec<f64>>(), |snapshot| {
        snapshots.push(snapshot.clone());
        true
    })?;
    let step = expm(&(&model.a * (followed / ROWS as f64))).map_err(|unsolved| Error::input(unsolved.to_string()))?;
    let mut predicted = vec![&step * x0];
    (1..ROWS).for_each(|i| predicted.push(&step * &predicted[i - 1]));
    let drift_lti: Vec<f64> = snapshots
        .iter()
        .zip(&predicted)
        .map(|(snapshot, lti)| {
            let ltv = coordinates.states_of(&snapshot.columns);
            norm.states(&(&ltv - lti)) / norm.states(&ltv)
        })
        .collect();
    let Some(end) = snapshots.last() else { return Err(Error::input("nothing to follow")) };
    let lti = {
        let all = coordinates.changes();
        Changes { q: all.q * &predicted[ROWS - 1], v: all.v * &predicted[ROWS - 1] }
    };
    let errors = |changes: &Changes| -> Vec<f64> {
        let pairs = end.members.iter().zip(&epsilons);
        pairs
            .map(|(member, eps)| {
                let [dq, dv] = difference(system, &end.motion, member);
                norm.off((&dq, &dv), (changes.q.as_slice(), changes.v.as_slice()), *eps)
            })
            .collect()
    };
    let (errors_ltv, errors_lti) = (errors(&end.columns), errors(&lti));
    let size = norm.size((end.columns.q.as_slice(), end.columns.v.as_slice()));
    let order_ltv = decay(&epsilons, &errors_ltv, |eps| TOO_LARGE * eps * size, floor(&errors_ltv));
    let horizons = [0.01, 0.1].map(|share| horizon(&times, &drift_lti, share));
    let (curves, curve_epsilon) = curves(system, coordinates, (&snapshots, &predicted), &epsilons);
    Ok(Ladder {
        direction,
        epsilons,
        errors_ltv,
        order_ltv,
        errors_lti,
        times,
        drift_lti,
        horizons,
        curves,
        curve_epsilon,
    })
}

/// What moves most, at a perturbation of about 1e-2.
fn curves(
    system: &dyn MechanicalSystem,
    coordinates: &crate::linearize::Coordinates,
    (snapshots, predicted): (&[Snapshot], &[Matrix]),
    epsilons: &[f64],
) -> (Vec<Curve>, f64) {
    let member = epsilons.iter().position(|eps| *eps <= 1.1e-2).unwrap_or(0);
    let Some(&eps) = epsilons.get(member) else { return (Vec::new(), 0.0) };
    let n = coordinates.r.nrows();
    let k = coordinates.r.ncols();
    let largest = |i: usize| snapshots.iter().map(|snapshot| snapshot.columns.q[(i, 0)].abs()).fold(0.0, f64::max);
    let mut order: Vec<usize> = (0..n).collect();
    order.sort_by(|&i, &j| largest(j).total_cmp(&largest(i)));
    let simulated: Vec<Vec<f64>> = snapshots
        .iter()
        .map(|snapshot| difference(system, &snapshot.motion, &snapshot.members[member]))
        .map(|[dq, _]| dq)
        .collect();
    let curve = |direction: usize| Curve {
        direction,
        simulated: simulated.iter().map(|dq| dq[direction]).collect(),
        ltv: snapshots.iter().map(|snapshot| eps * snapshot.columns.q[(direction, 0)]).collect(),
        lti: predicted.iter().map(|x| eps * (coordinates.r.row(direction) * x.rows(0, k))[(0, 0)]).collect(),
    };
    (order.into_iter().take(CURVES).map(curve).collect(), eps)
}

fn judge(ladders: &[Ladder], frozen: &Frozen, inputs: &[InputCheck]) -> Verdict {
    let orders = ladders.iter().map(|ladder| &ladder.order_ltv).chain(inputs.iter().map(|input| &input.order_ltv));
    let passes = |decay: &Decay| decay.is_exact || decay.order.is_some_and(|order| order > 2.0 - SLACK);
    let (ltv, lti) = (orders.clone().all(passes), passes(&frozen.decay));
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
