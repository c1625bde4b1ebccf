//! `holonom simplify SCENE --within P%`

use super::common::{Output, SceneOptions, Talk, duration, fail, number};
use super::interrupt;
use crate::error::{Error, Result};
use crate::prepared::Overrides;
use crate::simplify::{Nearby, Norm, SimplificationSettings, Source, registry, simplify};
use clap::ValueEnum;
use std::process::ExitCode;
use std::time::Duration;

#[derive(clap::Args)]
#[command(after_help = "Examples:
  holonom simplify models/flexible_slider_crank_fe.json --within 10%
  holonom simplify models/pendulum.json --within 1% --until 2 --outputs x,y --json")]
pub struct Args {
    #[command(flatten)]
    scene: SceneOptions,
    /// Allowed difference of every watched output from the scene as it is, such as 5%
    #[arg(long, value_name = "P%", value_parser = percentage, allow_hyphen_values = true)]
    within: f64,
    /// Outputs that the promise is about (default: all)
    #[arg(long, value_name = "NAME[,NAME...]", value_delimiter = ',')]
    outputs: Vec<String>,
    /// Base of relative differences
    #[arg(long, value_enum, default_value_t = NormOption::Range)]
    norm: NormOption,
    /// Runs in all, two of them of the scene as it is, and work in runs of that
    #[arg(long, value_name = "N", default_value_t = 15, value_parser = clap::value_parser!(u16).range(3..))]
    at_most: u16,
    /// Time for all of it, such as 20s or 5min (default: no limit)
    #[arg(long, value_name = "TIME", value_parser = duration, allow_hyphen_values = true)]
    budget: Option<Duration>,
    /// Keep the promise on motions nearby, too: parameters, inputs, signals and the start, moved by up to so much
    #[arg(long, value_name = "P%", value_parser = percentage, allow_hyphen_values = true)]
    robust: Option<f64>,
    /// Number of motions nearby (default: from 20 to 60, by the work of a run)
    #[arg(long, value_name = "N", requires = "robust", value_parser = clap::value_parser!(u16).range(1..))]
    samples: Option<u16>,
    /// End time, s
    #[arg(long, value_name = "T", value_parser = number, allow_negative_numbers = true)]
    until: Option<f64>,
    #[command(flatten)]
    output: Output,
    #[command(flatten)]
    talk: Talk,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum NormOption {
    /// Largest difference over the range of the output; of energies over the swing of the kinetic energy, of what
    /// hardly moves over a thousandth of the motion
    Range,
    /// Root mean square of the difference over that of the output about its mean
    Rms,
}

/// Reads a part in per cent, above 0 and below 100.
pub fn percentage(text: &str) -> Result<f64, String> {
    let wrong = || "write a part in per cent, such as 5% or 0.1%".to_string();
    let value = number(text.trim().strip_suffix('%').ok_or_else(wrong)?)?;
    (value > 0.0 && value < 100.0).then_some(0.01 * value).ok_or("it must be above 0 % and below 100 %".to_string())
}

pub fn run(args: Args) -> Result<ExitCode> {
    let overrides = Overrides { until: args.until, ..args.scene.overrides() };
    let prepared = args.talk.load(&args.scene.path, &overrides)?;
    let name = prepared.name.clone();
    let source = Source::load(&args.scene.path, &overrides)?;
    let folder = args.output.folder(&name)?;
    let own = folder.path().join("simplified.json").canonicalize();
    if own.is_ok_and(|own| args.scene.path.canonicalize().is_ok_and(|scene| scene == own)) {
        return Err(Error::input("simplified.json of that folder is the scene itself")
            .under("-o")
            .hint("name another folder"));
    }
    let bar = args.talk.progress(args.at_most.into(), &name);
    let mut watch = |what: &str, done: usize| {
        bar.set_message(what.to_string());
        bar.set_position(done as u64);
    };
    let found = simplify(&source, &args.settings(), registry(), &interrupt::is_asked, &mut watch);
    bar.finish_and_clear();
    let found = found?;
    args.talk.warn(&found.warnings);
    args.talk.publish(folder, "simplify", args.talk.origin(&prepared), &found)?;
    if interrupt::is_asked() {
        return fail("interrupted\n  help: the model is the least one until then");
    }
    let help = "give the scene a tighter rtol and atol, or a shorter motion by --until";
    found.broken().map_or(Ok(ExitCode::SUCCESS), |broken| fail(format!("{broken}\n  help: {help}")))
}

impl Args {
    fn settings(&self) -> SimplificationSettings {
        let samples = self.samples.map(usize::from);
        SimplificationSettings {
            within: self.within,
            norm: match self.norm {
                NormOption::Range => Norm::Range,
                NormOption::Rms => Norm::Rms,
            },
            outputs: self.outputs.clone(),
            at_most: self.at_most.into(),
            budget: self.budget,
            nearby: self.robust.map(|by| Nearby { by, samples }),
        }
    }
}
