//! A run that pauses and goes on, by one method or by automatic choice.

use super::automatic::Drive;
use super::checkpoint::flat;
use super::{Checkpoint, Leg, Method, Outcome, Sink, Span, Start, TimeLoop};
use crate::error::{Failure, Result};
use crate::formulation::Statistics;
use crate::system::MechanicalSystem;

/// How a run, or a part of it, ended.
#[derive(Clone, Debug, PartialEq)]
pub enum End {
    /// At the time that was asked for.
    Reached,
    /// The sink had what it wanted.
    Stopped,
    /// A function of the state changed its sign at this time, s.
    Event(f64),
    /// The run cannot go on; its last good state is kept.
    Failed(Failure),
}

/// The methods of a run.
#[derive(Clone, Debug)]
pub(crate) enum Choice {
    One(Box<Method>),
    /// Chosen while it runs, with these rtol and atol.
    Automatic(f64, f64),
}

pub(crate) enum Engine<'a> {
    One(Box<TimeLoop<'a>>, Box<Method>),
    Automatic(Box<Drive<'a>>),
}

impl<'a> Engine<'a> {
    /// A run over `span`, or the rest of it. A saved run goes on with its method.
    pub fn new(system: &'a dyn MechanicalSystem, choice: &Choice, span: Span, start: Start) -> Result<Self> {
        span.check()?;
        let y = match start {
            Start::State(q, v) => flat(system, span.start, (q, v))?,
            Start::Saved(saved) => saved.checked(system, span)?.y.clone(),
        };
        let one = |method: &Method| {
            method.check()?;
            Ok(Engine::One(Box::new(TimeLoop::new(system, method, span, y.clone())?), Box::new(method.clone())))
        };
        match (choice, start) {
            (Choice::One(method), _) => one(method),
            (Choice::Automatic(..), Start::Saved(saved)) => one(saved.method()),
            (&Choice::Automatic(rtol, atol), Start::State(..)) => {
                Ok(Engine::Automatic(Box::new(Drive::chosen(system, (rtol, atol), span, y)?)))
            }
        }
    }

    /// Shows the start, or the state at which a saved run goes on.
    pub fn begin(&mut self, start: Start, sink: &mut dyn Sink) -> Result<(), Failure> {
        match (start, self) {
            (Start::Saved(saved), Engine::One(run, method)) => run.go_on_from(saved, method, sink),
            (_, engine) => engine.time_loop().begin(sink),
        }
    }

    pub fn time_loop(&mut self) -> &mut TimeLoop<'a> {
        match self {
            Engine::One(run, _) => run,
            Engine::Automatic(drive) => &mut drive.run,
        }
    }

    fn present(&self) -> &TimeLoop<'a> {
        match self {
            Engine::One(run, _) => run,
            Engine::Automatic(drive) => &drive.run,
        }
    }

    /// The time that is reached, s.
    pub fn t(&self) -> f64 {
        self.present().t
    }

    pub fn statistics(&self) -> Statistics {
        match self {
            Engine::One(run, _) => run.statistics(),
            Engine::Automatic(drive) => drive.statistics(),
        }
    }

    /// Runs until `until`, a root of the sink, or its stop.
    ///
    /// # Errors
    /// Bad input, found where another method begins.
    pub fn advance(&mut self, until: f64, sink: &mut dyn Sink) -> Result<End> {
        self.time_loop().until = until;
        let failure = match self {
            Engine::One(run, _) => run.advance(sink).err(),
            Engine::Automatic(drive) => drive.go(sink, |_, _, _| false)?,
        };
        Ok(self.ended(failure, sink))
    }

    /// Takes one accepted step, which ends at `until` at the latest.
    pub fn step(&mut self, until: f64, sink: &mut dyn Sink) -> End {
        let run = self.time_loop();
        run.until = until;
        run.forget_root();
        let failure = run.step_once(sink).err();
        self.ended(failure, sink)
    }

    fn ended(&mut self, failure: Option<Failure>, sink: &dyn Sink) -> End {
        let run = self.time_loop();
        match (failure, run.roots.passed) {
            (Some(failure), _) => End::Failed(failure),
            (None, Some(t)) => End::Event(t),
            (None, None) if run.t < run.until && sink.is_done() => End::Stopped,
            (None, None) => End::Reached,
        }
    }

    /// Moves the end of the span to a later time.
    pub fn extend(&mut self, end: f64) {
        if let Engine::Automatic(drive) = self {
            drive.span.end = end;
        }
        self.time_loop().extend(end);
    }

    /// A checkpoint at the present state, whose last step is then completed.
    pub fn save(&mut self, sink: &mut dyn Sink) -> Result<Checkpoint, Failure> {
        self.time_loop().complete(sink)?;
        Ok(self.checkpoint())
    }

    pub fn checkpoint(&self) -> Checkpoint {
        match self {
            Engine::One(run, method) => run.checkpoint(method),
            Engine::Automatic(drive) => drive.run.checkpoint(drive.method()),
        }
    }

    /// The outcome at the present state, and the methods of an automatic choice in their order.
    pub fn finish(self, failure: Option<Failure>, sink: &mut dyn Sink) -> (Outcome, Vec<Leg>) {
        match self {
            Engine::One(mut run, _) => (run.finish(failure, sink), Vec::new()),
            Engine::Automatic(drive) => drive.finish(failure, sink),
        }
    }
}

/// Runs from the start to the end of the span.
pub(crate) fn run_through(
    system: &dyn MechanicalSystem,
    choice: &Choice,
    span: Span,
    start: Start,
    sink: &mut dyn Sink,
) -> Result<(Outcome, Vec<Leg>, Option<Checkpoint>)> {
    let mut engine = Engine::new(system, choice, span, start)?;
    let (failure, saved) = match engine.begin(start, sink) {
        Err(failure) => (Some(failure), None),
        Ok(()) => {
            let failure = match engine.advance(span.end, sink)? {
                End::Failed(failure) => Some(failure),
                _ => engine.time_loop().complete(sink).err(),
            };
            (failure, Some(engine.checkpoint()))
        }
    };
    let (outcome, legs) = engine.finish(failure, sink);
    Ok((outcome, legs, saved))
}

/// Integrates `system` over `span`, or the rest of it. A run that fails is no error: its outcome says where
/// and why, and the sink has what came before. Returns a checkpoint, too; none if the run could not begin.
///
/// # Errors
/// Bad input only: an unknown or impossible method, a bad span, a saved run of another system or beyond the span.
pub fn simulate_from(
    system: &dyn MechanicalSystem,
    method: &Method,
    span: Span,
    start: Start,
    sink: &mut dyn Sink,
) -> Result<(Outcome, Option<Checkpoint>)> {
    let (outcome, _, saved) = run_through(system, &Choice::One(Box::new(method.clone())), span, start, sink)?;
    Ok((outcome, saved))
}

/// Integrates `system` from (q, v), which should be consistent, over `span`, with these `tolerances`: begins with an
/// explicit method, and changes the method where another is faster. Returns the methods in their order, and a
/// checkpoint from which a run of the last one can be continued.
///
/// # Errors
/// Bad input only, as in [`simulate`](super::simulate).
pub fn simulate_automatic(
    system: &dyn MechanicalSystem,
    tolerances: (f64, f64),
    span: Span,
    start: (&[f64], &[f64]),
    sink: &mut dyn Sink,
) -> Result<(Outcome, Vec<Leg>, Option<Checkpoint>)> {
    let (rtol, atol) = tolerances;
    run_through(system, &Choice::Automatic(rtol, atol), span, Start::State(start.0, start.1), sink)
}
