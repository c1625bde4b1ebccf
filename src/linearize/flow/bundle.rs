//! What is carried along a motion.

use crate::linearize::{Changes, State};

/// A motion, columns of its variational equations, and motions beside it.
#[derive(Clone, Debug)]
pub struct Bundle {
    /// Where the motion starts, on the constraints.
    pub start: State,
    /// Changes that the constraints allow, carried by the variational equations.
    pub columns: Changes,
    /// Amplitude of the pulse that drives each column; none: no column is driven.
    pub driven: Vec<f64>,
    /// Other starts, on the constraints, carried by the full equations.
    pub members: Vec<State>,
    /// Amplitude of the pulse that drives each member; none: no member is driven.
    pub pushes: Vec<f64>,
    pub pulse: Option<Pulse>,
}

/// An input u(t) = amplitude (4 s (1 - s))^8 for s = (t - start)/width in [0, 1]: smooth to the seventh derivative.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pulse {
    pub input: usize,
    /// s
    pub start: f64,
    /// s
    pub width: f64,
}

impl Pulse {
    pub fn at(&self, t: f64) -> f64 {
        let s = (t - self.start) / self.width;
        if s > 0.0 && s < 1.0 { (4.0 * s * (1.0 - s)).powi(8) } else { 0.0 }
    }
}

/// The bundle at a time.
#[derive(Clone, Debug)]
pub struct Snapshot {
    pub motion: State,
    pub columns: Changes,
    pub members: Vec<State>,
}
