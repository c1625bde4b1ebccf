//! The only time loop: steps, step control, projection and output.

mod approach;
mod auto;
mod method;
mod observation;
mod rows;
mod spectrum;
mod step;
mod stiffness;

pub use auto::{Advice, advise};
pub use method::Method;
pub use observation::{Observation, Sink, Span, Stop};
pub use spectrum::{Mode, Spectrum};
pub use stiffness::{Stiffness, stiffness};

use approach::Approach;
use rows::{Rows, observation, project};
use step::is_too_large;

use crate::error::{Error, Failure, Result};
use crate::formulation::{self, Dynamics, Halt, Rows as Constraints, Statistics};
use crate::integrator::{self, From, Integrator, Problem, Setup, Store, Tolerance, first_step};
use crate::projection::{self, Projection};
use crate::system::MechanicalSystem;

/// How a run ended.
#[derive(Clone, Debug, PartialEq)]
pub struct Outcome {
    pub statistics: Statistics,
    pub t: f64,
    /// The last good state.
    pub q: Vec<f64>,
    pub v: Vec<f64>,
    pub failure: Option<Failure>,
}

/// Integrates `system` from (q, v), which should be consistent, over `span`. A run that cannot go on is no error: its
/// outcome says where and why, and the sink holds what came before.
///
/// # Errors
/// Bad input only: an unknown or impossible method, a bad span.
pub fn simulate(
    system: &dyn MechanicalSystem,
    method: &Method,
    span: Span,
    (q, v): (&[f64], &[f64]),
    sink: &mut dyn Sink,
) -> Result<Outcome> {
    method.check()?;
    if !(span.end > span.start && span.output_step > 0.0) {
        return Err(Error::input(format!("nothing to simulate from {} s to {} s", span.start, span.end))
            .hint("the end must come after the start and the output step must be above zero"));
    }
    let store = Store::default();
    let mut run = Run::new((system, &store), method, span, q, v)?;
    let failure = run.integrate(sink).err();
    if failure.is_some() {
        run.last_good_row(sink);
    }
    let (q, v) = run.problem.split(&run.y);
    Ok(Outcome { statistics: run.problem.dynamics.statistics, t: run.t, q: q.to_vec(), v: v.to_vec(), failure })
}

struct Run<'a> {
    problem: Problem<'a>,
    integrator: Box<dyn Integrator + 'a>,
    projection: Option<Box<dyn Projection>>,
    rows: Rows<'a>,
    approach: Approach,
    /// Factorizations up to the last accepted state.
    factored: u64,
    scales: Vec<f64>,
    tolerance: Tolerance,
    fixed: Option<f64>,
    span: Span,
    t: f64,
    y: Vec<f64>,
    slope: Vec<f64>,
    next: Vec<f64>,
    next_slope: Vec<f64>,
    change: Vec<f64>,
    /// Whether the projection, or another end of a step, moved the last state.
    is_moved: bool,
    phi_ddot: Vec<f64>,
    /// Velocities that follow from phi = 0 alone are of lower order and not tested.
    tests_velocities: bool,
    /// Why the last step was refused.
    refusal: &'static str,
}

const SINGULAR: &str = "the motion comes to a singular state, where this tolerance is too near to round-off: try a looser \
     one, or a fixed --step with `rk4`, which goes over it";

const NO_BRANCH: &str = "the start is a singular state, with velocities that no motion through it has: constraints \
     that depend on each other there ask for different accelerations";
const BRANCHES: &str = "give velocities along one of the motions that meet there, or start beside it";

/// What round-off may leave of accelerations of constraints, and of their lengths.
const ROUND_OFF: f64 = 1e-6;

/// Joints that are open by so many times the scene's size will not close again.
const MOST_OPEN: f64 = 10.0;

impl<'a> Run<'a> {
    fn new<'s: 'a>(
        (system, store): (&'s dyn MechanicalSystem, &'a Store<'s>),
        method: &'a Method,
        span: Span,
        q: &[f64],
        v: &[f64],
    ) -> Result<Self> {
        let problem = || -> Result<Problem<'a>> {
            Ok(Problem::new(Dynamics::new(system), formulation::make(&method.formulation, system)?))
        };
        let y = [q, v, &[0.0]].concat();
        let zeros = || vec![0.0; y.len()];
        let entry = integrator::find(&method.integrator)?;
        Ok(Run {
            problem: problem()?,
            integrator: (entry.make)(&Setup {
                integrator: &method.integrator,
                formulation: &method.formulation,
                system,
                store,
                is_fixed: method.step.is_some(),
            })?,
            projection: projection::make(&method.projection, system)?,
            rows: Rows::new(problem()?, projection::make(&method.projection, system)?),
            approach: Approach::default(),
            factored: 0,
            scales: system.scales(),
            tolerance: Tolerance { rtol: method.rtol, atol: method.atol },
            fixed: method.step,
            span,
            t: span.start,
            slope: zeros(),
            next: zeros(),
            next_slope: zeros(),
            change: zeros(),
            is_moved: false,
            phi_ddot: vec![0.0; system.dimensions().lambda],
            tests_velocities: formulation::rows(&method.formulation) != Some(Constraints::Position),
            refusal: "",
            y,
        })
    }

