//! `holonom loci SCENE`

use super::common::{MethodOptions, Output, SceneOptions, Talk, fail, number, positive};
use super::linear::ModelOptions;
use super::linearize::unlike;
use crate::error::{Error, Result, short};
use crate::linearize::{At, Gap, Kind, Linear, Loci, Variants, loci_along, loci_over, refuse_large, within_run};
use crate::prepared::Model;
use crate::report::linear::LociAnswer;
use crate::report::{Answer, Sealed, uncertain_kinds};
use crate::sweep::{Family, Range};
use std::path::{Path, PathBuf};
use std::process::ExitCode;

#[derive(clap::Args)]
#[command(after_help = "Examples:
  holonom loci models/pendulum.json --until 1 --every 0.1
  holonom loci models/four_bar_spring.json --sweep k1=10..1000:10:log --unit N/m --equilibrium")]
pub struct Args {
    #[command(flatten)]
    scene: SceneOptions,
    /// Time between two states of the motion, s (default: a sixtieth of the run)
    #[arg(long, value_name = "DT", value_parser = positive, allow_negative_numbers = true, conflicts_with = "sweep")]
    every: Option<f64>,
    /// Time of the first state, s (default: the start)
    #[arg(long, value_name = "T", value_parser = number, allow_negative_numbers = true, conflicts_with = "sweep")]
    from: Option<f64>,
    /// Vary a parameter instead of time, such as k1=10..1000:50, or k1=10..1000:50:log with a constant factor; at the
    /// start of each scene unless --at or --equilibrium says otherwise
    #[arg(long, value_name = "NAME=A..B[:N][:log]")]
    sweep: Option<Range>,
    /// With --sweep: unit of the parameter, such as N/m (default: that of a steady rotation by --equilibrium, else none).
    /// A speed of rotation (rad/s, deg/s, rev/s, rpm) gives a Campbell diagram with the lines 1x and 2x
    #[arg(long, value_name = "UNIT", requires = "sweep")]
    unit: Option<String>,
    /// With --sweep: at this time of each motion, s
    #[arg(long, value_name = "T", value_parser = number, allow_negative_numbers = true, requires = "sweep")]
    at: Option<f64>,
    /// With --sweep: at the static equilibrium of each scene, followed from value to value
    #[arg(long, requires = "sweep", conflicts_with = "at")]
    equilibrium: bool,
    /// Another scene of the mechanism, such as simplified.json: which modes it has lost, and how far others shift
    #[arg(long, value_name = "SCENE")]
    against: Option<PathBuf>,
    #[command(flatten)]
    model: ModelOptions,
    #[command(flatten)]
    run: MethodOptions,
    #[command(flatten)]
    talk: Talk,
    #[command(flatten)]
    output: Output,
}

pub fn run(args: Args) -> Result<ExitCode> {
    let in_file = |error: Error| error.in_file(&args.scene.path);
    let request = args.model.request()?;
    let prepared = args.run.load_tight(&args.scene, &args.talk)?;
    refuse_large(prepared.system().dimensions().v).map_err(in_file)?;
    let mut folder = args.output.folder(&prepared.name)?;
    let loci = loci(&args, &args.scene, &prepared, &request).map_err(in_file)?;
    if loci.reached.is_empty() {
        return none(&args, &loci);
    }
    args.talk.warn(&loci.doubts);
    let uncertain = loci.branches.iter().filter(|branch| branch.kind == Kind::Uncertain);
    let other = args.against.as_ref().map(|path| other(&args, &prepared, path, &request)).transpose()?;
    args.talk.warn(&uncertain_kinds(uncertain.map(|_| loci.method.as_str())));
    let other = other.as_ref().map(|(name, other)| (name.as_str(), other));
    let answer = LociAnswer::new(&prepared.name, &loci, args.unit.as_deref(), other);
    answer.stage(&mut folder, "loci", args.talk.origin(&prepared))?;
    let origin = Some(args.talk.origin(&prepared));
    args.talk.conclude(folder, &Sealed { origin, result: answer.summary(), files: Vec::new() }, || answer.text())?;
    // Any value of a parameter makes the loci incomplete; of a motion only the end does.
    match (&args.sweep, loci.gaps.first(), loci.gaps.last()) {
        (Some(Range { parameter, count, .. }), Some(Gap { at, error }), _) => {
            let gaps = loci.gaps.len();
            fail(format!("{gaps} of {count} values have no eigenvalues; at {parameter} = {}: {error:#}", short(*at)))
        }
        (None, _, Some(Gap { error: error @ Error::Run(_), .. })) => fail(error),
        _ => Ok(ExitCode::SUCCESS),
    }
}

