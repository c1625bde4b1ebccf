//! Cost and accuracy of models: text, table and figure.

use super::milliseconds;
use crate::error::{Result, percent};
use crate::plot::{AxisSpec, Figure, Panel, Series, Tint};
use crate::report::tables::optional;
use crate::report::{Answer, Folder, TextTable, table};
use crate::study::work_precision::models::{Finer, ModelCost, ModelCosts};
use serde::Serialize;

/// Models with what they cost, and with recommendations.
#[derive(Serialize)]
pub struct ModelsAnswer<'a> {
    #[serde(flatten)]
    costs: &'a ModelCosts,
    recommendations: Vec<ModelAdvice>,
    #[serde(skip)]
    title: String,
}

/// The cheapest model within a tolerance of the richest.
#[derive(Serialize)]
struct ModelAdvice {
    within: f64,
    model: String,
    sentence: String,
}

impl<'a> ModelsAnswer<'a> {
    pub fn new(scene: &str, costs: &'a ModelCosts) -> ModelsAnswer<'a> {
        // Differences below the error of the full model itself mean nothing.
        let told = costs.uncertainty().map_or(0.0, |(error, _)| error);
        let mut recommendations: Vec<ModelAdvice> = [0.1, 0.01, 1e-3, 1e-4]
            .iter()
            .filter(|within| **within >= told)
            .filter_map(|within| advice(costs, *within))
            .collect();
        // Only the first recommendation of the full model is kept.
        recommendations.dedup_by(|a, b| a.model == b.model && b.model == costs.models[costs.richest].name);
        ModelsAnswer { costs, recommendations, title: format!("{scene}: what models cost") }
    }

    fn errors(&self, model: &ModelCost) -> Vec<String> {
        let of = |name: &str| {
            let output = model.outputs.iter().find(|output| output.name == name);
            output.map_or("-".to_string(), |output| percent(output.max))
        };
        let outputs = self.costs.columns.iter().map(|column| of(&column.name));
        [model.name.clone()].into_iter().chain(outputs).collect()
    }
}

impl Answer for ModelsAnswer<'_> {
    fn json(&self) -> impl Serialize {
        self
    }

    fn text(&self) -> String {
        let ModelCosts { models, richest, rows, .. } = self.costs;
        let rich = &models[*richest];
        let mut text = format!("models against the full model, {}, at {rows} times of the motion\n\n", rich.name);
        text += &convergence(self.costs);
        for advice in &self.recommendations {
            text += &format!("  {}\n", advice.sentence);
        }
        let mut costs = TextTable::new(&["model", "q", "v", "constraints", "CPU", "numerics", "method"]).words(6);
        models.iter().for_each(|model| costs.row(cost(model)));
        let outputs = self.costs.columns.iter().map(|column| column.name.as_str());
        let mut errors = TextTable::new(&["largest difference"].into_iter().chain(outputs).collect::<Vec<_>>());
        models.iter().for_each(|model| errors.row(self.errors(model)));
        let failures = models.iter().filter_map(|model| Some((model, model.failure.as_ref()?)));
        let lines = failures.map(|(model, failure)| {
            format!("\n  {} FAILED at t = {:.4e} s: {}", model.name, failure.t, failure.reason)
        });
        format!("{text}\n{costs}\n{errors}{}", lines.collect::<String>())
    }

    fn write(&self, folder: &mut Folder, stem: &str) -> Result<()> {
        folder.table(stem, &models_table(self.costs)?)?;
        folder.figure(stem, models_figure(&self.title, self.costs))
    }
}

fn convergence(costs: &ModelCosts) -> String {
    let Finer { velocities, failure, .. } = &costs.finer;
    let mesh = match velocities {
        Some(_) => "with twice its elements",
        None => "without a mesh to refine, with a hundredth of its tolerance",
    };
    let text = match (costs.uncertainty(), failure) {
        (Some((error, output)), _) if error > 0.01 => {
            let error = percent(error);
            format!(
                "the full model is NOT converged: {mesh} {output} changes by {error}; what is nearer cannot be told"
            )
        }
        (Some((error, output)), _) => {
            format!("the full model is converged: {mesh} {output} changes by {} at most", percent(error))
        }
        (None, Some(failure)) => {
            format!("whether the full model is converged is not known: {mesh}: {}", failure.reason)
        }
        (None, None) => "whether the full model is converged is not known".to_string(),
    };
    format!("  {text}\n\n")
}

