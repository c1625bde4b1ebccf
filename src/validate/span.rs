//! Models along a motion against simulations of small perturbations over the whole span.

use super::perturb::{EPSILONS, Norm, Speed, moved};
use super::{Decay, Direction};
use crate::error::{Error, Result};
use crate::linearize::flow::{Bundle, Snapshot, flow};
use crate::linearize::{Along, Chart, State, Variation, minimal};
use crate::system::MechanicalSystem;
use crate::tolerances;
use serde::Serialize;

/// Perturbations along one direction of the first state, followed over the span.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct SpanCheck {
    /// Direction, as [`Direction::parse`] reads it.
    pub direction: String,
    /// Sizes of (dq, dv/rate), m or rad.
    pub epsilons: Vec<f64>,
    /// Times, s.
    pub times: Vec<f64>,
    /// At each time, and for each size, the norm of the simulated change less that by the transition matrices.
    pub errors_ltv: Vec<Vec<f64>>,
    /// Order of these errors in the size, at each time.
    #[doc(hidden)]
    pub orders: Vec<Decay>,
}

impl SpanCheck {
    /// Returns the time with the lowest order, and the order; none where no time has one.
    #[doc(hidden)]
    pub fn lowest(&self) -> Option<(f64, &Decay)> {
        let told = self.times.iter().copied().zip(&self.orders).filter(|(_, decay)| decay.order.is_some());
        told.min_by(|a, b| a.1.order.unwrap_or(0.0).total_cmp(&b.1.order.unwrap_or(0.0)))
    }

    /// True if the errors fall as the square of the size, or are round-off, wherever that can be told.
    pub fn is_right(&self) -> bool {
        let passes = |decay: &Decay| decay.order.is_none_or(|order| order > 2.0 - tolerances::ORDER_SLACK);
        let is_told = |decay: &Decay| decay.is_exact || decay.order.is_some();
        self.orders.iter().any(is_told) && self.orders.iter().all(|decay| decay.is_exact || passes(decay))
    }
}

/// Compares models along a motion with perturbed simulations: the changes by R, T and the products of the transition
/// matrices with differences of motions by the full equations.
///
/// # Errors
/// A motion that cannot go on, a direction that does not exist.
pub fn validate_along(
    system: &dyn MechanicalSystem,
    found: &Along,
    direction: &Direction,
    mut progress: impl FnMut(f64),
) -> Result<SpanCheck> {
    let first = &found.models[0];
    let point = &first.point;
    let start = State { t: point.t, q: point.q.clone(), v: point.v.clone() };
    let mut variation = Variation::new(system, start.t, &start.q, &start.v)?;
    let model = minimal(&mut variation, &Chart::parse(&first.chart))?;
    if model.built.a.nrows() == 0 {
        return Err(Error::input("nothing moves: there is no change to follow"));
    }
    let norm = Norm { rate: Speed::of(&model)?.usual };
    let mut x = direction.state(&model.coordinates, norm.rate)?;
    let perturbed = |&eps: &f64| moved(system, &start, &model.coordinates, &x, eps).map(|state| (eps, state));
    let (epsilons, members): (Vec<f64>, Vec<State>) = EPSILONS.iter().filter_map(perturbed).unzip();
    let times: Vec<f64> = found.models[1..].iter().map(|model| model.point.t).collect();
    let mut errors_ltv = Vec::new();
    let mut orders = Vec::new();
    let bundle = Bundle { members, ..Bundle::of(&start) };
    let mut places = found.transitions.iter().zip(&found.models[1..]);
    flow(system, &bundle, &times, |snapshot| {
        let Some((phi, model)) = places.next() else { return false };
        let Some(frame) = &model.frame else { return false };
        x = phi * &x;
        let end = Snapshot { columns: frame.coordinates.changes_of(&x), ..snapshot.clone() };
        let errors = norm.errors(system, &end, &end.columns, &epsilons);
        orders.push(norm.order(system, &end, &epsilons, &errors));
        errors_ltv.push(errors);
        progress(snapshot.motion.t);
        true
    })?;
    Ok(SpanCheck { direction: direction.name(), epsilons, times, errors_ltv, orders })
}
