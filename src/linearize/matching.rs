//! Matching of the eigenvalues of two states.

use super::{Complex, Matrix, Mode};
use crate::math::eigen::{ComplexMatrix, assign};
use crate::tolerances;

/// An eigenvalue with its shape.
#[derive(Clone, Debug)]
pub(super) struct Node {
    pub value: Complex<f64>,
    /// Its derivative with respect to time or the parameter, where it is known.
    pub slope: Option<Complex<f64>>,
    shape: Vec<Complex<f64>>,
}

impl Node {
    pub fn new(mode: &Mode, slope: Option<Complex<f64>>) -> Self {
        Node { value: mode.value, slope, shape: mode.shape.clone() }
    }

    fn side(&self) -> HalfPlane {
        match self.value.im {
            im if im > 0.0 => HalfPlane::Upper,
            im if im < 0.0 => HalfPlane::Lower,
            _ => HalfPlane::Real,
        }
    }
}

/// Half plane of an eigenvalue, or the real axis.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum HalfPlane {
    Upper,
    Real,
    Lower,
}

/// The eigenvalues at one end of a step.
struct Set {
    sides: Vec<HalfPlane>,
    /// Index of the other one of a conjugate pair.
    partner: Vec<Option<usize>>,
    values: Vec<Complex<f64>>,
}

/// Returns the index in `ends` of each of `starts`, whose values are `predicted`; none where a branch ends.
pub(super) fn matching(
    starts: &[&Node],
    predicted: &[Complex<f64>],
    ends: &[Node],
    mass: &Matrix,
) -> Vec<Option<usize>> {
    let from = Set::new(starts.iter().copied());
    let to = Set::new(ends.iter());
    let cost = cost(starts, predicted, ends, mass);
    let free = Matrix::from_fn(starts.len(), ends.len(), |i, j| {
        if is_allowed(from.sides[i], to.sides[j]) { cost[(i, j)] } else { f64::INFINITY }
    });
    let mut found = places(&free, assign(&free));
    if !is_symmetric(&found, &from, &to) {
        found = pairs_first(&cost, &from, &to);
    }
    order(&mut found, &from, &to);
    found
}

/// True unless a branch would cross the real axis from one half plane to the other.
fn is_allowed(from: HalfPlane, to: HalfPlane) -> bool {
    !matches!((from, to), (HalfPlane::Upper, HalfPlane::Lower) | (HalfPlane::Lower, HalfPlane::Upper))
}

fn are_equal(a: Complex<f64>, b: Complex<f64>) -> bool {
    (a - b).norm() <= tolerances::UNSEEN * a.norm().max(b.norm())
}

/// True if it is clear which mode is which: they change little, and the best assignment is much better than any in
/// which two of them are exchanged.
pub(super) fn is_clear(starts: &[&Node], ends: &[Node], mass: &Matrix) -> bool {
    let values: Vec<Complex<f64>> = starts.iter().map(|start| start.value).collect();
    let from = Set::new(starts.iter().copied());
    let to = Set::new(ends.iter());
    let cost = cost(starts, &values, ends, mass);
    let found = matching(starts, &values, ends, mass);
    let matched: Vec<(usize, usize)> = found.iter().enumerate().filter_map(|(i, j)| Some((i, (*j)?))).collect();
    let exchange = |&(i, j): &(usize, usize), &(k, l): &(usize, usize)| {
        let is_pair = from.partner[i] == Some(k) || to.partner[j] == Some(l);
        let is_possible = !is_pair && is_allowed(from.sides[i], to.sides[l]) && is_allowed(from.sides[k], to.sides[j]);
        let is_one = are_equal(values[i], values[k]) && are_equal(to.values[j], to.values[l]);
        !is_possible || is_one || cost[(i, l)] + cost[(k, j)] - cost[(i, j)] - cost[(k, l)] >= 1.0
    };
    // Where the number of modes changes, states between do not help.
    starts.len() != ends.len()
        || matched.iter().all(|place| cost[*place] <= tolerances::CHANGED_MODE)
            && matched.iter().enumerate().all(|(n, a)| matched[..n].iter().all(|b| exchange(a, b)))
}

/// Returns the columns found by [`assign`], without those that are outside or forbidden.
fn places(cost: &Matrix, assigned: Vec<usize>) -> Vec<Option<usize>> {
    let allowed = |(i, j): (usize, usize)| cost.get((i, j)).filter(|cost| cost.is_finite()).map(|_| j);
    assigned.into_iter().enumerate().map(allowed).collect()
}

/// Returns the cost (1 - MAC) + |lambda - p| / (|lambda| + |p|) of each pair.
fn cost(starts: &[&Node], predicted: &[Complex<f64>], ends: &[Node], mass: &Matrix) -> Matrix {
    let n = mass.nrows();
    let x = shapes(n, starts.iter().copied());
    let y = shapes(n, ends.iter());
    let metric = mass.map(Complex::from);
    let mx = &metric * &x;
    let my = &metric * &y;
    let size = |shape: &ComplexMatrix, weighed: &ComplexMatrix, j: usize| shape.column(j).dotc(&weighed.column(j)).re;
    let sizes = |shape: &ComplexMatrix, weighed: &ComplexMatrix| -> Vec<f64> {
        (0..shape.ncols()).map(|j| size(shape, weighed, j)).collect()
    };
    let of_x = sizes(&x, &mx);
    let of_y = sizes(&y, &my);
    let product = x.adjoint() * &my;
    let floor = floor(predicted.iter().chain(ends.iter().map(|end| &end.value)));
    Matrix::from_fn(starts.len(), ends.len(), |i, j| {
        let sizes = of_x[i] * of_y[j];
        let mac = if sizes > 0.0 { product[(i, j)].norm_sqr() / sizes } else { 0.0 };
        1.0 - mac + apart(predicted[i], ends[j].value, floor)
    })
}

