//! The modes of two models of one mechanism: which are lost, and which shift.

use super::matching::{apart, floor};
use super::{Branch, Complex, Kind, LinearModel, Matrix, Mode, pairs, seen, visible};
use crate::math::eigen::assign;
use crate::tolerances;

/// The modes of a model, each conjugate pair once, with those of another in their places.
#[derive(Clone, Debug)]
pub struct Against {
    /// Modes of the first model.
    pub modes: Vec<Fate>,
    /// Eigenvalues of the other that are in the place of none.
    pub added: Vec<Complex<f64>>,
    /// Outputs that both have.
    pub outputs: usize,
}

/// A mode, and that of the other model in its place.
#[derive(Clone, Copy, Debug)]
pub struct Fate {
    /// Eigenvalue, 1/s, without what is [rounding](Mode::clean_value).
    pub value: Complex<f64>,
    /// Eigenvalue in its place, also without; none where the mode is lost.
    pub there: Option<Complex<f64>>,
    /// Modal assurance criterion of the common outputs; none with fewer than two, which do not tell modes apart.
    pub mac: Option<f64>,
    /// Part of the mode that outputs see, as in [`seen`].
    pub seen: f64,
}

impl Fate {
    /// |change| of the eigenvalue over its size; none where the mode is lost, or zero here and not there.
    pub fn shift(&self) -> Option<f64> {
        let change = self.there.map(|there| (there - self.value).norm())?;
        let size = self.value.norm();
        if change == 0.0 { Some(0.0) } else { Some(change / size).filter(|shift| shift.is_finite()) }
    }
}

/// Matches the physical modes of two models by the least sum of
///
/// ```text
/// (1 - MAC) + |lambda - mu| / (|lambda| + |mu|),   MAC = |x^H y|^2 / ((x^H x)(y^H y))
/// ```
///
/// with x and y the changes of the outputs that both models have, each relative to the largest by a mode of the same
/// kinetic energy: coordinates of the two are not the same. Modes with one eigenvalue may be mixed at will: of these x is
/// the part of y in their span, and the other way round. A mode for which that leaves more than
/// [`tolerances::CHANGED_MODE`] is lost. Modes that all outputs see alike are told by their eigenvalues only; off
/// equilibrium these belong to the charts of the models.
pub fn against(model: &LinearModel, other: &LinearModel, time: f64) -> Against {
    let common: Vec<[usize; 2]> = model
        .outputs
        .iter()
        .enumerate()
        .filter_map(|(i, name)| Some([i, other.outputs.iter().position(|own| own == name)?]))
        .collect();
    let of = |model| pairs(model, Kind::Physical).into_iter().map(|pair| pair.mode).collect::<Vec<&Mode>>();
    let modes = of(model);
    let others = of(other);
    let changes = |modes: &[&Mode], side: usize| -> Vec<Vec<Complex<f64>>> {
        let of = |mode: &&Mode| {
            let all = visible(mode, time);
            common.iter().filter_map(|pair| all.get(pair[side]).copied()).collect()
        };
        modes.iter().map(of).collect()
    };
    let x = changes(&modes, 0);
    let y = changes(&others, 1);
    let largest = |k: usize| x.iter().chain(&y).filter_map(|x| x.get(k)).fold(0.0, |most: f64, x| most.max(x.norm()));
    // What no mode moves tells nothing: the energy at rest has no first derivative but round-off.
    let all = (0..common.len()).map(largest).fold(0.0, f64::max);
    let least = tolerances::ROUND_OFF_OF_SUMS * all;
    let size = |k: usize| Some(largest(k)).filter(|size| *size > least).unwrap_or(f64::INFINITY);
    let sizes: Vec<f64> = (0..common.len()).map(size).collect();
    let values = |modes: &[&Mode]| modes.iter().map(|mode| mode.clean_value()).collect::<Vec<_>>();
    let from = values(&modes);
    let to = values(&others);
    let floor = floor(from.iter().chain(&to));
    let scaled = |all: Vec<Vec<Complex<f64>>>| -> Vec<Vec<Complex<f64>>> {
        all.iter().map(|own| own.iter().zip(&sizes).map(|(y, size)| y / size).collect()).collect()
    };
    let spans = |all: &[Vec<Complex<f64>>], values: &[Complex<f64>]| -> Vec<Vec<Vec<Complex<f64>>>> {
        let is_one = |a: usize, b: usize| apart(values[a], values[b], floor) <= tolerances::EIGENVALUES_AGREE;
        (0..all.len()).map(|i| basis((0..all.len()).filter(|k| is_one(i, *k)).map(|k| &all[k]))).collect()
    };
    let x = scaled(x);
    let y = scaled(y);
    let [of_x, of_y] = [spans(&x, &from), spans(&y, &to)];
    let mac = |i: usize, j: usize| {
        let both = (part_within(&of_x[i], &y[j])?, part_within(&of_y[j], &x[i])?);
        (common.len() > 1).then(|| both.0.max(both.1))
    };
    let cost = |i: usize, j: usize| mac(i, j).map_or(0.0, |mac| 1.0 - mac) + apart(from[i], to[j], floor);
    let places = places(&Matrix::from_fn(from.len(), to.len(), cost));
    let parts = seen(&modes, time);
    let fate = |(i, place): (usize, &Option<usize>)| Fate {
        value: from[i],
        there: place.map(|j| to[j]),
        mac: place.and_then(|j| mac(i, j)),
        seen: parts[i],
    };
    let added = (0..to.len()).filter(|j| !places.contains(&Some(*j))).map(|j| to[j]).collect();
    Against { modes: places.iter().enumerate().map(fate).collect(), added, outputs: common.len() }
}

