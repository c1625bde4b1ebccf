//! `holonom tradeoff SCENE`

use super::common::{Output, SceneOptions, Talk, assignment, choice, duration, number, print, tell};
use super::interrupt;
use crate::choice::Choice;
use crate::error::{Error, Result};
use crate::files;
use crate::math::expression::Number;
use crate::measure::work_precision::models::{Variant, compare};
use crate::measure::work_precision::{Filter, Given, Lack, Motion, Plan, Runner, Watched, WorkPrecision, grid};
use crate::report::tradeoff::{ModelsSummary, Summary, models_figure, models_table, tradeoff_figure, tradeoff_table};
use crate::report::write_whole;
use crate::scene;
use crate::study::{Overrides, Study};
use crate::system::MechanicalSystem;
use crate::{formulation, projection};
use std::hash::{DefaultHasher, Hash, Hasher};
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::time::{Duration, Instant};

#[derive(clap::Args)]
pub struct Args {
    #[command(flatten)]
    scene: SceneOptions,
    /// Formulations to compare, such as index1; repeat for several (default: all)
    #[arg(long, value_parser = choice)]
    formulation: Vec<Choice>,
    /// Integrators to compare; repeat for several (default: all)
    #[arg(long, value_parser = choice)]
    integrator: Vec<Choice>,
    /// Projections to compare; repeat for several (default: those that are usual with each formulation)
    #[arg(long, value_parser = choice)]
    projection: Vec<Choice>,
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
    #[command(flatten)]
    output: Output,
    #[command(flatten)]
    talk: Talk,
}

/// Results so far are written so often.
const SAVED: Duration = Duration::from_secs(5);

pub fn run(args: Args) -> Result<ExitCode> {
    let study = args.talk.load(&args.scene.path, &args.overrides())?;
    study.span().map_err(|error| error.in_file(&args.scene.path))?;
    if args.variants.is_empty() { methods(&args, &study) } else { models(&args, study.settled()?) }
}

impl Args {
    fn overrides(&self) -> Overrides {
        Overrides { set: self.scene.set.clone(), until: self.until, ..Overrides::default() }
    }

    /// The table to measure against: that of the command line, or that which the scene brings.
    fn reference(&self, study: &Study) -> Option<PathBuf> {
        let own = || Some(scene::folder(Some(&self.scene.path)).join(study.reference.as_ref()?));
        self.reference.clone().or_else(own)
    }

    /// What to compare; by default all that a table has.
    fn outputs(&self, study: &Study, given: Option<&Given>) -> Vec<String> {
        let known = study.system().columns();
        let has = |name: &&str| known.iter().any(|column| column.name == **name);
        match given {
            Some(given) if self.outputs.is_empty() => given.names().filter(has).map(str::to_string).collect(),
            _ => self.outputs.clone(),
        }
    }

    /// Refuses unknown options of what is named, before anything is run.
    fn check_choices(&self, system: &dyn MechanicalSystem) -> Result<()> {
        for choice in &self.formulation {
            formulation::make(choice, system).map_err(|error| error.under("--formulation"))?;
        }
        for choice in &self.projection {
            projection::make(choice, system).map_err(|error| error.under("--projection"))?;
        }
        Ok(())
    }

    /// The scene as the command line names it, with what it changes.
    fn named(&self) -> String {
        let set = self.scene.set.iter().map(|(name, value)| format!(" --set {name}={value}"));
        let until = self.until.iter().map(|until| format!(" --until {until}"));
        [self.scene.path.display().to_string()].into_iter().chain(set).chain(until).collect()
    }
}

fn methods(args: &Args, study: &Study) -> Result<ExitCode> {
    let span = study.span()?;
    let given = args.reference(study).as_deref().map(Given::read).transpose()?;
    let outputs = args.outputs(study, given.as_ref());
    let watched = Watched::new(study.system(), &outputs).map_err(|error| error.under("--outputs"))?;
    let rows = usize::from(args.rows);
    let rows = given.as_ref().map_or(Ok(rows), |given| given.parts((span.start, span.end), rows))?;
    let filter = Filter {
        formulations: args.formulation.clone(),
        integrators: args.integrator.clone(),
        projections: args.projection.clone(),
    };
    args.check_choices(study.system())?;
    let plan = Plan {
        triples: grid(&filter)?,
        budget: args.budget,
        repeats: usize::from(args.repeats),
        rows,
        digits: args.digits,
        is_exhaustive: args.exhaustive,
        given,
    };
    let fresh = WorkPrecision {
        fingerprint: fingerprint(args, rows)?,
        ..WorkPrecision::fresh(&study.name, (span.start, span.end), rows)
    };
    let mut folder = args.output.folder(&study.name)?;
    let place = args.output.path(&study.name).join("tradeoff.json");
    let mut measured = if args.resume { resumed(&place, fresh)? } else { fresh };
    let bar = args.talk.progress(1000, &study.name);
    let (clock, mut saved) = (Instant::now(), Instant::now());
    let watch = |measured: &WorkPrecision, next: &str| {
        bar.set_position((1e3 * clock.elapsed().as_secs_f64() / args.budget.as_secs_f64()) as u64);
        bar.set_message(next.to_string());
        if saved.elapsed() > SAVED {
            saved = Instant::now();
            // What cannot be saved now will be told at the end.
            let _ = save(&place, measured);
        }
    };
    let is_asked = interrupt::is_asked;
    let motion = Motion {
        system: study.system(),
        start: study.start(),
        between: (span.start, span.end),
        ratio: study.method.atol / study.method.rtol,
        is_stopped: &is_asked,
    };
    let result = Runner::new(motion, &plan, watched, watch).run(&mut measured);
    bar.finish_and_clear();
    result?;
    let summary = Summary::new(&measured, &args.named());
    folder.write_json("tradeoff.json", &summary)?;
    folder.write("tradeoff.csv", &tradeoff_table(&measured)?)?;
    args.output.figure(&mut folder, "tradeoff", tradeoff_figure(&measured, args.digits))?;
    let written = folder.finish()?;
    args.talk.print(&summary, || summary.text(args.digits))?;
    if !args.talk.json && !args.talk.quiet {
        print(&format!("\nwritten to {}\n", written.listing()))?;
    }
    match (is_asked(), measured.lacks(args.digits)) {
        (true, _) => tell("error: interrupted\n  help: go on with --resume"),
        (_, Some(Lack { why, hint, is_all: true })) => tell(format!("error: no recommendation: {why}\n  help: {hint}")),
        _ => return Ok(ExitCode::SUCCESS),
    }
    Ok(ExitCode::from(1))
}

