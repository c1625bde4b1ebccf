//! Directions in which a state is perturbed.

use crate::error::{Error, Result, suggest};
use crate::linearize::{Changes, Coordinates, Matrix};
use crate::math::random::Random;

/// A direction in the states (z, y) of a chart.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Direction {
    /// All states at once, with pseudo-random components from a seed.
    Random(u64),
    /// One state, by its name.
    Named(String),
}

impl Direction {
    /// Reads `random`, `random:SEED` or the name of a state.
    pub fn parse(text: &str) -> Self {
        let seed = text.strip_prefix("random").map(|rest| rest.strip_prefix(':').unwrap_or(rest));
        match seed.map(|seed| if seed.is_empty() { Ok(1) } else { seed.parse() }) {
            Some(Ok(seed)) => Direction::Random(seed),
            _ => Direction::Named(text.to_string()),
        }
    }

    /// Returns the text that [`parse`](Self::parse) reads.
    pub fn name(&self) -> String {
        match self {
            Direction::Random(seed) => format!("random:{seed}"),
            Direction::Named(name) => name.clone(),
        }
    }

    /// Returns the direction x0 with velocities in proportion to `rate`, 1/s; the largest component of its (dq,
    /// dv/rate) is 1.
    ///
    /// # Errors
    /// The name is not one of the states.
    pub(super) fn state(&self, coordinates: &Coordinates, rate: f64) -> Result<Matrix> {
        let k = coordinates.freedom();
        let n = coordinates.r.ncols();
        let mut x = match self {
            Direction::Random(seed) => random(*seed, k + n),
            Direction::Named(name) => unit(name, &coordinates.states)?,
        };
        if matches!(self, Direction::Random(_)) {
            x.rows_mut(k, n).scale_mut(rate);
        }
        let Changes { q: dq, v: dv } = coordinates.changes_of(&x);
        let size = dq.amax().max(dv.amax() / rate);
        Ok(if size > 0.0 { x / size } else { x })
    }
}

fn unit(name: &str, states: &[String]) -> Result<Matrix> {
    let place = states.iter().position(|state| state == name).ok_or_else(|| {
        Error::input(format!("the model has no state `{name}`"))
            .under("--along")
            .hint(suggest(name, states.iter().map(String::as_str)))
    })?;
    Ok(Matrix::from_fn(states.len(), 1, |i, _| f64::from(u8::from(i == place))))
}

/// Returns pseudo-random components in [-1, 1], none of them small.
fn random(seed: u64, n: usize) -> Matrix {
    let mut random = Random(seed);
    Matrix::from_fn(n, 1, |_, _| {
        let z = random.bits();
        let size = 0.5 + 0.5 * (z >> 12) as f64 / (1u64 << 52) as f64;
        if z & 1 == 0 { size } else { -size }
    })
}
