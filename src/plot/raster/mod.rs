//! Raster pictures: drawn by plotters several times as large, then averaged down, since its lines have jagged edges.

mod canvas;
mod gif;

pub(super) use gif::gif;

use super::shape::{Drawing, Shape};

/// Output pixels per nominal pixel: 1280 pixels in 85 mm.
const DENSITY: usize = 2;
/// Subpixels per output pixel and direction.
const FINENESS: usize = 4;
/// Largest number of pixels of the large picture; beyond, it is drawn coarser.
const MOST_PIXELS: f64 = 5.0e7;
/// Printed width of 640 nominal pixels.
const COLUMN_METRES: f64 = 0.085;

/// Returns the bytes of a PNG file, or the reason why there is none.
pub(super) fn png(drawing: &Drawing) -> Result<Vec<u8>, String> {
    let (density, fineness) = resolution(drawing)?;
    let sheet = Sheet::new(drawing, density, fineness);
    let pixels = sheet.draw(sheet.blank(), &drawing.shapes)?;
    encode(&sheet.average(&pixels), sheet.size, density).map_err(|error| error.to_string())
}

/// Format of pictures of the same size.
struct Sheet {
    /// Subpixels per nominal pixel.
    scale: usize,
    fineness: usize,
    /// Width and height in output pixels.
    size: (usize, usize),
}

impl Sheet {
    fn new(drawing: &Drawing, density: usize, fineness: usize) -> Self {
        let size = (drawing.width.ceil() as usize * density, drawing.height.ceil() as usize * density);
        Self { scale: density * fineness, fineness, size }
    }

    /// Returns the large picture, empty.
    fn blank(&self) -> Vec<u8> {
        vec![255; 3 * self.size.0 * self.size.1 * self.fineness * self.fineness]
    }

    /// Draws on a large picture.
    fn draw(&self, mut pixels: Vec<u8>, shapes: &[Shape]) -> Result<Vec<u8>, String> {
        let size = (self.size.0 * self.fineness, self.size.1 * self.fineness);
        let mut pen = canvas::RasterCanvas::new(&mut pixels, size, self.scale);
        shapes.iter().try_for_each(|shape| pen.draw(shape))?;
        drop(pen);
        Ok(pixels)
    }

    /// Returns the output pixels (red, green, blue) of a large picture: means of `fineness` by `fineness` blocks.
    fn average(&self, pixels: &[u8]) -> Vec<u8> {
        let (stride, fineness) = (3 * self.size.0 * self.fineness, self.fineness);
        let count = (fineness * fineness) as u32;
        let mut means = Vec::with_capacity(3 * self.size.0 * self.size.1);
        for row in pixels.chunks_exact(stride * fineness) {
            for column in 0..self.size.0 {
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
}

/// Returns density and fineness, reduced for pictures of unusual size.
fn resolution(drawing: &Drawing) -> Result<(usize, usize), String> {
    let area = drawing.width.ceil() * drawing.height.ceil();
    let mut choices = [(DENSITY, FINENESS), (DENSITY, 3), (DENSITY, 2), (1, 2), (1, 1)].into_iter();
    let fits = |(density, fineness): &(usize, usize)| area * (density * fineness).pow(2) as f64 <= MOST_PIXELS;
    choices
        .find(fits)
        .ok_or_else(|| format!("{:.0} x {:.0} pixels are too many; save it as SVG", drawing.width, drawing.height))
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn blocks_are_averaged() {
        let sheet = Sheet { scale: 2, fineness: 2, size: (1, 1) };
        assert_eq!(sheet.average(&[[0u8; 6], [255; 6]].concat()), [128; 3]);
    }
}
