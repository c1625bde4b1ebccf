//! Line and column of a JSON path in the text it came from.

use serde_json::value::RawValue;
use std::collections::HashMap;

/// Line and column, from one, of the value at `path` (such as `joints[2].between`), or of the deepest part of the path
/// that exists.
pub fn locate(text: &str, path: &str) -> (usize, usize) {
    let Ok(whole) = serde_json::from_str::<&RawValue>(text) else { return (1, 1) };
    let mut segments = path.split(['.', '[']).filter(|segment| !segment.is_empty());
    let found = segments.try_fold(whole, |value, segment| part(value, segment).ok_or(value));
    let (Ok(value) | Err(value)) = found;
    line_and_column(text, value.get().as_ptr().addr() - text.as_ptr().addr())
}

/// The part of a value at a key or an index such as `2]`; it borrows from the same text.
fn part<'t>(value: &'t RawValue, segment: &str) -> Option<&'t RawValue> {
    match segment.strip_suffix(']') {
        None => serde_json::from_str::<HashMap<String, &RawValue>>(value.get()).ok()?.remove(segment),
        Some(index) => {
            serde_json::from_str::<Vec<&RawValue>>(value.get()).ok()?.get(index.parse::<usize>().ok()?).copied()
        }
    }
}

/// Line and column, from one and in characters, of byte `offset`.
pub fn line_and_column(text: &str, offset: usize) -> (usize, usize) {
    let before = text.get(..offset).unwrap_or(text);
    let last = before.rsplit('\n').next().unwrap_or("");
    (before.matches('\n').count() + 1, last.chars().count() + 1)
}

#[cfg(test)]
mod tests {
    use super::locate;

    const TEXT: &str = "{\n  \"a\": [1, {\"b\": \"x,}]\\\"\"}],\n  \"c\": {\"d\": [[1, 2], 3]}\n}";

    #[test]
    fn finds_values_and_the_deepest_part_that_exists() {
        assert_eq!(locate(TEXT, ""), (1, 1));
        assert_eq!(locate(TEXT, "a"), (2, 8));
        assert_eq!(locate(TEXT, "a[1].b"), (2, 18));
        assert_eq!(locate(TEXT, "c.d[0][1]"), (3, 19));
        assert_eq!(locate(TEXT, "c.d[1]"), (3, 23));
        assert_eq!(locate(TEXT, "c.missing"), (3, 8));
        assert_eq!(locate("", "a"), (1, 1));
    }
}
