//! Condition number of the saddle-point matrix, for reports.

use super::system::{System, add, balance, dot};
use super::{Pattern, SaddlePoint};
use crate::tolerances::math as tolerances;
use faer::{Mat, Side};

/// The 2-norm condition number of E K E, where the diagonal E makes the masses one and the rows of G of unit norm in
/// the mass metric, so that it does not depend on units. By the eigenvalues up to n + m = 600, beyond by power
/// iterations (a lower bound, close in practice).
/// Infinite for singular matrices, NaN if the values are not finite or do not fit.
pub fn condition_number(mass: &Pattern, mass_values: &[f64], g: &Pattern, g_values: &[f64]) -> f64 {
    let fits = mass_values.len() == mass.entries.len() && g_values.len() == g.entries.len();
    let inside = mass.rows == mass.cols && g.cols == mass.rows && mass.is_inside() && g.is_inside();
    if !fits || !inside || !mass_values.iter().chain(g_values).all(|v| v.is_finite()) {
        return f64::NAN;
    }
    let mut system = System::new(mass, g);
    system.store(mass_values, g_values);
    let mut scale = vec![1.0; mass.rows + g.rows];
    balance((mass, mass_values), (g, g_values), None, &mut scale);
    if mass.rows + g.rows == 0 {
        1.0
    } else if mass.rows + g.rows <= tolerances::DENSE_EQUATIONS {
        by_eigenvalues(&system, &scale)
    } else {
        by_iteration(&system, &scale)
    }
}

/// Calls `f(node, node, value)` for one triangle of K.
fn for_each_entry(system: &System, mut f: impl FnMut(usize, usize, f64)) {
    let n = system.mass.rows;
    system.mass.entries.iter().zip(&system.mass_values).for_each(|(&(i, j), &v)| f(i, j, v));
    system.g.entries.iter().zip(&system.g_values).for_each(|(&(j, i), &v)| f(n + j, i, v));
}

fn by_eigenvalues(system: &System, scale: &[f64]) -> f64 {
    let mut matrix = Mat::<f64>::zeros(scale.len(), scale.len());
    for_each_entry(system, |a, b, value| matrix[(a.max(b), a.min(b))] += value * scale[a] * scale[b]);
    faer::set_global_parallelism(faer::Par::Seq);
    let Ok(eigenvalues) = matrix.self_adjoint_eigenvalues(Side::Lower) else { return f64::NAN };
    let sizes = eigenvalues.iter().map(|v| v.abs());
    let (smallest, largest) = sizes.fold((f64::INFINITY, 0.0), |(a, b): (f64, f64), v| (a.min(v), b.max(v)));
    // An eigenvalue below round-off of the largest is zero.
    if smallest <= f64::EPSILON * largest { f64::INFINITY } else { largest / smallest }
}

fn by_iteration(system: &System, scale: &[f64]) -> f64 {
    let n = system.mass.rows;
    let mut solver = SaddlePoint::new(&system.mass, &system.g);
    if solver.factor(&system.mass_values, &system.g_values).is_err() || solver.is_rank_deficient() {
        return f64::INFINITY;
    }
    let times = |x: &[f64], y: &mut [f64]| {
        y.fill(0.0);
        let (top, bottom) = y.split_at_mut(n);
        system.residual(&x[..n], &x[n..], top, bottom);
        true
    };
    let largest = power(scale, |s| *s, times);
    let smallest = power(
        scale,
        |s| s.recip(),
        |x: &[f64], y: &mut [f64]| {
            y.fill(0.0);
            add(x, y);
            let (top, bottom) = y.split_at_mut(n);
            solver.solve(top, bottom).is_ok()
        },
    );
    largest * smallest
}

/// The largest |eigenvalue| of E A E, where `apply` multiplies by A (up to sign) and returns false on failure.
fn power(scale: &[f64], e: impl Fn(&f64) -> f64, mut apply: impl FnMut(&[f64], &mut [f64]) -> bool) -> f64 {
    let mut x: Vec<f64> = (0..scale.len()).map(|i| (1.0 + 0.7 * i as f64 * (i as f64 + 3.0)).sin()).collect();
    let mut y = x.clone();
    let mut norm = 0.0;
    for _ in 0..tolerances::CONDITION_STEPS {
        let length = dot(&x, &x).sqrt();
        x.iter_mut().zip(scale).for_each(|(x, s)| *x *= e(s) / length);
        if !apply(&x, &mut y) {
            return f64::INFINITY;
        }
        y.iter_mut().zip(scale).for_each(|(y, s)| *y *= e(s));
        norm = dot(&y, &y).sqrt();
        std::mem::swap(&mut x, &mut y);
    }
    norm
}
