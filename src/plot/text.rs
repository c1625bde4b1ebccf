//! Lines of text with superscripts and subscripts: measuring, breaking, shortening.

use super::font;

/// Size of a superscript or subscript relative to its line.
pub(super) const SCRIPT: f64 = 0.72;
/// Rise of a superscript, in em of the line.
pub(super) const RAISE: f64 = 0.40;
/// Drop of a subscript, in em of the line.
pub(super) const LOWER: f64 = 0.16;

/// Distance of lines of text in em.
pub(super) const LINE_HEIGHT: f64 = 1.22;
/// Half the height of a digit in em.
pub(super) const HALF_DIGIT: f64 = 0.365;

/// Part of a line on one level.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Run {
    pub text: String,
    pub level: Level,
}

/// Vertical level of a part.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Level {
    Base,
    Raised,
    Lowered,
}

impl Level {
    /// Returns size and downward shift of this level in a line of the given size.
    pub fn metrics(self, size: f64) -> (f64, f64) {
        match self {
            Self::Base => (size, 0.0),
            Self::Raised => (SCRIPT * size, -RAISE * size),
            Self::Lowered => (SCRIPT * size, LOWER * size),
        }
    }
}

/// A line of text.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Rich {
    pub runs: Vec<Run>,
}

impl Rich {
    /// Reads a text; superscript and subscript characters become raised and lowered parts, which look the same in every
    /// font, and control characters become spaces.
    pub fn new(text: &str) -> Self {
        if !text.is_empty() && text.bytes().all(|byte| byte == b' ' || byte.is_ascii_graphic()) {
            return Self { runs: vec![Run { text: text.to_string(), level: Level::Base }] };
        }
        let mut rich = Self::default();
        text.chars().for_each(|character| {
            let (level, plain) = classify(character);
            rich.push(level, plain);
        });
        rich
    }

    fn push(&mut self, level: Level, character: char) {
        match self.runs.last_mut() {
            Some(run) if run.level == level => run.text.push(character),
            _ => self.runs.push(Run { text: character.to_string(), level }),
        }
    }

    /// Returns the width at a font size.
    pub fn width(&self, size: f64) -> f64 {
        self.runs.iter().map(|run| font::width(&run.text) * run.level.metrics(size).0).sum()
    }
}

fn classify(character: char) -> (Level, char) {
    const RAISED: &str = "⁰¹²³⁴⁵⁶⁷⁸⁹⁺⁻⁼⁽⁾";
    const LOWERED: &str = "₀₁₂₃₄₅₆₇₈₉₊₋₌₍₎";
    const PLAIN: &str = "0123456789+−=()";
    let plain = |list: &str| list.chars().zip(PLAIN.chars()).find(|pair| pair.0 == character).map(|pair| pair.1);
    if let Some(plain) = plain(RAISED) {
        return (Level::Raised, plain);
    }
    if let Some(plain) = plain(LOWERED) {
        return (Level::Lowered, plain);
    }
    (Level::Base, if character.is_control() { ' ' } else { character })
}

/// Returns the width of a text at a font size.
pub(super) fn width(text: &str, size: f64) -> f64 {
    Rich::new(text).width(size)
}

/// Breaks a text at spaces into at most `most` lines of width `room`; a text that does not fit ends in "…".
pub(super) fn wrap(text: &str, size: f64, room: f64, most: usize) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    for word in text.split_whitespace() {
        let full = lines.len() == most;
        let joined = lines.last().map(|line| format!("{line} {word}"));
        match (lines.last_mut(), joined) {
            (Some(line), Some(joined)) if full || width(&joined, size) <= room => *line = joined,
            _ => lines.push(word.to_string()),
        }
    }
    lines.iter().map(|line| shorten(line, size, room)).collect()
}

/// A text broken into lines, smaller if it would not fit otherwise.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Label {
    pub lines: Vec<String>,
    pub size: f64,
}

impl Label {
    /// Breaks a text; units come last in labels, so a smaller size is better than a lost end.
    pub fn new(text: &str, size: f64, room: f64, most: usize) -> Self {
        let at = |size: f64| Self { lines: wrap(text, size, room, most), size };
        let whole = |label: &Self| !label.lines.iter().any(|line| line.ends_with('…'));
        let sizes = [size, 0.9 * size, 0.8 * size];
        sizes.into_iter().map(at).find(whole).unwrap_or_else(|| at(0.8 * size))
    }

    pub fn height(&self) -> f64 {
        LINE_HEIGHT * self.size * self.lines.len() as f64
    }
}

/// Returns the text, or the beginning that fits, followed by "…".
pub(super) fn shorten(text: &str, size: f64, room: f64) -> String {
    // No letter is narrower than this part of an em, so a longer text need not be measured.
    let most = (room / (0.2 * size)).clamp(0.0, 1e4) as usize;
    if text.chars().nth(most).is_none() && width(text, size) <= room {
        return text.to_string();
    }
    let letters: Vec<char> = text.chars().take(most).collect();
    let cut = |count: usize| letters[..count].iter().collect::<String>().trim_end().to_string() + "…";
    let (mut fits, mut too_long) = (0, letters.len() + 1);
    while too_long - fits > 1 {
        let middle = (fits + too_long) / 2;
        if width(&cut(middle), size) <= room { fits = middle } else { too_long = middle }
    }
    if fits == 0 { String::new() } else { cut(fits) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn superscripts_are_raised() {
        let rich = Rich::new("10⁻¹²");
        assert_eq!(rich.runs.len(), 2);
        assert_eq!(rich.runs[1], Run { text: "−12".into(), level: Level::Raised });
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
