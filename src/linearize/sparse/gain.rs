//! Static gain of the truncated modes.

use super::changes;
use crate::error::Result;
use crate::linearize::changes::beside;
use crate::linearize::entry::LinearMatrices;
use crate::linearize::perturbation::Perturbation;
use crate::linearize::response::observe;
use crate::linearize::spectrum::refused;
use crate::linearize::{Matrix, Response, Variation};
use crate::modes::search::{Found, Operator, Space};
use crate::modes::shifted::Shifted;
use crate::modes::{Quadratic, Sparse};
use crate::tolerances;

/// Adds H(s) - C (s - A)^-1 B at s = 0 to the direct part of each column, H the transfer function of all modes. `forces`
/// are those of a unit of each state of the inputs and of each input.
pub fn add_residual<'a>(
    variation: &mut Variation,
    equations: &'a Quadratic,
    turn: &Sparse,
    found: &mut Found<'a>,
    built: &mut LinearMatrices,
    forces: &Matrix,
) -> Result<()> {
    if forces.ncols() == 0 || built.c.nrows() == 0 {
        return Ok(());
    }
    let t = variation.point.t;
    let mut at_zero = at_zero(equations);
    let at = match (&mut at_zero, &mut found.operator) {
        (Some(at_zero), _) => at_zero,
        (None, Operator::Real(operator)) => operator,
        (None, Operator::Complex(_)) => return Ok(()),
    };
    let s = at.sigma;
    let mut p = Matrix::zeros(equations.len(), forces.ncols());
    for (force, mut to) in forces.column_iter().zip(p.column_iter_mut()) {
        to.copy_from(&force);
        at.solve(to.as_mut_slice()).map_err(|unsolved| refused(t, &unsolved))?;
    }
    let changes = changes(variation, turn, &Space { u: &p * s, p });
    let perturbation = Perturbation::new(variation, &changes, |_, _| None);
    let response = Response::exact(variation, &perturbation)?;
    let gain = observe(&variation.outputs()?, &perturbation, &response).state;
    let size = built.a.nrows();
    let columns = beside(&built.input_states.a, &built.b);
    if let Some(states_of_columns) = (Matrix::identity(size, size) * s - &built.a).lu().solve(&columns) {
        let rest = gain - &built.c * states_of_columns;
        let states = built.input_states.a.ncols();
        built.input_states.c += rest.columns(0, states);
        built.d += rest.columns(states, rest.ncols() - states);
    }
    Ok(())
}

/// Returns the equations at s = 0 if they have a stiffness above rounding along the softest direction; none otherwise.
fn at_zero(equations: &Quadratic) -> Option<Shifted<'_, f64>> {
    let mut operator = Shifted::new(equations, 0.0, 1.0).ok()?;
    let mut p: Vec<f64> = (0..equations.len()).map(|i| 1.0 + (i as f64).sin()).collect();
    for _ in 0..2 {
        let mut weighed = vec![0.0; p.len()];
        equations.mass.add_product(&p, 1.0, &mut weighed);
        let size = weighed.iter().map(|x| x.abs()).fold(f64::MIN_POSITIVE, f64::max);
        weighed.iter_mut().for_each(|x| *x /= size);
        operator.solve(&mut weighed).ok()?;
        p = weighed;
    }
    let energy = |part: &Sparse| {
        let mut product = vec![0.0; p.len()];
        part.add_product(&p, 1.0, &mut product);
        p.iter().zip(product).map(|(p, x)| p * x).sum::<f64>()
    };
    let softest = energy(&equations.stiffness).abs() / energy(&equations.mass).abs();
    (softest > tolerances::ROUND_OFF_OF_SUMS * equations.fastest().powi(2)).then_some(operator)
}
