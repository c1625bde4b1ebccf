//! Figures of a study: curves over one parameter, maps over two, scatter plots and parallel coordinates over more.

use super::figures::label;
use crate::error::significant;
use crate::math::bounds;
use crate::plot::{Align, AxisSpec, Figure, Item, ItemForm, Panel, Series, Spot, Style, Tint};
use crate::study::variants::{StudyRow, StudyTable};

/// Largest number of parameters that are drawn.
const MOST_PARAMETERS: usize = 6;
/// Height of a panel of a map and of a scatter plot, nominal pixels.
const MAP: f64 = 220.0;
const SCATTER: f64 = 130.0;
const FAILED: Tint = Tint::Body(1, 0.0);
const MARK: &str = "×";

/// Draws the recorded quantities over one parameter, or maps over two; none over more.
pub fn study_figure(table: &StudyTable) -> Option<Figure> {
    let panel = match table.parameters {
        1 => curve,
        2 => map,
        _ => return None,
    };
    let panels = drawn(table).map(|column| with_key(table, panel(table, column)));
    (table.rows.len() > 1).then(|| panels.fold(titled(table, ""), Figure::panel))
}

/// Draws each recorded quantity over each of two or more parameters.
pub fn scatter_figure(table: &StudyTable) -> Option<Figure> {
    let columns = table.parameters.min(MOST_PARAMETERS);
    if table.parameters < 2 || table.rows.len() < 2 {
        return None;
    }
    let panel = |(y, x): (usize, usize)| {
        let points = table.rows.values().map(|row| (row.values[x], row.values[y]));
        let disc = |(x, y)| Item { spots: vec![Spot::data(x, y)], tint: Tint::Body(0, 0.0), form: ItemForm::Disc(2.5) };
        let discs = points.filter(|(_, y)| y.is_finite()).map(disc);
        let plain = with_key(table, Panel::new(axis(table, x), recorded(table, y)).height(SCATTER));
        plain.items(discs).items(failures(table, |row| Spot::data(row.values[x], f64::NEG_INFINITY)))
    };
    let panels = drawn(table).flat_map(|y| (0..columns).map(move |x| (y, x))).map(panel);
    let figure = Figure { columns, width: (300.0 * columns as f64).max(640.0), ..titled(table, ": scatter") };
    Some(panels.fold(figure, Figure::panel))
}

/// Draws a line for each variant across an axis for each of three or more parameters and for each recorded quantity.
pub fn coordinates_figure(table: &StudyTable) -> Option<Figure> {
    let columns: Vec<usize> = (0..table.parameters.min(MOST_PARAMETERS)).chain(drawn(table)).collect();
    let last = *columns.last()?;
    if table.parameters < 3 || table.rows.len() < 2 {
        return None;
    }
    let ranges: Vec<(f64, f64)> = columns.iter().map(|column| range(table, *column)).collect();
    let place = |row: &StudyRow, i: usize| {
        let is_log = is_log(table, columns[i]);
        Spot::data(i as f64, part_of(row.values[columns[i]], ranges[i], is_log))
    };
    let line = |row: &StudyRow| {
        let spots: Vec<Spot> = (0..columns.len()).map(|i| place(row, i)).filter(|spot| spot.at.1.is_finite()).collect();
        let is_whole = row.failure.is_empty();
        let tint = match row.values[last] {
            _ if !is_whole => FAILED,
            value if value.is_finite() => Tint::Value(value),
            _ => Tint::Ink(0.5),
        };
        Item { spots, tint, form: ItemForm::Line(1.0, !is_whole) }
    };
    let stride = table.rows.len().div_ceil(1000);
    let names: Vec<String> = columns.iter().map(|column| name(table, *column)).collect();
    let end = columns.len() as f64 - 0.7;
    let x = AxisSpec { names, ..AxisSpec::from("").range(-0.3, end) };
    let mut panel = Panel::new(x, AxisSpec::from("least to greatest").range(-0.12, 1.12)).height(MAP + SCATTER);
    panel.colors = name(table, last).into();
    panel = panel.items(table.rows.values().step_by(stride).map(line));
    // A number that no variant has is an axis without values.
    for (i, (low, high)) in ranges.iter().enumerate().filter(|(_, (low, high))| low <= high) {
        let at = |y: f64| Spot::data(i as f64, y);
        let text = |value: f64| ItemForm::Text(significant(value, 4).replace('-', "−"), Align::Middle);
        panel = panel.items([
            Item { spots: vec![at(0.0), at(1.0)], tint: Tint::Ink(0.2), form: ItemForm::Line(1.4, false) },
            Item { spots: vec![at(0.0).moved(0.0, -16.0)], tint: Tint::Ink(0.0), form: text(*low) },
            Item { spots: vec![at(1.0).moved(0.0, 6.0)], tint: Tint::Ink(0.0), form: text(*high) },
        ]);
    }
    let longest = columns.iter().map(|column| name(table, *column).chars().count()).max().unwrap_or(0) as f64;
    let width = (200.0 + (9.5 * longest + 16.0) * columns.len() as f64).max(640.0);
    Some(Figure { width, ..titled(table, ": parallel coordinates") }.panel(with_key(table, panel)))
}

