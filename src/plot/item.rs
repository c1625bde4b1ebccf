//! Items drawn freely in a panel, at positions in data coordinates with sizes in pixels.

use super::data::Marker;
use super::*;

/// Position of a point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Place {
    /// A position in data coordinates; infinite ones are at the ends of the axes.
    Data(f64, f64),
    /// A position in the frame: (0, 0) is its lower left corner, (1, 1) its upper right one.
    Frame(f64, f64),
}

/// A point at an offset in nominal pixels from a position, independent of the scale.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spot {
    /// The position.
    pub at: Place,
    /// Offset to the right and up, nominal pixels.
    pub step: (f64, f64),
}

impl Spot {
    /// The point at a position in data coordinates.
    pub fn data(x: f64, y: f64) -> Self {
        Self { at: Place::Data(x, y), step: (0.0, 0.0) }
    }

    /// Returns the point moved to the right and up by these nominal pixels.
    pub fn moved(self, right: f64, up: f64) -> Self {
        Self { step: (self.step.0 + right, self.step.1 + up), ..self }
    }

    /// Returns its position in the picture; none if it is not a number.
    pub(super) fn put(&self, placed: &Placed) -> Option<Pt> {
        let end = |axis: &Axis, value: f64| {
            if value.is_finite() { value } else { axis.value(if value > 0.0 { 1.0 } else { 0.0 }) }
        };
        let (x, y) = match self.at {
            Place::Data(x, y) => placed.at(end(&placed.x, x), end(&placed.y, y))?,
            Place::Frame(right, up) => placed.frame.at(right, up),
        };
        Some((x + self.step.0, y - self.step.1)).filter(|at| at.0.is_finite() && at.1.is_finite())
    }
}

/// A colour of the palette with its paleness: 0 is full, 1 is paper.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Tint {
    /// Black to grey.
    Ink(f64),
    /// The colour that series of this index in a panel have.
    Body(usize, f64),
}

/// Kind of an item.
#[derive(Clone, Debug, PartialEq)]
pub enum Form {
    /// A line of a width in pixels through the points; true if it is dashed.
    Line(f64, bool),
    /// A convex polygon without an outline, of an opacity: 1 hides the items below.
    Area(f64),
    /// A disc of a radius in pixels.
    Disc(f64),
    /// A small text, whose point lies on the baseline.
    Text(String, Align),
    /// A small text at the side of its point where it hides least.
    Note(String),
}

/// An item to draw.
#[derive(Clone, Debug, PartialEq)]
pub struct Item {
    /// Its points, one for discs and texts.
    pub spots: Vec<Spot>,
    /// Its colour.
    pub tint: Tint,
    /// Its kind.
    pub form: Form,
}

impl Item {
    /// Returns its positions in data coordinates.
    pub fn data(&self) -> impl Iterator<Item = (f64, f64)> + '_ {
        self.spots.iter().filter_map(|spot| match spot.at {
            Place::Data(x, y) => Some((x, y)),
            Place::Frame(..) => None,
        })
    }

    /// Draws it at points, cut off at a rectangle. Notes are drawn when it is known what they would hide.
    fn draw(&self, page: &Page, points: &[Pt], within: &Rect) -> Done {
        let color = tint(self.tint);
        let mut center = points.iter().copied().filter(|point| within.contains(*point)).take(1);
        match &self.form {
            Form::Line(width, dashed) => {
                let stroke = Stroke { color, width: *width, dash: if *dashed { DASHED } else { &[] } };
                clip::polyline(points, within).into_iter().try_for_each(|part| page.draw(&Curve::new(part, stroke)))
            }
            Form::Area(opacity) => {
                let corners: Vec<_> = points.iter().map(|point| units(within.nearest(*point))).collect();
                page.draw(&Polygon::new(corners, color.mix(*opacity)))
            }
            Form::Disc(radius) => center.try_for_each(|at| Marker::Circle.draw(page, at, *radius, color)),
            Form::Text(text, align) => {
                let style = font(NOTE_SIZE, color, *align);
                center.try_for_each(|(x, y)| page.draw_text(text, &style, units((x, y - HALF_DIGIT * NOTE_SIZE))))
            }
            Form::Note(_) => Ok(()),
        }
    }
}

/// How far items may reach beyond the frame, nominal pixels.
const BEYOND: f64 = 24.0;
/// Half the side of the square that an inset needs.
const INSET: f64 = 42.0;

/// Draws the items of a panel; not those with a point that is not a number.
pub(super) fn draw(page: &Page, placed: &Placed) -> Done {
    let points = |item: &Item| item.spots.iter().map(|spot| spot.put(placed)).collect::<Option<Vec<Pt>>>();
    let mut items = placed.panel.items.iter().filter_map(|item| Some((item, points(item)?)));
    items.try_for_each(|(item, points)| item.draw(page, &points, &placed.frame.grown(BEYOND)))
}

/// Draws the inset in the corner where it hides least.
pub(super) fn inset(page: &Page, placed: &Placed, taken: &mut Taken) -> Done {
    let corners = [(0.0, 0.0), (1.0, 0.0), (0.0, 1.0), (1.0, 1.0)];
    let squares =
        corners.map(|(right, up)| Rect::new(placed.frame.grown(-INSET).at(right, up), (0.0, 0.0)).grown(INSET));
    let Some(free) = squares.into_iter().min_by_key(|square| taken.cover(square, 0.0)) else { return Ok(()) };
    for item in &placed.panel.inset {
        let (x, y) = free.at(0.5, 0.5);
        let points: Vec<Pt> = item.spots.iter().map(|spot| (x + spot.step.0, y - spot.step.1)).collect();
        item.draw(page, &points, &free.grown(INSET))?;
        taken.rects.push(free);
    }
    Ok(())
}
