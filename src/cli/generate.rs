//! `holonom generate NAME --n N`

use super::common::{pick, put, to_json};
use crate::error::Result;
use crate::scene::generate;
use std::path::PathBuf;

#[derive(clap::Args)]
#[command(after_help = "Examples:
  holonom generate chain --n 20 -o chain.json
  holonom generate n_four_bar")]
pub struct Args {
    /// Kind of scene: n_four_bar, chain or flexible_chain
    name: String,
    /// Number of loops or links
    #[arg(long, default_value_t = 10, value_parser = count, allow_negative_numbers = true)]
    n: usize,
    /// File to write (default: standard output)
    #[arg(short, value_name = "FILE")]
    output: Option<PathBuf>,
}

/// Larger scenes are probably a mistake.
const MOST: usize = 1_000_000;

fn count(text: &str) -> Result<usize, String> {
    text.parse().ok().filter(|n| (1..=MOST).contains(n)).ok_or_else(|| format!("give a whole number from 1 to {MOST}"))
}

pub fn run(args: Args) -> Result<()> {
    let names: Vec<&str> = generate::registry().iter().map(|(name, _)| *name).collect();
    let name = pick("scene to generate", &args.name, &names)?;
    let made = generate::registry().iter().find(|(known, _)| *known == name).map(|(_, make)| make(args.n));
    put(&to_json(&made)?, args.output.as_deref())
}
