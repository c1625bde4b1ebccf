//! Shapes drawn with soft edges by tiny-skia, for PNG and GIF files.

use super::palette::shades;
use super::shape::{Color, Drawing, Font as Lettering, Paint as Style, Pt, Shape, Text, is_closed};
use super::text::{DEJAVU, EM, glyphs, metrics};
use crate::files;
use ab_glyph::{Font, FontRef, GlyphId, OutlineCurve};
use tiny_skia::{FillRule, LineJoin, Paint, Path, PathBuilder, Pixmap, Stroke, StrokeDash, Transform};

/// Output pixels per nominal pixel: 1280 pixels in 85 mm.
const DENSITY: u32 = 2;

/// Returns the bytes of a PNG file, or the reason why there is none. Pictures of unusual size are drawn coarser.
pub(super) fn png(drawing: &Drawing) -> Result<Vec<u8>, String> {
    let Drawing { width, height, .. } = drawing;
    let fits = |density: &u32| width * height * f64::from(density.pow(2)) <= 5.0e7;
    let too_many = || format!("{width:.0} x {height:.0} pixels are too many; save it as SVG");
    let density = [DENSITY, 1].into_iter().find(fits).ok_or_else(too_many)?;
    let mut pixels = paper(drawing, density)?;
    draw(&mut pixels, density, &drawing.shapes);
    let per_metre = (640.0 * f64::from(density) / 0.085).round() as u32;
    files::png::encode(pixels.width(), pixels.height(), &rgb(&pixels), per_metre).map_err(|error| error.to_string())
}

/// Returns the bytes of a GIF file of `count` frames, of which `moving` gives the items.
pub(super) fn gif(
    still: &Drawing,
    count: usize,
    per_second: f64,
    moving: impl Fn(usize) -> Vec<Shape> + Sync,
    done: impl FnMut(usize),
) -> Result<Vec<u8>, String> {
    let mut paper = paper(still, 1)?;
    draw(&mut paper, 1, &still.shapes);
    let frame = |k: usize| {
        let mut pixels = paper.clone();
        draw(&mut pixels, 1, &moving(k));
        rgb(&pixels)
    };
    files::gif::encode((paper.width(), paper.height()), &shades(), count, per_second, frame, done)
}

fn paper(drawing: &Drawing, density: u32) -> Result<Pixmap, String> {
    let side = |nominal: f64| nominal.ceil() as u32 * density;
    let mut pixels = Pixmap::new(side(drawing.width), side(drawing.height)).ok_or("a figure without pixels")?;
    pixels.fill(tiny_skia::Color::WHITE);
    Ok(pixels)
}

/// Returns red, green and blue, row by row; the paper is opaque.
fn rgb(pixels: &Pixmap) -> Vec<u8> {
    pixels.pixels().iter().flat_map(|pixel| [pixel.red(), pixel.green(), pixel.blue()]).collect()
}

fn draw(pixels: &mut Pixmap, density: u32, shapes: &[Shape]) {
    let scale = Transform::from_scale(density as f32, density as f32);
    for shape in shapes {
        let (style, lines) = match shape {
            Shape::Text(line) => {
                text(pixels, scale, line);
                continue;
            }
            Shape::Drawn(style, lines) => (style, lines),
        };
        let Some(path) = outline(style, lines) else { continue };
        let mut fill = |paint| pixels.fill_path(&path, &paint, FillRule::Winding, scale, None);
        match style {
            Style::Disc(color, _) => fill(paint(*color, 1.0)),
            // Whole pixels, so that crisp areas leave no seam between them.
            Style::Area(color, opacity, crisp) => fill(Paint { anti_alias: !crisp, ..paint(*color, *opacity) }),
            Style::Line(stroke) => {
                let dash = StrokeDash::new(stroke.dash.iter().map(|length| *length as f32).collect(), 0.0);
                let width = stroke.width as f32;
                let style = Stroke { width, line_join: LineJoin::Round, dash, ..Stroke::default() };
                pixels.stroke_path(&path, &paint(stroke.color, 1.0), &style, scale, None);
            }
        }
    }
}

fn paint(Color(red, green, blue): Color, opacity: f64) -> Paint<'static> {
    let mut paint = Paint::default();
    paint.set_color_rgba8(red, green, blue, (255.0 * opacity).round() as u8);
    paint
}

/// Returns lines through points, or a circle around each.
fn outline(style: &Style, lines: &[Vec<Pt>]) -> Option<Path> {
    let mut path = PathBuilder::new();
    for points in lines {
        for (k, (x, y)) in points.iter().map(|(x, y)| (*x as f32, *y as f32)).enumerate() {
            match style {
                Style::Disc(_, radius) => path.push_circle(x, y, *radius as f32),
                _ if k == 0 => path.move_to(x, y),
                _ => path.line_to(x, y),
            }
        }
        if is_closed(points) {
            path.close();
        }
    }
    path.finish()
}

fn text(pixels: &mut Pixmap, scale: Transform, text: &Text) {
    let Some(font) = DEJAVU.as_ref() else { return };
    let Lettering(size, color, align) = text.font;
    let turn = Transform::from_rotate(if text.turned { -90.0 } else { 0.0 });
    let start = scale.pre_translate(text.at.0 as f32, text.at.1 as f32).pre_concat(turn);
    let mut along = -align.part() * text.rich.width(size);
    for (rise, run) in &text.rich.0 {
        let (size, down) = metrics(*rise, size);
        let (glyphs, end) = glyphs(font, run);
        for (glyph, right) in glyphs {
            let place = start.pre_translate((along + right * size) as f32, down as f32);
            let place = place.pre_scale((size / EM) as f32, (-size / EM) as f32);
            if let Some(path) = letter(font, glyph) {
                pixels.fill_path(&path, &paint(color, 1.0), FillRule::Winding, place, None);
            }
        }
        along += end * size;
    }
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
