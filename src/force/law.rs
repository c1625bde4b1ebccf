//! The law of a spring: an expression of its length or angle, its rate and time.

use super::{Instant, Motion};
use crate::body::{Build, Formula, MOST_MARKERS, MarkerId, Probe};
use crate::error::{Error, Result};
use crate::math::expression::Number;
use crate::math::{Rate, Scalar};

/// A law over a spring's own scalar and its rate, and over anything that an applied force may read.
pub struct Law {
    formula: Formula,
    markers: Vec<MarkerId>,
}

impl Law {
    /// Reads `law`, in which `name` is the scalar `own` and `rate` its rate; `given` are the keys of the linear law,
    /// which it replaces. The markers of the force begin with `ends`.
    pub fn read<const D: usize>(
        law: &Number,
        given: &[(&str, bool)],
        name: &str,
        own: Probe,
        ends: &[MarkerId],
        build: &Build<D>,
    ) -> Result<Self> {
        if let Some((key, _)) = given.iter().find(|(_, given)| *given) {
            return Err(Error::input(format!("a spring with a `law` has no `{key}`"))
                .under(key)
                .hint("write it into the law, or remove the law"));
        }
        let locals = [(name, own), ("rate", Probe { order: 1, ..own })];
        let formula = build.acting_with("law", law, true, &locals)?;
        let markers = formula.markers_after(ends);
        if markers.len() <= MOST_MARKERS {
            Ok(Law { formula, markers })
        } else {
            Err(Error::input(format!("the law uses {} markers", markers.len()))
                .under("law")
                .hint(format!("use at most {MOST_MARKERS}, those of the spring among them")))
        }
    }

    /// Markers of the force.
    pub fn markers(&self) -> &[MarkerId] {
        &self.markers
    }

    pub fn value<S: Scalar, const D: usize>(&self, frames: &Motion<S, D>, time: Instant<S>) -> S {
        self.formula.at(time.map(|t| t.x), &self.markers, frames)
    }

    pub fn switching<const D: usize>(&self, frames: &Motion<Rate, D>, time: Instant<Rate>, out: &mut [Rate]) {
        self.formula.switching_at(time.map(|t| t.x), &self.markers, frames, out);
    }
}
