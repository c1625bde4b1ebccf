//! Vertical lines, annotations, and where texts hide least.

use super::*;

/// Returns the position of a vertical line at a part of its height, if it lies within the frame.
fn on_line(placed: &Placed, x: f64, up: f64) -> Option<Pt> {
    let place = placed.x.place(x).filter(|place| (0.0..=1.0).contains(place))?;
    Some(placed.frame.at(place, up))
}

/// Draws the vertical lines.
pub(super) fn verticals(chart: &Chart, placed: &Placed) -> Done {
    let ends = [placed.y.value(0.0), placed.y.value(1.0)];
    let shown = placed.panel.verticals.iter().filter(|(x, _)| on_line(placed, *x, 0.5).is_some());
    let mut lines = shown.map(|(x, _)| Curve(ends.map(|end| (*x, end)).to_vec(), REFERENCE));
    lines.try_for_each(|line| chart.plotting_area().draw(&line))
}

/// Draws the labels of vertical lines and annotations, each where it hides least.
pub(super) fn texts(page: &Page, placed: &Placed, taken: &mut Taken) -> Done {
    for (x, label) in placed.panel.verticals.iter().filter(|line| !line.1.trim().is_empty()) {
        let heights = [0.96, 0.04, 0.5, 0.83, 0.17, 0.7, 0.3, 0.6, 0.4];
        let at = heights.into_iter().filter_map(|up| on_line(placed, *x, up)).flat_map(|at| around(at, 6.0));
        settle(page, placed, label, &at.collect::<Vec<_>>(), NOTE_INK, taken)?;
    }
    for note in &placed.panel.annotations {
        if let Some(at) = placed.at(note.x, note.y).filter(|at| placed.frame.contains(*at)) {
            let near_and_far = [around(at, 9.0), around(at, 18.0)].concat();
            settle(page, placed, &note.text, &near_and_far, tint(note.tint), taken)?;
        }
    }
    Ok(())
}

/// Draws a text at the place where it hides least, the first of equals, in a box of paper colour.
fn settle(page: &Page, placed: &Placed, text: &str, at: &[(Pt, Align)], color: Color, taken: &mut Taken) -> Done {
    let width = text::width(text, NOTE_SIZE);
    let bounds =
        |((x, y), align): &(Pt, Align)| Rect::new((x - align.part() * width, y - 0.42 * NOTE_SIZE), (width, NOTE_SIZE));
    let inside = at.iter().filter(|place| bounds(place).corners().iter().all(|corner| placed.frame.contains(*corner)));
    let best = inside.min_by_key(|place| taken.cover(&bounds(place), 2.0)).or(at.first());
    let Some(best) = best else { return Ok(()) };
    taken.rects.push(bounds(best));
    page.draw(&Rectangle::new(bounds(best).grown(1.5).corners().map(units), PAPER.filled()))?;
    page.draw_text(text, &font(NOTE_SIZE, color, best.1), units(best.0))
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
        let (right, down) = (to.0 - from.0, to.1 - from.1);
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
