//! Implicit integrators of diffsol behind the trait [`Integrator`].
//!
//! To add one: a file like `bdf.rs` that names the solver.

mod equations;
mod kinematics;
mod rows;
mod solver;

use super::{Control, From, Integrator, Problem, Setup, Tolerance};
use crate::error::Result;
use crate::formulation::{self, Dae, StepError};
use crate::math::kkt::Singular;
use crate::math::memory::refuse_dense;
use diffsol::error::OdeSolverError;
use diffsol::{DiffsolError, NalgebraLU, Vector};
use equations::{Equations, Values};
use solver::{Counted, Request, Solver};
pub use solver::{Start, serve, start_state};

/// True for formulations in which lambda follows from accelerations, or q is moved to phi = 0 by multipliers of its
/// own: with phi' = 0 or phi = 0 alone diffsol's steps lose orders.
pub fn solves(formulation: &formulation::Entry) -> bool {
    formulation.default_dae().is_some_and(|dae| dae.holds(2) || dae.mu.is_some())
}

/// Dense solver of the linear systems of Newton's method.
pub type Newton = NalgebraLU<f64>;

/// Properties of a method that the time loop depends on.
#[derive(Clone, Copy)]
pub struct Traits {
    pub order: usize,
    /// True for one-step methods, which continue from a moved state at no cost.
    pub follows: bool,
}

/// Steps of a diffsol solver, which keeps its state between attempts.
struct Implicit<'s> {
    equations: Equations<'s>,
    start: Start<'s>,
    traits: Traits,
    solver: Option<Solver<'s>>,
    /// Times at which the last attempt started and ended.
    began: f64,
    reached: f64,
    /// The state at the end of the last attempt; y' within it.
    y: Vec<f64>,
    slope: Vec<f64>,
    /// True if the solver is beyond that end.
    is_ahead: bool,
    own_step: f64,
    counted: Counted,
    control: Control,
}

/// A method of diffsol on the formulation of `setup`.
pub fn make<'s>(setup: &Setup<'s>, traits: Traits, start: Start<'s>) -> Result<Box<dyn Integrator + 's>> {
    let dae = formulation::dae(setup.formulation)?.unwrap_or(Dae::with(formulation::Row::ACCELERATION));
    let unknowns = rows::unknowns(&dae, setup.system.dimensions(), setup.len());
    refuse_dense(&setup.integrator.name, [unknowns; 2], COPIES).map_err(|error| error.hint(SPARSE))?;
    Ok(Box::new(Implicit {
        equations: Equations::new(rows::FirstOrderRows::new(dae, setup), setup.len()),
        start,
        traits,
        solver: None,
        began: f64::NAN,
        reached: f64::NAN,
        y: vec![0.0; setup.len()],
        slope: vec![0.0; setup.len()],
        is_ahead: false,
        own_step: 0.0,
        counted: Counted::default(),
        // The solver controls its error: this control only passes on the steps.
        control: Control::new(1.0, 0.0, 0.1, f64::INFINITY),
    }))
}

/// Number of matrices: Jacobian, mass matrix, the matrix of Newton's method and its factors, some of them twice.
const COPIES: f64 = 10.0;
const SPARSE: &str = "choose a sparse implicit integrator, such as radau_iia or generalized_alpha";

