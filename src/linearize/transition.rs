//! The state-transition matrix of the variational equations along a motion.

use super::flow::{Bundle, flow_through};
use super::{Changes, Chart, Coordinates, Matrix, State, Variation};
use crate::error::Result;
use crate::system::MechanicalSystem;

/// A basis of small changes of the start, carried to a later time.
#[derive(Clone, Debug)]
pub struct Transition {
    /// The motion at the end.
    pub state: State,
    /// The chart at the start, whose states (z, y) are the columns.
    #[doc(hidden)]
    pub start: Coordinates,
    /// (dq, dv) at the end of a unit of each state at the start.
    #[doc(hidden)]
    pub changes: Changes,
}

impl Transition {
    /// Returns the same in the states of a chart at the end, 2 k x 2 k: z = B dq, y = B (dv - T z).
    ///
    /// # Errors
    /// A chart that does not exist there.
    pub fn matrix(&self, system: &dyn MechanicalSystem, chart: &Chart) -> Result<Matrix> {
        let mut variation = Variation::new(system, self.state.t, &self.state.q, &self.state.v)?;
        Ok(chart.at(&mut variation)?.states_of(&self.changes))
    }
}

/// Integrates X' = A_u X along the motion from `start`, X(0) the states of `chart` there, and returns X at each of
/// `times` (increasing).
///
/// Where the motion passes a threshold at which v' jumps, X jumps by the saltation matrix.
///
/// # Errors
/// A chart that does not exist at the start; a motion that cannot go on.
pub fn transition(
    system: &dyn MechanicalSystem,
    start: &State,
    chart: &Chart,
    times: &[f64],
) -> Result<Vec<Transition>> {
    let mut variation = Variation::new(system, start.t, &start.q, &start.v)?;
    let coordinates = chart.at(&mut variation)?;
    let bundle = Bundle { columns: coordinates.changes(), ..Bundle::of(start) };
    let mut found = Vec::new();
    flow_through(system, &bundle, times, |snapshot| {
        let state = snapshot.motion.clone();
        let changes = snapshot.columns.clone();
        found.push(Transition { state, start: coordinates.clone(), changes });
        true
    })?;
    Ok(found)
}
