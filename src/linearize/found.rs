//! The eigenvalues at one state of a survey.

use super::{LociPoint, State};
use crate::error::Warning;

/// Result at one state.
#[derive(Clone)]
pub(super) struct Found {
    pub state: State,
    /// The eigenvalues.
    pub sample: LociPoint,
    pub method: String,
    pub chart: String,
    pub is_equilibrium: bool,
    pub turning: Option<f64>,
    pub doubt: Option<Warning>,
}
