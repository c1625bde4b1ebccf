//! Models and methods together: the error of the model and that of the method, against cost.

use super::{accuracy, milliseconds};
use crate::error::{Result, percent};
use crate::plot::{AxisSpec, Figure, Panel, Series, Style};
use crate::report::table::count;
use crate::report::{Answer, Folder, TextTable, cell as number, table};
use crate::study::work_precision::{Cell, WorkPrecision, front};
use serde::Serialize;

/// The models of a scene, the richest first, each by many methods.
#[derive(Clone, Debug, Serialize)]
pub struct ModelsAndMethods {
    pub scene: String,
    pub models: Vec<MeasuredModel>,
}

/// A model with its error, and the runs of methods on it.
#[derive(Clone, Debug, Serialize)]
pub struct MeasuredModel {
    /// Name, such as `within 10 %`.
    pub name: String,
    /// What it leaves out.
    pub left_out: Vec<String>,
    pub velocities: usize,
    pub constraints: usize,
    /// Largest difference of its reference from that of the richest, relative to the size of the output; none where one
    /// of them is missing, zero of the richest.
    pub error: Option<f64>,
    /// The output with that difference.
    pub worst: String,
    /// Runs, with errors against the model's own reference.
    pub measured: WorkPrecision,
}

impl MeasuredModel {
    /// A model against the richest; that one where there is none.
    pub fn new(
        name: String,
        left_out: Vec<String>,
        velocities: usize,
        constraints: usize,
        measured: WorkPrecision,
        richest: Option<&MeasuredModel>,
    ) -> Self {
        let own = measured.reference.as_ref().map(|reference| &reference.values);
        let against = match richest {
            None => own.map(|_| (0.0, String::new())),
            Some(richest) => {
                richest.measured.reference.as_ref().zip(own).map(|(rich, own)| rich.values.error(&own.rows))
            }
        };
        let (error, worst) = against.unzip();
        MeasuredModel { name, left_out, velocities, constraints, error, worst: worst.unwrap_or_default(), measured }
    }

    /// Runs with their cost, and the error of the model and of the method together.
    fn runs(&self) -> impl Iterator<Item = (&Cell, f64, f64)> {
        self.measured.cells.iter().filter_map(|cell| Some((cell, cell.cost?, self.error? + cell.error()?)))
    }
}

impl Answer for ModelsAndMethods {
    fn json(&self) -> impl Serialize {
        self
    }

    /// Returns the models, and the cheapest run for each error.
    fn text(&self) -> String {
        self.models_text() + &self.runs_text()
    }

    fn write(&self, folder: &mut Folder, stem: &str) -> Result<()> {
        folder.table(stem, &auto_table(self)?)?;
        folder.figure(stem, auto_figure(self))
    }
}

impl ModelsAndMethods {
    fn models_text(&self) -> String {
        let text = format!("{}: models and methods, errors together\n\n", self.scene);
        let mut models =
            TextTable::new(&["model", "velocities", "constraints", "its error", "in", "left out"]).words(4).words(5);
        for model in &self.models {
            let error = model.error.map_or("not known".to_string(), percent);
            let v = model.velocities.to_string();
            let c = model.constraints.to_string();
            let left_out = match &model.left_out[..] {
                [] => String::new(),
                [one] => one.clone(),
                [one, rest @ ..] => format!("{one}; {} more", rest.len()),
            };
            models.row([model.name.clone(), v, c, error, model.worst.clone(), left_out]);
        }
        text + &format!("{models}\n")
    }

    fn runs_text(&self) -> String {
        let headings = ["error below", "model", "method", "accuracy", "CPU", "of the model", "of the method"];
        let mut best = TextTable::new(&headings).words(1).words(2);
        for within in [0.1, 0.01, 1e-3, 1e-4, 1e-6] {
            if let Some((model, cell, cost)) = self.cheapest(within) {
                best.row([
                    percent(within),
                    model.name.clone(),
                    cell.method.triple(),
                    accuracy(&cell.method),
                    milliseconds(cost),
                    percent(model.error.unwrap_or(0.0)),
                    percent(cell.error().unwrap_or(0.0)),
                ]);
            }
        }
        let left_out = self.models.iter().filter_map(|model| Some((model, model.measured.left_out.as_ref()?)));
        // A measurement of models is not gone on with.
        let what = |what: &str| what.split(';').next().unwrap_or("").to_string();
        let left_out = left_out.map(|(model, text)| format!("  left out of {}: {}\n", model.name, what(text)));
        format!("{best}\n{}", left_out.collect::<String>())
    }

