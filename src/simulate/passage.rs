//! Steps across singular states.

use crate::tolerances;
use serde::{Deserialize, Deserializer, Serialize};

/// Steps over singular states by which others are judged. Unit: `[steps]`. Test: `no_passage_is_wrong_in_silence`.
const LOSSES_KNOWN: usize = 4;

/// A state whose rank indicator is below is singular to round-off: no step is placed from it. Unit: `[1]` of the
/// largest so far. Test: `from_rest_at_a_change_point_it_goes_where_it_is_pushed_or_says_why_not`.
const AT_SINGULAR: f64 = 1e-6;

/// How late a fixed step over a singular state may start, rather than after a step so short. Unit: `[1]` of the step.
/// Test: `rk4_with_projection_keeps_its_order_through_the_folds`.
const LATE_FIXED_STEP: f64 = 0.05;

/// The approach to a singular state, where G loses rank, by the rank indicator of a constraint row at the last accepted
/// states, which falls to zero there linearly in time.
///
/// On a branch of the motion v' is smooth through a singular state, but the stages of a step are off the constraints by
/// some delta, and there v' is wrong by delta over the rank indicator. A step that is refused for this and reduced
/// again and again ends nearer and nearer to the singular state, until round-off over the rank indicator is the error.
/// A step well across it is accurate.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct SingularPassage {
    #[serde(deserialize_with = "never")]
    t: f64,
    pub rank_indicator: f64,
    rate: f64,
    /// The last step, and the rate of `rate`; infinite as long as they are not known.
    #[serde(deserialize_with = "endless")]
    step: f64,
    #[serde(deserialize_with = "endless")]
    bend: f64,
    /// The largest rank indicator so far, its reference: unequal masses and lengths make it small without a
    /// singularity.
    pub largest: f64,
    /// The last step that was not near a singular state.
    regular: f64,
    /// True if a step across the singular state was tried from here.
    is_tried: bool,
    /// The largest change of the energy balance in a step over a singular state, J, and the number of such steps.
    #[serde(default)]
    lost: f64,
    #[serde(default)]
    known: usize,
    /// Number of steps of this passage that were refused for their change of the energy balance.
    #[serde(default)]
    refused: usize,
}

/// Infinity is null in JSON.
fn endless<'de, D: Deserializer<'de>>(from: D) -> Result<f64, D::Error> {
    Ok(Option::deserialize(from)?.unwrap_or(f64::INFINITY))
}

/// The time before the first state, null in JSON.
fn never<'de, D: Deserializer<'de>>(from: D) -> Result<f64, D::Error> {
    Ok(Option::deserialize(from)?.unwrap_or(f64::NEG_INFINITY))
}

impl Default for SingularPassage {
    fn default() -> Self {
        SingularPassage {
            t: f64::NEG_INFINITY,
            rank_indicator: 1.0,
            rate: 0.0,
            step: f64::INFINITY,
            bend: f64::INFINITY,
            largest: 0.0,
            regular: 0.0,
            is_tried: false,
            lost: 0.0,
            known: 0,
            refused: 0,
        }
    }
}

impl SingularPassage {
    /// Adds the rank indicator at an accepted state.
    pub fn add(&mut self, t: f64, rank_indicator: f64) {
        let step = t - self.t;
        let largest = self.largest.max(rank_indicator);
        let is_regular = rank_indicator > tolerances::PLACED_STEPS * largest && step.is_finite();
        let regular = if is_regular { step } else { self.regular };
        let rate = (rank_indicator - self.rank_indicator) / step;
        let bend = if self.step.is_finite() { 2.0 * (rate - self.rate) / (step + self.step) } else { f64::INFINITY };
        let refused = if is_regular { 0 } else { self.refused };
        let is_tried = false;
        *self = SingularPassage { t, rank_indicator, rate, step, bend, largest, regular, is_tried, refused, ..*self };
    }

    /// Adds the change of the energy balance in an accepted step over a singular state.
    pub fn add_loss(&mut self, lost: f64) {
        self.lost = self.lost.max(lost);
        self.known += 1;
    }

    /// True if a change of the energy balance is far beyond those of all steps over singular states so far: then the
    /// step is refused, once in a passage.
    pub fn refuses(&mut self, lost: f64) -> bool {
        let is_unusual =
            // With three refused steps some passages ended in steps without a size.
            self.known >= LOSSES_KNOWN && self.refused == 0 && lost > tolerances::UNUSUAL_LOSS * self.lost;
        self.refused += usize::from(is_unusual);
        is_unusual
    }

    /// True if a step of size `h` comes near a singular state.
    pub fn reaches(&self, h: f64) -> bool {
        self.is_near() || self.rate < 0.0 && h > 0.5 * self.ahead()
    }

