//! Maps of two parameters, and the methods that are compared on them.

use super::cell::CellQuantity;
use super::change::CellChange;
use super::parameters::{StressParameter, find, registry};
use super::subject::Subject;
use crate::error::{Error, Result, short, suggest};
use crate::sweep::Range;

/// A value on an axis, or one of the methods.
#[derive(Clone)]
pub struct AxisPlace {
    /// Text at the axis.
    pub label: String,
    /// Value; none for an entry that is not a number, such as another method.
    pub value: Option<f64>,
    /// Changes that it makes to the scene or the method.
    pub changes: Vec<CellChange>,
}

/// The parameter varied along one side of a map.
#[derive(Clone)]
pub struct MapAxis {
    /// Name of the parameter.
    pub name: String,
    /// Unit; empty for a ratio, and where it is not known.
    pub unit: String,
    /// Its values, in order.
    pub entries: Vec<AxisPlace>,
}

/// Every entry of x with every entry of y by every method.
#[derive(Clone)]
pub struct Map {
    /// Name on the command line.
    pub name: String,
    /// One line of description.
    pub about: String,
    /// First axis, the columns.
    #[doc(hidden)]
    pub x: MapAxis,
    /// Second axis, the rows.
    #[doc(hidden)]
    pub y: MapAxis,
    /// Compared methods, one panel each.
    #[doc(hidden)]
    pub methods: Vec<AxisPlace>,
    /// Quantity that figures and tables show; files contain all.
    #[doc(hidden)]
    pub quantity: CellQuantity,
}

impl AxisPlace {
    /// An entry with a value of a stress parameter.
    pub fn of(parameter: &'static StressParameter, value: f64) -> Self {
        AxisPlace {
            label: short(value),
            value: Some(value),
            changes: vec![CellChange::StressParameter(parameter, value)],
        }
    }

    /// An entry without a value.
    pub fn named(label: &str, changes: Vec<CellChange>) -> Self {
        AxisPlace { label: label.to_string(), value: None, changes }
    }
}

/// Number of values of an axis for which none are given.
const COUNT: usize = 9;

impl MapAxis {
    /// An axis of a stress parameter with given values.
    pub fn of(parameter: &'static StressParameter, values: Vec<f64>) -> Self {
        MapAxis {
            name: parameter.name.to_string(),
            unit: parameter.unit.to_string(),
            entries: values.into_iter().map(|value| AxisPlace::of(parameter, value)).collect(),
        }
    }

    /// An axis of a stress parameter with its default values for the subject.
    pub fn usual(parameter: &'static StressParameter, subject: &Subject) -> Self {
        MapAxis::of(parameter, (parameter.values)(subject))
    }

    /// Reads `EXTREME`, `EXTREME=A..B[:N][:log]` or `PARAMETER=A..B[:N][:log]`; without N nine values, those of stress
    /// parameters in geometric progression.
    ///
    /// # Errors
    /// A name that is neither a stress parameter nor a parameter of the scene, a bad range, a stress parameter that
    /// does not apply to the scene.
    pub fn parse(text: &str, subject: &Subject) -> Result<Self> {
        let name = text.split('=').next().unwrap_or_default().trim();
        let found = find(name).ok();
        let is_parameter = subject.parameters().any(|known| known == name);
        if found.is_none() && !is_parameter {
            let all = registry().iter().map(|parameter| parameter.name);
            return Err(Error::input(format!("`{name}` is neither an extreme nor a parameter of the scene"))
                .hint(suggest(name, all.chain(subject.parameters()))));
        }
        if let Some(parameter) = found.filter(|parameter| !(parameter.suits)(subject)) {
            let error = Error::input(format!("the scene has no {name}: {}", parameter.about));
            return Err(error.hint("`holonom stress --list` says which extremes there are"));
        }
        match (found, text.contains('=')) {
            (Some(parameter), false) => Ok(MapAxis::usual(parameter, subject)),
            (Some(parameter), true) => Ok(MapAxis::of(parameter, range(text, true)?.values())),
            (None, _) => Ok(MapAxis::parameter(&range(text, false)?)),
        }
    }

