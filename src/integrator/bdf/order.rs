//! Choice of the order and the size of the next step.

use super::history::HIGHEST;
use crate::integrator::Control;
use serde::{Deserialize, Serialize};

/// Order k and step size, from the norms of h^(j+1) y^(j+1) for j = k - 2 to k + 1: the order falls where these no
/// longer decrease with j, as they do not where the formula of order k is unstable, and rises where they do. A run
/// begins with order 1, then 2, and doubles every step as long as that goes well. StepStart order 3 on, whose formulas are
/// not stable on ever longer steps, a step grows after k + 1 equal ones. Source: Brenan, Campbell, Petzold, Numerical
/// Solution of Initial-Value Problems in DAEs, 5.2, and the codes IDA and VODE.
#[derive(Clone, Serialize, Deserialize)]
pub struct Order {
    pub k: usize,
    pub control: Control,
    is_starting: bool,
    /// Accepted steps with this order and size.
    steady: usize,
    /// Size of the last accepted step.
    last: f64,
    /// Rejected attempts of the present step.
    failures: usize,
    /// Those of the last attempt, which a choice follows at once.
    #[serde(skip)]
    terms: DerivativeNorms,
}

/// Highest order that is stable on steps each twice as long as the last: up to a factor of 1 + sqrt 2. Source: Hairer,
/// Norsett, Wanner, Solving Ordinary Differential Equations I, III.5.
const STABLE: usize = 2;

/// Norms of h^(j+1) y^(j+1) for j = k - 2 ... k + 1 after the last attempt; infinite where unknown.
pub type DerivativeNorms = [f64; 4];

impl Order {
    pub fn new() -> Self {
        Order {
            k: 1,
            control: Control::new(2.0, 0.25, 2.0),
            is_starting: true,
            steady: 0,
            last: 0.0,
            failures: 0,
            terms: [f64::INFINITY; 4],
        }
    }

    fn set(&mut self, k: usize) {
        if k != self.k {
            (self.k, self.steady) = (k, 0);
            self.control.exponent = 1.0 / (k as f64 + 1.0);
        }
    }

    pub fn restart(&mut self) {
        self.set(1);
        (self.is_starting, self.steady, self.failures) = (true, 0, 0);
    }

    /// True if the terms do not decrease from the order below, so that this is to be preferred; unless they are so
    /// small that round-off may be most of them.
    fn falls(&self) -> bool {
        let [lowest, lower, own, _] = self.terms;
        match self.k {
            1 => false,
            // The step may grow, and round-off, which does not fall with the order, may be most of its error.
            k if own <= 0.05 * (k as f64 + 1.0) => false,
            2 => lower <= 0.5 * own,
            _ => lowest.max(lower) <= own,
        }
    }

    /// Notes the terms of an attempt with this error, and lowers the order after one that is refused.
    pub fn tried(&mut self, error: f64, terms: DerivativeNorms) {
        self.terms = terms;
        if error <= 1.0 {
            return;
        }
        (self.is_starting, self.failures) = (false, self.failures + 1);
        let k = match self.failures {
            // As in IDA: the past does not predict what comes.
            3.. => 1,
            _ if self.falls() => self.k - 1,
            _ => self.k,
        };
        self.set(k);
        self.steady = 0;
    }

    /// Order and size of the next step after an accepted one, where `known` states are known after it.
    pub fn propose(&mut self, h: f64, growing: bool, known: usize) -> f64 {
        self.steady = if h == self.last { self.steady + 1 } else { 1 };
        (self.last, self.failures) = (h, 0);
        let [_, lower, own, higher] = self.terms;
        let highest = HIGHEST.min(known - 1);
        // Twice the step at one order has four times the error.
        self.is_starting &= growing && own <= 0.1 * (self.k as f64 + 1.0);
        if self.is_starting {
            self.set(STABLE.min(highest));
            return 2.0 * h;
        }
        let may_grow = growing && (self.k <= STABLE || self.steady > self.k);
        let is_steady = self.steady > self.k + 1 && self.k < highest;
        let (k, term) = match self.k {
            k if self.falls() => (k - 1, lower),
            1 if is_steady && higher < 0.5 * own => (2, higher),
            k if k > 1 && is_steady && lower <= own.min(higher) => (k - 1, lower),
            k if k > 1 && is_steady && higher < own => (k + 1, higher),
            k => (k, own),
        };
        self.set(k);
        let order = k as f64 + 1.0;
        let factor = (2.0 * term / order + 1e-4).powf(-1.0 / order);
        match factor {
            // As in VODE: formulas and the matrix are those of equal steps.
            _ if factor >= 1.5 && may_grow => h * factor.min(2.0),
            _ if factor <= 1.0 => h * factor.clamp(0.5, 0.9),
            _ => h,
        }
    }

    /// The same with an order that the method has.
    pub fn bounded(self) -> Self {
        Order { k: self.k.clamp(1, HIGHEST), ..self }
    }
}
