//! Where states xi have no place.

use super::MechanicalSystem;
use crate::error::{Error, Result};

/// Refuses a system with states xi.
///
/// # Errors
/// It has some: what cannot take them, and what to do.
pub fn refuse_states(system: &dyn MechanicalSystem, what: &str, hint: &str) -> Result<()> {
    match system.dimensions().states {
        0 => Ok(()),
        _ => Err(Error::input(format!("{what} cannot take a system with states xi")).hint(hint)),
    }
}
