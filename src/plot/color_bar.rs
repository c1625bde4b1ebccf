//! The colour bar of a panel.

use super::axes::{self, STRIP_GAP};
use super::axis::{Axis, Extent, Slack};
use super::palette::{
    COLOR_STEPS, EDGE, FRAME, LABEL_SIZE, NOTE_SIZE, TICK_LENGTH, TICK_SIZE, color_step, scale_color,
};
use super::panel::{AxisSpec, Panel};
use super::shape::{Align, Color, Drawing, Rect, Shape};
use super::text::{self, HALF_DIGIT, LINE_HEIGHT, Label};
use super::ticks::{Room, Ticks};

const GAP: f64 = 12.0;
const WIDTH: f64 = 16.0;

/// A colour scale with its marks.
#[derive(Clone, Debug)]
pub(super) struct ColorBar {
    axis: Axis,
    ticks: Ticks,
    title: String,
    label: Label,
}

impl ColorBar {
    /// The bar for all coloured values of a panel; none if there is nothing coloured.
    pub fn new(panel: &Panel) -> Option<Self> {
        let mut extent = Extent::default();
        let (label, scale) = match (&panel.heat_map, panel.color_series.first()) {
            (Some(map), _) => (&map.label, map.scale),
            (None, Some(series)) => (&series.label, series.scale),
            (None, None) => return None,
        };
        let cells = panel.heat_map.iter().flat_map(|map| map.values.iter().flatten().flatten());
        let points = panel.color_series.iter().flat_map(|series| series.points.iter().map(|point| &point.2));
        cells.chain(points).for_each(|value| extent.add(*value));
        let range = panel.heat_map.as_ref().and_then(|map| map.range);
        let spec = AxisSpec { label: label.clone(), scale, range, ..AxisSpec::default() };
        let axis = Axis::new(&spec, &extent, Slack::Round);
        Some(Self { axis, ticks: Ticks::default(), title: label.clone(), label: Label::default() })
    }

    /// Chooses marks and breaks the label for a height.
    pub fn fit(&mut self, height: f64) {
        self.ticks = Ticks::new(&self.axis, Room { length: height, size: TICK_SIZE, along: false });
        self.label = Label::new(&self.title, LABEL_SIZE, 1.05 * height, 2);
    }

    /// Returns the width needed to the right of the panel.
    pub fn width(&self) -> f64 {
        let factor = text::width(&self.ticks.factor, NOTE_SIZE) - WIDTH - EDGE;
        GAP + WIDTH + (TICK_LENGTH + 4.0 + self.ticks.widest(TICK_SIZE) + 5.0 + self.label.height()).max(factor)
    }

    /// True if there is a factor above the bar.
    pub fn has_factor(&self) -> bool {
        !self.ticks.factor.is_empty()
    }

    /// Returns a note on values without a logarithm, which are drawn at the floor.
    pub fn note(&self) -> Option<String> {
        axes::floor_note(&self.axis, "", "coloured as")
    }

    /// Returns the colour of a value; none for NaN and infinities.
    pub fn color(&self, value: f64) -> Option<Color> {
        self.step(value).map(scale_color)
    }

    /// Returns the step of a value on the colour scale.
    pub fn step(&self, value: f64) -> Option<usize> {
        self.axis.place(value).map(color_step)
    }

    /// Draws the bar at the right of a frame.
    pub fn draw(&self, drawing: &mut Drawing, frame: &Rect) {
        let bar = Rect { left: frame.right + GAP, right: frame.right + GAP + WIDTH, ..*frame };
        let step = bar.height() / COLOR_STEPS as f64;
        for k in 0..COLOR_STEPS {
            // Each step reaches down to the end of the bar, so that no seam shows between two.
            let top = bar.bottom - step * (k + 1) as f64;
            let bottom = (top + 2.0 * step).min(bar.bottom);
            drawing.fill(Rect { top, bottom, ..bar }, scale_color(k));
        }
        drawing.shapes.push(Shape::Path { points: bar.outline(), stroke: FRAME });
        let labels = bar.right + TICK_LENGTH + 4.0;
        for tick in &self.ticks.major {
            let y = bar.bottom - tick.at * bar.height();
            drawing.line((bar.right, y), (bar.right + TICK_LENGTH, y), FRAME);
            drawing.text(axes::text((labels, y + HALF_DIGIT * TICK_SIZE), &tick.label, TICK_SIZE, Align::Start));
        }
        let factor = (bar.left, bar.top - STRIP_GAP);
        drawing.text(axes::text(factor, &self.ticks.factor, NOTE_SIZE, Align::Start));
        let size = self.label.size;
        let mut x = labels + self.ticks.widest(TICK_SIZE) + 5.0 + 0.85 * size;
        for line in &self.label.lines {
            drawing.text(axes::turned((x, bar.center().1), line, size));
            x += LINE_HEIGHT * size;
        }
    }
}
