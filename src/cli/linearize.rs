//! `holonom linearize SCENE`

use super::common::{MethodOptions, Output, SceneOptions, Talk, number, print};
use crate::choice::Choice;
use crate::error::{Error, Result};
use crate::linearize::{self, Chart, Complex, Kind, LinearModel, Request, State, Variation, at_rest, states};
use crate::report::linear::{Linear, compare, comparison_text, linear_stem};
use crate::report::{self, Folder};
use crate::study::Study;
use serde::Serialize;
use std::process::ExitCode;

#[derive(clap::Args)]
pub struct Args {
    #[command(flatten)]
    scene: SceneOptions,
    /// Times of the states, s (default: the start)
    #[arg(long, value_name = "T[,T...]", value_parser = number, value_delimiter = ',', allow_negative_numbers = true)]
    at: Vec<f64>,
    /// mcs, rcs, baumgarte, penalty, augmented_lagrangian or force_projection, with options as in baumgarte:alpha=5; or
    /// all, to compare them
    #[arg(long, default_value = "mcs")]
    method: String,
    /// Coordinates of the perturbation: intrinsic, mass_orthogonal, frozen, or independent coordinates NAME[,NAME]
    /// (default: intrinsic, or mass_orthogonal with bodies in floating frames)
    #[arg(long, value_name = "CHART", conflicts_with = "independent")]
    chart: Option<String>,
    /// Independent coordinates, the same as --chart NAME[,NAME]
    #[arg(long, value_name = "NAME[,NAME...]")]
    independent: Option<String>,
    /// Only the N modes that are slowest, or nearest to --shift, in modal coordinates of the frozen equations: by sparse
    /// methods, for large models
    #[arg(long, value_name = "N", conflicts_with_all = ["chart", "independent"])]
    modes: Option<usize>,
    /// Modes nearest to this circular frequency
    #[arg(long, value_name = "RAD_PER_S", value_parser = number, requires = "modes")]
    shift: Option<f64>,
    /// Find the static equilibrium that belongs to the state first
    #[arg(long)]
    equilibrium: bool,
    #[command(flatten)]
    run: MethodOptions,
    #[command(flatten)]
    talk: Talk,
    #[command(flatten)]
    output: Output,
}

/// States of a run are integrated at least so well, unless --rtol or --atol says otherwise.
const TOLERANCE: f64 = 1e-10;

pub fn run(args: Args) -> Result<ExitCode> {
    let in_file = |error: Error| error.in_file(&args.scene.path);
    let mut study = args.run.load(&args.scene, None)?;
    study.method.rtol = args.run.rtol.unwrap_or(study.method.rtol.min(TOLERANCE));
    study.method.atol = args.run.atol.unwrap_or(study.method.atol.min(TOLERANCE));
    let requests = requests(&args).map_err(|error| error.under("--method"))?;
    let places = places(&args, &study).map_err(in_file)?;
    let mut folder = args.output.folder(&study.name)?;
    let mut results = Vec::new();
    for state in &places {
        let mut variation = state.variation(&study).map_err(in_file)?;
        let models = models(&args, &requests, &mut variation).map_err(in_file)?;
        results.push(report(&args, &study, &models, &mut folder)?);
    }
    match (args.talk.json, results.as_slice()) {
        (true, [one]) => args.talk.print(one, String::new)?,
        (true, all) => args.talk.print(&all, String::new)?,
        (false, _) if !args.talk.quiet => print(&format!("\nwritten to {}\n", folder.listing()))?,
        _ => {}
    }
    Ok(ExitCode::SUCCESS)
}

/// By each method, or the modes that are asked for.
fn models(args: &Args, requests: &[Request], variation: &mut Variation) -> Result<Vec<LinearModel>> {
    match args.modes {
        Some(count) => {
            let shift = Complex::new(0.0, args.shift.unwrap_or(0.0));
            Ok(vec![linearize::modal(variation, count, shift)?])
        }
        None => requests.iter().map(|request| linearize::linearize(variation, request)).collect(),
    }
}

fn requests(args: &Args) -> Result<Vec<Request>> {
    let chart = args.chart.as_ref().or(args.independent.as_ref()).map(|text| Chart::parse(text));
    if args.modes.is_some() && args.method != "mcs" {
        return Err(Error::input("--modes has a method of its own").hint("leave out --method, or --modes"));
    }
    let request = |method: Choice| Request { method, chart: chart.clone() };
    if args.method != "all" {
        return Ok(vec![request(Choice::parse(&args.method)?)]);
    }
    let all = ["mcs", "rcs", "rcs:form=index2", "rcs:form=index1", "rcs:form=ggl", "rcs:solver=gsvd", "rcs:solver=qz"];
    let rest = linearize::registry().iter().map(|entry| entry.name).filter(|name| !["mcs", "rcs"].contains(name));
    let projected = ["baumgarte:projected=yes", "penalty:projected=yes", "augmented_lagrangian:projected=yes"];
    let names = all.into_iter().chain(rest).chain(["penalty:kind=elastic"]).chain(projected);
    names.map(|name| Choice::parse(name).map(request)).collect()
}

fn places(args: &Args, study: &Study) -> Result<Vec<State>> {
    let times = if args.at.is_empty() { vec![study.start_time()] } else { args.at.clone() };
    if !args.equilibrium {
        let bar = args.talk.progress(times.len() as u64, &study.name);
        let found = states(study, &times, |_| bar.inc(1));
        bar.finish_and_clear();
        return found;
    }
    let (q, v) = study.start();
    times.into_iter().map(|t| at_rest(study, &State { t, q: q.to_vec(), v: v.to_vec() })).collect()
}

/// What `--json` prints for one state.
#[derive(Serialize)]
#[serde(untagged)]
enum Result_ {
    One(Box<report::linear::LinearFile>),
    All { t: f64, methods: Vec<report::linear::Comparison> },
}

fn report(args: &Args, study: &Study, models: &[LinearModel], folder: &mut Folder) -> Result<Result_> {
    let names = study.system().names();
    let linear = |model| Linear { scene: &study.name, names: &names, model };
    let is_alone = models.len() == 1;
    for model in models {
        let stem = linear_stem(model.point.t, (!is_alone).then_some(model.method.as_str()));
        linear(model).write(folder, &stem)?;
    }
    let first = &models[0];
    let is_silent = args.talk.json || args.talk.quiet;
    if !is_silent {
        print(&linear(first).text())?;
    }
    if is_alone {
        return Ok(Result_::One(Box::new(linear(first).file())));
    }
    let exact = first.modes.iter().filter(|mode| mode.kind == Kind::Physical).map(|mode| mode.value);
    let rows = compare(models, &exact.collect::<Vec<_>>());
    if !is_silent {
        print(&format!("\n{}", comparison_text(&rows)))?;
    }
    Ok(Result_::All { t: first.point.t, methods: rows })
}
