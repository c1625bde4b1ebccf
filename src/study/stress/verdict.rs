//! Summary of the cells of a map.

use super::cell::{Cell, Status};
use super::map::MapAxis;
use super::run::Stressed;
use crate::math::bounds;
use serde::Serialize;

/// Summary of one method on a map.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct MethodVerdict {
    /// Name of the method.
    pub method: String,
    /// Number of cells.
    pub cells: usize,
    /// Number of completed cells.
    pub completed: usize,
    /// Number of these within the tolerance: see [`Cell`]. Of some it is not known.
    pub held: usize,
    /// Number of these outside the tolerance.
    pub off: usize,
    /// Number of cells that did not complete, by status.
    pub others: Vec<(Status, usize)>,
    /// Least and largest of the map's quantity in completed cells.
    pub range: Option<[f64; 2]>,
    /// Least and largest error of completed cells.
    pub errors: Option<[f64; 2]>,
    /// Sides of the axes on which all unsuccessful cells lie.
    pub bounds: Vec<Bound>,
    /// Reasons of unsuccessful cells, each with the number of cells and the first of them.
    pub reasons: Vec<Reason>,
}

/// All unsuccessful cells lie on this side of an axis.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Bound {
    /// Name of the axis.
    pub axis: String,
    /// Side of the value.
    pub side: AxisSide,
    /// Value that bounds them, which belongs to the side.
    pub value: f64,
}

/// Side of a value on an axis.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum AxisSide {
    /// The value and larger ones.
    From,
    /// The value and smaller ones.
    UpTo,
}

/// A reason of unsuccessful cells.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Reason {
    /// How they ended.
    pub status: Status,
    /// The reason, as the first cell gives it.
    pub reason: String,
    /// Number of cells.
    pub count: usize,
    /// Label of the first cell on the x axis.
    pub x: String,
    /// Label of the first cell on the y axis.
    pub y: String,
}

impl Stressed {
    /// Returns the summary of each method.
    #[doc(hidden)]
    pub fn verdicts(&self) -> Vec<MethodVerdict> {
        (0..self.map.methods.len()).map(|method| self.verdict(method)).collect()
    }

    fn verdict(&self, method: usize) -> MethodVerdict {
        let cells: Vec<&Cell> = self.cells.iter().filter(|cell| cell.panel == method).collect();
        let count = |status: Status| cells.iter().filter(|cell| cell.status == status).count();
        let statuses = [Status::Diverged, Status::Failed, Status::Refused, Status::TooSlow, Status::LeftOut];
        let completed = || cells.iter().filter(|cell| cell.status == Status::Completed);
        let judged = |holds: bool| completed().filter(|cell| cell.holds == Some(holds)).count();
        let bounds = [bound(&self.map.x, &cells, |cell| cell.column), bound(&self.map.y, &cells, |cell| cell.row)];
        MethodVerdict {
            method: self.map.methods[method].label.clone(),
            cells: cells.len(),
            completed: count(Status::Completed),
            held: judged(true),
            off: judged(false),
            others: statuses.into_iter().map(|status| (status, count(status))).filter(|(_, n)| *n > 0).collect(),
            range: range(cells.iter().filter_map(|cell| self.map.quantity.of(cell))),
            errors: range(completed().filter_map(|cell| cell.error)),
            bounds: bounds.into_iter().flatten().collect(),
            reasons: self.reasons(&cells),
        }
    }

    /// Counts reasons that differ by numbers only as one.
    fn reasons(&self, cells: &[&Cell]) -> Vec<Reason> {
        let kind =
            |reason: &str| reason.chars().filter(|c| !c.is_ascii_digit() && !"+-.e".contains(*c)).collect::<String>();
        let mut found: Vec<Reason> = Vec::new();
        for cell in cells {
            let Some(reason) = cell.reason.as_ref().filter(|_| cell.status != Status::LeftOut) else { continue };
            match found.iter_mut().find(|known| known.status == cell.status && kind(&known.reason) == kind(reason)) {
                Some(known) => known.count += 1,
                None => found.push(Reason {
                    status: cell.status,
                    reason: reason.clone(),
                    count: 1,
                    x: self.map.x.entries[cell.column].label.clone(),
                    y: self.map.y.entries[cell.row].label.clone(),
                }),
            }
        }
        found.sort_by_key(|reason| std::cmp::Reverse(reason.count));
        found
    }
}

/// Returns the least and the largest value.
fn range(values: impl Iterator<Item = f64>) -> Option<[f64; 2]> {
    let (low, high) = bounds(values);
    (low <= high).then_some([low, high])
}

/// Returns the side of an axis on which all unsuccessful cells lie, if there is one and it is not all of the axis.
fn bound(axis: &MapAxis, cells: &[&Cell], place: impl Fn(&Cell) -> usize) -> Option<Bound> {
    let values = axis.values()?;
    let is_bad = |at: usize| {
        let ended = |cell: &&&Cell| matches!(cell.status, Status::Diverged | Status::Failed | Status::Refused);
        cells.iter().filter(|cell| place(cell) == at).any(|cell| ended(&cell))
    };
    let bad: Vec<usize> = (0..values.len()).filter(|at| is_bad(*at)).collect();
    let first = *bad.first()?;
    let last = *bad.last()?;
    let is_one_piece = last - first + 1 == bad.len();
    let (side, at) = match (first, last + 1 == values.len()) {
        (0, true) => return None,
        (_, true) => (AxisSide::From, first),
        (0, false) => (AxisSide::UpTo, last),
        _ => return None,
    };
    is_one_piece.then(|| Bound { axis: axis.name.clone(), side, value: values[at] })
}
