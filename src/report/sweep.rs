//! `sweep.json`, and the text on a sweep.

use super::Table;
use super::figures::MOST_COORDINATES;
use super::table::named;
use crate::error::significant;
use crate::sweep::{self, Nearest, Point, Sweep};
use crate::tolerances::report as tolerances;
use serde::Serialize;
use serde_json::{Map, Value};

/// Summary of a sweep.
#[derive(Clone, Debug, Serialize)]
pub struct SweepSummary {
    /// Name of the scene.
    pub scene: String,
    /// Name of the parameter.
    pub parameter: String,
    /// Range of the parameter.
    pub range: Ends,
    /// Number of values.
    pub count: usize,
    /// Number of values that were reached.
    pub reached: usize,
    /// `completed` or `failed`.
    pub status: &'static str,
    /// The first value that was not reached.
    pub failure: Option<Unreached>,
    /// The scene's own value of the parameter.
    pub own_value: f64,
    /// Ends of the branch within the range.
    pub limits: Vec<LimitSummary>,
    /// State nearest to a singular one.
    pub nearest_singular: Nearest,
    /// Outputs at the ends, and their extremes.
    pub outputs: Vec<Extremes>,
}

#[derive(Clone, Copy, Debug, Serialize)]
pub struct Ends {
    pub from: f64,
    pub to: f64,
}

/// The first value that was not reached.
#[derive(Clone, Debug, Serialize)]
pub struct Unreached {
    pub value: f64,
    pub reason: String,
    pub hint: String,
}

/// An end of the branch.
#[derive(Clone, Debug, Serialize)]
pub struct LimitSummary {
    pub value: f64,
    pub within: f64,
    pub unreached: f64,
    pub reason: String,
    pub rank_indicator: f64,
    pub outputs: Map<String, Value>,
}

/// An output at the ends of its curve (the ends of the branch, where those lie in the range) and at the scene's own
/// value, and its least and largest value.
#[derive(Clone, Debug, Serialize)]
pub struct Extremes {
    pub name: String,
    pub unit: String,
    pub first: Place,
    pub own: Option<Place>,
    pub last: Place,
    pub min: Place,
    pub max: Place,
}

/// A value of an output with that of the parameter.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Place {
    pub at: f64,
    pub value: f64,
}

/// Returns name and unit of what is shown: the outputs, or the first coordinates where the scene names none.
pub(super) fn watched(sweep: &Sweep) -> Vec<(&str, &str)> {
    match sweep.outputs.as_slice() {
        [] => sweep.names.q.iter().take(MOST_COORDINATES).map(|name| (name.as_str(), "m, rad")).collect(),
        outputs => outputs.iter().map(|output| (output.name.as_str(), output.unit.as_str())).collect(),
    }
}

/// Returns the values of these at a state.
pub(super) fn shown<'a>(sweep: &Sweep, point: &'a Point) -> &'a [f64] {
    if sweep.outputs.is_empty() { &point.q } else { &point.outputs }
}

impl SweepSummary {
    /// The summary of a sweep.
    pub fn new(sweep: &Sweep) -> Self {
        let range = &sweep.range;
        SweepSummary {
            scene: sweep.scene.clone(),
            parameter: range.parameter.clone(),
            range: Ends { from: range.from, to: range.to },
            count: range.count,
            reached: sweep.points.len(),
            status: if sweep.limits.is_empty() { "completed" } else { "failed" },
            failure: sweep.limits.first().map(|limit| Unreached {
                value: limit.unreached,
                reason: limit.reason.clone(),
                hint: hint(sweep),
            }),
            own_value: sweep.own_value,
            limits: sweep.limits.iter().map(|limit| limit_summary(sweep, limit)).collect(),
            nearest_singular: sweep.nearest_singular,
            outputs: extremes(sweep),
        }
    }

    /// Returns the summary as text.
    pub fn text(&self) -> String {
        let Ends { from, to } = self.range;
        let mut text = format!(
            "{}: {} of {} values of {} from {from} to {to}; the scene's own is {}\n",
            self.scene, self.reached, self.count, self.parameter, self.own_value
        );
        for line in self.ends() {
            text += &format!("  ENDS {line}\n");
        }
        text + &self.singular_line() + "\n" + &self.table()
    }

