//! `holonom check SCENE`

use super::common::Common;
use crate::error::Result;
use crate::report;
use std::process::ExitCode;

#[derive(clap::Args)]
pub struct Args {
    #[command(flatten)]
    common: Common,
}

pub fn run(args: Args) -> Result<ExitCode> {
    let study = args.common.load()?;
    let check = report::check(&study);
    args.common.talk.print(&check, || check.text())?;
    Ok(ExitCode::SUCCESS)
}
