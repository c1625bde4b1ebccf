//! Lexer: from characters to tokens.

use super::error::{ExpressionError, excerpt};
use super::operation::Two;

/// Kind of a token; the text of names and numbers is found by position.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum TokenKind {
    Number(f64),
    Name,
    /// The sign of an operation on two numbers; those of sum and difference stand before one number too.
    Infix(Two),
    Open,
    Close,
    Comma,
    /// The word `not`, which binds less tightly than a comparison.
    Not,
    /// The sign `!`, which binds as tightly as a unary minus.
    Bang,
    End,
}

/// A token and the bytes of the text it stands for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Token {
    pub kind: TokenKind,
    pub start: usize,
    pub end: usize,
}

/// Signs of two characters, looked for before any that they begin with.
const DOUBLE: [(&str, TokenKind); 6] = [
    ("<=", TokenKind::Infix(Two::AtMost)),
    (">=", TokenKind::Infix(Two::AtLeast)),
    ("==", TokenKind::Infix(Two::Equal)),
    ("!=", TokenKind::Infix(Two::Unequal)),
    ("&&", TokenKind::Infix(Two::And)),
    ("||", TokenKind::Infix(Two::Or)),
];

const SINGLE: [(&str, TokenKind); 11] = [
    ("<", TokenKind::Infix(Two::Less)),
    (">", TokenKind::Infix(Two::Greater)),
    ("!", TokenKind::Bang),
    ("+", TokenKind::Infix(Two::Add)),
    ("-", TokenKind::Infix(Two::Sub)),
    ("*", TokenKind::Infix(Two::Mul)),
    ("/", TokenKind::Infix(Two::Div)),
    ("^", TokenKind::Infix(Two::Pow)),
    ("(", TokenKind::Open),
    (")", TokenKind::Close),
    (",", TokenKind::Comma),
];

/// Signs of other languages, with those of this language in their place.
const FOREIGN: [(&str, &str); 19] = [
    ("**", "a power is written `^`"),
    ("=", "equality is written `==`"),
    ("&", "write `and` or `&&`"),
    ("|", "write `or` or `||`; a magnitude is `abs(x)`"),
    ("\u{2212}", "minus is written `-`"),
    ("\u{2013}", "minus is written `-`"),
    ("\u{d7}", "a product is written `*`"),
    ("\u{b7}", "a product is written `*`"),
    ("\u{22c5}", "a product is written `*`"),
    ("\u{f7}", "a quotient is written `/`"),
    ("\u{b2}", "a square is written `^2`"),
    ("\u{b3}", "a cube is written `^3`"),
    ("\u{b0}", "angles are in radians: `30*pi/180`"),
    ("\u{2032}", "a rate is written with `'`"),
    ("\u{2019}", "a rate is written with `'`"),
    ("\u{2264}", "write `<=`"),
    ("\u{2265}", "write `>=`"),
    ("[", "write `(`"),
    ("{", "write `(`"),
];

/// The tokens of `text`, the last one [`TokenKind::End`].
pub(super) fn tokens(text: &str) -> Result<Vec<Token>, ExpressionError> {
    let mut tokens = Vec::with_capacity(text.len() + 1);
    let mut start = 0;
    loop {
        let rest = text.get(start..).unwrap_or("");
        start += rest.len() - rest.trim_start().len();
        let token = next(text, start)?;
        tokens.push(token);
        if token.kind == TokenKind::End {
            return Ok(tokens);
        }
        start = token.end;
    }
}

/// The names that `text` mentions, functions among them, in the order of their mention.
pub(super) fn names(text: &str) -> Result<Vec<&str>, ExpressionError> {
    let named = tokens(text)?.into_iter().filter(|token| token.kind == TokenKind::Name);
    Ok(named.filter_map(|token| text.get(token.start..token.end)).collect())
}

/// The words of a text, which may be no expression, with what follows each: names with their dots and primes, numbers,
/// and single other characters.
pub(crate) fn words(text: &str) -> impl Iterator<Item = (&str, &str)> {
    let mut rest = text;
    std::iter::from_fn(move || {
        let first = rest.chars().next()?;
        let length = if begins_name(first) {
            name_length(rest)
        } else {
            // Letters after a number, as in `2nd`, are no name.
            number_length(rest).map_or(first.len_utf8(), |length| length + word_length(&rest[length..]))
        };
        let (word, after) = rest.split_at(length);
        rest = after;
        Some((word, after))
    })
}

