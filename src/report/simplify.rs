//! The least model that keeps a promise: text, table and figure.

use super::table::count;
use super::tables::{TableColumn, by_columns, optional};
use super::tradeoff::milliseconds;
use super::{Answer, Folder, TextTable, cell};
use crate::error::{Error, Result, percent, short_list};
use crate::math::bounds;
use crate::plot::{AxisSpec, Figure, Panel, Series, Style, Tint};
use crate::simplify::{ModelRun, Norm, Robustness, Simplification, Trial, Which};
use crate::study::work_precision::front;
use serde::Serialize;

impl Answer for Simplification {
    fn json(&self) -> impl Serialize {
        self
    }

    fn text(&self) -> String {
        let Simplification { scene, within, norm, outputs, trials, robustness, .. } = self;
        let size = match norm {
            Norm::Range => "range",
            Norm::Rms => "rms swing",
        };
        let mut text = format!("{scene}: within {} of the {size} of {}\n\n", percent(*within), short_list(outputs));
        text += &format!("{}\n", outcome(self));
        let mut changes = TextTable::new(&["tried", "estimated", "measured", "CPU", "result"]).words(4);
        for (trial, run) in trials.iter().filter_map(|trial| Some((trial, trial.run.as_ref()?))) {
            let measured = run.worst().map_or("-".to_string(), |worst| percent(worst.error));
            let result = if trial.is_kept { "kept" } else { first_line(&trial.reason) };
            let time = milliseconds(run.seconds);
            changes.row([name(trial), percent(trial.estimated), measured, time, result.to_string()]);
        }
        if trials.iter().any(|trial| trial.run.is_some()) {
            text += &format!(
                "{changes}  estimates are of an order only, and say what is tried first: what accumulates later is not in them\n"
            );
        }
        let left = trials.iter().filter(|trial| trial.run.is_none());
        for trial in left.clone().take(LISTED) {
            text += &format!("  not tried: {}: {}\n", name(trial), first_line(&trial.reason));
        }
        match left.count().saturating_sub(LISTED) {
            0 => {}
            more => text += &format!("  not tried: {more} more, in simplify.csv\n"),
        }
        robustness.iter().for_each(|robustness| text += &near(robustness, *within));
        text
    }

    fn write(&self, folder: &mut Folder, stem: &str) -> Result<()> {
        folder.table(stem, &by_columns(&COLUMNS, self.trials.iter())?)?;
        folder.figure(stem, simplify_figure(self))?;
        let scene = serde_json::to_string_pretty(&self.simplified).map_err(|error| Error::input(error.to_string()))?;
        folder.write("simplified.json", format!("{scene}\n").as_bytes())
    }
}

/// Number of changes that were not tried in the text.
const LISTED: usize = 5;

fn outcome(result: &Simplification) -> String {
    let Simplification { richest, chosen, runs, within, .. } = result;
    let mut text = if result.is_simpler() {
        String::new()
    } else {
        format!("  nothing can be left out: no simpler model keeps within {}\n", percent(*within))
    };
    for trial in result.left_out() {
        trial.what.iter().for_each(|what| text += &format!("  {what}\n"));
    }
    text += &match chosen.method.step {
        Some(step) => format!("  by {}, step {step:e} s\n", chosen.method.triple()),
        None => format!("  by {}, rtol {:e}\n", chosen.method.triple(), chosen.method.rtol),
    };
    let size =
        |run: &ModelRun| format!("{} and {}", count(run.velocities, "velocity"), count(run.constraints, "constraint"));
    let farthest =
        chosen.worst().map_or(String::new(), |worst| format!("{} is off by {}", worst.name, percent(worst.error)));
    let confirmed = result.second_opinion.iter().map(|opinion| format!("  the full model is {opinion}\n"));
    let confirmed: String = confirmed.collect();
    let before = format!("{} in {}", size(richest), milliseconds(richest.seconds));
    let after = format!("{} in {}", size(chosen), milliseconds(chosen.seconds));
    text + &format!(
        "  {after}, the full model {before}\n  {farthest}, all others by less\n{confirmed}  found by {runs} runs, with the work of {:.1} of the full model\n",
        result.cost
    )
}

/// What is done; to each of several, where that is the same.
fn name(trial: &Trial) -> String {
    let Trial { subjects, what, .. } = trial;
    let done = subjects.iter().zip(what).map(|(subject, what)| what.strip_prefix(subject.as_str()));
    match &done.collect::<Vec<_>>()[..] {
        [Some(first), rest @ ..] if !rest.is_empty() && rest.iter().all(|done| *done == Some(*first)) => {
            format!("each of {}{first}", short_list(subjects))
        }
        _ => short_list(what),
    }
}

fn first_line(text: &str) -> &str {
    text.lines().next().unwrap_or("")
}

fn near(robustness: &Robustness, within: f64) -> String {
    let Robustness { by, counted, kept, .. } = robustness;
    let worst = robustness.worst().map_or(0.0, |worst| worst.error);
    let left = |which, name: &str| match robustness.incomplete(which) {
        0 => String::new(),
        count => format!("; on {count} the {name} model does not complete"),
    };
    let start = match (robustness.positions, robustness.velocities) {
        (true, true) => Some("the positions and velocities at the start"),
        (true, false) => Some("the positions at the start"),
        (false, true) => Some("the velocities at the start"),
        (false, false) => None,
    };
    let parameters = (!robustness.parameters.is_empty()).then(|| short_list(&robustness.parameters));
    let inputs = (!robustness.inputs.is_empty()).then(|| short_list(&robustness.inputs));
    format!(
        "\n  within {} on {kept} of {counted} motions nearby, off by {} at most{}{}\n  moved by up to {}: {}\n",
        percent(within),
        percent(worst),
        left(Which::Simplified, "simplified"),
        left(Which::Richest, "richest"),
        percent(*by),
        parameters.into_iter().chain(start.map(str::to_string)).chain(inputs).collect::<Vec<_>>().join(", "),
    )
}

