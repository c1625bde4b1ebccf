//! Notes, and where texts hide least.

use super::item::Form;
use super::*;

/// Draws the notes of a panel, each where it hides least.
pub(super) fn draw(page: &Page, placed: &Placed, taken: &mut Taken) -> Done {
    for item in &placed.panel.items {
        let (Form::Note(text), [spot]) = (&item.form, &item.spots[..]) else { continue };
        let Some(at) = spot.put(placed).filter(|at| placed.frame.contains(*at)) else { continue };
        let is_free = matches!(spot.at, Place::Data(_, y) if y.is_infinite());
        settle(page, placed, text, &if is_free { along(placed, at.0) } else { beside(at) }, tint(item.tint), taken)?;
    }
    Ok(())
}

/// Returns positions at the sides of a point, near ones first.
fn beside(at: Pt) -> Vec<(Pt, Align)> {
    [around(at, 9.0), around(at, 18.0)].concat()
}

/// Returns positions beside a vertical line, those at its ends first.
fn along(placed: &Placed, x: f64) -> Vec<(Pt, Align)> {
    let heights = [0.96, 0.04, 0.5, 0.83, 0.17, 0.7, 0.3].map(|up| placed.frame.at(0.0, up).1);
    heights.into_iter().flat_map(|y| around((x, y), 6.0)).collect()
}

/// Returns positions at a distance from a point, those at its sides first.
fn around((x, y): Pt, distance: f64) -> Vec<(Pt, Align)> {
    const SIDES: [(f64, f64, Align); 8] = [
        (1.0, 0.0, Align::Start),
        (-1.0, 0.0, Align::End),
        (0.0, -1.0, Align::Middle),
        (0.0, 1.0, Align::Middle),
        (0.8, -0.8, Align::Start),
        (-0.8, -0.8, Align::End),
        (0.8, 0.8, Align::Start),
        (-0.8, 0.8, Align::End),
    ];
    let place = |(right, down, align)| ((x + distance * right, y + (distance + 0.4 * NOTE_SIZE) * down), align);
    SIDES.map(place).to_vec()
}

/// Draws a text at the place where it hides least, the first of equals, in a box of paper colour.
fn settle(page: &Page, placed: &Placed, text: &str, at: &[(Pt, Align)], color: Color, taken: &mut Taken) -> Done {
    let width = text::width(text, NOTE_SIZE);
    let bounds =
        |((x, y), align): &(Pt, Align)| Rect::new((x - align.part() * width, y - 0.42 * NOTE_SIZE), (width, NOTE_SIZE));
    let inside = at.iter().filter(|place| bounds(place).corners().iter().all(|corner| placed.frame.contains(*corner)));
    let best = inside.min_by_key(|place| taken.cover(&bounds(place), 2.0)).or(at.first());
    let Some(best) = best.filter(|_| !text.trim().is_empty()) else { return Ok(()) };
    taken.rects.push(bounds(best));
    let room = placed.frame.grown(-1.0);
    let corners = bounds(best).grown(1.5).corners().map(|corner| units(room.nearest(corner)));
    page.draw(&Rectangle::new(corners, PAPER.filled()))?;
    page.draw_text(text, &font(NOTE_SIZE, color, best.1), units(best.0))
}

/// Parts of a panel that must not be hidden.
#[derive(Clone, Debug, Default)]
pub(super) struct Taken {
    points: Vec<Pt>,
    pub rects: Vec<Rect>,
}

impl Taken {
    /// The positions of lines, markers and texts.
    pub fn new(shapes: &[Shape]) -> Self {
        let mut taken = Self::default();
        for shape in shapes {
            match shape {
                Shape::Text(text) => taken.rects.push(text.bounds()),
                Shape::Drawn(_, lines) => {
                    taken.points.extend(lines.iter().filter_map(|line| line.first()));
                    lines.iter().flat_map(|line| line.windows(2)).for_each(|pair| taken.segment(pair[0], pair[1]));
                }
            }
        }
        taken
    }

    fn segment(&mut self, from: Pt, to: Pt) {
        let right = to.0 - from.0;
        let down = to.1 - from.1;
        let steps = (right.hypot(down) / 5.0).ceil().clamp(1.0, 4000.0);
        let parts = (1..=steps as usize).map(|k| k as f64 / steps);
        self.points.extend(parts.map(|part| (from.0 + part * right, from.1 + part * down)));
    }

    /// Returns a measure of the parts that a rectangle would hide, or that are within `border` of it.
    pub fn cover(&self, rect: &Rect, border: f64) -> usize {
        let near = rect.grown(border);
        let points = self.points.iter().filter(|point| near.contains(**point)).count();
        points + 60 * self.rects.iter().filter(|other| other.overlaps(&near)).count()
    }
}
