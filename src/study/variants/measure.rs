//! Quantities that a study records of each variant: `max(travel)`, `at(x, 0.5)`, `cost`.

use crate::error::{Error, Result, find};
use crate::math::expression::Number;
use crate::system::Column;

/// A quantity of a run, one number.
#[derive(Clone, Debug, PartialEq)]
pub struct Measure {
    /// Its text, which is its name in tables.
    pub text: String,
    /// Its unit; empty where it is not known.
    pub unit: String,
    /// Its meaning.
    pub(super) what: What,
}

/// The meaning of a measure.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum What {
    /// A number of the course of an expression over time.
    OfCourse(Reduction, String),
    /// The largest error bar of the output at this index.
    Error(usize),
    /// The largest |phi| relative to the scene's size.
    Drift,
    /// The largest error of the energy balance.
    EnergyError,
    /// Work, in evaluations of the equations of motion.
    Cost,
    /// Accepted steps.
    Steps,
}

/// A number made of the course of a quantity over the output rows.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Reduction {
    Final,
    Max,
    Min,
    Mean,
    Rms,
    TimeOfMax,
    TimeOfMin,
    /// Time at which it first reaches a level.
    TimeOf(Number),
    /// Time during which it is above a level.
    Above(Number),
    /// Its value at a time.
    At(Number),
}

/// Quantities that need no course.
const OF_RUN: [(&str, &str, What); 4] = [
    ("drift", "", What::Drift),
    ("energy_error", "J", What::EnergyError),
    ("cost", "evaluations", What::Cost),
    ("steps", "", What::Steps),
];

const HINT: &str = "an output or expression, or one of max, min, mean, rms, final of it, time_of(max(x)), time_of(x, level), \
     above(x, level), at(x, time), error(output), drift, energy_error, cost, steps";

impl Measure {
    /// Reads a list with commas between the measures.
    ///
    /// # Errors
    /// A call with the wrong number of arguments; `error` of no output.
    pub fn parse_list(text: &str, outputs: &[Column]) -> Result<Vec<Measure>> {
        split(text).into_iter().map(|text| Measure::parse(text.trim(), outputs)).collect()
    }

    /// The final value of an output.
    pub fn last_of(output: &Column) -> Measure {
        let what = What::OfCourse(Reduction::Final, output.name.clone());
        Measure { text: output.name.clone(), unit: output.unit.clone(), what }
    }

    fn parse(text: &str, outputs: &[Column]) -> Result<Measure> {
        if text.is_empty() {
            return Err(Error::input("there is nothing to record between two commas").hint(HINT));
        }
        let is_output = |text: &str| outputs.iter().any(|output| output.name == text);
        if let Some((_, unit, what)) = OF_RUN.iter().find(|(name, ..)| *name == text && !is_output(text)) {
            return Ok(Measure { text: text.to_string(), unit: unit.to_string(), what: what.clone() });
        }
        if let Some((name, arguments)) = call(text).filter(|_| !is_output(text))
            && name == "error"
        {
            let [output] = arguments[..] else { return Err(wrong_count(text, "one output")) };
            let place = find("output", output, outputs.iter().map(|output| output.name.as_str()))?;
            return Ok(Measure { text: text.to_string(), unit: outputs[place].unit.clone(), what: What::Error(place) });
        }
        let (reduction, of) = if is_output(text) { (Reduction::Final, text) } else { reduction(text)? };
        let own = || outputs.iter().find(|output| output.name == of).map_or("", |output| output.unit.as_str());
        let unit = if reduction.is_time() { "s" } else { own() };
        let what = What::OfCourse(reduction, of.to_string());
        Ok(Measure { text: text.to_string(), unit: unit.to_string(), what })
    }

    /// True if all output rows are needed, and not the last one alone.
    pub(super) fn needs_rows(&self) -> bool {
        matches!(&self.what, What::OfCourse(reduction, _) if *reduction != Reduction::Final) || self.needs_error()
    }

    /// True if a second run is needed.
    pub(super) fn needs_error(&self) -> bool {
        matches!(self.what, What::Error(_))
    }
}

impl Reduction {
    fn is_time(&self) -> bool {
        use Reduction::*;
        matches!(self, TimeOfMax | TimeOfMin | TimeOf(_) | Above(_))
    }

    /// Returns the level or the time that it names.
    pub fn argument(&self) -> Option<&Number> {
        match self {
            Reduction::TimeOf(number) | Reduction::Above(number) | Reduction::At(number) => Some(number),
            _ => None,
        }
    }
}

/// Returns the reduction that a text asks for, and the expression that it reduces: without one the final value.
fn reduction(text: &str) -> Result<(Reduction, &str)> {
    use Reduction::*;
    let Some((name, arguments)) = call(text) else { return Ok((Final, text)) };
    let number = |text: &str| text.parse().map_or_else(|_| Number::from(text), Number::Value);
    Ok(match (name, &arguments[..]) {
        ("max", [of]) => (Max, of),
        ("min", [of]) => (Min, of),
        ("mean", [of]) => (Mean, of),
        ("rms", [of]) => (Rms, of),
        ("final", [of]) => (Final, of),
        ("time_of", [extreme]) => match call(extreme).as_ref().map(|(name, of)| (*name, &of[..])) {
            Some(("max", [of])) => (TimeOfMax, of),
            Some(("min", [of])) => (TimeOfMin, of),
            _ => return Err(wrong_count(text, "max(x), min(x), or a quantity and a level")),
        },
        ("time_of", [of, level]) => (TimeOf(number(level)), of),
        ("above", [of, level]) => (Above(number(level)), of),
        ("at", [of, time]) => (At(number(time)), of),
        ("mean" | "rms" | "final", _) => return Err(wrong_count(text, "one quantity")),
        ("time_of" | "above", _) => return Err(wrong_count(text, "a quantity and a level")),
        ("at", _) => return Err(wrong_count(text, "a quantity and a time")),
        _ => (Final, text),
    })
}

fn wrong_count(text: &str, takes: &str) -> Error {
    let name = text.split('(').next().unwrap_or_default();
    Error::input(format!("`{text}`: `{name}` takes {takes}")).hint(format!("give {HINT}"))
}

/// Returns name and arguments of a text that is one call.
fn call(text: &str) -> Option<(&str, Vec<&str>)> {
    let (name, rest) = text.split_once('(')?;
    let inner = rest.strip_suffix(')')?;
    let is_name = !name.is_empty() && name.trim_end().chars().all(|c| c.is_ascii_alphanumeric() || c == '_');
    // The bracket behind the name must close at the end: `max(a) - min(b)` is no call.
    let mut depth = 0i32;
    let closes_early = inner.chars().any(|c| {
        depth += i32::from(c == '(') - i32::from(c == ')');
        depth < 0
    });
    (is_name && !closes_early).then(|| (name.trim_end(), split(inner).into_iter().map(str::trim).collect()))
}

/// Splits a text at the commas that stand in no brackets.
fn split(text: &str) -> Vec<&str> {
    let mut depth = 0i32;
    let mut parts = Vec::new();
    let mut start = 0;
    for (at, c) in text.char_indices() {
        match c {
            '(' | '[' => depth += 1,
            ')' | ']' => depth -= 1,
            ',' if depth == 0 => {
                parts.push(&text[start..at]);
                start = at + 1;
            }
            _ => {}
        }
    }
    parts.push(&text[start..]);
    parts
}
