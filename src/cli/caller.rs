//! The caller of the command line: a shell, or a program that calls commands in its own process.

use crate::scene::Elements;
use std::cell::RefCell;
use std::sync::OnceLock;

thread_local! {
    static WORDS: RefCell<Option<Vec<String>>> = const { RefCell::new(None) };
}

static ELEMENTS: OnceLock<Elements> = OnceLock::new();

/// Sets the words of this thread's command, which results name.
pub fn set_words(words: &[String]) {
    WORDS.set(Some(words.to_vec()));
}

/// The words of the command; characters of a name that are not text are replaced.
pub fn command_line() -> Vec<String> {
    let process = || std::env::args_os().map(|word| word.to_string_lossy().into_owned()).collect();
    WORDS.with_borrow(Clone::clone).unwrap_or_else(process)
}

/// Sets the kinds of elements that scenes may name in all commands of this process.
pub fn set_elements(elements: Elements) {
    // They are set once, when the program starts.
    let _ = ELEMENTS.set(elements);
}

/// The kinds of elements that scenes may name.
pub fn elements() -> Elements {
    ELEMENTS.get().cloned().unwrap_or_default()
}
