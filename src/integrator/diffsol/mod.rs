//! BDF, diagonally implicit Runge-Kutta methods and Tsitouras' method by diffsol.
//!
//! diffsol chooses its own steps. [`Integrator::lead`] makes one and tells its size to the time loop, which cuts it at
//! thresholds and rows by the polynomial of the step. Where the equations change their form, the solver begins again.
//!
//! Source: M. Robinson et al., diffsol, <https://github.com/martinjrobins/diffsol>.

mod directions;
mod equations;
mod lu;
mod rows;
mod solver;

use super::{
    Accepted, Control, Dense, Integrator, IntegratorEntry, MakeIntegrator, Problem, Setup, Stability, Step, StepStart,
    Steps, Tightening, refuses, takes,
};
use crate::error;
use crate::formulation::{self, Dae, Dynamics, StepError};
use crate::method_spec::{MethodSpec, OptionDoc};
use crate::system::MechanicalSystem;
use crate::tolerances;
use ::diffsol::Tableau;
use equations::Equations;
use rows::EquationRows;
use solver::{Counters, DiffsolSolver, Scheme};

/// A method of diffsol on the equations of a run.
struct Diffsol<'s> {
    scheme: Scheme,
    system: &'s dyn MechanicalSystem,
    formulation: MethodSpec,
    dae: Option<Dae>,
    frame: Option<DiffsolSolver<'s>>,
    /// Rows that the equations of the frame do not contain.
    dropped: Vec<usize>,
    /// True if the solver begins again at the next step.
    begins: bool,
    /// True if the end of the last step was moved.
    is_moved: bool,
    /// The reason why steps became so small.
    cause: Option<StepError>,
    /// Work of the present solver that is already counted.
    counted: Counters,
    control: Control,
}

/// Error of the steps of diffsol, which refuses larger ones itself and does not tell.
const ACCEPTED: f64 = 0.5;

/// Part of the time that is round-off.
const ROUND_OFF: f64 = 4.0 * f64::EPSILON;

const TOO_LARGE: StepError =
    StepError::Unsuitable { reason: "there is not enough memory for a matrix of this size", hint: formulation::SPARSE };

const NOT_BEGUN: StepError =
    StepError::Unsuitable { reason: "the step has no solver", hint: "this is a mistake in holonom: please report it" };

