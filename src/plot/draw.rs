//! Drawing of a figure as shapes.

use super::axes;
use super::figure::Figure;
use super::item;
use super::layout::{self, Placed};
use super::legend::{self, Block, LegendEntry, Taken};
use super::marks::{self, Budget};
use super::notes;
use super::palette::{EDGE, FRAME, LABEL_SIZE, NOTE_INK, TITLE_SIZE};
use super::shape::{Align, Drawing, Rect, Shape, Text};
use super::text::{self, LINE_HEIGHT};

const PANEL_GAP: f64 = 16.0;
const LEGEND_GAP: f64 = 2.0;

/// Draws the whole figure.
pub(super) fn figure(figure: &Figure) -> Drawing {
    let (width, mut panels) = layout::place(figure);
    let title = figure.title.clone().unwrap_or_default();
    let mut drawing = Drawing { width, title: title.clone(), ..Drawing::default() };
    let mut top = EDGE + 2.0 + heading(&mut drawing, &title);
    let shared = shared_legend(&panels);
    let series = figure.panels.iter().map(|panel| panel.series.len() + panel.color_series.len()).sum();
    for (row, side_by_side) in panels.chunks_mut(layout::columns(figure)).enumerate() {
        top += if row > 0 { PANEL_GAP } else { 0.0 };
        let mut bottom = top;
        for placed in side_by_side {
            let entries = if shared.is_some() { Vec::new() } else { legend::entries(placed) };
            bottom = bottom.max(panel(&mut drawing, placed, top, &entries, Budget::new(series)));
        }
        top = bottom;
    }
    if let (Some(entries), Some(placed)) = (shared, panels.last()) {
        top = below(&mut drawing, &entries, &placed.frame, top);
    }
    drawing.height = (top + EDGE).ceil();
    drawing
}

/// Draws the title and returns its height.
fn heading(drawing: &mut Drawing, title: &str) -> f64 {
    let lines = text::wrap(title, TITLE_SIZE, drawing.width - 2.0 * EDGE, 3);
    for (row, line) in lines.iter().enumerate() {
        let y = EDGE + TITLE_SIZE * (0.85 + LINE_HEIGHT * row as f64);
        drawing.text(axes::text((0.5 * drawing.width, y), line, TITLE_SIZE, Align::Middle));
    }
    if lines.is_empty() { 0.0 } else { LINE_HEIGHT * TITLE_SIZE * lines.len() as f64 + 5.0 }
}

/// Returns the entries of the panels' legends if there are several panels and all have the same.
fn shared_legend(panels: &[Placed]) -> Option<Vec<LegendEntry>> {
    let mut all = panels.iter().map(legend::entries);
    let first = all.next().filter(|entries| !entries.is_empty() && panels.len() > 1)?;
    all.all(|entries| entries == first).then_some(first)
}

/// Draws a panel from `top` on and returns its lower end.
fn panel(drawing: &mut Drawing, placed: &mut Placed, top: f64, entries: &[LegendEntry], budget: Budget) -> f64 {
    let height = placed.frame.height();
    placed.frame.top = (top + placed.above()).round() + 0.5;
    placed.frame.bottom = placed.frame.top + height;
    let data = marks::shapes(placed, budget);
    let mut taken = Taken::default();
    taken.add(&data);
    if placed.panel.heat_map.is_none() {
        axes::grid(drawing, placed);
    }
    marks::cells(drawing, placed);
    let lines = notes::verticals(drawing, placed);
    taken.add(&lines);
    let items = item::shapes(placed);
    taken.add(&items);
    let empty = data.is_empty() && items.is_empty() && placed.panel.heat_map.is_none();
    drawing.shapes.extend(data);
    let first = drawing.shapes.len();
    drawing.shapes.extend(items);
    drawing.items = first..drawing.shapes.len();
    drawing.shapes.push(Shape::Path { points: placed.frame.outline(), stroke: FRAME });
    axes::axes(drawing, placed);
    item::inset(drawing, placed, &mut taken);
    notes::texts(drawing, placed, &mut taken);
    if empty {
        drawing
            .text(Text { color: NOTE_INK, ..axes::text(placed.frame.center(), "no data", LABEL_SIZE, Align::Middle) });
    }
    explain(drawing, placed, entries, &taken)
}

/// Draws legend and colour bar and returns the lower end of the panel.
fn explain(drawing: &mut Drawing, placed: &Placed, entries: &[LegendEntry], taken: &Taken) -> f64 {
    if let Some(bar) = &placed.bar {
        bar.draw(drawing, &placed.frame);
    }
    let bottom = placed.frame.bottom + placed.below();
    if entries.is_empty() {
        return bottom;
    }
    let free = if placed.panel.heat_map.is_none() { legend::inside(entries, &placed.frame, taken) } else { None };
    match free {
        Some((block, left, top)) => {
            block.draw(drawing, left, top, true);
            bottom
        }
        None => below(drawing, entries, &placed.frame, bottom),
    }
}

/// Draws a legend below a panel and returns its lower end.
fn below(drawing: &mut Drawing, entries: &[LegendEntry], frame: &Rect, top: f64) -> f64 {
    let block = Block::wide(entries, drawing.width - 2.0 * EDGE);
    let most = (drawing.width - EDGE - block.width()).max(EDGE);
    let left = (frame.center().0 - 0.5 * block.width()).clamp(EDGE, most);
    block.draw(drawing, left, top + LEGEND_GAP, false);
    top + LEGEND_GAP + block.height()
}
