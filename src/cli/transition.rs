//! `holonom transition SCENE`

use super::common::positive;
use super::linear::AtStates;
use crate::error::Result;
use crate::linearize::{Lyapunov, Operating, floquet, lyapunov};
use crate::report::linear::Transition;
use crate::tolerances;

#[derive(clap::Args)]
#[command(group = clap::ArgGroup::new("what").required(true).multiple(true))]
#[command(after_help = "Examples:
  holonom transition models/double_pendulum.json --lyapunov 1
  holonom transition models/pendulum.json --lyapunov 1 --json")]
pub struct Args {
    #[command(flatten)]
    at: AtStates,
    /// Period of the motion from the state, s: its Floquet multipliers and stability
    #[arg(long, value_name = "T", value_parser = positive, allow_negative_numbers = true, group = "what")]
    period: Option<f64>,
    /// Average growth of small changes over a time, s: the Lyapunov exponents
    #[arg(long, value_name = "T", value_parser = positive, allow_negative_numbers = true, group = "what")]
    lyapunov: Option<f64>,
}

/// Number of times that columns are made orthonormal.
const RENEWALS: f64 = 500.0;

pub fn run(args: Args) -> Result<()> {
    let prepared = args.at.load()?;
    let in_file = args.at.in_file();
    args.at.conclude(&prepared, |place, folder| {
        let floquet = match args.period {
            Some(period) => {
                let found = floquet(place.system(), &place.state, period).map_err(in_file)?;
                let defects = found.defects(tolerances::MULTIPLIER_OUTSIDE)?;
                Some((found, defects))
            }
            None => None,
        };
        let lyapunov = args.lyapunov.map(|duration| exponents(&args, &prepared.name, place, duration)).transpose();
        let lyapunov = lyapunov.map_err(in_file)?;
        let answer = Transition { scene: &prepared.name, t: place.state.t, floquet, lyapunov };
        args.at.add(folder, "transition", (&prepared, place.state.t), &answer)
    })
}

fn exponents(args: &Args, name: &str, place: &Operating, duration: f64) -> Result<Lyapunov> {
    let bar = args.at.talk.progress(1000, name);
    let progress = |t: f64| bar.set_position((1000.0 * t / duration) as u64);
    lyapunov(place.system(), &place.state, (duration, duration / RENEWALS), progress)
}
