//! `holonom linearize SCENE`

use super::common::{SceneOptions, number};
use super::linear::{AtStates, ChartOptions};
use super::simplify::percentage;
use crate::error::{Error, Result, Warning};
use crate::linearize::{
    self, Chart, Complex, Kind, Linear, LinearModel, LinearizationPoint, Operating, State, Variation, against, compare,
    kinks, within_run,
};
use crate::method_spec::MethodSpec;
use crate::prepared::Model;
use crate::report::linear::{
    AgainstAnswer, AlongAnswer, ArrayFormat, LinearAnswer, MethodsAnswer, NamedModel, stem_at,
};
use crate::report::{Answer, Folder, uncertain_kinds};
use crate::sweep::Range;
use crate::view::{Extras, ShownMotion, page, still};
use serde_json::Value;
use std::path::{Path, PathBuf};

#[derive(clap::Args)]
#[command(after_help = "Examples:
  holonom linearize models/four_bar_spring.json --at 0.3
  holonom linearize models/double_pendulum.json --along 0..2:41")]
pub struct Args {
    #[command(flatten)]
    at: AtStates,
    /// mcs, rcs, baumgarte, penalty, augmented_lagrangian or force_projection, with options as in baumgarte:alpha=5; or
    /// all, to compare them
    #[arg(long, default_value = "mcs")]
    method: String,
    #[command(flatten)]
    chart: ChartOptions,
    /// The linear time-varying model from time A to B, at N times, with transition matrices: one file ltv.npz
    #[arg(long, value_name = "A..B[:N]", value_parser = span, allow_negative_numbers = true, allow_hyphen_values = true,
          conflicts_with_all = ["at", "equilibrium", "modes", "against"])]
    along: Option<Times>,
    /// With --along: add times until linear interpolation between them is within this part of the largest entry
    #[arg(long, value_name = "P%", value_parser = percentage, allow_hyphen_values = true, requires = "along")]
    within: Option<f64>,
    /// With --along: formats of the arrays
    #[arg(long, value_enum, value_delimiter = ',', default_value = "npz", requires = "along")]
    format: Vec<ArrayFormat>,
    /// Only the N modes that are slowest, or nearest to --shift, in modal coordinates of the frozen equations: by
    /// sparse methods, for large models
    #[arg(long, value_name = "N", conflicts_with_all = ["chart", "independent"])]
    modes: Option<usize>,
    /// Modes nearest to this circular frequency
    #[arg(long, value_name = "RAD_PER_S", value_parser = number, requires = "modes")]
    shift: Option<f64>,
    /// The page of `holonom view` with the mode shapes, too, for each state
    #[arg(long, conflicts_with = "along")]
    view: bool,
    /// Another scene of the mechanism, such as simplified.json: which modes it has lost, and how far others shift
    #[arg(long, value_name = "SCENE")]
    against: Option<PathBuf>,
}

/// Times of a motion.
#[derive(Clone, Debug)]
pub struct Times {
    pub range: Range,
    /// True if their number was given.
    is_counted: bool,
}

/// Intervals with which the search for times begins.
const BEGUN: usize = 9;

pub fn span(text: &str) -> Result<Times, String> {
    let range: Range = format!("t={text}").parse().map_err(|error: Error| {
        let text = format!("{error:#}");
        text.replace("travel=-0.08..0.08:81", "0..2:41").replace("NAME=", "")
    })?;
    if range.from >= range.to || range.is_log {
        return Err("write A..B:N with A before B, as in 0..2:41".to_string());
    }
    Ok(Times { range, is_counted: text.contains(':') })
}

pub fn run(args: Args) -> Result<()> {
    let prepared = args.at.load()?;
    let in_file = args.at.in_file();
    if let Some(times) = &args.along {
        return along(&args, &prepared, times).map_err(in_file);
    }
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
        args.at.talk.warn(&uncertain_kinds(new.iter().map(String::as_str)));
        told.extend(new);
        args.at.talk.warn(&models.first().and_then(LinearModel::doubt));
        let compared = other.as_ref().map(|scene| compared(&args, &prepared, scene, state, &models[0], &requests));
        add(&args, &prepared, &models, compared.transpose()?, folder)
    })
}

/// Returns the state of the motion at the first time of a range.
pub fn begin(at: &AtStates, prepared: &Model, range: &Range) -> Result<State> {
    within_run(prepared, &[range.from, range.to]).map_err(|error| error.at("--along"))?;
    let start = prepared.states_at(&[range.from])?.swap_remove(0);
    at.talk.warn(&kinks(prepared.system(), &start)?);
    Ok(start)
}

fn along(args: &Args, prepared: &Model, times: &Times) -> Result<()> {
    if args.method != "mcs" {
        let error = Error::input("--along makes models in minimal coordinates, which only mcs has");
        return Err(error.under("--method").hint("leave out --method"));
    }
    let Times { range, is_counted } = times;
    let Range { from, to, .. } = *range;
    let mut folder = args.at.output.folder(&prepared.name)?;
    let progress = args.at.talk.progress_between(from, to, &prepared.name);
    let start = &begin(&args.at, prepared, range)?;
    let chart = args.chart.chart();
    let found = match args.within {
        Some(part) => {
            let count = if *is_counted { range.count } else { BEGUN };
            let times = Range::new("t", (from, to), count)?.values();
            linearize::within(prepared.system(), start, chart.as_ref(), &times, part, progress)?
        }
        None => linearize::along(prepared.system(), start, chart.as_ref(), &range.values(), progress)?,
    };
    args.at.talk.warn(&found.doubt());
    let answer = AlongAnswer { prepared, along: &found, formats: &args.format };
    let sealed = answer.stage(&mut folder, "ltv", args.at.talk.origin(prepared))?;
    args.at.talk.conclude(folder, &sealed, || answer.text())
}

