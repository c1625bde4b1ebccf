//! The variational equations at a state: every matrix of a linear model.

use super::{Changes, LinearizationPoint, Matrix, singular};
use crate::error::{Error, Result, clock};
use crate::formulation::{Dynamics, StepError, free_directions};
use crate::math::kkt::Pattern;
use crate::math::memory::refuse_dense;
use crate::system::{
    Column, Excitation, LeviCivita, MechanicalSystem, Need, OperatingPoint, OutputTangent, Tangent, check_start,
};

/// Small changes (dq, dv) of a state, dq along the velocity directions, with those of v' and lambda:
///
/// ```text
/// dq' = dv - [v, dq]
/// M dv' + G^T dlambda = -K dq - C dv + f_u du
/// G dv' = -Gdd dq - G1 dv
/// ```
///
/// where K and C belong to r = M v' + G^T lambda - f at the v' and lambda of the state, Gd = d(G v + phi_t)/dq and
/// Gdd = d(phi'')/dq; G1 = d(phi'')/dv = 2 Gd + G [v, .]. Changes that stay on the constraints have G dq = 0 and
/// G dv + Gd dq = 0. The saddle-point matrix is factored once: a direction costs a back-substitution.
pub struct Variation<'a> {
    /// The terms of the equations and the factored saddle-point matrix.
    pub dynamics: Dynamics<'a>,
    /// The operating point.
    pub point: LinearizationPoint,
    /// K and C.
    pub tangent: Tangent,
    /// Values of Gdd on the sparsity pattern of G.
    gdd: Vec<f64>,
    /// Velocity of the state that is evaluated.
    v: Vec<f64>,
    /// The equation that each input is part of.
    pub(super) excitations: Vec<Excitation>,
    /// Number of outputs.
    outputs: usize,
}

const NO_TANGENT: &str = "these equations give no K, C and gradient of phi''";
const GIVE_THEM: &str = "implement MechanicalSystem::tangent and acceleration_gradient, or write them as Equations";

impl<'a> Variation<'a> {
    /// The equations at a state, which should be on the constraints.
    ///
    /// # Errors
    /// A state that the system refuses; one without determined accelerations; a singular one; equations without
    /// derivatives.
    pub fn new(system: &'a dyn MechanicalSystem, t: f64, q: &[f64], v: &[f64]) -> Result<Self> {
        check_start(system, t, q, v)?;
        let dynamics = Dynamics::new(system);
        let tangent = Tangent::new(&dynamics.structure.tangent);
        let gdd = vec![0.0; dynamics.structure.g.entries.len()];
        let own = v.to_vec();
        let excitations = system.facts().excitations();
        let outputs = system.facts().outputs.len();
        let point = LinearizationPoint::default();
        let mut variation = Variation { dynamics, point, tangent, gdd, v: own, excitations, outputs };
        variation.operate_at(t, q, v)?;
        Ok(variation)
    }

    /// Makes another state, which should be on the constraints, the operating point, in the same memory.
    ///
    /// # Errors
    /// Those of [`Variation::new`].
    pub fn operate_at(&mut self, t: f64, q: &[f64], v: &[f64]) -> Result<()> {
        let refined = self.solve(t, q, v).and_then(|()| self.refine_solution());
        let known = refined.and_then(|()| self.load_solution(t, q, v)).map_err(|halt| at_state(t, &halt))?;
        if !known {
            return Err(Error::input(NO_TANGENT).hint(GIVE_THEM));
        }
        self.point = LinearizationPoint::new(&self.dynamics, &self.tangent.k, t, q, v);
        self.point.u = self.input_values();
        if self.point.is_equilibrium {
            // Rounding would give entries of Gdd that no scale tells from small terms.
            self.point.vdot.fill(0.0);
            self.load_point()?;
        }
        if singular::is_suspect(&self.dynamics) {
            let directions = self.free_directions()?;
            singular::refuse(&self.dynamics, &self.point, &directions)?;
        }
        Ok(())
    }

    /// Evaluates and factors at another state; the operating point stays. Returns whether the equations give
    /// derivatives.
    pub fn move_to(&mut self, t: f64, q: &[f64], v: &[f64]) -> Result<bool, StepError> {
        self.solve(t, q, v)?;
        self.load_solution(t, q, v)
    }

    /// Evaluates and factors at a state; solves for v' and lambda.
    fn solve(&mut self, t: f64, q: &[f64], v: &[f64]) -> Result<(), StepError> {
        self.v.copy_from_slice(v);
        self.dynamics.solve(t, q, v, |_, _| 0.0)?;
        self.dynamics.evaluate(t, q, v, Need::L);
        Ok(())
    }

