//! A solver of diffsol with the problem that it borrows.

use super::equations::Equations;
use super::lu::SparseLu;
use crate::formulation::{Statistics, StepError};
use crate::integrator::StepStart;
use diffsol::error::DiffsolError;
use diffsol::ode_solver::OdeSolverStatistics;
use diffsol::ode_solver::state::StateCommon;
use diffsol::{FaerVec, OdeSolverMethod, OdeSolverOptions, OdeSolverProblem, OdeSolverState, Vector, VectorCommon};
use self_cell::self_cell;
use std::marker::PhantomData;

/// A method of diffsol.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Scheme {
    Bdf,
    TrBdf2,
    Esdirk34,
    Tsit45,
}

/// The work of a solver since its start.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Counters {
    pub factorizations: u64,
    pub newton_iterations: u64,
    pub rejected: u64,
}

impl Counters {
    /// Adds the work since another time to `statistics`.
    pub fn add_since(self, before: Counters, statistics: &mut Statistics) {
        statistics.factorizations += self.factorizations - before.factorizations;
        statistics.newton_iterations += self.newton_iterations - before.newton_iterations;
        statistics.rejected += self.rejected - before.rejected;
    }
}

/// What the time loop asks of a solver.
pub trait Steps {
    /// End of the last step, s.
    fn t(&self) -> f64;
    /// Size of the next step, s.
    fn h(&self) -> f64;
    /// Makes a step that does not end after `limit`.
    fn step(&mut self, limit: f64) -> Result<(), DiffsolError>;
    /// Writes y = (q, v, works) within the last step, or at its end.
    fn write(&self, t: f64, y: &mut [f64]) -> Result<(), DiffsolError>;
    /// Continues from the differential variables `from.y` at `from.t`, with steps of size `from.h` at first.
    fn go_on_from(&mut self, from: StepStart);
    fn counters(&self) -> Counters;
}

struct Solver<'p, 's, S>(S, PhantomData<&'p Equations<'s>>);

impl<'p, 's, S: OdeSolverMethod<'p, Equations<'s>>> Steps for Solver<'p, 's, S> {
    fn t(&self) -> f64 {
        self.0.state().t
    }

    fn h(&self) -> f64 {
        self.0.state().h
    }

    fn step(&mut self, limit: f64) -> Result<(), DiffsolError> {
        if self.t() + self.h() > limit {
            self.0.set_stop_time(limit)?;
        }
        self.0.step().map(|_| ())
    }

    fn write(&self, t: f64, y: &mut [f64]) -> Result<(), DiffsolError> {
        let equations = &self.0.problem().eqn;
        let (t, (motion, works)) = (t.min(self.t()), y.split_at_mut(equations.differential()));
        motion.copy_from_slice(&self.0.interpolate(t)?.inner().col_as_slice(0)[..motion.len()]);
        if !works.is_empty() {
            let mut at = equations.works(|_| 0.0);
            self.0.interpolate_out_inplace(t, &mut at)?;
            works.copy_from_slice(at.inner().col_as_slice(0));
        }
        Ok(())
    }

    fn go_on_from(&mut self, from: StepStart) {
        let differential = self.0.problem().eqn.differential();
        let state = self.0.state_mut();
        for (vector, works, values) in [(state.y, state.g, from.y), (state.dy, state.dg, from.slope)] {
            let (motion, others) = values.split_at(differential);
            vector.inner_mut().col_as_slice_mut(0)[..differential].copy_from_slice(motion);
            works.inner_mut().col_as_slice_mut(0).copy_from_slice(others);
        }
        (*state.t, *state.h) = (from.t, from.h);
    }

    fn counters(&self) -> Counters {
        let OdeSolverStatistics {
            number_of_linear_solver_setups: factorizations,
            number_of_nonlinear_solver_iterations: newton_iterations,
            number_of_nonlinear_solver_fails: not_converged,
            number_of_error_test_failures: too_large,
            ..
        } = *self.0.get_statistics();
        let factorizations = factorizations as u64;
        let newton_iterations = newton_iterations as u64;
        let rejected = (not_converged + too_large) as u64;
        Counters { factorizations, newton_iterations, rejected }
    }
}

type Owner<'s> = OdeSolverProblem<Equations<'s>>;
type AnySolver<'p> = Box<dyn Steps + 'p>;

self_cell!(
    /// The problem, and a solver that borrows it.
    struct Pair<'s> {
        owner: Owner<'s>,

        #[not_covariant]
        dependent: AnySolver,
    }
);

/// A solver of diffsol on the equations of a run.
pub struct DiffsolSolver<'s>(Pair<'s>);

/// Newton's iteration ends at this part of the tolerated error: what it leaves of the constraints is drift.
const NEWTON: f64 = 0.01;

/// Steps after which the Jacobian is evaluated again. It is evaluated before where the iteration does not converge.
const JACOBIAN: usize = 10;

