//! The chart of a panel, drawn by plotters: grid, marks, labels, frame, colour bar; and the texts above it.

use super::sketch::{Sketch, units};
use super::*;
use plotters::chart::{ChartBuilder, MeshStyle};
use plotters::coord::combinators::{BindKeyPoints, WithKeyPoints};
use plotters::coord::types::RangedCoordi32;
use plotters::drawing::IntoDrawingArea;
use std::collections::BTreeMap;

/// Distance of factors from the frame, to their middle.
const STRIP_GAP: f64 = 11.0;
/// Distance of the colour bar from the frame, and its width.
const BAR_GAP: f64 = 12.0;
const BAR_WIDTH: f64 = 16.0;

/// A coordinate along an axis, in units of the backend.
type Along = WithKeyPoints<RangedCoordi32>;
/// Draws the mesh of a chart with the labelled marks of its axes or the others, and room at the left of its frame, below
/// and at the right.
fn mesh(
    out: &mut Shapes,
    stroke: Stroke,
    frame: &Rect,
    [x, y]: [&Axis; 2],
    is_labelled: bool,
    [left, below, right]: [f64; 3],
    set: impl Fn(&mut MeshStyle<Along, Along, Sketch>),
) {
    let sketch = Sketch::new(std::mem::take(out), stroke);
    let [width, height] = [frame.size().0, frame.size().1].map(units);
    let [left, below, right] = [left, below, right].map(units);
    // The last position is within the area.
    let size = (left + width + right + 1, height + below + 1);
    let page = sketch.clone().into_drawing_area().shrink((units(frame.left) - left, units(frame.top)), size);
    let marks = |axis: &Axis, length: i32| -> BTreeMap<i32, String> {
        let minor = axis.ticks.minor.iter().map(|value| (*value, String::new()));
        let ticks = if is_labelled { axis.ticks.major.clone() } else { minor.collect() };
        // Rounding places none beyond the ends.
        let place = |value| Some((f64::from(length) * axis.place(value)?.clamp(0.0, 1.0)).round() as i32);
        ticks.into_iter().filter_map(|(value, label)| Some((place(value)?, label))).collect()
    };
    let [across, up] = [marks(x, width), marks(y, height)];
    let along = |end: i32, marks: &BTreeMap<i32, _>| (0..end).with_key_points(marks.keys().copied().collect());
    let mut builder = ChartBuilder::on(&page);
    builder.y_label_area_size(left).x_label_area_size(below).right_y_label_area_size(right);
    let drawn = builder.build_cartesian_2d(along(width, &across), along(height, &up)).and_then(|mut chart| {
        let on_x = |place: &i32| across.get(place).cloned().unwrap_or_default();
        let on_y = |place: &i32| up.get(place).cloned().unwrap_or_default();
        let mut mesh = chart.configure_mesh();
        set(mesh.x_label_formatter(&on_x).y_label_formatter(&on_y));
        mesh.draw()
    });
    // A sketch refuses nothing.
    drawn.unwrap_or_default();
    *out = sketch.shapes.take();
}

/// Draws thin lines at the labelled marks.
pub(super) fn grid(out: &mut Shapes, placed: &Placed) {
    mesh(out, GRID, &placed.frame, [&placed.x, &placed.y], true, [0.0; 3], |_| {});
}

/// Draws marks, labels, titles and the frame of axes.
fn axes(out: &mut Shapes, both: [&Axis; 2], frame: &Rect, room: [f64; 3]) {
    let [x, y] = both.map(|axis| &axis.label);
    let font = |size: f64| ("DejaVu Sans", units(size), &INK);
    mesh(out, FRAME, frame, both, true, room, |mesh| {
        mesh.disable_mesh().set_all_tick_mark_size(units(0.5 * LABEL_DISTANCE)).label_style(font(TICK_SIZE));
        mesh.axis_desc_style(font(x.size)).x_desc(&x.text);
    });
    mesh(out, FRAME, frame, both, false, room, |mesh| {
        mesh.disable_mesh().set_all_tick_mark_size(units(MINOR_LENGTH));
        mesh.axis_desc_style(font(y.size)).y_desc(&y.text);
    });
    out.frame(frame, FRAME);
}

/// Draws the axes with the texts around them, and the colour bar as a chart of its own.
pub(super) fn draw(out: &mut Shapes, placed: &Placed) {
    let Placed { panel, x, y, bar, frame, margins: (left, right), .. } = placed;
    axes(out, [x, y], frame, [*left, placed.below() - 0.5, 0.0]);
    let strip = frame.top - STRIP_GAP;
    let beside = frame.right + BAR_GAP;
    let mut factor = |axis: &Axis, at, align| out.text(&axis.ticks.factor, at, Font(NOTE_SIZE, INK, align));
    factor(y, (frame.left, strip), Align::Start);
    bar.iter().for_each(|bar| factor(bar, (beside, strip), Align::Start));
    factor(x, (frame.right, frame.bottom + LABEL_DISTANCE + 2.0 * TICK_SIZE), Align::End);
    let title = text::shorten(panel.title.trim(), TICK_SIZE, frame.size().0);
    out.text(&title, (frame.at(0.5, 0.0).0, strip - placed.strip()), Font(TICK_SIZE, INK, Align::Middle));
    let Some(bar) = bar else { return };
    let column = Rect { left: beside, right: beside + BAR_WIDTH, ..*frame };
    for step in 0..COLOR_STEPS {
        // Each step reaches up to the end of the bar, so that no seam shows between two.
        let bottom = column.at(0.0, step as f64 / COLOR_STEPS as f64).1;
        out.draw(Paint::Area(scale_color(step), 1.0, true), Rect { bottom, ..column }.corners());
    }
    axes(out, [&Axis::default(), bar], &column, [0.0, 0.0, right - BAR_GAP - BAR_WIDTH - EDGE]);
}

/// Returns the width that a colour bar needs to the right of a frame.
pub(super) fn bar_width(bar: &Axis) -> f64 {
    let labels = LABEL_DISTANCE + bar.ticks.widest() + 6.0 + bar.label.height();
    BAR_GAP + BAR_WIDTH + labels.max(text::width(&bar.ticks.factor, NOTE_SIZE) - BAR_WIDTH - EDGE)
}
