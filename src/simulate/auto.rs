//! `--method auto`: a sound method for a motion, and why.

use super::spectrum::{Mode, Spectrum};
use super::{Method, Span};
use crate::error::short;
use crate::formulation::Choice;
use crate::system::{Loaded, MechanicalSystem};

/// A method with the reason for it, in one or two sentences.
#[derive(Clone, Debug, PartialEq)]
pub struct Advice {
    pub method: Method,
    pub because: String,
}

/// dop853, and where |lambda| h stops the growth of its steps: from E. Hairer's code, which calls that stiff.
const DOP853: Explicit = Explicit { order: 8, stability: 6.1 };
/// Steps of dop853 that cost as much as one of radau_iia: 4 to 20 on the shipped scenes, the fewer the larger.
const PRICE: f64 = 5.0;
/// Steps that radau_iia takes however smooth the motion is.
const FEWEST: f64 = 30.0;
/// A fast oscillation that lasts may be stepped over where it is this much faster than the rest,
const GAP: f64 = 100.0;
/// and where that saves this much, since what comes later may wake it.
const WAGER: f64 = 10.0;
/// So many steps for the sake of modes at rest deserve a word.
const CRAWL: f64 = 2e4;
/// From here on eight orders cost less than five at equal accuracy, on the shipped scenes.
const TIGHT: f64 = 1e-5;

/// Steps for stability below which rates are those of rounding, or as good as zero.
const SLOW: f64 = 1e-3;

/// What counts of an explicit method.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Explicit {
    pub order: usize,
    /// The largest |lambda| h.
    pub stability: f64,
}

/// What the spectrum says of a motion.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Verdict {
    /// Accuracy limits the steps.
    Calm,
    /// Stability does, but explicit steps are cheap.
    Mild,
    /// So it is, and implicit steps would be as short since the fast directions turn.
    Turning,
    /// What is fast decays.
    Damped,
    /// What is fast lasts and is at rest.
    Asleep,
    /// What is fast lasts and swings.
    Awake,
}

/// The choice for a motion from `state`, which has the v' and lambda of the equations, over `span`.
pub fn advise(system: &dyn MechanicalSystem, state: Loaded, span: Span, (rtol, atol): (f64, f64)) -> Advice {
    let advice = |names: [&str; 3], because: String| {
        let [formulation, integrator, projection] = names.map(Choice::named);
        Advice { method: Method { formulation, integrator, projection, rtol, atol, step: None }, because }
    };
    let explicit = ["index1", if rtol <= TIGHT { "dop853" } else { "dopri5" }, "manifold"];
    let Some(spectrum) = Spectrum::at(system, state, span.end - span.start) else {
        return advice(explicit, "the equations give no K and C, so that their stiffness is not known".to_string());
    };
    let Some(&fastest) = spectrum.modes.last() else {
        return advice(explicit, "the joints prescribe the whole motion, so that nothing can be stiff".to_string());
    };
    let work = Work::new(&spectrum, span.end - span.start, rtol, DOP853);
    let verdict = work.verdict(is_awake(&spectrum, state, (rtol, atol)));
    let names = match verdict {
        Verdict::Damped | Verdict::Asleep => ["ggl", "radau_iia", "none"],
        _ => explicit,
    };
    advice(names, work.words(verdict, fastest, &spectrum))
}

/// Whether the fastest mode swings by more than the tolerance.
pub(super) fn is_awake(spectrum: &Spectrum, state: Loaded, (rtol, atol): (f64, f64)) -> bool {
    let size = state.q.iter().fold(0.0f64, |size, q| size.max(q.abs()));
    spectrum.excitation > atol + rtol * size
}

/// Numbers of steps.
pub(super) struct Work {
    /// Of an explicit method for the accuracy of all modes while they last, and of those below a gap.
    pub accuracy: f64,
    slow: f64,
    /// Of those that are as much slower than the fastest, with no gap asked for: the modes of a finite element mesh have
    /// none.
    band: f64,
    /// Of the same for stability.
    pub stability: f64,
    /// Of an implicit method whose matrix changes too much within a longer step.
    turning: f64,
    /// Whether the fastest mode is there to the end.
    lasts: bool,
}

