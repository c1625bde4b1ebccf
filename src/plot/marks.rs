//! The data of a panel as shapes.

use std::collections::BTreeMap;

use super::axes;
use super::clip;
use super::color_bar::ColorBar;
use super::layout::Placed;
use super::palette::{Look, MARKER_RADIUS, NO_VALUE, TICK_SIZE, ink_on, scale_color, tint};
use super::series::{Series, Style};
use super::shape::{Align, Color, Drawing, Marker, Pt, Rect, Shape, Text};
use super::text;
use super::thin;

/// Largest number of points of one figure, so that its file stays small.
const LINE_POINTS: usize = 16_000;
const DOTS: usize = 12_000;
/// Coloured points need more space, each colour being a shape of its own.
const COLORED: usize = 4_000;
/// Least distance of markers along a line.
const MARKER_DISTANCE: f64 = 16.0;
const DOT_RADIUS: f64 = 2.7;
/// A line that changes its vertical direction by more than this, in pixels, more often than once in this many pixels,
/// is restless.
const RESTLESS: f64 = 4.0;

/// Points of one series when a figure has `count` of them.
#[derive(Clone, Copy, Debug)]
pub(super) struct Budget {
    line: usize,
    dots: usize,
}

impl Budget {
    pub fn new(count: usize) -> Self {
        let count = count.max(1);
        Self { line: (LINE_POINTS / count).max(200), dots: (DOTS / count).max(60) }
    }
}

/// Returns lines and points of a panel, in drawing order: restless lines below calm ones, then markers, then coloured
/// points.
pub(super) fn shapes(placed: &Placed, budget: Budget) -> Vec<Shape> {
    let (mut drawn, mut marks) = (Vec::new(), Vec::new());
    for (series, look) in placed.panel.series.iter().zip(&placed.looks) {
        let runs = runs(placed, series);
        drawn.push(lines(placed, look, &runs, budget));
        marks.extend(markers(placed, series, look, &runs, budget));
    }
    drawn.sort_by_key(|(dense, _)| !dense);
    let mut shapes: Vec<Shape> = drawn.into_iter().flat_map(|(_, shapes)| shapes).chain(marks).collect();
    if let Some(bar) = &placed.bar {
        colored(&mut shapes, placed, bar);
    }
    shapes
}

/// Returns the points in the picture, split where one of them is not a number.
fn runs(placed: &Placed, series: &Series) -> Vec<Vec<Pt>> {
    let places: Vec<Option<Pt>> = series.points.iter().map(|point| placed.at(point.0, point.1)).collect();
    places.split(Option::is_none).map(|run| run.iter().flatten().copied().collect::<Vec<Pt>>()).collect()
}

/// Returns the lines of a series, and true if they are restless: these are thin, since at full width they would be one
/// blot.
fn lines(placed: &Placed, look: &Look, runs: &[Vec<Pt>], budget: Budget) -> (bool, Vec<Shape>) {
    let Some(mut stroke) = look.line else { return (false, Vec::new()) };
    let full = runs.iter().map(Vec::len).sum::<usize>().max(1);
    let share = |run: &[Pt]| (budget.line * run.len() / full).max(8);
    let thinned = runs.iter().map(|run| clip::polyline(&thin::line(run, share(run)), &placed.frame));
    let parts: Vec<Vec<Pt>> = thinned.flatten().collect();
    let dense = parts.iter().map(|part| turns(part)).sum::<usize>() as f64 > placed.frame.width() / RESTLESS;
    if dense {
        stroke.width *= 0.5;
    }
    let mut shapes: Vec<Shape> = parts.into_iter().map(|points| Shape::Path { points, stroke }).collect();
    // A single point between two gaps has no line; a dot of the line's width would be missed.
    let alone = runs.iter().filter(|run| run.len() == 1 && look.marker.is_none()).map(|run| run[0]);
    let at: Vec<Pt> = alone.filter(|point| placed.frame.contains(*point)).collect();
    if !at.is_empty() {
        shapes.push(Shape::Marks { at, marker: Marker::Circle, radius: DOT_RADIUS, color: look.color });
    }
    (dense, shapes)
}

/// Returns the number of times a line changes its vertical direction, without small ripples.
fn turns(points: &[Pt]) -> usize {
    let steps = points.windows(2).map(|pair| pair[1].1 - pair[0].1).filter(|step| step.abs() > RESTLESS);
    let signs: Vec<bool> = steps.map(|step| step > 0.0).collect();
    signs.windows(2).filter(|pair| pair[0] != pair[1]).count()
}

