//! Items drawn freely in a panel, at positions in data coordinates with sizes in pixels.

use super::data::Marker;
use super::*;
use plotters_backend::BackendCoord;

/// Position of a point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Place {
    /// A position in data coordinates.
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
}

/// A colour of the palette with its paleness: 0 is full, 1 is paper.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Tint {
    /// Black to grey.
    Ink(f64),
    /// The colour that series of this index in a panel have.
    Body(usize, f64),
    /// White.
    Paper,
}

/// An item to draw.
#[derive(Clone, Debug, PartialEq)]
pub enum Item {
    /// A line through points.
    Line {
        /// The points.
        spots: Vec<Spot>,
        /// Its colour.
        tint: Tint,
        /// Its width in pixels.
        width: f64,
        /// True if it is dashed.
        dashed: bool,
    },
    /// A convex polygon without an outline.
    Area {
        /// Its corners.
        spots: Vec<Spot>,
        /// Its colour.
        tint: Tint,
        /// 1 hides the items below.
        opacity: f64,
    },
    /// A disc.
    Disc {
        /// Its centre.
        spot: Spot,
        /// Its radius in pixels.
        radius: f64,
        /// Its colour.
        tint: Tint,
    },
    /// A small text; its point lies on the baseline.
    Text {
        /// The point.
        spot: Spot,
        /// The text.
        text: String,
        /// Alignment of the text at the point.
        align: Align,
    },
}

impl Item {
    fn spots(&self) -> &[Spot] {
        match self {
            Self::Line { spots, .. } | Self::Area { spots, .. } => spots,
            Self::Disc { spot, .. } | Self::Text { spot, .. } => std::slice::from_ref(spot),
        }
    }

    /// Returns its positions in data coordinates.
    pub fn data(&self) -> impl Iterator<Item = (f64, f64)> + '_ {
        self.spots().iter().filter_map(|spot| match spot.at {
            Place::Data(x, y) => Some((x, y)),
            Place::Frame(..) => None,
        })
    }

    /// Draws it within a rectangle, by a function that gives the position of each point; not if one has none.
    fn draw(&self, page: &Page, put: &impl Fn(&Spot) -> Option<Pt>, within: &Rect) -> Done {
        let Some(points) = self.spots().iter().map(put).collect::<Option<Vec<Pt>>>() else { return Ok(()) };
        let spots = |points: Vec<Pt>| points.into_iter().map(units).collect::<Vec<BackendCoord>>();
        let center = points.iter().copied().filter(|point| within.contains(*point)).take(1);
        match self {
            Self::Line { tint: color, width, dashed, .. } => {
                let stroke = Stroke { color: tint(*color), width: *width, dash: if *dashed { DASHED } else { &[] } };
                let mut parts = clip::polyline(&points, within).into_iter();
                parts.try_for_each(|part| page.draw(&Curve(spots(part), stroke)))
            }
            Self::Area { tint: color, opacity, .. } => {
                page.draw(&Polygon::new(spots(clip::polygon(&points, within)), tint(*color).mix(*opacity)))
            }
            Self::Disc { radius, tint: color, .. } => {
                Marker::Circle.draw(page, center.map(units), *radius, tint(*color))
            }
            Self::Text { text, align, .. } => {
                let mut middle = center.map(|(x, y)| units((x, y - HALF_DIGIT * NOTE_SIZE)));
                middle.try_for_each(|at| page.draw_text(text, &font(NOTE_SIZE, INK, *align), at))
            }
        }
    }
}

/// How far items may reach beyond the frame, nominal pixels.
const BEYOND: f64 = 24.0;
/// Half the side of the square that an inset needs.
const INSET: f64 = 42.0;

/// Draws the items of a panel.
pub(super) fn draw(page: &Page, placed: &Placed) -> Done {
    let put = |spot: &Spot| {
        let (x, y) = match spot.at {
            Place::Data(x, y) => placed.at(x, y)?,
            Place::Frame(x, y) => placed.frame.at(x, y),
        };
        Some((x + spot.step.0, y - spot.step.1)).filter(|at| at.0.is_finite() && at.1.is_finite())
    };
    placed.panel.items.iter().try_for_each(|item| item.draw(page, &put, &placed.frame.grown(BEYOND)))
}

/// Draws the inset in the corner where it hides least.
pub(super) fn inset(page: &Page, placed: &Placed, taken: &mut Taken) -> Done {
    if placed.panel.inset.is_empty() {
        return Ok(());
    }
    let corners = [(0.0, 0.0), (1.0, 0.0), (0.0, 1.0), (1.0, 1.0)];
    let centers = corners.map(|(right, up)| placed.frame.grown(-INSET).at(right, up));
    let square = |center: Pt| Rect::new(center, (0.0, 0.0)).grown(INSET);
    let free = centers.into_iter().min_by_key(|center| taken.cover(&square(*center), 0.0));
    let (x, y) = free.unwrap_or(centers[0]);
    taken.rects.push(square((x, y)));
    let put = |spot: &Spot| Some((x + spot.step.0, y - spot.step.1));
    placed.panel.inset.iter().try_for_each(|item| item.draw(page, &put, &square((x, y)).grown(INSET)))
}
