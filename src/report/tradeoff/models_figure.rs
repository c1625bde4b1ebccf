//! Differences of models from the richest against their CPU time.

use crate::measure::work_precision::models::{ModelCost, ModelCosts};
use crate::plot::{AxisSpec, Figure, Panel, Series, Style};

/// One line an output, through the models by their time, each of which is named once. `None` where nothing differs.
pub fn models_figure(title: &str, costs: &ModelCosts) -> Option<Figure> {
    let mut poorer: Vec<&ModelCost> = costs.models.iter().filter(|model| model.seconds().is_some()).collect();
    poorer.sort_by(|a, b| a.seconds().unwrap_or(0.0).total_cmp(&b.seconds().unwrap_or(0.0)));
    let points = |name: &str| -> Vec<(f64, f64)> {
        let of = |model: &&ModelCost| {
            let output = model.outputs.iter().find(|output| output.name == name)?;
            Some((model.seconds()?, output.max)).filter(|_| output.max > 0.0)
        };
        poorer.iter().filter_map(of).collect()
    };
    let label = "largest difference (part of the largest value)";
    let mut panel = Panel::new(AxisSpec::from("CPU time (s)").log(), AxisSpec::from(label).log());
    for column in &costs.columns {
        let points = points(&column.name);
        if !points.is_empty() {
            panel = panel.series(Series::line(&column.name, points).style(Style::LineDots));
        }
    }
    for model in &poorer {
        if let (Some(seconds), Some(error)) = (model.seconds(), model.error().filter(|error| *error > 0.0)) {
            panel = panel.annotate(seconds, error, &model.name);
        }
    }
    (!panel.series.is_empty()).then(|| Figure::new().title(title).panel(panel.height(360.0)))
}
