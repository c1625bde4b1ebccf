//! The chart of a panel: grid, marks, labels, frame, colour bar, and the texts above it.

use super::panel::{AxisSpec, Scale};
use super::ticks::{Room, Ticks};
use super::*;
use plotters::chart::{ChartBuilder, MeshStyle};
use plotters::coord::ranged1d::ValueFormatter;
use plotters::style::ShapeStyle;

/// Distance of factors and notes from the frame, to their middle.
const STRIP_GAP: f64 = 11.0;
/// Distance of the colour bar from the frame, and its width.
const BAR_GAP: f64 = 12.0;
const BAR_WIDTH: f64 = 16.0;

/// Returns a length in units of the backend.
fn length(pixels: f64) -> i32 {
    units((pixels, 0.0)).0
}

/// Returns a stroke as a style of plotters, without its dashes.
pub(super) fn line(stroke: Stroke) -> ShapeStyle {
    stroke.color.stroke_width(length(stroke.width) as u32)
}

/// Builds the chart of a panel on an area as high as the panel, and sets its frame.
pub(super) fn build<'a>(area: &Page, placed: &mut Placed) -> Done<Chart<'a>> {
    let start = pixels(area.get_base_pixel()).0;
    let (left, right, distance) = placed.margins;
    // The frame lies in the middle of pixels, where its lines are sharp.
    let left = (start + left).round() + 0.5 - start;
    let label_area = (distance + placed.y_label.height()).min(left);
    let chart = ChartBuilder::on(area)
        .margin_left(length(left) - length(label_area))
        .margin_right(length(right + 0.5))
        .margin_top(length(placed.above() + 0.5))
        .y_label_area_size(length(label_area))
        .x_label_area_size(length(placed.below() - 0.5))
        .build_cartesian_2d(placed.x.clone(), placed.y.clone())?;
    let (across, down) = chart.plotting_area().get_pixel_range();
    // Positions are numbered to the last unit.
    let ((left, top), (right, bottom)) = (pixels((across.start, down.start)), pixels((across.end - 1, down.end - 1)));
    placed.frame = Rect { left, top, right, bottom };
    Ok(chart)
}

/// Draws thin lines at the labelled marks, and through zero.
pub(super) fn grid(chart: &mut Chart, placed: &Placed) -> Done {
    if placed.panel.heat_map.is_some() {
        return Ok(());
    }
    chart.configure_mesh().disable_axes().bold_line_style(line(GRID)).draw()?;
    let ends = |axis: &Axis| [axis.value(0.0), axis.value(1.0)];
    let has_zero =
        |axis: &Axis| placed.panel.zero_lines && axis.spec.scale == Scale::Linear && axis.low < 0.0 && axis.high > 0.0;
    let upright = ends(&placed.y).map(|y| (0.0, y)).to_vec();
    let level = ends(&placed.x).map(|x| (x, 0.0)).to_vec();
    let lines = [(&placed.x, upright), (&placed.y, level)].into_iter().filter(|(axis, _)| has_zero(axis));
    lines.map(|(_, points)| Curve(points, ZERO)).try_for_each(|zero| chart.plotting_area().draw(&zero))
}

/// Returns a style of marks of a length on the axes, with labels, and descriptions in a size.
fn marks<'a, 'b>(chart: &'b mut Chart<'a>, mark: f64, size: f64) -> MeshStyle<'a, 'b, Axis, Axis, Sketch> {
    let mut mesh = chart.configure_mesh();
    mesh.disable_mesh().axis_style(line(FRAME)).set_all_tick_mark_size(length(mark));
    mesh.label_style(font(TICK_SIZE, INK, Align::Middle)).axis_desc_style(font(size, INK, Align::Middle));
    mesh
}

/// Draws marks, labels and the frame.
pub(super) fn axes(chart: &mut Chart, placed: &Placed) -> Done {
    let blank = |_: &f64| String::new();
    let x_text = |value: &f64| if placed.shows_x { placed.x.format_ext(value) } else { String::new() };
    let x_label = if placed.shows_x { placed.x_label.text.as_str() } else { "" };
    marks(chart, 0.5 * LABEL_DISTANCE, placed.x_label.size).x_label_formatter(&x_text).x_desc(x_label).draw()?;
    marks(chart, MINOR_LENGTH, placed.y_label.size)
        .x_labels(0)
        .y_labels(0)
        .x_label_formatter(&blank)
        .y_label_formatter(&blank)
        .y_desc(placed.y_label.text.as_str())
        .draw()?;
    frame(chart)
}

/// Draws the frame around a chart.
fn frame(chart: &Chart) -> Done {
    let area = chart.plotting_area().strip_coord_spec();
    let (width, height) = area.dim_in_pixel();
    area.draw(&Rectangle::new([(0, 0), (width as i32 - 1, height as i32 - 1)], line(FRAME)))
}

