//! SVG files.
//!
//! Text stays text, so it can be searched and edited; fonts of nearly the same widths are named for viewers without
//! DejaVu Sans.

use super::*;

const FONTS: &str = "DejaVu Sans, Bitstream Vera Sans, Verdana, Geneva, sans-serif";

pub(super) fn render(drawing: &Drawing) -> String {
    let width = number(drawing.width);
    let height = number(drawing.height);
    let mut out = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}\" height=\"{height}\" viewBox=\"0 0 {width} {height}\" \
         role=\"img\" xml:space=\"preserve\" font-family=\"{FONTS}\" stroke-linejoin=\"round\">\n"
    );
    if !drawing.title.is_empty() {
        out += &format!("<title>{}</title>\n", escape(&drawing.title));
    }
    out += &format!("<rect width=\"{width}\" height=\"{height}\" fill=\"#ffffff\"/>\n");
    drawing.shapes.iter().for_each(|one| shape(&mut out, one));
    out + "</svg>\n"
}

/// Returns an animation of which `frames` are shown in a loop, each for `delay` seconds.
pub(super) fn animate(still: &Drawing, frames: &[Vec<Shape>], delay: f64) -> String {
    let mut out = render(still).trim_end_matches("</svg>\n").to_string();
    let count = frames.len() as f64;
    let whole = delay * count;
    for (k, frame) in frames.iter().enumerate() {
        let from = k as f64 / count;
        let to = (k + 1) as f64 / count;
        // Viewers without animation show the first frame.
        let first = if k == 0 { "inline" } else { "none" };
        out += &format!(
            "<g display=\"{first}\">\n<animate attributeName=\"display\" calcMode=\"discrete\" values=\"none;inline;none\" \
             keyTimes=\"0;{from:.6};{to:.6}\" dur=\"{whole:.4}s\" repeatCount=\"indefinite\"/>\n"
        );
        frame.iter().for_each(|one| shape(&mut out, one));
        out += "</g>\n";
    }
    out + "</svg>\n"
}

fn shape(out: &mut String, shape: &Shape) {
    match shape {
        Shape::Text(line) => text(out, line),
        Shape::Drawn(paint @ Paint::Disc(..), lines) => {
            let dots = lines.iter().flatten().map(|(x, y)| vec![(*x, *y), (x + 0.1, *y)]);
            *out += &format!("<path {} d=\"{}\"/>\n", style(paint), data(&dots.collect::<Vec<_>>()));
        }
        Shape::Drawn(paint, lines) => *out += &format!("<path {} d=\"{}\"/>\n", style(paint), data(lines)),
    }
}

fn style(paint: &Paint) -> String {
    let line = |color, width| format!("fill=\"none\" stroke=\"{}\" stroke-width=\"{}\"", hex(color), number(width));
    match paint {
        Paint::Line(Stroke { color, width, dash: [] }) => line(color, *width),
        Paint::Line(Stroke { color, width, dash }) => {
            let dash: Vec<String> = dash.iter().map(|length| number(*length)).collect();
            format!("{} stroke-dasharray=\"{}\"", line(color, *width), dash.join(" "))
        }
        // A thin border of the same colour: without it, viewers show bright seams between cells.
        Paint::Area(color, _, true) => format!("fill=\"{0}\" stroke=\"{0}\" stroke-width=\".4\"", hex(color)),
        Paint::Area(color, 1.0, _) => format!("fill=\"{}\"", hex(color)),
        Paint::Area(color, opacity, _) => format!("fill=\"{}\" fill-opacity=\"{}\"", hex(color), number(*opacity)),
        Paint::Disc(color, radius) => line(color, 2.0 * radius) + " stroke-linecap=\"round\"",
    }
}

fn text(out: &mut String, text: &Text) {
    let Font(size, color, align) = text.font;
    let anchor = ["start", "middle", "end"][align as usize];
    let x = number(text.at.0);
    let y = number(text.at.1);
    let upright = format!("x=\"{x}\" y=\"{y}\"");
    let place = if text.turned { format!("transform=\"translate({x} {y}) rotate(-90)\"") } else { upright };
    let color = hex(&color);
    *out += &format!("<text {place} font-size=\"{}\" fill=\"{color}\" text-anchor=\"{anchor}\">", number(size));
    let mut level = 0.0;
    for (rise, run) in &text.rich.0 {
        let (size, down) = text::metrics(*rise, size);
        let step = number(down - level);
        let is_plain = *rise == 0.0 && level == 0.0;
        let run = escape(run);
        let tspan = format!("<tspan dy=\"{step}\" font-size=\"{}\">{run}</tspan>", number(size));
        *out += if is_plain { &run } else { &tspan };
        level = down;
    }
    *out += "</text>\n";
}

/// Returns path data: steps in tenths of a pixel that add up without drift. Pairs that follow a move are lines.
fn data(lines: &[Vec<Pt>]) -> String {
    let mut out = String::new();
    let mut pen = [0; 2];
    for line in lines {
        let mut before = "m";
        for (x, y) in line {
            for (pen, value) in pen.iter_mut().zip([x, y]) {
                let next = (10.0 * value).round() as i64;
                let step = number((next - *pen) as f64 / 10.0);
                out += if before == " " && step.starts_with('-') { "" } else { before };
                out += &step;
                *pen = next;
                before = " ";
            }
        }
        out += if is_closed(line) { "z" } else { "" };
    }
    out
}

/// Returns a number with at most two digits after the point, and no zeros that say nothing.
fn number(value: f64) -> String {
    let text = format!("{value:.2}");
    match text.trim_end_matches('0').trim_end_matches('.') {
        "-0" => "0".to_string(),
        short if value.abs() < 1.0 => short.replacen("0.", ".", 1),
        short => short.to_string(),
    }
}

fn hex(color: &Color) -> String {
    format!("#{:02x}{:02x}{:02x}", color.0, color.1, color.2)
}

/// Returns text that is safe in XML; characters that XML forbids become spaces or the replacement character.
fn escape(text: &str) -> String {
    let plain = |character: char| match character {
        '\u{fffe}' | '\u{ffff}' => '\u{fffd}',
        _ if character.is_control() => ' ',
        _ => character,
    };
    text.chars().map(plain).collect::<String>().replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn paths_are_short() {
        assert_eq!(data(&[vec![(1.0, 2.0), (1.5, 1.0), (0.0, 3.25)]]), "m1 2 .5-1-1.5 2.3");
        assert_eq!(data(&[vec![(1.0, 1.0), (3.0, 1.0), (3.0, 0.0), (4.0, 1.0), (1.0, 1.0)]]), "m1 1 2 0 0-1 1 1-3 0z");
        assert_eq!(number(-0.001), "0");
        assert_eq!(escape("a<b & \u{1}\u{ffff}"), "a&lt;b &amp;  \u{fffd}");
    }
}
