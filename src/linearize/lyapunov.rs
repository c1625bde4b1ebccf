//! Lyapunov exponents: average growth rates of small changes.

use super::flow::{Bundle, flow};
use super::{Changes, Chart, Matrix, State, Variation};
use crate::error::Result;
use crate::system::MechanicalSystem;

/// Average growth rates along a motion.
#[derive(Clone, Debug, PartialEq)]
pub struct Lyapunov {
    /// Times after the start, s.
    pub times: Vec<f64>,
    /// At each time the exponents up to it, largest first, 1/s. Their sum is the average divergence: 0 without damping.
    pub exponents: Vec<Vec<f64>>,
}

impl Lyapunov {
    /// Exponents at the end, 1/s.
    pub fn last(&self) -> &[f64] {
        self.exponents.last().map_or(&[], Vec::as_slice)
    }
}

/// Returns all exponents over `duration`, the columns made orthonormal every `renewal` s: Benettin, Galgani, Giorgilli,
/// Strelcyn, Meccanica 15 (1980) 9-20. They converge as 1/t at best; the finite-time values are returned, so that this
/// shows.
///
/// # Errors
/// A motion that cannot go on.
pub fn lyapunov(
    system: &dyn MechanicalSystem,
    start: &State,
    duration: f64,
    renewal: f64,
    mut progress: impl FnMut(f64),
) -> Result<Lyapunov> {
    let mut variation = Variation::new(system, start.t, &start.q, &start.v)?;
    let columns = Chart::MassOrthogonal.at(&mut variation)?.changes();
    let bundle = Bundle { columns: orthonormal(&columns).0, ..Bundle::of(start) };
    let count = (duration / renewal).round().max(1.0) as usize;
    let times: Vec<f64> = (1..=count).map(|i| duration * i as f64 / count as f64).collect();
    let mut sums = vec![0.0; columns.q.ncols()];
    let mut exponents = Vec::new();
    flow(system, &bundle, &times.iter().map(|t| start.t + t).collect::<Vec<f64>>(), |snapshot| {
        let (renewed, growth) = orthonormal(&snapshot.columns);
        snapshot.columns = renewed;
        sums.iter_mut().zip(&growth).for_each(|(sum, growth)| *sum += growth.ln());
        let t = snapshot.motion.t - start.t;
        let mut now: Vec<f64> = sums.iter().map(|sum| sum / t).collect();
        now.sort_by(|a, b| b.total_cmp(a));
        exponents.push(now);
        progress(t);
        true
    })?;
    Ok(Lyapunov { times, exponents })
}

/// Q and the diagonal of R of the stacked columns (dq, dv). The exponents do not depend on the norm.
fn orthonormal(columns: &Changes) -> (Changes, Vec<f64>) {
    let (n, k) = columns.q.shape();
    let mut stacked = Matrix::zeros(2 * n, k);
    stacked.rows_mut(0, n).copy_from(&columns.q);
    stacked.rows_mut(n, n).copy_from(&columns.v);
    let qr = stacked.qr();
    let q = qr.q();
    let r = qr.r();
    let changes = Changes { q: q.rows(0, n).clone_owned(), v: q.rows(n, n).clone_owned() };
    (changes, (0..k).map(|i| r[(i, i)].abs()).collect())
}