/// |lambda - mu| / (|lambda| + |mu|), zero for two that are rounding.
pub(super) fn apart(a: Complex<f64>, b: Complex<f64>, floor: f64) -> f64 {
    (a - b).norm() / (a.norm() + b.norm() + floor)
}

/// Rounding of the largest finite value.
pub(super) fn floor<'a>(values: impl Iterator<Item = &'a Complex<f64>>) -> f64 {
    let largest = values.map(|value| value.norm()).filter(|size| size.is_finite()).fold(0.0, f64::max);
    (tolerances::EIGENVALUES_AGREE * largest).max(f64::MIN_POSITIVE)
}

fn shapes<'a>(n: usize, nodes: impl Iterator<Item = &'a Node>) -> ComplexMatrix {
    let all: Vec<&Node> = nodes.collect();
    ComplexMatrix::from_fn(n, all.len(), |i, j| all[j].shape.get(i).copied().unwrap_or_default())
}

impl Set {
    fn new<'a>(nodes: impl Iterator<Item = &'a Node>) -> Self {
        let (sides, values): (Vec<HalfPlane>, Vec<Complex<f64>>) = nodes.map(|node| (node.side(), node.value)).unzip();
        let mut partner = vec![None; sides.len()];
        for i in (0..sides.len()).filter(|&i| sides[i] == HalfPlane::Upper) {
            let off = |j: &usize| (values[*j].conj() - values[i]).norm();
            let free = (0..sides.len()).filter(|&j| sides[j] == HalfPlane::Lower && partner[j].is_none());
            if let Some(j) = free.min_by(|a, b| off(a).total_cmp(&off(b))) {
                (partner[i], partner[j]) = (Some(j), Some(i));
            }
        }
        Set { sides, partner, values }
    }

    /// Returns each pair as (index with im > 0, index with im < 0).
    fn pairs(&self) -> Vec<(usize, usize)> {
        let upper = (0..self.sides.len()).filter(|&i| self.sides[i] == HalfPlane::Upper);
        upper.filter_map(|i| Some((i, self.partner[i]?))).collect()
    }
}

/// True if every pair is matched to a pair or becomes real as a whole, and every pair is reached as a whole.
fn is_symmetric(found: &[Option<usize>], from: &Set, to: &Set) -> bool {
    from.pairs().into_iter().all(|(upper, lower)| match (found[upper], found[lower]) {
        (Some(a), Some(b)) if to.sides[a] == HalfPlane::Real => to.sides[b] == HalfPlane::Real,
        (Some(a), Some(b)) => to.partner[a] == Some(b),
        (Some(a), None) | (None, Some(a)) => to.sides[a] == HalfPlane::Real,
        (None, None) => true,
    })
}

/// Matches pairs to pairs first; the remaining ones become real or come from real ones.
fn pairs_first(cost: &Matrix, from: &Set, to: &Set) -> Vec<Option<usize>> {
    let starts = from.pairs();
    let ends = to.pairs();
    let pairs = Matrix::from_fn(starts.len(), ends.len(), |i, j| cost[(starts[i].0, ends[j].0)]);
    let mut found = vec![None; from.sides.len()];
    let mut is_reached = vec![false; to.sides.len()];
    for (i, end) in places(&pairs, assign(&pairs)).into_iter().enumerate() {
        let Some(end) = end else { continue };
        (found[starts[i].0], found[starts[i].1]) = (Some(ends[end].0), Some(ends[end].1));
        (is_reached[ends[end].0], is_reached[ends[end].1]) = (true, true);
    }
    let rows: Vec<usize> = (0..found.len()).filter(|&i| found[i].is_none()).collect();
    let columns: Vec<usize> = (0..is_reached.len()).filter(|&j| !is_reached[j]).collect();
    let rest = Matrix::from_fn(rows.len(), columns.len(), |i, j| cost[(rows[i], columns[j])]);
    for (i, end) in places(&rest, assign(&rest)).into_iter().enumerate() {
        found[rows[i]] = end.map(|end| columns[end]);
    }
    found
}

/// Orders two real eigenvalues that become a pair, or the reverse: the larger belongs to the one with im > 0.
fn order(found: &mut [Option<usize>], from: &Set, to: &Set) {
    for (upper, lower) in from.pairs() {
        if let (Some(a), Some(b)) = (found[upper], found[lower])
            && to.sides[a] == HalfPlane::Real
            && to.values[a].re < to.values[b].re
        {
            found.swap(upper, lower);
        }
    }
    for (upper, lower) in to.pairs() {
        let above = found.iter().position(|place| *place == Some(upper));
        let below = found.iter().position(|place| *place == Some(lower));
        if let (Some(a), Some(b)) = (above, below)
            && from.sides[a] == HalfPlane::Real
            && from.values[a].re < from.values[b].re
        {
            found.swap(a, b);
        }
    }
}
