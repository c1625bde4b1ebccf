//! Legends.

use super::axes;
use super::layout::Placed;
use super::palette::{Look, MARKER_RADIUS, PAPER, tint};
use super::shape::{Align, Color, Drawing, Marker, Rect, Shape, Stroke};
use super::text;

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

/// One line of a legend.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct LegendEntry {
    label: String,
    look: Look,
}

/// Entries in columns.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Block {
    columns: Vec<Vec<LegendEntry>>,
    widths: Vec<f64>,
    size: f64,
    sample: f64,
}

/// Returns the entries of a panel's legend.
pub(super) fn entries(placed: &Placed) -> Vec<LegendEntry> {
    let series = placed.panel.series.iter().zip(&placed.looks);
    let listed = series.filter(|(series, _)| !series.label.trim().is_empty());
    let lines = listed.map(|(series, look)| LegendEntry { label: series.label.clone(), look: *look });
    let keys = placed.panel.keys.iter().map(|(label, color)| LegendEntry {
        label: label.clone(),
        look: Look { line: None, marker: Some(Marker::Square), color: tint(*color) },
    });
    lines.chain(keys).collect()
}

impl Block {
    fn new(entries: &[LegendEntry], columns: usize, room: f64, size: f64) -> Self {
        let rows = entries.len().div_ceil(columns.max(1)).max(1);
        let sample = if entries.iter().any(|entry| entry.look.line.is_some()) { LINE_SAMPLE } else { MARKER_SAMPLE };
        let label_room = (room - sample - SAMPLE_GAP - 2.0 * PADDING).max(20.0);
        let shortened = |entry: &LegendEntry| LegendEntry {
            label: text::shorten(&entry.label, size, label_room),
            look: entry.look,
        };
        let columns: Vec<Vec<LegendEntry>> =
            entries.chunks(rows).map(|part| part.iter().map(shortened).collect()).collect();
        let width = |entry: &LegendEntry| sample + SAMPLE_GAP + text::width(&entry.label, size);
        let widths = columns.iter().map(|column| column.iter().map(width).fold(0.0, f64::max)).collect();
        Self { columns, widths, size, sample }
    }

    /// A block of as many columns as fit into a width, with smaller text if that splits a long column in two.
    pub fn wide(entries: &[LegendEntry], room: f64) -> Self {
        let most = entries.len().clamp(1, 6);
        let fitting = |least: usize, size: f64| {
            let blocks = (least..=most).rev().map(|columns| Self::new(entries, columns, room, size));
            blocks.into_iter().find(|block| block.width() <= room)
        };
        let least = if entries.len() > LONG { 2 } else { 1 };
        let sizes = [SIZE, 0.9 * SIZE, 0.8 * SIZE];
        let found = sizes.into_iter().find_map(|size| fitting(least, size)).or_else(|| fitting(1, SIZE));
        found.unwrap_or_else(|| Self::new(entries, 1, room, SIZE))
    }

    pub fn width(&self) -> f64 {
        let gaps = COLUMN_GAP * self.widths.len().saturating_sub(1) as f64;
        self.widths.iter().sum::<f64>() + gaps + 2.0 * PADDING
    }

    pub fn height(&self) -> f64 {
        let rows = self.columns.iter().map(Vec::len).max().unwrap_or(0);
        ROW * rows as f64 + 2.0 * PADDING - 2.0
    }

    /// Draws sample and label of one entry around the height `middle`.
    fn entry(&self, drawing: &mut Drawing, entry: &LegendEntry, left: f64, middle: f64) {
        if let Some(stroke) = entry.look.line {
            drawing.line((left, middle), (left + self.sample, middle), stroke);
        }
        if let Some(marker) = entry.look.marker {
            let at = vec![(left + 0.5 * self.sample, middle)];
            drawing.shapes.push(Shape::Marks { at, marker, radius: MARKER_RADIUS, color: entry.look.color });
        }
        let at = (left + self.sample + SAMPLE_GAP, middle + 0.34 * self.size);
        drawing.text(axes::text(at, &entry.label, self.size, Align::Start));
    }

