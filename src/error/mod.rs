//! Errors and warnings with place and remedy.

mod options;

use options::as_setting;
pub(crate) use options::as_settings;

use std::fmt;
use std::path::PathBuf;

/// Result with the library's [`Error`].
pub type Result<T, E = Error> = std::result::Result<T, E>;

/// An error of the library. [`Error::exit_code`] is the exit code of the program. `Debug` prints as `Display` does, so
/// that a `main` that returns it says what is wrong. `{}` names settings, `output_step = 0.1`; `{:#}` names the options
/// of the command line, `--output-step 0.1`, as the fields do.
#[derive(Clone, PartialEq)]
pub enum Error {
    /// The input is not valid.
    Input(Box<Input>),
    /// A file cannot be read, or cannot be created at its path.
    File {
        /// Path of the file.
        path: PathBuf,
        /// Cause, in words.
        problem: String,
    },
    /// A file could not be written: the disk is full, or a device failed.
    Unwritten {
        /// Path of the file.
        path: PathBuf,
        /// Cause, in words.
        problem: String,
    },
    /// The computation ended early; results up to then are kept.
    Run(Failure),
}

/// Bad input: its place, what is wrong, and the remedy.
#[derive(Debug, Clone, PartialEq, Default)]
#[doc(hidden)]
pub struct Input {
    /// JSON path such as `joints[2].between[1]`, or an option such as `--at`; empty for the whole file.
    pub path: String,
    /// Name of the element in which it is.
    pub element: Option<String>,
    /// What is wrong, without path and remedy.
    pub message: String,
    /// What to do about it.
    pub hint: Option<String>,
    /// Line and column in the file, from one.
    pub place: Option<(usize, usize)>,
    /// File that the input was read from.
    pub file: Option<PathBuf>,
}

/// Time and cause of the early end of a run.
#[derive(Debug, Clone, PartialEq, serde::Serialize, serde::Deserialize)]
#[doc(hidden)]
pub struct Failure {
    /// Time of the last good state, s.
    pub t: f64,
    /// Cause of the end.
    pub reason: String,
    /// What to change.
    pub hint: String,
}

/// Reason of the failure of a run that the user interrupted.
#[doc(hidden)]
pub const INTERRUPTED: &str = "interrupted";

/// A reason to doubt a result, with a remedy. `{}` and `{:#}` print settings and options as they do of an [`Error`].
#[derive(Debug, Clone, PartialEq)]
pub struct Warning {
    /// What is doubtful.
    pub text: String,
    /// What to do about it.
    pub hint: String,
}

impl Warning {
    /// A warning from its text and its remedy.
    pub fn new(text: impl Into<String>, hint: impl Into<String>) -> Self {
        Warning { text: text.into(), hint: hint.into() }
    }
}

impl fmt::Display for Warning {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(out, "warning: {}\n  help: {}", named(out, &self.text), named(out, &self.hint))
    }
}

/// One string: "TEXT; HINT".
impl serde::Serialize for Warning {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_str(&format_args!("{}; {}", self.text, self.hint))
    }
}

impl Error {
    /// Bad input, its path still empty; callers add the path by [`under`](Self::under).
    pub fn input(message: impl Into<String>) -> Self {
        Error::Input(Box::new(Input { message: message.into(), ..Input::default() }))
    }

