//! The chart of a panel: grid, marks, labels, frame, colour bar, and the texts above it.

use super::*;
use plotters::chart::{ChartBuilder, MeshStyle};
use plotters::style::ShapeStyle;

/// Distance of factors from the frame, to their middle.
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
    let label_area = (distance + placed.y.label.height()).min(left);
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

/// Draws thin lines at the labelled marks.
pub(super) fn grid(chart: &mut Chart) -> Done {
    chart.configure_mesh().disable_axes().bold_line_style(line(GRID)).draw()
}

/// Returns a style of marks of a length on the axes, with labels, and a title in a size.
fn marks<'a, 'b>(chart: &'b mut Chart<'a>, mark: f64, size: f64) -> MeshStyle<'a, 'b, Axis, Axis, Sketch> {
    let mut mesh = chart.configure_mesh();
    mesh.disable_mesh().axis_style(line(FRAME)).set_all_tick_mark_size(length(mark));
    mesh.label_style(font(TICK_SIZE, INK, Align::Middle)).axis_desc_style(font(size, INK, Align::Middle));
    mesh
}

/// Draws marks, labels and the frame.
pub(super) fn axes(chart: &mut Chart, placed: &Placed) -> Done {
    let Placed { x, y, .. } = placed;
    marks(chart, 0.5 * LABEL_DISTANCE, x.label.size).x_desc(&x.label.text).draw()?;
    marks(chart, MINOR_LENGTH, y.label.size).x_labels(0).y_labels(0).y_desc(&y.label.text).draw()?;
    frame(chart)
}

/// Draws the frame around a chart.
fn frame(chart: &Chart) -> Done {
    let area = chart.plotting_area().strip_coord_spec();
    let (width, height) = area.dim_in_pixel();
    area.draw(&Rectangle::new([(0, 0), (width as i32 - 1, height as i32 - 1)], line(FRAME)))
}

/// Writes factors and the title around the frame.
pub(super) fn texts(page: &Page, placed: &Placed) -> Done {
    let frame = placed.frame;
    let strip = frame.top - STRIP_GAP;
    let write = |text: &str, size, align, at| page.draw_text(text, &font(size, INK, align), units(at));
    write(&placed.y.ticks.factor, NOTE_SIZE, Align::Start, (frame.left, strip))?;
    if let Some(bar) = &placed.bar {
        write(&bar.ticks.factor, NOTE_SIZE, Align::Start, (frame.right + BAR_GAP, strip))?;
    }
    let below = (frame.right, frame.bottom + LABEL_DISTANCE + 2.0 * TICK_SIZE);
    write(&placed.x.ticks.factor, NOTE_SIZE, Align::End, below)?;
    let title = text::shorten(placed.panel.title.trim(), TICK_SIZE, frame.size().0);
    write(&title, TICK_SIZE, Align::Middle, (frame.at(0.5, 0.0).0, strip - placed.strip()))
}

/// Returns the width that a colour bar needs to the right of a frame.
pub(super) fn bar_width(bar: &Axis) -> f64 {
    let labels = LABEL_DISTANCE + bar.ticks.widest() + 6.0 + bar.label.height();
    BAR_GAP + BAR_WIDTH + labels.max(text::width(&bar.ticks.factor, NOTE_SIZE) - BAR_WIDTH - EDGE)
}

/// Draws the colour bar at the right of a panel's frame, as a chart of its own on the area of the panel.
pub(super) fn bar(area: &Page, placed: &Placed) -> Done {
    let Some(bar) = &placed.bar else { return Ok(()) };
    let left = placed.frame.right + BAR_GAP - pixels(area.get_base_pixel()).0;
    let right = pixels((area.dim_in_pixel().0 as i32, 0)).0 - left - BAR_WIDTH;
    let mut chart = ChartBuilder::on(area)
        .margin_left(length(left))
        .margin_right(length(EDGE))
        .margin_top(length(placed.above() + 0.5))
        .margin_bottom(length(placed.below() - 0.5))
        .right_y_label_area_size(length(right - EDGE))
        .build_cartesian_2d(Axis::new(&"".into(), &Extent::default(), None), bar.clone())?;
    chart.draw_series((0..COLOR_STEPS).map(|step| {
        // Each step reaches up to the end of the bar, so that no seam shows between two.
        let ends = [(0.0, bar.value(step as f64 / COLOR_STEPS as f64)), (1.0, bar.value(1.0))];
        Rectangle::new(ends, scale_color(step).filled())
    }))?;
    marks(&mut chart, 0.5 * LABEL_DISTANCE, bar.label.size).disable_x_axis().y_desc(&bar.label.text).draw()?;
    frame(&chart)
}