    /// Draws the block with its upper left corner at a point; with a box when it is inside a panel.
    pub fn draw(&self, drawing: &mut Drawing, left: f64, top: f64, boxed: bool) {
        if boxed {
            let rect = Rect::new(left, top, self.width(), self.height());
            drawing.fill(rect, PAPER);
            drawing.shapes.push(Shape::Path { points: rect.outline(), stroke: BORDER });
        }
        let mut x = left + PADDING;
        for (column, width) in self.columns.iter().zip(&self.widths) {
            for (row, entry) in column.iter().enumerate() {
                self.entry(drawing, entry, x, top + PADDING - 1.0 + ROW * (row as f64 + 0.5));
            }
            x += width + COLUMN_GAP;
        }
    }
}

/// Returns a block inside the frame that hides nothing, and its corner; none if there is no space.
pub(super) fn inside(entries: &[LegendEntry], frame: &Rect, taken: &Taken) -> Option<(Block, f64, f64)> {
    for columns in 1..=entries.len().min(4) {
        let block = Block::new(entries, columns, 0.8 * frame.width(), SIZE);
        let (width, height) = (block.width(), block.height());
        let fits = width <= frame.width() - 2.0 * INSET && height <= frame.height() - 2.0 * INSET;
        if !fits || width * height > MOST_AREA * frame.width() * frame.height() {
            continue;
        }
        let free = |corner: &(f64, f64)| taken.cover(&Rect::new(corner.0, corner.1, width, height), 5.0) == 0;
        if let Some((left, top)) = corners(frame, width, height).into_iter().find(free) {
            return Some((block, left, top));
        }
    }
    None
}

/// Returns the corners first, then the middles of the sides.
fn corners(frame: &Rect, width: f64, height: f64) -> [(f64, f64); 8] {
    let (left, right) = (frame.left + INSET, frame.right - INSET - width);
    let (top, bottom) = (frame.top + INSET, frame.bottom - INSET - height);
    let (across, down) = (0.5 * (left + right), 0.5 * (top + bottom));
    let corners = [(right, top), (left, top), (right, bottom), (left, bottom)];
    let middles = [(right, down), (left, down), (across, top), (across, bottom)];
    std::array::from_fn(|k| if k < 4 { corners[k] } else { middles[k - 4] })
}

/// Parts of a panel that must not be hidden.
#[derive(Clone, Debug, Default)]
pub(super) struct Taken {
    points: Vec<(f64, f64)>,
    pub rects: Vec<Rect>,
}

impl Taken {
    /// Adds the positions of lines and markers.
    pub fn add(&mut self, shapes: &[Shape]) {
        for shape in shapes {
            match shape {
                Shape::Path { points, .. } | Shape::Area { points, .. } => {
                    points.windows(2).for_each(|pair| self.segment(pair[0], pair[1]))
                }
                Shape::Marks { at, .. } => self.points.extend(at),
                Shape::Rects { rects, .. } => self.rects.extend(rects),
                Shape::Text(text) => self.rects.push(text.bounds()),
            }
        }
    }

    fn segment(&mut self, from: (f64, f64), to: (f64, f64)) {
        let steps = ((to.0 - from.0).hypot(to.1 - from.1) / 5.0).ceil().clamp(1.0, 4000.0);
        for k in 0..=steps as usize {
            let t = k as f64 / steps;
            self.points.push((from.0 + t * (to.0 - from.0), from.1 + t * (to.1 - from.1)));
        }
    }

    /// Returns a measure of the parts that a rectangle would hide, or that are within `border` of it.
    pub fn cover(&self, rect: &Rect, border: f64) -> usize {
        let near = rect.grown(border);
        let points = self.points.iter().filter(|point| near.contains(**point)).count();
        points + 60 * self.rects.iter().filter(|other| other.overlaps(&near)).count()
    }
}
