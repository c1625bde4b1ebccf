//! Accelerations and outputs of perturbed states by the full equations, without any derivative of theirs.

use crate::formulation::{Dynamics, ExponentialMap, StepError};
use crate::linearize::{Matrix, State};
use crate::math::{Piece, Rate, largest};
use crate::system::{Excitation, MechanicalSystem, Need, OperatingPoint, Scratch};
use crate::tolerances;
use crate::tolerances::SAME;

/// A perturbation of a state and of the inputs.
pub struct Shift<'p> {
    /// Change of q along the directions of v.
    pub q: &'p [f64],
    /// Change of v.
    pub v: &'p [f64],
    /// u, u' and u'' of an input, by its index.
    pub input: Option<(usize, [f64; 3])>,
}

/// The equations around a state, each function held on its piece there.
pub struct Probe<'a> {
    dynamics: Dynamics<'a>,
    start: &'a State,
    map: ExponentialMap,
    excitations: Vec<Excitation>,
    /// phi and phi' of the state: perturbed states have the same ones.
    residuals: [Vec<f64>; 2],
    forces: Matrix,
    outputs: usize,
}

/// Returns the pieces of the functions that change their form at a state.
pub fn pieces(system: &dyn MechanicalSystem, state: &State, scratch: &mut Scratch) -> Vec<Piece> {
    let switches = system.switches().all;
    let mut arguments = vec![Rate::fixed(0.0); switches.len()];
    let n = system.dimensions();
    let vdot = vec![0.0; n.v];
    let lambda = vec![0.0; n.lambda];
    let at = OperatingPoint { t: state.t, q: &state.q, v: &state.v, vdot: &vdot, lambda: &lambda };
    system.switching(at, &mut arguments, scratch);
    let pieces = switches.iter().zip(&arguments).map(|(switch, argument)| switch.thresholds.piece(argument.re));
    pieces.map(Option::unwrap_or_default).collect()
}

impl<'a> Probe<'a> {
    /// The equations around a state.
    pub fn new(system: &'a dyn MechanicalSystem, start: &'a State) -> Self {
        let mut dynamics = Dynamics::new(system);
        let pieces = pieces(system, start, &mut dynamics.scratch);
        dynamics.scratch.pieces = pieces;
        dynamics.evaluate(start.t, &start.q, &start.v, Need::MASS | Need::CONSTRAINTS | Need::G);
        let residuals = [dynamics.terms.phi.clone(), dynamics.terms.phi_dot.clone()];
        let excitations = system.facts().excitations();
        let forces = Matrix::zeros(start.v.len(), excitations.len());
        let outputs = system.facts().outputs.len();
        Probe { dynamics, start, map: ExponentialMap::new(system), excitations, residuals, forces, outputs }
    }

    /// Returns v' and the outputs of the state moved by `size` times a shift and closed.
    ///
    /// # Errors
    /// A state that does not close, or without determined accelerations.
    pub fn at(&mut self, shift: &Shift, size: f64) -> Result<(Vec<f64>, Vec<f64>), StepError> {
        let scaled = |x: &[f64]| x.iter().map(|x| size * x).collect::<Vec<f64>>();
        let input = shift.input.map(|(place, jet)| (place, jet.map(|u| size * u)));
        let mut q = self.start.q.clone();
        self.map.apply(self.dynamics.system, &self.start.q, &scaled(shift.q), &mut q);
        let mut v: Vec<f64> = self.start.v.iter().zip(scaled(shift.v)).map(|(v, dv)| v + dv).collect();
        // A velocity or a force leaves the constraints of position as they are.
        let is_displaced = shift.q.iter().any(|dq| *dq != 0.0) || self.driven(input, 0).is_some();
        self.close(&mut q, &mut v, input, is_displaced)?;
        self.solve(&q, &v, input)?;
        let Dynamics { system, vdot, lambda, scratch, .. } = &mut self.dynamics;
        let mut outputs = vec![0.0; self.outputs];
        system.outputs(OperatingPoint { t: self.start.t, q: &q, v: &v, vdot, lambda }, &mut outputs, scratch);
        Ok((vdot.clone(), outputs))
    }

    /// The row of phi that an input moves, with a derivative of the input.
    fn driven(&self, input: Option<(usize, [f64; 3])>, derivative: usize) -> Option<(usize, f64)> {
        let (place, jet) = input?;
        match self.excitations[place] {
            Excitation::Constraint(row) => Some((row, jet[derivative])),
            _ => None,
        }
    }

