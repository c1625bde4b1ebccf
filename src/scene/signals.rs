//! Signals of a scene: measured data from a table, or points written in it.

use super::format::{SceneFile, SignalSpec};
use crate::error::{Error, Result, excerpt, suggest};
use crate::math::expression::{Number, Parameters};
use crate::math::signal::{PointsError, Signal};
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
    let Points { points, places, field } = match (&spec.file, &spec.points) {
        (Some(file), None) => table(folder, file, spec.columns.as_ref()).map_err(|error| error.under("file"))?,
        (None, Some(_)) if spec.columns.is_some() => {
            return Err(Error::input("columns are those of a file").under("columns").hint("remove them"));
        }
        (None, Some(points)) => given(points, parameters)?,
        _ => {
            return Err(Error::input("expected either a file or points")
                .hint("give \"file\": \"road.csv\", or \"points\": [[x, y], ...]"));
        }
    };
    let signal = Signal::new(&spec.name, &points, spec.interpolation, spec.beyond);
    signal.map_err(|problem| fault(problem, &points, &places, field))
}

/// Points with the place of each, such as `road.csv, line 7`.
struct Points {
    points: Vec<[f64; 2]>,
    places: Vec<String>,
    field: &'static str,
}

fn fault(problem: PointsError, points: &[[f64; 2]], places: &[String], field: &str) -> Error {
    match problem {
        PointsError::TooFew => {
            Error::input(format!("a signal takes at least 2 points, found {}", points.len())).under(field)
        }
        PointsError::NotIncreasing(i) => {
            let (now, before) = (points[i][0], points[i - 1][0]);
            Error::input(format!("{}: x must increase, found {now} after {before}", places[i]))
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

fn given(points: &[[Number; 2]], parameters: &Parameters) -> Result<Points> {
    let place = |i: usize| format!("points[{i}]");
    let value = |(i, point): (usize, &[Number; 2])| {
        let number = |k: usize| {
            let value = point[k].evaluate(parameters);
            value.map_err(|error| Error::from(error).under(format!("[{k}]")).under(place(i)))
        };
        Ok([number(0)?, number(1)?])
    };
    let values = points.iter().enumerate().map(value).collect::<Result<_>>()?;
    Ok(Points { points: values, places: (0..points.len()).map(place).collect(), field: "points" })
}

/// Two columns of a table with headings: CSV with commas, semicolons or tabs.
fn table(folder: &Path, file: &str, columns: Option<&[String; 2]>) -> Result<Points> {
    let path = folder.join(file);
    let text = crate::files::read_text(&path).map_err(|problem| {
        let problem = super::explain(&path, &problem);
        Error::input(format!("{file}: {problem}")).hint("the file is looked for beside the scene")
    })?;
    let text = text.strip_prefix('\u{feff}').unwrap_or(&text);
    let header = text.lines().find(|line| !line.trim().is_empty()).unwrap_or_default();
    let delimiter = [b'\t', b';'].into_iter().find(|mark| header.as_bytes().contains(mark)).unwrap_or(b',');
    let mut reader =
        csv::ReaderBuilder::new().delimiter(delimiter).flexible(true).trim(csv::Trim::All).from_reader(text.as_bytes());
    let broken = |error: csv::Error| Error::input(format!("{file}: this is no table: {error}"));
    let headings: Vec<String> = reader.headers().map_err(broken)?.iter().map(str::to_string).collect();
    let chosen = choose(file, &headings, columns)?;
    let (mut points, mut places) = (Vec::new(), Vec::new());
    for record in reader.records() {
        let record = record.map_err(broken)?;
        let place = format!("{file}, line {}", record.position().map_or(0, |at| line(text, at)));
        if record.iter().skip(headings.len()).any(|cell| !cell.is_empty()) {
            let message = format!("{place}: {} values under {} names", record.len(), headings.len());
            return Err(Error::input(message).hint("decimals are written with a point; or name all columns"));
        }
        let number = |k: usize| {
            let cell = record.get(chosen[k]).unwrap_or_default();
            cell.parse::<f64>().ok().filter(|value| value.is_finite()).ok_or_else(|| {
                let found = if cell.is_empty() { "nothing".to_string() } else { format!("`{}`", excerpt(cell)) };
                Error::input(format!(
                    "{place}: expected a number in the column `{}`, found {found}",
                    headings[chosen[k]]
                ))
                .hint("decimals are written with a point: 0.5")
            })
        };
        points.push([number(0)?, number(1)?]);
        places.push(place);
    }
    Ok(Points { points, places, field: "file" })
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
            .hint("separate them by commas, semicolons or tabs, with names in the first line"));
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
