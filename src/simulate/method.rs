//! The method of a run.

use crate::error::{Error, Result, Warning, short};
use crate::formulation;
use crate::integrator::{self, Integrator, Setup, Steps, Tolerance};
use crate::math::array::Each;
use crate::method_spec::{MethodSpec, OwnMethods};
use crate::projection;
use crate::system::{Dimensions, MechanicalSystem};
use serde::{Deserialize, Serialize};
use std::str::FromStr;

/// Velocities from which on a dense formulation deserves a word. Unit: `[velocities]`. Why: a step of a chain takes 100
/// times as long as by index 1 there, with 300 600 times. Test: `dense_formulations_of_large_systems_are_warned_of`.
const LARGE_FOR_DENSE: usize = 100;

/// A method: formulation x integrator x projection, with its accuracy.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Method {
    /// Formulation with its options.
    pub formulation: MethodSpec,
    /// Integrator with its options.
    pub integrator: MethodSpec,
    /// Projection with its options.
    pub projection: MethodSpec,
    /// Relative tolerance.
    pub rtol: f64,
    /// Absolute tolerance.
    pub atol: f64,
    /// Fixed step, s; `None` lets the integrator choose.
    pub step: Option<f64>,
}

impl Method {
    /// The same with a fixed step, s, which methods such as `rattle` and `rk4` need.
    ///
    /// ```
    /// use holonom::methods::Method;
    ///
    /// let method = "index3 + rattle".parse::<Method>()?.with_step(1e-3);
    /// assert_eq!(method.step, Some(1e-3));
    /// # Ok::<(), holonom::Error>(())
    /// ```
    #[must_use]
    pub fn with_step(self, step: f64) -> Self {
        Method { step: Some(step), ..self }
    }
}

/// The method of least cost in most cases: at equal errors dop853 takes fewer evaluations than dopri5 on 18 of 29
/// shipped scenes at three digits, on 23 of 28 at six and on 19 of 23 at eight, where it is 2.3 times as fast in the
/// median.
impl Default for Method {
    fn default() -> Self {
        Method {
            formulation: MethodSpec::named("index1"),
            integrator: MethodSpec::named("dop853"),
            projection: MethodSpec::named("manifold"),
            rtol: 1e-8,
            atol: 1e-10,
            step: None,
        }
    }
}

/// Formulation, integrator and projection as [`Method::triple`] writes them, `ggl + radau_iia` or `index1 + dop853 +
/// manifold`, with options as [`MethodSpec::parse`] takes them and the default tolerances.
impl FromStr for Method {
    type Err = Error;

    fn from_str(text: &str) -> Result<Self> {
        let parts: Vec<&str> = text.split('+').map(str::trim).collect();
        let names = match parts[..] {
            [formulation, integrator] => [formulation, integrator, "none"],
            [formulation, integrator, projection] => [formulation, integrator, projection],
            _ => {
                return Err(Error::input(format!("`{text}` is no method"))
                    .hint("write formulation + integrator + projection, as in index1 + dop853 + manifold"));
            }
        };
        let [formulation, integrator, projection] = names.map(MethodSpec::parse);
        Ok(Method { formulation: formulation?, integrator: integrator?, projection: projection?, ..Method::default() })
    }
}

impl TryFrom<&str> for Method {
    type Error = Error;

    fn try_from(text: &str) -> Result<Self> {
        text.parse()
    }
}

impl From<&Method> for Method {
    fn from(method: &Method) -> Self {
        method.clone()
    }
}

/// atol = ratio rtol, rounded to the digits of a command line.
pub fn atol_of(rtol: f64, ratio: f64) -> f64 {
    let atol = rtol * ratio;
    format!("{atol:.3e}").parse().unwrap_or(atol)
}

impl Method {
    /// The default, with an absolute tolerance of 1e-8 of the length, m, of a scene that is smaller than a centimetre.
    pub fn of_length(length: f64) -> Self {
        let default = Method::default();
        // A scene shorter than a centimetre gets 1e-8 of its length, and no less than what round-off leaves of angles.
        Method { atol: (default.atol * (length / 0.01).min(1.0)).max(1e-16), ..default }
    }

    /// Formulation + integrator + projection, the last where there is one.
    pub fn triple(&self) -> String {
        let Method { formulation, integrator, projection, .. } = self;
        match projection.name.as_str() {
            "none" => format!("{formulation} + {integrator}"),
            _ => format!("{formulation} + {integrator} + {projection}"),
        }
    }

    /// The same where these own methods are known.
    pub(crate) fn knowing(self, own: &OwnMethods) -> Self {
        let Method { formulation, integrator, projection, .. } = &self;
        let [formulation, integrator, projection] =
            [formulation, integrator, projection].map(|spec| spec.clone().knowing(own));
        Method { formulation, integrator, projection, ..self }
    }

    /// Warnings about the method before a run of the system.
    pub fn doubts(&self, system: &dyn MechanicalSystem) -> Vec<Warning> {
        self.beyond_reach(system).into_iter().chain(self.dense(system)).collect()
    }

