//! Independent coordinates by name.

use super::changes::{Directions, directions};
use super::coordinates::constant;
use super::{Coordinates, Matrix, Variation, displacement};
use crate::error::{Error, Result, clock};
use crate::tolerances;

/// A coordinate that can be chosen: its name, that of its rate, and its direction of v.
struct Candidate {
    name: String,
    rate: String,
    direction: usize,
}

/// The chart whose z are the named coordinates: R = Z (B Z)^-1.
pub(super) fn coordinates(variation: &mut Variation, z: &Matrix, names: &[String]) -> Result<Coordinates> {
    let candidates = candidates(variation);
    let chosen = names.iter().map(|name| find(&candidates, name)).collect::<Result<Vec<&Candidate>>>()?;
    let states = variation.system().dimensions().states;
    let n = z.nrows();
    let degrees = z.ncols() - states;
    let best = || best(&candidates, &weighed(variation, z)).join(", ");
    if chosen.len() != degrees {
        let message =
            format!("{} coordinates are named, the mechanism has {degrees} degrees of freedom here", chosen.len());
        return Err(Error::input(message).under("--chart").hint(format!("independent here are: {}", best())));
    }
    let weighed = weighed(variation, z);
    let rows = Matrix::from_fn(degrees, degrees, |i, j| weighed[(chosen[i].direction, j)]);
    let smallest = rows.singular_values().iter().fold(f64::INFINITY, |least, x| least.min(*x));
    if smallest < tolerances::HALF_OF_THE_DIGITS {
        let message = format!("{} are not independent at t = {} s", names.join(", "), clock(variation.point.t));
        return Err(Error::input(message).under("--chart").hint(format!("independent here are: {}", best())));
    }
    let directions: Vec<usize> = chosen.iter().map(|chosen| chosen.direction).chain(n - states..n).collect();
    let b = Matrix::from_fn(directions.len(), n, |i, j| f64::from(u8::from(directions[i] == j)));
    let solved = (&b * z).lu().solve(&Matrix::identity(directions.len(), directions.len()));
    let inverse = solved.ok_or_else(|| Error::input("the coordinates are not independent").under("--chart"))?;
    let names_and_rates = chosen.iter().map(|c| (c.name.clone(), c.rate.clone())).unzip();
    constant(variation, &names.join(","), names_and_rates, z * inverse, b)
}

/// Returns every direction of v that moves q with the name of its coordinate, or of its rotation.
fn candidates(variation: &Variation) -> Vec<Candidate> {
    let Directions { q, v } = directions(variation.system(), &variation.point.q);
    q.into_iter().zip(v).enumerate().map(|(direction, (name, rate))| Candidate { name, rate, direction }).collect()
}

fn find<'c>(candidates: &'c [Candidate], name: &str) -> Result<&'c Candidate> {
    candidates.iter().find(|candidate| candidate.name == name || candidate.rate == name).ok_or_else(|| {
        let known = candidates.iter().map(|candidate| candidate.name.as_str());
        Error::unknown("coordinate", name, known).under("--chart")
    })
}

/// Returns Z without the directions of states, each row times the square root of its mass, or of what a direction
/// without inertia counts as, so that rows of any unit are comparable: no row is longer than 1.
fn weighed(variation: &Variation, z: &Matrix) -> Matrix {
    let degrees = z.ncols() - variation.system().dimensions().states;
    let weights = displacement::weights(variation, z);
    Matrix::from_fn(z.nrows(), degrees, |i, j| z[(i, j)] * weights[i])
}

/// Returns the coordinates that move most, by pivoted orthogonalization of the rows.
fn best<'c>(candidates: &'c [Candidate], weighed: &Matrix) -> Vec<&'c str> {
    let mut rest = weighed.clone();
    let mut names = Vec::new();
    for _ in 0..weighed.ncols() {
        let pivot = candidates.iter().max_by(|a, b| {
            let size = |candidate: &Candidate| rest.row(candidate.direction).norm();
            size(a).total_cmp(&size(b))
        });
        let Some(pivot) = pivot else { break };
        let row = rest.row(pivot.direction).clone_owned();
        let along = &rest * row.transpose() / row.norm_squared().max(f64::MIN_POSITIVE);
        rest -= along * row;
        names.push(pivot.name.as_str());
    }
    names
}
