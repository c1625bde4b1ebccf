//! When a simplified Newton iteration has converged, and when it will not.

/// Judges the norms of successive changes. Source: Hairer, Wanner, Solving Ordinary Differential Equations II, IV.8.
pub struct Convergence {
    most: usize,
    /// Corrections that may be large before the iteration is given up.
    patience: usize,
    /// Tolerated size of the last change, in units of the tolerance.
    kappa: f64,
    /// Changes of this size are round-off.
    floor: f64,
    /// theta / (1 - theta), from which the error left follows; kept between steps.
    eta: f64,
    /// Contraction: ratio of successive changes.
    pub theta: f64,
    pub iterations: usize,
    last: f64,
    last_ratio: f64,
    /// Size of the change with which the last iteration failed; infinite once one converged.
    stalled: f64,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Verdict {
    Converged,
    GoOn,
    Failed,
}

/// Taken for the contraction where one iteration was enough.
const AT_ONCE: f64 = 1e-3;
/// Two changes tell little of the contraction: one far smaller than this is not relied upon.
const LEAST: f64 = 0.1;
/// Round-off of many operations over that of a few.
const NEAR: f64 = 100.0;
/// Part of the tolerance that round-off may take, and how far two sizes of it lie apart.
const TOLERABLE: f64 = 0.1;
const ALIKE: f64 = 10.0;

impl Convergence {
    pub fn new() -> Self {
        Convergence {
            most: 0,
            patience: 0,
            kappa: 0.0,
            floor: 0.0,
            eta: 1.0,
            theta: AT_ONCE,
            iterations: 0,
            last: 0.0,
            last_ratio: 0.0,
            stalled: f64::INFINITY,
        }
    }

    /// Starts an iteration of at most `most` corrections at relative tolerance `rtol`.
    pub fn begin(&mut self, (most, patience): (usize, usize), rtol: f64, floor: f64) {
        self.patience = patience;
        self.floor = floor;
        self.most = most;
        self.kappa = (10.0 * f64::EPSILON / rtol).max(rtol.sqrt().min(0.03));
        self.eta = self.eta.powf(0.8);
        (self.theta, self.iterations) = (AT_ONCE, 0);
    }

    /// Of the next step size: smaller where more iterations were needed.
    pub fn safety(&self) -> f64 {
        let most = self.most as f64;
        0.9 * (2.0 * most + 1.0) / (2.0 * most + self.iterations as f64)
    }

    /// Where changes do not fall any more but are near round-off, nothing better is to be had.
    pub fn judge(&mut self, change: f64) -> Verdict {
        let verdict = self.watch(change);
        if verdict == Verdict::Converged {
            self.stalled = f64::INFINITY;
        }
        if verdict != Verdict::Failed {
            return verdict;
        }
        if change <= NEAR * self.floor || self.is_noise(change) {
            self.theta = AT_ONCE;
            return Verdict::Converged;
        }
        self.stalled = change;
        Verdict::Failed
    }

    /// A shorter step contracts more: changes that stop falling at the same size again are round-off, which unlike masses
    /// and nearly dependent constraints make larger than `floor` knows.
    fn is_noise(&self, change: f64) -> bool {
        change <= TOLERABLE && change <= ALIKE * self.stalled && self.stalled <= ALIKE * change
    }

    fn watch(&mut self, change: f64) -> Verdict {
        self.iterations += 1;
        if change <= self.floor {
            self.theta = self.theta.min(AT_ONCE);
            return Verdict::Converged;
        }
        if self.iterations > 1 {
            let ratio = change / self.last;
            self.theta = if self.iterations == 2 { ratio } else { (ratio * self.last_ratio).sqrt() };
            self.last_ratio = ratio;
            // The first change may have corrected what the start left of its constraints, and tell little.
            let limit = if self.iterations == 2 { 2.0 } else { 0.99 };
            if self.theta.is_nan() || self.theta > limit && self.iterations > self.patience {
                return Verdict::Failed;
            }
            self.theta = self.theta.min(0.99);
            self.eta = (self.theta / (1.0 - self.theta)).max(LEAST);
            let left = self.most.saturating_sub(self.iterations) as i32;
            if self.iterations > self.patience.max(2) && self.eta * change * self.theta.powi(left) > self.kappa {
                return Verdict::Failed;
            }
        }
        self.last = change.max(f64::MIN_POSITIVE);
        if self.eta * change <= self.kappa { Verdict::Converged } else { Verdict::GoOn }
    }
}