fn markers(placed: &Placed, series: &Series, look: &Look, runs: &[Vec<Pt>], budget: Budget) -> Option<Shape> {
    let marker = look.marker?;
    let visible: Vec<Pt> = runs.iter().flatten().copied().filter(|point| placed.frame.contains(*point)).collect();
    let at: Vec<Pt> = match series.style {
        Style::LineDots => spaced(&visible),
        _ => thin::dots(&visible, budget.dots).into_iter().map(|i| visible[i]).collect(),
    };
    let radius = MARKER_RADIUS * [1.0, 0.6, 0.35][usize::from(at.len() > 150) + usize::from(at.len() > 2000)];
    (!at.is_empty()).then_some(Shape::Marks { at, marker, radius, color: look.color })
}

/// Returns points at least [`MARKER_DISTANCE`] from the one before.
fn spaced(points: &[Pt]) -> Vec<Pt> {
    let mut kept: Vec<Pt> = Vec::new();
    for point in points {
        let far = |last: &Pt| (point.0 - last.0).hypot(point.1 - last.1) >= MARKER_DISTANCE;
        if kept.last().is_none_or(far) {
            kept.push(*point);
        }
    }
    kept
}

/// Draws points coloured by value, grouped by runs of one colour so that later points stay on top.
fn colored(shapes: &mut Vec<Shape>, placed: &Placed, bar: &ColorBar) {
    let points = placed.panel.color_series.iter().flat_map(|series| &series.points);
    let known = points.filter_map(|point| Some((placed.at(point.0, point.1)?, bar.step(point.2)?)));
    let visible: Vec<(Pt, usize)> = known.filter(|(point, _)| placed.frame.contains(*point)).collect();
    let places: Vec<Pt> = visible.iter().map(|(point, _)| *point).collect();
    let mut kept: Vec<(Pt, usize)> = thin::dots(&places, COLORED).into_iter().map(|i| visible[i]).collect();
    if kept.chunk_by(|a, b| a.1 == b.1).count() > COLORED / 4 {
        // Colours without order: grouping them all keeps the file small, and which is on top is arbitrary anyway.
        kept.sort_by_key(|point| point.1);
    }
    for group in kept.chunk_by(|a, b| a.1 == b.1) {
        let at = group.iter().map(|(point, _)| *point).collect();
        shapes.push(Shape::Marks { at, marker: Marker::Circle, radius: DOT_RADIUS, color: scale_color(group[0].1) });
    }
}

/// Draws the cells of the map and the texts on them.
pub(super) fn cells(drawing: &mut Drawing, placed: &Placed) {
    let (Some(map), Some(bar)) = (&placed.panel.heat_map, &placed.bar) else {
        return;
    };
    let cells: Vec<(usize, usize, Rect)> =
        map.cells(&placed.x, &placed.y).into_iter().map(|cell| (cell.0, cell.1, placed.rect(&cell.2))).collect();
    let color = |column, row| {
        let value = map.value(column, row).and_then(|value| bar.color(value));
        value.or_else(|| map.tint(column, row).map(tint)).unwrap_or(NO_VALUE)
    };
    let mut groups: BTreeMap<(u8, u8, u8), Vec<Rect>> = BTreeMap::new();
    for (column, row, rect) in &cells {
        let Color(red, green, blue) = color(*column, *row);
        groups.entry((red, green, blue)).or_default().push(*rect);
    }
    for ((red, green, blue), rects) in groups {
        drawing.shapes.push(Shape::Rects { rects, fill: Color(red, green, blue) });
    }
    let places: BTreeMap<(usize, usize), Rect> = cells.iter().map(|cell| ((cell.0, cell.1), cell.2)).collect();
    for (column, row, word) in &map.words {
        let Some((x, y)) = places.get(&(*column, *row)).map(Rect::center) else { continue };
        let at = (x, y + 0.36 * placed.word_size);
        let ink = ink_on(color(*column, *row));
        drawing.text(Text { color: ink, ..axes::text(at, word, placed.word_size, Align::Middle) });
    }
}

/// Returns the size at which all texts fit on their cells.
pub(super) fn word_size(placed: &Placed) -> f64 {
    let Some(map) = &placed.panel.heat_map else { return TICK_SIZE };
    let cells = map.cells(&placed.x, &placed.y);
    let rects = cells.iter().map(|cell| placed.rect(&cell.2));
    let (width, height) = rects
        .fold((f64::INFINITY, f64::INFINITY), |least, rect| (least.0.min(rect.width()), least.1.min(rect.height())));
    let widest = map.words.iter().map(|(_, _, word)| text::width(word, 1.0)).fold(0.1, f64::max);
    TICK_SIZE.min(0.88 * width / widest).min(0.8 * height)
}
