//! Shapes, from which files are written. Coordinates are nominal pixels, y down.

use super::sketch::DrawingResult;
use super::text::Rich;
use std::ops::Range;

pub(super) use plotters::style::RGBColor as Color;

pub(super) type Pt = (f64, f64);

#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Rect {
    pub left: f64,
    pub top: f64,
    pub right: f64,
    pub bottom: f64,
}

impl Rect {
    pub fn new((left, top): Pt, (width, height): (f64, f64)) -> Self {
        Self { left, top, right: left + width, bottom: top + height }
    }

    pub fn size(&self) -> (f64, f64) {
        (self.right - self.left, self.bottom - self.top)
    }

    /// Returns the point at parts of its width and height from the lower left corner.
    pub fn at(&self, right: f64, up: f64) -> Pt {
        let (width, height) = self.size();
        (self.left + right * width, self.bottom - up * height)
    }

    pub fn corners(&self) -> [Pt; 4] {
        [(self.left, self.top), (self.right, self.top), (self.right, self.bottom), (self.left, self.bottom)]
    }

    pub fn ends(&self) -> [Pt; 2] {
        [(self.left, self.top), (self.right, self.bottom)]
    }

    pub fn contains(&self, (x, y): Pt) -> bool {
        x >= self.left && x <= self.right && y >= self.top && y <= self.bottom
    }

    pub fn nearest(&self, (x, y): Pt) -> Pt {
        (x.max(self.left).min(self.right), y.max(self.top).min(self.bottom))
    }

    pub fn grown(&self, by: f64) -> Self {
        Self { left: self.left - by, top: self.top - by, right: self.right + by, bottom: self.bottom + by }
    }
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Stroke {
    pub color: Color,
    pub width: f64,
    /// Lengths of dash, gap, dash, ...; empty: solid.
    pub dash: &'static [f64],
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Align {
    Start,
    Middle,
    End,
}

impl Align {
    /// Returns the part of a text before its position.
    pub(super) fn part(self) -> f64 {
        [0.0, 0.5, 1.0][self as usize]
    }
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Font(pub f64, pub Color, pub Align);

/// A line of text; `at` is on its baseline.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Text {
    pub at: Pt,
    pub rich: Rich,
    pub font: Font,
    /// True if rotated by 90 degrees, to be read upwards.
    pub turned: bool,
}

impl Text {
    pub fn bounds(&self) -> Rect {
        let Self { at: (x, y), rich, font: Font(size, _, align), turned } = self;
        let width = rich.width(*size);
        let before = align.part() * width;
        let above = 0.78 * size;
        if *turned {
            return Rect::new((x - above, y + before - width), (*size, width));
        }
        Rect::new((x - before, y - above), (width, *size))
    }
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Paint {
    Line(Stroke),
    /// A polygon of an opacity; crisp ones leave no seam between neighbours.
    Area(Color, f64, bool),
    /// A disc of a radius around each point.
    Disc(Color, f64),
}

#[derive(Clone, Debug, PartialEq)]
pub(super) enum Shape {
    Drawn(Paint, Vec<Vec<Pt>>),
    Text(Text),
}

pub(super) fn is_closed(line: &[Pt]) -> bool {
    line.len() > 2 && line.first() == line.last()
}

#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Drawing {
    pub width: f64,
    pub height: f64,
    /// Title for screen readers and file browsers.
    pub title: String,
    pub shapes: Vec<Shape>,
    /// Range of the panels' items among the shapes: the moving part of an animation.
    pub items: Range<usize>,
    /// Number of shapes that are complete.
    pub sealed: usize,
}

impl Drawing {
    /// Ends a group of shapes, and returns their number: later ones are not joined to them.
    pub fn seal(&mut self) -> usize {
        self.sealed = self.shapes.len();
        self.sealed
    }

    /// Adds a line, a polygon or discs. Those of one style are one shape; texts between them hide nothing.
    pub fn record(&mut self, paint: Paint, mut points: Vec<Pt>) -> DrawingResult {
        if let Paint::Area(..) = paint {
            points.extend(points.first().copied());
            // Areas of one colour are filled together, where opposite senses would make holes.
            if points.windows(2).map(|pair| pair[0].0 * pair[1].1 - pair[1].0 * pair[0].1).sum::<f64>() < 0.0 {
                points.reverse();
            }
        }
        let mut open = self.shapes[self.sealed..].iter_mut().rev();
        match open.find(|shape| matches!(shape, Shape::Drawn(..))) {
            // What is transparent is seen through.
            Some(Shape::Drawn(same, lines)) if *same == paint && !matches!(paint, Paint::Area(_, ..1.0, _)) => {
                lines.push(points)
            }
            _ => self.shapes.push(Shape::Drawn(paint, vec![points])),
        }
        Ok(())
    }
}