/// The text with other words in the place of its names; `change` is given a name and what follows it, and returns `None`
/// where the name stays.
pub(crate) fn with_names<E>(
    text: &str,
    mut change: impl FnMut(&str, &str) -> Result<Option<String>, E>,
) -> Result<String, E> {
    let mut result = String::with_capacity(text.len());
    for (word, after) in words(text) {
        let other = if word.starts_with(begins_name) { change(word, after)? } else { None };
        result.push_str(other.as_deref().unwrap_or(word));
    }
    Ok(result)
}

/// True if `text` is one name without dots and primes.
pub(crate) fn is_plain_name(text: &str) -> bool {
    word_length(text) == text.len() && text.starts_with(begins_name)
}

fn next(text: &str, start: usize) -> Result<Token, ExpressionError> {
    let rest = text.get(start..).unwrap_or("");
    let token = |kind, length| Ok(Token { kind, start, end: start + length });
    if rest.is_empty() {
        return token(TokenKind::End, 0);
    }
    if rest.starts_with(begins_name) {
        let length = name_length(rest);
        return token(word(&rest[..length]), length);
    }
    if let Some(length) = number_length(rest) {
        let value = number(text, start, &rest[..length])?;
        return token(TokenKind::Number(value), length);
    }
    sign(text, start, rest)
}

