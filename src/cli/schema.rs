//! `holonom schema`

use super::common::{print, to_json};
use crate::error::Result;
use std::process::ExitCode;

pub fn run() -> Result<ExitCode> {
    print(&(to_json(&crate::prepared::schema(&crate::scene::Elements::default()))? + "\n"))?;
    Ok(ExitCode::SUCCESS)
}
