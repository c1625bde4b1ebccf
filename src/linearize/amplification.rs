//! Amplification of small changes by a motion.

use super::flow::{Bundle, flow};
use super::{Chart, Matrix, State, Variation};
use crate::error::{Error, Result};
use crate::prepared::PreparedScene;
use crate::simulate::{Method, Span, stiffness};
use crate::system::{MechanicalSystem, OperatingPoint};
use crate::tolerances::linearize as tolerances;

/// Returns the largest growth of any small change of the start up to any of `times` (increasing, after the start): the
/// norm of the transition matrices in mass-orthonormal states (z, y/s). The rate s is the one that makes the norm
/// least, so that an oscillation at one frequency counts 1, and so does free flight. `goes_on` is called with the
/// times.
///
/// # Errors
/// Too many degrees of freedom, a motion that cannot go on, or one that `goes_on` ends.
fn amplification(
    system: &dyn MechanicalSystem,
    start: &State,
    times: &[f64],
    mut goes_on: impl FnMut(f64) -> bool,
) -> Result<f64> {
    let chart = |state: &State| {
        let mut variation = Variation::new(system, state.t, &state.q, &state.v)?;
        Chart::MassOrthogonal.at(&mut variation)
    };
    let at_start = chart(start)?;
    let columns = at_start.changes();
    if columns.q.ncols() > 2 * tolerances::AMPLIFIED_FREEDOM {
        return Err(Error::input(format!(
            "more than {} degrees of freedom are too many to carry small changes of",
            tolerances::AMPLIFIED_FREEDOM
        )));
    }
    if columns.q.ncols() == 0 {
        return Ok(1.0);
    }
    let mut found = Vec::new();
    let bundle = Bundle { columns, ..Bundle::of(start) };
    flow(system, &bundle, times, |snapshot| {
        found.push(chart(&snapshot.motion).map(|chart| chart.states_of(&snapshot.columns)));
        goes_on(snapshot.motion.t)
    })?;
    if found.len() < times.len() {
        return Err(Error::input("it was ended"));
    }
    Ok(least_norm(&found.into_iter().collect::<Result<Vec<Matrix>>>()?, at_start.freedom()))
}

/// Returns the largest growth of any small change of the start by a scene's motion. `goes_on` is called with times of it.
///
/// # Errors
/// Too many degrees of freedom, a motion that cannot go on, or one that `goes_on` ends; modes that are too fast for the
/// explicit method that integrates small changes.
pub fn amplified(prepared: &PreparedScene, span: Span, goes_on: impl FnMut(f64) -> bool) -> Result<f64> {
    let start = State::start(prepared);
    let state = OperatingPoint {
        t: start.t,
        q: &start.q,
        v: &start.v,
        vdot: &prepared.assembly.vdot,
        lambda: &prepared.assembly.lambda,
    };
    if let Some(stiffness) = stiffness(prepared.system(), &Method::default(), state, span) {
        return Err(Error::input(stiffness.to_string()));
    }
    let time = |i: u32| span.start + (span.end - span.start) * f64::from(i) / f64::from(tolerances::AMPLIFIED_TIMES);
    amplification(
        prepared.system(),
        &start,
        &(1..=tolerances::AMPLIFIED_TIMES).map(time).collect::<Vec<f64>>(),
        goes_on,
    )
}

/// min over s of the largest norm of diag(1, 1/s) X diag(1, s), and of that of the start, 1. It is convex in log s:
/// Sezginer, Overton, IEEE Trans. Automatic Control 35 (1990) 229-230.
fn least_norm(matrices: &[Matrix], k: usize) -> f64 {
    let largest = |power: f64| {
        let norms = matrices.iter().map(|matrix| scaled(matrix, k, 10f64.powf(power)).singular_values().max());
        norms.fold(1.0, f64::max)
    };
    let [mut low, mut high] = tolerances::RATES_SOUGHT;
    for _ in 0..tolerances::RATES_THIRDS {
        let third = (high - low) / 3.0;
        if largest(low + third) < largest(high - third) { high -= third } else { low += third }
    }
    largest(0.5 * (low + high))
}

/// The first `k` states are z.
fn scaled(matrix: &Matrix, k: usize, rate: f64) -> Matrix {
    let mut scaled = matrix.clone();
    let rest = matrix.nrows() - k;
    scaled.columns_mut(k, rest).scale_mut(rate);
    scaled.rows_mut(k, rest).unscale_mut(rate);
    scaled
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The exact transition matrices of z'' = a z.
    fn at(a: f64, t: f64) -> Matrix {
        let w = f64::abs(a).sqrt();
        let (c, s) = if a < 0.0 { ((w * t).cos(), (w * t).sin()) } else { ((w * t).cosh(), (w * t).sinh()) };
        Matrix::from_row_slice(2, 2, &[c, s / w, a.signum() * s * w, c])
    }

    #[test]
    fn only_what_grows_counts() {
        let along = |a: f64| (1..=20).map(|i| at(a, 0.1 * f64::from(i))).collect::<Vec<Matrix>>();
        // An oscillation at 300 rad/s: 1; a saddle: e^(w t).
        assert!((least_norm(&along(-9e4), 1) - 1.0).abs() < 1e-2);
        assert!((least_norm(&along(9.0), 1) / f64::exp(6.0) - 1.0).abs() < 1e-2);
        // Free flight: the error that remains comes from the finite range in which s is sought.
        assert!((least_norm(&[Matrix::from_row_slice(2, 2, &[1.0, 2.0, 0.0, 1.0])], 1) - 1.0).abs() < 1e-2);
    }
}