    /// Evaluates K, C and Gdd with the solution; returns true if the equations give them.
    fn load_solution(&mut self, t: f64, q: &[f64], v: &[f64]) -> Result<bool, StepError> {
        let vdot = std::mem::take(&mut self.dynamics.vdot);
        let lambda = std::mem::take(&mut self.dynamics.lambda);
        let known = self.load(OperatingPoint { t, q, v, vdot: &vdot, lambda: &lambda });
        (self.dynamics.vdot, self.dynamics.lambda) = (vdot, lambda);
        known
    }

    /// Solves for v' and lambda to rounding. Near singular states the error of a plain solution would reappear in K and
    /// Gdd, over the fourth power of the rank indicator.
    fn refine_solution(&mut self) -> Result<(), StepError> {
        let Dynamics { kkt, terms, vdot, lambda, .. } = &mut self.dynamics;
        vdot.copy_from_slice(&terms.f);
        lambda.copy_from_slice(&terms.gamma);
        Ok(kkt.solve_refined(&terms.mass, &terms.g, vdot, lambda)?)
    }

    /// Evaluates K, C and Gdd at other v' and lambda of the state that is factored; returns true if the equations give
    /// them.
    pub fn load(&mut self, at: OperatingPoint) -> Result<bool, StepError> {
        let Dynamics { system, scratch, .. } = &mut self.dynamics;
        let known = system.tangent(at, &mut self.tangent, scratch);
        let known = known && system.acceleration_gradient(at, &mut self.gdd, scratch);
        let values = self.tangent.k.iter().chain(&self.tangent.c).chain(&self.gdd);
        if known && !values.into_iter().all(|x| x.is_finite()) {
            return Err(StepError::Term("a derivative of the equations".to_string()));
        }
        Ok(known)
    }

    /// Evaluates K, C and Gdd at the operating point again.
    pub(super) fn load_point(&mut self) -> Result<()> {
        let point = self.point.clone();
        self.load(point.at()).map(|_| ()).map_err(|halt| at_state(point.t, &halt))
    }

