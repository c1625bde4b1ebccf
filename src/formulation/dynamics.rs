//! The equations of motion of one system with the memory to solve them.

use super::Statistics;
use crate::error::Result;
use crate::math::all_finite;
use crate::math::kkt::{SaddlePoint, Singular};
use crate::system::{MechanicalSystem, Need, Scratch, Structure, Terms};
use crate::tolerances::TRUNCATED_RANK;
use std::fmt;
use std::sync::Arc;

/// The reason why a state cannot be evaluated or a step not be made.
#[derive(Clone, Debug, PartialEq)]
pub enum StepError {
    /// The state or a solution is infinite or not a number: the motion diverged.
    NotFinite,
    /// A term of the equations is not finite: an expression left its domain, or two points coincide. Names the term.
    Term(String),
    /// The coordinate has neither mass nor constraint along some direction of motion.
    Undetermined(String),
    /// The equations do not determine the accelerations.
    Singular(Singular),
    /// Newton's method does not find the end of a step.
    NotConverged,
    /// A projection does not satisfy the constraints.
    Open,
    /// The method does not fit these equations, whatever the step.
    Unsuitable {
        /// The reason, for the message.
        reason: &'static str,
        /// A method that fits, for the message.
        hint: &'static str,
    },
}

impl StepError {
    /// Remedy, where it does not depend on the run.
    pub fn hint(&self) -> Option<&'static str> {
        match self {
            StepError::Term(_) => Some(
                "the motion diverged (try a smaller step or a projection such as `manifold`), an expression left its \
                 domain (a division by zero, `sqrt`, `ln` or a power of what is negative, `mod` by zero, `floor` or \
                 `mod` beyond 2^29), or two points met: look at the motion just before the end",
            ),
            StepError::Unsuitable { hint, .. } => Some(hint),
            _ => None,
        }
    }

    /// True if no smaller step can help.
    pub fn is_fatal(&self) -> bool {
        matches!(self, StepError::Unsuitable { .. })
    }
}

impl fmt::Display for StepError {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            StepError::NotFinite => write!(out, "the motion is no longer finite"),
            StepError::Term(term) => write!(out, "{term} is infinite or not a number"),
            StepError::Undetermined(coordinate) => write!(
                out,
                "the motion is not determined: `{coordinate}` has neither mass nor constraint in a direction"
            ),
            StepError::Singular(singular) => write!(out, "{singular}"),
            StepError::NotConverged => write!(out, "Newton's method does not converge"),
            StepError::Open => write!(out, "the projection does not close the joints: its residual no longer falls"),
            StepError::Unsuitable { reason, .. } => write!(out, "{reason}"),
        }
    }
}

impl From<Singular> for StepError {
    fn from(singular: Singular) -> Self {
        match singular {
            Singular::NotFinite => StepError::NotFinite,
            other => StepError::Singular(other),
        }
    }
}

/// A system, the terms of its equations at the last state, and the factors of
///
/// ```text
/// [ M  G^T ] [ v'     ]   [ f     ]
/// [ G   0  ] [ lambda ] = [ gamma ]
/// ```
pub struct Dynamics<'a> {
    /// The mechanism.
    pub system: &'a dyn MechanicalSystem,
    /// Patterns of its matrices.
    pub structure: Structure,
    /// Terms at the last state.
    pub terms: Terms,
    /// The saddle-point matrix above and its factors.
    #[doc(hidden)]
    pub kkt: SaddlePoint,
    /// Constraints that depend on the others wherever phi = 0, and are dropped.
    pub dropped: Vec<usize>,
    /// Rows count as dependent below this fraction of the reference value: see `SaddlePoint::factor_truncated`.
    pub rank_tolerance: f64,
    /// Rank indicator of a dense solver other than `kkt` at the last solution.
    pub dense_indicator: f64,
    /// Reference value of `dense_indicator`, set at the start of a step as that of `kkt` is.
    pub dense_reference: f64,
    /// Rank indicator of G at the last solution where that came from another solver than `kkt`: see
    /// `SaddlePoint::rank_indicator`.
    pub rank_indicator: Option<f64>,
    /// True if multipliers of redundant rows are to be those of least norm, as for output; v' does not depend on it.
    pub wants_least: bool,
    /// v' of the last solution.
    pub vdot: Vec<f64>,
    /// lambda of the last solution.
    pub lambda: Vec<f64>,
    /// True if the factors are those of the last state at which terms were evaluated.
    pub is_factored: bool,
    /// True if a projection may take the factors of the last evaluation: that was at the state it projects, up to the
    /// error of a step.
    pub ends_near: bool,
    /// True if G was rank deficient at the last solution; false with a formulation that does not ask for the rank.
    pub is_rank_deficient: bool,
    /// Counters of the work.
    pub statistics: Statistics,
    /// Memory of the system, with the values of its inputs.
    pub scratch: Scratch,
    /// Inputs that are functions of the state.
    #[doc(hidden)]
    pub law: Option<Arc<Law>>,
}

