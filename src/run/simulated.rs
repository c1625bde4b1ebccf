//! A whole run in one call.

use super::{Moment, Run};
use crate::analysis::Record;
use crate::error::{Error, Result};
use crate::formulation::Statistics;
use crate::simulate::{Method, Span, Start};
use crate::system::MechanicalSystem;

/// A run from its start to its end.
pub struct Simulated {
    /// Rows, drift and energy.
    pub record: Record,
    /// The last state.
    pub state: Moment,
    /// Counters of the work.
    pub statistics: Statistics,
}

/// Integrates `system` from a consistent start over a span, `0.0..10.0`, by a method, `"ggl + radau_iia"`.
///
/// ```
/// use holonom::prelude::*;
///
/// /// x'' = -x
/// struct Oscillator;
///
/// impl Equations for Oscillator {
///     fn size(&self) -> (usize, usize) {
///         (1, 0)
///     }
///     fn mass<S: Scalar>(&self, _t: S, _q: &[S], mass: &mut [S]) {
///         mass[0] = S::one();
///     }
///     fn force<S: Scalar>(&self, _t: S, q: &[S], _v: &[S], f: &mut [S]) {
///         f[0] = -q[0];
///     }
///     fn phi<S: Scalar>(&self, _t: S, _q: &[S], _phi: &mut [S]) {}
/// }
///
/// let end = simulate(&Oscillator, "index1 + dop853", &([1.0], [0.0]), 0.0..3.0)?.state;
/// assert!((end.q[0] - 3.0_f64.cos()).abs() < 1e-7);
/// # Ok::<(), holonom::Error>(())
/// ```
///
/// # Errors
/// Bad input: an unknown or impossible method, a bad span; a run that cannot go on, for which a [`Run`] keeps what came
/// before.
pub fn simulate<'s, M: TryInto<Method>>(
    system: &dyn MechanicalSystem,
    method: M,
    start: impl Into<Start<'s>>,
    span: impl Into<Span>,
) -> Result<Simulated>
where
    Error: From<M::Error>,
{
    let Span { start: t, end, output_step } = span.into();
    let mut run = Run::new(system, method, t, start).rows_every(output_step);
    run.to(end)?;
    Ok(Simulated { state: run.state()?, statistics: run.statistics(), record: run.into_record() })
}
