//! `holonom kinematics SCENE NAME=A..B:N`

use super::common::{Output, SceneOptions, Talk, fail};
use crate::error::{Result, Warning, find};
use crate::report::{SweepAnswer, SweepLook};
use crate::sweep::{Family, Range, Sweep};
use crate::system::Column;
use std::process::ExitCode;

#[derive(clap::Args)]
#[command(after_help = "Examples:
  holonom kinematics models/five_link_kinematics.json travel=-0.08..0.08:21 --outputs camber,toe --against wheel_travel
  holonom kinematics models/double_wishbone.json rack=-0.06..0.06:25 --json")]
pub struct Args {
    #[command(flatten)]
    scene: SceneOptions,
    /// The parameter and its values, such as travel=-0.08..0.08:81 (without :N, 81 values)
    #[arg(value_name = "NAME=A..B[:N]")]
    range: Range,
    /// Outputs in the figure (default: all)
    #[arg(long, value_name = "NAME[,NAME...]", value_delimiter = ',')]
    outputs: Vec<String>,
    /// Output along the horizontal axis of the figure, in the place of the parameter
    #[arg(long, value_name = "NAME")]
    against: Option<String>,
    /// One panel an output (default: one for those of a unit whose ranges are alike)
    #[arg(long)]
    separate: bool,
    #[command(flatten)]
    output: Output,
    #[command(flatten)]
    talk: Talk,
}

pub fn run(args: Args) -> Result<ExitCode> {
    let family = Family::load_with(&args.scene.path, &args.scene.overrides())?;
    let known = family.outputs()?;
    known_output(&known, &args.outputs).map_err(|error| error.under("--outputs"))?;
    known_output(&known, args.against.as_slice()).map_err(|error| error.under("--against"))?;
    args.talk.warn(&family.doubts());
    let bar = args.talk.progress(args.range.count as u64, &args.range.parameter);
    let sweep = family.sweep(&args.range, |done| bar.set_position(done as u64))?;
    bar.finish_and_clear();
    args.talk.warn(&moves_nothing(&sweep));
    let look = SweepLook { outputs: &args.outputs, against: args.against.as_deref(), separate: args.separate };
    let answer = SweepAnswer { sweep: &sweep, look };
    let folder = args.output.folder(&sweep.scene)?;
    args.talk.publish(folder, "kinematics", args.talk.origin_of(&family.scene()?.parameters), &answer)?;
    answer.failure().map_or(Ok(ExitCode::SUCCESS), fail)
}

fn moves_nothing(sweep: &Sweep) -> Option<Warning> {
    let name = &sweep.range.parameter;
    let text = format!("`{name}` changes no position: `kinematics` assembles positions and simulates nothing");
    let hint = format!(
        "simulate variants by `holonom study SCENE --vary {name}=A..B:N`, or follow eigenvalues by `holonom loci SCENE --sweep {name}=A..B`"
    );
    sweep.moves_nothing().then(|| Warning::new(text, hint))
}

fn known_output(known: &[Column], names: &[String]) -> Result<()> {
    let names_of = || known.iter().map(|column| column.name.as_str());
    names.iter().try_for_each(|name| find("output", name, names_of()).map(drop))
}
