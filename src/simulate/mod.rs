//! The only time loop: steps, step control, projection and output.

mod advance;
mod automatic;
mod changes;
mod checkpoint;
mod contest;
mod crowd;
mod ending;
mod engine;
mod events;
mod first_explicit;
mod gaps;
mod held;
mod method;
mod observation;
mod output;
mod passage;
mod plan;
mod roots;
mod rows;
mod segments;
mod spectrum;
mod start;
mod step;
mod stiffness;
mod travel;

pub use crate::math::threads::spread;
#[doc(hidden)]
pub use crate::modes::SpectralMode;
pub(crate) use automatic::known_methods;
pub use automatic::{Leg, Trial, advise};
pub use checkpoint::{Checkpoint, Start};
pub(crate) use engine::{Choice, Engine, run_through};
pub use engine::{End, simulate_automatic, simulate_from};
pub use method::Method;
#[doc(hidden)]
pub use method::{atol_of, check_pair};
pub use observation::{Observation, Sink, Span, Stop};
pub(crate) use segments::Segments;
#[doc(hidden)]
pub use spectrum::Spectrum;
pub use start::refused;
#[doc(hidden)]
pub use stiffness::explicit;
pub use stiffness::{Stiffness, stiffness};

use crowd::Crowd;
use events::Events;
use gaps::Gaps;
use passage::SingularPassage;
use roots::Roots;
use rows::OutputRows;
use travel::Travelled;

use crate::error::{Failure, Result};
use crate::formulation::{self, Dynamics, Statistics};
use crate::initial::Travel;
use crate::integrator::{self, Integrator, IntegratorEntry, Problem, Tolerance};
use crate::method_spec::MethodSpec;
use crate::projection::{self, Projection};
use crate::system::MechanicalSystem;

/// The end of a run.
#[derive(Clone, Debug, PartialEq)]
pub struct Outcome {
    /// Counters of the work.
    pub statistics: Statistics,
    /// Time reached, s.
    pub t: f64,
    /// Coordinates of the last accepted state.
    pub q: Vec<f64>,
    /// Velocities of the last accepted state.
    pub v: Vec<f64>,
    /// The reason why the run ended early; none where it reached the end.
    pub failure: Option<Failure>,
}

/// Integrates `system` from the `start` (q, v), which should be consistent, over `span`. A run that fails is no error: its
/// outcome says where and why, and the sink has what came before.
///
/// # Errors
/// Bad input only: an unknown or impossible method, a bad span.
pub fn simulate(
    system: &dyn MechanicalSystem,
    method: &Method,
    span: Span,
    start: (&[f64], &[f64]),
    sink: &mut dyn Sink,
) -> Result<Outcome> {
    Ok(simulate_from(system, method, span, start.into(), sink)?.0)
}

/// The only time loop: a run from step to step.
pub(crate) struct TimeLoop<'a> {
    problem: Problem<'a>,
    entry: &'static IntegratorEntry,
    integrator: Box<dyn Integrator + 'a>,
    projection: Option<Box<dyn Projection + 'a>>,
    rows: OutputRows<'a>,
    approach: SingularPassage,
    events: Events<'a>,
    gaps: Gaps,
    crowd: Crowd,
    /// The state at the last threshold passage.
    turned_at: Vec<f64>,
    /// Time up to which a fixed step is divided, s.
    divided: f64,
    /// Number of factorizations up to the last accepted state.
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
    /// True if the projection, or another end of a step, moved the last state.
    is_moved: bool,
    phi_ddot: Vec<f64>,
    /// M v
    momentum: Vec<f64>,
    /// Change of the energy balance in the last step tried, J, where it is watched.
    lost: Option<f64>,
    /// False for velocities that follow from phi = 0 alone: they are of lower order and not tested.
    tests_velocities: bool,
    limits_projection: bool,
    is_explicit: bool,
    /// The reason why the last step was refused.
    refusal: &'static str,
    /// The step to try next, and true if it may grow after that.
    h: f64,
    growing: bool,
    /// The step that ends at the threshold which the last one passed, or at a point of a signal.
    cut: Option<f64>,
    /// Time since which the steps tried are counted, and their number.
    progress: (f64, usize),
    /// The travel of its drivers, if there are any.
    travelled: Option<Travelled<'a>>,
    /// Work after which the run pauses, in evaluations: see [`TimeLoop::mark`].
    allowance: f64,
    /// Time at which the run pauses, s: at most the end of the span.
    until: f64,
    /// The last accepted step, until it is [completed](Self::complete).
    last: Option<LastStep>,
    roots: Roots,
}

/// An accepted step of which the dense output may still be read.
#[derive(Clone, Copy)]
pub(crate) struct LastStep {
    start: f64,
    size: f64,
    error: Option<f64>,
    /// True if it was shorter than the step control proposed.
    is_cut: bool,
    changes_form: bool,
}

/// The projection of states on the dense output: that of the method; but where both levels are integrated, these are
/// satisfied at the ends of steps to round-off, and the error of a step is measured along them, so that the dense
/// output needs an exact projection between the ends, most of all where a driver removes the last degree of freedom.
fn within(method: &Method, system: &dyn MechanicalSystem) -> Result<Option<Box<dyn Projection>>> {
    match formulation::dae(&method.formulation)? {
        Some(dae) if dae.holds(0) && dae.holds(1) => projection::make(&MethodSpec::named("exact"), system),
        _ => projection::make(&method.projection, system),
    }
}

