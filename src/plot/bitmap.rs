//! A picture as PNG bytes: drawn several times as large, then averaged down, since plotters' lines have
//! jagged edges.

use plotters::backend::{BitMapBackend, DrawingBackend};
use plotters::style::{Color as _, RGBColor};

use super::font;
use super::shape::{Anchor, Color, Drawing, Marker, Pt, Rect, Shape, Stroke, Text};

/// Output pixels per nominal pixel, so that 85 mm hold 1280 pixels.
const DENSITY: usize = 2;
/// Subpixels per output pixel and direction.
const FINENESS: usize = 4;
/// The large picture has at most this many pixels; beyond, it is drawn coarser.
const MOST_PIXELS: f64 = 5.0e7;
/// Printed width of 640 nominal pixels.
const COLUMN_METRES: f64 = 0.085;

/// The whole file, or why there is none.
pub(super) fn render(drawing: &Drawing) -> Result<Vec<u8>, String> {
    let (density, fineness) = resolution(drawing)?;
    let sheet = Sheet { density, fineness, size: pixels(drawing, density) };
    let pixels = sheet.draw(sheet.blank(), &drawing.shapes)?;
    encode(&average(&pixels, sheet.size, fineness), sheet.size, density).map_err(|error| error.to_string())
}

/// Output pixels of a drawing.
fn pixels(drawing: &Drawing, density: usize) -> (usize, usize) {
    ((drawing.width.ceil() as usize) * density, (drawing.height.ceil() as usize) * density)
}

/// What many pictures of the same size are drawn on: one output pixel per nominal one.
pub(super) struct Sheet {
    density: usize,
    fineness: usize,
    /// Width and height in output pixels.
    pub size: (usize, usize),
}

impl Sheet {
    /// For the frames of an animation.
    pub fn of_frames(drawing: &Drawing) -> Self {
        Self { density: 1, fineness: 3, size: pixels(drawing, 1) }
    }

    /// The large picture, empty.
    pub fn blank(&self) -> Vec<u8> {
        vec![255; 3 * self.size.0 * self.size.1 * self.fineness * self.fineness]
    }

    /// Draws upon a large picture.
    pub fn draw(&self, mut pixels: Vec<u8>, shapes: &[Shape]) -> Result<Vec<u8>, String> {
        let size = (self.size.0 * self.fineness, self.size.1 * self.fineness);
        let scale = (self.density * self.fineness) as f64;
        Canvas { pixels: &mut pixels, size, scale }.draw(shapes)?;
        Ok(pixels)
    }

    /// The output pixels of a large picture: red, green, blue.
    pub fn output(&self, pixels: &[u8]) -> Vec<u8> {
        average(pixels, self.size, self.fineness)
    }
}

/// Density and fineness, reduced for pictures of unusual size.
fn resolution(drawing: &Drawing) -> Result<(usize, usize), String> {
    let area = drawing.width.ceil() * drawing.height.ceil();
    let choices = [(DENSITY, FINENESS), (DENSITY, 3), (DENSITY, 2), (1, 2), (1, 1)];
    let fits = |(density, fineness): &&(usize, usize)| area * (density * fineness).pow(2) as f64 <= MOST_PIXELS;
    choices
        .iter()
        .find(fits)
        .copied()
        .ok_or_else(|| format!("{:.0} x {:.0} pixels are too many; save it as SVG", drawing.width, drawing.height))
}

/// Means of `fineness` by `fineness` blocks.
fn average(pixels: &[u8], (width, height): (usize, usize), fineness: usize) -> Vec<u8> {
    let stride = 3 * width * fineness;
    let count = (fineness * fineness) as u32;
    let mut means = Vec::with_capacity(3 * width * height);
    for row in pixels.chunks_exact(stride * fineness) {
        for column in 0..width {
            for channel in 0..3 {
                let start = 3 * column * fineness + channel;
                let block = (0..fineness).flat_map(|y| (0..fineness).map(move |x| y * stride + 3 * x));
                let sum: u32 = block.map(|at| u32::from(row[start + at])).sum();
                means.push(((sum + count / 2) / count) as u8);
            }
        }
    }
    means
}

fn encode(pixels: &[u8], (width, height): (usize, usize), density: usize) -> Result<Vec<u8>, png::EncodingError> {
    let mut file = Vec::new();
    let mut encoder = png::Encoder::new(&mut file, width as u32, height as u32);
    encoder.set_color(png::ColorType::Rgb);
    encoder.set_depth(png::BitDepth::Eight);
    let per_metre = (640.0 * density as f64 / COLUMN_METRES).round() as u32;
    let dims = png::PixelDimensions { xppu: per_metre, yppu: per_metre, unit: png::Unit::Meter };
    encoder.set_pixel_dims(Some(dims));
    let mut writer = encoder.write_header()?;
    writer.write_image_data(pixels)?;
    writer.finish()?;
    Ok(file)
}

/// The large picture.
struct Canvas<'a> {
    pixels: &'a mut [u8],
    size: (usize, usize),
    scale: f64,
}

