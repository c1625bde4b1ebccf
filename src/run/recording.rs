//! Sinks of a run: its record, its present state by name, the function whose root ends it.

use super::Moment;
use crate::analysis::Recorder;
use crate::error::{Error, Result};
use crate::formulation::StepError;
use crate::simulate::{Engine, Observation, Sink, Stop};
use crate::system::{MechanicalSystem, Scratch};

/// Reads states for the functions of a run.
pub(super) struct StateReader<'a> {
    pub system: &'a dyn MechanicalSystem,
    pub moment: Moment,
    pub scratch: Scratch,
}

impl StateReader<'_> {
    pub fn read(&mut self, state: &Observation) {
        self.moment.read(self.system, state, &mut self.scratch);
    }

    pub fn read_present(&mut self, engine: &mut Engine) -> Result<()> {
        engine.time_loop().see_state(&mut |state| self.read(state)).map_err(unsolved)
    }
}

/// A state at which the equations have no solution.
pub(super) fn unsolved(halt: StepError) -> Error {
    let hint = halt.hint().unwrap_or("look at the state just before");
    Error::input(halt.to_string()).hint(hint)
}

/// All that sees a run.
pub(super) struct Observers<'a> {
    pub recorder: Recorder<'a>,
    pub reader: StateReader<'a>,
    /// A sink of the user.
    pub sink: Box<dyn Sink + 'a>,
}

impl<'a> Observers<'a> {
    pub fn of(system: &'a dyn MechanicalSystem) -> Self {
        let reader = StateReader { system, moment: Moment::of(system), scratch: Scratch::default() };
        Observers { recorder: Recorder::new(system), reader, sink: Box::new(()) }
    }

    /// The sink of a run that may look for a root.
    pub fn looking<'r>(&'r mut self, root: Option<&'r mut dyn FnMut(&Moment) -> f64>) -> Recording<'r, 'a> {
        Recording { observers: self, root }
    }
}

pub(super) struct Recording<'r, 'a> {
    observers: &'r mut Observers<'a>,
    root: Option<&'r mut dyn FnMut(&Moment) -> f64>,
}

impl<'a> Recording<'_, 'a> {
    fn sinks(&mut self) -> [&mut (dyn Sink + 'a); 2] {
        [&mut self.observers.recorder, self.observers.sink.as_mut()]
    }
}

impl Sink for Recording<'_, '_> {
    fn accepted(&mut self, state: &Observation) {
        self.sinks().into_iter().for_each(|sink| sink.accepted(state));
    }

    fn row(&mut self, state: &Observation) {
        self.sinks().into_iter().for_each(|sink| sink.row(state));
    }

    fn watches_events(&self) -> bool {
        self.observers.recorder.watches_events() || self.observers.sink.watches_events()
    }

    fn before_event(&mut self, state: &Observation) {
        self.sinks().into_iter().filter(|sink| sink.watches_events()).for_each(|sink| sink.before_event(state));
    }

    fn after_event(&mut self, state: &Observation) {
        self.sinks().into_iter().filter(|sink| sink.watches_events()).for_each(|sink| sink.after_event(state));
    }

    fn stops(&self) -> Option<Stop> {
        self.observers.recorder.stops().or_else(|| self.observers.sink.stops())
    }

    fn is_done(&self) -> bool {
        self.observers.sink.is_done()
    }

    fn watches_root(&self) -> bool {
        self.root.is_some()
    }

    fn root(&mut self, state: &Observation) -> f64 {
        let Some(root) = &mut self.root else { return 1.0 };
        self.observers.reader.read(state);
        root(&self.observers.reader.moment)
    }
}
