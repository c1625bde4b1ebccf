//! Lines of text with superscripts and subscripts: measuring with the embedded font, breaking, shortening.

use ab_glyph::{Font, FontRef, GlyphId};
use std::sync::LazyLock;

/// Distance of lines of text, and half the height of a digit, in em.
pub(super) const LINE_HEIGHT: f64 = 1.22;
pub(super) const HALF_DIGIT: f64 = 0.365;
/// Units of the font in an em.
pub(super) const EM: f64 = 2048.0;

/// The font; none would be a broken build, which a test checks.
pub(super) static DEJAVU: LazyLock<Option<FontRef>> =
    LazyLock::new(|| FontRef::try_from_slice(include_bytes!("fonts/DejaVuSans.ttf")).ok());

/// Returns the glyphs of a text, each with its start, and the end of the text; in em, with kerning.
pub(super) fn glyphs(font: &FontRef, text: &str) -> (Vec<(GlyphId, f64)>, f64) {
    let mut placed: Vec<(GlyphId, f64)> = Vec::new();
    let mut end = 0.0;
    for glyph in text.chars().map(|character| font.glyph_id(character)) {
        let kern = placed.last().map_or(0.0, |before| font.kern_unscaled(before.0, glyph));
        placed.push((glyph, f64::from(end + kern) / EM));
        end += kern + font.h_advance_unscaled(glyph);
    }
    (placed, f64::from(end) / EM)
}

pub(super) fn width(text: &str, size: f64) -> f64 {
    Rich::new(text).width(size)
}

/// Rise of superscripts and subscripts in em of the line.
const RAISED: f64 = 0.40;

/// Returns size and downward shift of a part with a rise.
pub(super) fn metrics(rise: f64, size: f64) -> (f64, f64) {
    (if rise == 0.0 { size } else { 0.72 * size }, -rise * size)
}

/// A line of text in parts, each with its rise in em.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Rich(pub Vec<(f64, String)>);

impl Rich {
    /// Reads a text. Superscript and subscript characters become raised and lowered parts, which look the same in
    /// every font, and so does a whole number after "^": `m/s^2`.
    pub fn new(text: &str) -> Self {
        let mut rich = Self::default();
        let mut is_exponent = false;
        let chars: Vec<char> = text.chars().collect();
        let is_digit = |k: usize| chars.get(k).is_some_and(char::is_ascii_digit);
        for (k, character) in chars.iter().enumerate() {
            let is_signed = matches!(chars.get(k + 1), Some('-' | '−'));
            let begins = *character == '^' && (is_digit(k + 1) || is_signed && is_digit(k + 2));
            is_exponent = begins || is_exponent && (is_digit(k) || chars[k - 1] == '^');
            match classify(*character) {
                _ if begins => {}
                _ if is_exponent => rich.push(RAISED, if *character == '-' { '−' } else { *character }),
                (rise, plain) => rich.push(rise, plain),
            }
        }
        rich
    }

    fn push(&mut self, rise: f64, character: char) {
        match self.0.last_mut() {
            Some((same, text)) if *same == rise => text.push(character),
            _ => self.0.push((rise, character.to_string())),
        }
    }

    pub fn width(&self, size: f64) -> f64 {
        let width = |text: &str| DEJAVU.as_ref().map_or(0.0, |font| glyphs(font, text).1);
        self.0.iter().map(|(rise, text)| width(text) * metrics(*rise, size).0).sum()
    }
}

/// Returns the rise of a character, and the one to draw.
fn classify(character: char) -> (f64, char) {
    let plain = |list: &str| "0123456789+−=()".chars().nth(list.chars().position(|one| one == character)?);
    let raised = plain("⁰¹²³⁴⁵⁶⁷⁸⁹⁺⁻⁼⁽⁾").map(|plain| (RAISED, plain));
    raised.or_else(|| Some((-0.16, plain("₀₁₂₃₄₅₆₇₈₉₊₋₌₍₎")?))).unwrap_or((0.0, character))
}

/// A text broken into lines, smaller if it would not fit otherwise.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Label {
    pub text: String,
    pub size: f64,
}

impl Label {
    /// Breaks a text; units come last in labels, so a smaller size is better than a lost end.
    pub fn new(text: &str, size: f64, room: f64, most: usize) -> Self {
        let at = |part: f64| Self { text: wrap(text, part * size, room, most).join("\n"), size: part * size };
        [1.0, 0.9, 0.8].into_iter().map(at).find(|label| !label.text.contains('…')).unwrap_or_else(|| at(0.8))
    }

    pub fn height(&self) -> f64 {
        LINE_HEIGHT * self.size * self.text.lines().count() as f64
    }
}

/// Breaks a text at spaces into at most `most` lines of width `room`; a text that does not fit ends in "…".
fn wrap(text: &str, size: f64, room: f64, most: usize) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    for word in text.split_whitespace() {
        let is_full = lines.len() == most;
        match lines.last_mut() {
            Some(line) if is_full || width(&format!("{line} {word}"), size) <= room => *line += &format!(" {word}"),
            _ => lines.push(word.to_string()),
        }
    }
    lines.iter().map(|line| shorten(line, size, room)).collect()
}

/// Returns the text, or the beginning that fits, followed by "…".
pub(super) fn shorten(text: &str, size: f64, room: f64) -> String {
    // No letter is narrower than this part of an em, so a longer text need not be measured.
    let most = (room / (0.2 * size)).clamp(0.0, 1e4) as usize;
    if text.chars().nth(most).is_none() && width(text, size) <= room {
        return text.to_string();
    }
    let cut = |count| text.chars().take(count).collect::<String>().trim_end().to_string() + "…";
    (1..=most).rev().map(cut).find(|cut| width(cut, size) <= room).unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn widths_are_those_of_the_font() {
        let font = DEJAVU.as_ref().expect("the font");
        assert_eq!(font.units_per_em().map(f64::from), Some(EM));
        // Read from the same file with fontTools: advances of A and V, and the kerning of their pair.
        assert_eq!([width("A", 1.0), width("V", 1.0)], [1401.0 / EM, 1401.0 / EM]);
        assert!(width("AV", 1.0) < width("A", 1.0) + width("V", 1.0) && width("mm", 1.0) > width("ll", 1.0));
    }

    #[test]
    fn superscripts_are_raised() {
        let rich = Rich::new("10⁻¹²");
        assert_eq!(rich.0.len(), 2);
        assert_eq!(rich.0[1], (RAISED, "−12".into()));
        assert_eq!(Rich::new("10^-12"), rich);
        assert_eq!(Rich::new("a (m/s^2) b^3"), Rich::new("a (m/s²) b³"));
        let texts: Vec<String> = Rich::new("x^n^2-1^").0.into_iter().map(|part| part.1).collect();
        assert_eq!(texts, ["x^n", "2", "-1^"]);
        assert!(Rich::new("").0.is_empty());
    }

    #[test]
    fn long_texts_are_broken_and_shortened() {
        let text = "the quick brown fox jumps over the lazy dog ".repeat(9);
        let lines = wrap(&text, 16.0, 200.0, 3);
        assert_eq!(lines.len(), 3);
        assert!(lines.iter().all(|line| width(line, 16.0) <= 200.0));
        assert!(lines[2].ends_with('…'));
        assert!(wrap("Donaudampfschifffahrtsgesellschaft", 16.0, 60.0, 2)[0].ends_with('…'));
        assert!(shorten("abc", 16.0, 1.0).is_empty());
    }
}
