//! The flat list of shapes from which files are written. Coordinates are nominal pixels, y down.

use super::text::Rich;
use std::ops::Range;

/// A point of the picture.
pub(super) type Pt = (f64, f64);

/// An opaque colour.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Color(pub u8, pub u8, pub u8);

/// A rectangle parallel to the axes.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Rect {
    pub left: f64,
    pub top: f64,
    pub right: f64,
    pub bottom: f64,
}

impl Rect {
    pub fn new(left: f64, top: f64, width: f64, height: f64) -> Self {
        Self { left, top, right: left + width, bottom: top + height }
    }

    pub fn width(&self) -> f64 {
        self.right - self.left
    }

    pub fn height(&self) -> f64 {
        self.bottom - self.top
    }

    pub fn center(&self) -> Pt {
        (0.5 * (self.left + self.right), 0.5 * (self.top + self.bottom))
    }

    pub fn contains(&self, (x, y): Pt) -> bool {
        x >= self.left && x <= self.right && y >= self.top && y <= self.bottom
    }

    /// Returns this rectangle, larger on every side.
    pub fn grown(&self, by: f64) -> Self {
        Self { left: self.left - by, top: self.top - by, right: self.right + by, bottom: self.bottom + by }
    }

    pub fn overlaps(&self, other: &Self) -> bool {
        self.left < other.right && other.left < self.right && self.top < other.bottom && other.top < self.bottom
    }

    pub fn holds(&self, other: &Self) -> bool {
        self.contains((other.left, other.top)) && self.contains((other.right, other.bottom))
    }

    /// Returns the outline, closed.
    pub fn outline(&self) -> Vec<Pt> {
        let corners = [(self.left, self.top), (self.right, self.top), (self.right, self.bottom)];
        corners.into_iter().chain([(self.left, self.bottom), (self.left, self.top)]).collect()
    }
}

/// Colour, width and dashes of a line.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Stroke {
    pub color: Color,
    pub width: f64,
    /// Lengths of dash, gap, dash, ...; empty: solid.
    pub dash: &'static [f64],
}

/// Shape of a point.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Marker {
    Circle,
    Square,
    Triangle,
    Diamond,
    TriangleDown,
    Cross,
}

/// Alignment of a text at its position.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Align {
    /// The text starts there.
    Start,
    /// Its middle is there.
    Middle,
    /// The text ends there.
    End,
}

/// A line of text; `at` is on its baseline.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Text {
    pub at: Pt,
    pub rich: Rich,
    pub size: f64,
    pub color: Color,
    pub align: Align,
    /// True if rotated by 90 degrees, to be read upwards.
    pub turned: bool,
}

impl Text {
    /// Returns the start of the text along its baseline, relative to its position.
    pub fn start(&self) -> f64 {
        let part = match self.align {
            Align::Start => 0.0,
            Align::Middle => -0.5,
            Align::End => -1.0,
        };
        part * self.rich.width(self.size)
    }

    /// Returns the box around the text, as measured with the embedded font.
    pub fn bounds(&self) -> Rect {
        let (start, width) = (self.start(), self.rich.width(self.size));
        let (above, below) = (0.78 * self.size, 0.22 * self.size);
        let (x, y) = self.at;
        if self.turned {
            return Rect { left: x - above, right: x + below, top: y - start - width, bottom: y - start };
        }
        Rect { left: x + start, right: x + start + width, top: y - above, bottom: y + below }
    }
}

/// A shape to draw.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Shape {
    Path {
        points: Vec<Pt>,
        stroke: Stroke,
    },
    /// A convex polygon, transparent by its opacity.
    Area {
        points: Vec<Pt>,
        fill: Color,
        opacity: f64,
    },
    Rects {
        rects: Vec<Rect>,
        fill: Color,
    },
    Marks {
        at: Vec<Pt>,
        marker: Marker,
        radius: f64,
        color: Color,
    },
    Text(Text),
}

/// A picture.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Drawing {
    pub width: f64,
    pub height: f64,
    /// Title for screen readers and file browsers.
    pub title: String,
    pub shapes: Vec<Shape>,
    /// Range of the panels' items among the shapes: the moving part of an animation.
    pub items: Range<usize>,
}

impl Drawing {
    pub fn line(&mut self, from: Pt, to: Pt, stroke: Stroke) {
        self.shapes.push(Shape::Path { points: vec![from, to], stroke });
    }

    pub fn fill(&mut self, rect: Rect, fill: Color) {
        self.shapes.push(Shape::Rects { rects: vec![rect], fill });
    }

    /// Adds a text, unless it is empty.
    pub fn text(&mut self, text: Text) {
        if !text.rich.runs.is_empty() {
            self.shapes.push(Shape::Text(text));
        }
    }
}

impl Marker {
    /// Returns the line width of the marker made of strokes; the others are filled.
    pub fn stroke_width(self, radius: f64) -> Option<f64> {
        (self == Self::Cross).then_some(0.42 * radius)
    }

    /// Returns its lines or filled outlines around a point. Areas are about equal; the circle is drawn as such.
    pub fn outlines(self, (x, y): Pt, radius: f64) -> Vec<Vec<Pt>> {
        let at = |points: &[Pt]| points.iter().map(|p| (x + radius * p.0, y + radius * p.1)).collect::<Vec<Pt>>();
        match self {
            Self::Circle => Vec::new(),
            Self::Square => vec![Rect::new(x, y, 0.0, 0.0).grown(0.89 * radius).outline()],
            Self::Triangle => vec![at(&[(0.0, -1.3), (1.2, 0.85), (-1.2, 0.85), (0.0, -1.3)])],
            Self::TriangleDown => vec![at(&[(0.0, 1.3), (1.2, -0.85), (-1.2, -0.85), (0.0, 1.3)])],
            Self::Diamond => vec![at(&[(0.0, -1.35), (1.15, 0.0), (0.0, 1.35), (-1.15, 0.0), (0.0, -1.35)])],
            Self::Cross => vec![at(&[(-0.9, -0.9), (0.9, 0.9)]), at(&[(-0.9, 0.9), (0.9, -0.9)])],
        }
    }
}
