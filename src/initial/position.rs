//! Positions: min |q - q_0|_W subject to phi(q, t) = 0 and the held coordinates.

use super::Metric;
use crate::error::{Error, Result, short};
use crate::math::largest;
use crate::tolerances::initial as tolerances;

/// Sequential quadratic programming: [W G^T; G 0] [d; .] = [-W (q - q_0); -phi]. The first part pulls back towards the
/// guess within the tangent space, the second is Newton's step; where the first part does not help, Newton's step alone
/// is taken, halved until the residual falls.
pub fn close(metric: &mut Metric, t: f64, q: &mut [f64]) -> Result<()> {
    let moved = vec![0.0; metric.system.dimensions().v];
    close_moved(metric, t, q, moved)
}

/// As [`close`]; `moved` is the way from the guess to q.
pub fn close_moved(metric: &mut Metric, t: f64, q: &mut [f64], mut moved: Vec<f64>) -> Result<()> {
    let n = metric.system.dimensions();
    let still = vec![0.0; n.v];
    let (mut best, mut smallest, mut stalled) = (f64::INFINITY, f64::INFINITY, 0);
    for _ in 0..tolerances::ASSEMBLY_ITERATIONS {
        metric.at(t, q, &still)?;
        let residual = metric.worst(&metric.terms.phi);
        let pulled = step(metric, Some(&moved))?;
        let size = largest(&pulled);
        let settled = size <= 1e-12 * (1.0 + largest(&moved));
        // Once closed, the residual is rounding, and the way to the nearest state counts.
        let falls = residual < 0.9 * best || (residual < tolerances::CLOSED && size < 0.9 * smallest);
        stalled = if falls { 0 } else { stalled + 1 };
        (best, smallest) = (best.min(residual), smallest.min(size));
        if residual < tolerances::CLOSED && (settled || stalled > 8) {
            return kept(metric, &moved);
        }
        if stalled > 40 {
            break;
        }
        let taken = advance(metric, t, q, &pulled, residual);
        let (factor, direction) = match taken {
            Some(factor) => (factor, pulled),
            None => {
                metric.at(t, q, &still)?;
                let newton = step(metric, None)?;
                match advance(metric, t, q, &newton, residual) {
                    Some(factor) => (factor, newton),
                    None if residual < tolerances::CLOSED => return kept(metric, &moved),
                    None => break,
                }
            }
        };
        moved.iter_mut().zip(&direction).for_each(|(moved, d)| *moved += factor * d);
    }
    metric.at(t, q, &still)?;
    Err(open(metric))
}

/// An error if a held coordinate moved: one that contradicts the joints is met half way, step by step.
fn kept(metric: &Metric, moved: &[f64]) -> Result<()> {
    let most = largest(moved).max(1.0);
    let Some(&held) = metric.held.iter().find(|&&held| moved[held].abs() > tolerances::SAME * most) else {
        return Ok(());
    };
    let names = metric.system.names().v;
    let name = names[held].trim_end_matches('\'');
    let by = short(moved[held]);
    Err(Error::input(format!("`{name}` is held, but the joints close only where it moves by {by} (m, rad)"))
        .under("assembly.hold")
        .hint("begin where the joints are closed, or hold fewer coordinates"))
}

pub(super) fn step(metric: &mut Metric, moved: Option<&[f64]>) -> Result<Vec<f64>> {
    let n = metric.system.dimensions().v;
    let mut top = moved.map_or(vec![0.0; n], |moved| metric.weigh(moved).iter().map(|x| -x).collect());
    let bottom: Vec<f64> = metric.terms.phi.iter().map(|phi| -phi).collect();
    metric.solve(&mut top, &bottom)?;
    Ok(top)
}

/// Moves q along `step`, halved until the residual does not grow; `None` if it does, with q unchanged.
fn advance(metric: &mut Metric, t: f64, q: &mut [f64], step: &[f64], residual: f64) -> Option<f64> {
    let start = q.to_vec();
    let mut rate = vec![0.0; q.len()];
    let mut factor = 1.0;
    for _ in 0..12 {
        let scaled: Vec<f64> = step.iter().map(|d| factor * d).collect();
        metric.system.rate(&start, &scaled, &mut rate);
        q.iter_mut().zip(&start).zip(&rate).for_each(|((q, start), rate)| *q = start + rate);
        metric.system.normalize(q);
        let now = metric.level(t, q, &scaled).phi;
        if now.is_finite() && (now < residual * (1.0 - 0.1 * factor) || now < tolerances::CLOSED) {
            return Some(factor);
        }
        factor *= 0.5;
    }
    q.copy_from_slice(&start);
    None
}

fn open(metric: &Metric) -> Error {
    let culprits = metric.culprits(&metric.terms.phi);
    if metric.has_initial() {
        return Error::input(format!(
            "the joints cannot be closed with the coordinates in `initial`; gaps that remain (m, rad): {culprits}"
        ))
        .under("initial")
        .hint("give values that the joints allow together, or fewer of them; or let the bodies start nearer");
    }
    let error = Error::input(format!("the joints cannot all be closed; gaps that remain (m, rad): {culprits}"));
    error.under("joints").hint(match metric.held.is_empty() {
        true => {
            "check lengths and markers of these joints, and whether one asks for what another forbids; or start nearer"
        }
        false => "check lengths and markers of these joints, or hold fewer coordinates in assembly.hold",
    })
}
