//! The chart of a panel: grid, marks, labels, frame, colour bar, and the texts above it.

use super::*;
use plotters::chart::{ChartBuilder, MeshStyle};

/// Distance of the colour bar from the frame, and its width.
const BAR_GAP: f64 = 12.0;
const BAR_WIDTH: f64 = 16.0;

/// Builds a chart around a frame, with room at the left of it, below and at the right.
fn build<'a>(page: &Page, frame: &Rect, [x, y]: [&PlotAxis; 2], room: [f64; 3]) -> Done<PlotChart<'a>> {
    let [left, below, right] = room.map(units);
    let (width, height) = frame.size();
    // The last position is within the area.
    let size = (left + units(width) + right + 1, units(height) + below + 1);
    let area = page.strip_coord_spec().shrink((units(frame.left) - left, units(frame.top)), size);
    let mut builder = ChartBuilder::on(&area);
    builder.y_label_area_size(left).x_label_area_size(below).right_y_label_area_size(right);
    builder.build_cartesian_2d(x.clone(), y.clone())
}

/// Builds the chart of a panel, and draws thin lines at the labelled marks.
pub(super) fn grid<'a>(page: &Page, placed: &PlacedPanel) -> Done<PlotChart<'a>> {
    let room = [placed.margins.0, placed.below() - 0.5, 0.0];
    let mut chart = build(page, &placed.frame, [&placed.x, &placed.y], room)?;
    chart.configure_mesh().disable_axes().bold_line_style(line(GRID)).draw()?;
    Ok(chart)
}

fn axes(page: &Page, chart: &mut PlotChart, [x, y]: [&PlotAxis; 2], frame: &Rect) -> Done {
    marks(chart, 0.5 * LABEL_DISTANCE, x.label.size).x_desc(&x.label.text).draw()?;
    marks(chart, MINOR_LENGTH, y.label.size).x_labels(0).y_labels(0).y_desc(&y.label.text).draw()?;
    page.draw(&Rectangle::new(frame.ends(), line(FRAME)))
}

/// Returns a style of marks of a length, with labels, and with a title in a size.
fn marks<'a, 'b>(
    chart: &'b mut PlotChart<'a>,
    length: f64,
    size: f64,
) -> MeshStyle<'a, 'b, PlotAxis, PlotAxis, Drawing> {
    let mut mesh = chart.configure_mesh();
    mesh.disable_mesh().axis_style(line(FRAME)).set_all_tick_mark_size(units(length));
    let text = |size| font(Font(size, INK, Align::Middle));
    mesh.label_style(text(TICK_SIZE)).axis_desc_style(text(size));
    mesh
}

/// Draws the axes with the texts around them, and the colour bar as a chart of its own.
pub(super) fn draw(page: &Page, chart: &mut PlotChart, placed: &PlacedPanel) -> Done {
    let PlacedPanel { panel, x, y, bar, frame, margins: (_, right), .. } = placed;
    axes(page, chart, [x, y], frame)?;
    let strip = frame.top - 11.0;
    let beside = frame.right + BAR_GAP;
    let factor = |axis: &PlotAxis, at, align| page.draw(&words(&axis.ticks.factor, at, Font(NOTE_SIZE, INK, align)));
    factor(y, (frame.left, strip), Align::Start)?;
    factor(x, (frame.right, frame.bottom + LABEL_DISTANCE + 2.0 * TICK_SIZE), Align::End)?;
    let title = text::shorten(panel.title.trim(), TICK_SIZE, frame.size().0);
    let above = (frame.at(0.5, 0.0).0, strip - placed.strip());
    page.draw(&words(&title, above, Font(TICK_SIZE, INK, Align::Middle)))?;
    let Some(bar) = bar else { return Ok(()) };
    factor(bar, (beside, strip), Align::Start)?;
    let column = Rect { left: beside, right: beside + BAR_WIDTH, ..*frame };
    let none = PlotAxis::new(&AxisSpec::default(), std::iter::empty(), None);
    let mut chart = build(page, &column, [&none, bar], [0.0, 0.0, right - BAR_GAP - BAR_WIDTH - EDGE])?;
    for step in 0..COLOR_STEPS {
        // Each step reaches up to the end of the bar, so that no seam shows between two.
        let bottom = column.at(0.0, step as f64 / COLOR_STEPS as f64);
        page.draw(&Rectangle::new([bottom, column.at(1.0, 1.0)], scale_color(step).filled()))?;
    }
    axes(page, &mut chart, [&none, bar], &column)
}

/// Returns the width that a colour bar needs to the right of a frame.
pub(super) fn bar_width(bar: &PlotAxis) -> f64 {
    let labels = LABEL_DISTANCE + bar.ticks.widest() + 6.0 + bar.label.height();
    BAR_GAP + BAR_WIDTH + labels.max(text::width(&bar.ticks.factor, NOTE_SIZE) - BAR_WIDTH - EDGE)
}
