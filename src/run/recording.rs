//! Sinks of a run: its record, its present state by name, the function whose root ends it.

use super::Moment;
use crate::analysis::Recorder;
use crate::error::{Error, Result};
use crate::formulation::StepError;
use crate::simulate::{Engine, Observation, Sink, Stop};
use crate::system::{MechanicalSystem, Scratch};

/// Reads states for the functions of a run.
pub(super) struct Reader<'a> {
    pub system: &'a dyn MechanicalSystem,
    pub moment: Moment,
    pub scratch: Scratch,
}

impl Reader<'_> {
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

/// Records a run that may look for a root.
pub(super) struct Recording<'r, 'a> {
    pub recorder: &'r mut Recorder<'a>,
    pub reader: &'r mut Reader<'a>,
    pub root: Option<&'r mut dyn FnMut(&Moment) -> f64>,
}

impl<'r, 'a> Recording<'r, 'a> {
    pub fn of(recorder: &'r mut Recorder<'a>, reader: &'r mut Reader<'a>) -> Self {
        Recording { recorder, reader, root: None }
    }
}

impl Sink for Recording<'_, '_> {
    fn accepted(&mut self, state: &Observation) {
        self.recorder.accepted(state);
    }

    fn row(&mut self, state: &Observation) {
        self.recorder.row(state);
    }

    fn watches_events(&self) -> bool {
        self.recorder.watches_events()
    }

    fn before_event(&mut self, state: &Observation) {
        self.recorder.before_event(state);
    }

    fn after_event(&mut self, state: &Observation) {
        self.recorder.after_event(state);
    }

    fn stops(&self) -> Option<Stop> {
        self.recorder.stops()
    }

    fn watches_root(&self) -> bool {
        self.root.is_some()
    }

    fn root(&mut self, state: &Observation) -> f64 {
        let Some(root) = &mut self.root else { return 1.0 };
        self.reader.read(state);
        root(&self.reader.moment)
    }
}
