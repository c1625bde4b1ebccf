//! Raster pictures.

mod canvas;
mod gif;

pub(super) use gif::gif;

use super::shape::Drawing;
use canvas::RasterCanvas;

/// Output pixels per nominal pixel: 1280 pixels in 85 mm.
const DENSITY: usize = 2;
/// Largest number of pixels.
const MOST_PIXELS: f64 = 5.0e7;
/// Printed width of 640 nominal pixels.
const COLUMN_METRES: f64 = 0.085;

/// Returns the bytes of a PNG file, or the reason why there is none. Pictures of unusual size are drawn coarser.
pub(super) fn png(drawing: &Drawing) -> Result<Vec<u8>, String> {
    let width = drawing.width.ceil();
    let height = drawing.height.ceil();
    let fits = |density: &usize| width * height * density.pow(2) as f64 <= MOST_PIXELS;
    let too_many = || format!("{width:.0} x {height:.0} pixels are too many; save it as SVG");
    let density = [DENSITY, 1].into_iter().find(fits).ok_or_else(too_many)?;
    let mut canvas = RasterCanvas::new(drawing, density).ok_or("a figure without pixels")?;
    canvas.draw(&drawing.shapes);
    encode(&canvas, density).map_err(|error| error.to_string())
}

fn encode(canvas: &RasterCanvas, density: usize) -> Result<Vec<u8>, png::EncodingError> {
    let (width, height) = canvas.size();
    let mut file = Vec::new();
    let mut encoder = png::Encoder::new(&mut file, width, height);
    encoder.set_color(png::ColorType::Rgb);
    encoder.set_depth(png::BitDepth::Eight);
    let per_metre = (640.0 * density as f64 / COLUMN_METRES).round() as u32;
    let dims = png::PixelDimensions { xppu: per_metre, yppu: per_metre, unit: png::Unit::Meter };
    encoder.set_pixel_dims(Some(dims));
    // Few colours and much paper: filters make files no smaller, and more effort makes them a fifth smaller at best.
    encoder.set_filter(png::Filter::NoFilter);
    encoder.set_deflate_compression(png::DeflateCompression::Level(1));
    let mut writer = encoder.write_header()?;
    writer.write_image_data(&canvas.rgb())?;
    writer.finish()?;
    Ok(file)
}
