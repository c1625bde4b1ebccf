//! Vertical lines, their labels, and annotations.

use super::axes;
use super::layout::Placed;
use super::legend::Taken;
use super::palette::{NOTE_INK, NOTE_SIZE, PAPER, REFERENCE, tint};
use super::shape::{Align, Color, Drawing, Pt, Rect, Shape, Text};
use super::text::HALF_DIGIT;

/// Draws the vertical lines and returns them.
pub(super) fn verticals(drawing: &mut Drawing, placed: &Placed) -> Vec<Shape> {
    let frame = placed.frame;
    let line = |at: f64| {
        let x = placed.at(at, placed.y.middle())?.0;
        let points = vec![(x, frame.top), (x, frame.bottom)];
        frame.contains(points[0]).then_some(Shape::Path { points, stroke: REFERENCE })
    };
    let lines: Vec<Shape> = placed.panel.verticals.iter().filter_map(|(at, _)| line(*at)).collect();
    drawing.shapes.extend(lines.iter().cloned());
    lines
}

/// Draws the labels of vertical lines and annotations, each where it hides least.
pub(super) fn texts(drawing: &mut Drawing, placed: &Placed, taken: &mut Taken) {
    for (x, label) in placed.panel.verticals.iter().filter(|line| !line.1.trim().is_empty()) {
        if let Some(at) = placed.at(*x, placed.y.middle()).filter(|at| placed.frame.contains(*at)) {
            let choices = beside_line(&placed.frame, at.0, label);
            settle(drawing, placed, choices, taken, NOTE_INK);
        }
    }
    for note in &placed.panel.annotations {
        if let Some(at) = placed.at(note.x, note.y).filter(|at| placed.frame.contains(*at)) {
            settle(drawing, placed, around(at, &note.text), taken, tint(note.tint));
        }
    }
}

/// Draws the text that hides least, the first of equals; on a map, in a box of paper colour.
fn settle(drawing: &mut Drawing, placed: &Placed, choices: Vec<Text>, taken: &mut Taken, color: Color) {
    let inside = |text: &&Text| placed.frame.holds(&text.bounds());
    let best = choices.iter().filter(inside).min_by_key(|text| taken.cover(&text.bounds(), 2.0)).or(choices.first());
    let Some(text) = best else { return };
    taken.rects.push(text.bounds());
    drawing.fill(text.bounds().grown(1.5), PAPER);
    drawing.text(Text { color, ..text.clone() });
}

/// Returns positions along a vertical line, ends first, on both sides of it.
fn beside_line(frame: &Rect, x: f64, label: &str) -> Vec<Text> {
    let place = |part: f64| {
        let y = frame.bottom - 0.5 * NOTE_SIZE - part * (frame.height() - 1.6 * NOTE_SIZE);
        [(x + 6.0, Align::Start), (x - 6.0, Align::End)].map(|(x, align)| axes::text((x, y), label, NOTE_SIZE, align))
    };
    [1.0, 0.0, 0.5, 0.85, 0.15, 0.7, 0.3, 0.6, 0.4].into_iter().flat_map(place).collect()
}

/// Returns positions around a point, near ones first.
fn around((x, y): Pt, label: &str) -> Vec<Text> {
    const SIDES: [(f64, f64, Align); 8] = [
        (1.0, 0.0, Align::Start),
        (-1.0, 0.0, Align::End),
        (0.0, -1.0, Align::Middle),
        (0.0, 1.0, Align::Middle),
        (0.8, -0.8, Align::Start),
        (-0.8, -0.8, Align::End),
        (0.8, 0.8, Align::Start),
        (-0.8, 0.8, Align::End),
    ];
    let place = |distance: f64, (right, down, align): (f64, f64, Align)| {
        // Below a point the text is lower by its height; above, its baseline is at the point.
        let y = y + distance * down + HALF_DIGIT * NOTE_SIZE * (1.0 + down);
        axes::text((x + distance * right, y), label, NOTE_SIZE, align)
    };
    [9.0, 18.0].into_iter().flat_map(|distance| SIDES.map(|side| place(distance, side))).collect()
}
