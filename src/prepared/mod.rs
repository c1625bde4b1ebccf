//! A scene ready to run: its mechanism, a consistent start, and the method of simulation.

mod any_mechanism;
mod doubts;
mod equations;
mod family;
mod far;
mod rest;
mod schema;
mod settings;

pub use any_mechanism::AnyMechanism;
pub(crate) use any_mechanism::in_either;
pub use family::{Family, linspace};
pub use schema::schema;
pub use settings::Overrides;

use doubts::{doubts, explained, of_scene, pulling};
use far::refuse_rounding;
use rest::at_rest;
use settings::SceneSettings;

use crate::error::{Error, Result, Warning};
use crate::initial::{self, Assembly};
use crate::math::array::Each;
use crate::math::expression::Parameters;
use crate::math::{Rate, Scalar, Thresholds};
use crate::method_spec::OwnMethods;
use crate::scene::Scene;
use crate::simulate::{
    Checkpoint, Choice, Leg, Method, Outcome, Sink, Span, Start, Stiffness, advise, run_through, stiffness,
};
use crate::system::{MechanicalSystem, OperatingPoint, Scratch};
use std::path::Path;

/// A scene made ready: its mechanism, a consistent start and the method of its runs.
///
/// ```
/// use holonom::prelude::*;
///
/// let model = Model::load("models/pendulum.json")?.set("l", 2.0)?;
/// let mut run = model.run();
/// run.to(1.0)?;
/// assert!(run.record().drift.position.max < 1e-12);
/// # Ok::<(), holonom::Error>(())
/// ```
pub struct Model {
    /// Name of the scene.
    pub name: String,
    /// Free text about the mechanism; empty if not given.
    pub about: String,
    /// Sources of its data and known results.
    pub references: Vec<String>,
    /// Values of the named parameters, overrides applied.
    pub parameters: Parameters,
    /// The equations of motion.
    #[doc(hidden)]
    pub mechanism: AnyMechanism,
    /// Formulation, integrator, projection, tolerances and step.
    pub method: Method,
    /// True if methods are chosen automatically, with the tolerances of `method`.
    pub is_automatic: bool,
    /// Reason for the method, if it was chosen by [`Model::settled`].
    pub chosen_because: Option<String>,
    /// Consistent start, with what assembly found about it.
    pub assembly: Assembly,
    /// Warnings about the scene and its start.
    pub doubts: Vec<Warning>,
    /// Hash of what the scene says of the mechanism.
    pub fingerprint: String,
    /// Own methods that may be named.
    pub(crate) own_methods: OwnMethods,
    /// Path, from the scene, of the reference table that accuracy is measured against.
    pub reference: Option<String>,
    start_time: f64,
    /// `None` if no end time is given.
    span: Option<Span>,
    /// What it was read from, if that is known.
    family: Option<Family>,
}

/// Outcome of a run, the methods used if they were chosen automatically, and a checkpoint to continue from.
pub type RunResult = (Outcome, Vec<Leg>, Option<Checkpoint>);

impl Model {
    /// Reads a scene, assembles it and resolves its settings.
    ///
    /// # Errors
    /// Bad input of any kind: see [`Scene::load`], `initial::assemble`, [`Method::check`].
    pub fn load(path: impl AsRef<Path>) -> Result<Model> {
        Model::load_with(path.as_ref(), &Overrides::default())
    }

    /// The same with other settings, parameters and kinds of elements.
    ///
    /// # Errors
    /// As [`load`](Self::load).
    pub fn load_with(path: &Path, overrides: &Overrides) -> Result<Model> {
        Family::read(path, overrides)?.model()
    }

    /// Reads a scene from text; files that it names are in the current folder.
    ///
    /// # Errors
    /// As [`load`](Self::load).
    pub fn parse(text: &str) -> Result<Model> {
        Family::of_text(text.to_string(), None, &Overrides::default())?.model()
    }

