//! The backend on which plotters draws: a drawing records shapes. Its pixels are hundredths of a nominal one.

use super::*;
use plotters::chart::ChartContext;
use plotters::coord::{CoordTranslate, cartesian::Cartesian2d};
use plotters::drawing::{DrawingArea, DrawingAreaErrorKind};
use plotters::element::{Drawable, PointCollection, Text as Words};
use plotters::style::text_anchor::{HPos, Pos, VPos};
use plotters::style::{FontDesc, FontFamily, FontStyle, ShapeStyle, TextStyle};
use plotters_backend::{BackendColor, BackendCoord, BackendStyle, BackendTextStyle, FontTransform};
use plotters_backend::{DrawingBackend, DrawingErrorKind};
use std::convert::Infallible;

/// Units of the backend in a nominal pixel.
const UNITS: f64 = 100.0;

/// The end of an operation; a drawing refuses nothing.
pub(super) type Done<T = ()> = Result<T, DrawingAreaErrorKind<Infallible>>;
pub(super) type DrawingResult<T = ()> = Result<T, DrawingErrorKind<Infallible>>;
/// The paper, on which positions are nominal pixels.
pub(super) type Page = DrawingArea<Drawing, Nominal>;
pub(super) type PlotChart<'a> = ChartContext<'a, Drawing, Cartesian2d<PlotAxis, PlotAxis>>;

pub(super) struct Nominal;

impl CoordTranslate for Nominal {
    type From = Pt;

    fn translate(&self, (x, y): &Pt) -> BackendCoord {
        (units(*x), units(*y))
    }
}

pub(super) fn units(pixels: f64) -> i32 {
    (UNITS * pixels).round() as i32
}

fn pixels((x, y): BackendCoord) -> Pt {
    (f64::from(x) / UNITS, f64::from(y) / UNITS)
}

fn solid(color: BackendColor) -> Color {
    Color(color.rgb.0, color.rgb.1, color.rgb.2)
}

/// Returns a stroke as a style of plotters, which has no dashes.
pub(super) fn line(stroke: Stroke) -> ShapeStyle {
    plotters::style::Color::stroke_width(&stroke.color, units(stroke.width) as u32)
}

/// Returns a style of text that is vertically centred at its position.
pub(super) fn font(Font(size, color, align): Font) -> TextStyle<'static> {
    let across = [HPos::Left, HPos::Center, HPos::Right][align as usize];
    let font = FontDesc::new(FontFamily::Name("DejaVu Sans"), UNITS * size, FontStyle::Normal);
    TextStyle { font, color: color.to_backend_color(), pos: Pos::new(across, VPos::Center) }
}

pub(super) fn words(text: &str, at: Pt, style: Font) -> Words<'static, Pt, &str> {
    Words::new(text, at, font(style))
}

impl DrawingBackend for Drawing {
    type ErrorType = Infallible;

    fn get_size(&self) -> (u32, u32) {
        (100_000_000, 100_000_000)
    }

    fn ensure_prepared(&mut self) -> DrawingResult {
        Ok(())
    }

    fn present(&mut self) -> DrawingResult {
        Ok(())
    }

    /// Charts have no single pixels.
    fn draw_pixel(&mut self, _: BackendCoord, _: BackendColor) -> DrawingResult {
        Ok(())
    }

    fn draw_line<S: BackendStyle>(&mut self, from: BackendCoord, to: BackendCoord, style: &S) -> DrawingResult {
        self.draw_path([from, to], style)
    }

    /// Draws a line of a grid, a mark or a frame, in the middle of pixels where it is parallel to an axis.
    fn draw_path<S: BackendStyle, I: IntoIterator<Item = BackendCoord>>(
        &mut self,
        path: I,
        style: &S,
    ) -> DrawingResult {
        let path: Vec<BackendCoord> = path.into_iter().collect();
        let mut line: Vec<Pt> = path.iter().copied().map(pixels).collect();
        for k in 1..path.len() {
            for end in &mut line[k - 1..=k] {
                end.0 = if path[k].0 == path[k - 1].0 { end.0.floor() + 0.5 } else { end.0 };
                end.1 = if path[k].1 == path[k - 1].1 { end.1.floor() + 0.5 } else { end.1 };
            }
        }
        let width = f64::from(style.stroke_width()) / UNITS;
        self.record(Paint::Line(Stroke { color: solid(style.color()), width, dash: &[] }), line)
    }

    fn draw_rect<S: BackendStyle>(
        &mut self,
        from: BackendCoord,
        to: BackendCoord,
        style: &S,
        fill: bool,
    ) -> DrawingResult {
        let corners = [from, (to.0, from.1), to, (from.0, to.1), from];
        if !fill {
            return self.draw_path(corners, style);
        }
        self.record(Paint::Area(solid(style.color()), 1.0, true), corners[..4].iter().copied().map(pixels).collect())
    }

    fn draw_circle<S: BackendStyle>(&mut self, at: BackendCoord, radius: u32, style: &S, _: bool) -> DrawingResult {
        self.record(Paint::Disc(solid(style.color()), f64::from(radius) / UNITS), vec![pixels(at)])
    }

    fn fill_polygon<S: BackendStyle, I: IntoIterator<Item = BackendCoord>>(
        &mut self,
        path: I,
        style: &S,
    ) -> DrawingResult {
        let paint = Paint::Area(solid(style.color()), style.color().alpha, false);
        self.record(paint, path.into_iter().map(pixels).collect())
    }

    fn draw_text<S: BackendTextStyle>(&mut self, text: &str, style: &S, at: BackendCoord) -> DrawingResult {
        let align = [Align::Start, Align::End, Align::Middle][style.anchor().h_pos as usize];
        let font = Font(style.size() / UNITS, solid(style.color()), align);
        // All turned texts read upwards, also those of right axes, which plotters turns the other way.
        let (turned, anchor) = match (style.transform(), style.anchor().v_pos) {
            (FontTransform::None, anchor) => (false, anchor),
            (FontTransform::Rotate90, VPos::Top) => (true, VPos::Bottom),
            (_, anchor) => (true, anchor),
        };
        let last = LINE_HEIGHT * text.lines().count().saturating_sub(1) as f64;
        let first = match anchor {
            VPos::Top => 0.78,
            VPos::Center => HALF_DIGIT - 0.5 * last,
            VPos::Bottom => -0.22 - last,
        };
        let (x, y) = pixels(at);
        for (row, line) in text.lines().enumerate().filter(|line| !line.1.is_empty()) {
            let down = (first + LINE_HEIGHT * row as f64) * font.0;
            let at = if turned { (x + down, y) } else { (x, y + down) };
            self.shapes.push(Shape::Text(Text { at, rich: Rich::new(line), font, turned }));
        }
        Ok(())
    }

    fn estimate_text_size<S: BackendTextStyle>(&self, text: &str, style: &S) -> DrawingResult<(u32, u32)> {
        Ok((text::width(text, style.size()) as u32, style.size() as u32))
    }
}

/// A line that may be dashed, of which styles of plotters know nothing.
pub(super) struct StrokedLine(pub Vec<Pt>, pub Stroke);

impl<'a> PointCollection<'a, Pt> for &'a StrokedLine {
    type Point = &'a Pt;
    type IntoIter = &'a [Pt];

    fn point_iter(self) -> Self::IntoIter {
        &self.0
    }
}

impl Drawable<Drawing> for StrokedLine {
    fn draw<I: Iterator<Item = BackendCoord>>(&self, points: I, drawing: &mut Drawing, _: (u32, u32)) -> DrawingResult {
        drawing.record(Paint::Line(self.1), points.map(pixels).collect())
    }
}