/// Writes those of the inputs u that are functions of the state of a system at (t, q, v).
pub type Law = dyn Fn(&dyn MechanicalSystem, (f64, &[f64], &[f64]), &mut [f64]) + Send + Sync;

impl<'a> Dynamics<'a> {
    /// Patterns and memory for a system; nothing is evaluated.
    pub fn new(system: &'a dyn MechanicalSystem) -> Self {
        let n = system.dimensions();
        let structure = system.structure();
        Dynamics {
            system,
            terms: Terms::new(system),
            kkt: SaddlePoint::sharing(&structure.mass, &structure.g, &structure.analysis),
            dropped: Vec::new(),
            rank_tolerance: TRUNCATED_RANK,
            dense_indicator: 0.0,
            dense_reference: 0.0,
            rank_indicator: None,
            wants_least: true,
            structure,
            vdot: vec![0.0; n.v],
            lambda: vec![0.0; n.lambda],
            is_factored: false,
            ends_near: false,
            is_rank_deficient: false,
            statistics: Statistics::default(),
            scratch: Scratch::default(),
            law: None,
        }
    }

    /// Evaluates the terms `need` at a state.
    #[inline]
    pub fn evaluate(&mut self, t: f64, q: &[f64], v: &[f64], need: Need) {
        self.is_factored = false;
        if let Some(law) = &self.law {
            law(self.system, (t, q, v), &mut self.scratch.inputs);
        }
        self.system.evaluate(t, q, v, need, &mut self.terms, &mut self.scratch);
    }

    /// Factors the saddle-point matrix of the terms.
    pub fn factor(&mut self) -> Result<(), StepError> {
        self.statistics.factorizations += 1;
        let factored = self.kkt.factor(&self.terms.mass, &self.terms.g);
        self.is_factored = factored.is_ok();
        factored.map_err(|singular| self.halt(singular))
    }

    /// Factors the matrix truncated near singular states: see `SaddlePoint::factor_truncated`.
    #[inline]
    pub fn factor_truncated(&mut self) -> Result<(), StepError> {
        self.statistics.factorizations += 1;
        let factored = self.kkt.factor_truncated(&self.terms.mass, &self.terms.g, self.rank_tolerance);
        self.is_factored = factored.is_ok();
        factored.map_err(|singular| self.halt(singular))
    }

    /// Dependent rows of G at a state, which should satisfy the constraints; none where that state has no solution.
    /// Also the norms of the part of gamma that no acceleration can satisfy, and of the terms that it is made of.
    pub fn dependent_rows(&mut self, t: f64, q: &[f64], v: &[f64]) -> (Vec<usize>, (f64, f64)) {
        self.right_sides(t, q, v, |_, _| 0.0);
        let solved = match self.kkt.factor(&self.terms.mass, &self.terms.g) {
            Ok(()) => self.kkt.solve(&mut self.vdot, &mut self.lambda),
            Err(singular) => Err(singular),
        };
        let rows = self.kkt.left_out().to_vec();
        if solved.is_err() || rows.is_empty() {
            return (rows, (0.0, 0.0));
        }
        let products = self.structure.g.entries.iter().zip(&self.terms.g).map(|((_, i), g)| (g * self.vdot[*i]).abs());
        let usual = products.chain(self.terms.gamma.iter().map(|gamma| gamma.abs())).fold(0.0, f64::max);
        (rows, (self.kkt.inconsistency(), usual))
    }

    /// The part of phi, over its scale, that no change of q removes; `None` where the rows of G are independent.
    pub fn dependent_rows_open(&mut self, t: f64, q: &[f64], v: &[f64]) -> Option<f64> {
        self.evaluate(t, q, v, Need::DYNAMICS);
        self.vdot.fill(0.0);
        self.lambda.copy_from_slice(&self.terms.phi);
        self.kkt.factor(&self.terms.mass, &self.terms.g).ok()?;
        self.kkt.solve(&mut self.vdot, &mut self.lambda).ok()?;
        let scale = self.system.facts().scales.iter().copied().fold(0.0, f64::max);
        (!self.kkt.left_out().is_empty()).then(|| self.kkt.inconsistency() / scale)
    }

    /// Drops these rows from now on: see `SaddlePoint::drop_rows`.
    pub fn drop_rows(&mut self, rows: &[usize]) {
        if self.dropped != rows {
            self.kkt.drop_rows(rows);
            self.dropped = rows.to_vec();
        }
    }