/// Writes factors, notes and the title around the frame.
pub(super) fn texts(page: &Page, placed: &Placed) -> Done {
    let frame = placed.frame;
    let strip = frame.top - STRIP_GAP;
    let write = |text: &str, size, color, align, at| page.draw_text(text, &font(size, color, align), units(at));
    write(&placed.y.ticks.factor, NOTE_SIZE, INK, Align::Start, (frame.left, strip))?;
    write(&placed.note(), NOTE_SIZE, NOTE_INK, Align::End, (frame.right, strip))?;
    if let Some(bar) = &placed.bar {
        write(&bar.axis.ticks.factor, NOTE_SIZE, INK, Align::Start, (frame.right + BAR_GAP, strip))?;
    }
    if placed.shows_x {
        let at = (frame.right, frame.bottom + LABEL_DISTANCE + 2.0 * TICK_SIZE);
        write(&placed.x.ticks.factor, NOTE_SIZE, INK, Align::End, at)?;
    }
    let title = text::shorten(placed.panel.title.trim(), TICK_SIZE, frame.size().0);
    write(&title, TICK_SIZE, INK, Align::Middle, (frame.at(0.5, 0.0).0, strip - placed.strip()))
}

/// A colour scale with its marks.
#[derive(Clone, Debug)]
pub(super) struct ColorBar {
    pub axis: Axis,
    label: Label,
}

impl ColorBar {
    /// The bar for all coloured values of a panel; none if there is nothing coloured.
    pub fn new(panel: &Panel) -> Option<Self> {
        let (label, scale) = match (&panel.heat_map, panel.color_series.first()) {
            (Some(map), _) => (&map.label, map.scale),
            (None, series) => series.map(|series| (&series.label, series.scale))?,
        };
        let mut extent = Extent::default();
        let cells = panel.heat_map.iter().flat_map(|map| map.values.iter().flatten().flatten());
        let points = panel.color_series.iter().flat_map(|series| series.points.iter().map(|point| &point.2));
        cells.chain(points).for_each(|value| extent.add(*value));
        let range = panel.heat_map.as_ref().and_then(|map| map.range);
        let spec = AxisSpec { label: label.clone(), scale, range, ..AxisSpec::default() };
        Some(Self { axis: Axis::new(&spec, &extent, None), label: Label::default() })
    }

    /// Chooses marks and breaks the label for a height.
    pub fn fit(&mut self, height: f64) {
        self.axis.ticks = Ticks::new(&self.axis, Room::Upwards(height));
        self.label = Label::new(&self.axis.spec.label, LABEL_SIZE, 1.05 * height, 2);
    }

    /// Returns the width needed to the right of the panel.
    pub fn width(&self) -> f64 {
        let labels = LABEL_DISTANCE + self.axis.ticks.widest() + 6.0 + self.label.height();
        BAR_GAP + BAR_WIDTH + labels.max(text::width(&self.axis.ticks.factor, NOTE_SIZE) - BAR_WIDTH - EDGE)
    }

    /// Returns the step of a value on the colour scale; none for NaN and infinities.
    pub fn step(&self, value: f64) -> Option<usize> {
        let place = self.axis.place(value)?.clamp(0.0, 1.0);
        Some(((place * COLOR_STEPS as f64) as usize).min(COLOR_STEPS - 1))
    }

    /// Draws the bar at the right of a panel's frame, as a chart of its own on the area of the panel.
    pub fn draw(&self, area: &Page, placed: &Placed) -> Done {
        let left = placed.frame.right + BAR_GAP - pixels(area.get_base_pixel()).0;
        let right = pixels((area.dim_in_pixel().0 as i32, 0)).0 - left - BAR_WIDTH;
        let mut chart = ChartBuilder::on(area)
            .margin_left(length(left))
            .margin_right(length(EDGE))
            .margin_top(length(placed.above() + 0.5))
            .margin_bottom(length(placed.below() - 0.5))
            .right_y_label_area_size(length(right - EDGE))
            .build_cartesian_2d(Axis::new(&AxisSpec::default(), &Extent::default(), None), self.axis.clone())?;
        chart.draw_series((0..COLOR_STEPS).map(|step| {
            // Each step reaches up to the end of the bar, so that no seam shows between two.
            let ends = [(0.0, self.axis.value(step as f64 / COLOR_STEPS as f64)), (1.0, self.axis.value(1.0))];
            Rectangle::new(ends, scale_color(step).filled())
        }))?;
        let label = self.label.text.as_str();
        marks(&mut chart, 0.5 * LABEL_DISTANCE, self.label.size).disable_x_axis().y_desc(label).draw()?;
        frame(&chart)
    }
}
