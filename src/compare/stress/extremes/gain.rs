//! Baumgarte's gains.

use super::super::change::baumgarte;
use super::super::extreme::{Extreme, ladder};
use crate::choice::Choice;

/// alpha = beta, the critical damping of phi'' + 2 alpha phi' + beta^2 phi = 0. From gains that do nothing within a step to
/// those at which explicit methods are unstable.
pub const EXTREME: Extreme = Extreme {
    name: "gain",
    unit: "1/s",
    about: "Baumgarte's gains alpha = beta",
    keeps_motion: true,
    suits: |subject| subject.dimensions.lambda > 0,
    values: |subject| {
        let rate = 1.0 / subject.base.typical.step;
        ladder(0.02 * rate, 40.0 * rate)
    },
    apply: |case, gain| {
        (case.method.formulation, case.method.projection) = (baumgarte(gain), Choice::named("none"));
        Ok(())
    },
};
