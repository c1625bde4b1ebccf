//! A chart carried along a motion.

use crate::error::Result;
use crate::linearize::coordinates::parallel;
use crate::linearize::flow::{Bundle, Snapshot, flow_until};
use crate::linearize::{Chart, Coordinates, Matrix, State, Variation};
use crate::system::{LeviCivita, MechanicalSystem, Need, OperatingPoint};
use crate::tolerances;

/// A chart at the start and its continuation along the motion: constant charts stay, as all do at an equilibrium; the
/// basis of the intrinsic one is transported parallel, in the same steps as the motion.
pub struct CarriedChart<'a> {
    system: &'a dyn MechanicalSystem,
    pub start: Coordinates,
    moves: bool,
    /// True when motions are followed no further.
    is_over: &'a dyn Fn() -> bool,
}

impl<'a> CarriedChart<'a> {
    /// The chart at a state.
    ///
    /// # Errors
    /// A chart that does not exist at the state.
    pub fn new(variation: &mut Variation<'a>, chart: &Chart, is_over: &'a dyn Fn() -> bool) -> Result<Self> {
        let start = chart.at(variation)?;
        let moves = *chart == Chart::Intrinsic && start.r.ncols() > 0 && !variation.point.is_equilibrium;
        Ok(CarriedChart { system: variation.system(), start, moves, is_over })
    }

    /// Returns the motions of a bundle at these times (increasing, after the start): at the first ones alone where the
    /// time is over.
    ///
    /// # Errors
    /// A motion that cannot go on.
    pub fn flow(&self, bundle: &Bundle, times: &[f64]) -> Result<Vec<Snapshot>> {
        let basis = if self.moves { self.start.r.clone() } else { bundle.basis.clone() };
        let bundle = Bundle { basis, ..bundle.clone() };
        let mut snapshots = Vec::new();
        flow_until(self.system, &bundle, times, self.is_over, |snapshot| {
            snapshots.push(snapshot.clone());
            true
        })?;
        Ok(snapshots)
    }

    /// Returns the chart at each snapshot.
    ///
    /// # Errors
    /// A state at which the chart does not exist.
    pub fn charts(&self, snapshots: &[Snapshot]) -> Result<Vec<Coordinates>> {
        let Some(Snapshot { motion, .. }) = snapshots.first().filter(|_| self.moves) else {
            return Ok(vec![self.start.clone(); snapshots.len()]);
        };
        let mut variation = Variation::new(self.system, motion.t, &motion.q, &motion.v)?;
        let mut chart = |Snapshot { motion: State { t, q, v }, basis, .. }: &Snapshot| {
            variation.operate_at(*t, q, v)?;
            nearest(&mut variation, basis)
        };
        snapshots.iter().map(&mut chart).collect()
    }

    /// Returns the basis R of the chart at a snapshot.
    pub fn basis<'b>(&'b self, snapshot: &'b Snapshot) -> &'b Matrix {
        if self.moves { &snapshot.basis } else { &self.start.r }
    }

    /// Returns the states (z, y) of the columns of each snapshot, which have no displacements of drivers in them: then dq
    /// = N z, and with the N' of the intrinsic chart
    ///
    /// ```text
    /// z = N^T M dq,   y = N^T M (dv - N' z - [v, dq]) = N^T (M (dv - [v, dq]) + W dq)
    /// ```
    ///
    /// # Errors
    /// A state without determined accelerations.
    pub fn states(&self, snapshots: &[Snapshot]) -> Result<Vec<Matrix>> {
        let Some(Snapshot { motion, .. }) = snapshots.first().filter(|_| self.moves) else {
            return Ok(snapshots.iter().map(|snapshot| self.start.states_of(&snapshot.columns)).collect());
        };
        let mut variation = Variation::new(self.system, motion.t, &motion.q, &motion.v)?;
        let mut connection = LeviCivita::new(variation.velocities());
        let own = |snapshot: &Snapshot| self.states_by(snapshot, &mut variation, &mut connection);
        Ok(snapshots.iter().map(own).collect())
    }

    fn states_by(&self, snapshot: &Snapshot, variation: &mut Variation, connection: &mut LeviCivita) -> Matrix {
        let Snapshot { motion: State { t, q, v }, columns, basis, .. } = snapshot;
        variation.dynamics.evaluate(*t, q, v, Need::MASS);
        let vdot = vec![0.0; v.len()];
        let lambda = vec![0.0; self.system.dimensions().lambda];
        let at = OperatingPoint { t: *t, q, v, vdot: &vdot, lambda: &lambda };
        self.system.levi_civita(at, connection, &mut variation.dynamics.scratch);
        let speeds = &columns.v - variation.bracket_of(v, &columns.q);
        let z = basis.tr_mul(&variation.mass_times(&columns.q));
        let y = basis.tr_mul(&(variation.mass_times(&speeds) + &connection.w * &columns.q));
        let k = self.start.freedom();
        let mut both = z.rows(0, k).clone_owned().resize_vertically(k + y.nrows(), 0.0);
        both.rows_mut(k, y.nrows()).copy_from(&y);
        both
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
    let square = x.tr_mul(&variation.mass_times(&x));
    let off = Matrix::identity(x.ncols(), x.ncols()) - &square;
    if off.amax() < tolerances::ROOT_OF_ROUND_OFF {
        return &x + &x * (off * 0.5);
    }
    let square = square.symmetric_eigen();
    let scaled = &square.eigenvectors
        * Matrix::from_diagonal(&square.eigenvalues.map(|value| value.max(f64::MIN_POSITIVE).sqrt().recip()));
    x * scaled * square.eigenvectors.transpose()
}
