//! Errors as figures.

use crate::tables::Curves;
use holonom::plot::{AxisSpec, Figure, Panel, Series, Style};

/// Errors below this are rounding of the last digit, and zeros are drawn there.
const LEAST: f64 = 1e-16;

fn panel(x: &str, curves: &Curves, (low, high): (f64, f64)) -> Panel {
    let y = AxisSpec::from("relative error").log().range(LEAST, 1e2);
    let mut panel = Panel::new(AxisSpec::from(x).log().range(low, high), y).title(curves.title.clone()).height(230.0);
    for (name, points) in &curves.lines {
        let points = points.iter().map(|(x, y)| (*x, y.max(LEAST))).collect();
        panel = panel.series(Series::line(name.clone(), points).style(Style::LineDots));
    }
    panel
}

pub fn gains(curves: &[Curves]) -> Figure {
    let figure = Figure::new().title("Baumgarte: error of the physical eigenvalues");
    curves.iter().fold(figure, |figure, curves| figure.panel(panel("alpha = beta (1/s)", curves, (1.0, 1e8))))
}

/// Equilibria on the left, moving states on the right.
pub fn penalties(curves: &[Curves]) -> Figure {
    let figure =
        Figure { columns: 2, width: 1000.0, ..Figure::new().title("Penalties: error of the physical eigenvalues") };
    let (equilibria, moving) = curves.split_at(curves.len() / 2);
    let both = equilibria.iter().zip(moving).flat_map(|(left, right)| [left, right]);
    both.fold(figure, |figure, curves| figure.panel(panel("penalty", curves, (1e2, 1e14))))
}
