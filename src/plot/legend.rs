//! Legends.

use super::*;

/// Width of the samples when some have a line, and when all are markers.
const LINE_SAMPLE: f64 = 34.0;
const MARKER_SAMPLE: f64 = 14.0;
const SAMPLE_GAP: f64 = 8.0;
const ROW: f64 = 20.5;
const COLUMN_GAP: f64 = 18.0;
const PADDING: f64 = 7.0;
const SIZE: f64 = 15.5;
/// Distance from the frame.
const INSET: f64 = 8.0;
/// Largest part of its panel that a legend inside covers.
const MOST_AREA: f64 = 0.35;
const BORDER: Stroke = Stroke { color: Color(190, 190, 190), width: 1.0, dash: &[] };

pub(super) type LegendEntry = (String, Look);

/// Entries in columns, each with its width.
pub(super) struct Block {
    columns: Vec<(Vec<LegendEntry>, f64)>,
    sample: f64,
}

pub(super) fn entries(placed: &Placed) -> Vec<LegendEntry> {
    let series = placed.panel.series.iter().zip(&placed.looks).map(|(series, look)| (series.label.clone(), *look));
    let key = |color| Look { line: None, marker: Some(SQUARE), color: placed.color(color) };
    let keys = placed.panel.keys.iter().map(|(label, color)| (label.clone(), key(*color)));
    series.filter(|entry| !entry.0.trim().is_empty()).chain(keys).collect()
}

impl Block {
    fn new(entries: &[LegendEntry], columns: usize, room: f64) -> Self {
        let sample = if entries.iter().any(|entry| entry.1.line.is_some()) { LINE_SAMPLE } else { MARKER_SAMPLE };
        let label_room = (room - sample - SAMPLE_GAP - 2.0 * PADDING).max(20.0);
        let shortened = |(label, look): &LegendEntry| (text::shorten(label, SIZE, label_room), *look);
        let column = |part: &[LegendEntry]| {
            let part: Vec<LegendEntry> = part.iter().map(shortened).collect();
            let widest = part.iter().map(|entry| text::width(&entry.0, SIZE)).fold(0.0, f64::max);
            (part, sample + SAMPLE_GAP + widest)
        };
        Self { columns: entries.chunks(entries.len().div_ceil(columns)).map(column).collect(), sample }
    }

    /// A block of as many columns as fit into a width.
    pub fn wide(entries: &[LegendEntry], room: f64) -> Self {
        let mut blocks = (1..=entries.len().min(6)).rev().map(|columns| Self::new(entries, columns, room));
        blocks.find(|block| block.size().0 <= room).unwrap_or_else(|| Self::new(entries, 1, room))
    }

    pub fn size(&self) -> (f64, f64) {
        let width = self.columns.iter().map(|column| column.1 + COLUMN_GAP).sum::<f64>() - COLUMN_GAP;
        (width + 2.0 * PADDING, ROW * self.columns[0].0.len() as f64 + 2.0 * PADDING - 2.0)
    }

    /// Draws the block with its upper left corner at a point; with a box when it is inside a panel.
    pub fn draw(&self, page: &Page, corner: Pt, boxed: bool) -> Done {
        if boxed {
            let (width, height) = self.size();
            let corners = [corner, (corner.0 + width, corner.1 + height)];
            page.draw(&Rectangle::new(corners, PAPER.filled()))?;
            page.draw(&Rectangle::new(corners, line(BORDER)))?;
        }
        let mut left = corner.0 + PADDING;
        for (entries, width) in &self.columns {
            for (row, (label, look)) in entries.iter().enumerate() {
                let at = |right: f64| (left + right, corner.1 + PADDING - 1.0 + ROW * (row as f64 + 0.5));
                if let Some(stroke) = look.line {
                    page.draw(&Curve(vec![at(0.0), at(self.sample)], stroke))?;
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

/// Returns a block inside the frame that hides nothing, and its corner; none if there is no space.
pub(super) fn inside(entries: &[LegendEntry], placed: &Placed, taken: &Taken) -> Option<(Block, Pt)> {
    let room = placed.frame.grown(-INSET);
    let frame = placed.frame.size();
    // Corners first, then the middles of the sides: parts of the free room from the lower left corner.
    const SIDES: [(f64, f64); 8] =
        [(1.0, 1.0), (0.0, 1.0), (1.0, 0.0), (0.0, 0.0), (1.0, 0.5), (0.0, 0.5), (0.5, 1.0), (0.5, 0.0)];
    (1..=entries.len().min(4)).find_map(|columns| {
        let block = Block::new(entries, columns, 0.8 * frame.0);
        let (width, height) = block.size();
        let fits = width <= room.size().0 && height <= room.size().1;
        let is_small = fits && width * height <= MOST_AREA * frame.0 * frame.1;
        let corner = |(right, up): (f64, f64)| {
            let (x, y) = room.at(right, up);
            (x - right * width, y - (1.0 - up) * height)
        };
        let is_free = |corner: &Pt| is_small && taken.cover(&Rect::new(*corner, (width, height)), 5.0) == 0;
        Some((block, SIDES.map(corner).into_iter().find(is_free)?))
    })
}