/// Returns the part of a range at which a value lies; by its ratio to the least where that is how it was varied.
fn part_of(value: f64, (low, high): (f64, f64), is_log: bool) -> f64 {
    let distance = |to: f64| if is_log { (to / low).ln() } else { to - low };
    distance(value) / distance(high).max(f64::MIN_POSITIVE)
}

fn titled(table: &StudyTable, what: &str) -> Figure {
    let scene = table.identity.get("scene").and_then(|scene| scene.as_str()).unwrap_or_default();
    Figure::new().title(format!("{scene}{what}, {} variants", table.rows.len()).replace('_', " "))
}

/// Returns the indices of the recorded columns that are drawn.
fn drawn(table: &StudyTable) -> impl Iterator<Item = usize> + use<> {
    (table.parameters..table.columns.len()).take(6)
}

fn name(table: &StudyTable, column: usize) -> String {
    label(&table.columns[column].name, &table.columns[column].unit)
}

fn range(table: &StudyTable, column: usize) -> (f64, f64) {
    bounds(table.rows.values().map(|row| row.values[column]).filter(|value| value.is_finite()))
}

fn with_key(table: &StudyTable, mut panel: Panel) -> Panel {
    if table.failed() > 0 {
        panel.keys.push(("failed".to_string(), FAILED));
    }
    panel
}

/// Returns a mark for each variant that failed.
fn failures(table: &StudyTable, place: impl Fn(&StudyRow) -> Spot) -> Vec<Item> {
    let failed = table.rows.values().filter(|row| !row.failure.is_empty());
    let mark =
        |row| Item { spots: vec![place(row)], tint: FAILED, form: ItemForm::Text(MARK.to_string(), Align::Middle) };
    failed.map(mark).collect()
}

/// Draws a recorded column over the only parameter.
fn curve(table: &StudyTable, column: usize) -> Panel {
    let mut points: Vec<(f64, f64)> = table.rows.values().map(|row| (row.values[0], row.values[column])).collect();
    points.sort_by(|a, b| a.0.total_cmp(&b.0));
    let style = if points.len() > 40 { Style::Line } else { Style::LineDots };
    let panel =
        Panel::new(axis(table, 0), recorded(table, column)).series(Series::line("", points).style(style).color(0));
    panel.items(failures(table, |row| Spot::data(row.values[0], f64::NEG_INFINITY).moved(0.0, 3.0)))
}

