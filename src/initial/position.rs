//! Positions: min |q - q_0|_W subject to phi(q, t) = 0 and the held coordinates.

use super::{Metric, closing, diagnosis, nearest};
use crate::error::{Error, Result, short};
use crate::math::largest;
use crate::tolerances;

/// Closes the joints, then moves along them to the state nearest to the guess.
pub fn close(metric: &mut Metric, t: f64, q: &mut [f64]) -> Result<()> {
    let moved = vec![0.0; metric.system.dimensions().v];
    close_moved(metric, t, q, moved)
}

/// As [`close`]; `moved` is the way from the guess to q.
pub fn close_moved(metric: &mut Metric, t: f64, q: &mut [f64], mut moved: Vec<f64>) -> Result<()> {
    let guess = q.to_vec();
    let way = moved.clone();
    if !closing::close(metric, t, q, &mut moved)? {
        if metric.has_initial() {
            return Err(diagnosis::refused_values(metric));
        }
        let mut closed = guess.clone();
        if let Some(error) = diagnosis::obstacle(metric, t, &guess, &way, &mut closed, &mut moved) {
            return Err(error);
        }
        q.copy_from_slice(&closed);
    }
    if moved.iter().any(|moved| *moved != 0.0) {
        nearest::approach(metric, t, q, &mut moved)?;
        // What the matrix at hand leaves of phi goes to round-off.
        closing::attempt(metric, t, q, &mut moved)?;
    }
    kept(metric, &moved)
}

/// An error if a held coordinate moved: one that contradicts the joints is met half way, step by step.
fn kept(metric: &Metric, moved: &[f64]) -> Result<()> {
    let most = largest(moved).max(1.0);
    let Some(&held) = metric.held.iter().find(|&&held| moved[held].abs() > tolerances::SAME * most) else {
        return Ok(());
    };
    let names = metric.system.facts().names.v.clone();
    let name = names[held].trim_end_matches('\'');
    let by = short(moved[held]);
    Err(Error::input(format!("`{name}` is held, but the joints close only where it moves by {by} (m, rad)"))
        .under("assembly.hold")
        .hint("begin where the joints are closed, or hold fewer coordinates"))
}
