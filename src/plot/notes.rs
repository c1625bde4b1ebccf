//! Notes, and where texts hide least.

use super::*;

/// Corners of a frame, then the middles of its sides: parts of the width and height from the lower left corner.
pub(super) const SIDES: [(f64, f64); 8] =
    [(1.0, 1.0), (0.0, 1.0), (1.0, 0.0), (0.0, 0.0), (1.0, 0.5), (0.0, 0.5), (0.5, 1.0), (0.5, 0.0)];

/// Draws the notes of a panel, each at the place where it hides least, in a box of paper colour.
pub(super) fn draw(out: &mut Shapes, placed: &Placed, taken: &mut Taken) {
    for item in &placed.panel.items {
        let (Form::Note(text), [spot]) = (&item.form, &item.spots[..]) else { continue };
        let Some((x, y)) = spot.put(placed).filter(|at| placed.frame.contains(*at)) else { continue };
        // Beside a vertical line at its ends first; at the sides of a point, near ones first.
        let along = [0.96, 0.04, 0.5, 0.83, 0.17, 0.7, 0.3].map(|up| around((x, placed.frame.at(0.0, up).1), 6.0));
        let beside = [9.0, 18.0].map(|distance| around((x, y), distance));
        let places = if spot.at.1.is_infinite() { along.concat() } else { beside.concat() };
        let width = text::width(text, NOTE_SIZE);
        let bounds = |((x, y), align): (Pt, Align)| {
            (Rect::new((x - align.part() * width, y - 0.42 * NOTE_SIZE), (width, NOTE_SIZE)), ((x, y), align))
        };
        let is_inside = |place: &(Rect, _)| place.0.corners().iter().all(|corner| placed.frame.contains(*corner));
        let mut places: Vec<(Rect, (Pt, Align))> = places.into_iter().map(bounds).collect();
        // One that is outside is better than none.
        if places.iter().any(is_inside) {
            places.retain(is_inside);
        } else {
            places.truncate(1);
        }
        let Some((rect, (at, align))) = taken.freest(places, 2.0).filter(|_| !text.trim().is_empty()) else { continue };
        let room = placed.frame.grown(-1.0);
        out.draw(Paint::Area(PAPER, 1.0, true), rect.grown(1.5).corners().map(|corner| room.nearest(corner)));
        out.text(text, at, Font(NOTE_SIZE, tint(item.tint), align));
    }
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

/// Parts of a panel that must not be hidden.
#[derive(Clone, Debug, Default)]
pub(super) struct Taken {
    points: Vec<Pt>,
    rects: Vec<Rect>,
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

    /// Occupies the place where a rectangle hides least, the first of equals, and returns it with what comes with it.
    pub fn freest<T>(&mut self, places: impl IntoIterator<Item = (Rect, T)>, border: f64) -> Option<(Rect, T)> {
        let freest = places.into_iter().min_by_key(|(rect, _)| self.cover(rect, border))?;
        self.rects.push(freest.0);
        Some(freest)
    }

    /// Returns a measure of the parts that a rectangle would hide, or that are within `border` of it.
    pub fn cover(&self, rect: &Rect, border: f64) -> usize {
        let near = rect.grown(border);
        let points = self.points.iter().filter(|point| near.contains(**point)).count();
        points + 60 * self.rects.iter().filter(|other| other.overlaps(&near)).count()
    }
}