    /// Warning that a formulation is dense, for a large system.
    fn dense(&self, system: &dyn MechanicalSystem) -> Option<Warning> {
        let Dimensions { v: n, lambda: m, .. } = system.dimensions();
        let is_dense = formulation::make(&self.formulation, system).is_ok_and(|made| made.is_dense());
        (is_dense && n >= LARGE_FOR_DENSE).then(|| {
            let (name, [n, m]) = (&self.formulation.name, [n, m].each(|count| count as f64));
            let operations = 3.0 * n * m * m + 4.0 * n * n * (n - m).max(0.0);
            let text = format!("{name} is dense: an evaluation takes {operations:.0e} operations with {n} velocities and {m} constraints, growing with n^3");
            Warning::new(text, formulation::SPARSE)
        })
    }

    /// Warning that the steps cannot be controlled tightly enough for rtol: with methods of low order at rtol 1e-9,
    /// say.
    fn beyond_reach(&self, system: &dyn MechanicalSystem) -> Option<Warning> {
        let entry = integrator::find(&self.integrator).ok()?;
        let asked = Tolerance::new(self.rtol, self.atol, system);
        let reached = entry.tightening.reached(&asked);
        // The promise of the README.
        let is_beyond = self.step.is_none() && reached > 10.0 * self.rtol;
        is_beyond.then(|| {
            let name = entry.name;
            let rtol = short(self.rtol);
            let reached = format!("{reached:.0e}");
            let text = format!("{name} comes to errors of about {reached}, not to rtol {rtol}: its steps are at their tightest");
            Warning::new(text, "choose a method of higher order, such as dop853, or radau_iia for stiff motions; --check-error measures errors")
        })
    }

    /// Refuses invalid combinations, and names the valid ones.
    pub fn check(&self) -> Result<()> {
        let entry = integrator::find(&self.integrator).map_err(|error| error.under("integrator"))?;
        check_pair(entry, &self.formulation).map_err(|error| error.under("formulation"))?;
        let formulation = self.formulation.name.as_str();
        let projection = self.projection.name.as_str();
        let known = formulation::lookup(&self.formulation);
        let refuses = |projection: &str| known.is_some_and(|known| (entry.refuses)(known, projection));
        if refuses(projection) {
            let others = projection::registry().iter().map(|other| other.name);
            let others: Vec<&str> = others.filter(|other| !refuses(other)).collect();
            return Err(Error::input(format!("{} with {formulation} loses an order with {projection}", entry.name))
                .under("projection")
                .hint(format!("{} with {formulation} goes with projection {}", entry.name, others.join(", "))));
        }
        for (name, value) in [("rtol", Some(self.rtol)), ("atol", Some(self.atol)), ("step", self.step)] {
            if let Some(value) = value.filter(|value| !(*value > 0.0 && value.is_finite())) {
                let error = Error::input(format!("{name} is {value}, but must be above zero")).under(name);
                return Err(error.hint("give a positive number"));
            }
        }
        if self.rtol > 1.0 {
            let error = Error::input(format!("rtol is {}, but must not be above 1", short(self.rtol))).under("rtol");
            return Err(error.hint("1 allows errors as large as the solution; choose 1e-3 or less"));
        }
        match self.step {
            Some(_) if entry.steps == Steps::Own => Err(Error::input(format!("{} chooses its own steps", entry.name))
                .under("step")
                .hint("leave the step out and give --rtol and --atol")),
            None if entry.steps == Steps::Fixed => Err(Error::input(format!("{} has no error estimate", entry.name))
                .under("integrator")
                .hint("give a fixed step: --step H, or \"step\" in \"simulation\" of the scene")),
            _ => Ok(()),
        }
    }

    /// Refuses options that the formulation, the integrator or the projection does not take, and a system that is too
    /// large for one of them.
    pub fn check_options(&self, system: &dyn MechanicalSystem) -> Result<()> {
        formulation::make(&self.formulation, system).map_err(|error| error.under("formulation"))?;
        self.make_integrator(system).map_err(|error| error.under("integrator"))?;
        projection::make(&self.projection, system).map_err(|error| error.under("projection"))?;
        Ok(())
    }

    pub(super) fn make_integrator<'a>(&self, system: &'a dyn MechanicalSystem) -> Result<Box<dyn Integrator + 'a>> {
        let Method { integrator, formulation, step, .. } = self;
        (integrator::find(integrator)?.make)(&Setup { integrator, formulation, system, is_fixed: step.is_some() })
    }
}

/// Refuses a formulation that the integrator does not take, and names the valid pairs.
pub fn check_pair(entry: &integrator::IntegratorEntry, formulation: &MethodSpec) -> Result<()> {
    let name = formulation.name.as_str();
    // An unknown formulation is refused by its own registry, with names to choose from.
    let Some(solved) = formulation::lookup(formulation).filter(|known| !(entry.solves)(known)) else { return Ok(()) };
    let takers: Vec<&str> =
        integrator::registry().iter().filter(|other| (other.solves)(solved)).map(|other| other.name).collect();
    let takers = if takers.is_empty() { "no integrator".to_string() } else { takers.join(", ") };
    let accepted: Vec<&str> = entry.accepts().collect();
    Err(Error::input(format!("{} cannot integrate {name}", entry.name)).hint(format!(
        "{} accepts {}; {name} goes with {takers}",
        entry.name,
        accepted.join(", ")
    )))
}
