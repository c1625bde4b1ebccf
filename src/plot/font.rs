//! The embedded font: which glyphs a text has and where they are, so that its width is known without drawing it.

use ab_glyph::{Font, FontRef, GlyphId};
use std::sync::LazyLock;

/// None would be a broken build: a test reads it.
pub(super) static DEJAVU: LazyLock<Option<FontRef>> =
    LazyLock::new(|| FontRef::try_from_slice(include_bytes!("fonts/DejaVuSans.ttf")).ok());

/// Units of the font in an em.
pub(super) const EM: f64 = 2048.0;

/// The glyphs of a text, each with where it begins, and where the text ends; in em, with kerning.
pub(super) fn glyphs(font: &FontRef, text: &str) -> (Vec<(GlyphId, f64)>, f64) {
    let (mut end, mut before) = (0.0, None);
    let mut place = |character| {
        let glyph = font.glyph_id(character);
        let start = end + before.map_or(0.0, |before| font.kern_unscaled(before, glyph));
        end = start + font.h_advance_unscaled(glyph);
        before = Some(glyph);
        (glyph, f64::from(start) / EM)
    };
    let placed = text.chars().map(&mut place).collect();
    (placed, f64::from(end) / EM)
}

/// Width of a text in em.
pub(super) fn width(text: &str) -> f64 {
    DEJAVU.as_ref().map_or(0.0, |font| glyphs(font, text).1)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn widths_are_those_of_the_font() {
        let font = DEJAVU.as_ref().expect("the font");
        assert_eq!(font.units_per_em().map(f64::from), Some(EM));
        // Read from the same file with fontTools: advances of A and V, and what brings them nearer to each other.
        assert_eq!([width("A"), width("V")], [1401.0 / EM, 1401.0 / EM]);
        assert!(width("AV") < width("A") + width("V") && width("mm") > width("ll"));
    }
}
