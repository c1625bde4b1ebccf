//! Runs that one can hold: stepped, run to a time or to an event, driven by inputs, saved and read.
//!
//! ```
//! use holonom::prelude::*;
//!
//! let model = Model::parse(r#"{
//!     "name": "fall", "dimension": 2, "gravity": [0, -9.81],
//!     "bodies": [{ "name": "ball", "type": "point_mass", "mass": 1, "initial": { "position": [0, 2] } }],
//!     "outputs": [{ "name": "height", "measure": "position", "of": "ball", "component": "y" }]
//! }"#)?;
//! let mut run = model.run();
//! let End::Event(t) = run.until(|x| x.output("height"), 5.0)? else { panic!("it falls") };
//! assert!((t - (2.0 * 2.0 / 9.81_f64).sqrt()).abs() < 1e-9);
//! assert!(run.record().output("height")?.last().abs() < 1e-9);
//! # Ok::<(), holonom::Error>(())
//! ```

mod inputs;
mod marker;
mod method;
mod moment;
mod recording;
mod settings;
mod simulated;

pub use crate::analysis::Record;
pub use crate::prepared::{Family, Model, Overrides, linspace};
pub use crate::scene::Scene;
pub use crate::simulate::{Checkpoint, End, Observation, Sink};
pub use inputs::{Input, every};
#[doc(hidden)]
pub use marker::MarkerFrame;
pub use moment::Moment;
pub use simulated::{Simulated, simulate};

use crate::error::{Error, Result, clock};
use crate::formulation::Statistics;
use crate::method_spec::OwnMethods;
use crate::simulate::{Choice, Engine, Span, Start, advise};
use crate::system::MechanicalSystem;
use inputs::Inputs;
use recording::{Observers, unsolved};

/// A run: one motion, from its start as far as it was asked to go.
///
/// [`step`](Self::step), [`to`](Self::to) and [`until`](Self::until) say how they ended; where the motion cannot go on
/// they return the failure as an error, and what came before stays readable.
pub struct Run<'a> {
    system: &'a dyn MechanicalSystem,
    choice: Choice,
    /// Own methods that may be named.
    own_methods: OwnMethods,
    start: RunOrigin,
    /// Time of the start of the motion, s.
    began: f64,
    /// The end that is planned, s.
    end: Option<f64>,
    output_step: Option<f64>,
    named: Vec<(String, Input<'a>)>,
    inputs: Inputs<'a>,
    engine: Option<Engine<'a>>,
    /// The reason why it cannot begin.
    refused: Option<Error>,
    observers: Observers<'a>,
}

/// The state at which a run begins.
enum RunOrigin {
    State(Vec<f64>, Vec<f64>),
    Saved(Box<Checkpoint>),
}

impl RunOrigin {
    fn start(&self) -> Start<'_> {
        match self {
            RunOrigin::State(q, v) => Start::State(q, v),
            RunOrigin::Saved(saved) => Start::Saved(saved),
        }
    }
}

impl<'a> Run<'a> {
    /// Takes one step, to the next sample of an input or the planned end at the latest.
    ///
    /// # Errors
    /// Bad input; a run without a planned end; a motion that cannot go on.
    pub fn step(&mut self) -> Result<End> {
        let end = self.end.ok_or_else(|| {
            Error::input("the run has no planned end")
                .hint("give `planned_to`, \"t_end\" in the scene, or run `to` a time")
        })?;
        self.begin(end)?;
        self.sample()?;
        let until = self.inputs.next_sample(self.began).min(end);
        let mut sink = self.observers.looking(None);
        let Some(engine) = &mut self.engine else { return Ok(End::Reached) };
        let end = engine.step(until, &mut sink);
        self.checked(end)
    }

    /// Runs to the time `t`, where a step ends. The record has a row there, too.
    ///
    /// # Errors
    /// Bad input; a motion that cannot go on.
    pub fn to(&mut self, t: f64) -> Result<End> {
        self.advance(t, None)
    }

    /// Runs until a function of the state changes sign, or to `t_end`. The place is located on the dense output, and a
    /// step ends there. A function that is zero at the start has to become positive or negative first.
    ///
    /// The sign is compared at the quarters of each step: a function that is on the other side for less is not seen.
    /// The record has a row where the run ends, too.
    ///
    /// # Errors
    /// Bad input, among it a name in the function that does not exist; a motion that cannot go on.
    pub fn until(&mut self, mut root: impl FnMut(&Moment) -> f64, t_end: f64) -> Result<End> {
        self.advance(t_end, Some(&mut root))
    }

    /// The present state; before the run has begun the start, with all inputs zero.
    ///
    /// # Errors
    /// Bad input; a state at which the equations have no solution.
    pub fn state(&mut self) -> Result<Moment> {
        if let Some(error) = &self.refused {
            return Err(error.clone());
        }
        let span = Span::from(self.began..self.t() + 1.0);
        let reader = &mut self.observers.reader;
        match &mut self.engine {
            Some(engine) => reader.read_present(engine)?,
            None => {
                reader.read_present(&mut Engine::new(self.system, &self.choice, span, self.start.start())?)?;
            }
        }
        Ok(self.observers.reader.moment.clone())
    }

    /// The state at a time within the last step, by the dense output.
    ///
    /// # Errors
    /// A time outside of it.
    pub fn interpolate(&mut self, t: f64) -> Result<Moment> {
        let Run { engine, observers: Observers { reader, .. }, .. } = self;
        let is_known = match engine {
            Some(engine) => engine.time_loop().see_within(t, &mut |state| reader.read(state)).map_err(unsolved)?,
            None => false,
        };
        if is_known {
            return Ok(reader.moment.clone());
        }
        Err(Error::input(format!("t = {} s is not in the last step of the run", clock(t)))
            .hint("interpolate after a step, at a time between its ends"))
    }

