//! `holonom import FILE`, URDF or MJCF

use super::common::{put, tell, to_json};
use crate::error::{Error, Result};
use crate::import::{Closure, Given, Options, import};
use crate::prepared::{Model, Overrides};
use crate::scene::Scene;
use std::path::PathBuf;

#[derive(clap::Args)]
#[command(after_help = "Examples:
  holonom import models/data/two_link.urdf --at shoulder=pi/4 --at elbow=-0.5
  holonom import models/data/double_pendulum.xml -o double_pendulum.json")]
pub struct Args {
    /// Robot in URDF, or model in MJCF; the root of the XML says which
    #[arg(value_name = "FILE")]
    path: PathBuf,
    /// Scene file to write (default: standard output)
    #[arg(short, value_name = "FILE")]
    output: Option<PathBuf>,
    /// Link of a URDF file that is the ground (default: the root of the tree)
    #[arg(long, value_name = "LINK")]
    base: Option<String>,
    /// The base of a URDF file moves freely, and is not the ground
    #[arg(long)]
    free: bool,
    /// Joint that closes a loop: [NAME=]revolute|spherical|weld:LINK@X,Y,Z:LINK@X,Y,Z[:axis=X,Y,Z], points and axis in the
    /// links' own frames
    #[arg(long, value_name = "JOINT", allow_hyphen_values = true)]
    close: Vec<Closure>,
    /// Position of a joint in the scene's guess, rad or m (default: 0, in MJCF `ref`); may be repeated
    #[arg(long, value_name = "JOINT=VALUE", allow_hyphen_values = true)]
    at: Vec<Given>,
    /// Print nothing but errors and the scene
    #[arg(long)]
    quiet: bool,
}

pub fn run(args: Args) -> Result<()> {
    let text = crate::files::read_text(&args.path).map_err(|error| Error::file(&args.path, error))?;
    let options = Options { base: args.base, is_free: args.free, closures: args.close, positions: args.at };
    let imported = import(&text, &options).map_err(|error| error.in_file(&args.path))?;
    let text = to_json(&imported.scene)?;
    put(&text, args.output.as_deref())?;
    if !args.quiet {
        imported.left_out.iter().for_each(|what| tell(format!("left out: {what}")));
        imported.warnings.iter().for_each(|what| tell(format!("warning: {what}")));
    }
    let ready = Scene::parse(&text, &[]).and_then(|scene| Model::new(scene, &Overrides::default()));
    match ready {
        Err(_) if imported.scene["bodies"].as_array().is_some_and(Vec::is_empty) => {
            tell("warning: no body moves\n  help: --free lets the base of a URDF file move freely");
        }
        Err(error) => tell(format!("warning: the scene does not start as it is: {error:#}")),
        Ok(_) => {}
    }
    Ok(())
}