    fn cheapest(&self, within: f64) -> Option<(&MeasuredModel, &Cell, f64)> {
        let runs = self.models.iter().flat_map(|model| model.runs().map(move |run| (model, run)));
        let good = runs.filter(|(_, (_, _, error))| *error <= within);
        let best = good.min_by(|a, b| a.1.1.total_cmp(&b.1.1));
        best.map(|(model, (cell, cost, _))| (model, cell, cost))
    }
}

/// Returns one row for each run of each model.
fn auto_table(summary: &ModelsAndMethods) -> Result<Vec<u8>> {
    let headings = ["model", "method", "rtol", "step", "cost", "model_error", "method_error", "error"];
    let row = |(model, (cell, cost, error)): (&MeasuredModel, (&Cell, f64, f64))| {
        let step = cell.method.step.map_or(String::new(), number);
        let numbers = [cost, model.error.unwrap_or(0.0), cell.error().unwrap_or(0.0), error].map(number);
        let own = [model.name.clone(), cell.method.triple(), number(cell.method.rtol), step];
        own.into_iter().chain(numbers).collect()
    };
    let runs = summary.models.iter().flat_map(|model| model.runs().map(move |run| (model, run)));
    table(headings.map(String::from).into_iter(), runs.map(row))
}

/// Draws the front of the methods of each model against cost: errors of model and method together, which fall with the
/// tolerance down to the error of the model, and each alone. `None` where no run was completed.
fn auto_figure(summary: &ModelsAndMethods) -> Option<Figure> {
    let points = |model: &MeasuredModel, error: fn((&Cell, f64, f64)) -> Option<f64>| -> Vec<(f64, f64)> {
        front(model.runs().filter_map(|run| Some((run.1, error(run)?))), |point| *point)
    };
    let together = |model: &MeasuredModel| {
        let mut line = points(model, |(_, _, both)| Some(both));
        let mut last = f64::INFINITY;
        line.retain(|(_, error)| {
            let is_less = *error < (1.0 - 0.02) * last;
            last = if is_less { *error } else { last };
            is_less
        });
        line
    };
    let costs = summary.models.iter().flat_map(|model| model.runs().map(|(_, cost, _)| cost));
    let (least, most) = costs.fold((f64::INFINITY, 0.0f64), |(low, high), cost| (low.min(cost), high.max(cost)));
    let axis = |label: &str| AxisSpec::from(label).log();
    let mut panel = Panel::new(axis("CPU time (s)").range(least / MARGIN, MARGIN * most), axis("error (relative)"));
    for (color, model) in summary.models.iter().enumerate() {
        let name = format!("{}, {}", model.name, count(model.velocities, "velocity"));
        panel = panel.series(Series::line(name, together(model)).style(Style::LineDots).color(color));
    }
    let simpler = summary
        .models
        .iter()
        .enumerate()
        .filter_map(|(color, model)| Some((color, model, model.error.filter(|error| *error > 0.0)?)));
    for (place, (color, model, error)) in simpler.enumerate() {
        let level = vec![(least / MARGIN, error), (MARGIN * most, error)];
        let alone = points(model, |(cell, _, _)| cell.error());
        let names = if place == 0 { ["the model alone", "the method alone"] } else { ["", ""] };
        panel = panel.series(Series::line(names[0], level).style(Style::Dashed).color(color));
        panel = panel.series(Series::line(names[1], alone).style(Style::Dotted).color(color));
    }
    let title = format!("{}: errors of models and methods", summary.scene);
    (most > 0.0).then(|| Figure::new().title(title).panel(panel.height(400.0)))
}

const MARGIN: f64 = 1.2;
