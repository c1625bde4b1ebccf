//! Derivatives of eigenvalues by left and right vectors and the derivative of the model.

use super::changes::beside;
use super::entry::LinearMatrices;
use super::spectrum::Vectors;
use super::{Complex, Matrix, Mode};
use crate::error::Result;
use crate::math::eigen::{ComplexMatrix, times};
use crate::tolerances::{DEFECTIVE_MODE, EIGENVALUES_AGREE};

/// The derivative of an eigenvalue with respect to a parameter or to time. As JSON its parts are `d_re`, `d_im` and
/// `error`, null without a derivative.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Slope {
    /// The eigenvalue, 1/s.
    pub value: Complex<f64>,
    /// Its derivative; none of a defective eigenvalue, which moves with the root of the change, and of one that is zero
    /// to rounding.
    pub derivative: Option<Complex<f64>>,
    /// |error| of the derivative: the last change by extrapolation, and what rounding of the eigenvalue makes of it.
    pub error: f64,
}

impl serde::Serialize for Slope {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let Slope { value, derivative, error } = self;
        let known = derivative.map(|slope| (Some(slope.re), Some(slope.im), Some(*error)));
        let (d_re, d_im, error) = known.unwrap_or_default();
        let parts = [("re", Some(value.re)), ("im", Some(value.im)), ("d_re", d_re), ("d_im", d_im), ("error", error)];
        serializer.collect_map(parts)
    }
}

/// The derivative of a model, [A' E'], or A' where it has no E.
pub(super) struct ModelRate {
    best: Matrix,
    /// Difference of the last two extrapolations.
    change: Matrix,
    /// The smallest step.
    step: f64,
}

impl ModelRate {
    /// Returns the derivative at zero of the model that `model` gives beside the one `here`; none where a model does not
    /// exist or has another number of states. Central differences over steps h, h/2, h/4 .. have errors that are series in
    /// h^2, which are extrapolated to zero (Richardson).
    ///
    /// Parameters are folded into the numbers of a scene when it is read, so no dual numbers pass through them.
    pub fn new(
        here: &LinearMatrices,
        steps: &[f64],
        mut model: impl FnMut(f64) -> Result<LinearMatrices>,
    ) -> Option<Self> {
        let mut row = Vec::new();
        for step in steps {
            let above = in_states_of(here, &model(*step).ok()?)?;
            let below = in_states_of(here, &model(-step).ok()?)?;
            row.push((above - below) / (2.0 * step));
        }
        let mut change = row.first()? * 0.0;
        let mut factor = 1.0;
        while let [.., before, last] = row.as_slice() {
            change = last - before;
            factor *= 4.0;
            row = row.windows(2).map(|pair| (&pair[1] * factor - &pair[0]) / (factor - 1.0)).collect();
        }
        Some(ModelRate { best: row.pop()?, change, step: *steps.last()? })
    }

    /// Returns the derivative of each finite mode,
    ///
    /// ```text
    /// lambda' = y^H (A' - lambda E') x,   y^H E x = 1
    /// ```
    ///
    /// and of equal eigenvalues with vectors of their own the eigenvalues of the matrix of such products.
    pub fn slopes(&self, vectors: &Vectors, modes: &[Mode]) -> Vec<Slope> {
        let modes = &modes[..vectors.right.ncols()];
        let pushed = push(&self.best, &vectors.right, modes);
        let changes = push(&self.change, &vectors.right, modes);
        let is_simple = |mode: &Mode| mode.condition < DEFECTIVE_MODE && !mode.is_zero();
        let is_equal = |a: &Mode, b: &Mode| (a.value - b.value).norm() <= EIGENVALUES_AGREE * a.value.norm();
        let slope = |(i, mode): (usize, &Mode)| {
            let equal: Vec<usize> =
                (0..modes.len()).filter(|&j| is_simple(&modes[j]) && is_equal(mode, &modes[j])).collect();
            let derivative = is_simple(mode).then(|| among_equal(&vectors.left, &pushed, &equal, i)).flatten();
            let changed = vectors.left.column(i).dotc(&changes.column(i)).norm();
            Slope { value: mode.value, derivative, error: changed + mode.error / self.step.abs() }
        };
        modes.iter().enumerate().map(slope).collect()
    }
}

/// (A' - lambda E') x, a column for each mode.
fn push(rate: &Matrix, right: &ComplexMatrix, modes: &[Mode]) -> ComplexMatrix {
    let n = rate.nrows();
    let mut pushed = times(&rate.columns(0, n).clone_owned(), right);
    if rate.ncols() > n {
        let moved = times(&rate.columns(n, n).clone_owned(), right);
        let columns = pushed.column_iter_mut().zip(moved.column_iter()).zip(modes);
        columns.for_each(|((mut to, moved), mode)| to -= moved * mode.value);
    }
    pushed
}

/// The derivative of mode `i`, one of those `equal` to it.
fn among_equal(left: &ComplexMatrix, pushed: &ComplexMatrix, equal: &[usize], i: usize) -> Option<Complex<f64>> {
    let product = |i: usize, j: usize| left.column(i).dotc(&pushed.column(j));
    if equal.len() < 2 {
        return Some(product(i, i));
    }
    let block = ComplexMatrix::from_fn(equal.len(), equal.len(), |row, column| product(equal[row], equal[column]));
    let index = equal.iter().position(|&j| j == i)?;
    block.try_schur(f64::EPSILON, 0)?.eigenvalues()?.get(index).copied()
}

/// Returns [A E], or A, of another model in the states of a chart `here`: changes of q and v that the other state allows
/// are counted as this chart counts them.
fn in_states_of(here: &LinearMatrices, other: &LinearMatrices) -> Option<Matrix> {
    let a = match &here.coordinates {
        Some(chart) => {
            let to = chart.states_of(&other.changes);
            let from = to.is_square().then(|| to.clone().try_inverse())??;
            to * &other.a * from
        }
        None => other.a.clone(),
    };
    let both = other.e.as_ref().map_or_else(|| a.clone(), |e| beside(&a, e));
    (a.shape() == here.a.shape()).then_some(both)
}
