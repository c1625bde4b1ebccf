//! Perturbations of many sizes along one direction, simulated and predicted.

use super::horizon::{SHARES, horizon, horizons};
use super::perturb::{EPSILONS, are_alike, difference, moved};
use super::subject::Subject;
use super::{Decay, EventPassage};
use crate::error::{Error, Result};
use crate::linearize::flow::{Bundle, Snapshot};
use crate::linearize::{Matrix, State};
use crate::math::array::Each;
use crate::math::eigen::expm;
use serde::Serialize;

/// Perturbations along one direction.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct PerturbationSequence {
    /// Direction, as [`Direction::parse`](super::Direction::parse) reads it.
    pub direction: String,
    /// Sizes of (dq, dv/rate), m or rad.
    pub epsilons: Vec<f64>,
    /// Norm of the difference of both motions at the end less its prediction by the variational equations; none (NaN is
    /// not written) where the perturbed state does not exist.
    pub errors_ltv: Vec<f64>,
    /// Order of these errors in epsilon.
    #[doc(hidden)]
    pub order_ltv: Decay,
    /// Norm of the same difference less the prediction by exp(A t).
    pub errors_lti: Vec<f64>,
    /// Times after the state, s.
    pub times: Vec<f64>,
    /// Relative error of exp(A t) against the variational equations, at each time.
    pub drift_lti: Vec<f64>,
    /// Times at which the frozen model is off by 1 % and 10 %, s; none: not within the time followed.
    pub horizons: [Option<f64>; 2],
    /// Changes of the velocity directions that move most, at `curve_epsilon`.
    #[doc(hidden)]
    pub curves: Vec<ChangeCurve>,
    /// Size of the perturbation of the curves, m or rad.
    pub curve_epsilon: f64,
    /// The motions through changes of form; none where there are none on the way, or motions do not come through.
    pub passage: Option<EventPassage>,
}

/// Change along one velocity direction over time, simulated and predicted.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ChangeCurve {
    /// Index of the direction in v.
    pub direction: usize,
    /// Difference of the two simulated motions, m or rad.
    pub simulated: Vec<f64>,
    /// Prediction by the variational equations.
    pub ltv: Vec<f64>,
    /// Prediction by exp(A t).
    pub lti: Vec<f64>,
}

/// Number of rows over time.
const ROWS: usize = 60;
/// Number of curves.
const CURVES: usize = 3;
/// The curves are those of the largest perturbation not above this.
const SHOWN: f64 = 1.1e-2;

/// The perturbed motions and their predictions.
struct Followed<'a> {
    subject: &'a Subject<'a>,
    epsilons: Vec<f64>,
    /// True for each perturbed start that is on the same pieces of the equations.
    alike: Vec<bool>,
    /// The first time asked for, s.
    first: f64,
    times: Vec<f64>,
    snapshots: Vec<Snapshot>,
    /// The states of the perturbation at each time, by the variational equations.
    states: Vec<Matrix>,
    /// exp(A t) x0 at each time.
    predicted: Vec<Matrix>,
}

/// Perturbs the start along x0, the state of `direction`, and follows perturbations of all sizes for a time.
pub(super) fn sequence(
    subject: &Subject,
    x0: &Matrix,
    direction: String,
    duration: f64,
) -> Result<PerturbationSequence> {
    let Subject { system, carried, norm, .. } = subject;
    let followed = follow(subject, x0, duration)?;
    let Some(end) = followed.snapshots.last() else {
        return Err(Error::input(format!("no perturbed motion came to {:.1e} s in the time", followed.first))
            .hint("give more time by --budget, or a shorter --horizon"));
    };
    let last = &followed.predicted[followed.snapshots.len() - 1];
    let errors_ltv = norm.errors(*system, end, &end.columns, &followed.epsilons);
    let chart = carried.charts(std::slice::from_ref(end))?.remove(0);
    let errors_lti = norm.errors(*system, end, &chart.changes_of(last), &followed.epsilons);
    let smooth = errors_ltv.iter().zip(&followed.alike).map(|(error, alike)| if *alike { *error } else { f64::NAN });
    let order_ltv = norm.order(*system, end, &followed.epsilons, &smooth.collect::<Vec<f64>>());
    let drift_lti = followed.drift();
    let coarse = SHARES.each(|share| horizon(&followed.times, &drift_lti, share));
    let passed = followed.times.iter().zip(&drift_lti).find(|(_, error)| **error > SHARES[1]);
    let until = passed.map_or(duration, |(t, _)| *t).min(*followed.times.last().unwrap_or(&duration));
    let horizons = horizons(subject, x0, until)?.unwrap_or(coarse);
    let (curves, curve_epsilon) = followed.curves();
    let Followed { epsilons, times, .. } = followed;
    Ok(PerturbationSequence {
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
        passage: None,
    })
}

