//! A scene ready to run: its mechanism, a consistent start, and the method of simulation.

mod any_mechanism;
mod doubts;
mod family;
mod far;
mod rest;
mod schema;

pub use any_mechanism::AnyMechanism;
pub use family::Family;
pub use schema::schema;

use doubts::{doubts, explained, of_scene, pulling};
use far::refuse_rounding;
use rest::at_rest;

use crate::error::{Error, Result, Warning, clock, short};
use crate::initial::{self, Assembly};
use crate::integrator::{self, Steps};
use crate::math::array::Each;
use crate::math::expression::{Number, Parameters};
use crate::math::{Rate, Scalar, Thresholds};
use crate::method_spec::MethodSpec;
use crate::scene::{self, Automatic, Elements, Scene, Simulation};
use crate::simulate::{
    Checkpoint, Leg, Method, Outcome, Sink, Span, Start, Stiffness, advise, atol_of, simulate_automatic, simulate_from,
    stiffness,
};
use crate::system::{MechanicalSystem, OperatingPoint, Scratch};
use std::path::Path;

/// Kinds of elements that a scene may name, and settings that replace those of the scene.
#[derive(Clone, Debug, Default)]
pub struct Overrides {
    /// Kinds of bodies, joints and forces that the scene may name.
    pub elements: Elements,
    /// Values that replace those of the scene's parameters.
    pub set: Vec<(String, Number)>,
    /// True to start from the static equilibrium that belongs to the scene's start.
    pub equilibrium: bool,
    /// Automatic choice in place of the scene's formulation, integrator, projection and step.
    pub method: Option<Automatic>,
    /// Formulation in place of the scene's.
    pub formulation: Option<MethodSpec>,
    /// Integrator in place of the scene's.
    pub integrator: Option<MethodSpec>,
    /// Projection in place of the scene's.
    pub projection: Option<MethodSpec>,
    /// Relative tolerance in place of the scene's.
    pub rtol: Option<f64>,
    /// Absolute tolerance in place of the scene's.
    pub atol: Option<f64>,
    /// Fixed step in place of the scene's, s; zero for steps that the integrator chooses.
    pub step: Option<f64>,
    /// End of the simulation in place of the scene's `t_end`, s.
    pub until: Option<f64>,
    /// Interval of the trajectory's rows in place of the scene's, s.
    pub output_step: Option<f64>,
}

/// A scene ready to run.
pub struct PreparedScene {
    /// Name of the scene.
    pub name: String,
    /// Free text about the mechanism; empty if not given.
    pub about: String,
    /// Sources of its data and known results.
    pub references: Vec<String>,
    /// Values of the named parameters, overrides applied.
    pub parameters: Parameters,
    /// The equations of motion.
    pub mechanism: AnyMechanism,
    /// Formulation, integrator, projection, tolerances and step.
    pub method: Method,
    /// True if methods are chosen automatically, with the tolerances of `method`.
    pub is_automatic: bool,
    /// Reason for the method, if it was chosen by [`PreparedScene::settled`].
    pub chosen_because: Option<String>,
    /// Consistent start, with what assembly found about it.
    pub assembly: Assembly,
    /// Warnings about the scene and its start.
    pub doubts: Vec<Warning>,
    /// Hash of what the scene says of the mechanism.
    pub fingerprint: String,
    /// Path, from the scene, of the reference table that accuracy is measured against.
    pub reference: Option<String>,
    start_time: f64,
    /// `None` if no end time is given.
    span: Option<Span>,
}

/// Outcome of a run, the methods used if they were chosen automatically, and a checkpoint to continue from.
pub type Simulated = (Outcome, Vec<Leg>, Option<Checkpoint>);

impl PreparedScene {
    /// Reads a scene, assembles it and resolves its settings.
    ///
    /// # Errors
    /// Bad input of any kind: see [`Scene::load`], [`initial::assemble`], [`Method::check`].
    pub fn load(path: &Path, overrides: &Overrides) -> Result<PreparedScene> {
        let text = scene::read_text(path)?;
        let prepared = overrides.elements.parse_in(scene::folder(Some(path)), &text, &overrides.set);
        let prepared = prepared.and_then(|scene| PreparedScene::new(scene, overrides));
        prepared.map_err(|error| scene::place(error, path, &text))
    }

