//! Minimal coordinates (MCS): the model in a chart of the directions that the constraints allow.

use super::{Chart, Coordinates, Matrix, Variation};
use super::variation::at_state;
use crate::error::Result;

/// (A, B, C, D) in the states (z, y) of a chart.
#[derive(Clone, Debug)]
pub struct Minimal {
    pub coordinates: Coordinates,
    pub a: Matrix,
    pub b: Matrix,
    pub c: Matrix,
    pub d: Matrix,
}

/// How the whole state answers to a few directions or inputs, a column each.
struct Answers {
    vdot: Matrix,
    lambda: Matrix,
}

/// The model in a chart: each state is a change (dq, dv) that the constraints allow, and a back-substitution gives its dv'
/// and dlambda. Exact in constant charts and in the intrinsic one. Gonzalez, Masarati, Cuadrado, Naya, J. Comput.
/// Nonlinear Dyn. 12 (2017), with the terms of a moving basis.
pub fn minimal(variation: &mut Variation, chart: &Chart) -> Result<Minimal> {
    let coordinates = chart.at(variation)?;
    let k = coordinates.r.ncols();
    let dq = stacked([&coordinates.r, &Matrix::zeros(variation.len(), k)]);
    let dv = stacked([&coordinates.tilt, &coordinates.r]);
    let answers = accelerate(variation, &dq, &dv)?;
    let mut a = Matrix::zeros(2 * k, 2 * k);
    a.view_mut((0, 0), (k, k)).copy_from(&coordinates.turn);
    a.view_mut((0, k), (k, k)).fill_with_identity();
    let lower = &coordinates.b * &answers.vdot - stacked([&coordinates.drift[0], &coordinates.drift[1]]);
    a.view_mut((k, 0), (k, 2 * k)).copy_from(&lower);
    let driven = drive(variation)?;
    let outputs = variation.outputs();
    let b = below(&coordinates.b * &driven.vdot);
    let c = &outputs.q * dq + &outputs.v * dv + &outputs.lambda * answers.lambda;
    let d = &outputs.u + &outputs.lambda * driven.lambda;
    Ok(Minimal { coordinates, a, b, c, d })
}

fn accelerate(variation: &mut Variation, dq: &Matrix, dv: &Matrix) -> Result<Answers> {
    let n = (variation.len(), variation.point.lambda.len());
    let mut answers = Answers { vdot: Matrix::zeros(n.0, dq.ncols()), lambda: Matrix::zeros(n.1, dq.ncols()) };
    let v = variation.point.v.clone();
    for j in 0..dq.ncols() {
        let (mut vdot, mut lambda) = (answers.vdot.column_mut(j), answers.lambda.column_mut(j));
        let change = (dq.column(j).clone_owned(), dv.column(j).clone_owned());
        let solved =
            variation.accelerate(&v, (change.0.as_slice(), change.1.as_slice()), (vdot.as_mut_slice(), lambda.as_mut_slice()));
        solved.map_err(|halt| at_state(variation.point.t, &halt))?;
    }
    Ok(answers)
}

/// dv' and dlambda of a unit of each input.
fn drive(variation: &mut Variation) -> Result<Answers> {
    let mut vdot = variation.inputs();
    let mut lambda = Matrix::zeros(variation.point.lambda.len(), vdot.ncols());
    for (mut vdot, mut lambda) in vdot.column_iter_mut().zip(lambda.column_iter_mut()) {
        let solved = variation.push(vdot.as_mut_slice(), lambda.as_mut_slice());
        solved.map_err(|halt| at_state(variation.point.t, &halt))?;
    }
    Ok(Answers { vdot, lambda })
}

/// [left right]
fn stacked([left, right]: [&Matrix; 2]) -> Matrix {
    let mut both = left.clone().resize_horizontally(left.ncols() + right.ncols(), 0.0);
    both.columns_mut(left.ncols(), right.ncols()).copy_from(right);
    both
}

/// [0; lower]
fn below(lower: Matrix) -> Matrix {
    let k = lower.nrows();
    lower.insert_rows(0, k, 0.0)
}