/// A row for each change: estimate, measurement, cost and result.
const COLUMNS: [TableColumn<Trial>; 11] = [
    ("candidate", |trial| trial.candidate.clone()),
    ("change", |trial| trial.what.join("; ")),
    ("estimated", |trial| cell(trial.estimated)),
    ("measured", |trial| optional(trial.run.as_ref().and_then(ModelRun::worst).map(|worst| worst.error))),
    ("worst", |trial| of_run(trial, |run| run.worst().map_or(String::new(), |worst| worst.name.clone()))),
    ("cpu_seconds", |trial| of_run(trial, |run| cell(run.seconds))),
    ("velocities", |trial| of_run(trial, |run| run.velocities.to_string())),
    ("constraints", |trial| of_run(trial, |run| run.constraints.to_string())),
    ("method", |trial| of_run(trial, |run| run.method.triple())),
    ("kept", |trial| trial.is_kept.to_string()),
    ("reason", |trial| trial.reason.clone()),
];

fn of_run(trial: &Trial, value: fn(&ModelRun) -> String) -> String {
    trial.run.as_ref().map_or(String::new(), value)
}

/// Factor of the axes around the points.
const MARGIN: f64 = 2.0;

/// Errors so many times below the promise are drawn there: they are as good as none.
const NEGLIGIBLE: f64 = 1e4;
/// Times that differ by less have a linear axis, since one of powers of ten would have a single mark.
const ALIKE: f64 = 10.0;

/// Draws the error of every model that was run against its CPU time: those that were kept, those that were not, the
/// front of all, and the promise; the richest and the chosen one are named. The axis has the errors of models that were
/// tried, and the richest one, whose error is its method's, at its end.
pub fn simplify_figure(result: &Simplification) -> Option<Figure> {
    let exact = |run: &ModelRun| run.worst().map(|worst| (run.seconds, worst.error)).filter(|(_, error)| *error > 0.0);
    let tried: Vec<(f64, f64)> = result.trials.iter().filter_map(|trial| trial.run.as_ref().and_then(exact)).collect();
    // Smaller errors are drawn at the least of the models that were tried, unless that is negligible.
    let least = tried.iter().map(|point| point.1).fold(result.within, f64::min).max(result.within / NEGLIGIBLE);
    let point = |run: &ModelRun| exact(run).map(|(seconds, error)| (seconds, error.max(least)));
    let of = |is_kept: bool| -> Vec<(f64, f64)> {
        let trials = result.trials.iter().filter(|trial| trial.is_kept == is_kept);
        trials.filter_map(|trial| trial.run.as_ref().and_then(point)).collect()
    };
    let kept = of(true);
    let refused = of(false);
    let points: Vec<(f64, f64)> = kept.iter().chain(&refused).copied().chain(point(&result.richest)).collect();
    let (x, right) = time_axis(points.iter().map(|point| point.0));
    let top = MARGIN * points.iter().map(|point| point.1).fold(result.within, f64::max);
    let y = AxisSpec::from("largest difference (relative)").log().range(least / MARGIN, top);
    let left = x.range.map_or(0.0, |range| range.0);
    let mut panel = Panel::new(x, y)
        .series(Series::dots("kept", kept))
        .series(Series::dots("not kept", refused).style(Style::Crosses))
        .series(
            Series::line("front", stairs(&front(points.iter().copied(), |point| *point), right)).style(Style::Guide),
        )
        .series(Series::line("promise", vec![(left, result.within), (right, result.within)]).style(Style::Dashed));
    for (run, name) in [(&result.richest, "as it is"), (&result.chosen, "chosen")] {
        let Some(((seconds, error), exact)) = point(run).zip(exact(run)) else { continue };
        let below = if exact.1 < least { format!(", off by {}", percent(exact.1)) } else { String::new() };
        let text = format!("{name}: {}{below}", count(run.velocities, "velocity"));
        panel =
            panel.series(Series::dots("", vec![(seconds, error)]).color(6)).note(Tint::Ink(0.0), seconds, error, text);
    }
    let hidden = tried.iter().any(|point| point.1 < least);
    let note = if hidden { format!(" (below {} drawn there)", percent(least)) } else { String::new() };
    let title = format!("{}: within {}{note}", result.scene, percent(result.within));
    (points.len() > 1).then(|| Figure::new().title(title).panel(panel.height(360.0)))
}

fn time_axis(times: impl Iterator<Item = f64>) -> (AxisSpec, f64) {
    let (least, most) = bounds(times);
    let axis = AxisSpec::from("CPU time (s)");
    if most < ALIKE * least {
        let end = 1.1 * most;
        (axis.range(0.0, end), end)
    } else {
        (axis.log().range(least / MARGIN, MARGIN * most), MARGIN * most)
    }
}

/// The least error at each cost, as a line.
fn stairs(front: &[(f64, f64)], end: f64) -> Vec<(f64, f64)> {
    let next = front.iter().skip(1).map(|point| point.0).chain([end]);
    front.iter().zip(next).flat_map(|(point, next)| [*point, (next, point.1)]).collect()
}
