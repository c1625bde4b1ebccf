//! Signals of a scene: measured data from a table, or points written in it.

use super::format::{SceneFile, SignalSpec};
use super::units::dimension_of;
use crate::error::{Error, Result, excerpt, suggest};
use crate::math::expression::{Number, Parameters};
use crate::math::signal::{PointsError, Signal};
use std::borrow::Cow;
use std::path::Path;

/// Adds the signals to the parameters, so that all expressions may call them. Those before are known in the points.
pub fn add(file: &SceneFile, folder: &Path, parameters: &mut Parameters) -> Result<()> {
    for (i, spec) in file.signals.iter().enumerate() {
        let signal = read(spec, file, folder, parameters);
        let added = signal.and_then(|signal| parameters.add_signal(signal).map_err(|error| under_name(error.into())));
        added.map_err(|error| error.under(format!("signals[{i}]")))?;
    }
    Ok(())
}

fn under_name(error: Error) -> Error {
    error.under("name")
}

fn read(spec: &SignalSpec, file: &SceneFile, folder: &Path, parameters: &Parameters) -> Result<Signal> {
    super::names::check_name(&spec.name).map_err(under_name)?;
    let outputs = file.outputs.iter().map(|output| (&output.name, "an output"));
    let mut others = outputs.chain(file.states.iter().map(|state| (&state.name, "a state")));
    if let Some((name, what)) = others.find(|(name, _)| **name == spec.name) {
        let error = Error::input(format!("`{name}` cannot name a signal: it is the name of {what}"));
        return Err(under_name(error.hint("rename one of them")));
    }
    let (points, lines) = match (&spec.file, &spec.points) {
        (Some(file), None) => {
            let table = table(folder, file, spec.columns.as_ref()).map_err(|error| error.under("file"))?;
            (table.points, Some((file, table.lines)))
        }
        (None, Some(_)) if spec.columns.is_some() => {
            return Err(Error::input("columns are those of a file").under("columns").hint("remove them"));
        }
        (None, Some(points)) => (given(points, parameters)?, None),
        _ => {
            return Err(Error::input("expected either a file or points")
                .hint("give \"file\": \"road.csv\", or \"points\": [[x, y], ...]"));
        }
    };
    let signal = Signal::new(&spec.name, &points, spec.interpolation, spec.beyond);
    let place = |i: usize| match &lines {
        Some((file, lines)) => format!("{file}, line {}", lines[i]),
        None => format!("points[{i}]"),
    };
    signal.map_err(|problem| fault(problem, &points, place, if lines.is_some() { "file" } else { "points" }))
}

/// The error of points that are no signal; `place` tells where one is written, such as `road.csv, line 7`.
fn fault(problem: PointsError, points: &[[f64; 2]], place: impl Fn(usize) -> String, field: &str) -> Error {
    match problem {
        PointsError::TooFew => {
            Error::input(format!("a signal takes at least 2 points, found {}", points.len())).under(field)
        }
        PointsError::NotIncreasing(i) => {
            let now = points[i][0];
            let before = points[i - 1][0];
            Error::input(format!("{}: x must increase, found {now} after {before}", place(i)))
                .under(field)
                .hint("give each x once, in order")
        }
        PointsError::NotFinite => Error::input("numbers or slopes are too large").under(field),
        PointsError::EndsDiffer => {
            let [first, last] = [points[0][1], points[points.len() - 1][1]];
            Error::input(format!("a cubic signal that repeats ends as it begins, found {first} and {last}"))
                .under("beyond")
                .hint("make the last y the first one, or use \"interpolation\": \"linear\"")
        }
    }
}

fn given(points: &[[Number; 2]], parameters: &Parameters) -> Result<Vec<[f64; 2]>> {
    let value = |(i, point): (usize, &[Number; 2])| {
        let number = |k: usize| {
            let value = point[k].evaluate(parameters);
            value.map_err(|error| Error::from(error).under(format!("points[{i}][{k}]")))
        };
        Ok([number(0)?, number(1)?])
    };
    points.iter().enumerate().map(value).collect()
}

/// Two columns of a table.
struct SignalTable {
    points: Vec<[f64; 2]>,
    /// Line of each point.
    lines: Vec<u64>,
}

