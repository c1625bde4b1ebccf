//! Drawing of a figure as shapes.

use super::sketch::Nominal;
use super::*;
use plotters::drawing::DrawingArea;
use std::{cell::RefCell, rc::Rc};

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
    let legends: Vec<_> = panels.iter().map(legend::entries).collect();
    let is_shared = legends.len() > 1 && legends.windows(2).all(|pair| pair[0] == pair[1]);
    let count = figure.panels.iter().map(|panel| panel.series.len() + 1).sum();
    let mut bottom = top;
    for (k, (placed, entries)) in panels.iter_mut().zip(&legends).enumerate() {
        if k % columns == 0 {
            top = bottom.round() + if k > 0 { 12.0 } else { 0.0 };
        }
        let end = placed.put(part * (k % columns) as f64, part, top);
        let taken = panel(drawing, &page, placed, count)?;
        let is_done = is_shared || legend::inside(&page, entries, placed, &taken)?;
        bottom = bottom.max(if is_done { end } else { legend::below(&page, entries, placed, end, width)? });
    }
    bottom = bottom.round();
    if let (true, Some(placed)) = (is_shared, panels.last()) {
        bottom = legend::below(&page, &legends[0], placed, bottom, width)?;
    }
    Ok((width, (bottom + EDGE).ceil()))
}

/// Draws a panel, and returns what a legend must not hide.
fn panel(drawing: &RefCell<Drawing>, page: &Page, placed: &PlacedPanel, count: usize) -> Done<Vec<Pt>> {
    let seal = || drawing.borrow_mut().seal();
    let mut chart = chart::grid(page, placed)?;
    let first = seal();
    data::series(page, placed, count)?;
    let items = seal();
    item::draw(page, placed)?;
    let last = seal();
    drawing.borrow_mut().items = items..last;
    let mut taken = notes::taken(&drawing.borrow().shapes[first..last]);
    chart::draw(page, &mut chart, placed)?;
    notes::draw(page, placed, &mut taken)?;
    if first == last {
        page.draw(&words("no data", placed.frame.at(0.5, 0.5), Font(LABEL_SIZE, NOTE_INK, Align::Middle)))?;
    }
    Ok(taken)
}
