//! `holonom stress SCENE`

use super::common::{MethodOptions, Output, SceneOptions, Talk, assignment, duration, fail, json_files, pick, print};
use super::interrupt;
use crate::clock::Stopwatch;
use crate::error::{Error, Result};
use crate::math::expression::{Number, Parameters};
use crate::report::stress::{FolderMaps, SceneMaps};
use crate::report::{Answer, TextTable};
use crate::study::stress::{CellQuantity, Limits, Map, MapAxis, Subject, known, maps, pair, registry, stress};
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::time::Duration;

#[derive(clap::Args)]
#[command(after_help = "Examples:
  holonom stress --list
  holonom stress models/pendulum.json --map time --limit 100ms --budget 2s")]
pub struct Args {
    /// Scene file (JSON); with --all a folder of them (default: models)
    #[arg(value_name = "SCENE", required_unless_present_any = ["all", "list"])]
    path: Option<PathBuf>,
    /// Replace a parameter of the scene
    #[arg(long, value_name = "NAME=VALUE", value_parser = assignment)]
    set: Vec<(String, Number)>,
    /// The maps to make (default: all that make sense for the scene); --list names them
    #[arg(long, value_name = "NAME[,NAME...]", value_delimiter = ',')]
    map: Vec<String>,
    /// One's own map: what varies along x, an extreme or a parameter, such as step or mass_ratio=1e-8..1e8:9:log
    #[arg(long, value_name = "EXTREME[=A..B[:N][:log]]", requires = "y", conflicts_with = "map")]
    x: Option<String>,
    /// Parameter along y
    #[arg(long, value_name = "EXTREME[=A..B[:N][:log]]", requires = "x")]
    y: Option<String>,
    /// Quantity of the figures: position, velocity, final_position, energy, error or seconds
    #[arg(long, value_name = "QUANTITY")]
    show: Option<String>,
    /// CPU time of each simulation, such as 1s or 500ms
    #[arg(long, value_name = "TIME", default_value = "1s", value_parser = duration, allow_hyphen_values = true)]
    limit: Duration,
    /// Time for all of a scene, such as 20s or 5min; what has no time left is left out, and said so (default: 60s, with
    /// --all 20s)
    #[arg(long, value_name = "TIME", value_parser = duration, allow_hyphen_values = true)]
    budget: Option<Duration>,
    /// Every scene of a folder, and one report
    #[arg(long)]
    all: bool,
    /// Print the maps and the extremes, and simulate nothing
    #[arg(long)]
    list: bool,
    #[command(flatten)]
    method: MethodOptions,
    #[command(flatten)]
    talk: Talk,
    #[command(flatten)]
    output: Output,
}

pub fn run(args: Args) -> Result<ExitCode> {
    if args.list {
        print(&list())?;
        return Ok(ExitCode::SUCCESS);
    }
    let path = args.path.clone().unwrap_or(PathBuf::from("models"));
    if args.all { run_all(&args, &path) } else { run_one(&args, &path) }
}

fn run_one(args: &Args, path: &Path) -> Result<ExitCode> {
    let begun = Stopwatch::start();
    let (subject, maps) = prepare(args, path)?;
    let folder = args.output.folder(&subject.name)?;
    let answer = simulate(args, &subject, maps, begun);
    args.talk.publish(folder, "stress", args.talk.origin_of(&subject.values), &answer)?;
    if interrupt::is_asked() { fail("interrupted") } else { Ok(ExitCode::SUCCESS) }
}

fn run_all(args: &Args, path: &Path) -> Result<ExitCode> {
    let paths = scenes(path)?;
    let folder = args.output.folder("stress")?;
    let mut scenes = Vec::new();
    let mut unread = Vec::new();
    for path in paths {
        if interrupt::is_asked() {
            break;
        }
        let begun = Stopwatch::start();
        match prepare(args, &path) {
            Err(error) => unread.push((path.display().to_string(), format!("{error:#}"))),
            Ok((subject, maps)) => {
                let maps = simulate(args, &subject, maps, begun);
                args.talk.say(&maps.text())?;
                scenes.push(maps);
            }
        }
    }
    let is_empty = scenes.is_empty();
    args.talk.publish(folder, "stress", args.talk.origin_of(&Parameters::default()), &FolderMaps { scenes, unread })?;
    if interrupt::is_asked() { fail("interrupted") } else { Ok(ExitCode::from(u8::from(is_empty))) }
}

