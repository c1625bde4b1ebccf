//! `holonom models [TAG]`

use super::common::{json_files, print_result};
use crate::error::{Error, Result};
use crate::report::TextTable;
use serde::{Deserialize, Serialize};
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

#[derive(clap::Args)]
#[command(after_help = "Examples:
  holonom models
  holonom models linkage")]
pub struct Args {
    /// Only scenes with this tag, such as linkage, vehicle, robot, flexible or machine
    tag: Option<String>,
    /// Folder of the scenes
    #[arg(long, value_name = "DIR", default_value = "models")]
    folder: PathBuf,
    /// Print as JSON
    #[arg(long)]
    json: bool,
}

/// The keys of a scene that tell what it is.
#[derive(Deserialize, Serialize)]
struct Listed {
    #[serde(default)]
    file: String,
    #[serde(default)]
    about: String,
    #[serde(default)]
    tags: Vec<String>,
    /// Without bodies a file is no scene.
    #[serde(rename = "bodies", skip_serializing)]
    _bodies: Vec<serde::de::IgnoredAny>,
}

pub fn run(args: Args) -> Result<()> {
    let mut scenes = scenes(&args.folder)?;
    if let Some(tag) = &args.tag {
        let known: BTreeSet<String> = scenes.iter().flat_map(|scene| scene.tags.clone()).collect();
        scenes.retain(|scene| scene.tags.contains(tag));
        if scenes.is_empty() {
            return Err(Error::unknown("tag", tag, known.iter().map(String::as_str)));
        }
    }
    print_result(args.json, &scenes, || {
        let mut table = TextTable::left(&["scene", "tags", "about"]);
        for Listed { file, about, tags, .. } in &scenes {
            let first = about.split_inclusive(". ").next().unwrap_or_default().trim_end();
            table.row([file.clone(), tags.join(" "), first.to_string()]);
        }
        table.to_string()
    })
}

fn scenes(folder: &Path) -> Result<Vec<Listed>> {
    let paths = json_files(folder).map_err(|problem| Error::file(folder, problem).hint(ELSEWHERE))?;
    Ok(paths.iter().filter_map(|path| scene(path)).collect())
}

const ELSEWHERE: &str = "run it where the folder `models` of holonom is, or give --folder";

fn scene(path: &Path) -> Option<Listed> {
    let listed: Listed = serde_json::from_str(&std::fs::read_to_string(path).ok()?).ok()?;
    Some(Listed { file: path.display().to_string(), ..listed })
}
