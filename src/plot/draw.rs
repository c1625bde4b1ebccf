//! Drawing of a figure as shapes.

use super::legend::{Block, LegendEntry};
use super::*;

const PANEL_GAP: f64 = 12.0;

/// Draws title, panels and legends from top to bottom.
pub(super) fn figure(figure: &Figure) -> Drawing {
    let (width, mut panels) = layout::place(figure);
    let mut drawing = Drawing { width, title: figure.title.clone(), ..Drawing::default() };
    let title = Label::new(&figure.title, TITLE_SIZE, width - 2.0 * EDGE, 3);
    let middle = (0.5 * width, EDGE - 2.0 + 0.5 * title.height());
    drawing.layer(|out| out.text(&title.text, middle, Font(title.size, INK, Align::Middle)));
    let mut top = (EDGE + 2.0 + if title.text.is_empty() { 0.0 } else { title.height() + 5.0 }).round();
    let columns = layout::columns(figure);
    let mut legends: Vec<Vec<LegendEntry>> = panels.iter().map(legend::entries).collect();
    let is_shared = legends.len() > 1 && legends.windows(2).all(|pair| pair[0] == pair[1]);
    let shared = if is_shared { std::mem::take(&mut legends).swap_remove(0) } else { Vec::new() };
    let mut legends = legends.into_iter();
    let count = figure.panels.iter().map(|panel| panel.series.len() + 1).sum();
    for (row, side_by_side) in panels.chunks_mut(columns).enumerate() {
        top += if row > 0 { PANEL_GAP } else { 0.0 };
        let mut bottom = top;
        let part = width / columns as f64;
        for (column, placed) in side_by_side.iter_mut().enumerate() {
            let end = placed.put(part * column as f64, part, top);
            let taken = panel(&mut drawing, placed, count);
            let mut entries = legends.next().unwrap_or_default();
            if let Some((block, corner)) = legend::inside(&entries, placed, &taken) {
                drawing.layer(|out| block.draw(out, corner, true));
                entries.clear();
            }
            bottom = bottom.max(legend_below(&mut drawing, &entries, placed, end));
        }
        top = bottom.round();
    }
    let bottom = panels.last().map_or(top, |placed| legend_below(&mut drawing, &shared, placed, top));
    drawing.height = (bottom + EDGE).ceil();
    drawing
}

/// Draws a panel, and returns what a legend must not hide.
fn panel(drawing: &mut Drawing, placed: &Placed, count: usize) -> Taken {
    drawing.layer(|out| chart::grid(out, placed));
    let data = drawing.layer(|out| data::series(out, placed, count));
    drawing.items = drawing.layer(|out| item::draw(out, placed));
    let shown = &drawing.shapes[data.start..drawing.items.end];
    let mut taken = Taken::new(shown);
    let is_empty = shown.is_empty();
    drawing.layer(|out| {
        chart::draw(out, placed);
        notes::draw(out, placed, &mut taken);
        if is_empty {
            out.text("no data", placed.frame.at(0.5, 0.5), Font(LABEL_SIZE, NOTE_INK, Align::Middle));
        }
    });
    taken
}

/// Draws a legend below a panel and returns its lower end.
fn legend_below(drawing: &mut Drawing, entries: &[LegendEntry], placed: &Placed, top: f64) -> f64 {
    if entries.is_empty() {
        return top;
    }
    let room = drawing.width - 2.0 * EDGE;
    let block = Block::wide(entries, room);
    let (width, height) = block.size();
    let left = (placed.frame.at(0.5, 0.0).0 - 0.5 * width).clamp(EDGE, (EDGE + room - width).max(EDGE));
    drawing.layer(|out| block.draw(out, (left, top), false));
    top + height
}
