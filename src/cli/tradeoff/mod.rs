//! `holonom tradeoff SCENE`

mod auto;
mod methods;
mod models;

use super::common::{Output, SceneOptions, Talk, duration, number};
use crate::error::Result;
use crate::method_spec::MethodSpec;
use crate::prepared::{Model, Overrides};
use crate::study::Watched;
use crate::study::work_precision::{Filter, GivenValues, TradeoffPlan, grid};
use crate::system::MechanicalSystem;
use crate::trajectory::recorded;
use crate::{formulation, projection};
use clap::ValueEnum;
use std::path::PathBuf;
use std::process::ExitCode;
use std::time::Duration;

#[derive(clap::Args)]
#[command(after_help = "Examples:
  holonom tradeoff models/pendulum.json --until 1 --digits 4 --budget 3s
  holonom tradeoff models/pendulum.json --until 1 --integrator dopri5 --integrator rk4 --digits 3 --json")]
pub struct Args {
    #[command(flatten)]
    scene: SceneOptions,
    /// Formulations to compare, such as index1; repeat for several (default: all)
    #[arg(long)]
    formulation: Vec<MethodSpec>,
    /// Integrators to compare; repeat for several (default: all)
    #[arg(long)]
    integrator: Vec<MethodSpec>,
    /// Projections to compare; repeat for several (default: those that are usual with each formulation)
    #[arg(long)]
    projection: Vec<MethodSpec>,
    /// End time, s
    #[arg(long, value_name = "T", value_parser = number, allow_negative_numbers = true)]
    until: Option<f64>,
    /// Outputs whose accuracy counts (default: all)
    #[arg(long, value_name = "NAME[,NAME...]", value_delimiter = ',')]
    outputs: Vec<String>,
    /// Digits to show the methods for, and that the reference must be good for
    #[arg(long, value_name = "N", default_value_t = 6)]
    digits: u32,
    /// Time for all of it, such as 60s or 5min
    #[arg(long, value_name = "TIME", default_value = "60s", value_parser = duration, allow_hyphen_values = true)]
    budget: Duration,
    /// Runs of a method, or model, that is quick; the fastest counts
    #[arg(long, value_name = "N", default_value_t = 3, value_parser = clap::value_parser!(u16).range(1..))]
    repeats: u16,
    /// Times at which motions are compared
    #[arg(long, value_name = "N", default_value_t = 200, value_parser = clap::value_parser!(u16).range(1..))]
    rows: u16,
    /// Try methods on that have fallen far behind
    #[arg(long)]
    exhaustive: bool,
    /// Go on with the measurement in the folder of the results
    #[arg(long)]
    resume: bool,
    /// Table (CSV) of values to compare with: t and outputs by name, in the place of a computed reference
    #[arg(long, value_name = "FILE")]
    reference: Option<PathBuf>,
    /// Compare models in the place of methods: scenes of the same mechanism, with their own parameters as in
    /// rod.json:modes=2,n=8
    #[arg(long, value_name = "SCENE[:NAME=VALUE,...]", num_args = 1..)]
    variants: Vec<String>,
    /// auto: models that `simplify` finds for 10 %, 1 % and 0.1 %, each by all methods; errors of model and method
    /// together
    #[arg(long, value_name = "auto", value_enum, conflicts_with_all = ["variants", "reference", "resume"])]
    models: Option<ModelChoice>,
    #[command(flatten)]
    output: Output,
    #[command(flatten)]
    talk: Talk,
}

#[derive(Clone, Copy, Debug, ValueEnum)]
enum ModelChoice {
    Auto,
}

pub fn run(args: Args) -> Result<ExitCode> {
    let prepared = args.talk.load(&args.scene.path, &args.overrides())?;
    prepared.span().map_err(|error| error.in_file(&args.scene.path))?;
    match (args.models, args.variants.is_empty()) {
        (Some(ModelChoice::Auto), _) => auto::run(&args, prepared),
        (None, true) => methods::run(&args, &prepared),
        (None, false) => models::run(&args, prepared.settled()?),
    }
}

/// Quantities, methods and times of a measurement.
struct Question {
    watched: Watched,
    plan: TradeoffPlan,
}

impl Args {
    /// Returns what to measure of a scene within `budget`; against these values, if they are given.
    fn question(&self, prepared: &Model, budget: Duration, given: Option<GivenValues>) -> Result<Question> {
        let span = prepared.span()?;
        let system = prepared.system();
        let rows = usize::from(self.rows);
        let outputs = self.outputs(prepared, given.as_ref());
        let watched = Watched::new(system, &outputs).map_err(|error| error.under("--outputs"))?;
        let rows = given.as_ref().map_or(Ok(rows), |given| given.parts(span.start, span.end, rows))?;
        self.check_choices(system)?;
        let filter = Filter {
            formulations: self.formulation.clone(),
            integrators: self.integrator.clone(),
            projections: self.projection.clone(),
        };
        let plan = TradeoffPlan {
            triples: grid(&filter)?,
            budget,
            repeats: usize::from(self.repeats),
            rows,
            digits: self.digits,
            is_exhaustive: self.exhaustive,
            given,
        };
        Ok(Question { watched, plan })
    }

    fn outputs(&self, prepared: &Model, given: Option<&GivenValues>) -> Vec<String> {
        let known = recorded(prepared.system());
        let has = |name: &&str| known.iter().any(|column| column.name == **name);
        match given {
            Some(given) if self.outputs.is_empty() => given.names().filter(has).map(str::to_string).collect(),
            _ => self.outputs.clone(),
        }
    }

    /// Refuses unknown options of the named methods, before anything is run.
    fn check_choices(&self, system: &dyn MechanicalSystem) -> Result<()> {
        for spec in &self.formulation {
            formulation::make(spec, system).map_err(|error| error.under("--formulation"))?;
        }
        for spec in &self.projection {
            projection::make(spec, system).map_err(|error| error.under("--projection"))?;
        }
        Ok(())
    }

    fn overrides(&self) -> Overrides {
        Overrides { until: self.until, ..self.scene.overrides() }
    }
}