/// An orthonormal basis of these.
fn basis<'a>(all: impl Iterator<Item = &'a Vec<Complex<f64>>>) -> Vec<Vec<Complex<f64>>> {
    let mut basis: Vec<Vec<Complex<f64>>> = Vec::new();
    for x in all {
        let mut rest = x.clone();
        for own in &basis {
            let part = product(own, &rest);
            rest.iter_mut().zip(own).for_each(|(rest, own)| *rest -= own * part);
        }
        let size = product(x, x).re.sqrt();
        let left = product(&rest, &rest).re.sqrt();
        if left > tolerances::EIGENVALUES_AGREE * size {
            basis.push(rest.iter().map(|rest| rest / left).collect());
        }
    }
    basis
}

/// Part of |y|^2 in the span of a basis, the MAC where that is of one; none where one of both is zero.
fn part_within(basis: &[Vec<Complex<f64>>], y: &[Complex<f64>]) -> Option<f64> {
    let parts = basis.iter().map(|own| product(own, y).norm_sqr()).sum::<f64>();
    let all = product(y, y).re;
    (all > 0.0 && !basis.is_empty()).then(|| parts / all)
}

/// x^H y
fn product(x: &[Complex<f64>], y: &[Complex<f64>]) -> Complex<f64> {
    x.iter().zip(y).map(|(x, y)| x.conj() * y).sum()
}

/// The column of each row; none where that costs too much.
fn places(cost: &Matrix) -> Vec<Option<usize>> {
    let is_near =
        |(i, j): (usize, usize)| cost.get((i, j)).filter(|cost| **cost <= tolerances::CHANGED_MODE).map(|_| j);
    // A place that costs too much is worth no other mode's change of place.
    let most = cost.map(|x| if x <= tolerances::CHANGED_MODE { x } else { f64::INFINITY });
    assign(&most).into_iter().enumerate().map(is_near).collect()
}

/// Place of each branch among others by the mean of |lambda - mu| / (|lambda| + |mu|) over the times that both have;
/// none where it is lost. Their shapes are not known.
pub fn branch_places(branches: &[&Branch], others: &[&Branch]) -> Vec<Option<usize>> {
    let floor = floor(branches.iter().chain(others).flat_map(|branch| branch.points.iter().map(|(_, value)| value)));
    let cost = |i: usize, j: usize| {
        let (sum, count) = both(branches[i], others[j])
            .fold((0.0, 0), |(sum, count), (_, [a, b])| (sum + apart(a, b, floor), count + 1));
        if count > 0 { sum / f64::from(count) } else { f64::INFINITY }
    };
    places(&Matrix::from_fn(branches.len(), others.len(), cost))
}

/// The finite eigenvalues of two branches at the times, or values, that both have.
pub fn both<'a>(one: &'a Branch, other: &'a Branch) -> impl Iterator<Item = (f64, [Complex<f64>; 2])> {
    let at = |at: f64| {
        let found = other.points.binary_search_by(|(place, _)| place.total_cmp(&at)).ok();
        found.map(|i| other.points[i].1).filter(|value| value.re.is_finite())
    };
    one.points
        .iter()
        .filter(|(_, value)| value.re.is_finite())
        .filter_map(move |(t, value)| Some((*t, [*value, at(*t)?])))
}
