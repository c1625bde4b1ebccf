//! Error and drift over CPU time.

use crate::plot::{AxisSpec, Figure, Panel, Series, Style};
use crate::report::figures::Floor;
use crate::study::work_precision::{Cell, Held, WorkPrecision, cheapest_by_method, front};

/// Draws work-precision diagrams, each with its Pareto front: errors over CPU time, evaluations and factorizations, and
/// drift over CPU time. `None` where no run was completed.
pub fn tradeoff_figure(measured: &WorkPrecision, digits: u32) -> Option<Figure> {
    let named = named(measured, digits);
    if named.is_empty() {
        return None;
    }
    let evaluations = |cell: &Cell| cell.statistics().map(|work| work.whole().rhs_evaluations as f64);
    let factorizations = |cell: &Cell| cell.statistics().map(|work| work.whole().factorizations as f64);
    let cost = |cell: &Cell| cell.cost;
    let drift = |cell: &Cell| cell.drift().map(Held::largest);
    let panel = |x: PlottedQuantity, y: PlottedQuantity| panel(measured, &named, x, y);
    let error = || PlottedQuantity("error (relative)", &Cell::error);
    let drifts = panel(PlottedQuantity("CPU time (s)", &cost), PlottedQuantity("drift of φ, φ′ (relative)", &drift));
    let figure =
        Figure { columns: 2, width: 1280.0, ..Figure::new().title(format!("{}: speed for accuracy", measured.scene)) };
    Some(
        figure
            .panel(panel(PlottedQuantity("CPU time (s)", &cost), error()))
            .panel(Floor::of(1.0).cut(drifts))
            .panel(panel(PlottedQuantity("evaluations of the equations of motion", &evaluations), error()))
            .panel(panel(PlottedQuantity("factorizations", &factorizations), error())),
    )
}

/// The label of an axis, and its value for a run.
#[derive(Clone, Copy)]
struct PlottedQuantity<'q>(&'q str, &'q dyn Fn(&Cell) -> Option<f64>);

/// Returns the best method of each integrator for this many digits, the quickest first.
fn named(measured: &WorkPrecision, digits: u32) -> Vec<usize> {
    let (reached, others) = cheapest_by_method(&measured.cells, digits);
    let mut named: Vec<usize> = Vec::new();
    for place in reached.into_iter().chain(others) {
        let cell = &measured.cells[place];
        let is_new = named.iter().all(|known| measured.cells[*known].method.integrator != cell.method.integrator);
        if is_new && cell.error().is_some() && named.len() < 6 {
            named.push(place);
        }
    }
    named
}

fn panel(measured: &WorkPrecision, named: &[usize], x: PlottedQuantity, y: PlottedQuantity) -> Panel {
    let axis = |quantity: PlottedQuantity| AxisSpec::from(quantity.0).log();
    let point = |cell: &Cell| Some((x.1(cell)?, y.1(cell)?));
    let is_named = |cell: &Cell| named.iter().any(|place| cell.is_of(&measured.cells[*place].method));
    let others = measured.cells.iter().filter(|cell| !is_named(cell)).filter_map(point).collect();
    let panel =
        Panel::new(axis(x), axis(y)).series(Series::line("other methods", others).style(Style::Crosses)).series(
            Series::line("Pareto front", front(measured.cells.iter().filter_map(point), |point| *point))
                .style(Style::Guide),
        );
    named.iter().enumerate().fold(panel, |panel, (color, place)| {
        let method = &measured.cells[*place].method;
        let points = measured.cells.iter().filter(|cell| cell.is_of(method)).filter_map(point).collect();
        panel.series(Series::line(method.triple(), points).style(Style::LineDots).color(color))
    })
}