    /// There is no `name` of this sort; the hint is the most similar known one.
    pub fn unknown<'a>(what: &str, name: &str, known: impl IntoIterator<Item = &'a str>) -> Self {
        Error::input(format!("there is no {what} `{name}`")).hint(suggest(name, known))
    }

    /// An error of a file that cannot be read or used.
    pub fn file(path: impl Into<PathBuf>, problem: impl ToString) -> Self {
        Error::File { path: path.into(), problem: problem.to_string() }
    }

    /// An error of a file that could not be written.
    pub fn unwritten(path: impl Into<PathBuf>, problem: impl ToString) -> Self {
        Error::Unwritten { path: path.into(), problem: problem.to_string() }
    }

    /// Changes what is said of bad input; other errors stay.
    pub(crate) fn changed(mut self, change: impl FnOnce(&mut Input)) -> Self {
        if let Error::Input(input) = &mut self {
            change(input);
        }
        self
    }

    /// Adds the remedy, unless there is one already.
    pub fn hint(self, hint: impl Into<String>) -> Self {
        self.changed(|input| _ = input.hint.get_or_insert(hint.into()))
    }

    /// Adds the name of the element, unless one closer to the fault is known.
    pub fn element(self, name: impl Into<String>) -> Self {
        self.changed(|input| _ = input.element.get_or_insert(name.into()))
    }

    /// Puts `segment` in front of the path: `under("joints[2]")` makes `between` into `joints[2].between`.
    pub fn under(self, segment: impl AsRef<str>) -> Self {
        self.changed(|input| {
            input.path = match input.path.chars().next() {
                None => segment.as_ref().to_string(),
                Some('[') => format!("{}{}", segment.as_ref(), input.path),
                Some(_) => format!("{}.{}", segment.as_ref(), input.path),
            }
        })
    }

    /// Replaces the path.
    pub fn at(self, path: impl Into<String>) -> Self {
        self.changed(|input| input.path = path.into())
    }

    /// Adds line and column in the file.
    pub fn placed(self, place: (usize, usize)) -> Self {
        self.changed(|input| _ = input.place.get_or_insert(place))
    }

    /// Adds the file that was read, unless an option of the command line is at fault.
    pub fn in_file(self, path: impl Into<PathBuf>) -> Self {
        self.changed(|input| {
            if !input.path.starts_with('-') {
                input.file.get_or_insert(path.into());
            }
        })
    }

    /// Exit code of the program: 2 for bad input or a file that cannot be read, 1 for all else.
    pub fn exit_code(&self) -> u8 {
        if matches!(self, Error::Input(_) | Error::File { .. }) { 2 } else { 1 }
    }
}

impl fmt::Display for Error {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Error::Input(input) => input.fmt(out),
            Error::File { path, problem } | Error::Unwritten { path, problem } => {
                write!(out, "{}: {problem}", path.display())
            }
            Error::Run(Failure { t, reason, hint }) => {
                write!(out, "stopped at t = {t:.6e} s: {}\n  help: {}", named(out, reason), named(out, hint))
            }
        }
    }
}

impl fmt::Debug for Error {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Display::fmt(self, out)
    }
}

impl fmt::Display for Input {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Some(file) = &self.file {
            write!(out, "{}", file.display())?;
            if let Some((line, column)) = self.place {
                write!(out, ":{line}:{column}")?;
            }
            write!(out, ": ")?;
        }
        let path = without_long_words(&self.path);
        let path = if out.alternate() { path } else { as_setting(&path) };
        match (path.as_str(), self.element.as_deref().map(without_long_words)) {
            ("", None) => {}
            ("", Some(element)) => write!(out, "`{element}`: ")?,
            (path, None) => write!(out, "at {path}: ")?,
            (path, Some(element)) => write!(out, "at {path} (`{element}`): ")?,
        }
        write!(out, "{}", named(out, &without_long_words(&self.message)))?;
        self.hint.iter().try_for_each(|hint| write!(out, "\n  help: {}", named(out, &without_long_words(hint))))
    }
}

/// The text as it is in the alternate form, that of the command line; else with settings in the place of options.
fn named(out: &fmt::Formatter, text: &str) -> String {
    if out.alternate() { text.to_string() } else { as_settings(text) }
}

/// The message with words of more than 100 bytes and quotations of more than 300 cut to their beginning.
fn without_long_words(text: &str) -> String {
    let short = |part: &str, most: usize| if part.len() > most { excerpt(part) } else { part.to_string() };
    let words = text.split(' ').map(|word| short(word, 100)).collect::<Vec<_>>().join(" ");
    words.split('`').map(|quotation| short(quotation, 300)).collect::<Vec<_>>().join("`")
}

