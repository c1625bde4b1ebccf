//! States, and the terms of the equations with their derivatives at one state.

use super::MechanicalSystem;
use crate::math::kkt::{Analysis, Pattern};
use crate::math::{Piece, Regime};
use std::any::Any;
use std::ops::BitOr;
use std::sync::Arc;

/// The set of terms that a caller needs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Need(u8);

impl Need {
    /// M
    pub const MASS: Need = Need(1);
    /// f, and the power of the forces without a potential.
    pub const FORCE: Need = Need(2);
    /// phi, phi', gamma and phi_t
    pub const CONSTRAINTS: Need = Need(4);
    /// G
    pub const G: Need = Need(8);
    /// L = d(G v + phi_t)/dq
    pub const L: Need = Need(16);
    /// M, f, constraints and G: all that v' and lambda need.
    pub const DYNAMICS: Need = Need(1 | 2 | 4 | 8);

    /// True if every term of `other` is in the set.
    #[inline]
    pub fn includes(self, other: Need) -> bool {
        self.0 & other.0 == other.0
    }
}

impl BitOr for Need {
    type Output = Need;
    fn bitor(self, other: Need) -> Need {
        Need(self.0 | other.0)
    }
}

/// Sparsity patterns of M, G, K and C. Clones share them, and what solvers find out about them.
#[derive(Clone, Debug)]
pub struct Structure {
    /// Lower triangle of M, n_v x n_v.
    pub mass: Arc<Pattern>,
    /// G, n_c x n_v; L has the same places.
    pub g: Arc<Pattern>,
    /// K and C, n_v x n_v.
    pub tangent: Arc<Pattern>,
    /// The order of elimination of [M G^T; G 0].
    pub(crate) analysis: Arc<Analysis>,
}

impl Structure {
    /// M by its lower triangle, G, and the places of K and C.
    pub fn new(mass: Pattern, g: Pattern, tangent: Pattern) -> Self {
        let mass = Arc::new(mass);
        let g = Arc::new(g);
        let tangent = Arc::new(tangent);
        Structure { mass, g, tangent, analysis: Arc::default() }
    }
}

/// The terms of the equations at one state, as named in the crate's documentation.
#[derive(Clone, Debug)]
pub struct Terms {
    /// Values of M at the places of [`Structure::mass`].
    pub mass: Vec<f64>,
    /// Generalized forces without the reactions, n_v.
    pub f: Vec<f64>,
    /// Constraints, n_c, m or rad.
    pub phi: Vec<f64>,
    /// phi' = G v + phi_t
    pub phi_dot: Vec<f64>,
    /// Partial derivative of phi with respect to t, n_c.
    pub phi_t: Vec<f64>,
    /// -phi'' at v' = 0
    pub gamma: Vec<f64>,
    /// Values of G at the places of [`Structure::g`].
    pub g: Vec<f64>,
    /// Values of L = d(G v + phi_t)/dq along the directions of v, at the places of G; empty until needed.
    pub l: Vec<f64>,
    /// Power of the forces that is not the rate of a potential, W.
    pub power: f64,
    /// Rates of [`SystemFacts::works`](super::SystemFacts::works).
    pub powers: Vec<f64>,
}

impl Terms {
    /// All zero, for the dimensions and patterns of a system.
    pub fn new(system: &dyn MechanicalSystem) -> Self {
        let n = system.dimensions();
        let structure = system.structure();
        let zeros = |n: usize| vec![0.0; n];
        Terms {
            mass: zeros(structure.mass.entries.len()),
            f: zeros(n.v),
            phi: zeros(n.lambda),
            phi_dot: zeros(n.lambda),
            phi_t: zeros(n.lambda),
            gamma: zeros(n.lambda),
            g: zeros(structure.g.entries.len()),
            l: zeros(structure.g.entries.len()),
            power: 0.0,
            powers: zeros(system.facts().works.len()),
        }
    }
}

/// A state with its accelerations and multipliers.
#[derive(Clone, Copy, Debug)]
pub struct OperatingPoint<'a> {
    /// Time, s.
    pub t: f64,
    /// Coordinates, n_q.
    pub q: &'a [f64],
    /// Velocities, n_v.
    pub v: &'a [f64],
    /// Accelerations, n_v.
    pub vdot: &'a [f64],
    /// Multipliers, n_c.
    pub lambda: &'a [f64],
}

/// Derivatives of r = M v' + G^T lambda - f, values at the places of `Structure::tangent`.
#[derive(Clone, Debug, PartialEq)]
pub struct Tangent {
    /// K = dr/dq along the directions of v, at fixed v' and lambda.
    pub k: Vec<f64>,
    /// C = dr/dv = -df/dv.
    pub c: Vec<f64>,
}

impl Tangent {
    /// All zero, for the places of `pattern`.
    pub fn new(pattern: &Pattern) -> Self {
        Tangent { k: vec![0.0; pattern.entries.len()], c: vec![0.0; pattern.entries.len()] }
    }
}

/// Memory that a system keeps between evaluations, of any type.
#[derive(Default)]
pub struct Scratch {
    memory: Option<Box<dyn Any + Send>>,
    /// Fixed pieces of the piecewise functions, by the number of their switching function; empty where each function
    /// takes the piece of its argument.
    pub pieces: Vec<Piece>,
    /// Values of the inputs u, which add to the equations: a system reads them in each evaluation. Empty where all are
    /// zero.
    pub inputs: Vec<f64>,
    /// True for outputs that nobody reads, which a system need not evaluate; empty where all are read.
    pub unread: Vec<bool>,
}

impl Scratch {
    /// Calls `see` with the memory of type `T`, made the first time or where the memory was of another type.
    #[doc(hidden)]
    pub fn with<T: Any + Send, R>(&mut self, make: impl FnOnce() -> T, see: impl FnOnce(&mut T, Regime) -> R) -> R {
        let kept = self.memory.take().and_then(|memory| memory.downcast().ok());
        let mut memory: Box<T> = kept.unwrap_or_else(|| Box::new(make()));
        let regime = if self.pieces.is_empty() { Regime::FREE } else { Regime::held(&self.pieces) };
        let result = see(&mut memory, regime);
        self.memory = Some(memory);
        result
    }
}
