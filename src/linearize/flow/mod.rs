//! A motion together with its small perturbations, linear and full, integrated in the same steps.

mod bundle;
mod field;
mod shape;

pub use bundle::{Bundle, Pulse, Snapshot};

use super::State;
use crate::error::{Error, Failure, Result};
use crate::formulation::{Choice, Dynamics, Halt};
use crate::integrator::{self, From, Integrator, Problem, Setup, Store, Tolerance, first_step};
use crate::system::MechanicalSystem;
use field::Field;
use shape::Shape;

/// Of the motion and of columns of size 1.
const TOLERANCE: Tolerance = Tolerance { rtol: 1e-13, atol: 1e-13 };
/// A run takes no more steps than this.
const MOST_STEPS: usize = 2_000_000;

/// Carries a bundle along its motion and shows it at `times` (increasing, after the start) by dop853 on the equations of
/// index 1 at a tolerance of 1e-13. After each step every state returns to the constraints and every column to their
/// tangent space. Since all take the same steps, differences between members are more accurate than the members.
///
/// `see` returns whether to go on, and may change what is carried (as a chart that is renewed does).
///
/// # Errors
/// A motion that cannot go on, with its last time.
pub fn flow(
    system: &dyn MechanicalSystem,
    bundle: &Bundle,
    times: &[f64],
    mut see: impl FnMut(&mut Snapshot) -> bool,
) -> Result<()> {
    let shape = Shape::of(system, bundle);
    let carrier = shape.carrier();
    let field = Field::new(system, &shape, bundle)?;
    let problem = Problem::new(Dynamics::new(&carrier), Box::new(field));
    let choice = |name: &str| Choice::named(name);
    let (store, integrator, formulation) = (Store::default(), choice("dop853"), choice("index1"));
    let setup =
        Setup { integrator: &integrator, formulation: &formulation, system: &carrier, store: &store, is_fixed: false };
    let method = (integrator::find(&integrator)?.make)(&setup)?;
    let mut run = Run { problem, method, t: bundle.start.t, y: shape.pack(bundle), h: None, steps: 0 };
    for &end in times {
        run.advance(end).map_err(|halt| stopped(run.t, &halt))?;
        let mut snapshot = shape.unpack(run.t, &run.y);
        let goes_on = see(&mut snapshot);
        shape.repack(&snapshot, &mut run.y);
        if !goes_on {
            break;
        }
    }
    Ok(())
}

struct Run<'a> {
    problem: Problem<'a>,
    method: Box<dyn Integrator + 'a>,
    t: f64,
    y: Vec<f64>,
    h: Option<f64>,
    steps: usize,
}

impl Run<'_> {
    fn advance(&mut self, end: f64) -> Result<(), Halt> {
        let (mut slope, mut next) = (vec![0.0; self.y.len()], vec![0.0; self.y.len()]);
        let mut growing = true;
        while self.t < end {
            self.problem.derivative(self.t, &self.y, &mut slope)?;
            let size = self.size(&slope, end)?;
            let h = if 1.01 * size >= end - self.t { end - self.t } else { size };
            let from = From { t: self.t, y: &self.y, slope: &slope };
            let error = self.method.attempt(&mut self.problem, &TOLERANCE, from, h, &mut next);
            let error = error.unwrap_or(None).unwrap_or(f64::INFINITY);
            growing = match error <= 1.0 {
                true => self.accept((h, error, growing), end, &mut next)?,
                false => self.reject(h, error)?,
            };
        }
        Ok(())
    }

    fn size(&mut self, slope: &[f64], end: f64) -> Result<f64, Halt> {
        let order = self.method.order();
        let first =
            |problem: &mut Problem| first_step(problem, &TOLERANCE, (self.t, end - self.t), &self.y, slope, order);
        self.h.map_or_else(|| first(&mut self.problem), Ok)
    }

    fn accept(&mut self, (h, error, growing): (f64, f64, bool), end: f64, next: &mut Vec<f64>) -> Result<bool, Halt> {
        self.steps += 1;
        let is_last = self.t + h >= end || h == end - self.t;
        let proposed = self.method.control().accept(h, error, growing);
        self.h = Some(if is_last { self.h.unwrap_or(proposed).max(proposed) } else { proposed });
        self.t = if is_last { end } else { self.t + h };
        self.problem.end_step(self.t, next)?;
        std::mem::swap(&mut self.y, next);
        if self.steps > MOST_STEPS { Err(TOO_STIFF) } else { Ok(true) }
    }

    fn reject(&mut self, h: f64, error: f64) -> Result<bool, Halt> {
        let smaller = if error.is_finite() { self.method.control().reject(h, error) } else { 0.25 * h };
        self.h = Some(smaller);
        if smaller < 1e-14 * self.t.abs().max(1e-3) { Err(Halt::TooInaccurate) } else { Ok(false) }
    }
}

const TOO_STIFF: Halt = Halt::Unsuitable {
    reason: "the explicit method that carries perturbations needs more than two million steps",
    hint: "choose a shorter time, or a model without its fastest modes",
};

fn stopped(t: f64, halt: &Halt) -> Error {
    let hint = halt.hint().unwrap_or("choose a shorter time").to_string();
    Failure { t, reason: halt.to_string(), hint }.into()
}

impl Bundle {
    /// The motion from a state alone.
    pub fn of(start: &State) -> Self {
        let columns = super::Changes::none(start.v.len());
        Bundle {
            start: start.clone(),
            columns,
            driven: Vec::new(),
            members: Vec::new(),
            pushes: Vec::new(),
            pulse: None,
        }
    }
}
