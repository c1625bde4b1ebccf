//! `holonom guide [CHAPTER]`

use super::common::print;
use crate::error::{Result, find};
use crate::guide::CHAPTERS;

#[derive(clap::Args)]
#[command(after_help = "Examples:
  holonom guide
  holonom guide tutorial")]
pub struct Args {
    /// Chapter to print (default: the list of chapters)
    chapter: Option<String>,
}

pub fn run(args: Args) -> Result<()> {
    let text = match &args.chapter {
        None => CHAPTERS.iter().map(|chapter| format!("{:<16} {}\n", chapter.name, chapter.title())).collect(),
        Some(name) => CHAPTERS[find("chapter", name, CHAPTERS.iter().map(|chapter| chapter.name))?].body(),
    };
    print(&text)
}