    /// Returns the mechanical system.
    pub fn system(&self) -> &'a dyn MechanicalSystem {
        self.dynamics.system
    }

    /// Returns n_v.
    pub fn velocities(&self) -> usize {
        self.dynamics.vdot.len()
    }

    /// Returns -K dq - C dv, a column each.
    #[doc(hidden)]
    pub fn force(&self, changes: &Changes) -> Matrix {
        let (pattern, mut force) =
            (&self.dynamics.structure.tangent, Matrix::zeros(self.velocities(), changes.q.ncols()));
        add_product(pattern, &self.tangent.k, &changes.q, -1.0, &mut force);
        add_product(pattern, &self.tangent.c, &changes.v, -1.0, &mut force);
        force
    }

    /// Returns G x, a column each.
    pub fn g_times(&self, x: &Matrix) -> Matrix {
        self.rows_times(&self.dynamics.terms.g, x)
    }

    /// Returns G dv' for phi'' + c1 phi' + c0 phi = 0, c = [c1, c0], a column each: -(Gdd + c1 Gd + c0 G) dq - (G1 + c1 G) dv.
    #[doc(hidden)]
    pub fn rows(&self, changes: &Changes, c: [f64; 2]) -> Matrix {
        let [c1, c0] = c;
        let Dynamics { structure, terms, .. } = &self.dynamics;
        let mut rows = Matrix::zeros(structure.g.rows, changes.q.ncols());
        let mut add = |values: &[f64], x: &Matrix, factor: f64| add_product(&structure.g, values, x, factor, &mut rows);
        add(&self.gdd, &changes.q, -1.0);
        add(&terms.l, &changes.v, -2.0);
        add(&terms.g, &self.bracket_with(&changes.v), -1.0);
        if c1 != 0.0 {
            add(&terms.l, &changes.q, -c1);
            add(&terms.g, &changes.v, -c1);
        }
        if c0 != 0.0 {
            add(&terms.g, &changes.q, -c0);
        }
        rows
    }

    /// Returns Gd x, a column each.
    pub fn gd_times(&self, x: &Matrix) -> Matrix {
        self.rows_times(&self.dynamics.terms.l, x)
    }

    /// Returns the product of a matrix with the places of G.
    fn rows_times(&self, values: &[f64], x: &Matrix) -> Matrix {
        let pattern = &self.dynamics.structure.g;
        let mut rows = Matrix::zeros(pattern.rows, x.ncols());
        add_product(pattern, values, x, 1.0, &mut rows);
        rows
    }

    /// Returns M x, a column each.
    pub fn mass_times(&self, x: &Matrix) -> Matrix {
        let Dynamics { structure, terms, .. } = &self.dynamics;
        let n = self.velocities().max(1);
        let mut momenta = Matrix::zeros(x.nrows(), x.ncols());
        for (x, momenta) in x.as_slice().chunks_exact(n).zip(momenta.as_mut_slice().chunks_exact_mut(n)) {
            structure.mass.multiply_symmetric(&terms.mass, x, momenta);
        }
        momenta
    }

    /// Returns dM/dt x at the operating point, a column each: by the change of K v with v', K = d(M v' + ..)/dq, where the
    /// equations do not say it.
    pub(super) fn mass_rate_times(&mut self, x: &Matrix) -> Result<Matrix> {
        let mut connection = LeviCivita::new(self.velocities());
        let Variation { dynamics, point, .. } = self;
        if dynamics.system.levi_civita(point.at(), &mut connection, &mut dynamics.scratch) {
            return Ok(connection.mass_dot * x);
        }
        let point = self.point.clone();
        let moving = point.v.len() - point.states;
        let along = Matrix::from_fn(point.v.len(), 1, |i, _| if i < moving { point.v[i] } else { 0.0 });
        let force = |variation: &Self| {
            let mut force = Matrix::zeros(along.nrows(), 1);
            add_product(&variation.dynamics.structure.tangent, &variation.tangent.k, &along, 1.0, &mut force);
            force
        };
        let here = force(self);
        let mut rates = Matrix::zeros(x.nrows(), x.ncols());
        for (x, mut rate) in x.column_iter().zip(rates.column_iter_mut()) {
            let vdot: Vec<f64> = point.vdot.iter().zip(&x).map(|(vdot, x)| vdot + AMPLIFIED * x).collect();
            self.load(OperatingPoint { vdot: &vdot, ..point.at() }).map_err(|halt| at_state(point.t, &halt))?;
            rate.copy_from(&((force(self) - &here) / AMPLIFIED).column(0));
        }
        self.load_point()?;
        Ok(rates)
    }

    /// Returns [v, x] at the velocity of the state, a column each.
    pub fn bracket_with(&self, x: &Matrix) -> Matrix {
        self.bracket_of(&self.v, x)
    }

    /// Returns [v, x], a column each.
    pub fn bracket_of(&self, v: &[f64], x: &Matrix) -> Matrix {
        let n = self.velocities().max(1);
        let mut turned = Matrix::zeros(x.nrows(), x.ncols());
        for (from, to) in x.as_slice().chunks_exact(n).zip(turned.as_mut_slice().chunks_exact_mut(n)) {
            self.dynamics.system.bracket(v, from, to);
        }
        turned
    }

    /// Applies [`push`](Self::push) to each column.
    pub fn push_all(&mut self, force: &mut Matrix, rows: &mut Matrix) -> Result<(), StepError> {
        let columns = force.column_iter_mut().zip(rows.column_iter_mut());
        for (mut force, mut rows) in columns {
            // Nothing answers to nothing: such as to velocities without damping, at rest.
            if force.iter().chain(rows.iter()).any(|x| *x != 0.0) {
                self.push(force.as_mut_slice(), rows.as_mut_slice())?;
            }
        }
        Ok(())
    }

    /// Solves M dv' + G^T dlambda = f, G dv' = rows in place: (f, rows) -> (dv', dlambda).
    pub fn push(&mut self, force: &mut [f64], rows: &mut [f64]) -> Result<(), StepError> {
        let Dynamics { kkt, terms, .. } = &mut self.dynamics;
        Ok(kkt.solve_refined(&terms.mass, &terms.g, force, rows)?)
    }

    /// Returns the smallest change d in the mass metric with G d = `rows`, for each column.
    pub fn correct(&mut self, rows: &Matrix) -> Result<Matrix> {
        let mut corrections = Matrix::zeros(self.velocities(), rows.ncols());
        let mut rows = rows.clone();
        self.push_all(&mut corrections, &mut rows).map_err(|halt| at_state(self.point.t, &halt))?;
        Ok(corrections)
    }

    /// Returns Z with G Z = 0 and Z^T M Z = I, n_v x k; the last columns are the unit vectors of the states.
    pub(super) fn free_directions(&mut self) -> Result<Matrix> {
        let z = free_directions(&mut self.dynamics).ok_or_else(|| at_state(self.point.t, &StepError::NotFinite))?;
        let correction = self.correct(&self.g_times(&z))?;
        Ok(z - correction)
    }

    /// Returns the names of the inputs and of the outputs.
    pub fn names(&self) -> (Vec<String>, Vec<String>) {
        let names = |columns: Vec<Column>| columns.into_iter().map(|column| column.name).collect();
        (names(self.system().facts().inputs.clone()), names(self.system().facts().outputs.clone()))
    }

    /// Returns the derivatives of the outputs at the operating point.
    ///
    /// # Errors
    /// Equations with outputs but without their derivatives.
    pub fn outputs(&mut self) -> Result<OutputTangent> {
        let system = self.system();
        let n = system.dimensions();
        let mut tangent = OutputTangent::new(self.outputs, n.v, n.lambda, self.excitations.len());
        if system.output_tangent(self.point.at(), &mut tangent, &mut self.dynamics.scratch) {
            Ok(tangent)
        } else {
            Err(Error::input("these equations give no derivatives of their outputs")
                .hint("implement MechanicalSystem::output_tangent, or leave the outputs out"))
        }
    }

    /// Returns M, n_v x n_v.
    pub fn mass(&self) -> Matrix {
        let Dynamics { structure, terms, .. } = &self.dynamics;
        let mut mass = Matrix::zeros(self.velocities(), self.velocities());
        for (&(i, j), value) in structure.mass.entries.iter().zip(&terms.mass) {
            mass[(i, j)] += value;
            if i != j {
                mass[(j, i)] += value;
            }
        }
        mass
    }

    /// Returns K = dr/dq, n_v x n_v.
    pub fn k(&self) -> Matrix {
        self.dynamics.structure.tangent.matrix(&self.tangent.k)
    }

    /// Returns C = dr/dv, n_v x n_v.
    pub fn c(&self) -> Matrix {
        self.dynamics.structure.tangent.matrix(&self.tangent.c)
    }

    /// Returns G, n_c x n_v.
    pub fn g(&self) -> Matrix {
        self.dynamics.structure.g.matrix(&self.dynamics.terms.g)
    }

    /// Returns Gd = d(G v + phi_t)/dq.
    pub fn gd(&self) -> Matrix {
        self.dynamics.structure.g.matrix(&self.dynamics.terms.l)
    }

    /// Returns the rows of G that do not depend on others at the state.
    pub fn independent_rows(&self) -> Vec<usize> {
        let left_out = self.dynamics.kkt.left_out();
        (0..self.point.lambda.len()).filter(|row| !left_out.contains(row)).collect()
    }

    /// Returns the matrix of [v, .] at a velocity.
    pub fn bracket(&self, v: &[f64]) -> Matrix {
        self.bracket_of(v, &Matrix::identity(self.velocities(), self.velocities()))
    }
}

