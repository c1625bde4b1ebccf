//! What can go wrong, told so that a person can mend it.

use std::fmt;
use std::path::PathBuf;

pub type Result<T, E = Error> = std::result::Result<T, E>;

/// An error of the library. [`Error::exit_code`] is what the command line ends with.
#[derive(Debug, Clone, PartialEq)]
pub enum Error {
    /// The input cannot be meant as it stands.
    Input(Input),
    /// A file could not be read or written.
    File { path: PathBuf, problem: String },
    /// The computation could not go on; what was computed until then is kept.
    Run(Failure),
}

/// Bad input: where, what was found, what would be right.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Input {
    /// JSON path such as `joints[2].between[1]`, or an option such as `--at`; empty for the whole file.
    pub path: String,
    /// Name of the element that is concerned.
    pub element: Option<String>,
    pub message: String,
    /// What to do about it.
    pub hint: Option<String>,
    /// Line and column in the file, from one.
    pub place: Option<(usize, usize)>,
    pub file: Option<PathBuf>,
}

/// Why and where a run ended early.
#[derive(Debug, Clone, PartialEq, serde::Serialize)]
pub struct Failure {
    /// Time of the last good state, s.
    pub t: f64,
    pub reason: String,
    pub hint: String,
}

impl Error {
    /// Bad input at the whole of what is being read; [`under`](Self::under) adds the path from outside.
    pub fn input(message: impl Into<String>) -> Self {
        Error::Input(Input { message: message.into(), ..Input::default() })
    }

    pub fn file(path: impl Into<PathBuf>, problem: impl ToString) -> Self {
        Error::File { path: path.into(), problem: problem.to_string() }
    }

    /// What would be right.
    pub fn hint(mut self, hint: impl Into<String>) -> Self {
        if let Error::Input(input) = &mut self {
            input.hint.get_or_insert(hint.into());
        }
        self
    }

    /// Adds the name of the element, unless one closer to the fault is known.
    pub fn element(mut self, name: impl Into<String>) -> Self {
        if let Error::Input(input) = &mut self {
            input.element.get_or_insert(name.into());
        }
        self
    }

    /// Puts `segment` in front of the path: `under("joints[2]")` makes `between` into `joints[2].between`.
    pub fn under(mut self, segment: impl AsRef<str>) -> Self {
        if let Error::Input(input) = &mut self {
            let joined = match input.path.chars().next() {
                None => segment.as_ref().to_string(),
                Some('[') => format!("{}{}", segment.as_ref(), input.path),
                Some(_) => format!("{}.{}", segment.as_ref(), input.path),
            };
            input.path = joined;
        }
        self
    }

    pub fn exit_code(&self) -> u8 {
        if matches!(self, Error::Run(_)) { 1 } else { 2 }
    }
}

impl fmt::Display for Error {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Error::Input(input) => input.fmt(out),
            Error::File { path, problem } => write!(out, "{}: {problem}", path.display()),
            Error::Run(failure) => {
                write!(out, "stopped at t = {:.6e} s: {}\n  help: {}", failure.t, failure.reason, failure.hint)
            }
        }
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
        match (self.path.as_str(), &self.element) {
            ("", None) => {}
            ("", Some(element)) => write!(out, "`{element}`: ")?,
            (path, None) => write!(out, "at {path}: ")?,
            (path, Some(element)) => write!(out, "at {path} (`{element}`): ")?,
        }
        write!(out, "{}", self.message)?;
        self.hint.iter().try_for_each(|hint| write!(out, "\n  help: {hint}"))
    }
}

impl std::error::Error for Error {}

impl From<Failure> for Error {
    fn from(failure: Failure) -> Self {
        Error::Run(failure)
    }
}

/// "did you mean" for a name that is not in the list, or the list itself when nothing is near.
pub fn suggest<'a>(found: &str, known: impl IntoIterator<Item = &'a str>) -> String {
    let mut known: Vec<&str> = known.into_iter().collect();
    let near = known.iter().max_by(|a, b| {
        strsim::jaro_winkler(found, a).total_cmp(&strsim::jaro_winkler(found, b)).then_with(|| b.cmp(a))
    });
    match near {
        None => "there are none to choose from".to_string(),
        Some(best) if strsim::jaro_winkler(found, best) > 0.75 => format!("did you mean `{best}`?"),
        Some(_) => {
            let more = known.len().saturating_sub(12);
            known.truncate(12);
            let tail = if more > 0 { format!(", and {more} more") } else { String::new() };
            format!("known are: {}{tail}", known.join(", "))
        }
    }
}
