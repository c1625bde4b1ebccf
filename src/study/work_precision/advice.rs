//! Recommendation of a method from measured runs.

use super::WorkPrecision;
use super::cell::{Cell, Held};
use crate::simulate::Method;
use crate::tolerances;
use serde::Serialize;

/// Largest number of digits recommended for.
const MOST_DIGITS: u32 = 14;

/// Order of preference for runs of equal cost and drift: the best-known methods first, others after them.
const KNOWN: [&[&str]; 3] = [
    &["dop853", "radau_iia", "dopri5", "adams", "rk4", "phem56", "generalized_alpha", "bdf"],
    &["index1", "ggl", "index2", "index3", "null_space", "baumgarte"],
    &["manifold", "exact", "none"],
];

/// The run to choose for a number of digits, and alternatives.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Recommendation {
    /// Number of correct digits.
    pub digits: u32,
    /// Index of the best cell: the cheapest; of a tie the one with the least drift, then the best-known method.
    pub best: usize,
    /// Indices of other methods that cost as little within 15 %: counted work tells times no better.
    pub ties: Vec<usize>,
    /// Index of the best run with another integrator.
    pub next: Option<usize>,
    /// Index of the best explicit run, whose steps stability limits.
    pub explicit: Option<usize>,
    /// Index of the best implicit run.
    pub implicit: Option<usize>,
}

/// Reason why there is no recommendation for a number of digits.
#[derive(Clone, Debug, PartialEq)]
pub struct Lack {
    /// The reason.
    pub why: String,
    /// Advice.
    pub hint: String,
    /// True if there is none for any number of digits.
    pub is_all: bool,
}

impl WorkPrecision {
    /// Returns the reason why no run is known to have this many digits; none where one is.
    #[doc(hidden)]
    pub fn lacks(&self, digits: u32) -> Option<Lack> {
        if self.recommend(digits).is_some() {
            return None;
        }
        let is_all = self.recommendations().is_empty();
        let best = self.cells.iter().filter_map(|cell| Some((cell.error()?, cell)));
        let best = best.min_by(|a, b| a.0.total_cmp(&b.0)).map(|(_, cell)| cell);
        let reference = self.reference.as_ref();
        let (why, hint) = match (reference, best) {
            (None, _) => ("there is no reference".to_string(), "give more time by --budget"),
            (Some(_), None) => {
                ("no run came to its end".to_string(), "give more time by --budget; tradeoff.csv has the reasons")
            }
            (Some(reference), _) if reference.digits() < f64::from(digits) => (
                if reference.worst.is_empty() || reference.digits() < 0.05 {
                    "the reference has no digit that a second run confirms".to_string()
                } else {
                    format!("the reference is sure of {:.1} digits ({})", reference.digits(), reference.worst)
                },
                "give more time by --budget, or choose by --outputs what counts",
            ),
            (Some(_), Some(cell)) => (
                format!(
                    "the most accurate run, {}, has {:.1} digits",
                    cell.method.triple(),
                    cell.digits().unwrap_or(0.0)
                ),
                "give more time by --budget, or try all tolerances by --exhaustive",
            ),
        };
        Some(Lack { why, hint: hint.to_string(), is_all })
    }

    /// Returns the run to choose for at least this many digits; none where no run is known to have them.
    pub fn recommend(&self, digits: u32) -> Option<Recommendation> {
        let tied = self.cheapest(digits, &|_| true);
        let first = |is_meant: &dyn Fn(&Cell) -> bool| self.cheapest(digits, is_meant).first().copied();
        let best = *tied.first()?;
        let cells = &self.cells;
        let mut ties: Vec<usize> = Vec::new();
        for place in tied {
            if [best].iter().chain(&ties).all(|known| !cells[*known].is_of(&cells[place].method)) {
                ties.push(place);
            }
        }
        Some(Recommendation {
            digits,
            best,
            ties,
            next: first(&|cell| cell.method.integrator != cells[best].method.integrator),
            explicit: first(&|cell| cell.is_explicit),
            implicit: first(&|cell| !cell.is_explicit),
        })
    }

