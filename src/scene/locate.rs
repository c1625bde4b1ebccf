//! Line and column of a JSON path in the text it came from.

/// Line and column, from one, of the value at `path` (such as `joints[2].between`), or of the deepest part of the path
/// that exists.
pub fn locate(text: &str, path: &str) -> Option<(usize, usize)> {
    let mut scanner = Scanner { text: text.as_bytes(), at: 0 };
    scanner.space();
    for segment in segments(path) {
        let before = scanner.at;
        if !scanner.enter(&segment) {
            scanner.at = before;
            break;
        }
    }
    text.is_char_boundary(scanner.at).then(|| line_and_column(text, scanner.at))
}

/// Line and column, from one and in characters, of byte `offset`.
pub fn line_and_column(text: &str, offset: usize) -> (usize, usize) {
    let before = text.get(..offset).unwrap_or(text);
    let last = before.rsplit('\n').next().unwrap_or("");
    (before.matches('\n').count() + 1, last.chars().count() + 1)
}

enum Segment {
    Key(String),
    Index(usize),
}

fn segments(path: &str) -> Vec<Segment> {
    let mut segments = Vec::new();
    for part in path.split('.') {
        let (key, indices) = part.split_once('[').unwrap_or((part, ""));
        if !key.is_empty() {
            segments.push(Segment::Key(key.to_string()));
        }
        let numbers = indices.split(['[', ']']).filter_map(|number| number.parse().ok());
        segments.extend(numbers.map(Segment::Index));
    }
    segments
}

/// Walks over JSON text that is known to be well formed.
struct Scanner<'a> {
    text: &'a [u8],
    at: usize,
}

impl Scanner<'_> {
    fn peek(&self) -> u8 {
        self.text.get(self.at).copied().unwrap_or(0)
    }

    fn space(&mut self) {
        while self.peek().is_ascii_whitespace() {
            self.at += 1;
        }
    }

    /// Moves from a value to its part; returns false if there is none.
    fn enter(&mut self, segment: &Segment) -> bool {
        let wanted = match (segment, self.peek()) {
            (Segment::Key(_), b'{') | (Segment::Index(_), b'[') => segment,
            _ => return false,
        };
        self.at += 1;
        for index in 0.. {
            self.space();
            match (wanted, self.peek()) {
                (_, b'}' | b']' | 0) => return false,
                (Segment::Key(key), _) => {
                    let found = self.string() == key.as_bytes();
                    self.space();
                    self.at += 1;
                    self.space();
                    if found {
                        return true;
                    }
                }
                (Segment::Index(wanted), _) if index == *wanted => return true,
                _ => {}
            }
            self.skip();
            self.space();
            if self.peek() == b',' {
                self.at += 1;
            }
        }
        false
    }

    /// Returns the raw text of the string here and moves past it.
    fn string(&mut self) -> &[u8] {
        let start = self.at + 1;
        self.at = start;
        while !matches!(self.peek(), b'"' | 0) {
            self.at += if self.peek() == b'\\' { 2 } else { 1 };
        }
        let end = self.at.min(self.text.len());
        self.at = end + 1;
        &self.text[start.min(end)..end]
    }

    /// Moves past a value.
    fn skip(&mut self) {
        let mut depth = 0;
        loop {
            match self.peek() {
                0 => return,
                b'"' => {
                    self.string();
                }
                b'{' | b'[' => {
                    depth += 1;
                    self.at += 1;
                }
                b'}' | b']' if depth == 0 => return,
                b'}' | b']' => {
                    depth -= 1;
                    self.at += 1;
                }
                b',' if depth == 0 => return,
                _ => self.at += 1,
            }
            if depth == 0 && matches!(self.peek(), b',' | b'}' | b']' | 0) {
                return;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::locate;

    const TEXT: &str = "{\n  \"a\": [1, {\"b\": \"x,}]\\\"\"}],\n  \"c\": {\"d\": [[1, 2], 3]}\n}";

    #[test]
    fn finds_values_and_the_deepest_part_that_exists() {
        assert_eq!(locate(TEXT, ""), Some((1, 1)));
        assert_eq!(locate(TEXT, "a"), Some((2, 8)));
        assert_eq!(locate(TEXT, "a[1].b"), Some((2, 18)));
        assert_eq!(locate(TEXT, "c.d[0][1]"), Some((3, 19)));
        assert_eq!(locate(TEXT, "c.d[1]"), Some((3, 23)));
        assert_eq!(locate(TEXT, "c.missing"), Some((3, 8)));
        assert_eq!(locate("", "a"), Some((1, 1)));
    }
}
