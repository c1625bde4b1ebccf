//! Items drawn freely in a panel, at positions in data coordinates with sizes in pixels.

use super::*;
use crate::math::polyline::clipped;

/// A point at an offset in nominal pixels from a position, independent of the scale.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spot {
    /// Position in data coordinates; infinite ones are at the ends of the axes.
    pub at: (f64, f64),
    /// Offset to the right and up, nominal pixels.
    pub step: (f64, f64),
}

impl Spot {
    pub fn data(x: f64, y: f64) -> Self {
        Self { at: (x, y), step: (0.0, 0.0) }
    }

    /// Returns the point moved to the right and up by these nominal pixels.
    pub fn moved(self, right: f64, up: f64) -> Self {
        Self { step: (self.step.0 + right, self.step.1 + up), ..self }
    }

    /// Returns its position in the picture; none if it is not a number.
    pub(super) fn put(&self, placed: &PlacedPanel) -> Option<Pt> {
        let place = |axis: &PlotAxis, value: f64| match value {
            f64::INFINITY => Some(1.0),
            f64::NEG_INFINITY => Some(0.0),
            _ => axis.place(value),
        };
        let (x, y) = placed.frame.at(place(&placed.x, self.at.0)?, place(&placed.y, self.at.1)?);
        Some((x + self.step.0, y - self.step.1)).filter(|at| at.0.is_finite() && at.1.is_finite())
    }
}

/// A colour of the palette with its paleness, of which 0 is full and 1 is paper, or one of the colour bar.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Tint {
    /// Black to grey.
    Ink(f64),
    /// The colour that series of this index in a panel have.
    Body(usize, f64),
    /// The colour of a value on the colour bar.
    Value(f64),
}

#[derive(Clone, Debug, PartialEq)]
pub enum ItemForm {
    /// A line of a width in pixels through the points; true if it is dashed.
    Line(f64, bool),
    /// A convex polygon without an outline, of an opacity: 1 hides the items below.
    Area(f64),
    /// A polygon that leaves no seam between it and its neighbours.
    Cell,
    /// A disc of a radius in pixels.
    Disc(f64),
    /// A small text, whose point lies on the baseline.
    Text(String, Align),
    /// A small text at the side of its point where it hides least.
    Note(String),
}

#[derive(Clone, Debug, PartialEq)]
pub struct Item {
    /// Its points, one for discs and texts.
    pub spots: Vec<Spot>,
    pub tint: Tint,
    pub form: ItemForm,
}

impl Item {
    /// Draws it at points, cut off at a rectangle. Notes are drawn when it is known what they would hide.
    fn draw(&self, page: &Page, color: Color, points: &[Pt], within: &Rect) -> Done {
        let center = points.iter().copied().find(|point| within.contains(*point));
        let corners: Vec<Pt> = points.iter().map(|point| within.nearest(*point)).collect();
        match (&self.form, center) {
            (ItemForm::Line(width, dashed), _) => {
                let stroke = Stroke { color, width: *width, dash: if *dashed { DASHED } else { &[] } };
                clipped(points, within.ends()).into_iter().try_for_each(|part| page.draw(&StrokedLine(part, stroke)))
            }
            (ItemForm::Area(opacity), _) => page.draw(&Polygon::new(corners, color.mix(*opacity))),
            (ItemForm::Cell, _) => page.draw(&Rectangle::new([corners[0], corners[2]], color.filled())),
            (ItemForm::Disc(radius), Some(at)) => Marker::Circle.draw(page, at, *radius, color),
            (ItemForm::Text(text, align), Some((x, y))) => {
                page.draw(&words(text, (x, y - HALF_DIGIT * NOTE_SIZE), Font(NOTE_SIZE, color, *align)))
            }
            _ => Ok(()),
        }
    }
}

/// Draws the items of a panel; not those with a point that is not a number.
pub(super) fn draw(page: &Page, placed: &PlacedPanel) -> Done {
    placed.panel.items.iter().try_for_each(|item| {
        let points: Option<Vec<Pt>> = item.spots.iter().map(|spot| spot.put(placed)).collect();
        let draw = |points: Vec<Pt>| item.draw(page, placed.color(item.tint), &points, &placed.frame.grown(24.0));
        points.map_or(Ok(()), draw)
    })
}
