//! Implicit integrators of diffsol: their steps behind our trait.
//!
//! To add one: a file like `bdf.rs` that names the solver.

mod equations;
mod form;
mod kinematics;
mod rows;
mod store;

use super::{Control, From, Integrator, Problem, Setup, Tolerance};
use crate::error::Result;
use crate::formulation::{self, Dae, Halt};
use crate::math::kkt::Singular;
use crate::math::memory::refuse_dense;
use diffsol::error::OdeSolverError;
use diffsol::ode_solver::state::StateCommon;
use diffsol::{
    DiffsolError, NalgebraLU, OdeSolverConfig, OdeSolverMethod, OdeSolverProblem, OdeSolverState, Vector, VectorCommon,
};
use equations::{Equations, Values};
use form::Form;
pub use store::Store;

/// Where lambda follows from accelerations, or q is moved to phi = 0 by multipliers of its own: with phi' = 0 or phi = 0 alone
/// diffsol's steps lose orders.
pub fn solves(formulation: &formulation::Entry) -> bool {
    formulation.default_dae().is_some_and(|dae| dae.holds(2) || dae.mu.is_some())
}

/// Solves the linear systems of Newton's method, dense.
pub type Newton = NalgebraLU<f64>;

/// Makes a solver that goes on from a state.
pub type Start<'h, 's, S> = fn(
    &'h OdeSolverProblem<Equations<'s>>,
    <S as OdeSolverMethod<'h, Equations<'s>>>::State,
) -> std::result::Result<S, DiffsolError>;

/// What our time loop must know of a method.
#[derive(Clone, Copy)]
pub struct Traits {
    pub order: usize,
    /// Whether steps go on at no cost from a state that was moved: so with one-step methods.
    pub follows: bool,
}

/// Steps of a solver, which keeps its state between attempts.
pub struct Implicit<'h, 's, S: OdeSolverMethod<'h, Equations<'s>>> {
    store: &'h Store<'s>,
    form: Option<Box<dyn Form + 's>>,
    start: Start<'h, 's, S>,
    traits: Traits,
    solver: Option<S>,
    /// Where the last attempt started and ended, and whether the solver is ahead of that.
    began: f64,
    reached: f64,
    /// The state that the last attempt ended with.
    y: Vec<f64>,
    is_ahead: bool,
    own_step: f64,
    counted: Counted,
    control: Control,
}

/// What a solver counts.
#[derive(Clone, Copy, Default)]
struct Counted {
    iterations: usize,
    factorizations: usize,
    rejected: usize,
}

/// A method of diffsol on the formulation of `setup`.
pub fn make<'h, 's, S>(
    setup: &Setup<'h, 's>,
    traits: Traits,
    start: Start<'h, 's, S>,
) -> Result<Box<dyn Integrator + 'h>>
where
    S: OdeSolverMethod<'h, Equations<'s>> + 'h,
{
    let dae = formulation::dae(setup.formulation)?.unwrap_or(Dae::with(formulation::Row::ACCELERATION));
    let unknowns = rows::unknowns(&dae, setup.system.dimensions());
    refuse_dense(&setup.integrator.name, [unknowns; 2], COPIES).map_err(|error| error.hint(SPARSE))?;
    let form: Box<dyn Form + 's> = Box::new(rows::Rows::new(dae, setup));
    Ok(Box::new(Implicit {
        store: setup.store,
        form: Some(form),
        start,
        traits,
        solver: None,
        began: f64::NAN,
        reached: f64::NAN,
        y: vec![0.0; setup.len()],
        is_ahead: false,
        own_step: 0.0,
        counted: Counted::default(),
        // The solver controls its error: what it is offered is all that is left.
        control: Control::new(1.0, 0.0, 0.1, f64::INFINITY),
    }))
}

/// Jacobian, mass matrix, the matrix of Newton's method and its factors, some of them twice.
const COPIES: f64 = 10.0;
const SPARSE: &str = "choose a sparse implicit integrator, such as radau_iia or generalized_alpha";

impl<'h, 's, S: OdeSolverMethod<'h, Equations<'s>>> Implicit<'h, 's, S> {
    /// A solver at `from` whose first step is at most `h`.
    fn begin(&mut self, tolerance: &Tolerance, from: From, h: f64) -> Result<S, Halt> {
        if let Some(form) = self.form.take() {
            self.store.fill(form, self.y.len(), tolerance);
        }
        let problem = self.store.problem().ok_or(Halt::NotConverged)?;
        let (eqn, empty) = (&problem.eqn, || Values::zeros(0, problem.eqn.context));
        let mut y = Values::zeros(eqn.len, eqn.context);
        let mut dy = y.clone();
        let (x, rate) = (y.inner_mut().as_mut_slice(), dy.inner_mut().as_mut_slice());
        eqn.with(|form| form.start(from, x, rate))?;
        let (s, ds, g, dg, sg, dsg) = (empty(), empty(), empty(), empty(), empty(), empty());
        let state = S::State::new_from_common(StateCommon { y, dy, g, dg, s, ds, sg, dsg, t: from.t, h });
        self.counted = Counted::default();
        self.is_ahead = false;
        (self.start)(problem, state).map_err(|error| self.halt(error))
    }

    /// The solver as it goes on from `from`.
    fn resume(&mut self, tolerance: &Tolerance, from: From, h: f64) -> Result<S, Halt> {
        match self.solver.take() {
            Some(solver) if self.reached == from.t && self.y == from.y => Ok(solver),
            Some(mut solver) if self.traits.follows && self.reached == from.t && !self.is_ahead => {
                let state = solver.state_mut();
                state.y.inner_mut().as_mut_slice()[..from.y.len()].copy_from_slice(from.y);
                state.dy.inner_mut().as_mut_slice()[..from.y.len()].copy_from_slice(from.slope);
                Ok(solver)
            }
            _ => self.begin(tolerance, from, h),
        }
    }

