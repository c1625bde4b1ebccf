//! Long times.

use super::super::extreme::{Extreme, decades};

/// In periods of the subject: see [`Typical`](super::super::Typical).
pub const EXTREME: Extreme = Extreme {
    name: "time",
    unit: "periods",
    about: "simulated time in periods of the motion",
    keeps_motion: false,
    suits: |_| true,
    values: |_| decades(0, 6, 1),
    apply: |case, periods| {
        case.duration = periods * case.typical.period;
        Ok(())
    },
};
