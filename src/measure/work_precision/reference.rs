//! What accuracy is measured against.

use super::grid::Triple;
use super::runner::Motion;
use super::sample::sample;
use super::yardstick::{Watched, Yardstick};
use crate::choice::Choice;
use crate::error::{Error, Failure, Result, suggest};
use crate::formulation;
use crate::integrator;
use crate::simulate::{Method, Span};
use rayon::prelude::*;
use serde::{Deserialize, Serialize};
use std::path::Path;
use std::time::{Duration, Instant};

/// Values to compare with, and how far they can be believed.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Reference {
    /// The method or the file.
    pub from: String,
    /// What it was compared with.
    pub checked_by: String,
    /// Whether that is another method than the reference's own at a looser tolerance.
    pub is_independent: bool,
    /// The largest relative difference between the two: no run can be told to be better.
    pub error: f64,
    /// The quantity that has it.
    pub worst: String,
    pub pace: Pace,
    pub values: Yardstick,
}

/// The steps with which methods of high order would err by as much as the motion moves, s: of those whose steps stability
/// limits, and of the others.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Pace {
    pub explicit: f64,
    pub implicit: f64,
}

/// Values from a file: columns by name, one of them `t`.
#[derive(Clone, Debug)]
pub struct Given {
    pub name: String,
    headings: Vec<String>,
    rows: Vec<Vec<f64>>,
}

/// From loose to tight: what comes through in time counts, and the looser ones tell the pace.
const LADDER: [f64; 4] = [1e-8, 1e-10, 1e-12, 1e-13];
/// An explicit and an implicit method, one in minimal coordinates, and a half-explicit one in the place of those that fail.
const FAMILIES: [[&str; 3]; 3] =
    [["index1", "dop853", "exact"], ["ggl", "radau_iia", "none"], ["null_space", "dopri5", "none"]];
const OTHER: [&str; 3] = ["index2", "phem56", "manifold"];

impl Reference {
    /// The motion at the tightest tolerance that comes through in the time allowed, and its error by a second method;
    /// against values of a file where they are `given`.
    ///
    /// # Errors
    /// A run error where no method comes through; a file that lacks a quantity or the times.
    pub fn find(
        motion: &Motion,
        watched: &Watched,
        (span, given): (Span, Option<&Given>),
        allowed: Duration,
    ) -> Result<Reference> {
        let climb = |family| climb(motion, watched, span, family, allowed);
        let mut lines: Vec<Line> = FAMILIES.into_par_iter().map(climb).collect::<Result<_>>()?;
        let pace = pace(&lines, span);
        lines.retain(|line| !line.is_empty());
        if lines.len() < 2 {
            lines.extend(Some(climb(OTHER)?).filter(|line| !line.is_empty()));
        }
        // The tightest first; of those as tight the one that is named first.
        lines.sort_by(|a, b| tightest(a).total_cmp(&tightest(b)));
        let Some((own, rest)) = lines.first().and_then(|line| line.split_last()) else {
            return Err(nothing(span).into());
        };
        let (values, from) = match given {
            Some(given) => (Yardstick::new(&watched.columns, given.rows_at(watched, span)?), given.name.clone()),
            None => (Yardstick::new(&watched.columns, own.rows.clone()), own.name()),
        };
        // Of others the one that agrees best: two methods do not come by chance to the same wrong digits.
        let others: Vec<&Rung> = match given {
            Some(_) => vec![own],
            None => lines[1..].iter().filter_map(|line| line.last()).collect(),
        };
        let is_independent = !others.is_empty();
        let candidates = if is_independent { others } else { rest.last().into_iter().collect() };
        let checked = candidates.into_iter().map(|rung| (values.error(&rung.rows), rung.name()));
        let nearest = checked.min_by(|a, b| a.0.0.total_cmp(&b.0.0));
        let ((error, worst), checked_by) = nearest.unwrap_or(((1.0, ""), "nothing".to_string()));
        let worst = worst.to_string();
        Ok(Reference { from, checked_by, is_independent, error, worst, pace, values })
    }

    /// Digits that it can vouch for.
    pub fn digits(&self) -> f64 {
        super::cell::digits(self.error)
    }
}

/// Runs of one method that came through, from loose to tight.
type Line = Vec<Rung>;

/// A run that came through.
struct Rung {
    method: Method,
    rows: Vec<Vec<f64>>,
    steps: u64,
}

impl Rung {
    fn name(&self) -> String {
        format!("{}, rtol {:e}", self.method.triple(), self.method.rtol)
    }

    /// The mean step, made longer by what the tolerance made it shorter.
    fn pace(&self, span: Span) -> f64 {
        let order = integrator::find(&self.method.integrator).map_or(5, |entry| entry.order.max(5));
        (span.end - span.start) / self.steps.max(1) as f64 * self.method.rtol.powf(-1.0 / order as f64)
    }
}

/// By the loosest runs of the first two families; where one of them has none, by the other.
fn pace(lines: &[Line], span: Span) -> Pace {
    let of = |line: usize| lines.get(line).and_then(|line| line.first()).map(|rung| rung.pace(span));
    let any = of(0).or(of(1)).or(of(2)).unwrap_or(1e-3 * (span.end - span.start));
    Pace { explicit: of(0).unwrap_or(any), implicit: of(1).unwrap_or(any) }
}

