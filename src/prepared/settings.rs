//! Settings of a scene, and what the command line gives in their place.

use crate::error::{Error, Result, Warning, clock, short};
use crate::integrator::{self, Steps};
use crate::math::expression::{Number, Parameters};
use crate::method_spec::{MethodSpec, OwnMethods};
use crate::scene::{Automatic, Elements, Simulation};
use crate::simulate::{Method, Span, atol_of};

/// Kinds of elements and methods that a scene may name, and settings that replace those of the scene.
#[derive(Clone, Debug, Default)]
pub struct Overrides {
    /// Kinds of bodies, joints and forces, and own methods, that the scene and these settings may name.
    pub elements: Elements,
    /// Values that replace those of the scene's parameters.
    pub set: Vec<(String, Number)>,
    /// True to start from the static equilibrium that belongs to the scene's start.
    pub equilibrium: bool,
    /// Automatic choice in place of the scene's formulation, integrator, projection and step.
    #[doc(hidden)]
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

/// Settings of the scene, and the overrides that replace them.
pub struct SceneSettings<'a> {
    pub parameters: &'a Parameters,
    pub scene: &'a Simulation,
    /// Own methods that may be named.
    pub own: &'a OwnMethods,
    pub overrides: &'a Overrides,
}

/// A larger number of rows is taken for a mistake.
const MOST_ROWS: f64 = 1e7;

impl SceneSettings<'_> {
    /// The error with the path of the option or key that gave the setting.
    pub fn place(&self, error: Error) -> Error {
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
    pub fn is_automatic(&self) -> Result<bool> {
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
    pub fn method(&self, is_automatic: bool, length: f64) -> Result<Method> {
        let given = self.overrides;
        let default = Method::of_length(length);
        let unnamed =
            Simulation { formulation: None, integrator: None, projection: None, step: None, ..self.scene.clone() };
        let scene = if is_automatic { &unnamed } else { self.scene };
        let pick = |given: &Option<MethodSpec>, scene: &Option<MethodSpec>, default: MethodSpec| {
            given.as_ref().or(scene.as_ref()).map_or(default, |spec| spec.clone().knowing(self.own))
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
    pub fn unused_tolerance(&self, method: &Method) -> Option<Warning> {
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

    pub fn span(&self, start: f64) -> Result<Option<Span>> {
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
        let output_step = given.unwrap_or(Span::from(start..end).output_step);
        if output_step > 0.0 && (end - start) / output_step < MOST_ROWS {
            Ok(Some(Span { start, end, output_step }))
        } else {
            Err(Error::input(format!("the output step is {output_step} s"))
                .under("output_step")
                .hint("give one above zero and above a ten-millionth of the time"))
        }
    }
}
