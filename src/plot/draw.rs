//! Drawing of a figure as shapes.

use super::legend::{Block, LegendEntry};
use super::sketch::Nominal;
use super::*;
use plotters::drawing::DrawingArea;
use std::{cell::RefCell, rc::Rc};

const PANEL_GAP: f64 = 12.0;

/// Draws a figure.
pub(super) fn figure(figure: &Figure) -> Drawing {
    let drawing = Rc::new(RefCell::new(Drawing { title: figure.title.clone(), ..Drawing::default() }));
    // A drawing refuses nothing.
    let (width, height) = sheet(figure, &drawing).unwrap_or_default();
    Drawing { width, height, ..drawing.take() }
}

/// Draws title, panels and legends from top to bottom, and returns the width and the height.
fn sheet(figure: &Figure, drawing: &Rc<RefCell<Drawing>>) -> Done<(f64, f64)> {
    let page = DrawingArea::from(drawing).apply_coord_spec(Nominal);
    let (width, mut panels) = layout::place(figure);
    let title = Label::new(&figure.title, TITLE_SIZE, width - 2.0 * EDGE, 3);
    let middle = (0.5 * width, EDGE - 2.0 + 0.5 * title.height());
    page.draw(&words(&title.text, middle, Font(title.size, INK, Align::Middle)))?;
    let mut top = (EDGE + 2.0 + if title.text.is_empty() { 0.0 } else { title.height() + 5.0 }).round();
    let columns = layout::columns(figure);
    let part = width / columns as f64;
    let legends: Vec<Vec<LegendEntry>> = panels.iter().map(legend::entries).collect();
    let is_shared = legends.len() > 1 && legends.windows(2).all(|pair| pair[0] == pair[1]);
    let count = figure.panels.iter().map(|panel| panel.series.len() + 1).sum();
    let last = panels.len();
    let mut bottom = top;
    for (k, (placed, entries)) in panels.iter_mut().zip(&legends).enumerate() {
        if k % columns == 0 {
            top = bottom.round() + if k > 0 { PANEL_GAP } else { 0.0 };
        }
        let end = placed.put(part * (k % columns) as f64, part, top);
        let taken = panel(drawing, &page, placed, count)?;
        let inside = legend::inside(entries, placed, &taken).filter(|_| !is_shared);
        bottom = bottom.max(end);
        match inside {
            Some((block, corner)) => block.draw(&page, corner, true)?,
            None if is_shared && k + 1 < last => {}
            None => {
                bottom = bottom.max(legend_below(
                    &page,
                    entries,
                    placed,
                    if is_shared { bottom.round() } else { end },
                    width,
                )?)
            }
        }
    }
    Ok((width, (bottom.round() + EDGE).ceil()))
}

/// Draws a panel, and returns what a legend must not hide.
fn panel(drawing: &RefCell<Drawing>, page: &Page, placed: &Placed, count: usize) -> Done<Taken> {
    let seal = || drawing.borrow_mut().seal();
    let mut chart = chart::grid(page, placed)?;
    let first = seal();
    data::series(page, placed, count)?;
    let items = seal();
    item::draw(page, placed)?;
    let last = seal();
    drawing.borrow_mut().items = items..last;
    let mut taken = Taken::new(&drawing.borrow().shapes[first..last]);
    chart::draw(page, &mut chart, placed)?;
    notes::draw(page, placed, &mut taken)?;
    if first == last {
        page.draw(&words("no data", placed.frame.at(0.5, 0.5), Font(LABEL_SIZE, NOTE_INK, Align::Middle)))?;
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
    let left = (placed.frame.at(0.5, 0.0).0 - 0.5 * block_width).min(width - EDGE - block_width).max(EDGE);
    block.draw(page, (left, top), false)?;
    Ok(top + height)
}
