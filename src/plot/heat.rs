//! Maps of coloured cells.

use super::*;

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
    pub fn log(self) -> Self {
        Self { scale: Scale::Log, ..self }
    }

    /// Sets fixed limits of the colours.
    pub fn range(self, low: f64, high: f64) -> Self {
        Self { range: Some((low, high)), ..self }
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

    /// Adds the outer borders of the cells to the extents.
    pub(super) fn extend(&self, x: &mut Extent, y: &mut Extent, scales: (Scale, Scale)) {
        edges(&self.x, scales.0).into_iter().for_each(|edge| x.add(edge));
        edges(&self.y, scales.1).into_iter().for_each(|edge| y.add(edge));
    }

    /// Returns the colour of a cell without a value; none if it is grey.
    fn tint(&self, column: usize, row: usize) -> Option<Color> {
        self.fills.iter().find(|fill| (fill.0, fill.1) == (column, row)).map(|fill| tint(fill.2))
    }

    /// Returns the step of a cell on the colour scale, if it has a finite value.
    fn step(&self, placed: &Placed, column: usize, row: usize) -> Option<usize> {
        placed.bar.as_ref()?.step((*self.values.get(row)?.get(column)?)?)
    }
}

/// Returns (column, row, rectangle in the picture) of each cell, clipped to the frame.
fn rects(map: &HeatMap, placed: &Placed) -> Vec<(usize, usize, Rect)> {
    let (columns, rows) = (edges(&map.x, placed.x.spec.scale), edges(&map.y, placed.y.spec.scale));
    let place = |axis: &Axis, value: f64| Some(axis.place(value)?.clamp(0.0, 1.0));
    let mut all = Vec::new();
    for (column, x) in columns.windows(2).enumerate() {
        for (row, y) in rows.windows(2).enumerate() {
            let places =
                [place(&placed.x, x[0]), place(&placed.x, x[1]), place(&placed.y, y[0]), place(&placed.y, y[1])];
            let [Some(begin), Some(end), Some(low), Some(high)] = places else { continue };
            let ((left, bottom), (right, top)) = (placed.frame.at(begin, low), placed.frame.at(end, high));
            if begin < end && low < high {
                all.push((column, row, Rect { left, top, right, bottom }));
            }
        }
    }
    all
}

/// Draws the cells of the map, those of a colour together, and the texts on them in a size that fits.
pub(super) fn cells(chart: &mut Chart, page: &Page, placed: &Placed) -> Done {
    let Some(map) = &placed.panel.heat_map else { return Ok(()) };
    let mut cells = rects(map, placed);
    let color = |column, row| {
        let value = map.step(placed, column, row).map(scale_color);
        value.or_else(|| map.tint(column, row)).unwrap_or(NO_VALUE)
    };
    cells.sort_by_key(|(column, row, _)| {
        let Color(red, green, blue) = color(*column, *row);
        (red, green, blue)
    });
    chart.draw_series(cells.iter().map(|(column, row, rect)| {
        Rectangle::new(rect.corners().map(|corner| placed.values(corner)), color(*column, *row).filled())
    }))?;
    let least =
        |part: fn((f64, f64)) -> f64| cells.iter().map(|cell| part(cell.2.size())).fold(f64::INFINITY, f64::min);
    let widest = map.words.iter().map(|(_, _, word)| text::width(word, 1.0)).fold(0.1, f64::max);
    let size = TICK_SIZE.min(0.88 * least(|size| size.0) / widest).min(0.8 * least(|size| size.1));
    for (column, row, word) in &map.words {
        if let Some((_, _, rect)) = cells.iter().find(|cell| (cell.0, cell.1) == (*column, *row)) {
            let style = font(size, ink_on(color(*column, *row)), Align::Middle);
            page.draw_text(word, &style, units(rect.at(0.5, 0.5)))?;
        }
    }
    Ok(())
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
