//! A picture as SVG text.
//!
//! Written here rather than with plotters' backend, whose coordinates are whole numbers and which has neither
//! dashes nor raised text. Text stays text, so it can be searched and edited; fonts of nearly the same widths
//! are named for viewers without DejaVu Sans.

use std::fmt::Write;

use super::font;
use super::shape::{Align, Color, Drawing, Marker, Pt, Rect, Shape, Stroke, Text};

const FONTS: &str = "DejaVu Sans, Bitstream Vera Sans, Verdana, Geneva, sans-serif";

/// The whole file.
pub(super) fn render(drawing: &Drawing) -> String {
    let mut out = opening(drawing);
    drawing.shapes.iter().for_each(|one| shape(&mut out, one));
    out.push_str("</svg>\n");
    out
}

/// The root element with title and paper.
fn opening(drawing: &Drawing) -> String {
    let (width, height) = (number(drawing.width), number(drawing.height));
    let mut out = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}\" height=\"{height}\" \
         viewBox=\"0 0 {width} {height}\" role=\"img\" font-family=\"{FONTS}\">\n"
    );
    if !drawing.title.is_empty() {
        push(&mut out, format_args!("<title>{}</title>\n", escape(&drawing.title)));
    }
    push(&mut out, format_args!("<rect width=\"{width}\" height=\"{height}\" fill=\"#ffffff\"/>\n"));
    out
}

fn shape(out: &mut String, shape: &Shape) {
    match shape {
        Shape::Path { points, stroke } => path(out, points, stroke),
        Shape::Area { points, fill, opacity } => {
            let (color, opacity, data) = (hex(*fill), number(*opacity), outline(points));
            push(out, format_args!("<path fill=\"{color}\" fill-opacity=\"{opacity}\" d=\"{data}\"/>\n"));
        }
        Shape::Rects { rects, fill } => rectangles(out, rects, *fill),
        Shape::Marks { at, marker, radius, color } => marks(out, at, *marker, *radius, *color),
        Shape::Text(line) => text(out, line),
    }
}

/// A picture of which `frames` are shown one after another, again and again, each for `delay` seconds.
pub(super) fn animate(still: &Drawing, frames: &[Vec<Shape>], delay: f64) -> String {
    let mut out = opening(still);
    still.shapes.iter().for_each(|one| shape(&mut out, one));
    let (count, whole) = (frames.len(), delay * frames.len() as f64);
    for (k, frame) in frames.iter().enumerate() {
        let (from, to) = (k as f64 / count as f64, (k + 1) as f64 / count as f64);
        // Viewers without animation show the first frame.
        let (first, values, times) = match k {
            0 => ("inline", "inline;none".to_string(), format!("0;{to:.6}")),
            _ if k + 1 == count => ("none", "none;inline".to_string(), format!("0;{from:.6}")),
            _ => ("none", "none;inline;none".to_string(), format!("0;{from:.6};{to:.6}")),
        };
        push(&mut out, format_args!("<g display=\"{first}\">\n"));
        if count > 1 {
            push(
                &mut out,
                format_args!(
                    "<animate attributeName=\"display\" calcMode=\"discrete\" values=\"{values}\" \
                     keyTimes=\"{times}\" dur=\"{whole:.4}s\" repeatCount=\"indefinite\"/>\n"
                ),
            );
        }
        frame.iter().for_each(|one| shape(&mut out, one));
        out.push_str("</g>\n");
    }
    out.push_str("</svg>\n");
    out
}

/// Writing to a string cannot fail.
fn push(out: &mut String, arguments: std::fmt::Arguments) {
    let _ = out.write_fmt(arguments);
}

fn path(out: &mut String, points: &[Pt], stroke: &Stroke) {
    let (color, width) = (hex(stroke.color), number(stroke.width));
    let dash: Vec<String> = stroke.dash.iter().map(|length| number(*length)).collect();
    let dash = if dash.is_empty() { String::new() } else { format!(" stroke-dasharray=\"{}\"", dash.join(" ")) };
    let joined = if points.len() > 2 { " stroke-linejoin=\"round\"" } else { "" };
    let data = outline(points);
    push(
        out,
        format_args!("<path fill=\"none\" stroke=\"{color}\" stroke-width=\"{width}\"{dash}{joined} d=\"{data}\"/>\n"),
    );
}

/// Cells get a thin border of their own colour: without it, viewers show bright seams between them.
fn rectangles(out: &mut String, rects: &[Rect], fill: Color) {
    let data: String = rects.iter().map(|rect| outline(&rect.outline())).collect();
    let color = hex(fill);
    push(out, format_args!("<path fill=\"{color}\" stroke=\"{color}\" stroke-width=\".4\" d=\"{data}\"/>\n"));
}

fn marks(out: &mut String, at: &[Pt], marker: Marker, radius: f64, color: Color) {
    let color = hex(color);
    if marker == Marker::Circle {
        let width = number(2.0 * radius);
        let cap = "stroke-linecap=\"round\"";
        let data = dots(at);
        push(
            out,
            format_args!("<path fill=\"none\" stroke=\"{color}\" stroke-width=\"{width}\" {cap} d=\"{data}\"/>\n"),
        );
        return;
    }
    let paths = |center: &Pt| -> String { marker.outlines(*center, radius).iter().map(|line| outline(line)).collect() };
    let data: String = at.iter().map(paths).collect();
    match marker.stroke_width(radius) {
        Some(width) => push(
            out,
            format_args!("<path fill=\"none\" stroke=\"{color}\" stroke-width=\"{}\" d=\"{data}\"/>\n", number(width)),
        ),
        None => push(out, format_args!("<path fill=\"{color}\" d=\"{data}\"/>\n")),
    }
}

