//! How much a scene may grow when it is expanded: known before memory is taken.

use crate::error::{Error, Result};
use crate::math::memory::size;
use serde_json::Value;

/// Copies of all elements together; more are taken for a mistake.
const COPIES: usize = 1_000_000;
/// Included scenes, each as often as it is included.
const INCLUDES: usize = 10_000;
/// Text of all copies together, bytes.
const TEXT: usize = 64_000_000;

/// What is left of it.
pub struct Budget {
    copies: usize,
    includes: usize,
    text: usize,
}

impl Default for Budget {
    fn default() -> Self {
        Budget { copies: COPIES, includes: INCLUDES, text: TEXT }
    }
}

impl Budget {
    /// Takes so many further values of a repetition.
    ///
    /// # Errors
    /// More than a million in all.
    pub fn take_copies(&mut self, count: usize) -> Result<()> {
        self.copies = self
            .copies
            .checked_sub(count)
            .ok_or_else(|| Error::input(format!("more than {COPIES} copies")).hint("repeat less"))?;
        Ok(())
    }

    /// Takes the text of so many copies of a value.
    ///
    /// # Errors
    /// More than 64 MB in all.
    pub fn take_text(&mut self, value: &Value, count: usize) -> Result<()> {
        self.take_bytes(count.saturating_mul(length(value)))
    }

    /// Takes an included scene with its text.
    ///
    /// # Errors
    /// More than ten thousand in all, or more than 64 MB of text.
    pub fn take_include(&mut self, text: &str) -> Result<()> {
        self.includes = self.includes.checked_sub(1).ok_or_else(|| {
            Error::input(format!("more than {INCLUDES} scenes are included, one in the other")).hint("include less")
        })?;
        self.take_bytes(text.len())
    }

    fn take_bytes(&mut self, bytes: usize) -> Result<()> {
        self.text = self.text.checked_sub(bytes).ok_or_else(|| {
            Error::input(format!(
                "the scene grows beyond {} of text by what is repeated or included",
                size(TEXT as f64)
            ))
            .hint("repeat less, or shorten what is repeated")
        })?;
        Ok(())
    }
}

/// Length of a value as text, about.
fn length(value: &Value) -> usize {
    match value {
        Value::String(text) => 2 + text.len(),
        Value::Array(items) => items.iter().map(|item| 1 + length(item)).sum::<usize>() + 2,
        Value::Object(entries) => entries.iter().map(|(key, value)| 4 + key.len() + length(value)).sum::<usize>() + 2,
        _ => 4,
    }
}