    fn integrate(&mut self, sink: &mut dyn Sink) -> Result<(), Failure> {
        let (q, v) = self.problem.split(&self.y);
        let (dependent, contradiction) = self.rows.problem.dynamics.dependent_rows(self.t, q, v);
        self.check_start(contradiction)?;
        self.hold(&dependent);
        self.problem.derivative(self.t, &self.y, &mut self.slope).map_err(|halt| self.halted(&halt))?;
        self.observe(sink);
        self.rows.y.copy_from_slice(&self.y);
        self.rows.emit(self.t, sink).map_err(|halt| self.halted(&halt))?;
        self.rows.next = 1;
        let mut h = self.first_step().map_err(|halt| self.halted(&halt))?;
        let mut growing = true;
        while self.t < self.span.end {
            self.ask(sink)?;
            let placed = self.place(h);
            let (mut size, mut last) = self.fit(placed);
            let error = match self.step(&mut size, &mut last) {
                Ok(error) => error,
                Err(halt) if halt.is_final() => return Err(self.halted(&halt)),
                Err(halt) => {
                    h = self.retry(size, None, &halt.to_string(), halt.hint())?;
                    growing = false;
                    continue;
                }
            };
            if error.is_some_and(is_too_large) {
                h = self.retry(size, error, self.refusal, None)?;
                growing = false;
                continue;
            }
            self.output(size, last, sink).map_err(|halt| self.halted(&halt))?;
            self.accept(size, last, sink);
            self.check_joints()?;
            if last && self.span.row(self.rows.next - 1) < self.span.end {
                self.ask(sink)?;
            }
            if let Some(error) = error {
                let proposed = self.integrator.control().accept(size, error, growing);
                // A step cut to hit the end says nothing against the size before it.
                h = if last { h.max(proposed) } else { proposed };
                if self.t < self.span.end && h < self.smallest() {
                    return Err(self.failure(format!("steps have fallen to {h:.1e} s"), None));
                }
            }
            growing = true;
        }
        Ok(())
    }

    /// Ends the run where the sink wants that.
    fn ask(&self, sink: &dyn Sink) -> Result<(), Failure> {
        sink.stops().map_or(Ok(()), |Stop { reason, hint }| Err(Failure { t: self.t, reason, hint }))
    }

    fn first_step(&mut self) -> Result<f64, Halt> {
        match self.fixed {
            Some(step) => Ok(step),
            None => {
                let span = (self.t, self.span.end - self.t);
                let order = self.integrator.order();
                first_step(&mut self.problem, &self.tolerance, span, &self.y, &self.slope, order)
            }
        }
    }

    /// The step of size `h`, if a singular state does not suggest another.
    fn place(&mut self, h: f64) -> f64 {
        if self.fixed.is_some() { h } else { self.approach.place(h, self.integrator.widest_gap()) }
    }

    /// The step cut or stretched a little so that the end is met; and whether it is the last.
    fn fit(&self, h: f64) -> (f64, bool) {
        let left = self.span.end - self.t;
        // A fixed step is met up to rounding, of the step and of the time.
        let stretched = match self.fixed {
            Some(_) => h * (1.0 + 1e-9) + 4.0 * f64::EPSILON * self.span.end.abs(),
            None => 1.01 * h,
        };
        if stretched >= left { (left, true) } else { (h, false) }
    }

    /// Where a step of size `h` ends. Fixed steps are counted, not added up, so that rounding does not gather.
    fn end_of(&self, h: f64, last: bool) -> f64 {
        match self.fixed {
            _ if last => self.span.end,
            Some(h) => self.span.start + (self.problem.dynamics.statistics.steps + 1) as f64 * h,
            None => self.t + h,
        }
    }

    /// Emits the rows within the step from `t` to `t + h`.
    fn output(&mut self, h: f64, last: bool, sink: &mut dyn Sink) -> Result<(), Halt> {
        let end = self.end_of(h, last);
        let slack = 1e-9 * h;
        let mut prepared = false;
        loop {
            let t = self.span.row(self.rows.next);
            if t > end + slack || self.rows.next > 0 && self.span.row(self.rows.next - 1) >= self.span.end {
                return Ok(());
            }
            if t > end - slack {
                self.rows.y.copy_from_slice(&self.next);
            } else {
                if !prepared {
                    self.prepare(h)?;
                    prepared = true;
                }
                let (rows, from) = (&mut self.rows, From { t: self.t, y: &self.y, slope: &self.slope });
                rows.problem.begin_step(self.t, &self.y)?;
                self.integrator.interpolate(&mut rows.problem, from, h, (t - from.t) / h, &mut rows.y)?;
                project(t, &mut rows.y, &mut rows.problem, &mut rows.projection)?;
            }
            self.rows.emit(t, sink)?;
            self.rows.next += 1;
            // A step may have millions of rows; the run ends before the next one.
            if sink.stops().is_some() {
                return Ok(());
            }
        }
    }

