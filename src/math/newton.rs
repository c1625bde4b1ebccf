//! Newton's method: the loop and the convergence monitor of all iterations.

use super::largest;
use crate::tolerances;

/// Rate of convergence of an iteration that needed one correction. Unit: `[1]`. Why: no second change tells it.
const RATE_AT_ONCE: f64 = 1e-3;

/// Two sizes at which iterations of a longer and a shorter step no longer fall are of the same round-off up to this
/// factor. Unit: `[1]`. Why: a step is halved at least, which would change the convergence by more.
const ROUND_OFF_ALIKE: f64 = 10.0;

/// A matrix whose corrections shrink by less does not serve its own system. Unit: `[1]`. Test:
/// `constraints_hold_and_the_penalty_does_not_matter`.
const MATRIX_RENEWED: f64 = 0.3;

/// Limits of an iteration; sizes are in the unit of its changes.
#[derive(Clone, Copy, Debug)]
pub struct Limits {
    /// Largest number of corrections.
    pub most: usize,
    /// Tolerated error of the result.
    pub tolerance: f64,
    /// Changes up to this size are round-off.
    pub round_off: f64,
    /// Stagnation tolerance: changes up to this size that no longer fall are round-off too.
    pub stagnation: f64,
    /// Largest allowed ratio of a change above the stagnation tolerance to the last one, from the second on.
    pub contraction: f64,
    /// Number of growing corrections before the iteration counts as diverged.
    pub patience: usize,
    /// Lower bound on the rate used in error estimates.
    pub least_rate: f64,
    /// Largest rate at which the matrix is used for the next system too.
    pub kept_rate: f64,
}

impl Limits {
    /// No limits, for struct update.
    pub const NONE: Limits = Limits {
        most: usize::MAX,
        tolerance: 0.0,
        round_off: 0.0,
        stagnation: 0.0,
        contraction: f64::INFINITY,
        patience: usize::MAX,
        least_rate: 0.0,
        kept_rate: 0.0,
    };
}

/// Decision after a correction.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Verdict {
    Continue,
    /// The error left is within the tolerance.
    Converged,
    /// The corrections grow, or would take too many iterations.
    Diverged,
}

/// Convergence monitor on the sizes of successive changes d_k. With the rate theta = |d_k|/|d_(k-1)|, the geometric
/// mean of the last two, the error left after a correction is theta/(1 - theta) |d_k|. Source: Hairer, Wanner, Solving
/// Ordinary Differential Equations II, IV.8.
#[derive(Clone, Debug)]
pub struct Monitor {
    limits: Limits,
    /// Ratio of successive changes; `RATE_AT_ONCE` after a single one.
    pub rate: f64,
    /// The largest ratio of successive changes above the stagnation tolerance; zero if there is none.
    pub slowest: f64,
    /// Number of corrections so far.
    pub iterations: usize,
    /// True if the last iteration ended by stagnation at round-off.
    pub has_stagnated: bool,
    /// theta/(1 - theta), kept between iterations as a first guess.
    contraction: f64,
    size: f64,
    ratio: f64,
    /// Size of the change at which the last iteration diverged, or at which changes are known to be round-off; zero
    /// once one converged.
    stalled: f64,
}

impl Default for Monitor {
    fn default() -> Self {
        Monitor {
            limits: Limits::NONE,
            rate: RATE_AT_ONCE,
            slowest: 0.0,
            iterations: 0,
            has_stagnated: false,
            contraction: 1.0,
            size: f64::INFINITY,
            ratio: 1.0,
            stalled: 0.0,
        }
    }
}

impl Monitor {
    /// Iterates: `correct` applies one correction, with a new matrix if its argument is true, and returns the size of
    /// the change. Returns true if the iteration converged.
    pub fn solve<E>(&mut self, limits: Limits, mut correct: impl FnMut(bool) -> Result<f64, E>) -> Result<bool, E> {
        self.begin(limits);
        loop {
            let change = correct(self.wants_matrix())?;
            match self.judge(change) {
                Verdict::Continue => {}
                verdict => return Ok(verdict == Verdict::Converged),
            }
        }
    }

    fn begin(&mut self, limits: Limits) {
        self.limits = limits;
        self.contraction = self.contraction.powf(0.8);
        (self.rate, self.slowest, self.iterations) = (RATE_AT_ONCE, 0.0, 0);
        (self.has_stagnated, self.size) = (false, f64::INFINITY);
    }

    /// True if the corrections so far converge so slowly that the matrix is to be renewed.
    fn wants_matrix(&self) -> bool {
        self.iterations > 1 && self.ratio > MATRIX_RENEWED && self.size > self.limits.stagnation
    }

    /// True if the matrix of the last iteration can be used for the next one.
    pub fn keeps_matrix(&self) -> bool {
        self.rate <= self.limits.kept_rate
    }

    fn judge(&mut self, change: f64) -> Verdict {
        let verdict = self.watch(change);
        match verdict {
            Verdict::Continue => {}
            Verdict::Converged => self.stalled = 0.0,
            Verdict::Diverged if self.is_round_off(change) => {
                (self.rate, self.has_stagnated) = (RATE_AT_ONCE, true);
                return Verdict::Converged;
            }
            Verdict::Diverged => self.stalled = change,
        }
        verdict
    }

    /// True if changes that no longer decrease are round-off: below the stagnation tolerance, or tolerable and of the
    /// size at which the iteration of a longer step, which contracts less, stopped too. Masses of very different size
    /// and nearly dependent constraints make round-off larger than the estimate. Later steps accept this size at once;
    /// otherwise each would have to be shorter than the one before.
    fn is_round_off(&self, change: f64) -> bool {
        let is_met_again = change <= ROUND_OFF_ALIKE * self.stalled && self.stalled <= ROUND_OFF_ALIKE * change;
        // A digit is left for the error of the step.
        change <= self.limits.stagnation || change <= 0.1 && is_met_again
    }