    /// Sets the reference values of the rank indicators.
    pub fn refer_to(&mut self, saddle: f64, dense: f64) {
        (self.kkt.rank_reference, self.dense_reference) = (saddle, dense);
    }

    /// The reason why the terms have no solution, with names.
    pub(crate) fn halt(&self, singular: Singular) -> StepError {
        match singular {
            Singular::Undetermined { coordinate } => StepError::Undetermined(self.coordinate(coordinate)),
            Singular::NotFinite => self.infinite_term().map_or(StepError::NotFinite, StepError::Term),
            other => StepError::Singular(other),
        }
    }

    fn coordinate(&self, direction: usize) -> String {
        let names = self.system.facts().names.v.clone();
        names.get(direction).map_or(String::new(), |name| name.trim_end_matches('\'').to_string())
    }

    /// The first term that is not finite; `None` where only rates of constraints are not: then velocities are too
    /// large.
    fn infinite_term(&self) -> Option<String> {
        let Terms { f, g, phi, .. } = &self.terms;
        if let Some(i) = f.iter().position(|f| !f.is_finite()) {
            let what = if i < self.system.dimensions().moving() { "force on" } else { "rate of" };
            return Some(format!("the {what} `{}`", self.coordinate(i)));
        }
        let open = phi.iter().position(|x| !x.is_finite());
        let entry = || g.iter().position(|g| !g.is_finite()).map(|entry| self.structure.g.entries[entry].0);
        let row = open.or_else(entry)?;
        Some(format!("the constraint of `{}`", self.system.facts().names.lambda.get(row)?))
    }

    /// v' and lambda at a state with phi'' = `acceleration_level`(phi, phi'), which is zero for the plain equations.
    pub fn solve(
        &mut self,
        t: f64,
        q: &[f64],
        v: &[f64],
        acceleration_level: impl Fn(f64, f64) -> f64,
    ) -> Result<(), StepError> {
        self.right_sides(t, q, v, acceleration_level);
        self.factor_truncated()?;
        self.solve_factored()
    }

    /// v' and lambda of the plain equations at another velocity of the state whose matrix is factored.
    pub fn solve_at_velocity(&mut self, t: f64, q: &[f64], v: &[f64]) -> Result<(), StepError> {
        self.right_sides(t, q, v, |_, _| 0.0);
        self.solve_factored()
    }

    #[inline]
    fn solve_factored(&mut self) -> Result<(), StepError> {
        self.is_rank_deficient = self.kkt.is_rank_deficient();
        let solved = if self.wants_least {
            self.kkt.solve(&mut self.vdot, &mut self.lambda)
        } else {
            self.kkt.solve_motion(&mut self.vdot, &mut self.lambda)
        };
        solved.map_err(|singular| self.halt(singular))
    }

    /// Evaluates the terms at a state and writes f to `vdot`, gamma + `acceleration_level` to `lambda`.
    pub fn right_sides(&mut self, t: f64, q: &[f64], v: &[f64], acceleration_level: impl Fn(f64, f64) -> f64) {
        self.statistics.rhs_evaluations += 1;
        self.evaluate(t, q, v, Need::DYNAMICS);
        self.vdot.copy_from_slice(&self.terms.f);
        let Terms { gamma, phi, phi_dot, .. } = &self.terms;
        for (((lambda, gamma), &phi), &phi_dot) in self.lambda.iter_mut().zip(gamma).zip(phi).zip(phi_dot) {
            *lambda = gamma + acceleration_level(phi, phi_dot);
        }
    }

    /// An error if v' or lambda is infinite or not a number.
    pub fn finite(&self) -> Result<(), StepError> {
        if all_finite(&self.vdot) && all_finite(&self.lambda) { Ok(()) } else { Err(StepError::NotFinite) }
    }

    /// Power of the forces without a potential and of moving constraints, lambda^T phi_t, W; then the powers whose
    /// work is watched.
    pub fn powers(&self, lambda: &[f64]) -> impl Iterator<Item = f64> {
        let moving = lambda.iter().zip(&self.terms.phi_t).map(|(l, p)| l * p).sum::<f64>();
        std::iter::once(self.terms.power + moving).chain(self.terms.powers.iter().copied())
    }

    /// max |phi''| = max |G v' - gamma| at the last solution. `row` has n_c places.
    pub fn acceleration_residual(&self, row: &mut [f64]) {
        row.iter_mut().zip(&self.terms.gamma).for_each(|(row, gamma)| *row = -gamma);
        self.structure.g.multiply(&self.terms.g, &self.vdot, row);
    }
}
