//! The embedded font: widths of texts, and glyphs as coverage of pixels.
//!
//! plotters draws glyphs but drops their left side bearing, so they are drawn one by one here and put where the
//! font's own tables say.

use std::sync::OnceLock;

use plotters::style::{FontDesc, FontFamily, FontStyle, register_font};

static DEJAVU: &[u8] = include_bytes!("fonts/DejaVuSans.ttf");
const FAMILY: &str = "holonom DejaVu Sans";
/// plotters takes the height from ascender to descender as the size; the em is this much smaller.
const HEIGHT_PER_EM: f64 = 2384.0 / 2048.0;
/// Size at which widths are measured: they come rounded to whole pixels.
const MEASURE: f64 = 1024.0;
/// Where the font has no answer.
const FALLBACK_WIDTH: f64 = 0.6;

fn font(size: f64) -> FontDesc<'static> {
    static REGISTERED: OnceLock<bool> = OnceLock::new();
    REGISTERED.get_or_init(|| register_font(FAMILY, FontStyle::Normal, DEJAVU).is_ok());
    FontDesc::new(FontFamily::Name(FAMILY), size, FontStyle::Normal)
}

/// Width of a text in em, with kerning.
pub(super) fn width(text: &str) -> f64 {
    match font(MEASURE * HEIGHT_PER_EM).layout_box(text) {
        Ok((_, (right, _))) => f64::from(right) / MEASURE,
        Err(_) => FALLBACK_WIDTH * text.chars().count() as f64,
    }
}

/// Calls `ink(right, down, coverage)` for the pixels of a text whose baseline starts at (0, 0); `em` in pixels.
pub(super) fn draw(text: &str, em: f64, mut ink: impl FnMut(i64, i64, f64)) {
    // An even whole size keeps the baseline, which plotters puts at half the size, on a pixel.
    let size = (0.5 * em * HEIGHT_PER_EM).round().max(1.0) * 2.0;
    let em = size / HEIGHT_PER_EM;
    let font = font(size);
    for (start, glyph) in text.char_indices() {
        let end = start + glyph.len_utf8();
        let pen = (width(&text[..end]) - width(&text[start..end])) * em;
        let left = pen.round() as i64 + (left_bearing(glyph) * em).floor() as i64;
        let down = -(0.5 * size) as i64;
        let drawn = font.draw(&text[start..end], (0, 0), |x, y, coverage| {
            ink(left + i64::from(x), down + i64::from(y), f64::from(coverage));
            Ok::<(), std::convert::Infallible>(())
        });
        // Without a glyph there is nothing to draw; the picture stays valid.
        drop(drawn);
    }
}

/// Space left of a glyph's ink, in em.
fn left_bearing(glyph: char) -> f64 {
    bearing_units(DEJAVU, glyph).map_or(0.0, |units| f64::from(units) / 2048.0)
}

fn bearing_units(font: &[u8], glyph: char) -> Option<i16> {
    let index = glyph_index(font, table(font, b"cmap")?, u32::from(glyph))?;
    let (metrics, header) = (table(font, b"hmtx")?, table(font, b"hhea")?);
    let full = usize::from(word(font, header + 34)?);
    // Glyphs beyond `full` share the last advance and list their bearing alone.
    let at = if index < full { 4 * index + 2 } else { 4 * full + 2 * (index - full) };
    word(font, metrics + at).map(|bits| bits as i16)
}

/// Number of the glyph of a character, from the segments of a format 4 map.
fn glyph_index(font: &[u8], maps: usize, code: u32) -> Option<usize> {
    let count = usize::from(word(font, maps + 2)?);
    let offsets = (0..count).filter_map(|map| long(font, maps + 4 + 8 * map + 4));
    let map = offsets.map(|offset| maps + offset).find(|at| word(font, *at) == Some(4))?;
    let (code, segments) = (u16::try_from(code).ok()?, usize::from(word(font, map + 6)?) / 2);
    let column = |number: usize| map + 14 + number * 2 * segments + if number > 0 { 2 } else { 0 };
    let segment = (0..segments).find(|s| word(font, column(0) + 2 * s).is_some_and(|last| last >= code))?;
    let (first, delta) = (word(font, column(1) + 2 * segment)?, word(font, column(2) + 2 * segment)?);
    let (at, place) = (column(3) + 2 * segment, code.checked_sub(first)?);
    match word(font, at)? {
        0 => Some(usize::from(code.wrapping_add(delta))),
        offset => word(font, at + usize::from(offset) + 2 * usize::from(place)).map(usize::from),
    }
}

fn table(font: &[u8], name: &[u8; 4]) -> Option<usize> {
    let entries = (0..usize::from(word(font, 4)?)).map(|entry| 12 + 16 * entry);
    let mut found = entries.filter(|at| font.get(*at..at + 4) == Some(name.as_slice()));
    long(font, found.next()? + 8)
}

fn word(font: &[u8], at: usize) -> Option<u16> {
    font.get(at..at + 2).map(|bytes| u16::from_be_bytes([bytes[0], bytes[1]]))
}

fn long(font: &[u8], at: usize) -> Option<usize> {
    Some(usize::from(word(font, at)?) << 16 | usize::from(word(font, at + 2)?))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_height_of_the_em_is_that_of_the_font() {
        let header = table(DEJAVU, b"hhea").expect("hhea");
        let ascender = f64::from(word(DEJAVU, header + 4).expect("ascender") as i16);
        let descender = f64::from(word(DEJAVU, header + 6).expect("descender") as i16);
        assert_eq!(HEIGHT_PER_EM, (ascender - descender) / 2048.0);
        assert_eq!(word(DEJAVU, table(DEJAVU, b"head").expect("head") + 18), Some(2048));
    }

    #[test]
    fn bearings_are_read() {
        // Read from the same file with fontTools.
        assert_eq!(bearing_units(DEJAVU, 'l'), Some(193));
        assert_eq!(bearing_units(DEJAVU, 'A'), Some(16));
        assert_eq!(bearing_units(DEJAVU, 'λ'), Some(61));
        assert_eq!(bearing_units(DEJAVU, 'j'), Some(-37));
        assert_eq!(bearing_units(DEJAVU, '−'), Some(217));
        assert!(width("mm") > width("ll"));
    }

    #[test]
    fn ink_is_inside_the_width() {
        let (mut low, mut high) = (i64::MAX, i64::MIN);
        draw("Hl", 100.0, |x, _, coverage| {
            if coverage > 0.5 {
                (low, high) = (low.min(x), high.max(x));
            }
        });
        assert!((8..=12).contains(&low), "{low}");
        assert!((high as f64) < 100.0 * width("Hl") - 8.0, "{high}");
    }
}