fn follow<'a>(subject: &'a Subject<'a>, x0: &Matrix, duration: f64) -> Result<Followed<'a>> {
    let Subject { system, start, model, carried, .. } = subject;
    let coordinates = &model.coordinates;
    let perturbed = |&eps: &f64| moved(*system, start, coordinates, x0, eps).map(|state| (eps, state));
    let (epsilons, members): (Vec<f64>, Vec<State>) = EPSILONS.iter().filter_map(perturbed).unzip();
    let alike = members.iter().map(|member| are_alike(*system, start, member)).collect();
    let columns = coordinates.changes_of(x0);
    let bundle = Bundle { columns, members, ..Bundle::of(start) };
    let mut times: Vec<f64> = (1..=ROWS).map(|i| duration * i as f64 / ROWS as f64).collect();
    let first = times[0];
    let snapshots = carried.flow(&bundle, &times.iter().map(|t| start.t + t).collect::<Vec<f64>>())?;
    let states = carried.states(&snapshots)?;
    let step = expm(&(&model.built.a * (duration / ROWS as f64)))?;
    let mut predicted = vec![&step * x0];
    (1..ROWS).for_each(|i| predicted.push(&step * &predicted[i - 1]));
    times.truncate(snapshots.len());
    Ok(Followed { subject, epsilons, alike, first, times, snapshots, states, predicted })
}

impl Followed<'_> {
    /// Returns the relative error of the frozen model at each time.
    fn drift(&self) -> Vec<f64> {
        let Subject { carried, norm, .. } = self.subject;
        let size = |x: &Matrix| norm.states(carried.start.freedom(), x);
        self.states.iter().zip(&self.predicted).map(|(ltv, lti)| size(&(ltv - lti)) / size(ltv)).collect()
    }

    /// Returns the curves that move most, and the size of their perturbation.
    fn curves(&self) -> (Vec<ChangeCurve>, f64) {
        let Subject { system, carried, .. } = self.subject;
        let member = self.epsilons.iter().position(|eps| *eps <= SHOWN).unwrap_or(0);
        let Some(&eps) = self.epsilons.get(member) else { return (Vec::new(), 0.0) };
        let column = |i: usize| self.snapshots.iter().map(move |snapshot| snapshot.columns.q[(i, 0)]);
        let largest = |i: usize| column(i).fold(0.0f64, |largest, x| largest.max(x.abs()));
        let mut order: Vec<usize> = (0..carried.start.r.nrows()).collect();
        order.sort_by(|&i, &j| largest(j).total_cmp(&largest(i)));
        let pairs = self.snapshots.iter().map(|snapshot| (&snapshot.motion, &snapshot.members[member]));
        let simulated: Vec<Vec<f64>> =
            pairs.map(|(motion, member)| difference(*system, motion, member)).map(|[dq, _]| dq).collect();
        let freedom = carried.start.freedom();
        let frozen = |direction: usize, snapshot: &Snapshot, x: &Matrix| {
            let row = carried.basis(snapshot).view((direction, 0), (1, freedom));
            eps * (row * x.rows(0, freedom))[0]
        };
        let predicted = || self.snapshots.iter().zip(&self.predicted);
        let curve = |direction: usize| ChangeCurve {
            direction,
            simulated: simulated.iter().map(|dq| dq[direction]).collect(),
            ltv: column(direction).map(|x| eps * x).collect(),
            lti: predicted().map(|(snapshot, x)| frozen(direction, snapshot, x)).collect(),
        };
        (order.into_iter().take(CURVES).map(curve).collect(), eps)
    }
}
