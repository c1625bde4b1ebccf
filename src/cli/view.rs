//! `holonom view SCENE`

use super::common::{Common, Output, fail, number, set_by};
use super::interrupt;
use crate::analysis::{Ledger, Recorder};
use crate::error::{Error, Failure, Result, clock};
use crate::linearize::{Linear, LinearModel};
use crate::method_spec::MethodSpec;
use crate::prepared::{Model, Overrides};
use crate::report::{Answer, Ending, FinishedRun, Folder, Shown};
use crate::simulate::Span;
use crate::trajectory::Trajectory;
use crate::view::{Extras, ROWS, ShownMotion, page};
use serde::Serialize;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

#[derive(clap::Args)]
#[command(mut_arg("figures", |arg| arg.hide(true)))]
#[command(after_help = "Examples:
  holonom view models/andrews.json
  holonom view models/flexible_pendulum.json --until 1 --modes")]
pub struct Args {
    #[command(flatten)]
    common: Common,
    #[command(flatten)]
    output: Output,
    /// Show a finished run in the place of a new one: its folder, such as out/NAME, whose parameters it takes
    #[arg(long, value_name = "DIR", conflicts_with_all = ["set", "equilibrium", "method", "formulation", "integrator",
          "projection", "rtol", "atol", "step", "adaptive", "until", "output_step"])]
    from: Option<PathBuf>,
    /// Largest number of rows; fewer where a page has no room for them
    #[arg(long, value_name = "N", default_value_t = ROWS as u16, value_parser = clap::value_parser!(u16).range(2..=20_000))]
    rows: u16,
    /// The mode shapes, too, of the linear model at the time of --at
    #[arg(long)]
    modes: bool,
    /// Time of the modes, s (default: the start)
    #[arg(long, value_name = "T", value_parser = number, allow_negative_numbers = true, requires = "modes")]
    at: Option<f64>,
    /// Other finished runs of this scene as ghosts: their folders
    #[arg(long, value_name = "DIR", num_args = 1..)]
    with: Vec<PathBuf>,
}

/// A motion with all that a page shows of it.
struct ViewedMotion {
    prepared: Model,
    trajectory: Trajectory,
    drift: Vec<[f64; 3]>,
    energy: Vec<Ledger>,
    failure: Option<Failure>,
    /// Rows before those that a divergence has spoilt.
    shown: Shown,
}

/// A page, as its JSON describes it.
#[derive(Serialize)]
struct Viewed {
    scene: String,
    status: &'static str,
    failure: Option<Failure>,
    /// Size of the page, bytes.
    bytes: usize,
    #[serde(skip)]
    page: String,
}

pub fn run(args: Args) -> Result<ExitCode> {
    let mut folder = None;
    let seen = match &args.from {
        Some(path) => args.finished(path, "--from")?,
        None => {
            let prepared = args.common.load()?;
            let span = args.common.span(&prepared)?;
            let folder = folder.insert(args.output.folder(&prepared.name)?);
            args.simulate(prepared, span, folder)?
        }
    };
    let folder = folder.map_or_else(|| args.output.folder(&seen.prepared.name), Ok)?;
    let with = |path: &PathBuf| args.finished(path, "--with").map(|seen| (label(path), seen));
    let ghosts = args.with.iter().map(with).collect::<Result<Vec<_>>>()?;
    let model = args.modes.then(|| args.model(&seen.prepared)).transpose()?;
    let extras = Extras {
        ghosts: ghosts.iter().map(|(label, seen)| seen.run(label)).collect(),
        model: model.as_ref(),
        notes: seen.notes(),
        rows: args.rows.into(),
    };
    let page = page(&seen.run("this run"), &extras);
    let failed = args.from.is_none().then(|| seen.failure.clone()).flatten();
    let status = if seen.failure.is_some() { "failed" } else { "completed" };
    let viewed =
        Viewed { scene: seen.prepared.name.clone(), status, failure: seen.failure.clone(), bytes: page.len(), page };
    args.common.talk.publish(folder, "view", args.common.talk.origin(&seen.prepared), &viewed)?;
    failed.map_or(Ok(ExitCode::SUCCESS), |failure| fail(Error::from(failure)))
}

