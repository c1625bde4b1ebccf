//! Shapes drawn by plotters on the large picture.

use crate::plot::font::{self, DEJAVU, EM};
use crate::plot::shape::{Color, Marker, Pt, Rect, Shape, Stroke, Text};
use ab_glyph::{Font, FontRef, GlyphId};
use plotters::backend::{BitMapBackend, DrawingBackend};
use plotters::style::{Color as _, RGBAColor, RGBColor};

/// The drawing backend of plotters with nominal coordinates.
pub(super) struct RasterCanvas<'a> {
    backend: BitMapBackend<'a>,
    /// Subpixels per nominal pixel.
    scale: f64,
}

type Drawn = Result<(), String>;

fn reason(error: impl ToString) -> String {
    error.to_string()
}

impl<'a> RasterCanvas<'a> {
    pub fn new(pixels: &'a mut [u8], size: (usize, usize), scale: usize) -> Self {
        let backend = BitMapBackend::with_buffer(pixels, (size.0 as u32, size.1 as u32));
        Self { backend, scale: scale as f64 }
    }

    pub fn draw(&mut self, shape: &Shape) -> Drawn {
        match shape {
            Shape::Path { points, stroke } => self.stroke(points, stroke),
            Shape::Area { points, fill, opacity } => self.polygon(points, style(*fill).mix(*opacity)),
            Shape::Rects { rects, fill } => rects.iter().try_for_each(|rect| self.rectangle(rect, *fill)),
            Shape::Marks { at, marker, radius, color } => {
                at.iter().try_for_each(|center| self.marker(*center, *marker, *radius, *color))
            }
            Shape::Text(text) => self.text(text),
        }
    }

    fn device(&self, (x, y): Pt) -> (i32, i32) {
        ((x * self.scale).round() as i32, (y * self.scale).round() as i32)
    }

    fn rectangle(&mut self, rect: &Rect, fill: Color) -> Drawn {
        let (from, to) = (self.device((rect.left, rect.top)), self.device((rect.right, rect.bottom)));
        if from.0 >= to.0 || from.1 >= to.1 {
            return Ok(());
        }
        self.backend.draw_rect(from, to, &style(fill), true).map_err(reason)
    }

    fn polygon(&mut self, corners: &[Pt], fill: RGBAColor) -> Drawn {
        let corners: Vec<(i32, i32)> = corners.iter().map(|corner| self.device(*corner)).collect();
        self.backend.fill_polygon(corners, &fill).map_err(reason)
    }

    fn disc(&mut self, center: Pt, radius: f64, fill: Color) -> Drawn {
        let pixels = (radius * self.scale).round().max(1.0) as u32;
        self.backend.draw_circle(self.device(center), pixels, &style(fill), true).map_err(reason)
    }

    fn marker(&mut self, center: Pt, marker: Marker, radius: f64, color: Color) -> Drawn {
        if marker == Marker::Circle {
            return self.disc(center, radius, color);
        }
        let outlines = marker.outlines(center, radius);
        match marker.stroke_width(radius) {
            Some(width) => outlines.iter().try_for_each(|line| self.stroke(line, &Stroke { color, width, dash: &[] })),
            None => outlines.iter().try_for_each(|line| self.polygon(&line[..line.len() - 1], style(color).mix(1.0))),
        }
    }

    fn stroke(&mut self, points: &[Pt], stroke: &Stroke) -> Drawn {
        for part in dashes(points, stroke.dash) {
            part.windows(2).try_for_each(|pair| self.segment(pair[0], pair[1], stroke))?;
            let is_closed = part.len() > 2 && part.first() == part.last();
            let joints = part.iter().take(part.len().saturating_sub(1)).skip(usize::from(!is_closed));
            joints.into_iter().try_for_each(|joint| self.disc(*joint, 0.5 * stroke.width, stroke.color))?;
        }
        Ok(())
    }