    fn singular_line(&self) -> String {
        let Nearest { value, rank_indicator } = self.nearest_singular;
        let place = format!("{} = {}", self.parameter, significant(value, 8));
        if rank_indicator < tolerances::TOLD_SINGULAR {
            format!("  SINGULAR at {place}: distance {rank_indicator:.1e}\n")
        } else {
            format!("  nearest to a singular state at {place}: distance {rank_indicator:.1e} (1 is far)\n")
        }
    }

    /// Returns the ends of the branch with the reasons.
    pub fn ends(&self) -> Vec<String> {
        let end = |limit: &LimitSummary| {
            format!(
                "at {} = {}; {} is out of reach: {}",
                self.parameter,
                significant(limit.value, 8),
                limit.unreached,
                limit.reason
            )
        };
        self.limits.iter().map(end).collect()
    }

    fn table(&self) -> String {
        let Some(first) = self.outputs.first() else { return String::new() };
        let headings = first.places().map(|place| {
            if self.limits.iter().any(|limit| limit.value == place.at) {
                format!("end, {}", significant(place.at, 6))
            } else {
                format!("at {}", significant(place.at, 6))
            }
        });
        let own = [self.parameter.clone(), String::new()];
        let headings: Vec<String> = own.into_iter().chain(headings).chain(["min", "max"].map(str::to_string)).collect();
        let mut table = Table::new(&headings.iter().map(String::as_str).collect::<Vec<_>>());
        for output in &self.outputs {
            let Extremes { name, unit, min, max, .. } = output;
            let size = min.value.abs().max(max.value.abs());
            let cells = output.places().chain([min, max]).map(|place| reading(place.value, unit, size));
            table.row([name.clone(), unit.clone()].into_iter().chain(cells));
        }
        table.to_string()
    }
}

impl Extremes {
    /// Returns the ends and the scene's own value between them.
    fn places(&self) -> impl Iterator<Item = &Place> {
        let own = self.own.iter().filter(|own| own.at != self.first.at && own.at != self.last.at);
        [&self.first].into_iter().chain(own).chain([&self.last])
    }
}

/// Returns a value of a curve of this size, with degrees in parentheses for radians; round-off is zero.
fn reading(value: f64, unit: &str, size: f64) -> String {
    let size = if unit == "rad" { size.max(1.0) } else { size };
    let value = if value.abs() < 1e-12 * size { 0.0 } else { value };
    let number = significant(value, 5);
    if unit == "rad" { format!("{number} ({}°)", significant(value.to_degrees(), 4)) } else { number }
}

fn hint(sweep: &Sweep) -> String {
    let [first, last] = [sweep.curve().first(), sweep.curve().last()]
        .map(|point| point.map_or(String::new(), |point| significant(point.value, 6)));
    format!("the mechanism moves from {first} to {last}: sweep within, or change the lengths that limit it")
}

fn limit_summary(sweep: &Sweep, limit: &sweep::Limit) -> LimitSummary {
    LimitSummary {
        value: limit.point.value,
        within: limit.within,
        unreached: limit.unreached,
        reason: limit.reason.clone(),
        rank_indicator: limit.point.rank_indicator,
        outputs: named(sweep.outputs.iter().map(|output| &output.name), &limit.point.outputs),
    }
}

fn extremes(sweep: &Sweep) -> Vec<Extremes> {
    let curve = sweep.curve();
    let of = |(i, (name, unit)): (usize, (&str, &str))| {
        let place = |point: &&Point| Place { at: point.value, value: shown(sweep, point)[i] };
        let ends = [curve.first(), curve.last()].map(|point| point.map(place));
        // Forces and speeds may grow without bounds towards an end of the branch.
        let values = || sweep.points.iter().chain(&sweep.own).map(|point| place(&point));
        Some(Extremes {
            name: name.to_string(),
            unit: unit.to_string(),
            first: ends[0]?,
            own: sweep.own.as_ref().map(|own| place(&own)),
            last: ends[1]?,
            min: values().min_by(|a, b| a.value.total_cmp(&b.value))?,
            max: values().max_by(|a, b| a.value.total_cmp(&b.value))?,
        })
    };
    watched(sweep).into_iter().enumerate().filter_map(of).collect()
}
