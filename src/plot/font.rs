//! The embedded font: glyphs of a text and their positions, from which its width is known without drawing it.

use ab_glyph::{Font, FontRef, GlyphId};
use std::sync::LazyLock;

/// The font; none would be a broken build, which a test checks.
pub(super) static DEJAVU: LazyLock<Option<FontRef>> =
    LazyLock::new(|| FontRef::try_from_slice(include_bytes!("fonts/DejaVuSans.ttf")).ok());

/// Units of the font in an em.
pub(super) const EM: f64 = 2048.0;

/// Returns the glyphs of a text, each with its start, and the end of the text; in em, with kerning.
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

/// Returns the width of a text in em.
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
        // Read from the same file with fontTools: advances of A and V, and the kerning of their pair.
        assert_eq!([width("A"), width("V")], [1401.0 / EM, 1401.0 / EM]);
        assert!(width("AV") < width("A") + width("V") && width("mm") > width("ll"));
    }
}
