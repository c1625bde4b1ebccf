//! Items drawn freely in a panel, at positions in data coordinates with sizes in pixels.

use super::axes;
use super::layout::Placed;
use super::legend::Taken;
use super::palette::{DASHED, NOTE_SIZE, tint};
use super::shape::{Align, Drawing, Marker, Pt, Rect, Shape, Stroke};

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

    /// Returns its shape, by a function that gives the position of each point; none if one has none.
    fn shape(&self, put: &impl Fn(&Spot) -> Option<Pt>) -> Option<Shape> {
        let all = |spots: &[Spot]| spots.iter().map(put).collect::<Option<Vec<Pt>>>();
        Some(match self {
            Self::Line { spots, tint: color, width, dashed } => {
                let dash = if *dashed { DASHED } else { &[] };
                Shape::Path { points: all(spots)?, stroke: Stroke { color: tint(*color), width: *width, dash } }
            }
            Self::Area { spots, tint: color, opacity } => {
                let mut points = all(spots)?;
                points.extend(points.first().copied());
                Shape::Area { points, fill: tint(*color), opacity: *opacity }
            }
            Self::Disc { spot, radius, tint: color } => {
                Shape::Marks { at: vec![put(spot)?], marker: Marker::Circle, radius: *radius, color: tint(*color) }
            }
            Self::Text { spot, text, align } => Shape::Text(axes::text(put(spot)?, text, NOTE_SIZE, *align)),
        })
    }
}

/// Returns the items of a panel as shapes.
pub(super) fn shapes(placed: &Placed) -> Vec<Shape> {
    let frame = placed.frame;
    let put = |spot: &Spot| {
        let (x, y) = match spot.at {
            Place::Data(x, y) => placed.at(x, y)?,
            Place::Frame(x, y) => (frame.left + x * frame.width(), frame.bottom - y * frame.height()),
        };
        Some((x + spot.step.0, y - spot.step.1))
    };
    placed.panel.items.iter().filter_map(|item| item.shape(&put)).collect()
}

/// Half the side of the square that an inset needs.
const INSET: f64 = 42.0;

/// Draws the inset in the corner where it hides least.
pub(super) fn inset(drawing: &mut Drawing, placed: &Placed, taken: &mut Taken) {
    if placed.panel.inset.is_empty() {
        return;
    }
    let inner = placed.frame.grown(-INSET);
    let corners =
        [(inner.left, inner.bottom), (inner.right, inner.bottom), (inner.left, inner.top), (inner.right, inner.top)];
    let square = |(x, y): Pt| Rect::new(x, y, 0.0, 0.0).grown(INSET);
    let free = corners.into_iter().min_by_key(|corner| taken.cover(&square(*corner), 0.0));
    let center = free.unwrap_or(corners[0]);
    taken.rects.push(square(center));
    let put = |spot: &Spot| Some((center.0 + spot.step.0, center.1 - spot.step.1));
    drawing.shapes.extend(placed.panel.inset.iter().filter_map(|item| item.shape(&put)));
}