fn tightest(line: &[Rung]) -> f64 {
    line.last().map_or(f64::INFINITY, |rung| rung.method.rtol)
}

fn climb(motion: &Motion, watched: &Watched, span: Span, names: [&str; 3], allowed: Duration) -> Result<Line> {
    let clock = Instant::now();
    let [own, integrator, projection] = names.map(Choice::named);
    let triple = Triple { formulation: own, integrator, projection };
    let mut line = Vec::new();
    // Minimal coordinates of large systems do not fit into memory.
    if formulation::make(&triple.formulation, motion.system).is_err() {
        return Ok(line);
    }
    for rtol in LADDER {
        let left = allowed.saturating_sub(clock.elapsed());
        let method = triple.at((rtol, rtol * motion.ratio), None);
        let run = sample(motion, watched, &method, span, left)?;
        if run.failure.is_some() {
            break;
        }
        line.push(Rung { method, rows: run.rows, steps: run.statistics.steps });
    }
    Ok(line)
}

fn nothing(span: Span) -> Failure {
    Failure {
        t: span.start,
        reason: "no method brings the motion to its end in the time allowed, so that there is nothing to compare with"
            .to_string(),
        hint: "give more time by --budget, a shorter motion by --until, or values by --reference FILE".to_string(),
    }
}

impl Given {
    /// Reads a table with headings, as `trajectory.csv` is one: `t` and quantities by name.
    ///
    /// # Errors
    /// A file that cannot be read or is no such table.
    pub fn read(path: &Path) -> Result<Given> {
        let text = crate::files::read_text(path).map_err(|error| Error::file(path, error))?;
        Given::parse(&path.display().to_string(), &text).map_err(|error| error.in_file(path))
    }

    /// The same from text.
    ///
    /// # Errors
    /// Text that is no table with a column `t`.
    pub fn parse(name: &str, text: &str) -> Result<Given> {
        let wrong = |what: String| {
            Error::input(what).hint("give a table of comma-separated values with headings, as trajectory.csv is one: t, then quantities by name")
        };
        let mut reader = csv::ReaderBuilder::new().trim(csv::Trim::All).from_reader(text.as_bytes());
        let headings = reader.headers().map_err(|error| wrong(format!("this is no table: {error}")))?;
        let headings: Vec<String> = headings.iter().map(str::to_string).collect();
        if headings.iter().all(|heading| heading != "t") {
            return Err(wrong("there is no column `t`".to_string()));
        }
        let mut rows = Vec::new();
        for (line, record) in reader.records().enumerate() {
            let record = record.map_err(|error| wrong(format!("this is no table: {error}")))?;
            let number = |cell: &str| match cell.parse::<f64>() {
                Ok(value) if value.is_finite() => Ok(value),
                _ => Err(wrong(format!("row {} has `{cell}`, which is no number", line + 1))),
            };
            rows.push(record.iter().map(number).collect::<Result<Vec<f64>>>()?);
        }
        Ok(Given { name: name.to_string(), headings, rows })
    }

    /// The quantities it has.
    pub fn names(&self) -> impl Iterator<Item = &str> {
        self.headings.iter().map(String::as_str).filter(|heading| *heading != "t")
    }

    /// So many equal parts of the time, at most `most`, that the file has a row at the end of each of them.
    ///
    /// # Errors
    /// A file without a row at the end.
    pub fn parts(&self, (start, end): (f64, f64), most: usize) -> Result<usize> {
        let has = |parts: usize| {
            (1..=parts).all(|k| self.row(start + (end - start) * k as f64 / parts as f64, end - start).is_some())
        };
        (1..=most).rev().find(|parts| has(*parts)).ok_or_else(|| {
            Error::input(format!("`{}` has no values at the end, t = {end} s", self.name))
                .under("--reference")
                .hint("give a file with a row at the end time, or --until a time that it has")
        })
    }

    fn row(&self, t: f64, duration: f64) -> Option<&[f64]> {
        let time = self.headings.iter().position(|heading| heading == "t")?;
        let row = self.rows.iter().find(|row| (row[time] - t).abs() <= 1e-9 * duration)?;
        Some(row)
    }

    /// The quantities watched at the times of `span` after its start.
    fn rows_at(&self, watched: &Watched, span: Span) -> Result<Vec<Vec<f64>>> {
        let place = |name: &String| {
            self.headings.iter().position(|heading| heading == name).ok_or_else(|| {
                let known = self.headings.iter().map(String::as_str);
                Error::input(format!("`{}` has no column `{name}`", self.name))
                    .under("--reference")
                    .hint(format!("{}; or name the quantities to compare by --outputs", suggest(name, known)))
            })
        };
        let names = watched.columns.iter().map(|column| &column.name);
        let places: Vec<usize> = names.map(place).collect::<Result<_>>()?;
        let parts = ((span.end - span.start) / span.output_step).round() as usize;
        let duration = span.end - span.start;
        let at = |k: usize| self.row(span.start + duration * k as f64 / parts as f64, duration);
        let values = |row: &[f64]| places.iter().map(|place| row[*place]).collect();
        Ok((1..=parts).filter_map(at).map(values).collect())
    }
}
