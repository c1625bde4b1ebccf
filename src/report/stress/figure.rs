//! Figure of a map.

use crate::plot::{Align, AxisSpec, Figure, Item, ItemForm, Panel, Spot, Tint};
use crate::study::stress::{Cell, MapAxis, Status, Stressed};
use crate::tolerances::WRONG_MOTION;

/// Smaller values have the colour of this one: they are round-off.
const ROUND_OFF: f64 = 1e-16;

/// Draws one panel for each method, with a common colour scale. Cells that did not complete have a colour and a symbol
/// by the reason, which the legend explains; a mark on others is explained by the title. None where there is nothing to
/// colour.
pub fn stress_figure(scene: &str, stressed: &Stressed) -> Option<Figure> {
    if stressed.is_empty() {
        return None;
    }
    let map = &stressed.map;
    let values: Vec<f64> = stressed.cells.iter().filter_map(|cell| map.quantity.of(cell)).collect();
    let low = values.iter().copied().fold(1.0, f64::min).max(ROUND_OFF);
    let high = values.iter().copied().fold(10.0 * low, f64::max);
    let has_wrong = stressed.cells.iter().any(is_wrong);
    let mark = if has_wrong { format!(" ({WRONG}=off by over {} %)", 100.0 * WRONG_MOTION) } else { String::new() };
    let title = format!("{scene}: {} by {} and {}{mark}", map.quantity.label(), map.x.name, map.y.name);
    let keys = keys(stressed);
    let panels =
        (0..map.methods.len()).map(|method| Panel { keys: keys.clone(), ..panel(stressed, method, (low, high)) });
    let figure = Figure { width: width(&map.x), ..Figure::new().title(title.replace('_', " ")) };
    Some(panels.fold(figure, Figure::panel))
}

/// Returns a width in nominal pixels at which every column has room for its label, and for a word of four letters.
fn width(axis: &MapAxis) -> f64 {
    let longest = axis.entries.iter().map(|entry| entry.label.chars().count()).max().unwrap_or(0).max(3);
    let columns = axis.entries.len() as f64 * (10.0 * longest as f64 + 16.0);
    (270.0 + columns).max(Figure::default().width)
}

fn panel(stressed: &Stressed, method: usize, (low, high): (f64, f64)) -> Panel {
    let map = &stressed.map;
    let columns = order(&map.x);
    let rows = order(&map.y);
    let mut panel = Panel::new(axis(&map.x, &columns), axis(&map.y, &rows))
        .title(map.methods[method].label.clone())
        .height(21.0 * rows.len().max(4) as f64);
    panel.colors = AxisSpec::from(map.quantity.label()).log().range(low, high);
    let mut words = Vec::new();
    for (row, from_row) in rows.iter().enumerate() {
        for (column, from_column) in columns.iter().enumerate() {
            let at = |right: f64, up: f64| Spot::data(column as f64 + right, row as f64 + up);
            let (word, tint, ink) = shown(stressed, stressed.cell(method, *from_row, *from_column), (low, high));
            let spots = vec![at(-0.5, -0.5), at(0.5, -0.5), at(0.5, 0.5), at(-0.5, 0.5)];
            panel.items.push(Item { spots, tint, form: ItemForm::Cell });
            if !word.is_empty() {
                let spots = vec![at(0.0, 0.0).moved(0.0, -5.3)];
                words.push(Item { spots, tint: ink, form: ItemForm::Text(word.to_string(), Align::Middle) });
            }
        }
    }
    // Cells of one colour in a row are one shape of the file.
    panel.items.sort_by(|a, b| order_of(a.tint).total_cmp(&order_of(b.tint)));
    panel.items(words)
}

/// Returns the text on a cell, the colour of the cell, and one that is seen on it.
fn shown(stressed: &Stressed, cell: Option<&Cell>, (low, high): (f64, f64)) -> (&'static str, Tint, Tint) {
    let mark = if cell.is_some_and(is_wrong) { WRONG } else { "" };
    let (word, tint) = cell.and_then(|cell| look(cell.status)).unwrap_or((mark, Tint::Ink(0.82)));
    let Some(value) = cell.and_then(|cell| stressed.map.quantity.of(cell)) else { return (word, tint, Tint::Ink(0.0)) };
    let is_bright = (value / low).ln() > 0.56 * (high / low).ln();
    (word, Tint::Value(value), Tint::Ink(if is_bright { 0.0 } else { 1.0 }))
}

/// Returns a number that is the same for equal colours only, largest for values.
fn order_of(tint: Tint) -> f64 {
    match tint {
        Tint::Ink(paleness) => paleness - 2.0,
        Tint::Body(place, paleness) => -3.0 * (place + 1) as f64 + paleness,
        Tint::Value(value) => value,
    }
}

/// Mark of cells that completed with a wrong motion.
const WRONG: &str = "!";

fn is_wrong(cell: &Cell) -> bool {
    cell.status == Status::Completed && cell.holds == Some(false)
}

/// Returns symbol and colour of the cells of a status; none if they have a value. What failed is red, what is not known
/// grey, the palest what was not begun.
fn look(status: Status) -> Option<(&'static str, Tint)> {
    Some(match status {
        Status::Completed => return None,
        Status::Diverged => ("∞", Tint::Body(1, 0.5)),
        Status::Failed => ("×", Tint::Body(4, 0.35)),
        Status::Refused => ("no", Tint::Ink(0.5)),
        Status::TooSlow => ("slow", Tint::Ink(0.7)),
        Status::LeftOut => ("–", Tint::Ink(0.88)),
    })
}

/// Returns the meaning of the colours and symbols on the map.
fn keys(stressed: &Stressed) -> Vec<(String, Tint)> {
    let mut found: Vec<Status> = stressed.cells.iter().map(|cell| cell.status).collect();
    found.sort_unstable();
    found.dedup();
    let key = |status: Status| look(status).map(|(symbol, tint)| (format!("{symbol} {}", status.word()), tint));
    found.into_iter().filter_map(key).collect()
}

/// Returns the indices of the entries of an axis, in ascending order of their values where all have one.
fn order(axis: &MapAxis) -> Vec<usize> {
    let mut order: Vec<usize> = (0..axis.entries.len()).collect();
    if let Some(values) = axis.values() {
        order.sort_by(|a, b| values[*a].total_cmp(&values[*b]));
    }
    order
}

fn axis(axis: &MapAxis, order: &[usize]) -> AxisSpec {
    let label = axis.label();
    let has_others = !axis.unit.is_empty() && axis.values().is_none();
    let label = if has_others { format!("{label}, or method") } else { label };
    let names: Vec<String> = order.iter().map(|k| axis.entries[*k].label.clone()).collect();
    let end = names.len() as f64 - 0.5;
    AxisSpec { names, ..AxisSpec::from(label).range(-0.5, end) }
}
