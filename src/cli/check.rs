//! `holonom check SCENE`

use super::common::{Common, number};
use crate::error::Result;
use crate::initial::equilibrium;
use crate::report::{self, EquilibriumReport};
use crate::simplify::{Hints, hints, registry};
use std::process::ExitCode;

#[derive(clap::Args)]
#[command(after_help = "Examples:
  holonom check models/parallelogram_redundant.json
  holonom check models/four_bar_spring.json --static")]
pub struct Args {
    #[command(flatten)]
    common: Common,
    /// Find the static equilibrium that belongs to the start
    #[arg(long = "static")]
    is_static: bool,
    /// Time that expressions of t are held at for the equilibrium, s (default: that of the start)
    #[arg(long, value_name = "T", value_parser = number, allow_negative_numbers = true, requires = "is_static")]
    at: Option<f64>,
}

pub fn run(args: Args) -> Result<ExitCode> {
    let prepared = args.common.load()?;
    let mut check = report::check(&prepared);
    let t = args.at.unwrap_or(prepared.start_time());
    let sought = args.is_static.then(|| equilibrium(prepared.system(), t, prepared.start()));
    // Bad input is an error; a search without success is a result.
    let (found, failure) = match sought.transpose() {
        Ok(found) => (found.map(|found| EquilibriumReport::of(&prepared, found)), None),
        Err(error) if error.exit_code() == 1 => (Some(EquilibriumReport::none(t)), Some(error)),
        Err(error) => return Err(error.in_file(&args.common.scene.path)),
    };
    check.equilibrium = found;
    let hints = hints(prepared, &args.common.scene.path, &args.common.overrides(), registry());
    check.hints = Some(hints.unwrap_or_else(|error| Hints { skipped: format!("{error:#}"), ..Hints::default() }));
    args.common.talk.warn(check.equilibrium.iter().flat_map(|rest| &rest.warnings));
    args.common.talk.print(&check, || check.text())?;
    failure.map_or(Ok(ExitCode::SUCCESS), Err)
}
