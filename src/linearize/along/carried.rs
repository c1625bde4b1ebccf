//! A chart carried along a motion.

use crate::error::Result;
use crate::linearize::coordinates::parallel;
use crate::linearize::flow::{Bundle, Snapshot, flow_until};
use crate::linearize::{Chart, Coordinates, Matrix, State, Variation};
use crate::system::MechanicalSystem;

/// A chart at the start and its continuation along the motion: constant charts stay, as all do at an equilibrium; the
/// basis of the intrinsic one is transported parallel, in the same steps as the motion.
pub struct Carried<'a> {
    system: &'a dyn MechanicalSystem,
    pub start: Coordinates,
    moves: bool,
    /// True when motions are followed no further.
    is_over: &'a dyn Fn() -> bool,
}

impl<'a> Carried<'a> {
    /// The chart at a state.
    ///
    /// # Errors
    /// A chart that does not exist at the state.
    pub fn new(variation: &mut Variation<'a>, chart: &Chart, is_over: &'a dyn Fn() -> bool) -> Result<Self> {
        let start = chart.at(variation)?;
        let moves = *chart == Chart::Intrinsic && start.r.ncols() > 0 && !variation.point.is_equilibrium;
        Ok(Carried { system: variation.system(), start, moves, is_over })
    }

    /// Returns the motions of a bundle at these times (increasing, after the start), with the chart at each: at the
    /// first ones alone where the time is over.
    ///
    /// # Errors
    /// A motion that cannot go on, a state at which the chart does not exist.
    pub fn flow(&self, bundle: &Bundle, times: &[f64]) -> Result<(Vec<Snapshot>, Vec<Coordinates>)> {
        let basis = if self.moves { self.start.r.clone() } else { bundle.basis.clone() };
        let bundle = Bundle { basis, ..bundle.clone() };
        let mut snapshots = Vec::new();
        flow_until(self.system, &bundle, times, self.is_over, |snapshot| {
            snapshots.push(snapshot.clone());
            true
        })?;
        let charts = snapshots.iter().map(|snapshot| self.at(snapshot)).collect::<Result<_>>()?;
        Ok((snapshots, charts))
    }

    fn at(&self, Snapshot { motion: State { t, q, v }, basis, .. }: &Snapshot) -> Result<Coordinates> {
        if self.moves { nearest(&mut Variation::new(self.system, *t, q, v)?, basis) } else { Ok(self.start.clone()) }
    }
}

/// Returns the intrinsic chart at a state whose basis is nearest to `n`.
///
/// # Errors
/// Equations that do not say how M changes; a singular state.
pub fn nearest(variation: &mut Variation, n: &Matrix) -> Result<Coordinates> {
    let off = variation.correct(&variation.g_times(n))?;
    let n = orthonormal(n - off, variation);
    parallel(variation, n)
}

/// Returns X (X^T M X)^(-1/2), the orthonormal basis nearest to X.
fn orthonormal(x: Matrix, variation: &Variation) -> Matrix {
    let square = x.tr_mul(&variation.mass_times(&x)).symmetric_eigen();
    let scaled = &square.eigenvectors
        * Matrix::from_diagonal(&square.eigenvalues.map(|value| value.max(f64::MIN_POSITIVE).sqrt().recip()));
    x * scaled * square.eigenvectors.transpose()
}
