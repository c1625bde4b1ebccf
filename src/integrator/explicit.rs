//! Explicit Runge-Kutta methods: the step of any tableau.

use super::hermite::Hermite;
use super::sums::{accumulate, combine};
use super::{Control, Dense, Integrator, Problem, Stability, Step, StepStart};
use crate::formulation::StepError;
use serde_json::Value;
use std::ops::Range;

/// The constants of an explicit method.
pub struct Tableau {
    /// Order p of the solution.
    pub order: usize,
    /// Nodes of the stages, then of those for interpolation. The first stage is y' at the start of the step.
    pub c: &'static [f64],
    /// Coefficients a_ij, one row per node; row i has i entries.
    pub a: &'static [&'static [f64]],
    /// Weights b_i, one per stage.
    pub b: &'static [f64],
    /// Error estimate of a step.
    pub error: ErrorEstimate,
    /// Weights of all stages in the interpolation polynomial beyond the cubic Hermite part, row by row.
    pub dense: &'static [&'static [f64]],
    /// Makes the step control.
    pub control: fn() -> Control,
}

impl Tableau {
    /// Stability region of the method.
    pub fn stability(&self) -> Stability {
        Stability::of(|i| self.a[i], self.b)
    }

    /// Weights of an embedded error estimate.
    pub fn embedded(&self) -> Option<&'static [f64]> {
        match self.error {
            ErrorEstimate::Embedded(weights) => Some(weights),
            _ => None,
        }
    }
}

/// Error estimate of a tableau.
pub enum ErrorEstimate {
    /// No estimate: steps are fixed.
    None,
    /// The error h sum e_i k_i, with e = b minus the weights of the compared solution. A weight more than stages
    /// belongs to y' at the new state.
    Embedded(&'static [f64]),
    /// Combination of a fifth- and a third-order estimate (DOP853).
    Pair {
        /// Weights e of the estimate of order 5, as in `Embedded`.
        fifth: &'static [f64],
        /// Weights e of the estimate of order 3.
        third: &'static [f64],
    },
}

/// The step k_i = F(t + c_i h, y + h sum_j a_ij k_j), y_1 = y + h sum b_i k_i.
pub struct Explicit {
    tableau: &'static Tableau,
    /// k_i of all stages; the first is a copy of y' at the start.
    k: Vec<Vec<f64>>,
    /// State of a stage, then scratch.
    stage: Vec<f64>,
    control: Control,
    polynomial: Hermite,
}

impl Explicit {
    /// Memory for states of length `len`, see [`Setup::len`](super::Setup::len).
    pub fn new(tableau: &'static Tableau, len: usize) -> Self {
        let zeros = |n: usize| vec![vec![0.0; len]; n];
        let (spacing, middle) = widest_gap(&tableau.c[..tableau.b.len()]);
        let mut control = (tableau.control)();
        control.spacing = spacing;
        control.gap = Some(middle);
        Explicit {
            tableau,
            k: zeros(tableau.c.len()),
            stage: vec![0.0; len],
            control,
            polynomial: Hermite::new(len, tableau.dense.len()),
        }
    }

    fn stages(&self) -> usize {
        self.tableau.b.len()
    }

    /// Index of the stage at the new state, if the embedded error estimate needs one.
    fn end_stage(&self) -> Option<usize> {
        match self.tableau.error {
            ErrorEstimate::Embedded(weights) if weights.len() > self.stages() => Some(weights.len() - 1),
            _ => None,
        }
    }

    /// k_i at the nodes `range`.
    fn evaluate(&mut self, problem: &mut Problem, range: Range<usize>, from: StepStart) -> Result<(), StepError> {
        let h = from.h;
        for i in range {
            combine(&mut self.stage, from.y, h, self.tableau.a[i], &self.k);
            let t = from.t + self.tableau.c[i] * h;
            problem.derivative(t, &self.stage, &mut self.k[i])?;
        }
        Ok(())
    }