    /// Assembles a scene and resolves its settings; `elements` and `set` of the overrides are not used.
    ///
    /// # Errors
    /// Bad input of any kind: see [`initial::assemble`], [`Method::check`].
    pub fn new(scene: Scene, overrides: &Overrides) -> Result<PreparedScene> {
        let settings = Settings { parameters: &scene.parameters, scene: &scene.simulation, overrides };
        let is_automatic = settings.is_automatic().map_err(|error| settings.place(error))?;
        let start = scene.start_time()?;
        let span = settings.span(start).map_err(|error| settings.place(error))?;
        let mechanism = AnyMechanism::new(scene.model);
        let length = mechanism.system().length();
        let method = settings.method(is_automatic, length).map_err(|error| settings.place(error))?;
        method.check_options(mechanism.system()).map_err(|error| settings.place(error))?;
        let held = AnyMechanism::held(scene.held);
        let has_joint_start = held[0].is_some();
        let held = held.each_ref().each(|held| held.as_ref().map(AnyMechanism::system));
        let assembly = initial::assemble_held(mechanism.system(), held, start, (&scene.q, &scene.v), &scene.hold);
        let mut assembly = assembly.map_err(|error| explained(error, of_scene(&mechanism)))?;
        check_switches(mechanism.system(), start, (&assembly.q, &assembly.v))?;
        let mut doubts = doubts(&mechanism, &scene.q, &assembly, has_joint_start);
        doubts.extend(settings.unused_tolerance(&method));
        if overrides.equilibrium {
            let (rest, warnings) = at_rest(mechanism.system(), start, &assembly)?;
            assembly = rest;
            doubts.extend(warnings);
        }
        doubts.extend(pulling(mechanism.system(), start, (&assembly.q, &assembly.v)));
        Ok(PreparedScene {
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
            reference: scene.simulation.reference,
            start_time: start,
            span,
        })
    }

    /// The equations of motion as the solvers see them.
    pub fn system(&self) -> &dyn MechanicalSystem {
        self.mechanism.system()
    }