    /// Takes a step, unless the solver is ahead, and writes the state at its end, or after `h` if that comes first.
    fn advance(&mut self, solver: &mut S, (began, h): (f64, f64), to: &mut [f64]) -> Result<(), Halt> {
        let end = began + h;
        if !self.is_ahead {
            // Smaller steps are lost in the rounding of t; without a least one diffsol tries for ever.
            let least = f64::EPSILON * began.abs().max(1e-3 * h);
            *solver.config_mut().as_base_mut().minimum_timestep = least.max(f64::MIN_POSITIVE);
            solver.step().map_err(|error| self.halt(error))?;
            // What stopped an evaluation on the way was overcome.
            self.own_halt();
        }
        let t = solver.state().t;
        self.is_ahead = t > end;
        self.own_step = if t < end { t - began } else { h };
        if self.own_step <= 0.0 {
            return Err(Halt::TooInaccurate);
        }
        match self.is_ahead {
            true => at(solver, end, to),
            false => to.copy_from_slice(&solver.state().y.inner().as_slice()[..to.len()]),
        }
        Ok(())
    }

    /// What stopped an evaluation since the last call.
    fn own_halt(&self) -> Option<Halt> {
        self.store.problem().and_then(|problem| problem.eqn.take_halt())
    }

    /// Why the solver gave up.
    fn halt(&self, error: DiffsolError) -> Halt {
        self.own_halt().unwrap_or(match error {
            DiffsolError::OdeSolverError(OdeSolverError::TooManyErrorTestFailures { .. }) => Halt::TooInaccurate,
            DiffsolError::OdeSolverError(
                OdeSolverError::StepSizeTooSmall { .. } | OdeSolverError::TooManyNonlinearSolverFailures { .. },
            ) => Halt::NotConverged,
            _ => Halt::Singular(Singular::NotFactored),
        })
    }

    /// Adds the work since the last call to that of the run.
    fn count(&mut self, solver: &S, problem: &mut Problem) {
        let found = solver.get_statistics();
        let now = Counted {
            iterations: found.number_of_nonlinear_solver_iterations,
            factorizations: found.number_of_linear_solver_setups,
            rejected: found.number_of_error_test_failures
                + found.number_of_linear_solver_setups_from_second_convergence_fail,
        };
        let own = self.store.problem().map(|problem| problem.eqn.take_statistics()).unwrap_or_default();
        let total = &mut problem.dynamics.statistics;
        total.newton_iterations += (now.iterations - self.counted.iterations) as u64;
        total.rejected += (now.rejected - self.counted.rejected) as u64;
        total.factorizations += (now.factorizations - self.counted.factorizations) as u64 + own.factorizations;
        total.rhs_evaluations += own.rhs_evaluations;
        total.jacobian_evaluations += own.jacobian_evaluations;
        self.counted = now;
    }
}

/// The state at a time within the last step; NaN where the solver has none.
fn at<'h, 's: 'h, S: OdeSolverMethod<'h, Equations<'s>>>(solver: &S, t: f64, out: &mut [f64]) {
    match solver.interpolate(t.min(solver.state().t)) {
        Ok(y) => out.copy_from_slice(&y.inner().as_slice()[..out.len()]),
        Err(_) => out.fill(f64::NAN),
    }
}

impl<'h, 's, S: OdeSolverMethod<'h, Equations<'s>>> Integrator for Implicit<'h, 's, S> {
    fn order(&self) -> usize {
        self.traits.order
    }

    fn control(&mut self) -> &mut Control {
        &mut self.control
    }

    fn own_step(&self) -> Option<f64> {
        Some(self.own_step)
    }

    fn seen(&self) -> Option<f64> {
        self.solver.as_ref().map(|solver| solver.state().t - self.began)
    }

    fn restart(&mut self) {
        self.solver = None;
    }

    fn attempt(
        &mut self,
        problem: &mut Problem,
        tolerance: &Tolerance,
        from: From,
        h: f64,
        to: &mut [f64],
    ) -> Result<Option<f64>, Halt> {
        let dynamics = &problem.dynamics;
        match (&mut self.form, self.store.problem()) {
            (Some(form), _) => form.follow(dynamics),
            (None, Some(solved)) => solved.eqn.with(|form| form.follow(dynamics)),
            _ => {}
        }
        let mut solver = self.resume(tolerance, from, h)?;
        let result = self.advance(&mut solver, (from.t, h), to);
        self.count(&solver, problem);
        result?;
        (self.began, self.reached) = (from.t, from.t + self.own_step);
        self.y.copy_from_slice(to);
        if !self.traits.follows {
            // The time loop brings quaternions back to unit length, which is no reason to start anew.
            let (q, _) = problem.split_mut(&mut self.y);
            problem.dynamics.system.normalize(q);
        }
        self.solver = Some(solver);
        Ok(Some(0.0))
    }

    fn prepare(&mut self, _: &mut Problem, _: From, _: f64, _: &[f64], _: &[f64]) -> Result<(), Halt> {
        Ok(())
    }

    fn interpolate(&mut self, _: &mut Problem, from: From, h: f64, theta: f64, out: &mut [f64]) -> Result<(), Halt> {
        match &self.solver {
            Some(solver) => at(solver, from.t + theta * h, out),
            None => out.fill(f64::NAN),
        }
        Ok(())
    }
}
