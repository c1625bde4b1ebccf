//! Expressions over time, scalars read off markers, and outputs by their names.

use super::{Frame, MarkerId, Probe};
use crate::error::{Error, Result};
use crate::math::expression::Expression;
use crate::math::{Scalar, Taylor, Time};

/// An expression over t and probes; variable 0 is t, variable i + 1 is probe i.
#[derive(Clone, Debug)]
pub struct Formula {
    /// The expression, its variables numbered as above.
    pub expression: Expression,
    /// Marker quantities in the order of the variables.
    pub probes: Vec<Probe>,
}

/// The largest number of probes of a formula: they are evaluated on the stack.
pub const MOST_PROBES: usize = 24;

impl Formula {
    /// The expression as a function of t alone; an error if it reads a marker.
    pub fn function_of_time(self) -> Result<Expression> {
        if self.probes.is_empty() {
            Ok(self.expression)
        } else {
            Err(Error::input("this may depend on t and parameters only, but uses a marker")
                .hint("markers and outputs may stand in an `equation` joint, an applied force or torque, the law of a spring, a tyre's road, and outputs"))
        }
    }

    /// The markers that it reads, each once, in the order of its probes.
    pub fn markers(&self) -> Vec<MarkerId> {
        let mut markers = Vec::new();
        for marker in self.probes.iter().flat_map(Probe::markers) {
            if !markers.contains(&marker) {
                markers.push(marker);
            }
        }
        markers
    }

    /// These markers, and after them the others that it reads.
    pub fn markers_after(&self, own: &[MarkerId]) -> Vec<MarkerId> {
        let others = self.markers().into_iter().filter(|marker| !own.contains(marker));
        own.iter().copied().chain(others).collect()
    }

    /// Value of the expression, with `read` for the values of the probes.
    pub fn evaluate<S: Scalar>(&self, time: Time<S>, read: impl Fn(&Probe) -> S) -> S {
        self.with(time, read, |variables| self.expression.eval_held(variables, time.regime))
    }

    /// Writes the arguments of its switching functions at their numbers.
    pub fn switching<S: Scalar>(&self, time: Time<S>, read: impl Fn(&Probe) -> S, out: &mut [S]) {
        self.with(time, read, |variables| self.expression.arguments(variables, time.regime, out));
    }

    /// Value at the moving frames of an element's markers.
    pub fn at<S: Scalar, const D: usize>(
        &self,
        time: Time<S>,
        markers: &[MarkerId],
        frames: &[Frame<Taylor<S>, D>],
    ) -> S {
        self.evaluate(time, |probe| probe.read(time.regime, |marker| slot(markers, marker, frames)))
    }

    /// As [`switching`](Self::switching), at the moving frames of an element's markers.
    pub fn switching_at<S: Scalar, const D: usize>(
        &self,
        time: Time<S>,
        markers: &[MarkerId],
        frames: &[Frame<Taylor<S>, D>],
        out: &mut [S],
    ) {
        self.switching(time, |probe| probe.read(time.regime, |marker| slot(markers, marker, frames)), out);
    }

    /// Value of a formula over positions and angles alone at the frames of an element's markers.
    pub fn placed<S: Scalar, const D: usize>(&self, time: Time<S>, markers: &[MarkerId], frames: &[Frame<S, D>]) -> S {
        self.evaluate(time, |probe| probe.position(time.regime, |marker| slot(markers, marker, frames)))
    }

    /// As [`switching`](Self::switching), for a formula over positions and angles alone.
    pub fn switching_placed<S: Scalar, const D: usize>(
        &self,
        time: Time<S>,
        markers: &[MarkerId],
        frames: &[Frame<S, D>],
        out: &mut [S],
    ) {
        self.switching(time, |probe| probe.position(time.regime, |marker| slot(markers, marker, frames)), out);
    }

    fn with<S: Scalar, R>(&self, time: Time<S>, read: impl Fn(&Probe) -> S, see: impl FnOnce(&[S]) -> R) -> R {
        if self.probes.is_empty() {
            return see(&[time.t]);
        }
        let mut variables = [time.t; MOST_PROBES + 1];
        for (place, probe) in variables[1..].iter_mut().zip(&self.probes) {
            *place = read(probe);
        }
        see(&variables[..=self.probes.len()])
    }
}

/// The frame of a marker among those of an element.
fn slot<'f, F>(markers: &[MarkerId], marker: MarkerId, frames: &'f [F]) -> &'f F {
    &frames[markers.iter().position(|&known| known == marker).unwrap_or(0)]
}
