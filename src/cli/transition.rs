//! `holonom transition SCENE`

use super::common::positive;
use super::linear::AtStates;
use crate::error::{Result, significant};
use crate::linearize::{Defect, Floquet, Lyapunov, Operating, State, floquet, lyapunov};
use crate::plot::{Figure, Panel, Series};
use crate::prepared::PreparedScene;
use crate::report::{Table, cell};
use crate::tolerances::report as tolerances;
use serde_json::{Value, json};
use std::process::ExitCode;

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

pub fn run(args: Args) -> Result<ExitCode> {
    let prepared = args.at.load()?;
    let in_file = args.at.in_file();
    args.at.conclude(&prepared, |place, folder| {
        let state = &place.state;
        let mut result = json!({ "scene": prepared.name, "t": state.t });
        if let Some(period) = args.period {
            let found = floquet(place.system(), state, period).map_err(in_file)?;
            let defects = found.defects(tolerances::MULTIPLIER_OUTSIDE)?;
            args.at.talk.say(&floquet_text(&prepared, state, &found, &defects))?;
            result["floquet"] = floquet_json(&found, &defects);
        }
        if let Some(duration) = args.lyapunov {
            let found = exponents(&args, &prepared.name, place, duration).map_err(in_file)?;
            args.at.talk.say(&lyapunov_text(&prepared, state, &found))?;
            args.at.output.figure(folder, &format!("lyapunov-{}", cell(state.t)), figure(&prepared, &found))?;
            result["lyapunov"] = json!({ "times": found.times, "exponents": found.exponents });
        }
        let result = args.at.talk.repeatable(&prepared, result);
        folder.seal(&format!("transition-{}.json", cell(state.t)), result)
    })?;
    Ok(ExitCode::SUCCESS)
}

fn exponents(args: &Args, name: &str, place: &Operating, duration: f64) -> Result<Lyapunov> {
    let bar = args.at.talk.progress(1000, name);
    let progress = |t: f64| bar.set_position((1000.0 * t / duration) as u64);
    lyapunov(place.system(), &place.state, (duration, duration / RENEWALS), progress)
}

fn floquet_json(found: &Floquet, defects: &[Defect]) -> Value {
    let pairs = |values: &[crate::linearize::Complex<f64>]| -> Vec<[f64; 2]> {
        values.iter().map(|value| [value.re, value.im]).collect()
    };
    json!({
        "period": found.period,
        "gap": found.gap,
        "monodromy": found.monodromy.row_iter().map(|row| row.iter().copied().collect()).collect::<Vec<Vec<f64>>>(),
        "multipliers": pairs(&found.multipliers),
        "exponents": pairs(&found.exponents()),
        "multiplier_errors": found.errors,
        "multiplier_conditions": found.conditions.iter().map(|x| x.is_finite().then_some(*x)).collect::<Vec<_>>(),
        "stable": found.is_stable(tolerances::MULTIPLIER_OUTSIDE) && defects.is_empty(),
        "grows_like_t": !defects.is_empty(),
    })
}

fn floquet_text(prepared: &PreparedScene, state: &State, found: &Floquet, defects: &[Defect]) -> String {
    let mut table = Table::new(&["multiplier re", "im", "size", "grows by (1/s)"]);
    for (value, exponent) in found.multipliers.iter().zip(found.exponents()) {
        let cells = [value.re, value.im, value.norm(), exponent.re];
        table.row(cells.map(|x| significant(x, 7)));
    }
    let verdict = match (found.is_stable(tolerances::MULTIPLIER_OUTSIDE), defects.first()) {
        (false, _) => "small changes grow".to_string(),
        (true, None) => "no small change grows".to_string(),
        (true, Some(Defect { count, vectors, .. })) => format!(
            "small changes grow like t, no faster: a multiplier of size 1 counts {count} and has {vectors} vector{}",
            if *vectors == 1 { "" } else { "s" }
        ),
    };
    format!(
        "{} from t = {} s over the period {} s (returns to {:.1e}): {verdict}\n\n{table}",
        prepared.name,
        significant(state.t, 6),
        significant(found.period, 9),
        found.gap
    )
}

fn lyapunov_text(prepared: &PreparedScene, state: &State, found: &Lyapunov) -> String {
    let list = |values: &[f64]| values.iter().map(|x| significant(*x, 4)).collect::<Vec<String>>().join(", ");
    let half = found.exponents.get(found.exponents.len() / 2).map_or(&[][..], Vec::as_slice);
    let duration = found.times.last().copied().unwrap_or(0.0);
    format!(
        "{} from t = {} s: Lyapunov exponents over {} s, 1/s\n  {}\n  over half of it: {}\n",
        prepared.name,
        significant(state.t, 6),
        significant(duration, 6),
        list(found.last()),
        list(half)
    )
}

fn figure(prepared: &PreparedScene, found: &Lyapunov) -> Option<Figure> {
    let count = found.last().len();
    let line = |i: usize| {
        let points = found.times.iter().zip(&found.exponents).map(|(t, now)| (*t, now[i])).collect();
        Series::line(format!("exponent {}", i + 1), points)
    };
    let panel = (0..count).map(line).fold(Panel::new("time (s)", "average growth (1/s)"), Panel::series);
    (count > 0).then(|| Figure::new().title(format!("{}: Lyapunov exponents", prepared.name)).panel(panel))
}