/// Tolerance of variables that take no part in the error test.
const UNTESTED: f64 = 1e20;

impl<'s> DiffsolSolver<'s> {
    /// A solver that begins at `from` with x there, and steps of its size at first.
    ///
    /// # Errors
    /// A state that the equations cannot be evaluated at.
    pub fn new(scheme: Scheme, equations: Equations<'s>, from: StepStart, x: &[f64]) -> Result<Self, StepError> {
        let problem = problem(equations, from);
        let begun = Pair::try_new(problem, |problem| begin(scheme, problem, from, x));
        begun.map(DiffsolSolver).map_err(|_| StepError::NotConverged)
    }

    /// The equations.
    pub fn equations(&self) -> &Equations<'s> {
        &self.0.borrow_owner().eqn
    }

    /// Calls `see` with the solver.
    pub fn with<T>(&self, see: impl FnOnce(&dyn Steps) -> T) -> T {
        self.0.with_dependent(|_, solver| see(&**solver))
    }

    /// Calls `change` with the solver.
    pub fn with_mut<T>(&mut self, change: impl FnOnce(&mut dyn Steps) -> T) -> T {
        self.0.with_dependent_mut(|_, solver| change(&mut **solver))
    }

    /// Begins again at another state.
    ///
    /// # Errors
    /// As [`Self::new`].
    pub fn restart(&mut self, scheme: Scheme, from: StepStart, x: &[f64]) -> Result<(), StepError> {
        self.0.with_dependent_mut(|problem, solver| {
            *solver = begin(scheme, problem, from, x).map_err(|_| StepError::NotConverged)?;
            Ok(())
        })
    }
}

/// Tolerances of the norm of diffsol, the root mean square over all variables: those of the time loop's norm, which is
/// over the tested ones.
fn problem<'s>(eqn: Equations<'s>, StepStart { h: h0, tolerance, .. }: StepStart) -> Owner<'s> {
    let len = diffsol::Op::nstates(&eqn);
    let integrate_out = diffsol::OdeEquations::out(&eqn).is_some();
    let motion = tolerance.motion();
    let share = (tolerance.tested(motion) as f64 / len as f64).sqrt();
    let is_tested = |i: usize| i < motion && !tolerance.untested().contains(&i);
    let atol = eqn.vector(|i| if is_tested(i) { share * tolerance.atol } else { UNTESTED });
    OdeSolverProblem {
        eqn,
        rtol: share * tolerance.rtol,
        atol,
        t0: 0.0,
        h0,
        integrate_out,
        sens_rtol: None,
        sens_atol: None,
        out_rtol: None,
        out_atol: None,
        param_rtol: None,
        param_atol: None,
        ic_options: Default::default(),
        ode_options: OdeSolverOptions {
            // A lifetime total, of which long runs have many.
            max_nonlinear_solver_failures: usize::MAX,
            nonlinear_solver_tolerance: NEWTON,
            // The time loop has a limit of its own, relative to the span.
            min_timestep: f64::MIN_POSITIVE,
            update_jacobian_after_steps: JACOBIAN,
            update_rhs_jacobian_after_steps: JACOBIAN,
            ..Default::default()
        },
    }
}

fn begin<'p, 's>(
    scheme: Scheme,
    problem: &'p Owner<'s>,
    from: StepStart,
    x: &[f64],
) -> Result<AnySolver<'p>, DiffsolError> {
    fn boxed<'p, 's: 'p>(solver: impl OdeSolverMethod<'p, Equations<'s>> + 'p) -> AnySolver<'p> {
        Box::new(Solver(solver, PhantomData))
    }
    Ok(match scheme {
        Scheme::Bdf => boxed(problem.bdf_solver::<SparseLu>(state(problem, from, x))?),
        Scheme::Tsit45 => boxed(problem.tsit45_solver(state(problem, from, x))?),
        Scheme::TrBdf2 => boxed(problem.tr_bdf2_solver::<SparseLu>(state(problem, from, x))?),
        Scheme::Esdirk34 => boxed(problem.esdirk34_solver::<SparseLu>(state(problem, from, x))?),
    })
}

fn state<S: OdeSolverState<FaerVec<f64>>>(problem: &Owner, from: StepStart, x: &[f64]) -> S {
    let eqn = &problem.eqn;
    let empty = || FaerVec::from_vec(Vec::new(), Default::default());
    let motion = eqn.differential();
    S::new_from_common(StateCommon {
        y: eqn.vector(|i| x[i]),
        dy: eqn.vector(|i| if i < motion { from.slope[i] } else { 0.0 }),
        g: eqn.works(|i| from.y[motion + i]),
        dg: eqn.works(|i| from.slope[motion + i]),
        s: empty(),
        ds: empty(),
        sg: empty(),
        dsg: empty(),
        t: from.t,
        h: from.h,
    })
}
