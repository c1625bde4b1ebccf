//! Shapes drawn with soft edges.

use super::coverage::Coverage;
use crate::plot::font::{self, DEJAVU, EM};
use crate::plot::shape::{Color, Drawing, Marker, Pt, Rect, Shape, Stroke, Text};
use ab_glyph::{Font, FontRef, GlyphId, point};

/// A picture.
#[derive(Clone)]
pub(super) struct RasterCanvas {
    /// Red, green and blue, row by row.
    pub pixels: Vec<u8>,
    /// Width and height in pixels.
    pub size: (usize, usize),
    /// Pixels per nominal pixel.
    scale: f64,
    coverage: Coverage,
}

impl RasterCanvas {
    /// White paper for a drawing.
    pub fn new(drawing: &Drawing, density: usize) -> Self {
        let size = (drawing.width.ceil() as usize * density, drawing.height.ceil() as usize * density);
        Self { pixels: vec![255; 3 * size.0 * size.1], size, scale: density as f64, coverage: Coverage::new(size) }
    }

    pub fn draw(&mut self, shapes: &[Shape]) {
        shapes.iter().for_each(|shape| self.shape(shape));
    }

    fn shape(&mut self, shape: &Shape) {
        match shape {
            Shape::Path { points, stroke } => {
                self.stroke(points, stroke);
                self.ink(stroke.color, 1.0);
            }
            Shape::Area { points, fill, opacity } => {
                self.polygon(points);
                self.ink(*fill, *opacity);
            }
            Shape::Rects { rects, fill } => rects.iter().for_each(|rect| self.rectangle(rect, *fill)),
            Shape::Marks { at, marker, radius, color } => {
                at.iter().for_each(|center| self.marker(*center, *marker, *radius));
                self.ink(*color, 1.0);
            }
            Shape::Text(text) => {
                self.text(text);
                self.ink(text.color, 1.0);
            }
        }
    }

    /// Mixes ink into the covered pixels.
    fn ink(&mut self, Color(red, green, blue): Color, opacity: f64) {
        let pixels = &mut self.pixels;
        self.coverage.take(|i, part| {
            for (value, ink) in pixels[3 * i..3 * i + 3].iter_mut().zip([red, green, blue]) {
                let paper = f32::from(*value);
                *value = (paper + opacity as f32 * part * (f32::from(ink) - paper)).round() as u8;
            }
        });
    }

    fn device(&self, (x, y): Pt) -> Pt {
        (x * self.scale, y * self.scale)
    }

    /// Fills whole pixels, so that cells leave no seam between them.
    fn rectangle(&mut self, rect: &Rect, Color(red, green, blue): Color) {
        let place = |value: f64, end: usize| (value * self.scale).round().clamp(0.0, end as f64) as usize;
        let (left, right) = (place(rect.left, self.size.0), place(rect.right, self.size.0));
        for y in place(rect.top, self.size.1)..place(rect.bottom, self.size.1) {
            let row = 3 * (y * self.size.0 + left)..3 * (y * self.size.0 + right.max(left));
            self.pixels[row].chunks_exact_mut(3).for_each(|pixel| pixel.copy_from_slice(&[red, green, blue]));
        }
    }

    fn polygon(&mut self, corners: &[Pt]) {
        let corners: Vec<Pt> = corners.iter().map(|corner| self.device(*corner)).collect();
        self.coverage.polygon(&corners);
    }

    fn disc(&mut self, center: Pt, radius: f64) {
        self.coverage.disc(self.device(center), radius * self.scale);
    }

    fn segment(&mut self, from: Pt, to: Pt, width: f64) {
        self.coverage.segment(self.device(from), self.device(to), width * self.scale);
    }

    fn marker(&mut self, center: Pt, marker: Marker, radius: f64) {
        if marker == Marker::Circle {
            return self.disc(center, radius);
        }
        let outlines = marker.outlines(center, radius);
        match marker.stroke_width(radius) {
            Some(width) => outlines.iter().for_each(|line| self.segment(line[0], line[1], width)),
            None => outlines.iter().for_each(|line| self.polygon(line)),
        }
    }

    /// Covers a line with round joints and square ends.
    fn stroke(&mut self, points: &[Pt], stroke: &Stroke) {
        for part in dashes(points, stroke.dash) {
            part.windows(2).for_each(|pair| self.segment(pair[0], pair[1], stroke.width));
            let is_closed = part.len() > 2 && part.first() == part.last();
            let joints = part.iter().take(part.len().saturating_sub(1)).skip(usize::from(!is_closed));
            joints.for_each(|joint| self.disc(*joint, 0.5 * stroke.width));
        }
    }

    fn text(&mut self, text: &Text) {
        let Some(font) = DEJAVU.as_ref() else { return };
        let mut along = text.start();
        for run in &text.rich.runs {
            let (size, down) = run.level.metrics(text.size);
            let (glyphs, end) = font::glyphs(font, &run.text);
            for (glyph, place) in glyphs {
                self.glyph(font, glyph, size, (along + place * size, down), text);
            }
            along += end * size;
        }
    }

    /// Covers a glyph; its origin is at an offset along the text and below its baseline.
    fn glyph(&mut self, font: &FontRef, glyph: GlyphId, size: f64, (along, down): Pt, text: &Text) {
        let height = f64::from(font.height_unscaled()) / EM * size * self.scale;
        // A turned text lies level in a picture that is turned back.
        let (right, below) = if text.turned { (-text.at.1, text.at.0) } else { text.at };
        let origin = self.device((right + along, below + down));
        let place = point(origin.0 as f32, origin.1 as f32);
        let Some(outline) = font.outline_glyph(glyph.with_scale_and_position(height as f32, place)) else { return };
        let corner = outline.px_bounds().min;
        outline.draw(|right, below, part| {
            let (x, y) = (corner.x as i64 + i64::from(right), corner.y as i64 + i64::from(below));
            let (x, y) = if text.turned { (y, -x - 1) } else { (x, y) };
            self.coverage.pixel(x, y, f64::from(part).min(1.0));
        });
    }
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
