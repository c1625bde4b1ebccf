//! Drawing of a figure as shapes.

use super::legend::{Block, LegendEntry};
use super::*;
use plotters::drawing::IntoDrawingArea;
use std::{cell::RefCell, rc::Rc};

const PANEL_GAP: f64 = 12.0;

/// Draws the whole figure.
pub(super) fn figure(figure: &Figure) -> Drawing {
    let (width, panels) = layout::place(figure);
    let drawing = Rc::new(RefCell::new(Drawing { width, title: figure.title.clone(), ..Drawing::default() }));
    // A sketch refuses nothing, so that there is always a page.
    let bottom = page(figure, panels, width, &Sketch(drawing.clone())).unwrap_or_default();
    drawing.borrow_mut().height = (bottom + EDGE).ceil();
    drawing.take()
}

/// Draws title, panels and legends from top to bottom, and returns the lower end.
fn page(figure: &Figure, mut panels: Vec<Placed>, width: f64, sketch: &Sketch) -> Done<f64> {
    let page = sketch.clone().into_drawing_area();
    let columns = layout::columns(figure);
    let mut top = (EDGE + 2.0 + heading(&page, &figure.title, width)?).round();
    let shared = shared_legend(&panels);
    let count = figure.panels.iter().map(|panel| panel.series.len() + 1).sum();
    for (row, side_by_side) in panels.chunks_mut(columns).enumerate() {
        top += if row > 0 { PANEL_GAP } else { 0.0 };
        let mut bottom = top;
        for (column, placed) in side_by_side.iter_mut().enumerate() {
            let size = (width / columns as f64, placed.height());
            let area = page.clone().shrink(units((size.0 * column as f64, top)), units(size));
            let mut entries = if shared.is_empty() { legend::entries(placed) } else { Vec::new() };
            let taken = panel(sketch, &page, &area, placed, count)?;
            if let Some((block, corner)) = legend::inside(&entries, placed, &taken) {
                block.draw(&page, corner, true)?;
                entries.clear();
            }
            bottom = bottom.max(legend_below(&page, &entries, placed, top + size.1, width)?);
        }
        top = bottom.round();
    }
    panels.last().map_or(Ok(top), |placed| legend_below(&page, &shared, placed, top, width))
}

/// Draws the title and returns its height.
fn heading(page: &Page, title: &str, width: f64) -> Done<f64> {
    let title = Label::new(title, TITLE_SIZE, width - 2.0 * EDGE, 3);
    let middle = (0.5 * width, EDGE - 2.0 + 0.5 * title.height());
    page.draw_text(&title.text, &font(title.size, INK, Align::Middle), units(middle))?;
    Ok(if title.text.is_empty() { 0.0 } else { title.height() + 5.0 })
}

/// Returns the entries of the panels' legends if there are several panels and all have the same.
fn shared_legend(panels: &[Placed]) -> Vec<LegendEntry> {
    let all: Vec<_> = panels.iter().map(legend::entries).collect();
    let is_shared = all.len() > 1 && all.windows(2).all(|pair| pair[0] == pair[1]);
    all.into_iter().next().filter(|_| is_shared).unwrap_or_default()
}

/// Draws a panel on its area, and returns what a legend must not hide.
fn panel(sketch: &Sketch, page: &Page, area: &Page, placed: &mut Placed, count: usize) -> Done<Taken> {
    let mut chart = chart::build(area, placed)?;
    if placed.panel.cells.is_empty() {
        chart::grid(&mut chart)?;
    }
    heat::draw(page, placed)?;
    let first = sketch.seal();
    data::series(page, placed, count)?;
    let items = sketch.seal();
    item::draw(page, placed)?;
    let last = sketch.seal();
    sketch.0.borrow_mut().items = items..last;
    let mut taken = Taken::new(&sketch.0.borrow().shapes[first..last]);
    chart::axes(&mut chart, placed)?;
    chart::texts(page, placed)?;
    chart::bar(area, placed)?;
    item::inset(page, placed, &mut taken)?;
    notes::draw(page, placed, &mut taken)?;
    if first == last && placed.panel.cells.is_empty() {
        page.draw_text("no data", &font(LABEL_SIZE, NOTE_INK, Align::Middle), units(placed.frame.at(0.5, 0.5)))?;
    }
    Ok(taken)
}

/// Draws a legend below a panel and returns its lower end.
fn legend_below(page: &Page, entries: &[LegendEntry], placed: &Placed, top: f64, width: f64) -> Done<f64> {
    if entries.is_empty() {
        return Ok(top);
    }
    let block = Block::wide(entries, width - 2.0 * EDGE);
    let (block_width, height) = block.size();
    let most = (width - EDGE - block_width).max(EDGE);
    let left = (placed.frame.at(0.5, 0.0).0 - 0.5 * block_width).clamp(EDGE, most);
    block.draw(page, (left, top), false)?;
    Ok(top + height)
}
