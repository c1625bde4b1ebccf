//! Check of a start before anything is computed with it.

use super::MechanicalSystem;
use crate::error::{Error, Result};

/// Refuses a start with too many or too few numbers, or one that the system itself refuses.
pub(crate) fn check_start(system: &dyn MechanicalSystem, t: f64, q: &[f64], v: &[f64]) -> Result<()> {
    let n = system.dimensions();
    for (found, wanted, what) in [(q.len(), n.q, "coordinates"), (v.len(), n.v, "velocities")] {
        if found != wanted {
            let message = format!("the start has {found} {what}, the system has {wanted}");
            return Err(
                Error::input(message).hint(format!("give {wanted} numbers, in the order of the system's {what}"))
            );
        }
    }
    system.check(t, q, v)
}
