//! Differences of models from the richest against their CPU time.

use crate::compare::work_precision::models::{ModelCost, ModelCosts};
use crate::plot::{AxisSpec, Figure, Panel, Series};

/// Of the axis of time, on both sides.
const MARGIN: f64 = 1.5;

/// A dot an output of each model, whose name stands at the largest. `None` where nothing differs.
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
    let times: Vec<f64> = poorer.iter().filter_map(|model| model.seconds()).collect();
    let (least, most) = times.iter().fold((f64::INFINITY, 0.0f64), |(a, b), time| (a.min(*time), b.max(*time)));
    let x = AxisSpec::from("CPU time (s)").log().range(MARGIN.recip() * least, MARGIN * most);
    let mut panel = Panel::new(x, AxisSpec::from("largest difference (relative)").log());
    for column in &costs.columns {
        let points = points(&column.name);
        if !points.is_empty() {
            panel = panel.series(Series::dots(&column.name, points));
        }
    }
    for model in &poorer {
        if let (Some(seconds), Some(error)) = (model.seconds(), model.error().filter(|error| *error > 0.0)) {
            // What differs is enough.
            let name = model.name.rsplit_once(':').map_or(model.name.as_str(), |(_, set)| set);
            panel = panel.annotate(seconds, error, name);
        }
    }
    (!panel.series.is_empty()).then(|| Figure::new().title(title).panel(panel.height(360.0)))
}
