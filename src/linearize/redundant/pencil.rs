//! The pencils (E, A) of the formulations with multipliers.

use super::LinearMatrices;
use super::rounding::PencilParts;
use crate::error::Result;
use crate::formulation::{Dae, DaeRow};
use crate::linearize::changes::{Directions, directions};
use crate::linearize::input_states::InputStates;
use crate::linearize::model::REDUNDANT;
use crate::linearize::perturbation::{ColumnBlocks as Columns, Perturbation};
use crate::linearize::{Changes, Matrix, Variation};

/// Returns the number of infinite eigenvalues with `m` independent constraints: m for a row of phi'' whose multiplier
/// acts in M v', m more for each time that the row is differentiated less; m less for mu, which acts in q'.
fn infinite(dae: &Dae, m: usize) -> usize {
    let of = |row: Option<DaeRow>, most: usize| row.map_or(0, |row| m * (most - row.level()));
    of(Some(dae.lambda), 3) + of(dae.eta, 3) + of(dae.mu, 2)
}

/// The multipliers of one kind: their rows and the index of the first.
#[derive(Clone, Copy)]
struct MultiplierKind {
    row: DaeRow,
    at: usize,
}

/// E x' = A x + `driven` s + B u with the states s of the inputs.
struct Pencil {
    e: Matrix,
    a: Matrix,
    driven: Matrix,
    b: Matrix,
}

/// Returns (E, A), B, C and D in x = (dq, dv, dlambda), followed by deta and dmu where the equations have them.
pub fn build(dae: &Dae, variation: &mut Variation) -> Result<LinearMatrices> {
    let independent = variation.independent_rows();
    let n = variation.velocities();
    let m = independent.len();
    let select = |rows: Matrix| rows.select_rows(&independent);
    let mut parts = PencilParts {
        k: variation.k(),
        c: variation.c(),
        g: select(variation.g()),
        gd: select(variation.gd()),
        rows: select(variation.rows(&Changes::all(n, n), [0.0; 2])),
    };
    parts.clean(variation);
    let mut end = 2 * n;
    let mut append = |row: DaeRow| {
        end += m;
        MultiplierKind { row, at: end - m }
    };
    let lambda = append(dae.lambda);
    let eta = dae.eta.map(&mut append);
    let mu = dae.mu.map(&mut append);
    let mut e = Matrix::zeros(end, end);
    let mut a = Matrix::zeros(end, end);
    let PencilParts { k, c, g, .. } = &parts;
    put(&mut e, (0, 0), &Matrix::identity(n, n));
    put(&mut e, (n, n), &variation.mass());
    put(&mut a, (0, 0), &-variation.bracket(&variation.point.v));
    put(&mut a, (0, n), &Matrix::identity(n, n));
    put(&mut a, (n, 0), &-k);
    put(&mut a, (n, n), &-c);
    put(&mut a, (n, lambda.at), &-g.transpose());
    // G M^-1, transposed: the change of v' and q' by the additional multipliers.
    let shift = if dae.has_shifts() { over_mass(g.clone(), variation.mass()) } else { None };
    if let (Some(eta), Some(shift)) = (eta, &shift) {
        put(&mut a, (n, eta.at), &-g.transpose());
        put(&mut a, (lambda.at, eta.at), &(shift * g.transpose() * -lambda.row.acceleration));
    }
    if let (Some(mu), Some(shift)) = (mu, &shift) {
        put(&mut a, (0, mu.at), &-shift.transpose());
    }
    for MultiplierKind { row, at } in [Some(lambda), eta, mu].into_iter().flatten() {
        put(&mut e, (at, n), &(g * row.acceleration));
        put(&mut a, (at, 0), &parts.row(row));
    }
    let perturbation = Perturbation::new(variation, &Changes::none(n), |_, _| None);
    let [mut driven, mut b] = perturbation.input_forces().map(|forces| forces.resize_vertically(n, 0.0));
    driven = driven.insert_rows(0, n, 0.0).resize_vertically(end, 0.0);
    b = b.insert_rows(0, n, 0.0).resize_vertically(end, 0.0);
    for MultiplierKind { row, at } in [Some(lambda), eta, mu].into_iter().flatten() {
        let [states, inputs] = perturbation.input_rows(row);
        put(&mut driven, (at, 0), &select(states));
        put(&mut b, (at, 0), &select(inputs));
    }
    observe(dae, variation, &independent, &perturbation, Pencil { e, a, driven, b })
}

/// Adds the outputs.
fn observe(
    dae: &Dae,
    variation: &mut Variation,
    independent: &[usize],
    perturbation: &Perturbation,
    pencil: Pencil,
) -> Result<LinearMatrices> {
    let Pencil { e, a, driven, b } = pencil;
    let n = variation.velocities();
    let size = a.nrows();
    let outputs = variation.outputs()?;
    let mut c = Matrix::zeros(outputs.q.nrows(), size);
    put(&mut c, (0, 0), &outputs.q);
    put(&mut c, (0, n), &outputs.v);
    put(&mut c, (0, 2 * n), &outputs.lambda.select_columns(independent));
    let unit = Matrix::identity(size, size);
    let changes = Changes { q: unit.rows(0, n).clone_owned(), v: unit.rows(n, n).clone_owned() };
    let Columns { input_states, inputs, .. } =
        perturbation.split(&(outputs.u * &perturbation.u[0] + outputs.udot * &perturbation.u[1]));
    let mut seen = input_states;
    let mut d = inputs;
    if outputs.vdot.iter().any(|slope| *slope != 0.0)
        && let Some(of_force) = over_mass(outputs.vdot, variation.mass())
    {
        c += &of_force * a.rows(n, n);
        seen += &of_force * driven.rows(n, n);
        d += &of_force * b.rows(n, n);
    }
    let states = states(dae, variation, independent);
    let chart = REDUNDANT.to_string();
    let infinite = infinite(dae, independent.len());
    let input_states = InputStates { orders: variation.orders(), a: driven, c: seen };
    let built =
        LinearMatrices { chart, states, a, b, c, d, e: Some(e), input_states, changes, coordinates: None, infinite };
    Ok(built.without_integrals(variation.system().dimensions()))
}

fn states(dae: &Dae, variation: &Variation, independent: &[usize]) -> Vec<String> {
    let system = variation.system();
    let Directions { mut q, v } = directions(system, &variation.point.q);
    q.resize(v.len(), String::new());
    let mut states = [q, v].concat();
    let multipliers = system.facts().names.lambda.clone();
    for (_, suffix) in
        [(Some(dae.lambda), ""), (dae.eta, " eta"), (dae.mu, " mu")].iter().filter(|kind| kind.0.is_some())
    {
        states.extend(independent.iter().map(|&row| format!("{}{suffix}", multipliers[row])));
    }
    states
}

/// Returns W M^-1; directions without mass stay as they are, since no output depends on them.
fn over_mass(outputs: Matrix, mut mass: Matrix) -> Option<Matrix> {
    for i in 0..mass.nrows() {
        if mass[(i, i)] == 0.0 {
            mass[(i, i)] = 1.0;
        }
    }
    Some(mass.lu().solve(&outputs.transpose())?.transpose())
}

fn put(target: &mut Matrix, at: (usize, usize), block: &Matrix) {
    target.view_mut(at, block.shape()).copy_from(block);
}