    fn watch(&mut self, change: f64) -> Verdict {
        let Limits { most, tolerance, round_off, stagnation, contraction, patience, least_rate, .. } = self.limits;
        self.iterations += 1;
        let last = std::mem::replace(&mut self.size, change.max(f64::MIN_POSITIVE));
        if change <= round_off {
            self.rate = self.rate.min(RATE_AT_ONCE);
            return Verdict::Converged;
        }
        if self.iterations > 1 {
            let ratio = change / last;
            self.rate = if self.iterations == 2 { ratio } else { (ratio * self.ratio).sqrt() };
            self.ratio = ratio;
            if change > stagnation {
                self.slowest = self.slowest.max(ratio);
            }
            let limit = tolerances::DIVERGED[usize::from(self.iterations > 2)];
            let is_stagnant = self.iterations > 2 && change <= stagnation && self.rate > tolerances::STAGNANT;
            let has_diverged = self.rate > limit && self.iterations > patience;
            if self.rate.is_nan() || is_stagnant || ratio > contraction || has_diverged {
                return Verdict::Diverged;
            }
            self.rate = self.rate.min(tolerances::DIVERGED[1]);
            self.contraction = (self.rate / (1.0 - self.rate)).max(least_rate);
            let left = most.saturating_sub(self.iterations).min(i32::MAX as usize) as i32;
            if self.iterations > patience.max(2) && self.contraction * change * self.rate.powi(left) > tolerance {
                return Verdict::Diverged;
            }
        }
        match change {
            _ if self.contraction * change <= tolerance => Verdict::Converged,
            _ if self.iterations >= most || change.is_nan() => Verdict::Diverged,
            _ => Verdict::Continue,
        }
    }

    /// Forgets the size of round-off, before an iteration of the same system with another matrix.
    pub fn reset(&mut self) {
        self.stalled = 0.0;
    }

    /// State that the next iteration takes from the last one, which converged: see [`recall`](Self::recall).
    pub fn memory(&self) -> [f64; 2] {
        [self.contraction, self.stalled]
    }

    /// Restores the state of [`memory`](Self::memory).
    pub fn recall(&mut self, memory: [f64; 2]) {
        [self.contraction, self.stalled] = memory;
    }
}

/// max |change| / max |changed|; zero for a change of zero.
pub fn relative(change: &[f64], changed: &[f64]) -> f64 {
    let change = largest(change);
    if change > 0.0 { change / largest(changed) } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use super::*;

    const LIMITS: Limits = Limits {
        most: 20,
        tolerance: 1e-3,
        round_off: 1e-12,
        stagnation: 1e-9,
        patience: 0,
        kept_rate: 1e-3,
        ..Limits::NONE
    };

    /// The sizes of changes that shrink by `rate` until the iteration ends.
    fn run(monitor: &mut Monitor, limits: Limits, rate: f64, floor: f64) -> (bool, usize) {
        let mut size = 1.0 / rate;
        let converged = monitor.solve(limits, |_| {
            size = (size * rate).max(floor);
            Ok::<_, ()>(size)
        });
        (converged == Ok(true), monitor.iterations)
    }

    #[test]
    fn the_error_left_is_that_of_the_rate() {
        let mut monitor = Monitor::default();
        // 1, 0.1, 0.01, 0.001: what is left of the third change is a ninth of it.
        assert_eq!(run(&mut monitor, LIMITS, 0.1, 0.0), (true, 4));
        assert!((monitor.contraction * monitor.size / (1e-3 / 9.0) - 1.0).abs() < 1e-12 && !monitor.keeps_matrix());
    }

    #[test]
    fn an_iteration_that_cannot_arrive_is_given_up_early() {
        let (converged, iterations) = run(&mut Monitor::default(), LIMITS, 0.8, 0.0);
        assert!(!converged && iterations == 3, "{iterations}");
    }

    #[test]
    fn changes_that_stop_falling_at_round_off_are_accepted_and_said_so() {
        let mut monitor = Monitor::default();
        let exact = Limits { tolerance: 1e-14, ..LIMITS };
        let (converged, _) = run(&mut monitor, exact, 1e-3, 1e-10);
        assert!(converged && monitor.has_stagnated);
        assert!(!run(&mut monitor, exact, 1e-3, 1e-7).0, "above the stagnation tolerance");
    }

    /// A longer step stopped at this size, too: from the second on such changes are round-off, until an iteration
    /// converges.
    #[test]
    fn round_off_that_was_met_twice_is_known() {
        let mut monitor = Monitor::default();
        let exact = Limits { tolerance: 1e-14, ..LIMITS };
        let met = [1e-7, 3e-7, 1e-7].map(|floor| run(&mut monitor, exact, 1e-3, floor).0);
        assert_eq!(met, [false, true, true]);
        assert!(run(&mut monitor, exact, 1e-3, 0.0).0 && !run(&mut monitor, exact, 1e-3, 1e-7).0);
    }

    #[test]
    fn changes_that_do_not_contract_are_given_up_unless_they_are_round_off() {
        let steep = Limits { tolerance: 0.0, patience: 20, contraction: 0.25, ..LIMITS };
        let mut monitor = Monitor::default();
        assert_eq!(run(&mut monitor, steep, 0.5, 0.0), (false, 2));
        assert_eq!(monitor.slowest, 0.5);
        // 1, 1e-2, ..., 1e-10, 1e-10: the last is not counted.
        assert_eq!(run(&mut monitor, steep, 1e-2, 1e-10), (true, 7));
        assert!((monitor.slowest / 1e-2 - 1.0).abs() < 1e-12 && monitor.has_stagnated);
    }
}
