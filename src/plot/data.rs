//! The data of a panel: lines, points, coloured points and bands.

use super::*;
use plotters::coord::CoordTranslate;
use plotters::drawing::DrawingArea;
use plotters::element::{Circle, Cross, EmptyElement};

/// Largest number of points of one figure, so that its file stays small.
const LINE_POINTS: usize = 16_000;
const DOTS: usize = 12_000;
/// Coloured points need more space, each colour being a shape of its own.
const COLORED: usize = 4_000;
/// Least distance of markers along a line.
const MARKER_DISTANCE: f64 = 16.0;
const DOT_RADIUS: f64 = 2.7;
/// A line that changes its vertical direction by more than this, in pixels, more often than once in this many pixels,
/// is restless.
const RESTLESS: f64 = 4.0;

/// Shape of a point.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Marker {
    Circle,
    Square,
    Triangle,
    Diamond,
    TriangleDown,
    Cross,
}

impl Marker {
    /// Draws markers on an area, at points of its coordinates. Areas of all shapes are about equal.
    pub fn draw<CT: CoordTranslate>(
        self,
        area: &DrawingArea<Sketch, CT>,
        at: impl IntoIterator<Item = CT::From>,
        radius: f64,
        color: Color,
    ) -> Done {
        let corners: &[Pt] = match self {
            Self::Circle | Self::Cross => &[],
            Self::Square => &[(-0.89, -0.89), (0.89, -0.89), (0.89, 0.89), (-0.89, 0.89)],
            Self::Triangle => &[(0.0, -1.3), (1.2, 0.85), (-1.2, 0.85)],
            Self::TriangleDown => &[(0.0, 1.3), (1.2, -0.85), (-1.2, -0.85)],
            Self::Diamond => &[(0.0, -1.35), (1.15, 0.0), (0.0, 1.35), (-1.15, 0.0)],
        };
        let polygon = || corners.iter().map(|(x, y)| units((radius * x, radius * y))).collect::<Vec<_>>();
        let (size, width) = units((radius, 0.42 * radius));
        at.into_iter().try_for_each(|point| match self {
            Self::Circle => area.draw(&Circle::new(point, size, color.filled())),
            Self::Cross => area.draw(&Cross::new(point, size * 9 / 10, color.stroke_width(width as u32))),
            _ => area.draw(&(EmptyElement::at(point) + Polygon::new(polygon(), color))),
        })
    }
}

/// Draws bands, cut off at the frame; infinite values lie beyond it.
pub(super) fn bands(chart: &Chart, placed: &Placed) -> Done {
    let place = |axis: &Axis, value: f64| axis.place(value).unwrap_or(value.signum()).clamp(-1.0, 2.0);
    let at = |x: f64, y: f64| placed.frame.at(place(&placed.x, x), place(&placed.y, y));
    for band in &placed.panel.bands {
        let known =
            || band.points.iter().filter(|point| ![point.0, point.1, point.2].iter().any(|value| value.is_nan()));
        let upper = known().rev().map(|point| at(point.0, point.2));
        let outline: Vec<Pt> = known().map(|point| at(point.0, point.1)).chain(upper).collect();
        let corners = clip::polygon(&outline, &placed.frame).into_iter().map(|corner| placed.values(corner));
        chart.plotting_area().draw(&Polygon::new(corners.collect::<Vec<_>>(), tint(band.tint)))?;
    }
    Ok(())
}

/// Draws lines and points of a panel, in a figure of `count` series: restless lines below calm ones, then markers, then
/// coloured points.
pub(super) fn series(chart: &Chart, placed: &Placed, count: usize) -> Done {
    let series = placed.panel.series.iter().zip(&placed.looks);
    let all: Vec<(&Series, &Look, Vec<Vec<Pt>>)> = series.map(|(one, look)| (one, look, runs(placed, one))).collect();
    let lines = all.iter().filter_map(|(_, look, runs)| Some(lines(placed, look.line?, runs, count)));
    let (restless, calm): (Vec<_>, Vec<_>) = lines.partition(|(is_restless, ..)| *is_restless);
    for (_, stroke, parts) in restless.into_iter().chain(calm) {
        for part in parts {
            let points = part.into_iter().map(|point| placed.values(point)).collect();
            chart.plotting_area().draw(&Curve(points, stroke))?;
        }
    }
    all.iter().try_for_each(|(series, look, runs)| markers(chart, placed, series, look, runs, count))?;
    colored(chart, placed)
}

