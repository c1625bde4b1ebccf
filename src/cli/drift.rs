//! `holonom drift SCENE`

use super::common::{Common, MethodOptions, Output};
use super::interrupt;
use crate::error::{Error, Failure, INTERRUPTED, Result};
use crate::integrator;
use crate::method_spec::MethodSpec;
use crate::prepared::Model;
use crate::report::{Ending, Shown, Stabilizations};
use crate::study::{StabilizedRun, drift_under_stabilizations, stabilizations};
use crate::view::{Extras, ShownMotion, page};
use std::process::ExitCode;

#[derive(clap::Args)]
#[command(mut_arg("formulation", |arg| arg.hide(true)), mut_arg("projection", |arg| arg.hide(true)))]
#[command(after_help = "Examples:
  holonom drift models/pendulum.json --until 2
  holonom drift models/pendulum.json --integrator rk4 --step 0.01 --until 1")]
pub struct Args {
    #[command(flatten)]
    common: Common,
    #[command(flatten)]
    output: Output,
    /// The page of `holonom view`, too: the run with the least drift, the others as ghosts
    #[arg(long)]
    view: bool,
}

pub fn run(args: Args) -> Result<ExitCode> {
    refuse_stabilization(&args.common.method)?;
    let prepared = load(&args.common)?;
    args.common.span(&prepared)?;
    let count = stabilizations(&prepared, 1.0)?.len();
    let mut folder = args.output.folder(&prepared.name)?;
    let bar = args.common.talk.progress(count as u64, "drift");
    let runs = drift_under_stabilizations(&prepared, || interrupt::stop(&folder), || bar.inc(1))?;
    bar.finish_and_clear();
    if args.view {
        view(&prepared, &runs).iter().try_for_each(|page| folder.write("stabilizations-view.html", page.as_bytes()))?;
    }
    let answer = Stabilizations { prepared: &prepared, runs };
    args.common.talk.publish(folder, "stabilizations", args.common.talk.origin(&prepared), &answer)?;
    fatal(&answer.runs).map_or(Ok(ExitCode::SUCCESS), |failure| Err(failure.clone().into()))
}

/// Returns the page of all runs with their own motion; none without any.
fn view(prepared: &Model, runs: &[StabilizedRun]) -> Option<String> {
    let mut shown: Vec<&StabilizedRun> = runs.iter().filter(|run| !run.motion.rows.is_empty()).collect();
    // Failed ones last, then by their drift.
    shown.sort_by(|a, b| a.drift.position.max.total_cmp(&b.drift.position.max));
    shown.sort_by_key(|run| run.failure.is_some());
    let (best, others) = shown.split_first()?;
    let ghosts = others.iter().map(|run| motion_of(prepared, run)).collect();
    Some(page(&motion_of(prepared, best), &Extras { ghosts, ..Extras::default() }))
}

fn motion_of<'a>(prepared: &'a Model, run: &'a StabilizedRun) -> ShownMotion<'a> {
    let ending = Ending::of(run.failure.as_ref(), &run.drift, run.energy.as_ref());
    let rows = Shown::of_trajectory(ending, &run.motion).rows;
    ShownMotion { label: run.method.clone(), rows, ..ShownMotion::new(prepared, &run.motion) }
}

/// Refuses a formulation or a projection, since all of them are compared.
fn refuse_stabilization(method: &MethodOptions) -> Result<()> {
    let given = [("--formulation", &method.formulation), ("--projection", &method.projection)];
    match given.into_iter().find(|(_, spec)| spec.is_some()) {
        None => Ok(()),
        Some((option, _)) => {
            Err(Error::input("`drift` compares every formulation and projection that the integrator goes with")
                .under(option)
                .hint("leave it out; `simulate` runs one of them, and writes its drift.csv"))
        }
    }
}

/// Loads the scene; with an integrator of the command line and the first formulation it accepts, since the comparison
/// does not depend on the scene's own.
fn load(common: &Common) -> Result<Model> {
    let mut overrides = common.overrides();
    if let Some(entry) = overrides.integrator.as_ref().and_then(|spec| integrator::find(spec).ok()) {
        overrides.formulation = entry.accepts().next().map(MethodSpec::named);
        overrides.projection = Some(MethodSpec::named("none"));
    }
    common.talk.load(&common.scene.path, &overrides)?.settled()
}

/// Returns the failure of the command: one failed stabilization is a result; all of them, or an interrupted one, are a
/// failed run.
fn fatal(rows: &[StabilizedRun]) -> Option<&Failure> {
    let failures: Vec<&Failure> = rows.iter().filter_map(|row| row.failure.as_ref()).collect();
    let interrupted = failures.iter().find(|failure| failure.reason == INTERRUPTED);
    interrupted.or(failures.last().filter(|_| failures.len() == rows.len())).copied()
}