/// Factor of v' by which its part of K, which is linear in it, stands out of the round-off of stiff springs.
const AMPLIFIED: f64 = 1_048_576.0;

/// Computes sum += factor A x.
fn add_product(pattern: &Pattern, values: &[f64], x: &Matrix, factor: f64, sum: &mut Matrix) {
    let rows = pattern.rows.max(1);
    let columns = pattern.cols.max(1);
    for (x, sum) in x.as_slice().chunks_exact(columns).zip(sum.as_mut_slice().chunks_exact_mut(rows)) {
        if x.iter().any(|x| *x != 0.0) {
            let entries = pattern.entries.iter().zip(values).filter(|(_, value)| **value != 0.0);
            entries.for_each(|(&(i, j), value)| sum[i] += factor * value * x[j]);
        }
    }
}

/// Error: there is no linear model at a state.
pub(super) fn at_state(t: f64, halt: &StepError) -> Error {
    let hint = halt.hint().unwrap_or("choose another time, a little before or after");
    Error::input(format!("at t = {} s there is no linear model: {halt}", clock(t))).hint(hint)
}

/// Refuses `copies` dense matrices of all velocities where they would not fit.
///
/// # Errors
/// Bad input, with the alternative.
pub(crate) fn refuse_all_modes(velocities: usize, copies: f64) -> Result<()> {
    let hint = "`holonom linearize --modes N` finds some of the modes by sparse methods";
    refuse_dense("a linear model with all its modes", velocities, velocities, copies).map_err(|error| error.hint(hint))
}