/// Returns the points in the picture, split where one of them is not a number.
fn runs(placed: &Placed, series: &Series) -> Vec<Vec<Pt>> {
    let places: Vec<Option<Pt>> = series.points.iter().map(|point| placed.at(point.0, point.1)).collect();
    places.split(Option::is_none).map(|run| run.iter().flatten().copied().collect::<Vec<Pt>>()).collect()
}

/// Returns the lines of a series with their stroke, and true if they are restless: these are thin, since at full width
/// they would be one blot.
fn lines(placed: &Placed, mut stroke: Stroke, runs: &[Vec<Pt>], count: usize) -> (bool, Stroke, Vec<Vec<Pt>>) {
    let full = runs.iter().map(Vec::len).sum::<usize>().max(1);
    let most = |run: &[Pt]| ((LINE_POINTS / count).max(200) * run.len() / full).max(8);
    let thinned = runs.iter().map(|run| clip::polyline(&thin::line(run, most(run)), &placed.frame));
    let parts: Vec<Vec<Pt>> = thinned.flatten().collect();
    let is_restless = parts.iter().map(|part| turns(part)).sum::<usize>() as f64 > placed.frame.size().0 / RESTLESS;
    stroke.width *= if is_restless { 0.5 } else { 1.0 };
    (is_restless, stroke, parts)
}

/// Returns how often a line changes its vertical direction visibly.
fn turns(points: &[Pt]) -> usize {
    let steps = points.windows(2).map(|pair| pair[1].1 - pair[0].1).filter(|step| step.abs() > RESTLESS);
    let signs: Vec<bool> = steps.map(|step| step > 0.0).collect();
    signs.windows(2).filter(|pair| pair[0] != pair[1]).count()
}

fn markers(chart: &Chart, placed: &Placed, series: &Series, look: &Look, runs: &[Vec<Pt>], count: usize) -> Done {
    // A single point between two gaps has no line; a dot of the line's width would be missed.
    let marked = runs.iter().filter(|run| look.marker.is_some() || run.len() == 1);
    let points: Vec<Pt> = marked.flatten().copied().filter(|point| placed.frame.contains(*point)).collect();
    let kept = match series.style {
        Style::LineDots => spaced(&points),
        _ => thin::dots(&points, (DOTS / count).max(60)).into_iter().map(|i| points[i]).collect(),
    };
    let crowd = usize::from(kept.len() > 150) + usize::from(kept.len() > 2000);
    let radius = if look.marker.is_some() { MARKER_RADIUS * [1.0, 0.6, 0.35][crowd] } else { DOT_RADIUS };
    let at = kept.into_iter().map(|point| placed.values(point));
    look.marker.unwrap_or(Marker::Circle).draw(chart.plotting_area(), at, radius, look.color)
}

/// Returns points at least [`MARKER_DISTANCE`] from the one before.
fn spaced(points: &[Pt]) -> Vec<Pt> {
    let mut kept: Vec<Pt> = Vec::new();
    for (x, y) in points {
        if kept.last().is_none_or(|last| (x - last.0).hypot(y - last.1) >= MARKER_DISTANCE) {
            kept.push((*x, *y));
        }
    }
    kept
}

/// Draws points coloured by value, in their order, so that later ones stay on top.
fn colored(chart: &Chart, placed: &Placed) -> Done {
    let points = placed.panel.color_series.iter().flat_map(|series| &series.points);
    let step = |value: f64| placed.bar.as_ref()?.step(value);
    let known = points.filter_map(|point| Some((placed.at(point.0, point.1)?, step(point.2)?)));
    let (places, steps): (Vec<Pt>, Vec<usize>) = known.filter(|(point, _)| placed.frame.contains(*point)).unzip();
    let mut kept = thin::dots(&places, COLORED);
    if kept.chunk_by(|a, b| steps[*a] == steps[*b]).count() > COLORED / 4 {
        // Colours without order: grouping them all keeps the file small, and which is on top is arbitrary anyway.
        kept.sort_by_key(|i| steps[*i]);
    }
    let dot = |i: usize| ([placed.values(places[i])], DOT_RADIUS, scale_color(steps[i]));
    kept.into_iter().map(dot).try_for_each(|(at, r, color)| Marker::Circle.draw(chart.plotting_area(), at, r, color))
}