    /// The model with another value of a parameter, assembled anew; the text is not read again. All else is as it was
    /// read.
    ///
    /// # Errors
    /// No such parameter; a value for which the scene is not valid; a model that was made from a [`Scene`].
    pub fn set(&self, parameter: &str, value: f64) -> Result<Model> {
        let family = self.family.as_ref().ok_or_else(|| {
            Error::input(format!("the model `{}` does not know what it was made from", self.name))
                .hint("make it by `load` or `parse`, or give the parameters where its scene is made")
        })?;
        family.with(parameter, value).model()
    }

    /// Assembles a scene and resolves its settings; `elements` and `set` of the overrides are not used.
    ///
    /// # Errors
    /// Bad input of any kind: see `initial::assemble`, [`Method::check`].
    pub fn new(scene: Scene, overrides: &Overrides) -> Result<Model> {
        let settings =
            SceneSettings { parameters: &scene.parameters, scene: &scene.simulation, own: &scene.methods, overrides };
        let is_automatic = settings.is_automatic().map_err(|error| settings.place(error))?;
        let start = scene.start_time()?;
        let span = settings.span(start).map_err(|error| settings.place(error))?;
        let mechanism = AnyMechanism::new(scene.model);
        let length = mechanism.system().facts().length;
        let method = settings.method(is_automatic, length).map_err(|error| settings.place(error))?;
        method.check_options(mechanism.system()).map_err(|error| settings.place(error))?;
        let held = AnyMechanism::held(scene.held);
        let has_joint_start = held[0].is_some();
        let held = held.each_ref().each(|held| held.as_ref().map(AnyMechanism::system));
        let assembly = initial::assemble_held(mechanism.system(), held, start, (&scene.q, &scene.v), &scene.hold);
        let mut assembly = assembly.map_err(|error| explained(error, of_scene(&mechanism)))?;
        check_switches(mechanism.system(), start, &assembly.q, &assembly.v)?;
        let mut doubts = doubts(&mechanism, &scene.q, &assembly, has_joint_start);
        doubts.extend(settings.unused_tolerance(&method));
        if overrides.equilibrium {
            let (rest, warnings) = at_rest(mechanism.system(), start, &assembly)?;
            assembly = rest;
            doubts.extend(warnings);
        }
        doubts.extend(pulling(mechanism.system(), start, &assembly.q, &assembly.v));
        Ok(Model {
            doubts,
            name: scene.name,
            about: scene.about,
            references: scene.references,
            parameters: scene.parameters,
            mechanism,
            method,
            is_automatic,
            chosen_because: None,
            assembly,
            fingerprint: scene.fingerprint,
            own_methods: scene.methods,
            reference: scene.simulation.reference,
            start_time: start,
            span,
            family: None,
        })
    }

    /// The equations of motion as the solvers see them.
    pub fn system(&self) -> &dyn MechanicalSystem {
        self.mechanism.system()
    }

    /// Replaces automatic choice by one method, the one chosen for the beginning of the motion.
    ///
    /// # Errors
    /// Bad input only: see `advise`.
    pub fn settled(mut self) -> Result<Model> {
        if std::mem::take(&mut self.is_automatic) {
            // Without an end time, a method is chosen for one second of motion.
            let start = self.start_time;
            let span = self.span.unwrap_or(Span { start, end: start + 1.0, output_step: 1.0 });
            let (method, because) = advise(self.system(), (self.method.rtol, self.method.atol), span, self.start())?;
            (self.method, self.chosen_because) = (method, Some(because));
        }
        Ok(self)
    }

    /// Start, end and output interval of the simulation, s.
    ///
    /// # Errors
    /// No end time in the scene or on the command line.
    pub fn span(&self) -> Result<Span> {
        self.span.ok_or_else(|| {
            Error::input(format!("the scene `{}` has no end time", self.name))
                .hint("give --until T, or \"t_end\" in \"simulation\" of the scene")
        })
    }