impl std::error::Error for Error {}

/// For conversions that cannot fail.
impl From<std::convert::Infallible> for Error {
    fn from(never: std::convert::Infallible) -> Self {
        match never {}
    }
}

impl From<Failure> for Error {
    fn from(failure: Failure) -> Self {
        Error::Run(failure)
    }
}

/// Longer names are not compared: that would take time, and they are no misspellings.
const LONGEST_NAME: usize = 200;

/// The name in `known` nearest to `found`: one or two typing errors away, or longer and beginning with it.
#[doc(hidden)]
pub fn nearest<'a>(found: &str, known: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    if found.len() > LONGEST_NAME {
        return None;
    }
    let known = known.into_iter().filter(|name| name.len() <= LONGEST_NAME);
    let found = found.to_lowercase();
    let length = found.chars().count();
    let slips = |name: &str| strsim::damerau_levenshtein(&found, &name.to_lowercase());
    let allowed = (length / 3).clamp(usize::from(length > 1), 4);
    let begins = |name: &str| length >= 3 && name.to_lowercase().starts_with(&found);
    let alike =
        |name: &str| slips(name) <= 2.min(length / 2) && strsim::jaro_winkler(&found, &name.to_lowercase()) > 0.8;
    // Names within the allowed distance come first, then the first of those that are merely alike.
    let rank = |name: &&str| if slips(name) <= allowed { slips(name) } else { usize::MAX };
    known.filter(|name| slips(name) <= allowed || begins(name) || alike(name)).min_by_key(rank)
}

/// "did you mean" for a name that is not in the list, or the list itself when nothing is near.
#[doc(hidden)]
pub fn suggest<'a>(found: &str, known: impl IntoIterator<Item = &'a str>) -> String {
    suggest_one_of(found, known.into_iter().collect())
}

fn suggest_one_of(found: &str, mut known: Vec<&str>) -> String {
    if let Some(near) = nearest(found, known.iter().copied()) {
        return format!("did you mean `{near}`?");
    }
    match known.as_slice() {
        [] => return "there are none to choose from".to_string(),
        [only] => return format!("there is only `{only}`"),
        _ => {}
    }
    let more = known.len().saturating_sub(MOST_NAMES);
    known.truncate(MOST_NAMES);
    let tail = if more > 0 { format!(" and {more} more") } else { String::new() };
    format!("choose one of {}{tail}", known.join(", "))
}

/// The place of `name` among the known names of this sort; else [`Error::unknown`].
#[doc(hidden)]
pub fn find<'a>(what: &str, name: &str, mut known: impl Iterator<Item = &'a str> + Clone) -> Result<usize> {
    let names = known.clone();
    known.position(|known| known == name).ok_or_else(|| Error::unknown(what, name, names))
}

/// Largest number of names that a message lists.
const MOST_NAMES: usize = 12;

/// The beginning of a user's text, short enough for a message.
#[doc(hidden)]
pub fn excerpt(text: &str) -> String {
    const MOST: usize = 60;
    match text.char_indices().nth(MOST) {
        Some((end, _)) => format!("{}...", &text[..end]),
        None => text.to_string(),
    }
}

/// A number rounded to so many digits after the first.
#[doc(hidden)]
pub fn rounded(value: f64, digits: usize) -> f64 {
    format!("{value:.digits$e}").parse().unwrap_or(value)
}

/// A number with at most four significant digits, without trailing zeros: 0.5, 1.25e-7.
#[doc(hidden)]
pub fn short(value: f64) -> String {
    shown(rounded(value, 3))
}

/// A number with at most two significant digits: 0.5, 1.2e-7.
#[doc(hidden)]
pub fn two_digits(value: f64) -> String {
    shown(rounded(value, 1))
}