    /// Draws a segment with its width and square ends.
    fn segment(&mut self, from: Pt, to: Pt, stroke: &Stroke) -> Drawn {
        let (dx, dy) = (to.0 - from.0, to.1 - from.1);
        let length = dx.hypot(dy);
        if length < 1e-9 {
            return Ok(());
        }
        let (nx, ny) = (-0.5 * stroke.width * dy / length, 0.5 * stroke.width * dx / length);
        if dx == 0.0 || dy == 0.0 {
            let (nx, ny) = (nx.abs(), ny.abs());
            let (left, right) = (from.0.min(to.0) - nx, from.0.max(to.0) + nx);
            let (top, bottom) = (from.1.min(to.1) - ny, from.1.max(to.1) + ny);
            return self.rectangle(&Rect { left, top, right, bottom }, stroke.color);
        }
        let side = |p: Pt, sign: f64| (p.0 + sign * nx, p.1 + sign * ny);
        let corners = [side(from, 1.0), side(to, 1.0), side(to, -1.0), side(from, -1.0)];
        self.polygon(&corners, style(stroke.color).mix(1.0))
    }

    fn text(&mut self, text: &Text) -> Drawn {
        let Some(font) = DEJAVU.as_ref() else { return Ok(()) };
        let mut along = text.start();
        for run in &text.rich.runs {
            let (size, down) = run.level.metrics(text.size);
            let (glyphs, end) = font::glyphs(font, &run.text);
            for (glyph, place) in glyphs {
                self.glyph(font, glyph, size, (along + place * size, down), text)?;
            }
            along += end * size;
        }
        Ok(())
    }

    /// Draws a glyph; its origin is at an offset along the text and below its baseline.
    fn glyph(&mut self, font: &FontRef, glyph: GlyphId, size: f64, (along, down): Pt, text: &Text) -> Drawn {
        let height = f64::from(font.height_unscaled()) / EM * size * self.scale;
        let Some(outline) = font.outline_glyph(glyph.with_scale(height as f32)) else { return Ok(()) };
        let shift = if text.turned { (down, -along) } else { (along, down) };
        let origin = self.device((text.at.0 + shift.0, text.at.1 + shift.1));
        let corner = outline.px_bounds().min;
        let mut drawn = Ok(());
        outline.draw(|right, below, coverage| {
            let (right, below) = (corner.x as i32 + right as i32, corner.y as i32 + below as i32);
            let (x, y) = if text.turned { (below, -right) } else { (right, below) };
            let ink = style(text.color).mix(f64::from(coverage).min(1.0)).to_backend_color();
            if let Err(error) = self.backend.draw_pixel((origin.0 + x, origin.1 + y), ink) {
                drawn = Err(reason(error));
            }
        });
        drawn
    }
}

fn style(color: Color) -> RGBColor {
    RGBColor(color.0, color.1, color.2)
}

/// Returns the drawn parts of a dashed line.
fn dashes(points: &[Pt], pattern: &[f64]) -> Vec<Vec<Pt>> {
    if pattern.is_empty() || pattern.iter().any(|length| *length <= 0.0) {
        return vec![points.to_vec()];
    }
    let (mut parts, mut current) = (Vec::new(), points.first().map_or_else(Vec::new, |first| vec![*first]));
    let (mut step, mut left) = (0, pattern[0]);
    for pair in points.windows(2) {
        let length = (pair[1].0 - pair[0].0).hypot(pair[1].1 - pair[0].1);
        let mut done = 0.0;
        while length - done > left {
            done += left;
            let t = done / length;
            let at = (pair[0].0 + t * (pair[1].0 - pair[0].0), pair[0].1 + t * (pair[1].1 - pair[0].1));
            current.push(at);
            parts.extend((step % 2 == 0).then(|| std::mem::take(&mut current)));
            step += 1;
            (current, left) = (vec![at], pattern[step % pattern.len()]);
        }
        left -= length - done;
        current.push(pair[1]);
    }
    parts.extend((step % 2 == 0).then_some(current));
    parts
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn dashes_go_around_corners() {
        let parts = dashes(&[(0.0, 0.0), (4.0, 0.0), (4.0, 10.0)], &[6.0, 2.0]);
        assert_eq!(parts, [vec![(0.0, 0.0), (4.0, 0.0), (4.0, 2.0)], vec![(4.0, 4.0), (4.0, 10.0)]]);
    }
}