impl<'s> Implicit<'s> {
    /// A solver at `from` whose first step is at most `h`.
    fn begin(&mut self, tolerance: &Tolerance, from: From, h: f64) -> Result<Solver<'s>, StepError> {
        let eqn = &self.equations;
        let (mut x, mut rate) = (Values::zeros(eqn.len, eqn.context), Values::zeros(eqn.len, eqn.context));
        eqn.with(|rows| rows.start(from, x.inner_mut().as_mut_slice(), rate.inner_mut().as_mut_slice()))?;
        (self.counted, self.is_ahead) = (Counted::default(), false);
        let begun = Solver::new((self.start, eqn.clone()), tolerance, (from.t, h), [x, rate]);
        begun.map_err(|error| self.halt(error))
    }

    /// The solver continued from `from`, or a new one.
    fn resume(&mut self, tolerance: &Tolerance, from: From, h: f64) -> Result<Solver<'s>, StepError> {
        match self.solver.take() {
            Some(solver) if self.reached == from.t && self.y == from.y => Ok(solver),
            Some(mut solver) if self.traits.follows && self.reached == from.t && !self.is_ahead => {
                solver.go_on_from(from.y, from.slope).map_err(|error| self.halt(error))?;
                Ok(solver)
            }
            _ => self.begin(tolerance, from, h),
        }
    }

    /// Takes a step, unless the solver is ahead, and writes the state at its end, or after `h` if that comes first.
    fn advance(&mut self, solver: &mut Solver, (began, h): (f64, f64), to: &mut [f64]) -> Result<(), StepError> {
        let end = began + h;
        if !self.is_ahead {
            // Smaller steps are lost in the rounding of t; without a lower bound diffsol retries without end.
            let least = f64::EPSILON * began.abs().max(1e-3 * h);
            solver.request(Request::Step(least.max(f64::MIN_POSITIVE))).map_err(|error| self.halt(error))?;
            // Errors of evaluations before a successful step do not count.
            self.equations.take_halt();
        }
        let t = solver.t();
        self.is_ahead = t > end;
        self.own_step = if t < end { t - began } else { h };
        if self.own_step <= 0.0 {
            return Err(StepError::TooInaccurate);
        }
        solver
            .request(if self.is_ahead { Request::At(end) } else { Request::State })
            .map_err(|error| self.halt(error))?;
        solver.read(to);
        Ok(())
    }

    /// Writes the work at the end of a step, by Radau's rule of order 3. That of the solver is behind: an iteration of
    /// Newton's method evaluates the powers before it moves the state, and is not continued for their sake.
    fn add_work(
        &mut self,
        solver: &mut Solver,
        problem: &mut Problem,
        from: From,
        to: &mut [f64],
    ) -> Result<(), StepError> {
        let (h, motion) = (self.own_step, self.y.len() - to.len());
        solver.request(Request::At(from.t + 2.0 / 3.0 * h)).map_err(|error| self.halt(error))?;
        solver.read(&mut self.y);
        problem.derivative(from.t + 2.0 / 3.0 * h, &self.y, &mut self.slope)?;
        for (i, to) in (motion..).zip(to) {
            *to = from.y[i] + h * (0.25 * from.slope[i] + 0.75 * self.slope[i]);
        }
        Ok(())
    }

    /// The error of a failed solver.
    fn halt(&self, error: DiffsolError) -> StepError {
        self.equations.take_halt().unwrap_or(match error {
            DiffsolError::OdeSolverError(OdeSolverError::TooManyErrorTestFailures { .. }) => StepError::TooInaccurate,
            DiffsolError::OdeSolverError(
                OdeSolverError::StepSizeTooSmall { .. } | OdeSolverError::TooManyNonlinearSolverFailures { .. },
            ) => StepError::NotConverged,
            _ => StepError::Singular(Singular::NotFactored),
        })
    }

    /// Adds the work since the last call to that of the run.
    fn count(&mut self, solver: &Solver, problem: &mut Problem) {
        let (now, own) = (solver.counted(), self.equations.take_statistics());
        let total = &mut problem.dynamics.statistics;
        total.newton_iterations += (now.iterations - self.counted.iterations) as u64;
        total.rejected += (now.rejected - self.counted.rejected) as u64;
        total.factorizations += (now.factorizations - self.counted.factorizations) as u64 + own.factorizations;
        total.rhs_evaluations += own.rhs_evaluations;
        total.jacobian_evaluations += own.jacobian_evaluations;
        self.counted = now;
    }
}

impl Integrator for Implicit<'_> {
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
        self.solver.as_ref().map(|solver| solver.t() - self.began)
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
    ) -> Result<Option<f64>, StepError> {
        self.equations.with(|rows| rows.follow(&problem.dynamics));
        let mut solver = self.resume(tolerance, from, h)?;
        let result = self.advance(&mut solver, (from.t, h), to);
        self.count(&solver, problem);
        result?;
        (self.began, self.reached) = (from.t, from.t + self.own_step);
        if self.traits.follows {
            self.add_work(&mut solver, problem, from, &mut to[tolerance.motion()..])?;
        }
        self.y.copy_from_slice(to);
        if !self.traits.follows {
            // The time loop normalizes quaternions, which is no reason to restart.
            let (q, _) = problem.split_mut(&mut self.y);
            problem.dynamics.system.normalize(q);
        }
        self.solver = Some(solver);
        Ok(Some(0.0))
    }

    fn prepare(&mut self, _: &mut Problem, _: From, _: f64, _: &[f64], _: &[f64]) -> Result<(), StepError> {
        Ok(())
    }

    fn interpolate(
        &mut self,
        problem: &mut Problem,
        from: From,
        h: f64,
        theta: f64,
        out: &mut [f64],
    ) -> Result<(), StepError> {
        let Some(mut solver) = self.solver.take() else {
            out.fill(f64::NAN);
            return Ok(());
        };
        if self.traits.follows {
            // The solver has a work of its own, of which only the change within the step counts.
            solver.request(Request::At(from.t)).map_err(|error| self.halt(error))?;
            solver.read(&mut self.slope);
        }
        solver.request(Request::At(from.t + theta * h)).map_err(|error| self.halt(error))?;
        solver.read(out);
        if self.traits.follows {
            let (q, v) = problem.split(out);
            let motion = q.len() + v.len();
            (motion..out.len()).for_each(|i| out[i] += from.y[i] - self.slope[i]);
        }
        self.solver = Some(solver);
        Ok(())
    }
}