fn scenes(path: &Path) -> Result<Vec<PathBuf>> {
    let mut paths = json_files(path).map_err(|error| Error::file(path, format!("no folder of scenes: {error}")))?;
    paths.retain(|path| !path.to_string_lossy().ends_with(".schema.json"));
    if paths.is_empty() { Err(Error::file(path, "there is no scene in this folder")) } else { Ok(paths) }
}

fn prepare(args: &Args, path: &Path) -> Result<(Subject<'static>, Vec<Map>)> {
    let scene = SceneOptions { path: path.to_path_buf(), set: args.set.clone() };
    let mut subject = Subject::load(path, &args.method.overrides(&scene, None))?;
    subject.is_stopped = &interrupt::is_asked;
    args.talk.warn(&subject.doubts);
    let quantity = args.show.as_ref().map(|name| quantity(name)).transpose()?;
    let axis = |text: &str, option: &str| MapAxis::parse(text, &subject).map_err(|error| error.under(option));
    let mut maps = match (&args.x, &args.y) {
        (Some(x), Some(y)) => vec![pair(&subject, axis(x, "--x")?, axis(y, "--y")?, CellQuantity::Velocity)],
        _ => maps(&subject, &args.map).map_err(|error| error.under("--map"))?,
    };
    maps.iter_mut().for_each(|map| map.quantity = quantity.unwrap_or(map.quantity));
    Ok((subject, maps))
}

fn quantity(name: &str) -> Result<CellQuantity> {
    let name =
        pick("quantity", name, &CellQuantity::ALL.map(CellQuantity::name)).map_err(|error| error.under("--show"))?;
    Ok(CellQuantity::ALL.into_iter().find(|quantity| quantity.name() == name).unwrap_or(CellQuantity::Velocity))
}

impl Args {
    fn budget(&self) -> Duration {
        let usual = Duration::from_secs(if self.all { 20 } else { 60 });
        self.budget.unwrap_or(usual).min(LONGEST)
    }
}

/// Limit of times, so that multiples of them do not overflow.
const LONGEST: Duration = Duration::from_secs(1_000_000_000);

/// Simulates the maps, each with its share of the remaining time.
fn simulate(args: &Args, subject: &Subject, maps: Vec<Map>, begun: Stopwatch) -> SceneMaps {
    let budget = args.budget();
    let cell = args.limit.min(LONGEST);
    let count = maps.len();
    let bar = args.talk.progress(maps.iter().map(|map| map.cell_count() as u64).sum(), &subject.name);
    let one = |(k, map): (usize, Map)| {
        let left = budget.saturating_sub(begun.wall());
        // The first maps are the most informative and have the largest share.
        let all = 2 * left / (count - k + 1) as u32;
        stress(subject, map, Limits { cell, all }, &|| bar.inc(1))
    };
    let maps = maps.into_iter().enumerate().map(one).collect();
    bar.finish_and_clear();
    SceneMaps {
        scene: subject.name.clone(),
        method: subject.base.method.clone(),
        typical_step: subject.base.typical.step,
        typical_period: subject.base.typical.period,
        wall_seconds: begun.wall().as_secs_f64(),
        maps,
    }
}

fn list() -> String {
    let mut maps = TextTable::left(&["map", ""]);
    let mut extremes = TextTable::left(&["extreme", ""]);
    known().iter().for_each(|map| maps.row([map.name.to_string(), map.about.to_string()]));
    registry().iter().for_each(|extreme| extremes.row([extreme.name.to_string(), extreme.about.to_string()]));
    format!("{maps}\n{extremes}")
}