impl Work {
    pub fn new(spectrum: &Spectrum, duration: f64, tolerance: f64, method: Explicit) -> Self {
        // The error of a step is about (|lambda| h)^(p+1) / (p+1)!.
        let factorial: f64 = (1..=method.order + 1).map(|k| k as f64).product();
        let radians = (factorial * tolerance).powf(1.0 / (method.order + 1) as f64);
        let digits = -tolerance.min(0.5).ln();
        let life = |mode: &Mode| if mode.decay > 0.0 { (digits / mode.decay).min(duration) } else { duration };
        let steps = |modes: &[Mode]| modes.iter().map(|mode| mode.rate() * life(mode) / radians).fold(0.0, f64::max);
        let modes = &spectrum.modes;
        let gap = (1..modes.len()).rev().find(|&i| modes[i].rate() > GAP * modes[i - 1].rate());
        let band = modes.last().map_or(0, |last| modes.partition_point(|mode| GAP * mode.rate() < last.rate()));
        let [damping, stiffness] = spectrum.turning;
        Work {
            band: steps(&modes[..band]),
            accuracy: steps(modes),
            slow: steps(&modes[..gap.unwrap_or(modes.len())]),
            stability: modes.last().map_or(0.0, |fastest| fastest.rate() * duration / method.stability),
            // Newton's iteration over a step contracts by h^2 dC/dt + h^3 dK/dt.
            turning: duration * damping.sqrt().max(stiffness.cbrt()),
            lasts: modes.last().is_some_and(|fastest| life(fastest) >= duration),
        }
    }

    /// Steps that accuracy asks for where the fastest modes are stepped over.
    pub fn smooth(&self) -> f64 {
        if self.lasts { self.slow } else { self.accuracy }
    }

    /// Steps that accuracy asks for where what is at rest stays so.
    pub fn asked(&self, is_excited: bool) -> f64 {
        if !is_excited && self.crawls() { self.band.min(self.smooth()) } else { self.smooth() }
    }

    /// Whether stability asks for a great many steps on behalf of modes that are at rest and far above others.
    pub fn crawls(&self) -> bool {
        self.lasts && self.stability > CRAWL && self.stability > PRICE * WAGER * self.band.max(FEWEST)
    }

    fn explicit(&self) -> f64 {
        self.accuracy.max(self.stability)
    }

    pub fn verdict(&self, is_excited: bool) -> Verdict {
        let smooth = self.smooth();
        let saves = |implicit: f64| self.explicit() > PRICE * implicit.max(FEWEST);
        match self.lasts {
            _ if self.stability <= self.accuracy && !self.lasts => Verdict::Calm,
            false if !saves(smooth) => Verdict::Mild,
            false if !saves(self.turning) => Verdict::Turning,
            false => Verdict::Damped,
            true if self.stability <= smooth.max(FEWEST) => Verdict::Calm,
            true if !saves(WAGER * smooth.max(FEWEST)) => Verdict::Mild,
            true if is_excited || !saves(self.turning) => Verdict::Awake,
            true => Verdict::Asleep,
        }
    }

    fn words(&self, verdict: Verdict, fastest: Mode, spectrum: &Spectrum) -> String {
        let fast = match self.stability > SLOW {
            true => {
                format!("The fastest mode at the start {fastest}{}", if spectrum.is_estimate { ", about" } else { "" })
            }
            false => "No mode at the start is fast".to_string(),
        };
        let [explicit, accuracy, turning] = [self.explicit(), self.accuracy, self.turning].map(count);
        let slow_only = "Where only the slow motion is wanted, generalized_alpha on ggl damps the oscillation away";
        match verdict {
            Verdict::Calm => format!("not stiff. {fast}: accuracy, not stability, limits explicit steps"),
            Verdict::Mild => format!(
                "hardly stiff. {fast}; the {explicit} steps that an explicit method may need cost less than implicit ones"
            ),
            Verdict::Turning => format!(
                "stiff, but implicit methods would gain little. {fast}, in directions that turn with the motion and so \
                 hold an implicit method to some {turning} steps; {explicit} explicit ones cost less"
            ),
            Verdict::Damped => format!(
                "stiff. {fast}; an explicit method would need {explicit} steps for stability, {accuracy} for accuracy"
            ),
            Verdict::Asleep => format!(
                "stiff. {fast} and is at rest; an explicit method would need {explicit} steps to stay stable, radau_iia \
                 steps over the oscillation until something wakes it. {slow_only}"
            ),
            Verdict::Awake => format!(
                "fast, not stiff. {fast} and is awake, so that the tolerance asks for {explicit} explicit steps. {slow_only}"
            ),
        }
    }
}

/// A number of steps with two digits.
pub(super) fn count(steps: f64) -> String {
    let steps = steps.ceil().max(1.0);
    short(format!("{steps:.1e}").parse().unwrap_or(steps))
}
