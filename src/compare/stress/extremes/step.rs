//! Fixed steps.

use super::super::extreme::{Extreme, ladder};

pub const EXTREME: Extreme = Extreme {
    name: "step",
    unit: "s",
    about: "fixed step of the method",
    keeps_motion: true,
    suits: |_| true,
    values: |subject| {
        let step = subject.base.typical.step;
        ladder(step / 40.0, 6.0 * step)
    },
    apply: |case, step| {
        case.method.step = Some(step);
        Ok(())
    },
};
