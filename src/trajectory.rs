//! The computed motion: named columns over time.

use crate::simulate::Observation;
use crate::system::{Column, MechanicalSystem, Names, OperatingPoint, Scratch};

/// Rows of t, q, v, lambda and outputs, as they will be written to a file.
#[derive(Clone, Debug)]
pub struct Trajectory {
    /// Names of q, v and lambda; none where rows have outputs only.
    pub names: Names,
    /// Names and units of the outputs.
    pub outputs: Vec<Column>,
    /// One row per output time: t, q, v, lambda, outputs.
    pub rows: Vec<Vec<f64>>,
}

/// An output that is undefined at some rows.
#[derive(Clone, Debug, PartialEq)]
pub struct Gap {
    /// Name of the output.
    pub name: String,
    /// Time of the first row without a value, s.
    pub first: f64,
    /// Number of rows without a value.
    pub count: usize,
}

/// Names and units of what a run watches: the outputs, then the works.
pub fn recorded(system: &dyn MechanicalSystem) -> Vec<Column> {
    [system.facts().outputs.clone(), system.facts().works.clone()].concat()
}

/// The values of the `count` columns of [`recorded`] at a state with its works; without these they are zero.
pub fn values(
    system: &dyn MechanicalSystem,
    state: OperatingPoint,
    works: &[f64],
    count: usize,
    scratch: &mut Scratch,
) -> Vec<f64> {
    let mut all = vec![0.0; count];
    let (outputs, last) = all.split_at_mut(count - works.len());
    system.outputs(state, outputs, scratch);
    last.copy_from_slice(works);
    all
}

/// Reads a state with the inputs and on the pieces of the run: of a law that jumps there, the run is still on the side it came from.
pub fn on_pieces<R>(state: &Observation, scratch: &mut Scratch, read: impl FnOnce(&mut Scratch) -> R) -> R {
    scratch.pieces.extend_from_slice(state.pieces);
    scratch.inputs.extend_from_slice(state.inputs);
    let found = read(scratch);
    scratch.pieces.clear();
    scratch.inputs.clear();
    found
}

impl Trajectory {
    /// No rows, with the columns of a system.
    pub fn new(system: &dyn MechanicalSystem) -> Self {
        Trajectory { names: system.facts().names.clone(), outputs: recorded(system), rows: Vec::new() }
    }

    /// No rows, with time, the first `coordinates` and the outputs as the only columns.
    pub fn of_outputs(system: &dyn MechanicalSystem, coordinates: usize) -> Self {
        Trajectory::new(system).part(coordinates)
    }

    /// No rows, with time, the first `coordinates` and the outputs of this one as the only columns.
    pub(crate) fn part(&self, coordinates: usize) -> Self {
        let q = self.names.q.iter().take(coordinates).cloned().collect();
        let names = Names { q, v: Vec::new(), lambda: Vec::new() };
        Trajectory { names, outputs: self.outputs.clone(), rows: Vec::new() }
    }

    /// Headings of all columns: `t`, coordinates, velocities, multipliers, outputs.
    pub fn headings(&self) -> Vec<&str> {
        let Names { q, v, lambda } = &self.names;
        let own = ["t"].into_iter().chain(q.iter().chain(v).chain(lambda).map(String::as_str));
        own.chain(self.outputs.iter().map(|output| output.name.as_str())).collect()
    }

    /// Returns the row of a state with its outputs.
    pub fn row(&self, system: &dyn MechanicalSystem, state: &Observation, scratch: &mut Scratch) -> Vec<f64> {
        let Names { q, v, lambda } = &self.names;
        let first = 1 + q.len() + v.len() + lambda.len();
        let mut row = Vec::with_capacity(first + self.outputs.len());
        row.push(state.t);
        row.extend_from_slice(&state.q[..q.len()]);
        row.extend_from_slice(&state.v[..v.len()]);
        row.extend_from_slice(&state.lambda[..lambda.len()]);
        row.resize(first + self.outputs.len() - state.works.len(), 0.0);
        on_pieces(state, scratch, |scratch| system.outputs(state.loaded(), &mut row[first..], scratch));
        row.extend_from_slice(state.works);
        row
    }

    /// Appends the last row of a trajectory that has more columns.
    pub fn push_part(&mut self, full: &Trajectory) {
        let (Some(row), Names { q, v, lambda }) = (full.rows.last(), &self.names) else { return };
        let (all_q, all_v, all_lambda) = full.row_state(row);
        let own = [&all_q[..q.len()], &all_v[..v.len()], &all_lambda[..lambda.len()]];
        self.rows.push([&row[..1], own[0], own[1], own[2], full.row_outputs(row)].concat());
    }

    /// Times of the rows, s.
    pub fn times(&self) -> impl ExactSizeIterator<Item = f64> + '_ {
        self.rows.iter().map(|row| row[0])
    }

    /// A column by its heading.
    pub fn column(&self, heading: &str) -> Option<Vec<f64>> {
        let index = self.headings().iter().position(|known| *known == heading)?;
        Some(self.rows.iter().map(|row| row[index]).collect())
    }

    /// What is compared of each row: the outputs, or the coordinates where there are none.
    pub fn watched(&self) -> impl Iterator<Item = Vec<f64>> + '_ {
        let of = |row| if self.outputs.is_empty() { self.row_state(row).0 } else { self.row_outputs(row) };
        self.rows.iter().map(move |row| of(row).to_vec())
    }

    /// Names and units of the outputs.
    pub fn named_outputs(&self) -> impl Iterator<Item = (&str, &str)> {
        self.outputs.iter().map(|column| (column.name.as_str(), column.unit.as_str()))
    }

    /// The outputs of a row.
    pub fn row_outputs<'a>(&self, row: &'a [f64]) -> &'a [f64] {
        &row[row.len() - self.outputs.len()..]
    }

    /// q, v and lambda of a row.
    pub fn row_state<'a>(&self, row: &'a [f64]) -> (&'a [f64], &'a [f64], &'a [f64]) {
        let nq = self.names.q.len();
        let nv = self.names.v.len();
        let nc = self.names.lambda.len();
        let (q, rest) = row[1..].split_at(nq);
        let (v, rest) = rest.split_at(nv);
        (q, v, &rest[..nc])
    }
}