/// The parts of a run.
pub(crate) struct RunParts<'a> {
    pub problem: Problem<'a>,
    /// The entry of the integrator.
    pub entry: &'static IntegratorEntry,
    pub integrator: Box<dyn Integrator + 'a>,
    pub projection: Option<Box<dyn Projection + 'a>>,
    /// A second problem and projection for output rows, whose work is counted separately from that of the steps.
    pub rows: (Problem<'a>, Option<Box<dyn Projection + 'a>>),
    pub tests_velocities: bool,
    /// True if a step is refused whose projection moves the state by far more than the tolerance.
    pub limits_projection: bool,
}

impl<'a> TimeLoop<'a> {
    fn new(system: &'a dyn MechanicalSystem, method: &Method, span: Span, y: Vec<f64>) -> Result<Self> {
        let problem = || -> Result<Problem<'a>> {
            Ok(Problem::new(Dynamics::new(system), formulation::make(&method.formulation, system)?))
        };
        let entry = integrator::find(&method.integrator)?;
        let mut of_steps = problem()?;
        // Output rows show reactions; steps need the motion alone.
        of_steps.dynamics.wants_least = false;
        let parts = RunParts {
            problem: of_steps,
            entry,
            integrator: method.make_integrator(system)?,
            projection: projection::make(&method.projection, system)?,
            rows: (problem()?, within(method, system)?),
            tests_velocities: formulation::dae(&method.formulation)?.is_none_or(|dae| dae.velocity_index() == 1),
            limits_projection: true,
        };
        let tolerance = entry.tightening.of_steps(&Tolerance::new(method.rtol, method.atol, system));
        Ok(TimeLoop::of(parts, tolerance, method.step, span, y))
    }

    fn of(parts: RunParts<'a>, tolerance: Tolerance, fixed: Option<f64>, span: Span, y: Vec<f64>) -> Self {
        let zeros = || vec![0.0; y.len()];
        let system = parts.problem.dynamics.system;
        TimeLoop {
            is_explicit: parts.entry.stability.is_some(),
            problem: parts.problem,
            entry: parts.entry,
            integrator: parts.integrator,
            projection: parts.projection,
            rows: OutputRows::new(parts.rows.0, parts.rows.1),
            approach: SingularPassage::default(),
            events: Events::new(system, span.start, span.end),
            gaps: Gaps::new(system),
            crowd: Crowd::default(),
            turned_at: zeros(),
            divided: span.start,
            factored: 0,
            scales: system.facts().scales.clone(),
            tolerance,
            fixed,
            span,
            t: span.start,
            slope: zeros(),
            next: zeros(),
            next_slope: zeros(),
            change: zeros(),
            is_moved: false,
            phi_ddot: vec![0.0; system.dimensions().lambda],
            momentum: vec![0.0; system.dimensions().v],
            lost: None,
            tests_velocities: parts.tests_velocities,
            limits_projection: parts.limits_projection,
            refusal: "",
            h: 0.0,
            growing: true,
            cut: None,
            progress: (span.start, 0),
            travelled: Travel::new(system, span.start, &y[..system.dimensions().q]).map(Travelled::new),
            allowance: f64::INFINITY,
            until: span.end,
            last: None,
            roots: Roots::default(),
            y,
        }
    }

    fn begin(&mut self, sink: &mut dyn Sink) -> Result<(), Failure> {
        self.begin_form()?;
        self.settle();
        self.start_gaps();
        self.check_start()?;
        self.problem.derivative(self.t, &self.y, &mut self.slope).map_err(|halt| self.halted(&halt))?;
        self.observe(self.fixed, sink);
        self.rows.y.copy_from_slice(&self.y);
        self.rows.emit(self.t, sink).map_err(|halt| self.halted(&halt))?;
        self.rows.next = 1;
        self.h = self.first_step().map_err(|halt| self.halted(&halt))?;
        Ok(())
    }

    /// Begins at the present state, which another run has reached and shown, with the rows that it dropped, and no
    /// smaller a step than its last, `h`: a far smaller first one would take many to grow.
    fn go_on(&mut self, dropped: &[usize], h: f64) -> Result<(), Failure> {
        self.progress = (self.t, 0);
        self.divided = self.t;
        self.begin_form()?;
        self.settle();
        self.start_gaps();
        self.drop_rows(dropped);
        self.problem.derivative(self.t, &self.y, &mut self.slope).map_err(|halt| self.halted(&halt))?;
        let first = self.first_step().map_err(|halt| self.halted(&halt))?;
        // A multistep method doubles its first steps, and does not where one of them is refused.
        self.h = if self.entry.begins_anew { first } else { first.max(h) };
        Ok(())
    }

    /// Sets the constants of the formulation for the whole run.
    fn settle(&mut self) {
        let (q, v) = self.problem.split(&self.y);
        self.problem.formulation.settle(self.t, q, v, &mut self.problem.dynamics);
        let settled = self.problem.formulation.settled();
        self.rows.problem.formulation.recall(&settled);
    }

    /// The outcome at the present state.
    fn finish(&mut self, failure: Option<Failure>, sink: &mut dyn Sink) -> Outcome {
        // Steps may have gone a little over the end of a travel.
        if failure.as_ref().is_some_and(|failure| failure.t >= self.t) {
            self.last_good_row(sink);
        }
        let (q, v) = self.problem.split(&self.y);
        Outcome { statistics: self.statistics(), t: self.t, q: q.to_vec(), v: v.to_vec(), failure }
    }
}