fn text(out: &mut String, text: &Text) {
    let anchor = match text.align {
        Align::Start => "start",
        Align::Middle => "middle",
        Align::End => "end",
    };
    let (x, y) = (number(text.at.0), number(text.at.1));
    let place = if text.turned {
        format!("transform=\"translate({x} {y}) rotate(-90)\"")
    } else {
        format!("x=\"{x}\" y=\"{y}\"")
    };
    let (size, color) = (number(text.size), hex(text.color));
    push(out, format_args!("<text {place} font-size=\"{size}\" fill=\"{color}\" text-anchor=\"{anchor}\">"));
    let (mut level, mut gap) = (0.0, 0.0);
    for run in &text.rich.runs {
        let (size, down) = run.level.metrics(text.size);
        // Viewers drop spaces beside a raised part, so these become steps.
        let inner = run.text.trim_start_matches(' ');
        gap += spaces(run.text.len() - inner.len(), size);
        let word = inner.trim_end_matches(' ');
        if size == text.size && down == level && gap == 0.0 {
            out.push_str(&escape(word));
        } else {
            let (right, step, size) = (number(gap), number(down - level), number(size));
            push(
                out,
                format_args!("<tspan dx=\"{right}\" dy=\"{step}\" font-size=\"{size}\">{}</tspan>", escape(word)),
            );
        }
        (level, gap) = (down, spaces(inner.len() - word.len(), size));
    }
    out.push_str("</text>\n");
}

/// Width of so many spaces.
fn spaces(count: usize, size: f64) -> f64 {
    count as f64 * font::width(" ") * size
}

/// Path data: absolute start, then steps in tenths of a pixel that add up without drift.
fn outline(points: &[Pt]) -> String {
    let grid = |point: &Pt| (tenths(point.0), tenths(point.1));
    let Some(first) = points.first() else {
        return String::new();
    };
    let mut at = grid(first);
    let mut data = format!("M{}{}l", tenths_text(at.0, false), tenths_text(at.1, true));
    let mut leading = true;
    for point in &points[1..] {
        let next = grid(point);
        data.push_str(&tenths_text(next.0 - at.0, !leading));
        data.push_str(&tenths_text(next.1 - at.1, true));
        (at, leading) = (next, false);
    }
    if points.len() > 2 && points.first() == points.last() {
        data.push('z');
    }
    data
}

/// Discs as strokes a tenth of a pixel long with round ends: a quarter of the bytes of circles.
fn dots(at: &[Pt]) -> String {
    let mut data = String::new();
    let mut pen = (0, 0);
    for (x, y) in at {
        let next = (tenths(*x), tenths(*y));
        let step = (tenths_text(next.0 - pen.0, false), tenths_text(next.1 - pen.1, true));
        data.push_str(&format!("m{}{}h.1", step.0, step.1));
        pen = (next.0 + 1, next.1);
    }
    data
}

fn tenths(value: f64) -> i64 {
    (10.0 * value).round() as i64
}

/// A number of tenths, after a space if it needs one to be told from the number before.
fn tenths_text(value: i64, follows: bool) -> String {
    let sign = if value < 0 {
        "-"
    } else if follows {
        " "
    } else {
        ""
    };
    let (whole, rest) = (value.unsigned_abs() / 10, value.unsigned_abs() % 10);
    match (whole, rest) {
        (whole, 0) => format!("{sign}{whole}"),
        (0, rest) => format!("{sign}.{rest}"),
        (whole, rest) => format!("{sign}{whole}.{rest}"),
    }
}

/// At most two digits after the point, none when they are zero.
fn number(value: f64) -> String {
    let text = format!("{value:.2}");
    let short = text.trim_end_matches('0').trim_end_matches('.');
    if short == "-0" { "0".to_string() } else { short.to_string() }
}

fn hex(color: Color) -> String {
    format!("#{:02x}{:02x}{:02x}", color.0, color.1, color.2)
}

/// Text that is safe in XML; characters that XML forbids become the replacement character.
fn escape(text: &str) -> String {
    let mut safe = String::with_capacity(text.len());
    for character in text.chars() {
        match character {
            '&' => safe.push_str("&amp;"),
            '<' => safe.push_str("&lt;"),
            '>' => safe.push_str("&gt;"),
            '\u{fffe}' | '\u{ffff}' => safe.push('\u{fffd}'),
            _ if character.is_control() => safe.push(' '),
            _ => safe.push(character),
        }
    }
    safe
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn paths_are_short() {
        assert_eq!(outline(&[(1.0, 2.0), (1.5, 1.0), (0.0, 3.25)]), "M1 2l.5-1-1.5 2.3");
        assert_eq!(number(-0.001), "0");
        assert_eq!(escape("a<b & \u{1}\u{ffff}"), "a&lt;b &amp;  \u{fffd}");
    }
}