/// Two columns of a table with headings: CSV with commas, semicolons, tabs or blanks. Lines that begin with # are
/// comments; a first line without numbers has the units.
fn table(folder: &Path, file: &str, columns: Option<&[String; 2]>) -> Result<SignalTable> {
    let path = folder.join(file);
    let text = crate::files::read_text(&path).map_err(|problem| {
        let problem = super::explain(&path, &problem);
        Error::input(format!("{file}: {problem}")).hint("the file is looked for beside the scene")
    })?;
    let text = text.strip_prefix('\u{feff}').unwrap_or(&text);
    let is_data = |line: &&str| !line.trim().is_empty() && !line.trim_start().starts_with('#');
    let header = text.lines().find(is_data).unwrap_or_default();
    let delimiter = [b'\t', b';', b','].into_iter().find(|mark| header.as_bytes().contains(mark));
    let text = if delimiter.is_none() { Cow::Owned(with_commas(text)) } else { Cow::Borrowed(text) };
    let mut reader = csv::ReaderBuilder::new()
        .delimiter(delimiter.unwrap_or(b','))
        .comment(Some(b'#'))
        .flexible(true)
        .trim(csv::Trim::All)
        .from_reader(text.as_bytes());
    let broken = |error: csv::Error| Error::input(format!("{file}: this is no table: {error}"));
    let headings: Vec<String> = reader.headers().map_err(broken)?.iter().map(str::to_string).collect();
    let chosen = choose(file, &headings, columns)?;
    let mut table = SignalTable { points: Vec::new(), lines: Vec::new() };
    let mut record = csv::StringRecord::new();
    while reader.read_record(&mut record).map_err(broken)? {
        let line = record.position().map_or(0, |at| line(&text, at));
        let row = TableRow { file, line, headings: &headings, record: &record };
        if table.points.is_empty() && row.has_units() {
            row.check_units(chosen)?;
            continue;
        }
        table.points.push(row.values(chosen)?);
        table.lines.push(line);
    }
    Ok(table)
}

/// The text with a comma in the place of blanks within its lines.
fn with_commas(text: &str) -> String {
    let joined = |line: &str| line.split_whitespace().collect::<Vec<_>>().join(",");
    text.lines()
        .map(|line| if line.trim_start().starts_with('#') { line.to_string() } else { joined(line) } + "\n")
        .collect()
}

/// A line of a table.
struct TableRow<'a> {
    file: &'a str,
    line: u64,
    headings: &'a [String],
    record: &'a csv::StringRecord,
}

impl TableRow<'_> {
    /// True if it has a word in every column.
    fn has_units(&self) -> bool {
        self.record.iter().all(|cell| !cell.is_empty() && cell.parse::<f64>().is_err())
    }

    /// Refuses units other than those of the SI: the values of a signal are taken as they are.
    fn check_units(&self, chosen: [usize; 2]) -> Result<()> {
        for column in chosen {
            let cell = self.record.get(column).unwrap_or_default();
            let name = cell.trim_matches(['[', ']', '(', ')']);
            let unit = dimension_of(name).and_then(|dimension| dimension.unit(name).ok());
            if unit.is_some_and(|unit| unit.per_si != 1.0) {
                let message = format!("{}: the column `{}` is in {name}", self.place(), self.headings[column]);
                return Err(Error::input(message).hint("the values of a signal are in units of the SI: convert them"));
            }
        }
        Ok(())
    }

    fn values(&self, chosen: [usize; 2]) -> Result<[f64; 2]> {
        let TableRow { headings, record, .. } = self;
        if record.iter().skip(headings.len()).any(|cell| !cell.is_empty()) {
            let message = format!("{}: {} values under {} names", self.place(), record.len(), headings.len());
            return Err(Error::input(message).hint("decimals are written with a point; or name all columns"));
        }
        Ok([self.number(chosen[0])?, self.number(chosen[1])?])
    }

    fn number(&self, column: usize) -> Result<f64> {
        let cell = self.record.get(column).unwrap_or_default();
        let value = cell.parse::<f64>();
        if let Some(value) = value.as_ref().ok().filter(|value| value.is_finite()) {
            return Ok(*value);
        }
        let found = if cell.is_empty() { "nothing".to_string() } else { format!("`{}`", excerpt(cell)) };
        let name = &self.headings[column];
        let is_gap = cell.is_empty() || value.is_ok_and(f64::is_nan);
        let hint = if is_gap {
            "remove the line, or fill the gap: between two lines a signal is interpolated"
        } else {
            "decimals are written with a point: 0.5"
        };
        let place = self.place();
        Err(Error::input(format!("{place}: expected a number in the column `{name}`, found {found}")).hint(hint))
    }

    fn place(&self) -> String {
        format!("{}, line {}", self.file, self.line)
    }
}

/// Line of a record, whose position is before the empty lines that it follows.
fn line(text: &str, at: &csv::Position) -> u64 {
    let rest = text.as_bytes().iter().skip(at.byte() as usize);
    let empty = rest.take_while(|c| matches!(c, b'\r' | b'\n')).filter(|c| **c == b'\n');
    at.line() + empty.count() as u64
}

/// Indices of the two columns by name, or those of the first two.
fn choose(file: &str, headings: &[String], columns: Option<&[String; 2]>) -> Result<[usize; 2]> {
    if headings.len() < 2 {
        return Err(Error::input(format!("{file}: expected two columns or more, found {}", headings.len()))
            .hint("separate them by commas, semicolons, tabs or blanks, with names in the first line"));
    }
    if headings.iter().all(|heading| heading.parse::<f64>().is_ok()) {
        return Err(Error::input(format!("{file}: the first line has numbers in the place of names"))
            .hint("name the columns in the first line, such as `s,z`"));
    }
    let Some(columns) = columns else { return Ok([0, 1]) };
    let index = |name: &String| {
        headings.iter().position(|heading| heading == name).ok_or_else(|| {
            Error::input(format!("{file}: there is no column `{}`", excerpt(name)))
                .hint(suggest(name, headings.iter().map(String::as_str)))
        })
    };
    Ok([index(&columns[0])?, index(&columns[1])?])
}
