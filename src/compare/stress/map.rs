//! Two stress parameters at a time, and the methods that are compared on them.

use super::cell::Quantity;
use super::change::Change;
use super::parameters::{StressParameter, find, registry};
use super::subject::Subject;
use crate::error::{Error, Result, short, suggest};
use crate::sweep::Range;

/// A place on an axis, or one of the methods.
#[derive(Clone)]
pub struct AxisPlace {
    pub label: String,
    /// None for a place between, above or below the numbers of its axis, such as another method.
    pub value: Option<f64>,
    pub changes: Vec<Change>,
}

/// What is varied along one side of a map.
#[derive(Clone)]
pub struct Axis {
    pub name: String,
    /// Empty for a ratio, and where it is not known.
    pub unit: String,
    pub entries: Vec<AxisPlace>,
}

/// Every entry of x with every entry of y by every method.
#[derive(Clone)]
pub struct Map {
    pub name: String,
    pub about: String,
    pub x: Axis,
    pub y: Axis,
    pub methods: Vec<AxisPlace>,
    /// What is shown of the cells; all else is in the files.
    pub quantity: Quantity,
}

impl AxisPlace {
    /// A value of a stress parameter.
    pub fn of(parameter: &'static StressParameter, value: f64) -> Self {
        AxisPlace { label: short(value), value: Some(value), changes: vec![Change::StressParameter(parameter, value)] }
    }

    pub fn named(label: &str, changes: Vec<Change>) -> Self {
        AxisPlace { label: label.to_string(), value: None, changes }
    }
}

/// Values of an axis for which none are given.
const COUNT: usize = 9;

impl Axis {
    pub fn of(parameter: &'static StressParameter, values: Vec<f64>) -> Self {
        Axis {
            name: parameter.name.to_string(),
            unit: parameter.unit.to_string(),
            entries: values.into_iter().map(|value| AxisPlace::of(parameter, value)).collect(),
        }
    }

    /// The stress parameter with the values that suit the subject.
    pub fn usual(parameter: &'static StressParameter, subject: &Subject) -> Self {
        Axis::of(parameter, (parameter.values)(subject))
    }

    /// `EXTREME`, `EXTREME=A..B[:N][:log]` or `PARAMETER=A..B[:N][:log]`; without N nine values, of stress parameters with a constant
    /// factor.
    ///
    /// # Errors
    /// A name that is neither a stress parameter nor one of the scene, a bad range, a stress parameter that the scene does not have.
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
            (Some(parameter), false) => Ok(Axis::usual(parameter, subject)),
            (Some(parameter), true) => Ok(Axis::of(parameter, range(text, true)?.values())),
            (None, _) => Ok(Axis::parameter(&range(text, false)?)),
        }
    }

    fn parameter(range: &Range) -> Self {
        let name = &range.parameter;
        let entry = |value: f64| AxisPlace {
            label: short(value),
            value: Some(value),
            changes: vec![Change::Parameter(name.clone(), value)],
        };
        Axis { name: name.clone(), unit: String::new(), entries: range.values().into_iter().map(entry).collect() }
    }

    /// Name and unit.
    pub fn label(&self) -> String {
        let name = self.name.replace('_', " ");
        if self.unit.is_empty() { name } else { format!("{name} ({})", self.unit) }
    }

    /// The values in order, where all entries have one.
    pub fn values(&self) -> Option<Vec<f64>> {
        self.entries.iter().map(|entry| entry.value).collect()
    }

    /// Whether each value is about the same factor of the one before.
    pub fn is_log(&self) -> bool {
        let values = self.values().unwrap_or_default();
        let is_positive = values.iter().all(|value| *value > 0.0);
        is_positive
            && values
                .first()
                .zip(values.last())
                .is_some_and(|(first, last)| last / first >= 30.0 || first / last >= 30.0)
    }
}

/// A range as `sweep` reads it, with fewer values where none are said.
fn range(text: &str, is_log: bool) -> Result<Range> {
    let mut parts = text.split(':');
    let has_count = parts.nth(1).is_some_and(|part| part.trim() != "log");
    if has_count {
        return text.parse();
    }
    let ends = text.split(':').next().unwrap_or_default();
    let asks_log = text.ends_with(":log");
    let range: Range = format!("{ends}:{COUNT}").parse()?;
    if asks_log || is_log && range.from > 0.0 && range.to > 0.0 { range.log() } else { Ok(range) }
}

impl AxisPlace {
    fn keeps_motion(&self) -> bool {
        self.changes.iter().all(Change::keeps_motion)
    }

    /// Of a list, the part of the way from its middle, 0, to its ends, 1; what stands beside the numbers is in the middle.
    fn eccentricity(entries: &[AxisPlace], at: usize) -> f64 {
        let ends = entries.len().saturating_sub(1).max(1) as f64;
        entries[at].value.map_or(0.0, |_| (2.0 * at as f64 / ends - 1.0).abs())
    }
}

impl Map {
    /// What the cell of a method, row and column changes, in this order: method, x, y.
    pub(super) fn changes(&self, [panel, row, column]: [usize; 3]) -> impl Iterator<Item = &Change> {
        let entries = [&self.methods[panel], &self.x.entries[column], &self.y.entries[row]];
        entries.into_iter().flat_map(|entry| &entry.changes)
    }

    /// Tells the motions of cells apart, by the places that have a say in them.
    pub(super) fn motion(&self, [panel, row, column]: [usize; 3]) -> [Option<usize>; 3] {
        let entries = [(&self.methods, panel), (&self.y.entries, row), (&self.x.entries, column)];
        entries.map(|(entries, at)| (!entries[at].keeps_motion()).then_some(at))
    }

    /// How far a cell is from the middle of the map, where scenes are most themselves.
    pub(super) fn eccentricity(&self, [_, row, column]: [usize; 3]) -> f64 {
        AxisPlace::eccentricity(&self.x.entries, column).hypot(AxisPlace::eccentricity(&self.y.entries, row))
    }

    /// The method, row and column of a cell by its number.
    pub(super) fn place(&self, index: usize) -> [usize; 3] {
        let (columns, rows) = (self.x.entries.len(), self.y.entries.len());
        [index / (rows * columns), index / columns % rows, index % columns]
    }

    /// The numbers of the cells beside one, by the same method.
    pub(super) fn beside(&self, [panel, row, column]: [usize; 3]) -> impl Iterator<Item = usize> {
        let (columns, rows) = (self.x.entries.len(), self.y.entries.len());
        let beside = |at: usize, count: usize| [at.checked_sub(1), Some(at + 1).filter(|at| *at < count)];
        let lines = beside(row, rows).into_iter().flatten().map(move |row| (row, column));
        let along = beside(column, columns).into_iter().flatten().map(move |column| (row, column));
        lines.chain(along).map(move |(row, column)| (panel * rows + row) * columns + column)
    }

    pub fn len(&self) -> usize {
        self.x.entries.len() * self.y.entries.len() * self.methods.len()
    }

    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }
}
