//! The linear model against perturbed simulations.

use crate::plot::{AxisSpec, Figure, Panel, Series, Style};
use crate::report::figures::quantity;

/// Errors of a prediction over the size of the perturbation, of the model that varies along the motion (LTV) and of the
/// frozen one (LTI).
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ErrorOrder {
    /// In the unit of `norm`.
    pub epsilons: Vec<f64>,
    pub ltv: Vec<f64>,
    pub lti: Vec<f64>,
    /// What is measured, such as `error of the final state`.
    pub what: String,
}

/// How far a quantity of the perturbed motion is from that of the nominal one, and as predicted.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Deviation {
    pub name: String,
    pub unit: String,
    pub simulated: Vec<f64>,
    pub ltv: Vec<f64>,
    pub lti: Vec<f64>,
}

/// Errors over epsilon with a line of slope 2; then, for each unit, deviations over time with both predictions. `None`
/// where there is neither.
pub fn validation_figure(title: &str, order: &ErrorOrder, times: &[f64], deviations: &[Deviation]) -> Option<Figure> {
    let mut panels: Vec<Panel> = order_panel(order).into_iter().collect();
    let mut units: Vec<(&str, Vec<&Deviation>)> = Vec::new();
    for deviation in deviations.iter().filter(|_| times.len() > 1) {
        match units.iter_mut().find(|(unit, _)| *unit == deviation.unit) {
            Some((_, members)) => members.push(deviation),
            None => units.push((&deviation.unit, vec![deviation])),
        }
    }
    panels.extend(units.iter().map(|(unit, members)| deviation_panel(unit, members, times)));
    let figure = Figure { panels, ..Figure::new().title(title) };
    (!figure.panels.is_empty()).then_some(figure)
}

fn order_panel(order: &ErrorOrder) -> Option<Panel> {
    let what = if order.what.is_empty() { "error of the prediction" } else { &order.what };
    let pairs = |errors: &[f64]| -> Vec<(f64, f64)> {
        let pairs = order.epsilons.iter().copied().zip(errors.iter().copied());
        pairs.filter(|(epsilon, error)| *epsilon > 0.0 && *error > 0.0).collect()
    };
    let (ltv, lti) = (pairs(&order.ltv), pairs(&order.lti));
    let mut panel = Panel::new(AxisSpec::from("perturbation ε").log(), AxisSpec::from(what).log());
    // Below the errors, through the largest perturbation.
    let largest = ltv.iter().chain(&lti).map(|point| point.0).fold(0.0, f64::max);
    let smallest = ltv.iter().chain(&lti).map(|point| point.0).fold(largest, f64::min);
    let anchor = ltv.iter().chain(&lti).filter(|point| point.0 == largest).map(|point| point.1).reduce(f64::min)?;
    let guide = |epsilon: f64| (epsilon, 0.3 * anchor * (epsilon / largest).powi(2));
    for (label, points, color) in [("LTV (along the motion)", ltv, 0), ("LTI (frozen)", lti, 1)] {
        if !points.is_empty() {
            panel = panel.series(Series::line(label, points).style(Style::LineDots).color(color));
        }
    }
    Some(panel.series(Series::line("slope 2", vec![guide(smallest), guide(largest)]).style(Style::Guide)))
}

fn deviation_panel(unit: &str, members: &[&Deviation], times: &[f64]) -> Panel {
    let [first, others @ ..] = members else { return Panel::default() };
    let what = if others.is_empty() { first.name.as_str() } else { quantity(unit) };
    let label = if unit.is_empty() { format!("change of {what}") } else { format!("change of {what} ({unit})") };
    let mut panel = Panel::new("time (s)", label);
    let line =
        |name: String, values: &[f64]| Series::line(name, times.iter().copied().zip(values.iter().copied()).collect());
    let is_alone = others.is_empty();
    for (i, member) in members.iter().enumerate() {
        let name = if is_alone { "simulated".to_string() } else { member.name.clone() };
        panel = panel.series(line(name, &member.simulated).color(i));
    }
    for (i, member) in members.iter().enumerate() {
        // The styles mean the same for all members: one entry for each is enough.
        let once = |name: &str| if i == 0 { name.to_string() } else { String::new() };
        let colors = if is_alone { [1, 2] } else { [i, i] };
        panel = panel
            .series(line(once("predicted, LTV"), &member.ltv).style(Style::Dashed).color(colors[0]))
            .series(line(once("predicted, LTI"), &member.lti).style(Style::Dotted).color(colors[1]));
    }
    panel
}
