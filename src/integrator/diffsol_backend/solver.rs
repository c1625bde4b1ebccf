//! A diffsol solver together with the problem that it borrows.

use super::super::Tolerance;
use super::equations::{Equations, Values};
use crate::tolerances::integrator as tolerances;
use diffsol::ode_solver::state::StateCommon;
use diffsol::{
    DiffsolError, OdeSolverConfig, OdeSolverMethod, OdeSolverOptions, OdeSolverProblem, OdeSolverState, Vector,
    VectorCommon,
};
use std::cell::RefCell;
use std::future::{Future, poll_fn};
use std::pin::Pin;
use std::rc::Rc;
use std::task::{Context, Poll, Waker};

/// Starts a solver on a problem and calls [`serve`].
pub type Start<'s> = fn(OdeSolverProblem<Equations<'s>>, SharedExchange) -> Task<'s>;

/// The future that owns a solver and the problem it borrows, which safe code allows nowhere else: polled once a
/// request.
pub type Task<'s> = Pin<Box<dyn Future<Output = ()> + 's>>;

/// Place of requests and answers.
pub type SharedExchange = Rc<RefCell<Exchange>>;

/// A running solver that answers requests.
pub struct Solver<'s> {
    task: Task<'s>,
    exchange: SharedExchange,
}

/// A request and its answer.
pub struct Exchange {
    request: Request,
    result: Result<(), DiffsolError>,
    /// Time of the solver's state, after every request; and the step that a start is to try.
    t: f64,
    h: f64,
    /// On entry the unknowns and rates to start or continue from; on return those requested.
    x: Values,
    rate: Values,
    counted: Counted,
}

#[derive(Clone, Copy)]
pub enum Request {
    /// Returns the present state.
    State,
    /// Continues from this number of first unknowns of the exchange and their rates; the others stay.
    Move(usize),
    /// Takes a step of at least this size.
    Step(f64),
    /// Returns x at a time within the last step; NaN where the solver has none.
    At(f64),
}

/// The counters of a solver.
#[derive(Clone, Copy, Default)]
pub struct Counted {
    pub iterations: usize,
    pub factorizations: usize,
    pub rejected: usize,
}

impl<'s> Solver<'s> {
    /// A solver at (t, x) with x' = `rate`, whose first step is at most `h`.
    pub fn new(
        (start, equations): (Start<'s>, Equations<'s>),
        tolerance: &Tolerance,
        (t, h): (f64, f64),
        [x, rate]: [Values; 2],
    ) -> Result<Self, DiffsolError> {
        let slip = Exchange { request: Request::State, result: Ok(()), t, h, x, rate, counted: Counted::default() };
        let exchange = Rc::new(RefCell::new(slip));
        let mut solver = Solver { task: start(problem_of(equations, tolerance), exchange.clone()), exchange };
        solver.request(Request::State)?;
        Ok(solver)
    }

    pub fn request(&mut self, request: Request) -> Result<(), DiffsolError> {
        self.exchange.borrow_mut().request = request;
        // A solver that failed to start has ended, and is not kept.
        let _ = self.task.as_mut().poll(&mut Context::from_waker(Waker::noop()));
        std::mem::replace(&mut self.exchange.borrow_mut().result, Ok(()))
    }

    /// Continues from another state and its rate.
    pub fn go_on_from(&mut self, y: &[f64], slope: &[f64]) -> Result<(), DiffsolError> {
        {
            let Exchange { x, rate, .. } = &mut *self.exchange.borrow_mut();
            x.inner_mut().as_mut_slice()[..y.len()].copy_from_slice(y);
            rate.inner_mut().as_mut_slice()[..y.len()].copy_from_slice(slope);
        }
        self.request(Request::Move(y.len()))
    }

    pub fn t(&self) -> f64 {
        self.exchange.borrow().t
    }

    /// Writes the first unknowns of the last answer.
    pub fn read(&self, out: &mut [f64]) {
        out.copy_from_slice(&self.exchange.borrow().x.inner().as_slice()[..out.len()]);
    }

