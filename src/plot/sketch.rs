//! The backend on which plotters draws: it records shapes. Its pixels are hundredths of a nominal one.

use super::text::{self, Rich};
use super::{Align, Axis, Color, Drawing, HALF_DIGIT, LINE_HEIGHT, Paint, Pt, Shape, Stroke, Text};
use plotters::chart::ChartContext;
use plotters::coord::{Shift, cartesian::Cartesian2d};
use plotters::drawing::{DrawingArea, DrawingAreaErrorKind};
use plotters::element::{Drawable, PointCollection};
use plotters::style::text_anchor::{HPos, Pos, VPos};
use plotters::style::{Color as _, FontDesc, FontFamily, FontStyle, TextStyle};
use plotters_backend::{BackendColor, BackendCoord, BackendStyle, BackendTextStyle, FontTransform};
use plotters_backend::{DrawingBackend, DrawingErrorKind};
use std::{cell::RefCell, convert::Infallible, rc::Rc};

/// Units of the backend in a nominal pixel.
const UNITS: f64 = 100.0;
/// Height of the paper in units: the picture ends where the drawing does.
const PAPER_HEIGHT: u32 = 100_000_000;

/// A part of the paper.
pub(super) type Page = DrawingArea<Sketch, Shift>;
/// The chart of a panel.
pub(super) type Chart<'a> = ChartContext<'a, Sketch, Cartesian2d<Axis, Axis>>;
/// The end of a drawing operation; a sketch refuses nothing.
pub(super) type Done<T = ()> = Result<T, DrawingAreaErrorKind<Infallible>>;
type Drawn<T = ()> = Result<T, DrawingErrorKind<Infallible>>;

/// Returns a position in units of the backend.
pub(super) fn units((x, y): Pt) -> BackendCoord {
    ((UNITS * x).round() as i32, (UNITS * y).round() as i32)
}

/// Returns a position of the backend in nominal pixels.
pub(super) fn pixels((x, y): BackendCoord) -> Pt {
    (f64::from(x) / UNITS, f64::from(y) / UNITS)
}

/// Returns a style of text that is vertically centred at its position.
pub(super) fn font(size: f64, color: Color, align: Align) -> TextStyle<'static> {
    let across = [HPos::Left, HPos::Center, HPos::Right][align as usize];
    let font = FontDesc::new(FontFamily::Name("DejaVu Sans"), UNITS * size, FontStyle::Normal);
    TextStyle { font, color: color.to_backend_color(), pos: Pos::new(across, VPos::Center) }
}

/// A drawing in progress.
#[derive(Clone)]
pub(super) struct Sketch(pub Rc<RefCell<Drawing>>);

impl Sketch {
    /// Completes all shapes and returns their number.
    pub fn seal(&self) -> usize {
        let mut drawing = self.0.borrow_mut();
        drawing.sealed = drawing.shapes.len();
        drawing.sealed
    }

    fn add(&self, paint: Paint, line: Vec<Pt>) -> Drawn {
        self.0.borrow_mut().add(paint, line);
        Ok(())
    }

    fn line(&self, line: Vec<Pt>, style: &impl BackendStyle) -> Drawn {
        let width = f64::from(style.stroke_width()) / UNITS;
        self.add(Paint::Line(Stroke { color: solid(style.color()), width, dash: &[] }), line)
    }

    fn area(&self, mut outline: Vec<Pt>, color: BackendColor, crisp: bool) -> Drawn {
        // Areas of one colour are filled together, where opposite senses would make holes.
        if outline.windows(2).map(|pair| pair[0].0 * pair[1].1 - pair[1].0 * pair[0].1).sum::<f64>() < 0.0 {
            outline.reverse();
        }
        self.add(Paint::Area(solid(color), color.alpha, crisp), outline)
    }
}

fn solid(color: BackendColor) -> Color {
    Color(color.rgb.0, color.rgb.1, color.rgb.2)
}

/// Returns the middle of the nearest pixel, where a thin line is sharp.
fn sharp(value: f64) -> f64 {
    value.floor() + 0.5
}

impl DrawingBackend for Sketch {
    type ErrorType = Infallible;

    fn get_size(&self) -> (u32, u32) {
        (units((self.0.borrow().width, 0.0)).0 as u32, PAPER_HEIGHT)
    }

    fn ensure_prepared(&mut self) -> Drawn {
        Ok(())
    }

    fn present(&mut self) -> Drawn {
        Ok(())
    }

