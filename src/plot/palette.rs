//! Colours, dashes, markers and sizes.

use super::*;
use plotters::style::colors::colormaps::{ColorMap, ViridisRGB};

pub(super) const TITLE_SIZE: f64 = 19.0;
pub(super) const LABEL_SIZE: f64 = 18.0;
pub(super) const TICK_SIZE: f64 = 16.0;
pub(super) const NOTE_SIZE: f64 = 14.5;
/// Distance of tick labels from the frame, twice the length of a mark, and length of a minor mark.
pub(super) const LABEL_DISTANCE: f64 = 11.0;
pub(super) const MINOR_LENGTH: f64 = 3.0;
pub(super) const MARKER_RADIUS: f64 = 4.2;
/// Free border around the figure.
pub(super) const EDGE: f64 = 8.0;

pub(super) const INK: Color = Color(26, 26, 26);
pub(super) const NOTE_INK: Color = Color(85, 85, 85);
pub(super) const PAPER: Color = Color(255, 255, 255);

pub(super) const FRAME: Stroke = Stroke { color: Color(51, 51, 51), width: 1.4, dash: &[] };
pub(super) const GRID: Stroke = Stroke { color: Color(228, 228, 228), width: 1.0, dash: &[] };
pub(super) const DASHED: &[f64] = &[5.0, 4.0];

/// Okabe and Ito's colours, those with the most contrast on white first, black last. Their yellow is omitted: a thin
/// yellow line on white cannot be seen.
pub(super) const COLORS: [Color; 7] = [
    Color(0, 114, 178),
    Color(213, 94, 0),
    Color(0, 158, 115),
    Color(230, 159, 0),
    Color(204, 121, 167),
    Color(86, 180, 233),
    Color(0, 0, 0),
];
const DASHES: [&[f64]; 4] = [&[], &[9.0, 4.0], &[2.4, 3.2], &[10.0, 3.5, 2.4, 3.5]];
pub(super) const SQUARE: Marker = Marker::Polygon(&[(-0.89, -0.89), (0.89, -0.89), (0.89, 0.89), (-0.89, 0.89)]);
/// Their areas are about equal.
const MARKERS: [Marker; 5] = [
    Marker::Circle,
    SQUARE,
    Marker::Polygon(&[(0.0, -1.3), (1.2, 0.85), (-1.2, 0.85)]),
    Marker::Polygon(&[(0.0, -1.35), (1.15, 0.0), (0.0, 1.35), (-1.15, 0.0)]),
    Marker::Polygon(&[(0.0, 1.3), (1.2, -0.85), (-1.2, -0.85)]),
];

/// Appearance of one series, in the panel and in the legend.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Look {
    pub line: Option<Stroke>,
    pub marker: Option<Marker>,
    pub color: Color,
}

/// Returns the appearance of the series of a panel. Of eight lines or more dashes alternate too: four patterns and seven
/// colours give 28 different lines, neighbours differing in both.
pub(super) fn looks(all: &[Series]) -> Vec<Look> {
    use Style::*;
    let has_own_pattern = |series: &&Series| !matches!(series.style, Dashed | Dotted | Guide | Crosses);
    let is_many = all.iter().filter(has_own_pattern).count() > COLORS.len();
    let look = |(index, Series { style, color, .. }): (usize, &Series)| {
        let place = color.unwrap_or(index);
        let color = if matches!(style, Guide | Crosses) { Color(130, 130, 130) } else { COLORS[place % COLORS.len()] };
        let pattern = if is_many { index % DASHES.len() } else { 0 };
        let dash = match style {
            Dashed => DASHES[pattern.max(1)],
            Dotted => DASHES[2],
            Guide => DASHED,
            _ => DASHES[pattern],
        };
        let width = if matches!(style, Thin | Guide) { 1.2 } else { 2.3 };
        let marker = match style {
            Crosses => Some(Marker::Cross),
            Dots | LineDots => Some(MARKERS[place % MARKERS.len()]),
            _ => None,
        };
        let line = (!matches!(style, Dots | Crosses)).then_some(Stroke { color, width, dash });
        Look { line, marker, color }
    };
    all.iter().enumerate().map(look).collect()
}

pub(super) fn mix(from: Color, to: Color, share: f64) -> Color {
    let part = |from: u8, to: u8| (f64::from(from) * (1.0 - share) + f64::from(to) * share).round() as u8;
    Color(part(from.0, to.0), part(from.1, to.1), part(from.2, to.2))
}

/// Number of colours of a colour scale: enough to look continuous, few enough to group by.
pub(super) const COLOR_STEPS: usize = 128;

/// Returns Viridis (van der Walt and Smith) at `step` of [`COLOR_STEPS`]. Its last yellow is cut off, being hard to see
/// on white.
pub(super) fn scale_color(step: usize) -> Color {
    ViridisRGB.get_color(0.96 * step.min(COLOR_STEPS - 1) as f64 / (COLOR_STEPS - 1) as f64)
}

/// Returns the colours of figures, mixed with paper and with ink as at soft edges: 239, for files with a palette.
#[cfg(feature = "figures")]
pub(super) fn shades() -> Vec<[u8; 3]> {
    let pale = |color| (0..24).map(move |k| mix(color, PAPER, f64::from(k) / 24.0));
    let dark = |color| (1..11).map(move |k| mix(color, INK, f64::from(k) / 11.0));
    let all = [PAPER].into_iter().chain(COLORS.into_iter().flat_map(|color| pale(color).chain(dark(color))));
    all.map(|Color(red, green, blue)| [red, green, blue]).collect()
}