/// Colours a recorded column over both parameters: cells of a grid, else discs.
fn map(table: &StudyTable, column: usize) -> Panel {
    let columns = edges(table, 0);
    let rows = edges(table, 1);
    // A list may have one value of a parameter in all rows.
    let is_grid = columns.len().min(rows.len()) > 2 && (columns.len() - 1) * (rows.len() - 1) == table.count;
    let of_cells = |parameter: usize, edges: &[f64]| axis(table, parameter).range(edges[0], edges[edges.len() - 1]);
    let axes = if is_grid { [of_cells(0, &columns), of_cells(1, &rows)] } else { [axis(table, 0), axis(table, 1)] };
    let [x, y] = axes;
    let mut panel = Panel::new(x, y).height(MAP);
    panel.colors = name(table, column).into();
    let item = |row: &StudyRow| {
        let tint = Tint::Value(row.values[column]);
        if !is_grid {
            return Item { spots: vec![Spot::data(row.values[0], row.values[1])], tint, form: ItemForm::Disc(4.0) };
        }
        let (left, right) = cell(&columns, row.values[0]);
        let (low, high) = cell(&rows, row.values[1]);
        let spots = [(left, low), (right, low), (right, high), (left, high)].map(|(x, y)| Spot::data(x, y)).to_vec();
        Item { spots, tint, form: ItemForm::Cell }
    };
    let done = table.rows.values().filter(|row| row.values[column].is_finite());
    panel = panel.items(done.map(item));
    panel.items(failures(table, |row| Spot::data(row.values[0], row.values[1]).moved(0.0, -5.0)))
}

/// Returns the axis of a recorded column, with room below for the marks of variants that failed.
fn recorded(table: &StudyTable, column: usize) -> AxisSpec {
    let spec = AxisSpec::from(name(table, column));
    let (low, high) = range(table, column);
    let height = high - low;
    let has_marks = table.failed() > 0 && height > 0.0;
    if has_marks { spec.range(low - 0.2 * height, high + 0.05 * height) } else { spec }
}

/// Returns the axis of a parameter, logarithmic where that is how it was varied, with room at its ends.
fn axis(table: &StudyTable, parameter: usize) -> AxisSpec {
    let is_log = is_log(table, parameter);
    let (low, high) = range(table, parameter);
    let more = |at: f64| if is_log { low * (high / low).powf(at) } else { low + at * (high - low) };
    let spec = AxisSpec { is_log, ..name(table, parameter).into() };
    if low < high { spec.range(more(-0.05), more(1.0 + 0.05)) } else { spec }
}

/// True if the values of a parameter were chosen with a constant factor.
fn is_log(table: &StudyTable, parameter: usize) -> bool {
    let own = format!("{}=", table.columns[parameter].name);
    let plan = table.identity.get("plan").and_then(|plan| plan.as_str()).unwrap_or_default();
    plan.split(' ').any(|word| word.starts_with(&own) && word.ends_with(":log"))
}

/// Returns the borders of cells about the values of a parameter.
fn edges(table: &StudyTable, parameter: usize) -> Vec<f64> {
    let mut values: Vec<f64> = table.rows.values().map(|row| row.values[parameter]).collect();
    values.sort_by(f64::total_cmp);
    values.dedup();
    let is_log = is_log(table, parameter);
    let middle = |a: f64, b: f64| if is_log { (a * b).sqrt() } else { 0.5 * (a + b) };
    let beyond = |a: f64, b: f64| if is_log { a * a / middle(a, b) } else { 2.0 * a - middle(a, b) };
    let first = &values[..values.len().min(2)];
    let last = &values[values.len().saturating_sub(2)..];
    let ends = [beyond(first[0], first[first.len() - 1]), beyond(last[last.len() - 1], last[0])];
    let inner = values.windows(2).map(|pair| middle(pair[0], pair[1]));
    [ends[0]].into_iter().chain(inner).chain([ends[1]]).collect()
}

fn cell(edges: &[f64], value: f64) -> (f64, f64) {
    let i = edges.partition_point(|edge| *edge <= value).clamp(1, edges.len() - 1);
    (edges[i - 1], edges[i])
}