    /// Returns the runs with at least this many digits, whose constraints are satisfied to as many, that cost as little
    /// as the cheapest of them; the one to choose first.
    fn cheapest(&self, digits: u32, is_meant: &dyn Fn(&Cell) -> bool) -> Vec<usize> {
        // Outputs that do not move do not show open constraints.
        let gap = 0.1f64.powi(digits as i32).max(tolerances::ROUND_OFF_OF_SOLUTIONS);
        let is_closed = |cell: &Cell| cell.drift().is_some_and(|drift| drift.position <= gap);
        let good = |cell: &Cell| cell.digits() >= Some(f64::from(digits)) && is_closed(cell) && is_meant(cell);
        let cost = |place: &usize| self.cells[*place].cost.unwrap_or(f64::INFINITY);
        let mut tied: Vec<usize> = (0..self.cells.len()).filter(|place| good(&self.cells[*place])).collect();
        let least = tied.iter().map(cost).fold(f64::INFINITY, f64::min);
        tied.retain(|place| cost(place).is_finite() && cost(place) <= 1.15 * least);
        tied.sort_by_key(|place| merit(&self.cells[*place]));
        tied
    }

    /// Returns a recommendation for each number of digits that is reached.
    pub fn recommendations(&self) -> Vec<Recommendation> {
        (1..=MOST_DIGITS).filter_map(|digits| self.recommend(digits)).collect()
    }

    /// Returns the Pareto front: the indices of runs than which none is both cheaper and more accurate, from cheap to
    /// expensive.
    pub fn front(&self) -> Vec<usize> {
        let known = |i: usize| Some((i, (self.cells[i].cost?, self.cells[i].error()?)));
        front((0..self.cells.len()).filter_map(known), |known| known.1).into_iter().map(|(i, _)| i).collect()
    }
}

/// Returns the items than which none is lower in both numbers, the Pareto front, by the first.
pub fn front<T>(items: impl Iterator<Item = T>, of: impl Fn(&T) -> (f64, f64)) -> Vec<T> {
    let mut all: Vec<T> = items.collect();
    let order = |(a, b): (f64, f64), (c, d): (f64, f64)| a.total_cmp(&c).then(b.total_cmp(&d));
    all.sort_by(|one, other| order(of(one), of(other)));
    let mut least = f64::INFINITY;
    all.retain(|item| {
        let is_less = of(item).1 < least;
        least = least.min(of(item).1);
        is_less
    });
    all
}

/// Returns the order of preference, less is better: decades of drift, then how well the method is known.
fn merit(cell: &Cell) -> (i32, [usize; 3], u32) {
    let drift = cell.drift().map_or(1.0, Held::largest).max(tolerances::ROUND_OFF_OF_SOLUTIONS);
    let Method { integrator, formulation, projection, .. } = &cell.method;
    let mut ranks = [0; 3];
    for ((rank, list), spec) in ranks.iter_mut().zip(KNOWN).zip([integrator, formulation, projection]) {
        *rank = list.iter().position(|known| *known == spec.name).unwrap_or(list.len());
    }
    (drift.log10().round() as i32, ranks, cell.decades)
}

fn cost(cell: &Cell) -> f64 {
    cell.cost.unwrap_or(f64::INFINITY)
}

/// Returns the cheapest run with at most this error.
pub(super) fn cheapest(cells: &[Cell], error: f64) -> Option<&Cell> {
    let good = cells.iter().filter(|cell| cell.error().is_some_and(|own| own <= error));
    good.min_by(|a, b| cost(a).total_cmp(&cost(b)))
}

/// Returns the cost of each run over that of the cheapest that is as accurate; none where it has no result.
pub(super) fn behind(cells: &[Cell]) -> Vec<Option<f64>> {
    cells.iter().map(|cell| Some(cell.cost? / cheapest(cells, cell.error()?)?.cost?)).collect()
}

/// Returns for each method the index of its cheapest run with this many digits, else of its most accurate, else of its
/// last; the first list by cost, the second, of the others, by accuracy.
pub fn cheapest_by_method(cells: &[Cell], digits: u32) -> (Vec<usize>, Vec<usize>) {
    let reaches = |i: &usize| cells[*i].digits() >= Some(f64::from(digits));
    let merit = |i: &usize| if reaches(i) { cost(&cells[*i]) } else { cells[*i].error().unwrap_or(f64::INFINITY) };
    let order = |a: &usize, b: &usize| reaches(b).cmp(&reaches(a)).then(merit(a).total_cmp(&merit(b)));
    let places: Vec<usize> = (0..cells.len()).collect();
    let groups = places.chunk_by(|a, b| cells[*a].is_of(&cells[*b].method));
    let mut best: Vec<usize> = groups.filter_map(|group| group.iter().copied().min_by(order)).collect();
    best.sort_by(order);
    best.into_iter().partition(reaches)
}
