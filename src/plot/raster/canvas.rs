//! Shapes drawn with soft edges by tiny-skia.

use super::super::shape::{Color, Drawing, Paint as Style, Pt, Shape, Stroke, Text};
use super::super::text::{DEJAVU, EM, glyphs, metrics};
use ab_glyph::{Font, FontRef, GlyphId, OutlineCurve, Point};
use tiny_skia::{FillRule, LineJoin, Paint, PathBuilder, Pixmap, PremultipliedColorU8, StrokeDash, Transform};

/// A picture.
#[derive(Clone)]
pub(super) struct RasterCanvas {
    pixels: Pixmap,
    /// Scale from nominal pixels to those of the picture.
    scale: Transform,
}

impl RasterCanvas {
    /// Returns white paper for a drawing, or none where it has no pixels.
    pub fn new(drawing: &Drawing, density: usize) -> Option<Self> {
        let side = |nominal: f64| nominal.ceil() as u32 * density as u32;
        let mut pixels = Pixmap::new(side(drawing.width), side(drawing.height))?;
        pixels.fill(tiny_skia::Color::WHITE);
        Some(Self { pixels, scale: Transform::from_scale(density as f32, density as f32) })
    }

    /// Returns width and height in pixels.
    pub fn size(&self) -> (u32, u32) {
        (self.pixels.width(), self.pixels.height())
    }

    /// Returns red, green and blue, row by row; the paper is opaque.
    pub fn rgb(&self) -> Vec<u8> {
        let rgb = |pixel: &PremultipliedColorU8| [pixel.red(), pixel.green(), pixel.blue()];
        self.pixels.pixels().iter().flat_map(rgb).collect()
    }

    pub fn draw(&mut self, shapes: &[Shape]) {
        shapes.iter().for_each(|shape| self.shape(shape));
    }

    fn shape(&mut self, shape: &Shape) {
        match shape {
            Shape::Text(text) => self.fill(letters(text), text.color, 1.0, true),
            Shape::Drawn(Style::Line(stroke), lines) => self.stroke(outline(lines), stroke),
            // Whole pixels, so that crisp areas leave no seam between them.
            Shape::Drawn(Style::Area(color, opacity, crisp), lines) => {
                self.fill(outline(lines), *color, *opacity, !crisp)
            }
            Shape::Drawn(Style::Disc(color, radius), points) => {
                let mut path = PathBuilder::new();
                points.iter().flatten().for_each(|(x, y)| path.push_circle(*x as f32, *y as f32, *radius as f32));
                self.fill(path, *color, 1.0, true);
            }
        }
    }

    fn fill(&mut self, path: PathBuilder, color: Color, opacity: f64, anti_alias: bool) {
        if let Some(path) = path.finish() {
            let paint = Paint { anti_alias, ..paint(color, opacity) };
            self.pixels.fill_path(&path, &paint, FillRule::Winding, self.scale, None);
        }
    }

    fn stroke(&mut self, path: PathBuilder, stroke: &Stroke) {
        let dash = StrokeDash::new(stroke.dash.iter().map(|length| *length as f32).collect(), 0.0);
        let (width, line_join) = (stroke.width as f32, LineJoin::Round);
        let style = tiny_skia::Stroke { width, line_join, dash, ..tiny_skia::Stroke::default() };
        if let Some(path) = path.finish() {
            self.pixels.stroke_path(&path, &paint(stroke.color, 1.0), &style, self.scale, None);
        }
    }
}

fn paint(Color(red, green, blue): Color, opacity: f64) -> Paint<'static> {
    let mut paint = Paint::default();
    paint.set_color_rgba8(red, green, blue, (255.0 * opacity).round() as u8);
    paint
}

/// Returns lines through points, closed where they end at their start.
fn outline(lines: &[Vec<Pt>]) -> PathBuilder {
    let mut path = PathBuilder::new();
    for points in lines {
        points.iter().take(1).for_each(|(x, y)| path.move_to(*x as f32, *y as f32));
        points.iter().skip(1).for_each(|(x, y)| path.line_to(*x as f32, *y as f32));
        if points.len() > 2 && points.first() == points.last() {
            path.close();
        }
    }
    path
}

/// Returns the outlines of a text's letters.
fn letters(text: &Text) -> PathBuilder {
    let mut path = PathBuilder::new();
    let Some(font) = DEJAVU.as_ref() else { return path };
    let mut along = -text.align.part() * text.rich.width(text.size);
    for (rise, run) in &text.rich.0 {
        let (size, down) = metrics(*rise, text.size);
        let (glyphs, end) = glyphs(font, run);
        for (glyph, start) in glyphs {
            let place = |point: Point| {
                let right = along + (start + f64::from(point.x) / EM) * size;
                let below = down - f64::from(point.y) / EM * size;
                let (x, y) = if text.turned { (below, -right) } else { (right, below) };
                ((text.at.0 + x) as f32, (text.at.1 + y) as f32)
            };
            letter(&mut path, font, glyph, place);
        }
        along += end * size;
    }
    path
}

/// Adds a glyph; `place` returns where a point of the font is in the picture.
fn letter(path: &mut PathBuilder, font: &FontRef, glyph: GlyphId, place: impl Fn(Point) -> (f32, f32)) {
    let mut pen = None;
    for curve in font.outline(glyph).map_or_else(Vec::new, |outline| outline.curves) {
        let (OutlineCurve::Line(from, to) | OutlineCurve::Quad(from, _, to) | OutlineCurve::Cubic(from, _, _, to)) =
            curve;
        let (start, (x, y)) = (place(from), place(to));
        if pen != Some(from) {
            path.move_to(start.0, start.1);
        }
        match curve {
            OutlineCurve::Line(..) => path.line_to(x, y),
            OutlineCurve::Quad(_, a, _) => path.quad_to(place(a).0, place(a).1, x, y),
            OutlineCurve::Cubic(_, a, b, _) => path.cubic_to(place(a).0, place(a).1, place(b).0, place(b).1, x, y),
        }
        pen = Some(to);
    }
}
