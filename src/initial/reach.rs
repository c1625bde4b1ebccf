//! The coordinates in `initial`: a path to them from the guess with its joints closed.

use super::follow::newton;
use super::{Metric, position};
use crate::error::{Error, Result};
use crate::scene::INITIAL;
use crate::tolerances::initial as tolerances;

/// Closes the joints with the rows of `initial`, as [`position::close`], on the branch of the guess: phi of these rows,
/// whose size at the guess is `gap`, goes to zero as (1 - s) gap, s from 0 to 1 in steps in each of which Newton's
/// method contracts. Where the joints do not close without the rows, or the path comes to the values only in the limit,
/// at a dead centre, it begins at the guess with all rows.
///
/// # Errors
/// Values that the joints do not allow, or on another branch only; the message says where the path ends.
pub fn reach(alone: &mut Metric, all: &mut Metric, t: f64, q: &mut [f64]) -> Result<()> {
    let (guess, mut moved) = (q.to_vec(), vec![0.0; all.system.dimensions().v]);
    let (done, ended) = match follow(alone, all, t, q, &mut moved) {
        Ok((_, None)) => return position::close_moved(all, t, q, moved),
        Ok((done, Some(gaps))) => (done, format!("; turned there from the guess, they stop short by {gaps}")),
        Err(_) => (1.0, String::new()),
    };
    q.copy_from_slice(&guess);
    match position::close(all, t, q) {
        Ok(()) if done < tolerances::NEARLY_THERE => Err(Error::input(format!(
            "the values in `initial` are on another branch of the mechanism than its guess{ended}"
        ))
        .under(INITIAL)
        .hint("give the bodies a guess on the branch that is meant, or values that the joints come to")),
        closed => closed.map_err(|error| error.changed(|input| input.message += &ended)),
    }
}

/// Closes the joints alone, and moves q along the path; returns how much of it, and the gaps that remain where it ends
/// before the values.
fn follow(
    alone: &mut Metric,
    all: &mut Metric,
    t: f64,
    q: &mut [f64],
    moved: &mut [f64],
) -> Result<(f64, Option<String>)> {
    position::close(alone, t, q)?;
    let groups = all.system.groups().into_iter().filter(|group| group.kind == INITIAL);
    let rows: Vec<usize> = groups.flat_map(|group| group.rows).collect();
    let done = path(all, &rows, t, q, moved);
    Ok((done, (done < 1.0).then(|| all.culprits(&all.terms.phi))))
}

/// Moves q along the path on which phi of some rows, open by `gap` at q, goes to zero as (1 - s) gap. Returns s where it
/// ends; the terms are those at q.
pub(super) fn path(all: &mut Metric, rows: &[usize], t: f64, q: &mut [f64], moved: &mut [f64]) -> f64 {
    all.residual(t, q);
    let mut gap = vec![0.0; all.terms.phi.len()];
    rows.iter().for_each(|row| gap[*row] = all.terms.phi[*row]);
    let (mut done, mut part) = (0.0, 1.0);
    while done < 1.0 && part > tolerances::LEAST_PART {
        let next = f64::min(done + part, 1.0);
        let (mut ahead, mut change) = (q.to_vec(), moved.to_vec());
        all.ahead = gap.iter().map(|gap| (1.0 - next) * gap).collect();
        let contracts = newton(all, t, &mut ahead, &mut change).unwrap_or(false);
        if contracts && all.residual(t, &ahead).is_finite() && all.is_closed(&ahead) {
            q.copy_from_slice(&ahead);
            moved.copy_from_slice(&change);
            (done, part) = (next, 2.0 * part);
        } else {
            part *= 0.5;
        }
    }
    all.ahead.clear();
    all.residual(t, q);
    done
}
