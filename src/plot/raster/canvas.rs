//! Shapes drawn with soft edges by tiny-skia.

use super::super::shape::{Color, Drawing, Paint as Style, Pt, Shape, Stroke, Text};
use super::super::text::{DEJAVU, EM, glyphs, metrics};
use ab_glyph::{Font, FontRef, GlyphId, OutlineCurve};
use tiny_skia::{FillRule, LineJoin, Paint, Path, PathBuilder, Pixmap, PremultipliedColorU8, StrokeDash, Transform};

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
            Shape::Text(text) => self.text(text),
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

    fn text(&mut self, text: &Text) {
        let Some(font) = DEJAVU.as_ref() else { return };
        let turn = Transform::from_rotate(if text.turned { -90.0 } else { 0.0 });
        let start = self.scale.pre_translate(text.at.0 as f32, text.at.1 as f32).pre_concat(turn);
        let mut along = -text.align.part() * text.rich.width(text.size);
        for (rise, run) in &text.rich.0 {
            let (size, down) = metrics(*rise, text.size);
            let (glyphs, end) = glyphs(font, run);
            for (glyph, right) in glyphs {
                let place = start.pre_translate((along + right * size) as f32, down as f32);
                let place = place.pre_scale((size / EM) as f32, (-size / EM) as f32);
                if let Some(path) = letter(font, glyph) {
                    self.pixels.fill_path(&path, &paint(text.color, 1.0), FillRule::Winding, place, None);
                }
            }
            along += end * size;
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
        let width = stroke.width as f32;
        let line_join = LineJoin::Round;
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

/// Returns the outline of a glyph in units of the font; none for spaces.
fn letter(font: &FontRef, glyph: GlyphId) -> Option<Path> {
    let mut path = PathBuilder::new();
    let mut pen = None;
    for curve in font.outline(glyph)?.curves {
        let (OutlineCurve::Line(from, to) | OutlineCurve::Quad(from, _, to) | OutlineCurve::Cubic(from, _, _, to)) =
            curve;
        if pen != Some(from) {
            path.move_to(from.x, from.y);
        }
        match curve {
            OutlineCurve::Line(..) => path.line_to(to.x, to.y),
            OutlineCurve::Quad(_, a, _) => path.quad_to(a.x, a.y, to.x, to.y),
            OutlineCurve::Cubic(_, a, b, _) => path.cubic_to(a.x, a.y, b.x, b.y, to.x, to.y),
        }
        pen = Some(to);
    }
    path.finish()
}
