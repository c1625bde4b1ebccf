//! The rate of a state.

use super::{Action, ForceKernel, Instant, Motion};
use crate::body::{Formula, MOST_MARKERS, MarkerId, Wrench};
use crate::error::{Error, Result};
use crate::math::{Rate, Scalar, Taylor};

/// xi' = r(t, q, v, xi): a force of that size along x on the marker of a state, whose mass is one.
pub struct StateRate {
    rate: Formula,
    markers: Vec<MarkerId>,
}

impl StateRate {
    /// The rate of the state at the marker `state`.
    ///
    /// # Errors
    /// An expression over too many markers and states.
    pub fn new(state: MarkerId, rate: Formula) -> Result<Self> {
        let markers = rate.markers_after(&[state]);
        if markers.len() <= MOST_MARKERS {
            Ok(StateRate { rate, markers })
        } else {
            Err(Error::input(format!("uses {} markers and states", markers.len()))
                .hint(format!("use at most {MOST_MARKERS} in one rate, or split it into several states")))
        }
    }

    /// The markers whose frames it takes: that of its state, then those that the rate reads.
    pub fn markers(&self) -> &[MarkerId] {
        &self.markers
    }
}

impl<const D: usize> ForceKernel<D> for StateRate {
    fn act<S: Scalar>(&self, frames: &Motion<S, D>, time: Instant<S>, out: &mut [Wrench<S, D>]) -> Action<S> {
        let rate = self.rate.at(time.map(|t| t.x), &self.markers, frames);
        out[0].force[0] = rate;
        // A state has no energy: the power of the wrench that moves it is no work.
        let power = rate * frames[0].r[0].d;
        Action { potential: Taylor::new(S::zero(), -power, S::zero()), magnitude: rate }
    }

    fn switching(&self, _input: &[Taylor<Rate>; 3], frames: &Motion<Rate, D>, time: Instant<Rate>, out: &mut [Rate]) {
        self.rate.switching_at(time.map(|t| t.x), &self.markers, frames, out);
    }
}
