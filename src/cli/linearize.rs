//! `holonom linearize SCENE`

use super::common::{MethodOptions, Output, SceneOptions, Talk, print};
use super::linear::{ChartOptions, StateOptions};
use crate::choice::Choice;
use crate::error::{Error, Result};
use crate::linearize::{self, Chart, Kind, LinearModel, Request};
use crate::report::linear::{Linear, compare, comparison_text, linear_stem};
use crate::report::mechanism::{Look, mode_figure};
use crate::report::{self, Folder};
use crate::study::Study;
use serde::Serialize;
use std::process::ExitCode;

#[derive(clap::Args)]
pub struct Args {
    #[command(flatten)]
    scene: SceneOptions,
    #[command(flatten)]
    states: StateOptions,
    /// mcs, rcs, baumgarte, penalty, augmented_lagrangian or force_projection, with options as in baumgarte:alpha=5; or
    /// all, to compare them
    #[arg(long, default_value = "mcs")]
    method: String,
    #[command(flatten)]
    chart: ChartOptions,
    #[command(flatten)]
    run: MethodOptions,
    #[command(flatten)]
    talk: Talk,
    #[command(flatten)]
    output: Output,
}

pub fn run(args: Args) -> Result<ExitCode> {
    let in_file = |error: Error| error.in_file(&args.scene.path);
    let study = args.run.load_tight(&args.scene)?;
    let requests = requests(&args).map_err(|error| error.under("--method"))?;
    let places = args.states.states(&study, &args.talk).map_err(in_file)?;
    let mut folder = args.output.folder(&study.name)?;
    let mut results = Vec::new();
    for state in &places {
        let mut variation = state.variation(&study).map_err(in_file)?;
        let models = requests.iter().map(|request| linearize::linearize(&mut variation, request));
        let models = models.collect::<Result<Vec<LinearModel>>>().map_err(in_file)?;
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

fn requests(args: &Args) -> Result<Vec<Request>> {
    let chart = args.chart.chart();
    let request = |method: Choice| Request { method, chart: chart.clone() };
    if args.method != "all" {
        return Ok(vec![request(Choice::parse(&args.method)?)]);
    }
    let charts = if args.chart.chart().is_none() { vec![Chart::MassOrthogonal, Chart::Frozen] } else { Vec::new() };
    let charts = charts.into_iter().map(|chart| Ok(Request { method: Choice::named("mcs"), chart: Some(chart) }));
    let all = ["rcs", "rcs:form=index2", "rcs:form=index1", "rcs:form=ggl", "rcs:solver=gsvd", "rcs:solver=qz"];
    let rest = linearize::registry().iter().map(|entry| entry.name).filter(|name| !["mcs", "rcs"].contains(name));
    let projected = ["baumgarte:projected=yes", "penalty:projected=yes", "augmented_lagrangian:projected=yes"];
    let names = all.into_iter().chain(rest).chain(["penalty:kind=elastic"]).chain(projected);
    let first = std::iter::once(Ok(request(Choice::named("mcs"))));
    first.chain(charts).chain(names.map(|name| Choice::parse(name).map(request))).collect()
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
    let first = &models[0];
    let stem = linear_stem(first.point.t, None);
    linear(first).write(folder, &stem)?;
    let figure = mode_figure(study, &Look::plain(&study.mechanism), first);
    args.output.figure(folder, &stem.replace("linear", "modes"), figure)?;
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
        print(&format!("\n{}", comparison_text(&rows, first.point.is_equilibrium)))?;
    }
    let all = Result_::All { t: first.point.t, methods: rows };
    folder.write_json(&format!("{}.json", stem.replace("linear", "methods")), &all)?;
    Ok(all)
}
