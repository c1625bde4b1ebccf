//! Grid, tick marks and labels around a panel.

use super::axis::Axis;
use super::layout::Placed;
use super::palette::{FRAME, GRID_LINE, INK, LABEL_SIZE, NOTE_INK, NOTE_SIZE, TICK_LENGTH, TICK_SIZE};
use super::shape::{Align, Drawing, Pt, Text};
use super::text::{self, HALF_DIGIT, LINE_HEIGHT, Rich};
use super::ticks::Ticks;
use super::ticks::decimal::power_of_ten;

/// Height of the strip above a frame with factors and notes, and distance of its text from the frame.
pub(super) const STRIP: f64 = 22.0;
pub(super) const STRIP_GAP: f64 = 6.0;

/// Draws thin lines at the labelled marks.
pub(super) fn grid(drawing: &mut Drawing, placed: &Placed) {
    let frame = placed.frame;
    for tick in &placed.x_ticks.major {
        let x = crisp(frame.left + tick.at * frame.width());
        drawing.line((x, frame.top), (x, frame.bottom), GRID_LINE);
    }
    for tick in &placed.y_ticks.major {
        let y = crisp(frame.bottom - tick.at * frame.height());
        drawing.line((frame.left, y), (frame.right, y), GRID_LINE);
    }
}

/// Returns the middle of the nearest pixel, where a thin line is sharp.
fn crisp(value: f64) -> f64 {
    value.floor() + 0.5
}

/// Draws marks, labels, factors and notes.
pub(super) fn axes(drawing: &mut Drawing, placed: &Placed) {
    y_axis(drawing, placed);
    x_axis(drawing, placed);
    let frame = placed.frame;
    let strip = frame.top - STRIP_GAP;
    drawing.text(text((frame.left, strip), &placed.y_ticks.factor, NOTE_SIZE, Align::Start));
    let note = text((frame.right, strip), &placed.note(), NOTE_SIZE, Align::End);
    drawing.text(Text { color: NOTE_INK, ..note });
    let title = text::shorten(&placed.panel.title, TICK_SIZE, frame.width());
    drawing.text(text((frame.center().0, strip - placed.strip()), &title, TICK_SIZE, Align::Middle));
}

fn y_axis(drawing: &mut Drawing, placed: &Placed) {
    let frame = placed.frame;
    let place = |at: f64| crisp(frame.bottom - at * frame.height());
    marks(drawing, &placed.y_ticks, |at| (frame.left, place(at)), (-TICK_LENGTH, 0.0));
    for tick in &placed.y_ticks.major {
        let y = place(tick.at);
        let at = (frame.left - TICK_LENGTH - 4.0, y + HALF_DIGIT * TICK_SIZE);
        drawing.text(text(at, &tick.label, TICK_SIZE, Align::End));
    }
    let size = placed.y_label.size;
    let mut x = placed.y_label_at - placed.y_label.height() + size;
    for line in &placed.y_label.lines {
        drawing.text(turned((x, frame.center().1), line, size));
        x += LINE_HEIGHT * size;
    }
}

fn x_axis(drawing: &mut Drawing, placed: &Placed) {
    let frame = placed.frame;
    let place = |at: f64| (crisp(frame.left + at * frame.width()), frame.bottom);
    marks(drawing, &placed.x_ticks, place, (0.0, TICK_LENGTH));
    if placed.shows_x {
        x_texts(drawing, placed);
    }
}

/// Draws marks that begin at their positions, minor ones shorter.
fn marks(drawing: &mut Drawing, ticks: &Ticks, place: impl Fn(f64) -> Pt, (right, down): Pt) {
    let minor = ticks.minor.iter().map(|at| (*at, 0.55));
    for (at, part) in ticks.major.iter().map(|tick| (tick.at, 1.0)).chain(minor) {
        let (x, y) = place(at);
        drawing.line((x, y), (x + part * right, y + part * down), FRAME);
    }
}

fn x_texts(drawing: &mut Drawing, placed: &Placed) {
    let frame = placed.frame;
    let mut y = frame.bottom + TICK_LENGTH + 1.05 * TICK_SIZE;
    for tick in &placed.x_ticks.major {
        let x = frame.left + tick.at * frame.width();
        drawing.text(text((x, y), &tick.label, TICK_SIZE, Align::Middle));
    }
    y += 0.3 * TICK_SIZE + LABEL_SIZE;
    drawing.text(text((frame.right, y), &placed.x_ticks.factor, NOTE_SIZE, Align::End));
    for line in &placed.x_label.lines {
        drawing.text(text((frame.center().0, y), line, placed.x_label.size, Align::Middle));
        y += LINE_HEIGHT * placed.x_label.size;
    }
}

/// Returns a note on the values that a logarithmic axis draws at its floor.
pub(super) fn floor_note(axis: &Axis, name: &str, drawn: &str) -> Option<String> {
    let floor = axis.floor?;
    let values = match (name, floor.negative) {
        ("", false) => "0".to_string(),
        ("", true) => "values ≤ 0".to_string(),
        (name, false) => format!("{name} = 0"),
        (name, true) => format!("{name} ≤ 0"),
    };
    Some(format!("{values} {drawn} {}", power_of_ten(floor.exponent)))
}

/// Returns a horizontal line of text.
pub(super) fn text(at: Pt, line: &str, size: f64, align: Align) -> Text {
    Text { at, rich: Rich::new(line), size, color: INK, align, turned: false }
}

/// Returns a centred line of text that reads upwards.
pub(super) fn turned(at: Pt, line: &str, size: f64) -> Text {
    Text { turned: true, ..text(at, line, size, Align::Middle) }
}
