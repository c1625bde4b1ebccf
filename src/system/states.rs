//! Refusal of states xi where a solver has no use for them.

use super::MechanicalSystem;
use crate::error::{Error, Result};

/// Refuses a system with states xi.
///
/// # Errors
/// The system has states; the error names `what` refuses them and gives the hint.
pub fn refuse_states(system: &dyn MechanicalSystem, what: &str, hint: &str) -> Result<()> {
    match system.dimensions().states {
        0 => Ok(()),
        _ => Err(Error::input(format!("{what} cannot take a system with states xi")).hint(hint)),
    }
}
