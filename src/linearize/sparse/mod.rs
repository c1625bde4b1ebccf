//! A few modes of a large mechanism, without a dense matrix of its size.

mod equations;
mod gain;

use super::changes::beside;
use super::entry::LinearMatrices;
use super::input_states::InputStates;
use super::perturbation::Perturbation;
use super::response::observe;
use super::spectrum::{modes_of, refused};
use super::{Changes, Complex, Cost, Lift, LinearModel, Matrix, Response, Variation};
use crate::error::{Error, Result};
use crate::math::eigen::Unsolved;
use crate::modes::reduce::{self, Modal};
use crate::modes::search::{self, Found, Space};
use crate::modes::{Quadratic, Sparse};
use std::time::Instant;

/// Residual of a mode that is returned, with the operator of the search. Unit: `[1]` of |theta x|. Why: rounding in K
/// is some 1e-16 of the square of the fastest rate over the square of that of the mode, and nothing makes up for it.
const MODE_RESIDUAL: f64 = 1e-4;

/// Returns the `count` modes nearest to `shift`, in 1/s (0: the slowest ones), as a model in modal coordinates. A
/// conjugate pair is one mode. Fewer come where the mechanism has fewer, and more where one has no eigenvector of its
/// own.
///
/// The frozen index-3 pencil, exact at an equilibrium:
///
/// ```text
/// dq' = dv - [v, dq],   M dv' = -K dq - C dv - G^T dlambda + f_u du,   G dq = 0
/// ```
///
/// A is block diagonal: [re im; -im re] for a pair, re for a real eigenvalue, states `mode1.re`, `mode1.im`, the
/// largest change of a coordinate or state xi of a unit of which is 1. Eigenvalues without independent vectors, such as
/// the double zeros of a free body, have a common block of states `shared1` ... B follows from left vectors. D has the
/// gain at s = 0 of the modes truncated, so that the model's static gain is right (mode acceleration); where rigid
/// bodies make that infinite, their gain at the real shift of the search, a fiftieth of the fastest rate found, and
/// nothing for a complex shift.
///
/// Krylov-Schur on (A - sigma E)^-1 E and on its adjoint, with dv eliminated: each takes one sparse factorization of
/// [sigma^2 M + sigma C + K, G^T; G, 0] and a solution per application, so cost is linear in the number of links of a
/// chain; all is real for a real shift. sigma lies close to `shift`. Source of the elimination: Tisseur, Meerbergen,
/// "The quadratic eigenvalue problem", SIAM Review 43 (2001) 235-286.
///
/// # Errors
/// No mode asked for or none there; eigenvalues that do not converge; outputs without derivatives.
pub fn modal(variation: &mut Variation, count: usize, shift: Complex<f64>) -> Result<LinearModel> {
    let clock = Instant::now();
    let turn = equations::turn(variation);
    let equations = equations::equations(variation, &turn);
    check(&equations, count, shift)?;
    let shift = Complex::new(shift.re, shift.im.abs());
    let adjoint = equations.transposed();
    let assembly = clock.elapsed().as_secs_f64();
    let clock = Instant::now();
    let t = variation.point.t;
    let count = count.min(equations.finite);
    let unsolved = |unsolved: Unsolved| refused(t, &unsolved);
    let mut found = search::find([&equations, &adjoint], count, shift).map_err(unsolved)?;
    for space in [&mut found.right, &mut found.left] {
        hold(variation, &equations, space)?;
    }
    let modal = reduce::reduce(&equations, &found, count, shift).map_err(unsolved)?;
    let eigen = clock.elapsed().as_secs_f64();
    let clock = Instant::now();
    let (mut built, forces) = build(variation, &equations, &turn, modal)?;
    gain::add_residual(variation, &equations, &turn, &mut found, &mut built, &forces)?;
    let assembly = assembly + clock.elapsed().as_secs_f64();
    finish(variation, &mut found, built, assembly, eigen)
}

fn check(equations: &Quadratic, count: usize, shift: Complex<f64>) -> Result<()> {
    if count == 0 {
        return Err(Error::input("no mode is asked for").under("--modes").hint("ask for 1 or more"));
    }
    if equations.finite == 0 {
        return Err(Error::input("the mechanism has no degree of freedom here, so no modes"));
    }
    if shift.re.is_finite() && shift.im.is_finite() {
        Ok(())
    } else {
        Err(Error::input("the shift is not finite").under("--shift"))
    }
}