fn cost(model: &ModelCost) -> Vec<String> {
    let counts = [model.coordinates, model.velocities, model.constraints].map(|count| count.to_string());
    let time = model.seconds().map_or("-".to_string(), milliseconds);
    let numerics = model.numerical_error.map_or("-".to_string(), |error| format!("{error:.0e}"));
    let method = format!("{}, rtol {:e}", model.method.triple(), model.method.rtol);
    [model.name.clone()].into_iter().chain(counts).chain([time, numerics, method]).collect()
}

/// Returns the cheapest model that has all outputs within this of the richest's; none where only the richest has.
fn advice(costs: &ModelCosts, within: f64) -> Option<ModelAdvice> {
    let rich = &costs.models[costs.richest];
    let is_good = |model: &&ModelCost| {
        model.outputs.len() == costs.columns.len() && model.error().is_some_and(|error| error <= within)
    };
    let time = |model: &ModelCost| model.seconds().unwrap_or(f64::INFINITY);
    let best = costs.models.iter().filter(is_good).min_by(|a, b| time(a).total_cmp(&time(b)))?;
    let against = if best.name == rich.name {
        "no poorer model is as near".to_string()
    } else {
        format!("the full model takes {}", milliseconds(rich.seconds()?))
    };
    let sentence = format!(
        "within {} in all outputs: {}, {}; {against}",
        percent(within),
        best.name,
        milliseconds(best.seconds()?)
    );
    Some(ModelAdvice { within, model: best.name.clone(), sentence })
}

/// Returns one row for each model: size, time and the differences of each output.
fn models_table(costs: &ModelCosts) -> Result<Vec<u8>> {
    let own = ["model", "coordinates", "velocities", "constraints", "method", "cpu_seconds", "numerical_error"];
    let outputs =
        costs.columns.iter().flat_map(|column| [format!("{} max", column.name), format!("{} rms", column.name)]);
    let headings: Vec<String> = own.map(String::from).into_iter().chain(outputs).collect();
    let row = |model: &ModelCost| {
        let counts = [model.coordinates, model.velocities, model.constraints].map(|count| count.to_string());
        let errors = costs.columns.iter().flat_map(|column| {
            let output = model.outputs.iter().find(|output| output.name == column.name);
            [optional(output.map(|output| output.max)), optional(output.map(|output| output.rms))]
        });
        let times = [optional(model.seconds()), optional(model.numerical_error)];
        let own = [model.name.clone()].into_iter().chain(counts).chain([model.method.triple()]).chain(times);
        own.chain(errors).collect()
    };
    table(headings.into_iter(), costs.models.iter().map(row))
}

/// Draws a dot for each output of each model, whose name stands at the largest. `None` where nothing differs.
fn models_figure(title: &str, costs: &ModelCosts) -> Option<Figure> {
    let mut poorer: Vec<&ModelCost> = costs.models.iter().filter(|model| model.seconds().is_some()).collect();
    poorer.sort_by(|a, b| a.seconds().unwrap_or(0.0).total_cmp(&b.seconds().unwrap_or(0.0)));
    let points = |name: &str| -> Vec<(f64, f64)> {
        let of = |model: &&ModelCost| {
            let output = model.outputs.iter().find(|output| output.name == name)?;
            Some((model.seconds()?, output.max)).filter(|_| output.max > 0.0)
        };
        poorer.iter().filter_map(of).collect()
    };
    let times: Vec<f64> = poorer.iter().filter_map(|model| model.seconds()).collect();
    let (least, most) = times.iter().fold((f64::INFINITY, 0.0f64), |(a, b), time| (a.min(*time), b.max(*time)));
    let x = AxisSpec::from("CPU time (s)").log().range(least / 1.5, 1.5 * most);
    let mut panel = Panel::new(x, AxisSpec::from("largest difference (relative)").log());
    for column in &costs.columns {
        let points = points(&column.name);
        if !points.is_empty() {
            panel = panel.series(Series::dots(&column.name, points));
        }
    }
    for model in &poorer {
        if let (Some(seconds), Some(error)) = (model.seconds(), model.error().filter(|error| *error > 0.0)) {
            // The part of the name that differs is enough.
            let name = model.name.rsplit_once(':').map_or(model.name.as_str(), |(_, set)| set);
            panel = panel.note(Tint::Ink(0.0), seconds, error, name);
        }
    }
    (!panel.series.is_empty()).then(|| Figure::new().title(title).panel(panel.height(360.0)))
}
