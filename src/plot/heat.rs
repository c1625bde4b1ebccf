//! Maps of coloured cells.

use super::axis::{Axis, Extent};
use super::item::Tint;
use super::panel::Scale;
use super::shape::Rect;

/// Cells coloured by a value, each around one x and one y.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct HeatMap {
    /// Title of the colour bar, with the unit.
    pub label: String,
    /// Centres of the columns, ascending.
    pub x: Vec<f64>,
    /// Centres of the rows, ascending.
    pub y: Vec<f64>,
    /// Rows of cells; a cell without a value is grey.
    pub values: Vec<Vec<Option<f64>>>,
    /// (column, row, colour): colours of cells without a value that are not grey.
    pub fills: Vec<(usize, usize, Tint)>,
    /// (column, row, text): short texts on cells, like "fail", in a size that fits.
    pub words: Vec<(usize, usize, String)>,
    /// Scale of the colour.
    pub scale: Scale,
    /// Fixed limits of the colours, shared by several maps; values beyond have the colour of the limit.
    pub range: Option<(f64, f64)>,
}

impl HeatMap {
    /// A map without values at these positions.
    pub fn new(label: impl Into<String>, x: Vec<f64>, y: Vec<f64>) -> Self {
        let values = vec![vec![None; x.len()]; y.len()];
        Self { label: label.into(), x, y, values, ..Self::default() }
    }

    /// Sets a logarithmic colour scale.
    pub fn log(mut self) -> Self {
        self.scale = Scale::Log;
        self
    }

    /// Sets fixed limits of the colours.
    pub fn range(mut self, low: f64, high: f64) -> Self {
        self.range = Some((low, high));
        self
    }

    /// Sets the value of a cell; cells outside the map are ignored.
    pub fn set(&mut self, column: usize, row: usize, value: f64) {
        if let Some(cell) = self.values.get_mut(row).and_then(|cells| cells.get_mut(column)) {
            *cell = Some(value);
        }
    }

    /// Sets the colour of a cell without a value.
    pub fn fill(&mut self, column: usize, row: usize, tint: Tint) {
        self.fills.push((column, row, tint));
    }

    /// Writes a text on a cell.
    pub fn mark(&mut self, column: usize, row: usize, word: impl Into<String>) {
        self.words.push((column, row, word.into()));
    }

    /// Returns the value of a cell, if it is a finite number.
    pub(super) fn value(&self, column: usize, row: usize) -> Option<f64> {
        self.values.get(row)?.get(column)?.filter(|value| value.is_finite())
    }

    /// Returns the colour of a cell without a value; none if it is grey.
    pub(super) fn tint(&self, column: usize, row: usize) -> Option<Tint> {
        self.fills.iter().find(|fill| (fill.0, fill.1) == (column, row)).map(|fill| fill.2)
    }

    /// Adds the outer borders of the cells to the extents.
    pub(super) fn extend(&self, x: &mut Extent, y: &mut Extent, scales: (Scale, Scale)) {
        edges(&self.x, scales.0).into_iter().for_each(|edge| x.add(edge));
        edges(&self.y, scales.1).into_iter().for_each(|edge| y.add(edge));
    }

    /// Returns the cells to draw: column, row and rectangle between the axes (0 to 1, y up).
    pub(super) fn cells(&self, x: &Axis, y: &Axis) -> Vec<(usize, usize, Rect)> {
        let columns = bands(&self.x, x);
        let rows = bands(&self.y, y);
        let cell = |row: (usize, f64, f64), column: (usize, f64, f64)| {
            (column.0, row.0, Rect { left: column.1, right: column.2, top: row.1, bottom: row.2 })
        };
        rows.iter().flat_map(|row| columns.iter().map(|column| cell(*row, *column))).collect()
    }
}

/// Returns (index, begin, end) along an axis, clipped to it.
fn bands(middles: &[f64], axis: &Axis) -> Vec<(usize, f64, f64)> {
    let places: Vec<Option<f64>> = edges(middles, axis.scale).into_iter().map(|edge| axis.place(edge)).collect();
    let band = |(index, pair): (usize, &[Option<f64>])| {
        let (begin, end) = (pair[0]?, pair[1]?);
        let (begin, end) = (begin.min(end).max(0.0), begin.max(end).min(1.0));
        (end > begin).then_some((index, begin, end))
    };
    places.windows(2).enumerate().filter_map(band).collect()
}

/// Returns the borders halfway between the centres on the scale; one more than there are centres.
fn edges(middles: &[f64], scale: Scale) -> Vec<f64> {
    let by_ratio = scale == Scale::Log && middles.iter().all(|middle| *middle > 0.0);
    let to = |value: f64| if by_ratio { value.log10() } else { value };
    let from = |place: f64| if by_ratio { 10f64.powf(place) } else { place };
    let at: Vec<f64> = middles.iter().map(|middle| to(*middle)).collect();
    let (Some(first), Some(last)) = (at.first(), at.last()) else {
        return Vec::new();
    };
    let begin = at.get(1).map_or(0.5, |next| 0.5 * next - 0.5 * first);
    let end = at.iter().nth_back(1).map_or(0.5, |previous| 0.5 * last - 0.5 * previous);
    let inner = at.windows(2).map(|pair| 0.5 * pair[0] + 0.5 * pair[1]);
    std::iter::once(first - begin).chain(inner).chain([last + end]).map(from).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn borders_are_halfway_on_the_scale() {
        assert_eq!(edges(&[1.0, 2.0, 4.0], Scale::Linear), [0.5, 1.5, 3.0, 5.0]);
        let log = edges(&[1e-2, 1.0], Scale::Log);
        assert!((log[1] - 0.1).abs() < 1e-12 && (log[2] - 10.0).abs() < 1e-9);
        assert_eq!(edges(&[3.0], Scale::Linear), [2.5, 3.5]);
    }
}
