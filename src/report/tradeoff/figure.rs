//! Error and drift against CPU time.

use crate::measure::work_precision::{Cell, Held, WorkPrecision, cheapest_by_method};
use crate::plot::{AxisSpec, Figure, Panel, Series, Style};

/// Methods that have a colour; the others stand back as crosses.
const NAMED: usize = 6;

/// The work-precision diagram with the Pareto front, and drift against CPU time. `None` where no run was completed.
pub fn tradeoff_figure(measured: &WorkPrecision, digits: u32) -> Option<Figure> {
    let named = named(measured, digits);
    if named.is_empty() {
        return None;
    }
    let errors = panel(measured, &named, "error (relative)", Cell::error);
    let drifts = panel(measured, &named, "drift of φ, φ′ (relative)", |cell| cell.drift().map(Held::largest));
    Some(Figure::new().title(format!("{}: speed for accuracy", measured.scene)).panel(errors).panel(drifts))
}

/// The best method of each integrator for so many digits, those first that are quickest.
fn named(measured: &WorkPrecision, digits: u32) -> Vec<usize> {
    let (reached, others) = cheapest_by_method(&measured.cells, digits);
    let mut named: Vec<usize> = Vec::new();
    for place in reached.into_iter().chain(others) {
        let cell = &measured.cells[place];
        let is_new = named.iter().all(|known| measured.cells[*known].method.integrator != cell.method.integrator);
        if is_new && cell.error().is_some() && named.len() < NAMED {
            named.push(place);
        }
    }
    named
}

fn panel(measured: &WorkPrecision, named: &[usize], label: &str, value: impl Fn(&Cell) -> Option<f64>) -> Panel {
    let panel = Panel::new(AxisSpec::from("CPU time (s)").log(), AxisSpec::from(label).log());
    let is_named = |cell: &Cell| named.iter().any(|place| cell.is_of(&measured.cells[*place].method));
    let others = measured.cells.iter().filter(|cell| !is_named(cell)).filter_map(|cell| point(cell, &value)).collect();
    let panel = panel.series(Series::line("other methods", others).style(Style::Crosses));
    let front = measured.front().into_iter().filter_map(|place| point(&measured.cells[place], &value)).collect();
    let panel = panel.series(Series::line("best for the error", front).style(Style::Guide));
    named.iter().enumerate().fold(panel, |panel, (color, place)| {
        let method = &measured.cells[*place].method;
        let own = measured.cells.iter().filter(|cell| cell.is_of(method));
        let points = own.filter_map(|cell| point(cell, &value)).collect();
        panel.series(Series::line(method.triple(), points).style(Style::LineDots).color(color))
    })
}

fn point(cell: &Cell, value: impl Fn(&Cell) -> Option<f64>) -> Option<(f64, f64)> {
    Some((cell.seconds()?, value(cell)?))
}
