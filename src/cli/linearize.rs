//! `holonom linearize SCENE`

use super::common::{SceneOptions, number};
use super::linear::{AtStates, ChartOptions};
use crate::error::{Error, Result, Warning};
use crate::linearize::{
    self, Chart, Comparison, Complex, Kind, LinearModel, Operating, Request, Variation, against, compare,
};
use crate::method_spec::MethodSpec;
use crate::prepared::PreparedScene;
use crate::report::linear::{AgainstFile, Linear, comparison_text, linear_stem};
use crate::report::mechanism::{Look, mode_figure};
use crate::report::{self, Folder, Repeatable, Sealed};
use serde::Serialize;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

#[derive(clap::Args)]
#[command(after_help = "Examples:
  holonom linearize models/four_bar_spring.json --at 0.3
  holonom linearize models/quarter_car.json --equilibrium --method all")]
pub struct Args {
    #[command(flatten)]
    at: AtStates,
    /// mcs, rcs, baumgarte, penalty, augmented_lagrangian or force_projection, with options as in baumgarte:alpha=5; or
    /// all, to compare them
    #[arg(long, default_value = "mcs")]
    method: String,
    #[command(flatten)]
    chart: ChartOptions,
    /// Only the N modes that are slowest, or nearest to --shift, in modal coordinates of the frozen equations: by
    /// sparse methods, for large models
    #[arg(long, value_name = "N", conflicts_with_all = ["chart", "independent"])]
    modes: Option<usize>,
    /// Modes nearest to this circular frequency
    #[arg(long, value_name = "RAD_PER_S", value_parser = number, requires = "modes")]
    shift: Option<f64>,
    /// Another scene of the mechanism, such as simplified.json: which modes it has lost, and how far others shift
    #[arg(long, value_name = "SCENE")]
    against: Option<PathBuf>,
}

pub fn run(args: Args) -> Result<ExitCode> {
    let prepared = args.at.load()?;
    let in_file = args.at.in_file();
    let requests = requests(&args).map_err(|error| error.under("--method"))?;
    let other = args.against.as_ref().map(|path| other(&args, path)).transpose()?;
    let strangers = other.as_ref().map(|scene| unlike(&prepared, scene)).transpose()?.flatten();
    args.at.talk.warn(&strangers);
    let mut told = Vec::new();
    args.at.conclude(&prepared, |state, folder| {
        let mut variation = state.variation().map_err(in_file)?;
        let models = models(&args, &requests, &mut variation).map_err(in_file)?;
        let uncertain = models.iter().filter(|model| model.has_uncertain_kinds()).map(|model| model.method.clone());
        let new: Vec<String> = uncertain.filter(|method| !told.contains(method)).collect();
        args.at.talk.warn(&report::uncertain_kinds(new.iter().map(String::as_str)));
        told.extend(new);
        args.at.talk.warn(&models.first().and_then(LinearModel::doubt));
        let compared = other.as_ref().map(|scene| compared(&args, &prepared, scene, (state, &models[0]), &requests));
        report(&args, &prepared, (&models, compared.transpose()?), folder)
    })?;
    Ok(ExitCode::SUCCESS)
}

/// Returns the models by each method, or the requested modes.
fn models(args: &Args, requests: &[Request], variation: &mut Variation) -> Result<Vec<LinearModel>> {
    match args.modes {
        Some(count) => {
            let shift = Complex::new(0.0, args.shift.unwrap_or(0.0));
            Ok(vec![linearize::modal(variation, count, shift)?])
        }
        None => {
            let mut models = Vec::new();
            for request in requests {
                match linearize::linearize(variation, request) {
                    Ok(model) => models.push(model),
                    Err(error) if models.is_empty() => return Err(error),
                    Err(error) => args.at.talk.warn([&without_model(request, error)]),
                }
            }
            Ok(models)
        }
    }
}

/// Warning for a method that is left out of the comparison.
fn without_model(request: &Request, error: Error) -> Warning {
    let Error::Input(input) = error else { return Warning::new(error.to_string(), "take another time") };
    let text = format!("no model by {}: {}", request.method, input.message);
    Warning::new(text, input.hint.unwrap_or_default())
}

fn requests(args: &Args) -> Result<Vec<Request>> {
    let chart = args.chart.chart();
    if args.modes.is_some() && args.method != "mcs" {
        return Err(Error::input("--modes has a method of its own").hint("leave out --method, or --modes"));
    }
    if args.against.is_some() && args.method == "all" {
        return Err(Error::input("--against compares models by one method").hint("name it, or leave out --against"));
    }
    let request = |method: MethodSpec| Request { method, chart: chart.clone() };
    if args.method != "all" {
        return Ok(vec![request(MethodSpec::parse(&args.method)?)]);
    }
    let charts = if args.chart.chart().is_none() { vec![Chart::MassOrthogonal, Chart::Frozen] } else { Vec::new() };
    let charts = charts.into_iter().map(|chart| Ok(Request { method: MethodSpec::named("mcs"), chart: Some(chart) }));
    let all = ["rcs", "rcs:form=index2", "rcs:form=index1", "rcs:form=ggl", "rcs:solver=gsvd", "rcs:solver=qz"];
    let rest = linearize::registry().iter().map(|entry| entry.name).filter(|name| !["mcs", "rcs"].contains(name));
    let projected = ["baumgarte:projected=yes", "penalty:projected=yes", "augmented_lagrangian:projected=yes"];
    let names = all.into_iter().chain(rest).chain(["penalty:kind=elastic"]).chain(projected);
    let first = std::iter::once(Ok(request(MethodSpec::named("mcs"))));
    first.chain(charts).chain(names.map(|name| MethodSpec::parse(name).map(request))).collect()
}

