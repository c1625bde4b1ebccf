//! `holonom bode SCENE`

use super::common::positive;
use super::linear::{AtStates, ModelOptions};
use crate::error::{Error, Result, Warning, clock, find, short};
use crate::linearize::{Complex, LinearModel, Resonances, frequency_response};
use crate::prepared::Model;
use crate::report::linear::{FrequencyResponse, Magnitude, Response};
use crate::system::Column;

#[derive(clap::Args)]
#[command(after_help = "Examples:
  holonom bode models/quarter_car.json --equilibrium
  holonom bode models/quarter_car.json --equilibrium --from 0.1 --to 100 --points 200")]
pub struct Args {
    #[command(flatten)]
    at: AtStates,
    /// Lowest frequency, Hz (default: a tenth of that of the slowest mode)
    #[arg(long, value_name = "F", value_parser = positive, allow_negative_numbers = true)]
    from: Option<f64>,
    /// Highest frequency, Hz (default: ten times that of the fastest mode)
    #[arg(long, value_name = "F", value_parser = positive, allow_negative_numbers = true)]
    to: Option<f64>,
    /// Number of frequencies with a constant factor between them (default: 400, and more at lightly damped modes)
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(2..=1_000_000))]
    points: Option<u32>,
    /// Inputs (default: all)
    #[arg(long = "input", value_name = "NAME[,NAME...]", value_delimiter = ',')]
    inputs: Vec<String>,
    /// Outputs (default: all)
    #[arg(long = "output", value_name = "NAME[,NAME...]", value_delimiter = ',')]
    outputs: Vec<String>,
    /// Magnitudes in the figure in their unit on a logarithmic axis, as in the files (default: in dB of it)
    #[arg(long)]
    absolute: bool,
    #[command(flatten)]
    model: ModelOptions,
}

/// Indices of the chosen inputs and outputs.
struct Chosen {
    inputs: Vec<usize>,
    outputs: Vec<usize>,
}

pub fn run(args: Args) -> Result<()> {
    let in_file = args.at.in_file();
    let request = args.model.request()?;
    let prepared = args.at.load()?;
    let inputs = prepared.system().facts().inputs.clone();
    let outputs = prepared.system().facts().outputs.clone();
    let chosen = Chosen {
        inputs: choose("input", &args.inputs, &inputs).map_err(in_file)?,
        outputs: choose("output", &args.outputs, &outputs)
            .map_err(|error| accumulated(&args.outputs, &prepared.system().facts().works).unwrap_or(error))
            .map_err(in_file)?,
    };
    args.at.conclude(&prepared, |state, folder| {
        let model = state.variation().map_err(in_file)?.linearize(&request).map_err(in_file)?;
        args.at.talk.warn(&moving(&model));
        let frequencies = frequencies(&args, &model)?;
        let response = respond(&args, &prepared, model, &chosen, frequencies);
        args.at.add(folder, "bode", &prepared, response.model.point.t, &response)
    })
}

/// Warning for a state off equilibrium, where A(t) is not constant and no transfer function is that of the motion.
fn moving(model: &LinearModel) -> Option<Warning> {
    let t = clock(model.point.t);
    let text = format!(
        "at t = {t} s the mechanism is not in equilibrium: this is the response of its equations frozen there, which holds \
         at frequencies far above those of the motion, and belongs to the chart ({})",
        model.chart
    );
    (!model.point.is_equilibrium).then(|| Warning::new(text, "--equilibrium finds the equilibrium near the state"))
}

/// Why works among the named outputs, or the only ones, have no response.
fn accumulated(named: &[String], works: &[Column]) -> Option<Error> {
    let work = works.iter().find(|work| named.is_empty() || named.contains(&work.name))?;
    let text = format!("`{}` is a work, which adds up along the motion: it is no function of the state", work.name);
    Some(Error::input(text).under("--output").hint("name an output of the state, such as the power of the same force"))
}

fn choose(what: &str, named: &[String], known: &[Column]) -> Result<Vec<usize>> {
    if known.is_empty() {
        let example = match what {
            "input" => {
                r#""inputs": [{ "name": "push", "force": NAME, "component": "x" }], with the NAME of one of its forces"#
            }
            _ => {
                r#""outputs": [{ "name": "x", "measure": "position", "of": NAME, "component": "x" }], with the NAME of a body"#
            }
        };
        return Err(Error::input(format!("the scene has no {what}s, so there is no frequency response"))
            .hint(format!("add to the scene {example}")));
    }
    let place = |name: &String| {
        let known = known.iter().map(|column| column.name.as_str());
        find(what, name, known).map_err(|error| error.under(format!("--{what}")))
    };
    if named.is_empty() { Ok((0..known.len()).collect()) } else { named.iter().map(place).collect() }
}

fn frequencies(args: &Args, model: &LinearModel) -> Result<Vec<f64>> {
    let around = Resonances::around(model);
    let range = Resonances { from: args.from.unwrap_or(around.from), to: args.to.unwrap_or(around.to) };
    if range.from >= range.to {
        let message = format!("the frequencies go from {} Hz to {} Hz", short(range.from), short(range.to));
        let option = if args.to.is_some() { "--to" } else { "--from" };
        return Err(Error::input(message).under(option).hint("give --from F1 and --to F2 with F1 below F2"));
    }
    Ok(match args.points {
        Some(count) => range.frequencies(count as usize),
        None => range.with_peaks(400, model),
    })
}

fn respond<'p>(
    args: &Args,
    prepared: &'p Model,
    model: LinearModel,
    chosen: &Chosen,
    frequencies: Vec<f64>,
) -> FrequencyResponse<'p> {
    let inputs = prepared.system().facts().inputs.clone();
    let outputs = prepared.system().facts().outputs.clone();
    let found = frequency_response(&model, &frequencies);
    let pole = Complex::new(f64::NAN, f64::NAN);
    let pair = |i: usize, j: usize| Response {
        input: inputs[j].name.clone(),
        output: outputs[i].name.clone(),
        input_unit: inputs[j].unit.clone(),
        output_unit: outputs[i].unit.clone(),
        values: found.iter().map(|matrix| matrix.as_ref().map_or(pole, |matrix| matrix[(i, j)])).collect(),
    };
    let pairs = chosen.inputs.iter().flat_map(|&j| chosen.outputs.iter().map(move |&i| (i, j)));
    let responses = pairs.map(|(i, j)| pair(i, j)).collect();
    let magnitude = if args.absolute { Magnitude::Absolute } else { Magnitude::Decibel };
    FrequencyResponse { scene: &prepared.name, model, frequencies, responses, magnitude }
}