/// Removes the components off the constraints that rounding and infinite eigenvalues cause.
fn hold(variation: &mut Variation, equations: &Quadratic, space: &mut Space) -> Result<()> {
    for part in [&mut space.p, &mut space.u] {
        *part -= variation.correct(&equations.g.product(part))?;
    }
    Ok(())
}

/// Returns dq = p, dv = s p + [v, p]; dxi = p. `turn` is [v, .].
fn changes(variation: &Variation, turn: &Sparse, space: &Space) -> Changes {
    let mut q = space.p.clone();
    let mut v = &space.u + turn.product(&space.p);
    let n = variation.system().dimensions();
    v.rows_mut(n.moving(), n.states).copy_from(&space.p.rows(n.moving(), n.states));
    q.rows_mut(n.moving(), n.states).fill(0.0);
    Changes { q, v }
}

/// Adds inputs and outputs. Returns also the forces of a unit of each state of the inputs and of each input: with
/// dq = p + P u for what drivers prescribe, -(M P u'' + C P u' + K P u) is one.
fn build(
    variation: &mut Variation,
    equations: &Quadratic,
    turn: &Sparse,
    modal: Modal,
) -> Result<(LinearMatrices, Matrix)> {
    let n = equations.len();
    let changes = changes(variation, turn, &modal.space);
    let lift = Lift::frozen(variation, &Matrix::zeros(n, 0), &Matrix::zeros(0, n))?;
    let perturbation = Perturbation::new(variation, &changes, |i, j| lift.along(i, j));
    let response = Response::exact(variation, &perturbation)?;
    let outputs = observe(&variation.outputs()?, &perturbation, &response);
    let [states, inputs] = perturbation.input_forces();
    let mut forces = beside(&states, &inputs);
    if variation.has_drivers() {
        let terms = [&equations.stiffness, &equations.damping, &equations.mass];
        for (term, u) in terms.into_iter().zip(&perturbation.u) {
            forces -= term.product(&lift.p) * u.columns_range(changes.q.ncols()..);
        }
    }
    let columns = modal.inputs * &forces;
    let driven = columns.columns(0, states.ncols());
    let b = columns.columns_range(states.ncols()..);
    let input_states = InputStates { orders: variation.orders(), a: driven.clone_owned(), c: outputs.input_states };
    let chart = "modal".to_string();
    let states = modal.states;
    let b = b.clone_owned();
    let c = outputs.state;
    let d = outputs.inputs;
    Ok((
        LinearMatrices {
            chart,
            states,
            a: modal.a,
            b,
            c,
            d,
            e: None,
            input_states,
            changes,
            coordinates: None,
            infinite: 0,
        },
        forces,
    ))
}

/// Adds the modes, the residual of each checked.
fn finish(
    variation: &mut Variation,
    found: &mut Found,
    built: LinearMatrices,
    assembly_seconds: f64,
    eigen_seconds: f64,
) -> Result<LinearModel> {
    let t = variation.point.t;
    let (modes, vectors, conditioning) = modes_of(variation, &built).map_err(|unsolved| refused(t, &unsolved))?;
    let shapes = built.shapes(variation.system().dimensions());
    let space = [shapes.map(Complex::from), free_rates(variation, &built, &shapes).map(Complex::from)];
    for (mode, vector) in modes.iter().zip(vectors.column_iter()) {
        let [p, u] = [&space[0] * vector, &space[1] * vector];
        let residual = found.operator.residual(mode.value, p.iter().chain(u.iter()).copied());
        let residual = residual.map_err(|unsolved| refused(t, &unsolved))?;
        if residual.is_nan() || residual > MODE_RESIDUAL {
            return Err(refused(t, &Unsolved::NotConverged { converged: 0, wanted: modes.len() }));
        }
    }
    let size = built.a.nrows();
    let cost = Cost { assembly_seconds, eigen_seconds, conditioning, size, off_constraints: None };
    Ok(built.finish(variation, "modal".to_string(), modes, cost))
}

/// Returns s dq = dv - [v, dq] of each state, and s dxi, which is that of its `shapes`.
fn free_rates(variation: &Variation, built: &LinearMatrices, shapes: &Matrix) -> Matrix {
    let mut rates = &built.changes.v - variation.bracket_with(&built.changes.q);
    let n = variation.system().dimensions();
    rates.rows_mut(n.moving(), n.states).copy_from(&(shapes.rows(n.moving(), n.states) * &built.a));
    rates
}
