//! Tolerances of adaptive methods.

use super::super::extreme::{Extreme, decades};

pub const EXTREME: Extreme = Extreme {
    name: "tolerance",
    unit: "",
    about: "rtol = atol of adaptive methods",
    keeps_motion: true,
    suits: |_| true,
    values: |_| decades(-14, -2, 2),
    apply: |case, tolerance| {
        (case.method.rtol, case.method.atol, case.method.step) = (tolerance, tolerance, None);
        Ok(())
    },
};