fn loci(args: &Args, scene: &SceneOptions, prepared: &Model, request: &Linear) -> Result<Loci> {
    if let Some(range) = &args.sweep {
        return over(args, scene, prepared, range, request);
    }
    let times = times(args, prepared)?;
    let bar = args.talk.progress(times.len() as u64, &prepared.name);
    Ok(loci_along(prepared, request, &times, || bar.inc(1)))
}

fn other(args: &Args, own: &Model, path: &Path, request: &Linear) -> Result<(String, Loci)> {
    let scene = SceneOptions { path: path.to_path_buf(), set: Vec::new() };
    let prepared = args.run.load_tight(&scene, &args.talk)?;
    args.talk.warn(&unlike(own, &prepared)?);
    // Of two scenes the message has to say which.
    let found = loci(args, &scene, &prepared, request).map_err(|error| error.element(&prepared.name).in_file(path))?;
    Ok((prepared.name, found))
}

fn times(args: &Args, prepared: &Model) -> Result<Vec<f64>> {
    let start = prepared.start_time();
    let end = prepared.span()?.end;
    let from = args.from.unwrap_or(start);
    if !(start..end).contains(&from) {
        let message =
            format!("t = {} s is not within the run, from {} s to {} s", short(from), short(start), short(end));
        return Err(Error::input(message).under("--from").hint("begin earlier, or run longer with --until T"));
    }
    let every = args.every.unwrap_or((end - from) / 60.0);
    let count = (end - from) / every;
    match count {
        // Rounding must not lose the end.
        _ if (1.0 - 1e-9..1e5).contains(&count) => {
            let last = (count + 1e-9).floor();
            Ok(Range::new("t", (from, (from + last * every).min(end)), last as usize + 1)?.values())
        }
        _ => {
            let message = format!("states every {} s over {} s", short(every), short(end - from));
            Err(Error::input(message)
                .under("--every")
                .hint("give a time shorter than the run, and above a 100 000th of it"))
        }
    }
}

fn over(args: &Args, scene: &SceneOptions, prepared: &Model, range: &Range, request: &Linear) -> Result<Loci> {
    let at = match args.at {
        Some(t) => within_run(prepared, &[t]).map(|()| At::Time(t))?,
        None if args.equilibrium => At::Equilibrium,
        None => At::Start,
    };
    let overrides = args.run.overrides(scene, None);
    let family = Family::load_with(&scene.path, &overrides)?;
    let variants = Variants { family: &family, overrides: &overrides, range };
    let bar = args.talk.progress(range.count as u64, &range.parameter);
    loci_over(&variants, at, request, || bar.inc(1)).map_err(|error| error.under("--sweep"))
}

/// Handles the case that no state has eigenvalues: wrong input, or a failure everywhere.
fn none(args: &Args, loci: &Loci) -> Result<ExitCode> {
    let Some(gap) = loci.gaps.first() else { return Ok(ExitCode::from(1)) };
    match &gap.error {
        Error::Input(input) if input.path.starts_with('-') => Err(gap.error.clone().in_file(&args.scene.path)),
        error => {
            let name = args.sweep.as_ref().map_or("t", |range| range.parameter.as_str());
            fail(format!("no state has eigenvalues; at {name} = {}: {error:#}", short(gap.at)))
        }
    }
}