    /// True if the last state is so near to a singular one that the next step may come there.
    pub fn may_be_singular(&self) -> bool {
        self.rank_indicator < tolerances::PLACED_STEPS * self.largest
    }

    /// True if no rank indicator has been added.
    pub fn is_unknown(&self) -> bool {
        self.t == f64::NEG_INFINITY
    }

    /// True if the last state is near a singular one.
    pub fn is_near(&self) -> bool {
        self.rank_indicator < tolerances::NEAR_SINGULAR * self.largest
    }

    /// True if steps of size `h` are too small to pass a singular state.
    pub fn is_stuck(&self, h: f64) -> bool {
        self.may_be_singular() && h < tolerances::ROOT_OF_ROUND_OFF * self.regular
    }

    /// Time to the singular state at the last rate, s.
    fn ahead(&self) -> f64 {
        -self.rank_indicator / self.rate
    }

    /// The step to try where the control proposes `h`: once from each state one that goes well across the singular
    /// state, which is then at its `gap`, the fraction of a step that is farthest from all stages; after that one that
    /// ends well before it.
    pub fn place(&mut self, h: f64, gap: f64) -> f64 {
        let ahead = self.ahead();
        let across = self.ahead() / gap;
        // At a singular state there is none ahead.
        if !(self.may_be_singular() && self.rank_indicator > AT_SINGULAR * self.largest && self.rate < 0.0) {
            h
        } else if !self.is_tried && across <= h.max(self.regular) {
            self.is_tried = true;
            across
        } else {
            h.min(0.5 * ahead)
        }
    }

    /// The step to take in a run with fixed steps of size `h`, where `left` is the time to the next point of the grid
    /// and `end` that to the end of the run. A singular state is passed at the `gap` of one step, from an extra state
    /// before it.
    ///
    /// Round-off of positions gives errors eps/s^2 in the velocities and eps/s^3 in the accelerations of a stage where
    /// the rank indicator is s, about a tenth of the step over `scale`, the time in which the motion changes: this
    /// bounds the accuracy of a short step across a singular state. So that step is as long as possible for a method of
    /// this `order`: its local error, (step/scale)^(order + 1), is still round-off.
    pub fn place_fixed(&self, h: f64, left: f64, end: f64, gap: f64, order: usize) -> f64 {
        let ahead = self.ahead();
        if !(self.rate < 0.0 && ahead < end) {
            return left;
        }
        let scale = (-self.largest / self.rate).min((self.largest / self.bend.abs()).sqrt());
        // There are few such steps.
        let local_error = f64::EPSILON.max(0.1 * (h / scale).powi(order as i32));
        let longest = scale * local_error.powf(1.0 / (order as f64 + 1.0));
        let across = h.max(longest).min((end - ahead) / (1.0 - gap));
        let before = ahead - gap * across;
        if before >= left || ahead < 0.5 * gap * across {
            left
        } else if before > LATE_FIXED_STEP * across {
            before
        } else {
            ahead / gap
        }
    }
}

#[cfg(test)]
mod tests {
    use super::SingularPassage;

    fn near(rank_indicator: f64) -> SingularPassage {
        let mut approach = SingularPassage::default();
        [(0.9, 1.0), (1.0, rank_indicator + 0.1), (1.1, rank_indicator)]
            .into_iter()
            .for_each(|(t, rank_indicator)| approach.add(t, rank_indicator));
        approach
    }

    #[test]
    fn a_step_over_the_singular_state_is_tried_once_from_each_state() {
        let mut approach = near(0.2);
        assert!((approach.place(1.0, 0.5) - 0.4).abs() < 1e-12);
        assert!((approach.place(0.3, 0.5) - 0.1).abs() < 1e-12);
        assert_eq!(approach.place(0.09, 0.5), 0.09);
        approach.add(1.2, 0.1);
        assert!((approach.place(0.3, 0.5) - 0.2).abs() < 1e-12);
    }

    #[test]
    fn short_steps_stop_before_the_singular_state_until_one_as_long_as_before_goes_over_it() {
        let mut approach = SingularPassage::default();
        [(0.8, 1.0), (0.9, 0.5), (1.0, 0.4), (1.1, 0.2)]
            .into_iter()
            .for_each(|(t, rank_indicator)| approach.add(t, rank_indicator));
        assert!((approach.place(0.09, 0.5) - 0.05).abs() < 1e-12, "0.2 is longer than the regular 0.1");
        approach.add(1.15, 0.1);
        assert!((approach.place(0.05, 0.5) - 0.1).abs() < 1e-12);
    }

    #[test]
    fn far_from_singular_states_nothing_changes() {
        assert_eq!(SingularPassage::default().place(1.0, 0.5), 1.0);
        let mut leaving = near(0.2);
        leaving.add(1.2, 0.25);
        assert_eq!(leaving.place(1.0, 0.5), 1.0);
    }
}
