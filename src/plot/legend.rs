//! Legends.

use super::data::Marker;
use super::*;

/// Width of the samples when some have a line, and when all are markers.
const LINE_SAMPLE: f64 = 34.0;
const MARKER_SAMPLE: f64 = 14.0;
const SAMPLE_GAP: f64 = 8.0;
const ROW: f64 = 20.5;
const COLUMN_GAP: f64 = 18.0;
const PADDING: f64 = 7.0;
const SIZE: f64 = 15.5;
/// Longer legends should not be one column below a panel.
const LONG: usize = 5;
/// Distance from the frame.
const INSET: f64 = 8.0;
/// Largest part of its panel that a legend inside covers.
const MOST_AREA: f64 = 0.35;
const BORDER: Stroke = Stroke { color: Color(190, 190, 190), width: 1.0, dash: &[] };

/// One line of a legend: its label and look.
pub(super) type LegendEntry = (String, Look);

/// Entries in columns, each with its width.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Block {
    columns: Vec<(Vec<LegendEntry>, f64)>,
    text_size: f64,
    sample: f64,
}

/// Returns the entries of a panel's legend.
pub(super) fn entries(placed: &Placed) -> Vec<LegendEntry> {
    let series = placed.panel.series.iter().zip(&placed.looks).map(|(series, look)| (series.label.clone(), *look));
    let key = |color| Look { line: None, marker: Some(Marker::Square), color: tint(color) };
    let keys = placed.panel.keys.iter().map(|(label, color)| (label.clone(), key(*color)));
    series.filter(|entry| !entry.0.trim().is_empty()).chain(keys).collect()
}

impl Block {
    fn new(entries: &[LegendEntry], columns: usize, room: f64, size: f64) -> Self {
        let rows = entries.len().div_ceil(columns.max(1)).max(1);
        let sample = if entries.iter().any(|entry| entry.1.line.is_some()) { LINE_SAMPLE } else { MARKER_SAMPLE };
        let label_room = (room - sample - SAMPLE_GAP - 2.0 * PADDING).max(20.0);
        let shortened = |entry: &LegendEntry| (text::shorten(&entry.0, size, label_room), entry.1);
        let column = |part: &[LegendEntry]| {
            let part: Vec<LegendEntry> = part.iter().map(shortened).collect();
            let widest = part.iter().map(|entry| text::width(&entry.0, size)).fold(0.0, f64::max);
            (part, sample + SAMPLE_GAP + widest)
        };
        Self { columns: entries.chunks(rows).map(column).collect(), text_size: size, sample }
    }

    /// A block of as many columns as fit into a width, with smaller text if that splits a long column in two.
    pub fn wide(entries: &[LegendEntry], room: f64) -> Self {
        let least = if entries.len() > LONG { 2 } else { 1 };
        let columns = (least..=entries.len().clamp(1, 6)).rev();
        let sizes = [SIZE, 0.9 * SIZE, 0.8 * SIZE].into_iter();
        let mut all = sizes.flat_map(|size| columns.clone().map(move |count| Self::new(entries, count, room, size)));
        all.find(|block| block.size().0 <= room).unwrap_or_else(|| Self::new(entries, 1, room, SIZE))
    }

    pub fn size(&self) -> (f64, f64) {
        let width = self.columns.iter().map(|column| column.1 + COLUMN_GAP).sum::<f64>() - COLUMN_GAP;
        let rows = self.columns.iter().map(|column| column.0.len()).max().unwrap_or(0);
        (width + 2.0 * PADDING, ROW * rows as f64 + 2.0 * PADDING - 2.0)
    }

    /// Draws the block with its upper left corner at a point; with a box when it is inside a panel.
    pub fn draw(&self, page: &Page, corner: Pt, boxed: bool) -> Done {
        if boxed {
            let corners = Rect::new(corner, self.size()).corners().map(units);
            page.draw(&Rectangle::new(corners, PAPER.filled()))?;
            page.draw(&Rectangle::new(corners, chart::line(BORDER)))?;
        }
        let mut left = corner.0 + PADDING;
        for (entries, width) in &self.columns {
            for (row, (label, look)) in entries.iter().enumerate() {
                let y = corner.1 + PADDING - 1.0 + ROW * (row as f64 + 0.5);
                let at = |right: f64| units((left + right, y));
                let line = look.line.map(|stroke| Curve(vec![at(0.0), at(self.sample)], stroke));
                line.iter().try_for_each(|line| page.draw(line))?;
                let marker = look.marker.iter();
                marker
                    .into_iter()
                    .try_for_each(|one| one.draw(page, [at(0.5 * self.sample)], MARKER_RADIUS, look.color))?;
                page.draw_text(label, &font(self.text_size, INK, Align::Start), at(self.sample + SAMPLE_GAP))?;
            }
            left += width + COLUMN_GAP;
        }
        Ok(())
    }
}

/// Returns a block inside the frame that hides nothing, and its corner; none if there is no space.
pub(super) fn inside(entries: &[LegendEntry], placed: &Placed, taken: &Taken) -> Option<(Block, Pt)> {
    let (frame, most) = (placed.frame, if placed.panel.heat_map.is_none() { entries.len().min(4) } else { 0 });
    let (frame_width, frame_height) = frame.size();
    let room = frame.grown(-INSET);
    for block in (1..=most).map(|columns| Block::new(entries, columns, 0.8 * frame_width, SIZE)) {
        let (width, height) = block.size();
        let fits = width <= room.size().0 && height <= room.size().1;
        let free = |corner: &Pt| taken.cover(&Rect::new(*corner, (width, height)), 5.0) == 0;
        if fits && width * height <= MOST_AREA * frame_width * frame_height {
            // Corners first, then the middles of the sides; parts of the room that is left.
            let (across, down) = (room.size().0 - width, room.size().1 - height);
            let sides =
                [(1.0, 0.0), (0.0, 0.0), (1.0, 1.0), (0.0, 1.0), (1.0, 0.5), (0.0, 0.5), (0.5, 0.0), (0.5, 1.0)];
            let corners = sides.map(|(x, y)| (room.left + x * across, room.top + y * down));
            if let Some(corner) = corners.into_iter().find(free) {
                return Some((block, corner));
            }
        }
    }
    None
}
