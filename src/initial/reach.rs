//! The coordinates in `initial`: a path to them from the guess with its joints closed.

use super::follow::path;
use super::{Metric, position};
use crate::error::{Error, Result};
use crate::scene::INITIAL;

/// Closes the joints with the rows of `initial`, as [`position::close`], on the branch of the guess: phi of these rows,
/// whose size at the guess is `gap`, goes to zero as (1 - s) gap, s from 0 to 1 in steps in each of which Newton's
/// method contracts. Where the joints do not close without the rows, or the path comes to the values only in the limit,
/// at a dead centre, it begins at the guess with all rows.
///
/// # Errors
/// Values that the joints do not allow, or on another branch only; the message says where the path ends.
pub fn reach(alone: &mut Metric, all: &mut Metric, t: f64, q: &mut [f64]) -> Result<()> {
    let guess = q.to_vec();
    let mut moved = vec![0.0; all.system.dimensions().v];
    let (done, ended) = match follow(alone, all, t, q, &mut moved) {
        Ok((_, None)) => return position::close_moved(all, t, q, moved),
        Ok((done, Some(gaps))) => (done, format!("; turned there from the guess, they stop short by {gaps}")),
        Err(_) => (1.0, String::new()),
    };
    q.copy_from_slice(&guess);
    match position::close(all, t, q) {
        // At a dead centre steps halve: the path comes to its end in the limit only.
        Ok(()) if done < 0.999 => Err(Error::input(format!(
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
    let groups = all.system.facts().groups().into_iter().filter(|group| group.kind == INITIAL);
    let rows: Vec<usize> = groups.flat_map(|group| group.rows).collect();
    let done = path(all, &rows, t, q, moved);
    Ok((done, (done < 1.0).then(|| all.culprits(&all.terms.phi))))
}
