//! `holonom completions SHELL` and `holonom man`

use super::Cli;
use super::common::{Talk, print};
use crate::error::{Error, Result};
use crate::report::Folder;
use clap::CommandFactory;
use clap_complete::Shell;
use std::path::PathBuf;

#[derive(clap::Args)]
#[command(after_help = "Examples:
  holonom completions bash
  holonom completions zsh")]
pub struct Completions {
    /// The shell
    #[arg(value_enum)]
    shell: Shell,
}

#[derive(clap::Args)]
#[command(after_help = "Examples:
  holonom man
  holonom man -o man/man1")]
pub struct Man {
    /// Folder for a page of each command (default: the page of holonom on standard output)
    #[arg(short, value_name = "DIR")]
    output: Option<PathBuf>,
    #[command(flatten)]
    talk: Talk,
}

pub fn completions(args: Completions) -> Result<()> {
    let mut script = Vec::new();
    clap_complete::generate(args.shell, &mut Cli::command(), "holonom", &mut script);
    print(&String::from_utf8_lossy(&script))
}

pub fn man(args: Man) -> Result<()> {
    let mut command = Cli::command();
    command.build();
    let Some(path) = &args.output else {
        return print(&String::from_utf8_lossy(&page(command)?));
    };
    let mut folder = Folder::create(path)?;
    let pages: Vec<clap::Command> =
        command.get_subcommands().filter(|one| one.get_name() != "help" && !one.is_hide_set()).cloned().collect();
    folder.write("holonom.1", &page(command)?)?;
    for one in pages {
        let name = format!("holonom-{}", one.get_name());
        folder.write(&format!("{name}.1"), &page(one.display_name(name))?)?;
    }
    args.talk.tell_files(&folder.finish()?)
}

fn page(command: clap::Command) -> Result<Vec<u8>> {
    let mut page = Vec::new();
    let failed = |error: std::io::Error| Error::unwritten("manual page", error.to_string());
    clap_mangen::Man::new(command).render(&mut page).map_err(failed)?;
    Ok(page)
}