    fn prepare(&mut self, h: f64) -> Result<(), Halt> {
        let from = From { t: self.t, y: &self.y, slope: &self.slope };
        // Interpolation stages run on the rows' problem: they do not count.
        self.rows.problem.begin_step(self.t, &self.y)?;
        self.integrator.prepare(&mut self.rows.problem, from, h, &self.next, &self.next_slope)
    }

    fn accept(&mut self, h: f64, last: bool, sink: &mut dyn Sink) {
        self.t = self.end_of(h, last);
        std::mem::swap(&mut self.y, &mut self.next);
        std::mem::swap(&mut self.slope, &mut self.next_slope);
        self.problem.dynamics.statistics.steps += 1;
        self.observe(sink);
    }

    fn observe(&mut self, sink: &mut dyn Sink) {
        let deficient = self.problem.dynamics.is_rank_deficient;
        self.problem.dynamics.statistics.rank_deficient += u64::from(deficient);
        let dynamics = &self.problem.dynamics;
        // Without a new factorization, as in `penalty`, what the last one says is of another state.
        let is_factored = dynamics.statistics.factorizations > self.factored;
        self.factored = dynamics.statistics.factorizations;
        let own = || (is_factored && dynamics.kkt.is_factored()).then(|| dynamics.kkt.smallest_sine());
        let sine = dynamics.sine.or_else(own);
        self.approach.add(self.t, sine.unwrap_or(1.0));
        let usual = self.approach.largest;
        [&mut self.problem, &mut self.rows.problem].into_iter().for_each(|p| p.dynamics.kkt.usual_sine = usual);
        sink.accepted(&observation(self.t, &self.y, &self.problem, sine, &mut self.phi_ddot));
    }

    /// Refuses velocities that no motion has: where rows depend on each other, their accelerations must not contradict.
    /// `contradiction` is theirs, and what is usual for accelerations of constraints there.
    fn check_start(&self, (contradiction, usual): (f64, f64)) -> Result<(), Failure> {
        let scale = self.scales.iter().fold(0.0, |largest: f64, scale| largest.max(*scale));
        let opened = contradiction * (self.span.end - self.span.start).powi(2);
        match contradiction > ROUND_OFF * usual && opened > ROUND_OFF * scale {
            true => Err(self.failure(NO_BRANCH.to_string(), Some(BRANCHES))),
            false => Ok(()),
        }
    }

    /// Ends a motion that is no longer one of this mechanism.
    fn check_joints(&self) -> Result<(), Failure> {
        let rows = self.problem.dynamics.terms.phi.iter().zip(&self.scales);
        let open = rows.fold(0.0, |open: f64, (phi, scale)| open.max(phi.abs() / scale));
        match open > MOST_OPEN {
            true => Err(self.failure(format!("the joints have come apart by {open:.1e} times the scene's size"), None)),
            false => Ok(()),
        }
    }

    /// The step to try after a failed one, or the end of the run where no smaller step makes sense.
    fn retry(&mut self, h: f64, error: Option<f64>, reason: &str, hint: Option<&str>) -> Result<f64, Failure> {
        self.problem.dynamics.statistics.rejected += 1;
        if self.fixed.is_some() {
            return Err(self.failure(format!("{reason} (with the fixed step {h:e} s)"), hint));
        }
        let smaller = match error {
            Some(error) if error.is_finite() => self.integrator.control().reject(h, error),
            _ => 0.25 * h,
        };
        let is_stuck = self.keeps_constraints() && self.approach.is_stuck(h);
        match smaller > self.smallest() && !is_stuck {
            true => Ok(smaller),
            false => {
                let hint = if is_stuck { Some(SINGULAR) } else { hint };
                Err(self.failure(format!("{reason}, down to a step of {h:.1e} s"), hint))
            }
        }
    }

    /// Steps below make no sense.
    fn smallest(&self) -> f64 {
        1e-15 * self.t.abs().max(1e-3 * (self.span.end - self.span.start))
    }

    /// Where a run ends early, its last good state shows how it came to that.
    fn last_good_row(&mut self, sink: &mut dyn Sink) {
        if self.rows.next > 0 && self.span.row(self.rows.next - 1) < self.t {
            // A state that cannot be evaluated is none to show.
            self.rows.y.copy_from_slice(&self.y);
            let _ = self.rows.emit(self.t, sink);
        }
    }

    fn halted(&self, halt: &Halt) -> Failure {
        self.failure(halt.to_string(), halt.hint())
    }

    /// With what usually helps where there is no `hint`.
    fn failure(&self, reason: String, hint: Option<&str>) -> Failure {
        let usual = match self.fixed {
            Some(_) => "try a smaller --step, a projection such as `manifold`, or an adaptive integrator",
            None => "try another tolerance or a projection such as `manifold`; look at the motion just before the end",
        };
        Failure { t: self.t, reason, hint: hint.unwrap_or(usual).to_string() }
    }
}