impl<'s> Diffsol<'s> {
    fn make(scheme: Scheme, order: usize, setup: &Setup<'_, 's>) -> error::Result<Box<dyn Integrator + 's>> {
        let Setup { formulation, system, .. } = *setup;
        let dae = match scheme {
            Scheme::Tsit45 => None,
            _ => Some(setup.dae()?),
        };
        // Bad options of the formulation are refused here.
        formulation::make(formulation, system)?;
        let mut control = Control::new(order as f64 + 1.0, 0.2, 5.0);
        control.order = order;
        Ok(Box::new(Diffsol {
            scheme,
            system,
            formulation: formulation.clone(),
            dae,
            frame: None,
            dropped: Vec::new(),
            begins: true,
            is_moved: false,
            cause: None,
            counted: Counters::default(),
            control,
        }))
    }

    /// The equations of a run at present: with the rows, pieces and constants of its problem.
    fn equations(&self, problem: &Problem) -> Result<Equations<'s>, StepError> {
        let formulation = formulation::make(&self.formulation, self.system).map_err(|_| TOO_LARGE)?;
        let mut own = Problem::new(Dynamics::new(self.system), formulation);
        own.dynamics.drop_rows(&problem.dynamics.dropped);
        own.dynamics.wants_least = false;
        let rows = self.dae.map(|dae| EquationRows::new(dae, &own.dynamics));
        Equations::new(own, rows).ok_or(TOO_LARGE)
    }

    /// Lets the solver begin again, or continue from a state that was moved, where that is needed.
    fn meet(&mut self, problem: &Problem, from: StepStart) -> Result<(), StepError> {
        let lambda = &problem.dynamics.lambda;
        if self.is_moved && self.scheme == Scheme::Bdf {
            self.begins = self.begins || self.frame.is_none() || self.is_apart(from)?;
            self.is_moved = false;
        }
        match &mut self.frame {
            Some(frame) if self.dropped == problem.dynamics.dropped => {
                if self.begins {
                    frame.equations().follow(problem);
                    let x = frame.equations().start(from, lambda);
                    frame.restart(self.scheme, from, &x)?;
                    self.counted = Counters::default();
                } else if self.is_moved {
                    frame.with_mut(|solver| solver.go_on_from(from));
                }
            }
            _ => {
                let equations = self.equations(problem)?;
                equations.follow(problem);
                let x = equations.start(from, lambda);
                self.frame = Some(DiffsolSolver::new(self.scheme, equations, from, &x)?);
                self.dropped.clone_from(&problem.dynamics.dropped);
                self.counted = Counters::default();
            }
        }
        (self.begins, self.is_moved) = (false, false);
        Ok(())
    }

    /// True if a moved state is so far from the polynomial of the steps that BDF must begin again at order 1, as where
    /// coordinates are brought back to unit length again and again.
    fn is_apart(&self, from: StepStart) -> Result<bool, StepError> {
        let mut change = vec![0.0; from.y.len()];
        self.write(from.t, &mut change)?;
        change.iter_mut().zip(from.y).for_each(|(change, y)| *change -= y);
        // Half of the correction that refuses a step: each beginning, at order 1, costs accuracy.
        Ok(from.tolerance.norm(from.y, &change) > 5.0)
    }

    /// Makes steps up to `t`, none of which ends after `from.end`.
    fn advance(&mut self, problem: &mut Problem, from: StepStart, t: f64) -> Result<(), StepError> {
        let frame = self.frame.as_mut().ok_or(NOT_BEGUN)?;
        while frame.with(|solver| solver.t()) < t {
            frame.equations().begin_step(problem, from)?;
            let before = frame.with(|solver| solver.t());
            let stepped = frame.with_mut(|solver| solver.step(from.end));
            let advanced = frame.with(|solver| solver.t()) - before;
            let failure = frame.equations().take_failure();
            self.cause = failure.or(self.cause.take().filter(|_| advanced <= tolerances::SAME * before.abs()));
            frame.equations().count(&mut problem.dynamics.statistics);
            let counters = frame.with(|solver| solver.counters());
            counters.add_since(std::mem::replace(&mut self.counted, counters), &mut problem.dynamics.statistics);
            // Near a state that cannot be evaluated steps become so small that time stands still.
            if stepped.is_err() || advanced <= ROUND_OFF * before.abs() {
                return Err(self.cause.take().unwrap_or(StepError::NotConverged));
            }
        }
        Ok(())
    }

    /// Writes the differential variables at `t`.
    fn write(&self, t: f64, out: &mut [f64]) -> Result<(), StepError> {
        let frame = self.frame.as_ref().ok_or(NOT_BEGUN)?;
        frame.with(|solver| solver.write(t, out)).map_err(|_| StepError::NotConverged)
    }
}

impl Integrator for Diffsol<'_> {
    fn control(&mut self) -> &mut Control {
        &mut self.control
    }

    fn lead(&mut self, problem: &mut Problem, from: StepStart) -> Result<f64, StepError> {
        self.meet(problem, from)?;
        self.advance(problem, from, (from.t + ROUND_OFF * from.t.abs()).next_up())?;
        Ok(self.frame.as_ref().map_or(from.h, |frame| frame.with(|solver| solver.t()) - from.t))
    }

    fn attempt(&mut self, problem: &mut Problem, from: StepStart, to: &mut [f64]) -> Result<Option<f64>, StepError> {
        self.meet(problem, from)?;
        self.advance(problem, from, from.end)?;
        self.write(from.end, to)?;
        Ok(Some(ACCEPTED))
    }

    fn accepted(&mut self, step: &Accepted) -> f64 {
        self.is_moved |= step.is_moved;
        self.frame.as_ref().map_or(step.h, |frame| frame.with(|solver| solver.h()))
    }

    fn restart(&mut self) {
        self.begins = true;
    }

    fn dense(&mut self) -> Option<&mut dyn Dense> {
        Some(self)
    }
}

impl Dense for Diffsol<'_> {
    fn interpolate(&mut self, _: &mut Problem, step: Step, theta: f64, out: &mut [f64]) -> Result<(), StepError> {
        self.write(step.from.t + theta * step.from.h, out)
    }
}

/// A method of diffsol, which chooses its steps.
const fn entry(name: &'static str, about: &'static str, order: usize, make: MakeIntegrator) -> IntegratorEntry {
    IntegratorEntry { steps: Steps::Own, leads: true, ..IntegratorEntry::new(name, about, order, make) }
}

/// Region of an explicit method of diffsol.
fn stability(tableau: &Tableau<f64>) -> Stability {
    let b = tableau.b().as_slice();
    let rows: Vec<Vec<f64>> = (0..b.len()).map(|i| (0..i).map(|j| tableau.a(i, j)).collect()).collect();
    Stability::of(|i| &rows[i], b)
}