    fn parameter(range: &Range) -> Self {
        let name = &range.parameter;
        let entry = |value: f64| AxisPlace {
            label: short(value),
            value: Some(value),
            changes: vec![CellChange::Parameter(name.clone(), value)],
        };
        MapAxis { name: name.clone(), unit: String::new(), entries: range.values().into_iter().map(entry).collect() }
    }

    /// Returns name and unit.
    pub fn label(&self) -> String {
        let name = self.name.replace('_', " ");
        if self.unit.is_empty() { name } else { format!("{name} ({})", self.unit) }
    }

    /// Returns the values in order, if all entries have one.
    pub fn values(&self) -> Option<Vec<f64>> {
        self.entries.iter().map(|entry| entry.value).collect()
    }
}

/// Reads a range like `sweep`, with fewer values by default.
fn range(text: &str, is_log: bool) -> Result<Range> {
    let range: Range = text.parse()?;
    if text.split(':').nth(1).is_some_and(|part| part.trim() != "log") {
        return Ok(range);
    }
    let range = Range { count: COUNT, ..range };
    if is_log && range.from > 0.0 && range.to > 0.0 { range.log() } else { Ok(range) }
}

impl AxisPlace {
    fn keeps_motion(&self) -> bool {
        self.changes.iter().all(CellChange::keeps_motion)
    }

    /// Returns the distance of an entry from the middle of its list, 0, to its ends, 1; an entry without a value counts
    /// as in the middle.
    fn eccentricity(entries: &[AxisPlace], at: usize) -> f64 {
        let ends = entries.len().saturating_sub(1).max(1) as f64;
        entries[at].value.map_or(0.0, |_| (2.0 * at as f64 / ends - 1.0).abs())
    }
}

impl Map {
    /// Returns the changes of the cell of a method, row and column, in this order: method, x, y.
    pub(super) fn changes(&self, cell: [usize; 3]) -> impl Iterator<Item = &CellChange> {
        let [panel, row, column] = cell;
        let entries = [&self.methods[panel], &self.x.entries[column], &self.y.entries[row]];
        entries.into_iter().flat_map(|entry| &entry.changes)
    }

    /// Returns the indices of the entries that change the motion; cells where these are equal have the same motion.
    pub(super) fn motion(&self, cell: [usize; 3]) -> [Option<usize>; 3] {
        let [panel, row, column] = cell;
        let moved = |entries: &[AxisPlace], i: usize| (!entries[i].keeps_motion()).then_some(i);
        [moved(&self.methods, panel), moved(&self.y.entries, row), moved(&self.x.entries, column)]
    }

    /// Returns the distance of a cell from the middle of the map, where parameters are closest to those of the scene.
    pub(super) fn eccentricity(&self, cell: [usize; 3]) -> f64 {
        let [_, row, column] = cell;
        AxisPlace::eccentricity(&self.x.entries, column).hypot(AxisPlace::eccentricity(&self.y.entries, row))
    }

    /// Returns the method, row and column of a cell by its number.
    pub(super) fn place(&self, index: usize) -> [usize; 3] {
        let columns = self.x.entries.len();
        let rows = self.y.entries.len();
        [index / (rows * columns), index / columns % rows, index % columns]
    }

    /// Returns the numbers of the neighbouring cells with the same method.
    pub(super) fn beside(&self, cell: [usize; 3]) -> impl Iterator<Item = usize> {
        let [panel, row, column] = cell;
        let columns = self.x.entries.len();
        let rows = self.y.entries.len();
        let beside = |at: usize, count: usize| [at.checked_sub(1), Some(at + 1).filter(|at| *at < count)];
        let lines = beside(row, rows).into_iter().flatten().map(move |row| (row, column));
        let along = beside(column, columns).into_iter().flatten().map(move |column| (row, column));
        lines.chain(along).map(move |(row, column)| (panel * rows + row) * columns + column)
    }

    /// Number of cells.
    pub fn cell_count(&self) -> usize {
        self.x.entries.len() * self.y.entries.len() * self.methods.len()
    }
}