    fn error(&mut self, from: StepStart, to: &[f64]) -> Option<f64> {
        let StepStart { y, h, tolerance, .. } = from;
        let last = tolerance.motion();
        let mut square = |weights: &[f64]| {
            self.stage.fill(0.0);
            accumulate(&mut self.stage, h, weights, &self.k);
            tolerance.squares(last, y, to, &self.stage)
        };
        let n = tolerance.tested(last);
        match &self.tableau.error {
            ErrorEstimate::None => None,
            ErrorEstimate::Embedded(weights) => Some((square(weights) / n as f64).sqrt()),
            ErrorEstimate::Pair { fifth, third } => {
                let fifth = square(fifth);
                let third = square(third);
                // err5^2 / sqrt(err5^2 + 0.01 err3^2); zero for a step without any change.
                let both = fifth + 0.01 * third;
                Some(if both == 0.0 { 0.0 } else { fifth / (both * n as f64).sqrt() })
            }
        }
    }
}

/// Length and middle of the widest interval of [0, 1] between nodes; 0 counts as a node.
pub(super) fn widest_gap(nodes: &[f64]) -> (f64, f64) {
    let next = |node: f64| nodes.iter().copied().filter(|other| *other > node).fold(1.0, f64::min);
    let gap = |node: f64| (next(node) - node, 0.5 * (next(node) + node));
    nodes.iter().map(|&node| gap(node)).fold(gap(0.0), |widest, gap| if gap.0 > widest.0 { gap } else { widest })
}

impl Integrator for Explicit {
    fn control(&mut self) -> &mut Control {
        &mut self.control
    }

    /// A step knows its start alone.
    fn memory(&self) -> Option<Value> {
        Some(Value::Array(Vec::new()))
    }

    fn attempt(&mut self, problem: &mut Problem, from: StepStart, to: &mut [f64]) -> Result<Option<f64>, StepError> {
        self.k[0].copy_from_slice(from.slope);
        self.evaluate(problem, 1..self.stages(), from)?;
        combine(to, from.y, from.h, self.tableau.b, &self.k);
        if let Some(end) = self.end_stage() {
            problem.derivative(from.end, to, &mut self.k[end])?;
        }
        Ok(self.error(from, to))
    }

    fn last_slope(&self) -> Option<&[f64]> {
        self.end_stage().map(|end| &self.k[end][..])
    }

    fn lower_order(&self, from: StepStart, out: &mut [f64]) -> bool {
        let (ErrorEstimate::Embedded(error) | ErrorEstimate::Pair { fifth: error, .. }) = self.tableau.error else {
            return false;
        };
        let solution = self.tableau.b.iter().copied().chain(std::iter::repeat(0.0));
        out.copy_from_slice(from.y);
        for ((b, e), k) in solution.zip(error).zip(&self.k) {
            out.iter_mut().zip(k).for_each(|(out, k)| *out += from.h * (b - e) * k);
        }
        true
    }

    fn dense(&mut self) -> Option<&mut dyn Dense> {
        if self.tableau.dense.is_empty() { None } else { Some(self) }
    }
}

/// Cubic Hermite interpolation, raised by the stages of the tableau.
impl Dense for Explicit {
    fn prepare(&mut self, problem: &mut Problem, step: Step) -> Result<(), StepError> {
        let stages = self.stages();
        if self.k.len() > stages {
            self.k[stages].copy_from_slice(step.slope);
            self.evaluate(problem, stages + 1..self.k.len(), step.from)?;
        }
        self.polynomial.prepare(step);
        for (row, weights) in self.polynomial.beyond().iter_mut().zip(self.tableau.dense) {
            row.fill(0.0);
            accumulate(row, step.from.h, weights, &self.k);
        }
        Ok(())
    }

    fn interpolate(&mut self, _: &mut Problem, step: Step, theta: f64, out: &mut [f64]) -> Result<(), StepError> {
        self.polynomial.interpolate(theta, step.from.y, out);
        Ok(())
    }
}
