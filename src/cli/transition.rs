//! `holonom transition SCENE`

use super::common::positive;
use super::linear::AtStates;
use crate::error::Result;
use crate::linearize::{floquet, lyapunov};
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
        let exponents = |duration: f64| {
            let progress = args.at.talk.progress_between(0.0, duration, &prepared.name);
            // Columns are made orthonormal 500 times.
            lyapunov(place.system(), &place.state, duration, duration / 500.0, progress)
        };
        let lyapunov = args.lyapunov.map(exponents).transpose().map_err(in_file)?;
        let answer = Transition { scene: &prepared.name, t: place.state.t, floquet, lyapunov };
        args.at.add(folder, "transition", &prepared, place.state.t, &answer)
    })
}