fn save(place: &Path, measured: &WorkPrecision) -> Result<()> {
    let text = serde_json::to_string_pretty(measured).map_err(|error| Error::file(place, error))?;
    write_whole(place, text.as_bytes())
}

/// Of all that makes measurements comparable: the scene, what is changed of it, what is compared and when.
fn fingerprint(args: &Args, rows: usize) -> Result<String> {
    let mut hasher = DefaultHasher::new();
    scene::read_text(&args.scene.path)?.hash(&mut hasher);
    let set: Vec<(&str, String)> =
        args.scene.set.iter().map(|(name, value)| (name.as_str(), value.to_string())).collect();
    (set, args.until.map(f64::to_bits), &args.outputs, rows, &args.reference).hash(&mut hasher);
    Ok(format!("{:016x}", hasher.finish()))
}

/// What was measured before.
fn resumed(place: &Path, fresh: WorkPrecision) -> Result<WorkPrecision> {
    let wrong = |problem: &str| Error::file(place, format!("{problem}; leave out --resume to begin anew"));
    let text = files::read_text(place).map_err(|_| wrong("there is no measurement to go on with"))?;
    let measured: WorkPrecision =
        serde_json::from_str(&text).map_err(|error| wrong(&format!("this is no measurement ({error})")))?;
    match measured.fingerprint == fresh.fingerprint {
        true => Ok(measured),
        false => Err(wrong("this is a measurement of another scene, or with other options")),
    }
}

/// A scene with parameters of its own.
fn variant(text: &str, args: &Args, like: &Study) -> Result<Variant> {
    let (path, set) = match text.rsplit_once(':') {
        Some((path, rest)) if rest.contains('=') => (path, rest),
        _ => (text, ""),
    };
    let pairs = set.split(',').filter(|pair| !pair.is_empty());
    let own = pairs.map(|pair| {
        let wrong = |_| Error::input(format!("`{pair}` is no parameter")).hint("write SCENE:NAME=VALUE,NAME=VALUE");
        assignment(pair).map_err(wrong)
    });
    let own: Vec<(String, Number)> = own.collect::<Result<_>>().map_err(|error| error.under("--variants"))?;
    let span = like.span()?;
    let overrides = Overrides { set: own, until: Some(span.end), ..args.overrides() };
    let study = args.talk.load(Path::new(path), &overrides).and_then(Study::settled).map_err(of_variants)?;
    let source = Some((PathBuf::from(path), overrides));
    Ok(Variant { name: named(Path::new(path), set), study, source })
}

/// A parameter at fault was given by `--variants`, not by `--set`.
fn of_variants(error: Error) -> Error {
    let Error::Input(mut input) = error else { return error };
    if input.path == "--set" {
        input.path = "--variants".to_string();
    }
    Error::Input(input)
}

/// The file's name and the parameters.
fn named(path: &Path, set: &str) -> String {
    let stem = path.file_stem().map_or(String::new(), |stem| stem.to_string_lossy().into_owned());
    if set.is_empty() { stem } else { format!("{stem}:{set}") }
}

fn models(args: &Args, study: Study) -> Result<ExitCode> {
    let mut others = Vec::new();
    for text in &args.variants {
        others.push(variant(text, args, &study)?);
    }
    let (name, title) = (study.name.clone(), format!("{}: what models cost", study.name));
    let set = args.scene.set.iter().map(|(name, value)| format!("{name}={value}")).collect::<Vec<_>>().join(",");
    let source = Some((args.scene.path.clone(), args.overrides()));
    let own = Variant { name: named(&args.scene.path, &set), study, source };
    let variants: Vec<Variant> = [own].into_iter().chain(others).collect();
    let mut folder = args.output.folder(&name)?;
    let repeats = usize::from(args.repeats);
    let bar = args.talk.progress((variants.len() * (repeats + 1) + 1) as u64, &name);
    let watch = |name: &str, done: usize| {
        bar.set_message(name.to_string());
        bar.set_position(done as u64);
    };
    let costs = compare(&variants, &args.outputs, (repeats, args.budget), watch);
    bar.finish_and_clear();
    let costs = costs?;
    let summary = ModelsSummary::new(&costs);
    folder.write_json("models.json", &summary)?;
    folder.write("models.csv", &models_table(&costs)?)?;
    args.output.figure(&mut folder, "models", models_figure(&title, &costs))?;
    let written = folder.finish()?;
    args.talk.print(&summary, || summary.text())?;
    if !args.talk.json && !args.talk.quiet {
        print(&format!("\nwritten to {}\n", written.listing()))?;
    }
    Ok(ExitCode::SUCCESS)
}