/// ```text
/// x_g = x + g h/2 (x' + x'_g),   x_1 = x + h (w x' + w x'_g + g/2 x'_1),   g = 2 - sqrt 2,  w = sqrt 2/4
/// ```
///
/// with x' = F at t, t + g h and t + h. Source: Bank et al., IEEE Trans. CAD 4 (1985) 436-451; error estimate of Hosea,
/// Shampine, Appl. Numer. Math. 20 (1996) 21-37. Order 2 in q, v and lambda, L-stable: infinitely fast oscillations
/// vanish after one step. Two stages a step with one sparse matrix of all variables. For low accuracy in stiff or kinked
/// motions: a digit more costs three times the steps. Projections cost it nothing. It takes no fixed steps, and a
/// continued run agrees within the tolerance only. Cubic Hermite interpolation.
pub const TR_BDF2: IntegratorEntry = IntegratorEntry {
    // Errors of steady rotations were 60 rtol over 30 revolutions with a factor of 0.25.
    tightening: Tightening::new(0.06, 1.5),
    solves: takes::accelerations_or_positions,
    ..entry(
        "tr_bdf2",
        "implicit, L-stable, for stiff motions at two or three digits; by diffsol; chooses its steps",
        2,
        |setup| Diffsol::make(Scheme::TrBdf2, 2, setup),
    )
};

/// ```text
/// x'_i = F(t + c_i h, x + h sum_{j<=i} a_ij x'_j),   a_11 = 0, a_ii = 0.4358...,   x_1 = x + h sum b_j x'_j,  b = a_4
/// ```
///
/// Source: Jorgensen, Kristensen, Thomsen, arXiv:1803.01613 (2018), the error by an embedded method of order 4. Order 3
/// in q, v and lambda, L-stable and stiffly accurate: fast oscillations are damped out, and `ggl` satisfies its
/// constraints at every step to the tolerance of the iteration. Three stages a step with one sparse matrix of all
/// variables. Projections cost it nothing. It takes no fixed steps, and a continued run agrees within the tolerance
/// only. Cubic Hermite interpolation.
pub const ESDIRK34: IntegratorEntry = IntegratorEntry {
    tightening: Tightening::new(0.1, 4.0 / 3.0),
    solves: takes::accelerations_or_positions,
    ..entry(
        "esdirk34",
        "implicit, L-stable, for stiff motions, also those that nothing damps; by diffsol; chooses its steps",
        3,
        |setup| Diffsol::make(Scheme::Esdirk34, 3, setup),
    )
};

/// The explicit method of order 5 with an embedded one of order 4 and seven stages, the last of which is the first of the
/// next step. Source: Tsitouras, Comput. Math. Appl. 62 (2011) 770-775. Order 5 in q, v and lambda; six evaluations a
/// step. It shares no code with the other explicit methods, and so confirms them. It takes no fixed steps.
/// Interpolation of order 4.
pub const TSIT45: IntegratorEntry = IntegratorEntry {
    // As of `dopri5`, which has the same orders.
    tightening: Tightening::new(0.1, 1.0),
    stability: Some(|| stability(&Tableau::tsit45())),
    ..entry(
        "tsit45",
        "explicit, for smooth motions at three to eight digits; by diffsol; chooses its steps",
        5,
        |setup| Diffsol::make(Scheme::Tsit45, 5, setup),
    )
};

/// Numerical differentiation formulas of order 1 to 5, on backward differences of equal steps. Source: Shampine,
/// Reichelt, SIAM J. Sci. Comput. 18 (1997) 1-22. One sparse matrix of all variables, kept for some steps. Orders 3 to 5
/// are not stable for fast undamped oscillations. At equal errors it took 1.7 to 2.7 times the time of `bdf` on chains
/// (`cargo bench --bench implicit`), with which it shares no code: it confirms the other implicit methods. Projections
/// are refused: after one the differences do not fit. It takes no fixed steps, and a continued run agrees within the
/// tolerance only.
pub const DIFFSOL: IntegratorEntry = IntegratorEntry {
    tightening: Tightening::new(0.07, 1.2),
    solves: takes::accelerations_or_positions,
    refuses: refuses::all,
    options: &[OptionDoc { name: "method", about: "bdf, the only one that has no name of its own" }],
    begins_anew: true,
    ..entry(
        "diffsol",
        "bdf of diffsol, implicit, order 1 to 5 by itself, for comparison with others; chooses its steps",
        5,
        |setup| {
            setup.integrator.one_of("method", &["bdf"])?;
            Diffsol::make(Scheme::Bdf, 2, setup)
        },
    )
};