/// Comparison of all methods at one state.
#[derive(Serialize)]
struct Methods {
    t: f64,
    methods: Vec<Comparison>,
}

/// JSON output for one state.
#[derive(Serialize)]
#[serde(untagged)]
enum Printed {
    One(Box<Sealed<Repeatable<report::linear::LinearFile>>>),
    All(Box<Sealed<Repeatable<Methods>>>),
    Against(Box<Compared>),
}

/// A linear model with its comparison.
#[derive(Serialize)]
struct Compared {
    #[serde(flatten)]
    linear: Sealed<Repeatable<report::linear::LinearFile>>,
    against: Sealed<Repeatable<AgainstFile>>,
}

fn other(args: &Args, path: &Path) -> Result<PreparedScene> {
    let scene = SceneOptions { path: path.to_path_buf(), set: Vec::new() };
    args.at.run.load_tight(&scene, &args.at.talk)
}

/// A warning where a scene to compare with has no body, or no output, of the first.
///
/// # Errors
/// It has neither: it is a scene of something else.
pub fn unlike(own: &PreparedScene, other: &PreparedScene) -> Result<Option<Warning>> {
    let bodies = |scene: &PreparedScene| -> Vec<String> {
        let names = scene.system().names().v.into_iter();
        names.map(|name| name.split('.').next().unwrap_or_default().trim_end_matches('\'').to_string()).collect()
    };
    let outputs = |scene: &PreparedScene| scene.system().columns().into_iter().map(|column| column.name).collect();
    let shares = |list: &dyn Fn(&PreparedScene) -> Vec<String>| {
        let there = list(other);
        list(own).iter().any(|name| there.contains(name))
    };
    let text = match [shares(&bodies), shares(&outputs)] {
        [true, true] => return Ok(None),
        [false, false] => {
            let text =
                format!("{} has no body and no output of {}: it is a scene of something else", other.name, own.name);
            return Err(Error::input(text)
                .under("--against")
                .hint("name a scene of the same mechanism, such as simplified.json"));
        }
        [false, true] => format!("{} has no body of {}: is it a scene of the same mechanism?", other.name, own.name),
        [true, false] => {
            format!("{} has no output of {}: modes are told by their eigenvalues alone", other.name, own.name)
        }
    };
    Ok(Some(Warning::new(text, "give both scenes the same names")))
}

/// The modes of `model` against those of another scene at the same time.
fn compared(
    args: &Args,
    prepared: &PreparedScene,
    scene: &PreparedScene,
    (own, model): (&Operating, &LinearModel),
    requests: &[Request],
) -> Result<AgainstFile> {
    let places = args.at.states.at(scene, &args.at.talk, own.state.t)?;
    let other = models(args, &requests[..1], &mut places.variation()?)?;
    let time = prepared.span().map_or(1.0, |span| span.end - span.start);
    Ok(AgainstFile::new(own.state.t, &scene.name, &against(model, &other[0], time)))
}

fn report(
    args: &Args,
    prepared: &PreparedScene,
    (models, against): (&[LinearModel], Option<AgainstFile>),
    folder: &mut Folder,
) -> Result<Printed> {
    let names = prepared.system().names();
    let first = &models[0];
    let linear = Linear { scene: &prepared.name, names: &names, model: first };
    let stem = linear_stem(first.point.t);
    linear.write(folder, &stem)?;
    let figure = mode_figure(prepared, &Look::plain(&prepared.mechanism), first);
    args.at.output.figure(folder, &stem.replace("linear", "modes"), figure)?;
    let one = folder.seal(&format!("{stem}.json"), args.at.talk.repeatable(prepared, linear.file()))?;
    args.at.talk.say(&linear.text())?;
    if let Some(against) = against {
        args.at.talk.say(&format!("\n{}", against.text()))?;
        let all = args.at.talk.repeatable(prepared, against);
        let against = folder.seal(&format!("{}.json", stem.replace("linear", "against")), all)?;
        return Ok(Printed::Against(Box::new(Compared { linear: one, against })));
    }
    if models.len() == 1 {
        return Ok(Printed::One(Box::new(one)));
    }
    let exact = first.modes.iter().filter(|mode| mode.kind == Kind::Physical).map(|mode| mode.value);
    let rows = compare(models, &exact.collect::<Vec<_>>());
    args.at.talk.say(&format!("\n{}", comparison_text(&rows, first.point.is_equilibrium)))?;
    let all = args.at.talk.repeatable(prepared, Methods { t: first.point.t, methods: rows });
    folder.seal(&format!("{}.json", stem.replace("linear", "methods")), all).map(|all| Printed::All(Box::new(all)))
}