    /// Replaces automatic choice by one method, the one chosen for the beginning of the motion.
    ///
    /// # Errors
    /// Bad input only: see [`advise`].
    pub fn settled(mut self) -> Result<PreparedScene> {
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
    pub fn simulate(&self, method: &Method, span: Span, sink: &mut dyn Sink) -> Result<(Outcome, Vec<Leg>)> {
        let (q, v) = self.start();
        self.simulate_from(method, span, Start::State(q, v), sink).map(|(outcome, legs, _)| (outcome, legs))
    }

    /// Simulates from another consistent state, or from a checkpoint, whose method continues with automatic choice.
    /// Returns a checkpoint to continue from, too.
    ///
    /// # Errors
    /// Bad input only: see [`simulate_from`]; a tolerance below the rounding of positions far from the origin.
    pub fn simulate_from(&self, method: &Method, span: Span, start: Start, sink: &mut dyn Sink) -> Result<Simulated> {
        refuse_rounding(&self.mechanism, self.start().0, method)?;
        match start {
            Start::State(q, v) if self.is_automatic => {
                simulate_automatic(self.system(), (method.rtol, method.atol), span, (q, v), sink)
            }
            Start::Saved(saved) if self.is_automatic => {
                let (outcome, next) = simulate_from(self.system(), saved.method(), span, start, sink)?;
                let leg = Leg::going_on(saved.t(), saved.method(), outcome.statistics);
                Ok((outcome, vec![leg], next))
            }
            _ => {
                let (outcome, saved) = simulate_from(self.system(), method, span, start, sink)?;
                Ok((outcome, Vec::new(), saved))
            }
        }
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
fn check_switches(system: &dyn MechanicalSystem, t: f64, (q, v): (&[f64], &[f64])) -> Result<()> {
    let vdot = vec![0.0; v.len()];
    let count = system.switches().len();
    if count == 0 {
        return Ok(());
    }
    let [zeros, ones] = [0.0, 1.0].map(|x| {
        let mut out = vec![Rate::constant(x); count];
        system.switching(OperatingPoint { t, q, v, vdot: &vdot, lambda: &[] }, &mut out, &mut Scratch::default());
        out
    });
    let is_read = |switch: usize| system.switches()[switch].thresholds != Thresholds::Held;
    let is_unwritten = |switch: &usize| zeros[*switch].value() == 0.0 && ones[*switch].value() == 1.0;
    match (0..count).find(|switch| is_read(*switch) && is_unwritten(switch)) {
        None => Ok(()),
        Some(switch) => Err(Error::input(format!(
            "the type of {} has a switching function whose argument it never writes",
            system.owner_of_switch(switch)
        ))
        .hint("this is a mistake in the code of the type: its kernel has to implement `switching`")),
    }
}

/// Settings of the scene, and the overrides that replace them.
struct Settings<'a> {
    parameters: &'a Parameters,
    scene: &'a Simulation,
    overrides: &'a Overrides,
}

/// Number of rows of a trajectory by default.
const ROWS: f64 = 500.0;
/// A larger number of rows is taken for a mistake.
const MOST_ROWS: f64 = 1e7;

impl Settings<'_> {
    /// The error with the path of the option or key that gave the setting.
    fn place(&self, error: Error) -> Error {
        let Error::Input(mut input) = error else { return error };
        let given = self.overrides;
        let (option, is_given) = match input.path.as_str() {
            "method" => ("--method", given.method.is_some()),
            "formulation" => ("--formulation", given.formulation.is_some()),
            "integrator" => ("--integrator", given.integrator.is_some()),
            "projection" => ("--projection", given.projection.is_some()),
            "rtol" => ("--rtol", given.rtol.is_some()),
            "atol" => ("--atol", given.atol.is_some()),
            "step" => ("--step", given.step.is_some()),
            "t_end" => ("--until", given.until.is_some()),
            "output_step" => ("--output-step", given.output_step.is_some()),
            _ => return Error::Input(input),
        };
        input.path = if is_given { option.to_string() } else { format!("simulation.{}", input.path) };
        Error::Input(input)
    }

    fn number(&self, field: &str, number: &Option<Number>) -> Result<Option<f64>> {
        let Some(number) = number else { return Ok(None) };
        let value = number.evaluate(self.parameters);
        value.map(Some).map_err(|error| Error::from(error).under(field).under("simulation"))
    }

    /// True for automatic choice of methods; the command line has precedence over the scene.
    fn is_automatic(&self) -> Result<bool> {
        let scene = self.scene;
        let given = self.overrides;
        let named = |choices: [&Option<MethodSpec>; 3], has_step: bool| {
            let names = ["formulation", "integrator", "projection"].into_iter().zip(choices);
            let found = names.filter(|(_, spec)| spec.is_some()).map(|(name, _)| name).next();
            found.or(has_step.then_some("step"))
        };
        let in_scene = named([&scene.formulation, &scene.integrator, &scene.projection], scene.step.is_some());
        let has_step = given.step.is_some_and(|step| step > 0.0);
        let on_line = named([&given.formulation, &given.integrator, &given.projection], has_step);
        let beside = if given.method.is_some() { on_line } else { in_scene };
        match (given.method.or(scene.method), beside) {
            (Some(Automatic::Auto), Some(name)) => {
                Err(Error::input(format!("`auto` chooses the {name}, which is also given"))
                    .under("method")
                    .hint(format!("leave out {name} or method")))
            }
            (method, _) => Ok(given.method.is_some() || method.is_some() && on_line.is_none()),
        }
    }

    /// The method, with default tolerances for a scene of this `length`, m.
    fn method(&self, is_automatic: bool, length: f64) -> Result<Method> {
        let own = self.scene;
        let given = self.overrides;
        let default = Method::of_length(length);
        let unnamed = Simulation { formulation: None, integrator: None, projection: None, step: None, ..own.clone() };
        let scene = if is_automatic { &unnamed } else { own };
        let pick = |given: &Option<MethodSpec>, scene: &Option<MethodSpec>, default: MethodSpec| {
            given.clone().or_else(|| scene.clone()).unwrap_or(default)
        };
        let integrator = pick(&given.integrator, &scene.integrator, default.integrator);
        // A scene's fixed step goes with the scene's integrator.
        let steps = integrator::find(&integrator).map_err(|error| error.under("integrator"))?.steps;
        let own_step =
            if given.integrator.is_some() && steps != Steps::Fixed { None } else { self.number("step", &scene.step)? };
        let own_rtol = self.number("rtol", &scene.rtol)?.unwrap_or(default.rtol);
        let own_atol = self.number("atol", &scene.atol)?.unwrap_or(default.atol);
        // A looser rtol loosens atol in proportion, since the tighter one would govern.
        let (rtol, atol) =
            given.rtol.map_or((own_rtol, own_atol), |rtol| (rtol, own_atol.max(atol_of(rtol, own_atol / own_rtol))));
        let method = Method {
            formulation: pick(&given.formulation, &scene.formulation, default.formulation),
            integrator,
            projection: pick(&given.projection, &scene.projection, default.projection),
            rtol,
            atol: given.atol.unwrap_or(atol),
            step: given.step.or(own_step).filter(|step| given.step.is_none() || *step != 0.0),
        };
        method.check()?;
        Ok(method)
    }

    /// Warning about a tolerance on the command line where the scene fixes the step.
    fn unused_tolerance(&self, method: &Method) -> Option<Warning> {
        let given = self.overrides;
        let option = [("--rtol", given.rtol), ("--atol", given.atol)].into_iter().find(|(_, value)| value.is_some())?.0;
        let step = short(method.step?);
        let is_fixed = integrator::find(&method.integrator).is_ok_and(|entry| entry.steps == Steps::Fixed);
        let hint = if is_fixed {
            "choose an integrator with an error estimate, such as --integrator dop853"
        } else {
            "give --adaptive, by which the integrator chooses its steps"
        };
        Some(Warning::new(format!("{option} has no effect: the step is fixed, {step} s"), hint))
    }

    fn span(&self, start: f64) -> Result<Option<Span>> {
        let scene = self.scene;
        let Some(end) = self.overrides.until.or(self.number("t_end", &scene.t_end)?) else { return Ok(None) };
        if !(end > start && end.is_finite()) {
            return Err(Error::input(format!(
                "the end time {} s is not after the start, {} s",
                clock(end),
                clock(start)
            ))
            .under("t_end")
            .hint("give a later end: --until T, or \"t_end\" in \"simulation\" of the scene"));
        }
        let given = self.overrides.output_step.or(self.number("output_step", &scene.output_step)?);
        let output_step = given.unwrap_or((end - start) / ROWS);
        if output_step > 0.0 && (end - start) / output_step < MOST_ROWS {
            Ok(Some(Span { start, end, output_step }))
        } else {
            Err(Error::input(format!("the output step is {output_step} s"))
                .under("output_step")
                .hint("give one above zero and above a ten-millionth of the time"))
        }
    }
}
