//! Convergence orders of every accepted triple formulation x integrator x projection, from errors at two numbers of steps.

use super::fixed;
use holonom::integrator::{IntegratorEntry, Steps, registry};
use holonom::projection::registry as projections;
use holonom::simulate::Method;
use rayon::prelude::*;
use std::ops::Range;

/// Motions go from 0 to here, with rows at eight times: steps that are a multiple of eight in number need no interpolation, and
/// one more puts the rows at all eighths of a step.
pub const END: f64 = 1.5;

pub type Rows = Vec<Vec<f64>>;

/// Those that take fixed steps; the others have their orders proven by tolerances.
pub fn integrators() -> impl Iterator<Item = &'static IntegratorEntry> {
    registry().iter().filter(|entry| entry.steps != Steps::Own)
}

/// Numbers of steps at which the leading term of the error rules while the error is above 1e-12, four digits over
/// round-off. That range is narrow for order 8, whose leading term is small, as are all those of collocation.
pub fn steps(entry: &IntegratorEntry) -> [usize; 2] {
    match (entry.name, entry.order) {
        ("radau_iia", _) => [64, 128],
        (_, ..=4) => [128, 256],
        (_, 5) => [256, 512],
        _ => [32, 40],
    }
}

/// Gains with which the stabilizing terms are no faster than the motion; faster ones need smaller steps to show the
/// order.
pub fn gentle(formulation: &str) -> String {
    match formulation {
        "baumgarte" => "baumgarte:alpha=1".to_string(),
        "invariant_manifold" => "invariant_manifold:gamma=1".to_string(),
        "force_projection" => "force_projection:position=1".to_string(),
        // What a penalty solves differs from the equations of motion by O(1/penalty): with 1e18 by less than round-off,
        // so that the common reference serves. Ordinary penalties have a test of their own in tests/orders.rs.
        "penalty" => "penalty:penalty=1e18,omega=1".to_string(),
        "augmented_lagrangian" => "augmented_lagrangian:omega=1".to_string(),
        other => other.to_string(),
    }
}

/// Euclidean norm of the errors in these columns over all rows: one component alone may pass through zero.
pub fn error(rows: &Rows, reference: &Rows, columns: &Range<usize>) -> f64 {
    let pairs = rows.iter().zip(reference);
    pairs.map(|(row, exact)| columns.clone().map(|i| (row[i] - exact[i]).powi(2)).sum::<f64>()).sum::<f64>().sqrt()
}

/// Every triple, in two numbers of steps, has the order of its integrator in these columns to so much.
pub fn check(
    levels: &[(&str, Range<usize>)],
    reference: &Rows,
    of: impl Fn(&IntegratorEntry) -> ([usize; 2], f64) + Sync,
    solution: impl Fn(&Method) -> Rows + Sync,
) {
    let triples: Vec<_> = integrators()
        .flat_map(|entry| entry.accepts().map(move |formulation| (entry, gentle(formulation))))
        .flat_map(|(entry, formulation)| {
            let name = formulation.split(':').next().unwrap_or_default().to_string();
            let accepted = projections().iter().filter(move |projection| !entry.refuses(&name, projection.name));
            accepted.map(move |projection| (entry, formulation.clone(), projection.name))
        })
        .collect();
    // 4 explicit integrators x 8 vector fields x 6 projections, and what takes index 2 or 3.
    assert!(triples.len() >= 216);
    triples.par_iter().for_each(|(entry, formulation, projection)| {
        let ([coarse, fine], slack) = of(entry);
        let found = [coarse, fine].map(|n| solution(&fixed(formulation, entry.name, projection, END / n as f64)));
        for (name, columns) in levels {
            let errors = [0, 1].map(|k| error(&found[k], reference, columns));
            let order = (errors[0] / errors[1]).ln() / (fine as f64 / coarse as f64).ln();
            let triple = format!("{formulation} + {} + {projection}", entry.name);
            assert!((order - entry.order as f64).abs() < slack, "{triple}: order {order:.2} in {name}, {errors:?}");
        }
    });
}