fn models(args: &Args, requests: &[Linear], variation: &mut Variation) -> Result<Vec<LinearModel>> {
    match args.modes {
        Some(count) => {
            let shift = Complex::new(0.0, args.shift.unwrap_or(0.0));
            Ok(vec![linearize::modal(variation, count, shift)?])
        }
        None => {
            let mut models = Vec::new();
            for request in requests {
                match variation.linearize(request) {
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
fn without_model(request: &Linear, error: Error) -> Warning {
    let Error::Input(input) = error else { return Warning::new(format!("{error:#}"), "take another time") };
    let text = format!("no model by {}: {}", request.method, input.message);
    Warning::new(text, input.hint.unwrap_or_default())
}

fn requests(args: &Args) -> Result<Vec<Linear>> {
    let chart = args.chart.chart();
    if args.modes.is_some() && args.method != "mcs" {
        return Err(Error::input("--modes has a method of its own").hint("leave out --method, or --modes"));
    }
    if args.against.is_some() && args.method == "all" {
        return Err(Error::input("--against compares models by one method").hint("name it, or leave out --against"));
    }
    let request = |method: MethodSpec| Linear { method, chart: chart.clone() };
    if args.method != "all" {
        return Ok(vec![request(MethodSpec::parse(&args.method)?)]);
    }
    let charts = if args.chart.chart().is_none() { vec![Chart::MassOrthogonal, Chart::Frozen] } else { Vec::new() };
    let charts = charts.into_iter().map(|chart| Ok(Linear { method: MethodSpec::named("mcs"), chart: Some(chart) }));
    let all = ["rcs", "rcs:form=index2", "rcs:form=index1", "rcs:form=ggl", "rcs:solver=gsvd", "rcs:solver=qz"];
    let rest = linearize::registry().iter().map(|entry| entry.name).filter(|name| !["mcs", "rcs"].contains(name));
    let projected = ["baumgarte:projected=yes", "penalty:projected=yes", "augmented_lagrangian:projected=yes"];
    let names = all.into_iter().chain(rest).chain(["penalty:kind=elastic"]).chain(projected);
    let first = std::iter::once(Ok(request(MethodSpec::named("mcs"))));
    first.chain(charts).chain(names.map(|name| MethodSpec::parse(name).map(request))).collect()
}

fn other(args: &Args, path: &Path) -> Result<Model> {
    let scene = SceneOptions { path: path.to_path_buf(), set: Vec::new() };
    args.at.run.load_tight(&scene, &args.at.talk)
}

/// A warning where a scene to compare with has no body, or no output, of the first.
///
/// # Errors
/// It has neither: it is a scene of something else.
pub fn unlike(own: &Model, other: &Model) -> Result<Option<Warning>> {
    let bodies = |scene: &Model| -> Vec<String> {
        let names = scene.system().facts().names.v.clone().into_iter();
        names.map(|name| name.split('.').next().unwrap_or_default().trim_end_matches('\'').to_string()).collect()
    };
    let outputs = |scene: &Model| scene.system().facts().outputs.iter().map(|column| column.name.clone()).collect();
    let shares = |list: &dyn Fn(&Model) -> Vec<String>| {
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
fn compared<'s>(
    args: &Args,
    prepared: &Model,
    scene: &'s Model,
    place: &Operating,
    model: &LinearModel,
    requests: &[Linear],
) -> Result<AgainstAnswer<'s>> {
    let other_place = args.at.states.at(scene, &args.at.talk, place.state.t)?;
    let other = models(args, &requests[..1], &mut other_place.variation()?)?;
    let time = prepared.span().map_or(1.0, |span| span.end - span.start);
    Ok(AgainstAnswer { t: place.state.t, other: &scene.name, found: against(model, &other[0], time) })
}

/// Writes the first model, and what it is compared with; returns the JSON to print.
fn add(
    args: &Args,
    prepared: &Model,
    models: &[LinearModel],
    against: Option<AgainstAnswer>,
    folder: &mut Folder,
) -> Result<Value> {
    let first = &models[0];
    let LinearizationPoint { t, is_equilibrium, .. } = first.point;
    if args.view {
        let still = still(prepared, &first.point);
        let page = page(&ShownMotion::new(prepared, &still), &Extras { model: Some(first), ..Extras::default() });
        folder.write(&format!("{}.html", stem_at("view", t)), page.as_bytes())?;
    }
    let linear = NamedModel { scene: &prepared.name, names: &prepared.system().facts().names, model: first };
    let mut json = args.at.add(folder, "linear", prepared, t, &LinearAnswer { prepared, linear })?;
    if let Some(against) = against {
        json["against"] = args.at.add(folder, "against", prepared, t, &against)?;
        return Ok(json);
    }
    if models.len() == 1 {
        return Ok(json);
    }
    let exact = first.modes.iter().filter(|mode| mode.kind == Kind::Physical).map(|mode| mode.value);
    let methods = compare(models, &exact.collect::<Vec<_>>());
    args.at.add(folder, "methods", prepared, t, &MethodsAnswer { t, is_equilibrium, methods })
}
