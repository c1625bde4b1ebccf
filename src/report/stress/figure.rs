//! Figure of a map.

use crate::compare::stress::{Axis, Cell, Status, Stressed};
use crate::plot::{AxisSpec, Figure, HeatMap, Panel};
use crate::tolerances::report::WRONG_MOTION;

/// Height of a row of cells, in nominal pixels.
const ROW: f64 = 21.0;
/// Smaller values have the colour of this one: they are round-off.
const ROUND_OFF: f64 = 1e-16;

/// Draws one panel for each method, with a common colour scale; symbols mark cells that did not complete or are far
/// off. None where there is nothing to colour.
pub fn stress_figure(scene: &str, stressed: &Stressed) -> Option<Figure> {
    if stressed.is_empty() {
        return None;
    }
    let map = &stressed.map;
    let values: Vec<f64> = stressed.cells.iter().filter_map(|cell| map.quantity.of(cell)).collect();
    let low = values.iter().copied().fold(1.0, f64::min).max(ROUND_OFF);
    let high = values.iter().copied().fold(10.0 * low, f64::max);
    let title = format!("{scene}: {} by {} and {}{}", map.quantity.label(), map.x.name, map.y.name, legend(stressed));
    let title = title.replace('_', " ");
    let panels = (0..map.methods.len()).map(|method| panel(stressed, method, (low, high)));
    Some(panels.fold(Figure::new().title(title), Figure::panel))
}

fn panel(stressed: &Stressed, method: usize, (low, high): (f64, f64)) -> Panel {
    let map = &stressed.map;
    let (columns, x) = places(&map.x);
    let (rows, y) = places(&map.y);
    let at = |places: &[(usize, f64)]| places.iter().map(|place| place.1).collect();
    let mut cells = HeatMap::new(map.quantity.label(), at(&columns), at(&rows)).log().range(low, high);
    for (row, (from_row, _)) in rows.iter().enumerate() {
        for (column, (from_column, _)) in columns.iter().enumerate() {
            let Some(cell) = stressed.cell(method, *from_row, *from_column) else { continue };
            map.quantity.of(cell).into_iter().for_each(|value| cells.set(column, row, value));
            symbol(cell).into_iter().for_each(|(symbol, _)| cells.mark(column, row, symbol));
        }
    }
    Panel::new(x, y).title(map.methods[method].label.clone()).heat_map(cells).height(ROW * rows.len().max(4) as f64)
}

/// Returns the meaning of the symbols on cells; `slow` needs none.
fn legend(stressed: &Stressed) -> String {
    let mut found: Vec<&Cell> = stressed.cells.iter().filter(|cell| cell.status != Status::TooSlow).collect();
    found.sort_by_key(|cell| cell.status);
    let mut all: Vec<String> =
        found.into_iter().filter_map(symbol).map(|(symbol, word)| format!("{symbol}={word}")).collect();
    all.dedup();
    if all.is_empty() { String::new() } else { format!(" ({})", all.join(", ")) }
}

/// Returns the symbol on a cell and its meaning.
fn symbol(cell: &Cell) -> Option<(&'static str, String)> {
    let symbol = match cell.status {
        Status::Completed if cell.holds == Some(false) => {
            return Some(("!", format!("off by over {} %", 100.0 * WRONG_MOTION)));
        }
        Status::Completed => return None,
        Status::Diverged => "∞",
        Status::Failed => "×",
        Status::Refused => "no",
        Status::TooSlow => "slow",
        Status::LeftOut => "–",
    };
    Some((symbol, cell.status.word().to_string()))
}

/// Returns the entries of an axis in ascending order with their positions, and the axis.
fn places(axis: &Axis) -> (Vec<(usize, f64)>, AxisSpec) {
    let label = AxisSpec::from(axis.label());
    let Some(values) = axis.values() else {
        let label =
            AxisSpec::from(if axis.unit.is_empty() { axis.label() } else { format!("{}, or method", axis.label()) });
        let names = axis.entries.iter().map(|entry| entry.label.clone());
        return ((0..axis.entries.len()).map(|k| (k, k as f64)).collect(), label.names(names));
    };
    let mut places: Vec<(usize, f64)> = values.into_iter().enumerate().collect();
    places.sort_by(|a, b| a.1.total_cmp(&b.1));
    (places, if axis.is_log() { label.log() } else { label })
}