    /// Stiffness that makes the method unsuitable for this motion, if it is explicit and was not chosen automatically.
    #[doc(hidden)]
    pub fn stiffness(&self, span: Span) -> Option<Stiffness> {
        let Assembly { q, v, vdot, lambda, .. } = &self.assembly;
        let state = OperatingPoint { t: span.start, q, v, vdot, lambda };
        (!self.is_automatic).then(|| stiffness(self.system(), &self.method, state, span))?
    }

    /// Simulates by `method` or, with automatic choice, by the methods that get farthest with its tolerances.
    /// Returns these in their order; none if the method is named.
    ///
    /// # Errors
    /// Bad input only: see [`simulate`](crate::simulate::simulate).
    #[doc(hidden)]
    pub fn simulate(&self, method: &Method, span: Span, sink: &mut dyn Sink) -> Result<(Outcome, Vec<Leg>)> {
        let (q, v) = self.start();
        self.simulate_from(method, span, Start::State(q, v), sink).map(|(outcome, legs, _)| (outcome, legs))
    }

    /// Simulates from another consistent state, or from a checkpoint, whose method continues with automatic choice.
    /// Returns a checkpoint to continue from, too.
    ///
    /// # Errors
    /// Bad input only: see [`simulate_from`](crate::simulate::simulate_from); a tolerance below the rounding of positions far from the origin.
    #[doc(hidden)]
    pub fn simulate_from(&self, method: &Method, span: Span, start: Start, sink: &mut dyn Sink) -> Result<RunResult> {
        refuse_rounding(&self.mechanism, self.start().0, method)?;
        let (outcome, legs, next) = run_through(self.system(), &self.choice(method), span, start, sink)?;
        match start {
            Start::Saved(saved) if self.is_automatic => {
                let leg = Leg::going_on(saved.t(), saved.method(), outcome.statistics);
                Ok((outcome, vec![leg], next))
            }
            _ => Ok((outcome, legs, next)),
        }
    }

    /// The methods of a run with the tolerances of `method`.
    pub(crate) fn choice(&self, method: &Method) -> Choice {
        if self.is_automatic {
            Choice::Automatic(method.rtol, method.atol)
        } else {
            Choice::One(Box::new(method.clone()))
        }
    }

    /// Refuses tolerances below the rounding of positions far from the origin.
    pub(crate) fn check_rounding(&self) -> Result<()> {
        refuse_rounding(&self.mechanism, self.start().0, &self.method)
    }

    /// Time at the start of the motion, s.
    pub fn start_time(&self) -> f64 {
        self.start_time
    }

    /// The consistent start (q, v).
    pub fn start(&self) -> (&[f64], &[f64]) {
        (&self.assembly.q, &self.assembly.v)
    }
}

/// Refuses an element with a switching function whose argument it never writes: its law would never switch.
fn check_switches(system: &dyn MechanicalSystem, t: f64, q: &[f64], v: &[f64]) -> Result<()> {
    let vdot = vec![0.0; v.len()];
    let count = system.switches().all.len();
    if count == 0 {
        return Ok(());
    }
    let written_over = |x: f64| {
        let mut arguments = vec![Rate::constant(x); count];
        let at = OperatingPoint { t, q, v, vdot: &vdot, lambda: &[] };
        system.switching(at, &mut arguments, &mut Scratch::default());
        arguments
    };
    let zeros = written_over(0.0);
    let ones = written_over(1.0);
    let is_read = |switch: usize| system.switches().all[switch].thresholds != Thresholds::Held;
    let is_unwritten = |switch: &usize| zeros[*switch].value() == 0.0 && ones[*switch].value() == 1.0;
    match (0..count).find(|switch| is_read(*switch) && is_unwritten(switch)) {
        None => Ok(()),
        Some(switch) => Err(Error::input(format!(
            "the type of {} has a switching function whose argument it never writes",
            system.switches().owner(switch)
        ))
        .hint("this is a mistake in the code of the type: its kernel has to implement `switching`")),
    }
}