    fn draw_pixel(&mut self, at: BackendCoord, color: BackendColor) -> Drawn {
        self.draw_rect(at, (at.0 + 1, at.1 + 1), &color, true)
    }

    /// Draws a line of a grid or a mark, which is sharp where it is parallel to an axis.
    fn draw_path<S: BackendStyle, I: IntoIterator<Item = BackendCoord>>(&mut self, path: I, style: &S) -> Drawn {
        let mut line: Vec<Pt> = path.into_iter().map(pixels).collect();
        if line.iter().all(|point| point.0 == line[0].0) {
            line.iter_mut().for_each(|point| point.0 = sharp(point.0));
        } else if line.iter().all(|point| point.1 == line[0].1) {
            line.iter_mut().for_each(|point| point.1 = sharp(point.1));
        }
        self.line(line, style)
    }

    fn draw_line<S: BackendStyle>(&mut self, from: BackendCoord, to: BackendCoord, style: &S) -> Drawn {
        self.draw_path([from, to], style)
    }

    fn draw_rect<S: BackendStyle>(&mut self, from: BackendCoord, to: BackendCoord, style: &S, fill: bool) -> Drawn {
        let [(a, b), (c, d)] = [from, to].map(pixels).map(|(x, y)| if fill { (x, y) } else { (sharp(x), sharp(y)) });
        let outline = vec![(a, b), (c, b), (c, d), (a, d), (a, b)];
        if fill { self.area(outline, style.color(), true) } else { self.line(outline, style) }
    }

    fn draw_circle<S: BackendStyle>(&mut self, at: BackendCoord, radius: u32, style: &S, _: bool) -> Drawn {
        self.add(Paint::Disc(solid(style.color()), f64::from(radius) / UNITS), vec![pixels(at)])
    }

    fn fill_polygon<S: BackendStyle, I: IntoIterator<Item = BackendCoord>>(&mut self, path: I, style: &S) -> Drawn {
        let mut outline: Vec<Pt> = path.into_iter().map(pixels).collect();
        outline.extend(outline.first().copied());
        self.area(outline, style.color(), false)
    }

    fn draw_text<S: BackendTextStyle>(&mut self, text: &str, style: &S, at: BackendCoord) -> Drawn {
        let (size, color, (x, y)) = (style.size() / UNITS, solid(style.color()), pixels(at));
        // All turned texts read upwards, also those of right axes, which plotters turns the other way.
        let (turned, anchor) = match (style.transform(), style.anchor().v_pos) {
            (FontTransform::None, anchor) => (false, anchor),
            (FontTransform::Rotate90, VPos::Top) => (true, VPos::Bottom),
            (_, anchor) => (true, anchor),
        };
        let align = [Align::Start, Align::End, Align::Middle][style.anchor().h_pos as usize];
        let last = LINE_HEIGHT * text.lines().count().saturating_sub(1) as f64;
        let first = match anchor {
            VPos::Top => 0.78,
            VPos::Center => HALF_DIGIT - 0.5 * last,
            VPos::Bottom => -0.22 - last,
        };
        for (row, line) in text.lines().enumerate().filter(|line| !line.1.is_empty()) {
            let down = (first + LINE_HEIGHT * row as f64) * size;
            let at = if turned { (x + down, y) } else { (x, y + down) };
            let text = Text { at, rich: Rich::new(line), size, color, align, turned };
            self.0.borrow_mut().shapes.push(Shape::Text(text));
        }
        Ok(())
    }

    fn estimate_text_size<S: BackendTextStyle>(&self, text: &str, style: &S) -> Drawn<(u32, u32)> {
        Ok((text::width(text, style.size()) as u32, style.size() as u32))
    }
}

/// A line that may be dashed, of which styles of plotters know nothing.
pub(super) struct Curve(Vec<BackendCoord>, Stroke);

impl Curve {
    pub fn new(points: Vec<Pt>, stroke: Stroke) -> Self {
        Self(points.into_iter().map(units).collect(), stroke)
    }
}

impl<'a> PointCollection<'a, BackendCoord> for &'a Curve {
    type Point = &'a BackendCoord;
    type IntoIter = &'a [BackendCoord];

    fn point_iter(self) -> Self::IntoIter {
        &self.0
    }
}

impl Drawable<Sketch> for Curve {
    fn draw<I: Iterator<Item = BackendCoord>>(&self, points: I, backend: &mut Sketch, _: (u32, u32)) -> Drawn {
        backend.add(Paint::Line(self.1), points.map(pixels).collect())
    }
}
