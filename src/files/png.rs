//! PNG files.

use png::{ColorType, DeflateCompression, Encoder, EncodingError, Filter, PixelDimensions, Unit};

/// Returns the file of a picture of red, green and blue, row by row, with its number of pixels in a metre.
///
/// # Errors
/// The encoder refuses the size.
pub fn encode(width: u32, height: u32, rgb: &[u8], per_metre: u32) -> Result<Vec<u8>, EncodingError> {
    let mut file = Vec::new();
    let mut encoder = Encoder::new(&mut file, width, height);
    encoder.set_color(ColorType::Rgb);
    encoder.set_pixel_dims(Some(PixelDimensions { xppu: per_metre, yppu: per_metre, unit: Unit::Meter }));
    // Few colours and much paper: filters make files no smaller, and more effort makes them a fifth smaller at best.
    encoder.set_filter(Filter::NoFilter);
    encoder.set_deflate_compression(DeflateCompression::Level(1));
    let mut writer = encoder.write_header()?;
    writer.write_image_data(rgb)?;
    writer.finish()?;
    Ok(file)
}