    /// The correction of phi (0) or phi' (1) to its value at the start, with the factors of the last evaluation.
    fn correction(
        &mut self,
        derivative: usize,
        input: Option<(usize, [f64; 3])>,
        step: &mut [f64],
    ) -> Result<(), StepError> {
        let driven = self.driven(input, derivative);
        let terms = &self.dynamics.terms;
        let values = [&terms.phi, &terms.phi_dot][derivative];
        let mut rows: Vec<f64> =
            values.iter().zip(&self.residuals[derivative]).map(|(now, start)| now - start).collect();
        if let Some((row, u)) = driven {
            rows[row] -= u;
        }
        Ok(self.dynamics.kkt.solve_projection(&rows, step)?)
    }

    /// Moves q and v back to the residuals of the start by the least corrections, to round-off.
    fn close(
        &mut self,
        q: &mut [f64],
        v: &mut [f64],
        input: Option<(usize, [f64; 3])>,
        is_displaced: bool,
    ) -> Result<(), StepError> {
        if self.residuals[0].is_empty() {
            return Ok(());
        }
        if is_displaced {
            self.close_positions(q, v, input)?;
        }
        let need = Need::MASS | Need::CONSTRAINTS | Need::G;
        let mut step = vec![0.0; v.len()];
        self.dynamics.evaluate(self.start.t, q, v, need);
        self.dynamics.factor_truncated()?;
        self.correction(1, input, &mut step)?;
        v.iter_mut().zip(&step).for_each(|(v, dv)| *v -= dv);
        // Once more, for what rounding left.
        self.dynamics.evaluate(self.start.t, q, v, need);
        self.correction(1, input, &mut step)?;
        v.iter_mut().zip(&step).for_each(|(v, dv)| *v -= dv);
        Ok(())
    }

    /// Moves q back to phi of the start.
    fn close_positions(&mut self, q: &mut [f64], v: &[f64], input: Option<(usize, [f64; 3])>) -> Result<(), StepError> {
        let t = self.start.t;
        let need = Need::MASS | Need::CONSTRAINTS | Need::G;
        let mut step = vec![0.0; v.len()];
        let mut rate = vec![0.0; q.len()];
        let mut last = f64::INFINITY;
        for _ in 0..tolerances::PROJECTIONS {
            self.dynamics.evaluate(t, q, v, need);
            self.dynamics.factor_truncated()?;
            self.correction(0, input, &mut step)?;
            let size = largest(&step);
            if size.is_nan() || size >= tolerances::NEWTON_HALVES * last {
                break;
            }
            last = size;
            let system = self.dynamics.system;
            system.rate(q, &step, &mut rate);
            q.iter_mut().zip(&rate).for_each(|(q, rate)| *q -= rate);
            system.normalize(q);
        }
        if last > SAME * largest(q).max(1.0) {
            return Err(StepError::Open);
        }
        Ok(())
    }

    /// Solves for v' and lambda with the input.
    fn solve(&mut self, q: &[f64], v: &[f64], input: Option<(usize, [f64; 3])>) -> Result<(), StepError> {
        let t = self.start.t;
        self.dynamics.right_sides(t, q, v, |_, _| 0.0);
        if let Some((row, acceleration)) = self.driven(input, 2) {
            self.dynamics.lambda[row] += acceleration;
        } else if let Some((place, [u, rate, _])) = input {
            let Dynamics { system, scratch, vdot, .. } = &mut self.dynamics;
            let mut add = |forces: &Matrix, u: f64| {
                vdot.iter_mut().zip(&forces.column(place)).for_each(|(f, slope)| *f += slope * u);
            };
            system.input_forces(t, q, v, &mut self.forces, scratch);
            add(&self.forces, u);
            if self.excitations[place] == Excitation::Displacement {
                system.input_rate_forces(t, q, v, &mut self.forces, scratch);
                add(&self.forces, rate);
            }
        }
        self.dynamics.factor_truncated()?;
        let Dynamics { kkt, terms, vdot, lambda, .. } = &mut self.dynamics;
        kkt.solve_refined(&terms.mass, &terms.g, vdot, lambda)?;
        self.dynamics.finite()
    }
}
