//! Legends.

use super::*;

const SAMPLE_GAP: f64 = 8.0;
const ROW: f64 = 20.5;
const COLUMN_GAP: f64 = 18.0;
const PADDING: f64 = 7.0;
const SIZE: f64 = 15.5;
const BORDER: Stroke = Stroke { color: Color(190, 190, 190), width: 1.0, dash: &[] };
/// Corners and middles of sides, in parts from the lower left corner.
const SIDES: [(f64, f64); 8] =
    [(1.0, 1.0), (0.0, 1.0), (1.0, 0.0), (0.0, 0.0), (1.0, 0.5), (0.0, 0.5), (0.5, 1.0), (0.5, 0.0)];

pub(super) type LegendEntry = (String, Look);

pub(super) fn entries(placed: &PlacedPanel) -> Vec<LegendEntry> {
    let series = placed.panel.series.iter().zip(&placed.looks).map(|(series, look)| (series.label.clone(), *look));
    let key = |color| Look { line: None, marker: Some(SQUARE), color: placed.color(color) };
    let keys = placed.panel.keys.iter().map(|(label, color)| (label.clone(), key(*color)));
    series.filter(|entry| !entry.0.trim().is_empty()).chain(keys).collect()
}

/// Entries in columns, each with its width.
struct Block {
    columns: Vec<(Vec<LegendEntry>, f64)>,
    sample: f64,
    size: (f64, f64),
}

impl Block {
    fn new(entries: &[LegendEntry], columns: usize, room: f64) -> Self {
        let sample = if entries.iter().any(|entry| entry.1.line.is_some()) { 34.0 } else { 14.0 };
        let label_room = (room - sample - SAMPLE_GAP - 2.0 * PADDING).max(20.0);
        let shortened = |(label, look): &LegendEntry| (text::shorten(label, SIZE, label_room), *look);
        let column = |part: &[LegendEntry]| {
            let part: Vec<LegendEntry> = part.iter().map(shortened).collect();
            let widest = part.iter().map(|entry| text::width(&entry.0, SIZE)).fold(0.0, f64::max);
            (part, sample + SAMPLE_GAP + widest)
        };
        let rows = entries.len().div_ceil(columns);
        let columns: Vec<_> = entries.chunks(rows).map(column).collect();
        let width = columns.iter().map(|column| column.1 + COLUMN_GAP).sum::<f64>() - COLUMN_GAP;
        Self { columns, sample, size: (width + 2.0 * PADDING, ROW * rows as f64 + 2.0 * PADDING - 2.0) }
    }

    fn draw(&self, page: &Page, corner: Pt) -> Done {
        let mut left = corner.0 + PADDING;
        for (entries, width) in &self.columns {
            for (row, (label, look)) in entries.iter().enumerate() {
                let at = |right: f64| (left + right, corner.1 + PADDING - 1.0 + ROW * (row as f64 + 0.5));
                if let Some(stroke) = look.line {
                    page.draw(&StrokedLine(vec![at(0.0), at(self.sample)], stroke))?;
                }
                if let Some(marker) = look.marker {
                    marker.draw(page, at(0.5 * self.sample), MARKER_RADIUS, look.color)?;
                }
                page.draw(&words(label, at(self.sample + SAMPLE_GAP), Font(SIZE, INK, Align::Start)))?;
            }
            left += width + COLUMN_GAP;
        }
        Ok(())
    }
}

/// Draws a legend inside the frame where it hides nothing, in a box; false if there is no space.
pub(super) fn inside(page: &Page, entries: &[LegendEntry], placed: &PlacedPanel, taken: &[Pt]) -> Done<bool> {
    let room = placed.frame.grown(-8.0);
    let frame = placed.frame.size();
    let place = |columns: usize| {
        let block = Block::new(entries, columns, 0.8 * frame.0);
        let (width, height) = block.size;
        let fits = width <= room.size().0 && height <= room.size().1 && width * height <= 0.35 * frame.0 * frame.1;
        let rects = SIDES.map(|(right, up)| {
            let (x, y) = room.at(right, up);
            Rect::new((x - right * width, y - (1.0 - up) * height), block.size)
        });
        let rect = rects.into_iter().find(|rect| fits && notes::cover(taken, &rect.grown(5.0)) == 0)?;
        Some((block, rect.ends()))
    };
    let Some((block, corners)) = (1..=entries.len().min(4)).find_map(place) else { return Ok(false) };
    page.draw(&Rectangle::new(corners, PAPER.filled()))?;
    page.draw(&Rectangle::new(corners, line(BORDER)))?;
    block.draw(page, corners[0])?;
    Ok(true)
}

/// Draws a legend below a panel in as many columns as fit into the figure, and returns its lower end.
pub(super) fn below(page: &Page, entries: &[LegendEntry], placed: &PlacedPanel, top: f64, width: f64) -> Done<f64> {
    let room = width - 2.0 * EDGE;
    let block = |columns| Some(Block::new(entries, columns, room)).filter(|block| columns == 1 || block.size.0 <= room);
    let Some(block) = (1..=entries.len().min(6)).rev().find_map(block) else { return Ok(top) };
    let left = (placed.frame.at(0.5, 0.0).0 - 0.5 * block.size.0).min(width - EDGE - block.size.0).max(EDGE);
    block.draw(page, (left, top))?;
    Ok(top + block.size.1)
}