    pub fn counted(&self) -> Counted {
        self.exchange.borrow().counted
    }
}

impl Exchange {
    fn answer<'p, 's: 'p, S: OdeSolverMethod<'p, Equations<'s>>>(&mut self, solver: &mut S) {
        match self.request {
            Request::State => {}
            Request::Move(n) => {
                let state = solver.state_mut();
                for (to, from) in [(state.y, &self.x), (state.dy, &self.rate)] {
                    to.inner_mut().as_mut_slice()[..n].copy_from_slice(&from.inner().as_slice()[..n]);
                }
            }
            Request::Step(least) => {
                *solver.config_mut().as_base_mut().minimum_timestep = least;
                self.result = solver.step().map(|_| ());
            }
            Request::At(t) => {
                match solver.interpolate(t.min(solver.state().t)) {
                    Ok(x) => self.x = x,
                    Err(_) => self.x.fill(f64::NAN),
                }
                return;
            }
        }
        let state = solver.state();
        self.t = state.t;
        self.x.copy_from(state.y);
        self.rate.copy_from(state.dy);
        let found = solver.get_statistics();
        self.counted = Counted {
            iterations: found.number_of_nonlinear_solver_iterations,
            factorizations: found.number_of_linear_solver_setups,
            rejected: found.number_of_error_test_failures
                + found.number_of_linear_solver_setups_from_second_convergence_fail,
        };
    }
}

/// The state to start from.
pub fn start_state<S: OdeSolverState<Values>>(exchange: &SharedExchange) -> S {
    let Exchange { t, h, x, rate, .. } = &*exchange.borrow();
    let empty = || Values::zeros(0, *x.context());
    let (s, ds, g, dg, sg, dsg) = (empty(), empty(), empty(), empty(), empty(), empty());
    S::new_from_common(StateCommon { y: x.clone(), dy: rate.clone(), g, dg, s, ds, sg, dsg, t: *t, h: *h })
}

/// Answers one request at each poll.
pub async fn serve<'p, 's: 'p, S: OdeSolverMethod<'p, Equations<'s>>>(
    solver: Result<S, DiffsolError>,
    exchange: &SharedExchange,
) {
    match solver {
        Ok(mut solver) => loop {
            exchange.borrow_mut().answer(&mut solver);
            let mut is_polled = false;
            poll_fn(|_| if std::mem::replace(&mut is_polled, true) { Poll::Ready(()) } else { Poll::Pending }).await;
        },
        Err(error) => exchange.borrow_mut().result = Err(error),
    }
}

/// Equations and tolerances for diffsol. Its limit of Newton failures counts those of the whole run; if Newton's method
/// stopped at a fifth of the tolerance, its default, the residual would appear in lambda and as drift.
fn problem_of<'s>(eqn: Equations<'s>, tolerance: &Tolerance) -> OdeSolverProblem<Equations<'s>> {
    // diffsol averages over all unknowns, our norm over the tested ones.
    let tested = (tolerance.tested(tolerance.motion()) as f64 / eqn.len as f64).sqrt();
    let mut atol = Values::from_element(eqn.len, tolerances::NOT_TESTED, eqn.context);
    let places = atol.inner_mut().as_mut_slice();
    places[..tolerance.motion()].fill(tested * tolerance.atol);
    places[tolerance.untested()].fill(tolerances::NOT_TESTED);
    OdeSolverProblem {
        eqn,
        rtol: tested * tolerance.rtol,
        atol,
        t0: 0.0,
        h0: 0.0,
        integrate_out: false,
        sens_rtol: None,
        sens_atol: None,
        out_rtol: None,
        out_atol: None,
        param_rtol: None,
        param_atol: None,
        ic_options: Default::default(),
        ode_options: OdeSolverOptions {
            max_nonlinear_solver_failures: usize::MAX,
            nonlinear_solver_tolerance: 0.01,
            update_jacobian_after_steps: 10,
            update_rhs_jacobian_after_steps: 10,
            ..OdeSolverOptions::default()
        },
    }
}
