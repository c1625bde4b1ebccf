//! Notes, and where texts hide least.

use super::*;

/// Directions from a point to the right and down, its sides first.
const AROUND: [(f64, f64); 8] =
    [(1.0, 0.0), (-1.0, 0.0), (0.0, -1.0), (0.0, 1.0), (0.8, -0.8), (-0.8, -0.8), (0.8, 0.8), (-0.8, 0.8)];

/// Draws the notes of a panel, each at the place where it hides least, inside of the frame if possible.
pub(super) fn draw(page: &Page, placed: &PlacedPanel, taken: &mut Vec<Pt>) -> Done {
    for item in &placed.panel.items {
        let (ItemForm::Note(text), [spot]) = (&item.form, &item.spots[..]) else { continue };
        let Some((x, y)) = spot.put(placed).filter(|at| placed.frame.contains(*at)) else { continue };
        let width = text::width(text, NOTE_SIZE);
        let around = |y: f64, distance: f64| {
            AROUND.map(|(right, down)| {
                let before = if right == 0.0 { 0.5 } else { f64::from(right < 0.0) };
                let middle = y + (distance + 0.4 * NOTE_SIZE) * down;
                Rect::new((x + distance * right - before * width, middle - 0.42 * NOTE_SIZE), (width, NOTE_SIZE))
            })
        };
        // Beside a vertical line at its ends first; at the sides of a point, near ones first.
        let along = || [0.96, 0.04, 0.5, 0.83, 0.17, 0.7, 0.3].map(|up| around(placed.frame.at(0.0, up).1, 6.0));
        let places =
            if spot.at.1.is_infinite() { along().concat() } else { [9.0, 18.0].map(|far| around(y, far)).concat() };
        let is_outside = |rect: &Rect| !rect.corners().iter().all(|corner| placed.frame.contains(*corner));
        let freest = places.into_iter().min_by_key(|rect| (is_outside(rect), cover(taken, &rect.grown(2.0))));
        let Some(rect) = freest.filter(|_| !text.trim().is_empty()) else { continue };
        taken.extend(around_text(&rect));
        let room = placed.frame.grown(-1.0);
        let corners = rect.grown(1.5).ends().map(|corner| room.nearest(corner));
        page.draw(&Rectangle::new(corners, PAPER.filled()))?;
        page.draw(&words(text, rect.at(0.5, 0.58), Font(NOTE_SIZE, placed.color(item.tint), Align::Middle)))?;
    }
    Ok(())
}

/// Returns points that must not be hidden: of lines, markers and texts.
pub(super) fn taken(shapes: &[Shape]) -> Vec<Pt> {
    let of = |shape: &Shape| match shape {
        Shape::Text(text) => around_text(&text.bounds()),
        Shape::Drawn(_, lines) => lines.iter().flat_map(|line| dotted(line, 5.0)).collect(),
    };
    shapes.iter().flat_map(of).collect()
}

/// Returns the number of points that a rectangle would hide.
pub(super) fn cover(taken: &[Pt], rect: &Rect) -> usize {
    taken.iter().filter(|point| rect.contains(**point)).count()
}

/// Returns points around a text, so many that lines are hidden rather than it.
fn around_text(rect: &Rect) -> Vec<Pt> {
    let [a, b, c, d] = rect.corners();
    dotted(&[a, b, c, d, a], 0.5).collect()
}

/// Returns points along a line, at most some pixels apart.
fn dotted(line: &[Pt], apart: f64) -> impl Iterator<Item = Pt> {
    let between = move |pair: &[Pt]| {
        let (x, y) = pair[0];
        let right = pair[1].0 - x;
        let down = pair[1].1 - y;
        let steps = (right.hypot(down) / apart).ceil().clamp(1.0, 4000.0);
        (1..=steps as usize).map(move |k| (x + k as f64 / steps * right, y + k as f64 / steps * down))
    };
    line.first().copied().into_iter().chain(line.windows(2).flat_map(between))
}
