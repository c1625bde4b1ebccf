//! The series of a panel: lines and points.

use super::*;
use crate::math::polyline;

/// A line that changes its vertical direction by more than this, in pixels, more often than once in this many pixels,
/// is restless.
const RESTLESS: f64 = 4.0;

/// Shape of a point; polygons have their corners in radii.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Marker {
    Circle,
    Cross,
    Polygon(&'static [Pt]),
}

impl Marker {
    pub fn draw(self, page: &Page, (x, y): Pt, radius: f64, color: Color) -> Done {
        let at = |(right, down): &Pt| (x + radius * right, y + radius * down);
        match self {
            Self::Circle => page.draw(&Circle::new((x, y), units(radius), color.filled())),
            Self::Polygon(corners) => page.draw(&Polygon::new(corners.iter().map(at).collect::<Vec<_>>(), color)),
            Self::Cross => {
                let stroke = Stroke { color, width: 0.42 * radius, dash: &[] };
                page.draw(&Cross::new((x, y), units(0.86 * radius), line(stroke)))
            }
        }
    }
}

/// Draws lines and points of a panel, in a figure of `count` series: restless lines below calm ones, then markers.
pub(super) fn series(page: &Page, placed: &PlacedPanel, count: usize) -> Done {
    let runs = |series: &Series| runs(placed, series);
    let all: Vec<(&Look, Vec<Vec<Pt>>)> = placed.looks.iter().zip(placed.panel.series.iter().map(runs)).collect();
    let lines = all.iter().filter_map(|(look, runs)| Some(lines(placed, look.line?, runs, count)));
    let (restless, calm): (Vec<_>, Vec<_>) = lines.partition(|(is_restless, ..)| *is_restless);
    for (_, stroke, parts) in restless.into_iter().chain(calm) {
        parts.into_iter().try_for_each(|part| page.draw(&StrokedLine(part, stroke)))?;
    }
    all.iter().try_for_each(|(look, runs)| markers(page, placed, look, runs, count))
}

/// Returns the points in the picture, split where one of them is not a number.
fn runs(placed: &PlacedPanel, series: &Series) -> Vec<Vec<Pt>> {
    let place = |(x, y): &Pt| Some(placed.frame.at(placed.x.place(*x)?, placed.y.place(*y)?));
    let places: Vec<Option<Pt>> = series.points.iter().map(place).collect();
    places.split(Option::is_none).map(|run| run.iter().flatten().copied().collect()).collect()
}

/// Returns the lines of a series with their stroke, and true if they are restless: these are thin, since at full width
/// they would be one blot.
fn lines(placed: &PlacedPanel, mut stroke: Stroke, runs: &[Vec<Pt>], count: usize) -> (bool, Stroke, Vec<Vec<Pt>>) {
    let full = runs.iter().map(Vec::len).sum::<usize>().max(1);
    let most = |run: &[Pt]| ((16_000 / count).max(200) * run.len() / full).max(8);
    let thinned = runs.iter().map(|run| polyline::clipped(&polyline::thinned(run, most(run)), placed.frame.ends()));
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

fn markers(page: &Page, placed: &PlacedPanel, look: &Look, runs: &[Vec<Pt>], count: usize) -> Done {
    // A single point between two gaps has no line; a dot of the line's width would be missed.
    let marked = runs.iter().filter(|run| look.marker.is_some() || run.len() == 1);
    let points: Vec<Pt> = marked.flatten().copied().filter(|point| placed.frame.contains(*point)).collect();
    let kept = polyline::apart(&points, (12_000 / count).max(60));
    let crowd = usize::from(kept.len() > 150) + usize::from(kept.len() > 2000);
    let radius = if look.marker.is_some() { MARKER_RADIUS * [1.0, 0.6, 0.35][crowd] } else { 2.7 };
    let marker = look.marker.unwrap_or(Marker::Circle);
    kept.into_iter().try_for_each(|i| marker.draw(page, points[i], radius, look.color))
}
