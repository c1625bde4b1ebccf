//! `holonom validate SCENE`

use super::common::{positive, tell};
use super::linear::{AtStates, ChartOptions};
use crate::error::Result;
use crate::report::cell;
use crate::report::linear::{ValidationFile, validation_figure};
use crate::validate::{Direction, Settings, validate};
use std::process::ExitCode;

#[derive(clap::Args)]
#[command(after_help = "Examples:
  holonom validate models/four_bar_spring.json --at 0.3
  holonom validate models/pendulum.json --along random:7 --horizon 0.1")]
pub struct Args {
    #[command(flatten)]
    at: AtStates,
    /// Directions of the perturbation: random[:SEED] or names of states of the chart (default: random:1)
    #[arg(long, value_name = "DIRECTION[,DIRECTION...]", value_delimiter = ',')]
    along: Vec<String>,
    /// How long perturbed motions are followed, s (default: about a period of a usual mode)
    #[arg(long, value_name = "T", value_parser = positive, allow_negative_numbers = true)]
    horizon: Option<f64>,
    /// Leave the inputs out
    #[arg(long)]
    no_inputs: bool,
    #[command(flatten)]
    chart: ChartOptions,
}

pub fn run(args: Args) -> Result<ExitCode> {
    let prepared = args.at.load()?;
    let default = Settings::default();
    let directions = match args.along.as_slice() {
        [] => default.directions,
        names => names.iter().map(|name| Direction::parse(name)).collect(),
    };
    let settings = Settings { chart: args.chart.chart(), directions, horizon: args.horizon, inputs: !args.no_inputs };
    let (names, mut complaints) = (prepared.system().names(), Vec::new());
    args.at.conclude(&prepared, |place, folder| {
        let found = validate(place.system(), &place.state, &settings).map_err(args.at.in_file())?;
        let file = ValidationFile::new(&prepared.name, &names, &found);
        let stem = format!("validation-{}", cell(place.state.t));
        for (i, sequence) in found.sequences.iter().enumerate() {
            let title = format!(
                "{}, perturbed at t = {} s ({})",
                prepared.name,
                crate::error::significant(place.state.t, 6),
                sequence.direction
            );
            let name = if i == 0 { stem.clone() } else { format!("{stem}-{}", i + 1) };
            args.at.output.figure(folder, &name, validation_figure(&title, &names, sequence))?;
        }
        args.at.talk.say(&file.text(&found))?;
        if !file.is_right() {
            complaints.push(file.complaint());
        }
        folder.seal(&format!("{stem}.json"), args.at.talk.repeatable(&prepared, file))
    })?;
    for complaint in &complaints {
        tell(format!("error: {complaint}"));
    }
    Ok(if complaints.is_empty() { ExitCode::SUCCESS } else { ExitCode::from(1) })
}
