//! Measured errors of models along a motion.

use super::course::Course;
use crate::error::Result;
use crate::linearize::flow::flow;
use crate::linearize::{Coordinates, LinearModel, Matrix, State, Variation};
use crate::system::MechanicalSystem;

/// A against the limit of (Phi(t + h, t) - I)/h for h to 0. Velocities are divided by a rate of the model; both numbers
/// are parts of the largest entry of A.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
pub struct MeasuredA {
    /// Time, s.
    pub t: f64,
    /// Largest difference from the limit.
    pub error: f64,
    /// Uncertainty of the limit.
    pub uncertainty: f64,
}

/// Largest deviation of a kind of matrix, half-way between two times, from the mean of both: the error of linear
/// interpolation.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct Deviation {
    /// Key of the matrices in files: `A`.
    pub of: &'static str,
    /// Largest entry over all times.
    pub largest: f64,
    /// Largest deviation, as a part of the largest entry.
    pub error: f64,
    /// Its time, s.
    pub t: f64,
}

/// The matrices that are interpolated, by their keys in files.
const NAMES: [&str; 6] = ["A", "B", "C", "D", "R", "T"];

/// The matrices of a model between two times.
pub(super) struct Middle {
    t: f64,
    matrices: [Matrix; 6],
}

impl Middle {
    pub fn new(model: &LinearModel) -> Self {
        Middle { t: model.point.t, matrices: matrices(model) }
    }
}

/// A, B, C and D of a model, and R and T of its chart; none of these without a chart.
fn matrices(model: &LinearModel) -> [Matrix; 6] {
    let chart = model.frame.as_ref().map(|frame| &frame.coordinates);
    let r = chart.map_or_else(|| Matrix::zeros(0, 0), |chart| chart.r.clone());
    let tilt = chart.map_or_else(|| Matrix::zeros(0, 0), |chart| chart.tilt.clone());
    [model.a.clone(), model.b.clone(), model.c.clone(), model.d.clone(), r, tilt]
}

/// Returns the deviations of each kind of matrix, and the largest in each interval of so many that has a model half-way.
pub(super) fn deviations(models: &[LinearModel], middles: &[Middle], stride: usize) -> (Vec<Deviation>, Vec<f64>) {
    let ends: Vec<[Matrix; 6]> = models.iter().map(matrices).collect();
    let mut intervals = vec![0.0f64; middles.len()];
    let mut found = Vec::new();
    for (i, of) in NAMES.into_iter().enumerate() {
        let largest = ends.iter().fold(0.0f64, |most, all| most.max(size(&all[i])));
        let mut worst = Deviation { of, largest, error: 0.0, t: models[0].point.t };
        for ((pair, middle), interval) in ends.windows(2).step_by(stride).zip(middles).zip(&mut intervals) {
            let off = size(&(&middle.matrices[i] - (&pair[0][i] + &pair[1][i]) * 0.5));
            let error = if off > 0.0 { off / largest.max(off) } else { 0.0 };
            *interval = interval.max(error);
            if error > worst.error {
                (worst.error, worst.t) = (error, middle.t);
            }
        }
        found.push(worst);
    }
    (found, intervals)
}

/// Returns the largest entry; 0 of an empty matrix.
fn size(matrix: &Matrix) -> f64 {
    matrix.iter().fold(0.0, |most, x| most.max(x.abs()))
}

/// Measures A at some of the times, spread evenly; where a motion cannot be followed from one, nothing is known there.
pub(super) fn measure(system: &dyn MechanicalSystem, course: &Course, models: &[LinearModel]) -> Vec<MeasuredA> {
    let last = models.len() - 1;
    // They tell a wrong term, which is wrong nearly everywhere.
    let count = last.min(5);
    let places = (0..count).map(|i| i * last / count.max(1));
    places.filter_map(|place| of_a(system, course, &models[place]).ok().flatten()).collect()
}

/// Returns the error of A at a state by the transition matrices over halved steps; none where nothing moves.
fn of_a(system: &dyn MechanicalSystem, course: &Course, model: &LinearModel) -> Result<Option<MeasuredA>> {
    let Some(start) = model.frame.as_ref().map(|frame| &frame.coordinates) else { return Ok(None) };
    let own = start.freedom() + start.r.ncols();
    let k = start.freedom();
    let a = model.a.view((0, 0), (own, own)).clone_owned();
    let rate = rate(&a, start);
    let alike = |x: &Matrix| alike(x, k, rate);
    if size(&a) == 0.0 {
        return Ok(None);
    }
    let point = &model.point;
    // The sixth power of it, over those of two that the extrapolation divides by, is round-off.
    let longest = 0.2 / rate;
    let steps: Vec<f64> = (0..7).rev().map(|i| longest / f64::from(1u32 << i)).collect();
    let times: Vec<f64> = steps.iter().map(|h| point.t + h).collect();
    let state = State { t: point.t, q: point.q.clone(), v: point.v.clone() };
    let mut course = course.from(start);
    let bundle = course.bundle(&state);
    let mut quotients = Vec::new();
    flow(system, &bundle, &times, |snapshot| {
        let State { t, q, v } = &snapshot.motion;
        let chart =
            Variation::new(system, *t, q, v).and_then(|mut variation| course.at(&mut variation, &snapshot.basis));
        let identity = Matrix::identity(own, own);
        quotients.extend(chart.map(|chart| (alike(&chart.states_of(&snapshot.columns)) - identity) / (t - point.t)));
        true
    })?;
    quotients.reverse();
    if quotients.len() < steps.len() {
        return Ok(None);
    }
    let (limit, uncertainty) = limit(quotients);
    let a = alike(&a);
    let largest = size(&a);
    Ok(Some(MeasuredA { t: point.t, error: size(&(limit - &a)) / largest, uncertainty: uncertainty / largest }))
}

/// Returns a rate at which states and chart change, 1/s.
fn rate(a: &Matrix, chart: &Coordinates) -> f64 {
    let k = chart.freedom();
    let rest = a.nrows() - k;
    let stiff = size(&a.view((k, 0), (rest, k)).clone_owned()).sqrt();
    let damped = size(&a.view((k, k), (rest, rest)).clone_owned());
    let turning = size(&chart.tilt) / size(&chart.r).max(f64::MIN_POSITIVE);
    Some(stiff.max(damped).max(turning)).filter(|rate| *rate > 0.0).unwrap_or(1.0)
}

/// Scales the blocks of a transition matrix, or of A, to one unit.
fn alike(x: &Matrix, k: usize, rate: f64) -> Matrix {
    let mut x = x.clone();
    let rest = x.nrows() - k;
    x.rows_mut(k, rest).unscale_mut(rate);
    x.columns_mut(k, rest).scale_mut(rate);
    x
}

/// Returns the limit of values at h, h/2, h/4 .. whose error is a series in h, and its uncertainty: the entry of the
/// scheme of Richardson and Neville that differs least from its neighbours (Ridders, Adv. Eng. Software 4 (1982) 75-76).
fn limit(values: Vec<Matrix>) -> (Matrix, f64) {
    let mut best = (values[0].clone(), f64::INFINITY);
    let mut before: Vec<Matrix> = Vec::new();
    for value in values {
        let mut row = vec![value];
        for (order, coarse) in before.iter().enumerate() {
            let fine = &row[order];
            let refined = fine + (fine - coarse) / (2f64.powi(order as i32 + 1) - 1.0);
            let change = size(&(&refined - fine)).max(size(&(&refined - coarse)));
            if change < best.1 {
                best = (refined.clone(), change);
            }
            row.push(refined);
        }
        before = row;
    }
    best
}