/// Returns the name of a run: that of its folder.
fn label(path: &Path) -> String {
    path.file_name().map_or_else(|| path.display().to_string(), |name| name.to_string_lossy().into_owned())
}

impl Args {
    fn finished(&self, path: &Path, option: &str) -> Result<ViewedMotion> {
        let run = FinishedRun::read(path, false).map_err(|error| error.under(option))?;
        let overrides = Overrides { set: run.parameters.clone(), ..Overrides::default() };
        let prepared = self.common.talk.load(&self.common.scene.path, &overrides);
        let prepared = prepared.map_err(|error| set_by(error, option))?;
        let drift = run.drift()?;
        let energy = run.energy()?;
        let failure = run.failure.clone();
        let ending = run.ending;
        let trajectory = run.trajectory(prepared.system())?;
        if trajectory.names.q.is_empty() || trajectory.rows.is_empty() {
            return Err(Error::input(
                "the coordinates were left out of this run, so that its mechanism cannot be shown",
            )
            .under(option)
            .hint("simulate without --outputs-only"));
        }
        let shown = Shown::of_trajectory(ending, &trajectory);
        Ok(ViewedMotion { prepared, trajectory, drift, energy, failure, shown })
    }

    /// Runs the scene, with as many rows as the page shows.
    fn simulate(&self, prepared: Model, span: Span, folder: &Folder) -> Result<ViewedMotion> {
        let length = span.end - span.start;
        let mut recorder = Recorder::new(prepared.system())
            .with_progress(self.common.talk.progress_between(span.start, span.end, &prepared.name))
            .with_stop(|| interrupt::stop(folder));
        let output_step = length / f64::from(self.rows - 1);
        let (outcome, _) = prepared.simulate(&prepared.method, Span { output_step, ..span }, &mut recorder)?;
        let record = recorder.finish();
        let ending = Ending::of(outcome.failure.as_ref(), &record.drift, record.energy.as_ref());
        let shown = Shown::of_trajectory(ending, &record.trajectory);
        Ok(ViewedMotion {
            prepared,
            trajectory: record.trajectory,
            drift: record.drift_rows,
            energy: record.ledger_rows,
            failure: outcome.failure,
            shown,
        })
    }

    fn model(&self, prepared: &Model) -> Result<LinearModel> {
        let t = self.at.unwrap_or_else(|| prepared.start_time());
        let state = prepared.states_at(&[t]).map_err(|error| error.under("--at"))?.swap_remove(0);
        let request = Linear { method: MethodSpec::named("mcs"), chart: None };
        let in_file = |error: Error| error.in_file(&self.common.scene.path);
        let mut variation = state.variation(prepared).map_err(in_file)?;
        let model = variation.linearize(&request).map_err(in_file)?;
        self.common.talk.warn(&model.doubt());
        Ok(model)
    }
}

impl ViewedMotion {
    fn notes(&self) -> Vec<String> {
        let stopped = |failure: &Failure| format!("this run stopped at t = {} s: {}", clock(failure.t), failure.reason);
        self.failure.as_ref().map(stopped).into_iter().chain(self.shown.note()).collect()
    }

    fn run(&self, label: &str) -> ShownMotion<'_> {
        ShownMotion {
            label: label.to_string(),
            rows: self.shown.rows,
            drift: &self.drift,
            energy: &self.energy,
            ..ShownMotion::new(&self.prepared, &self.trajectory)
        }
    }
}

impl Answer for Viewed {
    fn json(&self) -> impl Serialize {
        self
    }

    fn text(&self) -> String {
        let size = self.bytes.div_ceil(1000);
        format!("{}: a page of {size} kB; open it in a browser\n", self.scene)
    }

    fn write(&self, folder: &mut Folder, stem: &str) -> Result<()> {
        folder.write(&format!("{stem}.html"), self.page.as_bytes())
    }
}
