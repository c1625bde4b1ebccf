//! What a solver borrows while it runs.

use super::super::Tolerance;
use super::equations::{Equations, Values};
use super::form::Form;
use crate::tolerances::integrator as tolerances;
use diffsol::{OdeSolverOptions, OdeSolverProblem, Vector};
use std::cell::OnceCell;

/// The equations of a run with their tolerances, which a solver refers to: a store outlives the integrator.
#[derive(Default)]
pub struct Store<'s>(OnceCell<OdeSolverProblem<Equations<'s>>>);

impl<'s> Store<'s> {
    /// Puts the equations in; those of a second integrator are not taken.
    pub(super) fn fill(&self, form: Box<dyn Form + 's>, rates: usize, tolerance: &Tolerance) {
        let _ = self.0.set(problem_of(form, rates, tolerance));
    }

    pub(super) fn problem(&self) -> Option<&OdeSolverProblem<Equations<'s>>> {
        self.0.get()
    }
}

/// Equations and tolerances for diffsol. Its limit of Newton failures counts those of the whole run; where Newton's
/// method stops at a fifth of the tolerance, which is its default, what is left shows in lambda and as drift.
fn problem_of<'s>(form: Box<dyn Form + 's>, rates: usize, tolerance: &Tolerance) -> OdeSolverProblem<Equations<'s>> {
    let eqn = Equations::new(form, rates);
    // diffsol takes the mean over all unknowns, our norm that over the tested ones.
    let tested = (tolerance.tested(rates - 1) as f64 / eqn.len as f64).sqrt();
    let mut atol = Values::from_element(eqn.len, tolerances::NOT_TESTED, eqn.context);
    let places = atol.inner_mut().as_mut_slice();
    places[..rates - 1].fill(tested * tolerance.atol);
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