/// A number with this number of significant digits, without an exponent if that is short.
#[doc(hidden)]
pub fn significant(value: f64, digits: usize) -> String {
    if value == 0.0 {
        return "0".to_string();
    }
    let size = value.abs().log10().floor() as i32;
    if !(-4..digits as i32).contains(&size) {
        return format!("{value:.*e}", digits - 1);
    }
    let text = format!("{value:.*}", (digits as i32 - 1 - size).max(0) as usize);
    if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.').to_string() } else { text }
}

/// A part in per cent with three significant digits, without an exponent from 0.0001 % on: 0.123 %, 3e-5 %.
#[doc(hidden)]
pub fn percent(part: f64) -> String {
    let rounded = format!("{:.2e}", 100.0 * part).parse().unwrap_or(f64::NAN);
    match rounded {
        little if little != 0.0 && little < 1e-4 => format!("{little:.0e} %"),
        much => format!("{much} %"),
    }
}

/// A time with at most nine significant digits: 0.6 for 0.6000000000000001.
#[doc(hidden)]
pub fn clock(t: f64) -> String {
    shown(rounded(t, 8))
}

fn shown(rounded: f64) -> String {
    match rounded.abs() {
        size if size == 0.0 || (1e-3..1e6).contains(&size) => format!("{rounded}"),
        _ => format!("{rounded:e}"),
    }
}

/// Number of names that [`short_list`] writes out.
const NAMED: usize = 5;

/// The first few names, and the number of the others.
#[doc(hidden)]
pub fn short_list(names: &[String]) -> String {
    match names {
        few if few.len() <= NAMED => few.join(", "),
        many => format!("{} and {} more", many[..NAMED].join(", "), many.len() - NAMED),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parts_are_told_in_per_cent() {
        for (part, text) in [
            (0.0, "0 %"),
            (1.234e-8, "1e-6 %"),
            (1.234e-6, "0.000123 %"),
            (0.004995, "0.5 %"),
            (0.1 + 0.2, "30 %"),
            (0.9996, "100 %"),
            (123.45, "12300 %"),
            (f64::INFINITY, "inf %"),
        ] {
            assert_eq!(percent(part), text);
        }
    }

    #[test]
    fn slips_are_mended() {
        let known = ["stiffness", "damping", "spring_damper", "inertia", "initial", "t_end", "between", "mass", "x"];
        let table = [
            ("stifness", Some("stiffness")),
            ("intial", Some("initial")),
            ("inertai", Some("inertia")),
            ("tend", Some("t_end")),
            ("betwen", Some("between")),
            ("spring", Some("spring_damper")),
            ("masss", Some("mass")),
            ("dmaping", Some("damping")),
            ("X", Some("x")),
            ("y", None),
            ("alfa", None),
            ("hinge", None),
            ("zzz", None),
            ("", None),
        ];
        table.iter().for_each(|(found, meant)| assert_eq!(nearest(found, known), *meant, "{found}"));
        assert_eq!(
            (nearest("alfa", ["alpha", "beta"]), nearest("inertia", ["mass", "initial"])),
            (Some("alpha"), None)
        );
        assert_eq!(suggest("hinge", ["weld", "gear"]), "choose one of weld, gear");
    }

    #[test]
    fn numbers_are_short() {
        let table = [(0.0, "0"), (0.5, "0.5"), (1.0 / 3.0, "0.3333"), (-5.0, "-5"), (123456.7, "123500")];
        table.iter().for_each(|(value, text)| assert_eq!(short(*value), *text));
        assert_eq!((clock(0.1 + 0.2), clock(12.345_678_912_3)), ("0.3".into(), "12.3456789".into()));
        assert_eq!((short(1.2346e-7), short(1e9), short(f64::NAN)), ("1.235e-7".into(), "1e9".into(), "NaN".into()));
    }
}
