//! `holonom validate SCENE`

use super::common::{duration, positive, tell};
use super::interrupt;
use super::linear::{AtStates, ChartOptions};
use super::linearize::{Times, begin, span};
use crate::clock::Stopwatch;
use crate::error::{Error, Result, Warning};
use crate::linearize::along;
use crate::prepared::Model;
use crate::report::Answer;
use crate::report::linear::{SpanAnswer, ValidationAnswer};
use crate::validate::{Direction, Settings, validate_along, validate_until};
use std::process::ExitCode;
use std::time::Duration;

#[derive(clap::Args)]
#[command(after_help = "Examples:
  holonom validate models/four_bar_spring.json --at 0.3
  holonom validate models/double_pendulum.json --along 0..2:41")]
pub struct Args {
    #[command(flatten)]
    at: AtStates,
    /// Directions of the perturbation: random[:SEED] or names of states of the chart (default: random:1). A..B:N checks
    /// the models at N times from A to B, over the whole span
    #[arg(long, value_name = "DIRECTION[,DIRECTION...]", value_delimiter = ',')]
    along: Vec<String>,
    /// Time over which perturbed motions are followed, s (default: about a period of a usual mode)
    #[arg(long, value_name = "T", value_parser = positive, allow_negative_numbers = true)]
    horizon: Option<f64>,
    /// Leave the inputs out
    #[arg(long)]
    no_inputs: bool,
    /// Time for all states together, as 20s or 5min: what is known by then is written
    #[arg(long, value_name = "TIME", value_parser = duration, default_value = "20s")]
    budget: Duration,
    #[command(flatten)]
    chart: ChartOptions,
}

pub fn run(args: Args) -> Result<ExitCode> {
    let prepared = args.at.load()?;
    let default = Settings::default();
    let (spans, names): (Vec<&String>, Vec<&String>) = args.along.iter().partition(|text| text.contains(".."));
    let directions = match names.as_slice() {
        [] => default.directions,
        names => names.iter().map(|name| Direction::parse(name)).collect(),
    };
    if let Some(text) = spans.first() {
        let times = span(text).map_err(|message| Error::input(message).under("--along"))?;
        return over(&args, &prepared, &times, &directions).map_err(args.at.in_file());
    }
    let settings = Settings { chart: args.chart.chart(), directions, horizon: args.horizon, inputs: !args.no_inputs };
    let names = prepared.system().facts().names.clone();
    let mut complaints = Vec::new();
    let watch = Stopwatch::start();
    let budget = args.budget.as_secs_f64();
    let bar = args.at.talk.progress(1000, &prepared.name);
    let mut done = 0.0;
    let states = args.at.states.count() as f64;
    args.at.conclude(&prepared, |place, folder| {
        done += 1.0;
        // Each state may use what is left for those up to it.
        let is_over = || {
            let part = watch.wall().as_secs_f64() / budget;
            bar.set_position((1000.0 * part) as u64);
            part > done / states || interrupt::is_asked()
        };
        let found = validate_until(place.system(), &place.state, &settings, &is_over).map_err(args.at.in_file())?;
        args.at.talk.warn(
            &found
                .cut
                .iter()
                .map(|text| Warning::new(text, "give more time by --budget, or a shorter --horizon"))
                .collect::<Vec<_>>(),
        );
        let answer = ValidationAnswer { scene: &prepared.name, names: &names, found };
        complaints.extend((!answer.is_right()).then(|| answer.complaint()));
        args.at.add(folder, "validation", &prepared, place.state.t, &answer)
    })?;
    for complaint in &complaints {
        tell(format!("error: {complaint}"));
    }
    Ok(if complaints.is_empty() { ExitCode::SUCCESS } else { ExitCode::from(1) })
}

fn over(args: &Args, prepared: &Model, times: &Times, directions: &[Direction]) -> Result<ExitCode> {
    let range = &times.range;
    let mut folder = args.at.output.folder(&prepared.name)?;
    let progress = args.at.talk.progress_between(range.from, range.to, &prepared.name);
    let start = begin(&args.at, prepared, range)?;
    let chart = args.chart.chart();
    let found = along(prepared.system(), &start, chart.as_ref(), &range.values(), &progress)?;
    let check = |direction| validate_along(prepared.system(), &found, direction, &progress);
    let checks = directions.iter().map(check).collect::<Result<Vec<_>>>()?;
    drop(progress);
    let answer = SpanAnswer { scene: &prepared.name, along: &found, checks: &checks };
    let sealed = answer.stage(&mut folder, "validation-along", args.at.talk.origin(prepared))?;
    args.at.talk.conclude(folder, &sealed, || answer.text())?;
    if answer.is_right() {
        return Ok(ExitCode::SUCCESS);
    }
    tell(format!("error: {}", answer.verdict()));
    Ok(ExitCode::from(1))
}
