//! What to choose.

use super::WorkPrecision;
use super::cell::{Cell, Held};
use serde::Serialize;

/// Digits by which a reference must be better than what it vouches for.
const BETTER: f64 = 2.0;
/// Digits that are asked for.
const MOST_DIGITS: u32 = 14;

/// Runs that take up to this much longer than the cheapest are as cheap, as far as a clock can tell: of those with its
/// integrator the one that drifts least is recommended.
const AS_CHEAP: f64 = 1.1;

/// The cheapest run for so many digits, and the next.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub struct Recommendation {
    pub digits: u32,
    /// Places in the list of cells.
    pub best: usize,
    /// The cheapest with another integrator.
    pub next: Option<usize>,
    /// The cheapest whose steps stability limits, and that whose steps may be as long as they like.
    pub explicit: Option<usize>,
    pub implicit: Option<usize>,
}

impl WorkPrecision {
    /// The cheapest run for at least so many digits; none where no run has them, or the reference cannot tell.
    pub fn recommend(&self, digits: u32) -> Option<Recommendation> {
        if f64::from(digits) + BETTER > self.reference.as_ref()?.digits() {
            return None;
        }
        let cells = &self.cells;
        let cheapest = |is_meant: &dyn Fn(&Cell) -> bool| {
            let good = |i: &usize| cells[*i].digits() >= Some(f64::from(digits)) && is_meant(&cells[*i]);
            let times = (0..cells.len()).filter(good).filter_map(|i| Some((i, cells[i].seconds()?)));
            let times: Vec<(usize, f64)> = times.collect();
            let (first, least) = times.iter().copied().min_by(|a, b| a.1.total_cmp(&b.1))?;
            let drift = |i: usize| cells[i].drift().map_or(f64::INFINITY, Held::largest);
            let is_like = |i: usize| cells[i].method.integrator == cells[first].method.integrator;
            let as_cheap = times.into_iter().filter(|(i, seconds)| *seconds <= AS_CHEAP * least && is_like(*i));
            as_cheap.map(|(i, _)| i).min_by(|a, b| drift(*a).total_cmp(&drift(*b)))
        };
        let best = cheapest(&|_| true)?;
        Some(Recommendation {
            digits,
            best,
            next: cheapest(&|cell| cell.method.integrator != cells[best].method.integrator),
            explicit: cheapest(&|cell| cell.is_explicit),
            implicit: cheapest(&|cell| !cell.is_explicit),
        })
    }

    /// One for each number of digits that is reached.
    pub fn recommendations(&self) -> Vec<Recommendation> {
        (1..=MOST_DIGITS).filter_map(|digits| self.recommend(digits)).collect()
    }

    /// The places of runs than which none is both cheaper and more accurate, from cheap to dear.
    pub fn front(&self) -> Vec<usize> {
        let known = |i: usize| Some((i, self.cells[i].seconds()?, self.cells[i].error()?));
        let mut all: Vec<(usize, f64, f64)> = (0..self.cells.len()).filter_map(known).collect();
        all.sort_by(|a, b| a.1.total_cmp(&b.1).then(a.2.total_cmp(&b.2)));
        let mut best = f64::INFINITY;
        all.retain(|(_, _, error)| {
            let is_better = *error < best;
            best = best.min(*error);
            is_better
        });
        all.into_iter().map(|(i, ..)| i).collect()
    }
}

/// The cheapest run with at most this error.
pub(super) fn cheapest(cells: &[Cell], error: f64) -> Option<&Cell> {
    let good = cells.iter().filter(|cell| cell.error().is_some_and(|own| own <= error));
    good.min_by(|a, b| a.seconds().unwrap_or(f64::INFINITY).total_cmp(&b.seconds().unwrap_or(f64::INFINITY)))
}

/// The places of runs that take at most `factor` times as long as the cheapest that is as accurate.
pub(super) fn near_best(cells: &[Cell], factor: f64) -> Vec<usize> {
    let is_near = |cell: &Cell| {
        let best = cheapest(cells, cell.error()?)?;
        Some(cell.seconds()? <= factor * best.seconds()?)
    };
    (0..cells.len()).filter(|i| is_near(&cells[*i]) == Some(true)).collect()
}

/// Of each method the place of its cheapest run with so many digits, else of its most accurate, else of its last; the
/// first kind by time, the others by accuracy.
pub fn cheapest_by_method(cells: &[Cell], digits: u32) -> (Vec<usize>, Vec<usize>) {
    let (mut reached, mut others): (Vec<usize>, Vec<usize>) = (Vec::new(), Vec::new());
    for group in cells.chunk_by(|a, b| a.is_of(&b.method)) {
        let first = group.as_ptr_range();
        let offset = cells.iter().position(|cell| std::ptr::eq(cell, first.start)).unwrap_or(0);
        let seconds = |i: &usize| group[*i].seconds().unwrap_or(f64::INFINITY);
        let good = (0..group.len()).filter(|i| group[*i].digits() >= Some(f64::from(digits)));
        match good.min_by(|a, b| seconds(a).total_cmp(&seconds(b))) {
            Some(i) => reached.push(offset + i),
            None => {
                let error = |i: &usize| group[*i].error().unwrap_or(f64::INFINITY);
                let best = (0..group.len()).min_by(|a, b| error(a).total_cmp(&error(b)));
                others.extend(best.map(|i| offset + i));
            }
        }
    }
    let time = |i: &usize| cells[*i].seconds().unwrap_or(f64::INFINITY);
    let error = |i: &usize| cells[*i].error().unwrap_or(f64::INFINITY);
    reached.sort_by(|a, b| time(a).total_cmp(&time(b)));
    others.sort_by(|a, b| error(a).total_cmp(&error(b)));
    (reached, others)
}