impl Canvas<'_> {
    fn draw(&mut self, shapes: &[Shape]) -> Result<(), String> {
        for shape in shapes {
            match shape {
                Shape::Text(text) => self.text(text),
                other => self.shape(other)?,
            }
        }
        Ok(())
    }

    fn shape(&mut self, shape: &Shape) -> Result<(), String> {
        let size = (self.size.0 as u32, self.size.1 as u32);
        let mut pen = Pen { backend: BitMapBackend::with_buffer(self.pixels, size), scale: self.scale };
        match shape {
            Shape::Path { points, stroke } => pen.stroke(points, stroke),
            Shape::Rects { rects, fill } => rects.iter().try_for_each(|rect| pen.rectangle(rect, *fill)),
            Shape::Marks { at, marker, radius, color } => {
                at.iter().try_for_each(|center| pen.marker(*center, *marker, *radius, *color))
            }
            Shape::Area { points, fill, opacity } => pen.area(points, *fill, *opacity),
            Shape::Text(_) => Ok(()),
        }
    }

    fn text(&mut self, text: &Text) {
        let width = text.rich.width(text.size);
        let mut along = match text.anchor {
            Anchor::Start => 0.0,
            Anchor::Middle => -0.5 * width,
            Anchor::End => -width,
        };
        for run in &text.rich.runs {
            let (size, down) = run.level.metrics(text.size);
            let shift = if text.turned { (down, -along) } else { (along, down) };
            let origin = self.device((text.at.0 + shift.0, text.at.1 + shift.1));
            font::draw(&run.text, size * self.scale, |right, down, coverage| {
                let at = if text.turned { (down, -right) } else { (right, down) };
                self.blend((origin.0 + at.0, origin.1 + at.1), text.color, coverage);
            });
            along += font::width(&run.text) * size;
        }
    }

    fn device(&self, (x, y): Pt) -> (i64, i64) {
        ((x * self.scale).round() as i64, (y * self.scale).round() as i64)
    }

    fn blend(&mut self, (x, y): (i64, i64), color: Color, coverage: f64) {
        let (Ok(x), Ok(y)) = (usize::try_from(x), usize::try_from(y)) else {
            return;
        };
        if x >= self.size.0 || y >= self.size.1 {
            return;
        }
        let start = 3 * (y * self.size.0 + x);
        let coverage = coverage.clamp(0.0, 1.0);
        for (channel, ink) in self.pixels[start..start + 3].iter_mut().zip([color.0, color.1, color.2]) {
            *channel = (f64::from(*channel) * (1.0 - coverage) + f64::from(ink) * coverage).round() as u8;
        }
    }
}

/// plotters on the large picture, in nominal coordinates.
struct Pen<'a> {
    backend: BitMapBackend<'a>,
    scale: f64,
}

impl Pen<'_> {
    fn device(&self, (x, y): Pt) -> (i32, i32) {
        ((x * self.scale).round() as i32, (y * self.scale).round() as i32)
    }

    fn rectangle(&mut self, rect: &Rect, fill: Color) -> Result<(), String> {
        let (from, to) = (self.device((rect.left, rect.top)), self.device((rect.right, rect.bottom)));
        if from.0 >= to.0 || from.1 >= to.1 {
            return Ok(());
        }
        self.backend.draw_rect(from, to, &style(fill), true).map_err(|error| error.to_string())
    }

    fn polygon(&mut self, corners: &[Pt], fill: Color) -> Result<(), String> {
        let corners: Vec<(i32, i32)> = corners.iter().map(|corner| self.device(*corner)).collect();
        self.backend.fill_polygon(corners, &style(fill)).map_err(|error| error.to_string())
    }

    fn area(&mut self, corners: &[Pt], fill: Color, opacity: f64) -> Result<(), String> {
        let corners: Vec<(i32, i32)> = corners.iter().map(|corner| self.device(*corner)).collect();
        self.backend.fill_polygon(corners, &style(fill).mix(opacity)).map_err(|error| error.to_string())
    }

    fn disc(&mut self, center: Pt, radius: f64, fill: Color) -> Result<(), String> {
        let pixels = (radius * self.scale).round().max(1.0) as u32;
        let center = self.device(center);
        self.backend.draw_circle(center, pixels, &style(fill), true).map_err(|error| error.to_string())
    }

    fn marker(&mut self, center: Pt, marker: Marker, radius: f64, color: Color) -> Result<(), String> {
        if marker == Marker::Circle {
            return self.disc(center, radius, color);
        }
        let outlines = marker.outlines(center, radius);
        match marker.stroke_width(radius) {
            Some(width) => outlines.iter().try_for_each(|line| self.stroke(line, &Stroke::solid(color, width))),
            None => outlines.iter().try_for_each(|line| self.polygon(&line[..line.len() - 1], color)),
        }
    }

    fn stroke(&mut self, points: &[Pt], stroke: &Stroke) -> Result<(), String> {
        for part in dashes(points, stroke.dash) {
            part.windows(2).try_for_each(|pair| self.segment(pair[0], pair[1], stroke))?;
            let joints = if part.len() > 2 { &part[1..part.len() - 1] } else { &[] };
            joints.iter().try_for_each(|joint| self.disc(*joint, 0.5 * stroke.width, stroke.color))?;
            if part.len() > 2 && part.first() == part.last() {
                self.disc(part[0], 0.5 * stroke.width, stroke.color)?;
            }
        }
        Ok(())
    }

    /// A segment with its width, ending square at its ends.
    fn segment(&mut self, from: Pt, to: Pt, stroke: &Stroke) -> Result<(), String> {
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
        self.polygon(&[side(from, 1.0), side(to, 1.0), side(to, -1.0), side(from, -1.0)], stroke.color)
    }
}

fn style(color: Color) -> RGBColor {
    RGBColor(color.0, color.1, color.2)
}

/// The drawn parts of a dashed line.
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

    #[test]
    fn blocks_are_averaged() {
        let pixels = [[0u8; 6], [255; 6]].concat();
        assert_eq!(average(&pixels, (1, 1), 2), [128; 3]);
    }
}