    /// The present state with all that the run carries: a run [from there](Self::from_saved) goes on bit by bit as this
    /// one, but for what sampled inputs remember.
    ///
    /// # Errors
    /// A run that has not begun; a motion that cannot go on.
    pub fn save(&mut self) -> Result<Checkpoint> {
        match &mut self.engine {
            Some(engine) => Ok(engine.save(&mut self.observers.looking(None))?),
            None => Err(Error::input("the run has not begun").hint("take a step, or run to a time")),
        }
    }

    /// The time that the run has reached, s.
    pub fn t(&self) -> f64 {
        match (&self.engine, &self.start) {
            (Some(engine), _) => engine.t(),
            (None, RunOrigin::Saved(saved)) => saved.t(),
            (None, RunOrigin::State(..)) => self.began,
        }
    }

    /// Counters of the work so far.
    pub fn statistics(&self) -> Statistics {
        self.engine.as_ref().map_or(Statistics::default(), Engine::statistics)
    }

    /// What was recorded so far: rows, drift, energy.
    pub fn record(&mut self) -> &Record {
        self.observers.recorder.record()
    }

    /// The record of a run that is over, with the singular states on its way.
    pub fn into_record(self) -> Record {
        self.observers.recorder.finish()
    }

    /// Begins the run, planned to `t` at least; or extends it.
    fn begin(&mut self, t: f64) -> Result<()> {
        if let Some(error) = &self.refused {
            return Err(error.clone());
        }
        let planned = self.end.filter(|end| *end >= t).unwrap_or(t);
        match &mut self.engine {
            Some(engine) if self.end.is_some_and(|end| end < planned) => engine.extend(planned),
            Some(_) => {}
            None => match self.begun(planned) {
                Ok(engine) => self.engine = Some(engine),
                Err(error) => {
                    self.refused = Some(error.clone());
                    return Err(error);
                }
            },
        }
        self.end = Some(planned);
        Ok(())
    }

    /// The engine at the start, which is shown.
    fn begun(&mut self, end: f64) -> Result<Engine<'a>> {
        let output_step = self.output_step.unwrap_or(Span::from(self.began..end).output_step);
        let span = Span { start: self.began, end, output_step };
        self.inputs = Inputs::new(self.system, std::mem::take(&mut self.named), &self.observers.reader.moment)?;
        let has_inputs = !self.inputs.is_empty();
        if let (Start::State(q, v), true) = (self.start.start(), has_inputs) {
            self.inputs.check_added(self.system, self.began, q, v)?;
        }
        if let (&Choice::Automatic(rtol, atol), Start::State(q, v), true) =
            (&self.choice, self.start.start(), has_inputs)
        {
            self.choice = Choice::One(Box::new(advise(self.system, (rtol, atol), span, (q, v))?.0));
        }
        let mut engine = Engine::new(self.system, &self.choice, span, self.start.start())?;
        if has_inputs {
            let mut u = self.inputs.zeros();
            engine.time_loop().set_inputs(&u, self.inputs.law.as_ref());
            match &self.start {
                RunOrigin::Saved(saved) => self.inputs.go_on(saved.t(), self.began),
                // The first samples are taken before the first row is shown.
                RunOrigin::State(..) => {
                    let read = self.observers.reader.read_present(&mut engine);
                    self.observers.reader.moment.check_names()?;
                    read?;
                    self.inputs.sample(self.began, self.began, &self.observers.reader.moment, &mut u);
                    engine.time_loop().set_inputs(&u, self.inputs.law.as_ref());
                }
            }
        }
        let begun = engine.begin(self.start.start(), &mut self.observers.looking(None));
        self.observers.reader.moment.check_names()?;
        begun?;
        Ok(engine)
    }

    /// Takes the samples that are due, and holds their values from here on.
    fn sample(&mut self) -> Result<()> {
        let t = self.t();
        if !self.inputs.is_due(t, self.began) {
            return Ok(());
        }
        let Some(engine) = &mut self.engine else { return Ok(()) };
        self.observers.reader.read_present(engine)?;
        let mut u = engine.time_loop().inputs().to_vec();
        self.inputs.sample(t, self.began, &self.observers.reader.moment, &mut u);
        self.observers.reader.moment.check_names()?;
        let mut sink = self.observers.looking(None);
        Ok(engine.time_loop().hold(&u, &mut sink)?)
    }

    fn advance(&mut self, t: f64, mut root: Option<&mut dyn FnMut(&Moment) -> f64>) -> Result<End> {
        if !t.is_finite() || t < self.t() {
            return Err(Error::input(format!("the run is at t = {} s and cannot go to {t} s", clock(self.t())))
                .hint("give a later time"));
        }
        self.begin(t)?;
        if let Some(engine) = &mut self.engine {
            engine.time_loop().forget_root();
        }
        loop {
            self.sample()?;
            let until = self.inputs.next_sample(self.began).min(t);
            let root = root.as_mut().map(|root| &mut **root as &mut dyn FnMut(&Moment) -> f64);
            let mut sink = self.observers.looking(root);
            let Some(engine) = &mut self.engine else { return Ok(End::Reached) };
            let end = engine.advance(until, &mut sink)?;
            if end != End::Reached || until >= t {
                engine.time_loop().show_row(&mut sink);
                return self.checked(end);
            }
        }
    }

    /// The end, or the error for which it came early.
    fn checked(&self, end: End) -> Result<End> {
        self.observers.reader.moment.check_names()?;
        match end {
            End::Failed(failure) => Err(failure.into()),
            end => Ok(end),
        }
    }
}
