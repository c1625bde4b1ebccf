//! Text on standard output and standard error, or kept for a program that called the command.
//!
//! Names, units and quotations come from scenes. Characters that control a terminal are escaped here, through which all
//! text passes.

use crate::error::{Error, Result};
use std::borrow::Cow;
use std::cell::RefCell;
use std::io::{ErrorKind, Write};

/// The output of a command that a program called.
#[derive(Debug, Default)]
pub struct Captured {
    /// The result as JSON; none of a command that only prints text.
    pub json: Option<String>,
    /// The text for standard output.
    pub text: String,
    /// Warnings and errors, in their order.
    pub told: Vec<String>,
}

thread_local! {
    static CAPTURED: RefCell<Option<Captured>> = const { RefCell::new(None) };
}

/// Keeps the output of this thread during `work` in the place of printing it.
pub fn captured<R>(work: impl FnOnce() -> R) -> (R, Captured) {
    CAPTURED.set(Some(Captured::default()));
    let result = work();
    (result, CAPTURED.take().unwrap_or_default())
}

pub fn is_captured() -> bool {
    CAPTURED.with_borrow(Option::is_some)
}

/// Calls `keep` with the output so far, and returns true, if it is kept.
pub fn capture(keep: impl FnOnce(&mut Captured)) -> bool {
    CAPTURED.with_borrow_mut(|captured| captured.as_mut().map(keep).is_some())
}

/// Writes to standard output; a closed pipe (`| head`) is no error.
///
/// # Errors
/// Other errors of the system, such as a full disk.
pub fn print(text: &str) -> Result<()> {
    if capture(|captured| captured.text += text) {
        return Ok(());
    }
    match std::io::stdout().write_all(visible(text).as_bytes()) {
        Err(error) if error.kind() != ErrorKind::BrokenPipe => {
            Err(Error::unwritten("standard output", error.to_string()))
        }
        _ => Ok(()),
    }
}

/// Writes a line to standard error, without an error if that is closed.
pub fn tell(text: impl AsRef<str>) {
    if capture(|captured| captured.told.push(text.as_ref().to_string())) {
        return;
    }
    let _ = writeln!(std::io::stderr(), "{}", visible(text.as_ref()));
}

/// Returns the text with characters that control a terminal, or change the direction of writing, as `\u001b`; JSON
/// keeps its meaning.
pub fn visible(text: &str) -> Cow<'_, str> {
    if !text.contains(steers) {
        return Cow::Borrowed(text);
    }
    let shown = |c: char| if steers(c) { format!("\\u{:04x}", c as u32) } else { c.to_string() };
    Cow::Owned(text.chars().map(shown).collect())
}

/// True for control characters except line breaks and tabs; marks, embeddings, overrides and isolates of bidirectional
/// text; line and paragraph separators.
fn steers(c: char) -> bool {
    let is_control = c.is_control() && !matches!(c, '\n' | '\t');
    is_control || matches!(c, '\u{61c}' | '\u{200e}' | '\u{200f}' | '\u{2028}'..='\u{202e}' | '\u{2066}'..='\u{2069}')
}

#[cfg(test)]
mod tests {
    use super::visible;

    #[test]
    fn nothing_steers_the_terminal() {
        let table = [
            ("a\tb\nφ\u{301}", "a\tb\nφ\u{301}"),
            ("\u{1b}[31mred\u{7}\0\r", "\\u001b[31mred\\u0007\\u0000\\u000d"),
            ("\u{9b}2J\u{7f}", "\\u009b2J\\u007f"),
            ("\u{202e}txt\u{2066}", "\\u202etxt\\u2066"),
        ];
        table.iter().for_each(|(text, shown)| assert_eq!(visible(text), *shown));
    }

    #[test]
    fn json_stays_what_it_is() {
        let value = serde_json::json!({ "a\u{9b}": "\u{1b}\u{202e}\u{7f}\\" });
        let text = serde_json::to_string_pretty(&value).unwrap();
        assert_eq!(serde_json::from_str::<serde_json::Value>(&visible(&text)).unwrap(), value);
    }
}