fn sign(text: &str, start: usize, rest: &str) -> Result<Token, ExpressionError> {
    let find = |signs: &[(&'static str, TokenKind)]| signs.iter().find(|(sign, _)| rest.starts_with(sign)).copied();
    let foreign = FOREIGN.iter().find(|(sign, _)| rest.starts_with(sign));
    match (find(&DOUBLE), foreign, find(&SINGLE)) {
        (Some((sign, kind)), ..) | (None, None, Some((sign, kind))) => {
            Ok(Token { kind, start, end: start + sign.len() })
        }
        (None, Some((sign, hint)), _) => Err(unexpected(text, start, sign).hint(*hint)),
        (None, None, None) => Err(unexpected(text, start, &rest.chars().take(1).collect::<String>())),
    }
}

fn unexpected(text: &str, start: usize, found: &str) -> ExpressionError {
    ExpressionError::at(text, start, format!("unexpected `{}`", found.escape_debug()), "")
}

fn number(text: &str, start: usize, digits: &str) -> Result<f64, ExpressionError> {
    match digits.parse::<f64>() {
        Ok(value) if value.is_finite() => Ok(value),
        _ => Err(ExpressionError::at(text, start, format!("number `{}` too large", excerpt(digits)), "")),
    }
}

fn word(name: &str) -> TokenKind {
    match name {
        "and" => TokenKind::Infix(Two::And),
        "or" => TokenKind::Infix(Two::Or),
        "not" => TokenKind::Not,
        _ => TokenKind::Name,
    }
}

fn begins_name(c: char) -> bool {
    c.is_alphabetic() || c == '_'
}

/// Length in bytes of the letters, digits and underscores that `text` begins with.
fn word_length(text: &str) -> usize {
    text.find(|c: char| !begins_name(c) && !c.is_ascii_digit()).unwrap_or(text.len())
}

/// Length in bytes of `word(.word)*'*`: a dot belongs to the name only if a word follows.
fn name_length(text: &str) -> usize {
    let mut length = word_length(text);
    while let Some(tail) = text[length..].strip_prefix('.') {
        match word_length(tail) {
            0 => break,
            more => length += 1 + more,
        }
    }
    let tail = &text[length..];
    length + tail.len() - tail.trim_start_matches('\'').len()
}

/// Length in bytes of the number that `text` begins with: digits with at most one point, and an exponent if complete.
fn number_length(text: &str) -> Option<usize> {
    let digits = |from: usize| text[from..].bytes().take_while(u8::is_ascii_digit).count();
    let whole = digits(0);
    let mut length = whole;
    if text[whole..].starts_with('.') {
        let fraction = digits(whole + 1);
        if whole + fraction == 0 {
            return None;
        }
        length = whole + 1 + fraction;
    }
    if length == 0 {
        return None;
    }
    let tail = text[length..].strip_prefix(['e', 'E']);
    let sign = tail.map_or(0, |tail| usize::from(tail.starts_with(['+', '-'])));
    match tail.map_or(0, |_| digits(length + 1 + sign)) {
        0 => Some(length),
        exponent => Some(length + 1 + sign + exponent),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn words(text: &str) -> Vec<&str> {
        let tokens = tokens(text).unwrap();
        tokens.iter().map(|token| &text[token.start..token.end]).filter(|word| !word.is_empty()).collect()
    }

    fn message(text: &str) -> String {
        tokens(text).unwrap_err().to_string()
    }

    #[test]
    fn names_take_dots_primes_and_greek_letters() {
        assert_eq!(words("crank.C.x*theta''-ω_1'"), ["crank.C.x", "*", "theta''", "-", "ω_1'"]);
        assert_eq!(words("link2.3d + _a"), ["link2.3d", "+", "_a"]);
        assert_eq!(message("crank."), "unexpected `.` at character 6");
        assert_eq!(names("2*a.b + sin(c') and d").unwrap(), ["a.b", "sin", "c'", "d"]);
    }

    #[test]
    fn numbers_take_a_point_and_an_exponent() {
        let value = |text: &str| match tokens(text).unwrap()[..] {
            [Token { kind: TokenKind::Number(value), .. }, Token { kind: TokenKind::End, .. }] => value,
            _ => f64::NAN,
        };
        let table = [("1", 1.0), (".5", 0.5), ("3.", 3.0), ("1e-3", 1e-3), ("2.5E+4", 2.5e4), ("1.e2", 100.0)];
        table.iter().for_each(|(text, expected)| assert_eq!(value(text), *expected, "{text}"));
        assert_eq!(words("2e+x"), ["2", "e", "+", "x"]);
        assert_eq!(words("1.2.3"), ["1.2", ".3"]);
        assert_eq!(message("2+1e999"), "number `1e999` too large at character 3");
    }

    #[test]
    fn foreign_signs_are_explained() {
        let table = [
            ("x**2", "unexpected `**` at character 2; a power is written `^`"),
            ("a=b", "unexpected `=` at character 2; equality is written `==`"),
            ("ω−1", "unexpected `−` at character 2; minus is written `-`"),
            ("a & b", "unexpected `&` at character 3; write `and` or `&&`"),
            ("30°", "unexpected `°` at character 3; angles are in radians: `30*pi/180`"),
            ("a \u{0} b", "unexpected `\\0` at character 3"),
            ("a # b", "unexpected `#` at character 3"),
        ];
        table.iter().for_each(|(text, expected)| assert_eq!(message(text), *expected));
        assert_eq!(words("a<=b==c!=d&&!e||f"), ["a", "<=", "b", "==", "c", "!=", "d", "&&", "!", "e", "||", "f"]);
    }

    #[test]
    fn names_in_any_text_are_replaced() {
        let words: Vec<&str> = super::words("2nd-a.b'(1e-3x").map(|(word, _)| word).collect();
        assert_eq!(words, ["2nd", "-", "a.b'", "(", "1e-3x"]);
        let change = |name: &str, after: &str| match name {
            "l" => Err(()),
            _ => Ok((name != "t").then(|| format!("{name}_{}", after.len()))),
        };
        assert_eq!(with_names("2e3*t + f(ä.x'') crank.", change), Ok("2e3*t + f_15(ä.x''_8) crank_1.".to_string()));
        assert_eq!(with_names("t*l", change), Err(()));
    }

    #[test]
    fn plain_names_have_neither_dots_nor_primes() {
        ["l", "m3", "_k", "β"].iter().for_each(|name| assert!(is_plain_name(name), "{name}"));
        ["", "3m", "a.b", "a'", "a b", "a-b"].iter().for_each(|name| assert!(!is_plain_name(name), "{name}"));
    }
}
