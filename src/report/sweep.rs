//! `kinematics.json`, and the text on a sweep.

use super::sweep_figure::{SweepLook, sweep_figure};
use super::table::named;
use super::tables::{shown, sweep_table, watched};
use super::{Answer, Folder, TextTable};
use crate::error::{Result, significant};
use crate::sweep::{BranchLimit, Nearest, Point, Range, Sweep};
use crate::tolerances;
use serde::Serialize;
use serde_json::{Value, json};

pub struct SweepAnswer<'a> {
    pub sweep: &'a Sweep,
    pub look: SweepLook<'a>,
}

/// An output at the ends of its curve (the ends of the branch, where those lie in the range) and at the scene's own
/// value, and its least and largest value.
#[derive(Serialize)]
struct Extremes {
    name: String,
    unit: String,
    first: ValueAt,
    own: Option<ValueAt>,
    last: ValueAt,
    min: ValueAt,
    max: ValueAt,
}

/// A value of an output with that of the parameter.
#[derive(Clone, Copy, Serialize)]
struct ValueAt {
    at: f64,
    value: f64,
}

impl Answer for SweepAnswer<'_> {
    fn json(&self) -> impl Serialize {
        let Sweep { scene, range, points, limits, own_value, nearest_singular, .. } = self.sweep;
        let limit = |limit: &BranchLimit| {
            json!({
                "value": limit.point.value,
                "within": limit.within,
                "unreached": limit.unreached,
                "reason": limit.reason,
                "rank_indicator": limit.point.rank_indicator,
                "outputs": named(self.sweep.outputs.iter().map(|output| &output.name), &limit.point.outputs),
            })
        };
        let failure =
            |limit: &BranchLimit| json!({ "value": limit.unreached, "reason": limit.reason, "hint": self.hint() });
        json!({
            "scene": scene,
            "parameter": range.parameter,
            "range": { "from": range.from, "to": range.to },
            "count": range.count,
            "reached": points.len(),
            "status": if limits.is_empty() { "completed" } else { "failed" },
            "failure": limits.first().map(failure),
            "own_value": own_value,
            "limits": limits.iter().map(limit).collect::<Vec<Value>>(),
            "nearest_singular": nearest_singular,
            "outputs": extremes(self.sweep),
        })
    }

    fn text(&self) -> String {
        let Sweep { scene, range: Range { parameter, from, to, count, .. }, points, own_value, .. } = self.sweep;
        let reached = points.len();
        let mut text = format!(
            "{scene}: {reached} of {count} values of {parameter} from {from} to {to}; the scene's own is {own_value}\n"
        );
        for line in self.ends() {
            text += &format!("  ENDS {line}\n");
        }
        text + &self.singular_line() + "\n" + &self.table()
    }

    fn write(&self, folder: &mut Folder, stem: &str) -> Result<()> {
        folder.table(stem, &sweep_table(self.sweep)?)?;
        folder.figure(stem, sweep_figure(self.sweep, self.look))
    }
}

impl SweepAnswer<'_> {
    /// Returns the failure: the ends of the branch with the reasons, and the remedy. None of a whole sweep.
    pub fn failure(&self) -> Option<String> {
        let ends = self.ends().join("\n       ");
        (!ends.is_empty()).then(|| format!("the branch ends {ends}\n  help: {}", self.hint()))
    }

    fn singular_line(&self) -> String {
        let Nearest { value, rank_indicator } = self.sweep.nearest_singular;
        let place = format!("{} = {}", self.sweep.range.parameter, significant(value, 8));
        if rank_indicator < tolerances::UNSEEN {
            format!("  SINGULAR at {place}: distance {rank_indicator:.1e}\n")
        } else {
            format!("  nearest to a singular state at {place}: distance {rank_indicator:.1e} (1 is far)\n")
        }
    }

    fn ends(&self) -> Vec<String> {
        let end = |BranchLimit { point, unreached, reason, .. }: &BranchLimit| {
            let parameter = &self.sweep.range.parameter;
            format!("at {parameter} = {}; {unreached} is out of reach: {reason}", significant(point.value, 8))
        };
        self.sweep.limits.iter().map(end).collect()
    }

    fn hint(&self) -> String {
        let curve = self.sweep.curve();
        let place = |point: Option<&&Point>| point.map_or(String::new(), |point| significant(point.value, 6));
        let first = place(curve.first());
        let last = place(curve.last());
        format!("the mechanism moves from {first} to {last}: stay within, or change the lengths that limit it")
    }

    fn table(&self) -> String {
        let outputs = extremes(self.sweep);
        let Some(first) = outputs.first() else { return String::new() };
        let headings = first.places().map(|place| {
            if self.sweep.limits.iter().any(|limit| limit.point.value == place.at) {
                format!("end, {}", significant(place.at, 6))
            } else {
                format!("at {}", significant(place.at, 6))
            }
        });
        let own = [self.sweep.range.parameter.clone(), String::new()];
        let headings: Vec<String> = own.into_iter().chain(headings).chain(["min", "max"].map(str::to_string)).collect();
        let mut table = TextTable::new(&headings.iter().map(String::as_str).collect::<Vec<_>>());
        for output in &outputs {
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
    fn places(&self) -> impl Iterator<Item = &ValueAt> {
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

fn extremes(sweep: &Sweep) -> Vec<Extremes> {
    let curve = sweep.curve();
    let of = |(i, (name, unit)): (usize, (&str, &str))| {
        let place = |point: &&Point| ValueAt { at: point.value, value: shown(sweep, point)[i] };
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
